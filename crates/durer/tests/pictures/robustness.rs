//! No acne: what is lit is lit in every pixel, however large, small or far away it is.

use crate::support::{compile, explained, look, scene};
use durer::math::{DVec3, Rgb};

/// One of each shape around the origin, of about unit size, in a form that a factor multiplies.
fn shapes(s: f64) -> Vec<String> {
    vec![
        format!("sphere: {{radius: {s}}}"),
        format!("box: {{min: [-{s}, -{s}, -{s}], max: [{s}, {s}, {s}]}}"),
        format!("cylinder: {{base: [0, -{s}, 0], top: [0, {s}, 0], radius: {s}}}"),
        format!("cylinder: {{base: [0, -{s}, 0], top: [0, {s}, 0], radius: {s}, open: true}}"),
        format!("cone: {{base: [0, -{s}, 0], top: [0, {s}, 0], radius: {s}}}"),
        format!("cone: {{base: [0, -{s}, 0], top: [0, {s}, 0], radius: {}, top_radius: {s}}}", 0.4 * s),
        format!("disc: {{normal: [1, 2, 3], radius: {s}, inner_radius: {}}}", 0.3 * s),
        format!("rectangle: {{corner: [-{s}, -{s}, {}], edges: [[{s}, {s}, 0], [0, {s}, {s}]]}}", 0.3 * s),
        format!("triangle: {{vertices: [[-{s}, 0, {s}], [{s}, 0, 0], [0, {s}, -{s}]]}}"),
        format!("torus: {{axis: [1, 2, 1], radius: {}, tube_radius: {}}}", 0.7 * s, 0.3 * s),
        "plane: {normal: [1, 2, 1]}".to_owned(),
    ]
}

/// The lamp is at the eye: whatever is seen is lit, with nothing between.
fn assert_lit(shape: &str, transform: &str, middle: DVec3, scale: f64) {
    let size = 32;
    for towards in [DVec3::new(-0.3, -0.4, -1.0), DVec3::new(0.8, -1.0, 0.5), DVec3::new(0.1, 1.0, -0.2)] {
        let eye = middle - towards * (3.0 * scale);
        let text = format!(
            "camera: {{position: [{x}, {y}, {z}], look_at: [{}, {}, {}], fov: 50, up: [0.1, 0.2, 1]}}
picture: {{width: {size}, height: {size}}}
render: {{antialias: none}}
lights: [point: {{position: [{x}, {y}, {z}]}}]
objects: [group: {{transform: [{transform}], objects: [{shape}]}}]",
            middle.x,
            middle.y,
            middle.z,
            x = eye.x,
            y = eye.y,
            z = eye.z
        );
        let mut hits = 0;
        for pixel in explained(&compile(scene(&text))) {
            let ray = &pixel.samples[0].ray;
            if ray.hit.is_some() {
                let light = &ray.lights[0];
                let context = || format!("{shape}, {transform}, at ({}, {}): {light:?}", pixel.x, pixel.y);
                assert!(light.cosine > -1e-6, "{}", context());
                assert!(light.visibility == Rgb::WHITE || light.cosine < 1e-6, "{}", context());
                hits += 1;
            }
        }
        assert!(hits > 4, "{shape} covers {hits} pixels");
    }
}

#[test]
fn whatever_the_eye_sees_a_lamp_at_the_eye_lights() {
    for scale in [1e-3, 1.0, 1e6] {
        for shape in shapes(scale) {
            assert_lit(&shape, "", DVec3::ZERO, scale);
        }
    }
}

#[test]
fn it_does_so_when_the_size_is_made_by_a_transform() {
    for scale in [1e-3, 1e6] {
        for shape in shapes(1.0) {
            assert_lit(&shape, &format!("scale: {scale}"), DVec3::ZERO, scale);
        }
    }
    for shape in shapes(1.0) {
        assert_lit(&shape, "scale: [1, 0.05, 1], rotate: {x: 30}", DVec3::ZERO, 1.0);
    }
}

#[test]
fn it_does_so_far_from_the_origin() {
    let middle = DVec3::new(1e6, -2e6, 1e6);
    for shape in shapes(1.0) {
        assert_lit(&shape, "translate: [1e+6, -2e+6, 1e+6]", middle, 1.0);
    }
}

/// A ball has 0.2 + 0.8 n·l wherever the light reaches it: no speckle anywhere, up to where day becomes night.
#[test]
fn a_ball_is_lit_by_the_formula_in_every_pixel() {
    for (radius, far) in [(1e-3, 0.0), (1.0, 0.0), (1e6, 0.0), (1.0, 1e6)] {
        let text = format!(
            "camera: {{position: [{far}, {far}, {z}], look_at: [{far}, {far}, 0], orthographic: {{height: {h}}}}}
picture: {{width: 90, height: 90}}
render: {{antialias: none}}
background: 0
lights: [directional: {{direction: [-1, -2, -2]}}]
objects: [sphere: {{center: [{far}, {far}, 0], radius: {radius}, material: {{color: 1}}}}]",
            z = 3.0 * radius,
            h = 2.0 * radius
        );
        let image = crate::support::picture(scene(&text));
        for y in 0..90 {
            for x in 0..90 {
                let (a, b) = ((f64::from(x) + 0.5) / 45.0 - 1.0, 1.0 - (f64::from(y) + 0.5) / 45.0);
                let c2 = 1.0 - a * a - b * b;
                if c2 > 1e-3 {
                    let cosine = (a + 2.0 * b + 2.0 * c2.sqrt()) / 3.0;
                    let (found, expected) = (f64::from(image.pixel(x, y).r), 0.2 + 0.8 * cosine.max(0.0));
                    assert!(
                        (found - expected).abs() < 1e-5,
                        "radius {radius} at {far}: ({x}, {y}): {found}, {expected}"
                    );
                }
            }
        }
    }
}

/// Rays that start on a mirror or on glass do not meet it again at once.
#[test]
fn mirrors_and_glass_do_not_meet_themselves() {
    for scale in [1e-3, 1.0, 1e6] {
        for offset in [0.0, 0.3, 0.77, 0.999, 0.999_999] {
            let ray = ([offset * scale, 0.0, 5.0 * scale], [offset * scale, 0.0, 0.0]);
            let ball = |material: &str| {
                format!("lights: []\nobjects: [sphere: {{radius: {scale}, material: {{{material}}}}}]")
            };
            let mirror = look(&ball("reflection: 1"), ray.0, ray.1);
            assert!(mirror.after(1).hit.is_none(), "mirror, {offset} × {scale}");
            for material in ["transparency: 1", "transparency: 1, ior: 1.5", "transparency: 1, ior: 1.0001"] {
                let clear = look(&ball(material), ray.0, ray.1);
                let inside = clear.after(1).hit.expect("the far face");
                assert!(!inside.from_outside, "{material}, {offset} × {scale}");
                assert!(clear.after(2).hit.is_none(), "{material}, {offset} × {scale}");
            }
        }
    }
}
