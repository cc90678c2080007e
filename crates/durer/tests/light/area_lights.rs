//! Glowing shapes over a matte floor: what a point of it gives back is its albedo times their radiance times the form factor,
//! which textbooks on heat transfer list.

use crate::support::assert_pixel;
use std::f64::consts::PI;

/// One spot of a matte floor in y = 0, seen from above, under a light; nothing but what comes straight from that.
fn floor(light: &str) -> String {
    format!(
        "camera: {{position: [0, 0.01, 0], look_at: [0, 0, 0], up: [0, 0, 1], orthographic: {{height: 0.0001}}}}\n\
         background: black\n\
         lights: []\n\
         objects:\n  \
         - rectangle: {{corner: [-1, 0, 1], edges: [[2, 0, 0], [0, 0, -2]], material: {{matte: {{color: 0.5}}}}}}\n  \
         - {light}\n"
    )
}

const DIRECT: &str = "{path: {max_depth: 2}}";

#[test]
fn a_rectangle_above() {
    for (a, b, h) in [(1.0_f64, 1.0_f64, 1.0_f64), (4.0, 0.5, 0.3), (0.2, 0.1, 3.0)] {
        let light = format!(
            "rectangle: {{corner: [{}, {h}, {}], edges: [[{a}, 0, 0], [0, 0, {b}]], \
             material: {{matte: {{color: black, emission: 3}}}}}}",
            -a / 2.0,
            -b / 2.0
        );
        // Four times that of a quarter, over whose corner the spot lies.
        let (a, b) = (a / 2.0, b / 2.0);
        let side = |a: f64, b: f64| a / a.hypot(h) * (b / a.hypot(h)).atan();
        let factor = 4.0 / (2.0 * PI) * (side(a, b) + side(b, a));
        assert_pixel(DIRECT, 64, &floor(&light), 0.5 * 3.0 * factor);
    }
}

#[test]
fn a_disc_above() {
    for (r, h) in [(0.5, 1.0), (3.0, 0.5)] {
        let light = format!(
            "disc: {{center: [0, {h}, 0], normal: [0, -1, 0], radius: {r}, \
             material: {{matte: {{color: black, emission: 3}}}}}}"
        );
        assert_pixel(DIRECT, 64, &floor(&light), 0.5 * 3.0 * r * r / (r * r + h * h));
    }
}

#[test]
fn a_ball_above_and_aside() {
    // The part of its solid angle's projection: sin² of its half-angle times the cosine towards its middle.
    for (center, r) in [([0.0_f64, 2.0, 0.0], 1.0), ([0.0, 10.0, 0.0], 0.1), ([3.0, 4.0, 0.0], 2.0_f64)] {
        let [x, y, z] = center;
        let light = format!(
            "sphere: {{center: [{x}, {y}, {z}], radius: {r}, material: {{matte: {{color: black, emission: 3}}}}}}"
        );
        let d = x.hypot(y);
        assert_pixel(DIRECT, 64, &floor(&light), 0.5 * 3.0 * (r / d).powi(2) * y / d);
    }
}

/// A light of one side lights but that.
#[test]
fn the_dark_side() {
    let light = |normal: &str| {
        format!(
            "disc: {{center: [0, 1, 0], normal: {normal}, radius: 1, \
             material: {{matte: {{color: black, emission: {{color: 3, sides: front}}}}}}}}"
        )
    };
    assert_pixel(DIRECT, 64, &floor(&light("[0, -1, 0]")), 0.75);
    let (found, _) = crate::support::pixel(DIRECT, 16, &floor(&light("[0, 1, 0]")));
    assert!(found.is_black(), "{found:?}");
}

/// Glass bends light, so lamps are not seen through it; where it is but half there, half of their light gets past each of its
/// two surfaces, whether a number says so or a texture.
#[test]
fn glass_that_is_half_there() {
    let lit = |ball: &str| {
        let light = format!("point: {{position: [0, 4, 0], intensity: 1}}\nobjects:\n  {ball}");
        let floor =
            "- rectangle: {corner: [-1, 0, 1], edges: [[2, 0, 0], [0, 0, -2]], material: {matte: {color: 0.5}}}";
        let text = format!(
            "camera: {{position: [0, 0.01, 0], look_at: [0, 0, 0], up: [0, 0, 1], orthographic: {{height: 0.0001}}}}\n\
             background: black\n\
             textures: {{half: {{checker: {{colors: [0.5, 0.5], size: 1}}}}}}\n\
             lights:\n  - {light}\n  {floor}\n"
        );
        f64::from(crate::support::pixel(DIRECT, 4, &text).0.g)
    };
    let ball = |opacity: &str| {
        format!("- sphere: {{center: [0, 2, 0], radius: 0.5, material: {{glass: {{ior: 1.5, opacity: {opacity}}}}}}}")
    };
    assert!((lit("") - 0.5).abs() < 1e-6);
    for (opacity, expected) in [("1", 0.0), ("0.5", 0.125), ("half", 0.125), ("0.9", 0.005)] {
        let found = lit(&ball(opacity));
        assert!((found - expected).abs() < 1e-6, "{opacity}: {found}, not {expected}");
    }
}
