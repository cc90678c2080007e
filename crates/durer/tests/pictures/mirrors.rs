//! Mirrors: images behind the glass, images of images, and where the chain of rays ends.

use crate::support::{assert_color, assert_gray, difference, look, picture, scene};
use durer::math::Rgb;
use durer::{NotTraced, RayKind};

/// The eye at the origin looks along -z; a lamp and a ball; beside them what differs.
fn view(lamp_z: f64, ball_z: f64, rest: &str) -> durer::imaging::Image {
    let text = format!(
        "camera: {{fov: 60}}
picture: {{width: 48, height: 40}}
render: {{antialias: none}}
background: 0
lights: [point: {{position: [1, 2, {lamp_z}]}}]
objects:
  - sphere: {{center: [1, 0.5, {ball_z}], radius: 1, material: {{color: tomato, specular: 0.5, shininess: 10}}}}
{rest}"
    );
    picture(scene(&text))
}

/// A mirror at z = -5 shows what stands at z = 3 as if it stood at z = -13, and the lamp at 2 as at -12.
#[test]
fn the_mirror_image_is_as_far_behind_as_the_thing_is_before() {
    let mirror = "  - plane: {point: [0, 0, -5], normal: [0, 0, 1], material: {color: 0, reflection: [0.8, 0.4, 0.2]}}";
    let mirrored = view(2.0, 3.0, mirror);
    let direct = view(-12.0, -13.0, "");
    let mut seen = 0;
    for (mirrored, direct) in mirrored.pixels.iter().zip(&direct.pixels) {
        let expected = *direct * durer::math::Rgb::new(0.8, 0.4, 0.2);
        assert!(difference(*mirrored, expected) < 1e-6, "{mirrored:?} {expected:?}");
        seen += usize::from(!direct.is_black());
    }
    assert!(seen > 20, "the ball covers {seen} pixels");
}

#[test]
fn a_ray_leaves_a_mirror_at_the_angle_at_which_it_came() {
    let text = "
lights: []
objects: [rectangle: {corner: [-2, 2, 0], edges: [[2, -2, 0], [0, 0, 2]], material: {reflection: 1}}]
";
    // The mirror x + y = 0 takes (x, y) to (-y, -x).
    let seen = look(text, [2.0, 3.0, 1.0], [-1.0, 1.0, 1.5]);
    let length = (9.0_f64 + 4.0 + 0.25).sqrt();
    crate::support::assert_vector(seen.after(1).direction, [2.0 / length, 3.0 / length, 0.5 / length]);
    assert_eq!(seen.after(1).kind, RayKind::Reflected);
}

/// Two mirrors face each other, each glowing with 0.1 and reflecting one half: 0.1 (1 + 1/2 + 1/4 + …).
fn hall(render: &str) -> String {
    format!(
        "render: {{{render}}}
lights: []
objects:
  - plane: {{point: [0, 0, -5], normal: [0, 0, 1], material: &mirror {{color: 0.1, ambient: 1, reflection: 0.5}}}}
  - plane: {{point: [0, 0, 5], normal: [0, 0, 1], material: *mirror}}"
    )
}

#[test]
fn between_two_mirrors_the_images_end_at_the_depth_limit() {
    for max_depth in [1, 2, 3, 5, 8, 20] {
        let seen = look(&hall(&format!("max_depth: {max_depth}, min_weight: 0")), [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
        assert_gray(seen.color, 0.1 * (2.0 - 0.5_f64.powi(max_depth - 1)));
        let last = seen.after(max_depth as usize - 1);
        assert_eq!(last.depth, max_depth as u32);
        assert!(last.children.is_empty());
        let [(RayKind::Reflected, weight, NotTraced::TooDeep)] = last.not_traced[..] else {
            panic!("{:?}", last.not_traced)
        };
        assert_gray(weight, 0.5_f64.powi(max_depth));
    }
}

/// Weights are 1, 1/2, 1/4, …: a ray that counts as much as the limit is traced, one below it is not.
#[test]
fn rays_that_count_too_little_are_not_traced() {
    for (min_weight, traced) in [(0.1, 4), (0.125, 4), (0.126, 3), (0.5, 2), (0.6, 1), (0.0, 30)] {
        let render = format!("max_depth: 30, min_weight: {min_weight}");
        let seen = look(&hall(&render), [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
        assert_gray(seen.color, 0.1 * (2.0 - 0.5_f64.powi(traced - 1)));
        let why = if traced == 30 { NotTraced::TooDeep } else { NotTraced::TooFaint };
        assert_eq!(seen.after(traced as usize - 1).not_traced[0].2, why);
    }
}

/// c = (1 - t)·shade + t·behind + r·reflected.
#[test]
fn reflection_is_added_to_shade_and_to_what_shows_through() {
    let text = "
background: {bottom: 0, top: 1}
lights: []
objects: [plane: {material: {color: 0.6, ambient: 1, transparency: 0.25, reflection: [0.5, 0.2, 0]}}]
";
    // Straight down: behind is the bottom of the background, reflected its top.
    assert_color(look(text, [0.0, 5.0, 0.0], [0.0, 0.0, 0.0]).color, [0.95, 0.65, 0.45]);
    // Upward: behind is the top, reflected the bottom.
    assert_color(look(text, [0.0, -5.0, 0.0], [0.0, 0.0, 0.0]).color, [0.7; 3]);
}

/// What is mirrored, and what glass lets pass, has the color of the thing, where it has one of its own.
#[test]
fn mirrors_and_glass_have_the_colors_of_things() {
    let seen = |integrator: &str, objects: &str| {
        let settings = format!("integrator: {integrator}, antialias: none");
        picture(scene(&format!(
            "{{picture: {{width: 3, height: 3}}, render: {{{settings}}}, background: 0.5, ambient: 0, lights: [], \
             camera: {{position: [0, 0, 5], look_at: [0, 0, 0], fov: 5}}, objects: [{objects}]}}"
        )))
        .pixel(1, 1)
    };
    let expected = Rgb::new(0.1, 0.3, 0.4);
    let own = "spheres: {centers: [[0, 0, 0]], colors: [[0.2, 0.6, 0.8]], material: {mirror: {}}}";
    for integrator in ["whitted", "path"] {
        let found = seen(integrator, own);
        assert!((found - expected).map(f32::abs).max_component() < 1e-6, "{integrator}: {found:?}");
        // Both boundaries of the ball let the color pass once.
        let glass = own.replace("mirror: {}", "glass: {ior: 1}");
        let found = seen(integrator, &glass);
        let expected = Rgb::new(0.02, 0.18, 0.32);
        assert!((found - expected).map(f32::abs).max_component() < 1e-6, "{integrator}, glass: {found:?}");
    }
}

/// Panes in front of an even sky give back no more than there is.
#[test]
fn panes_make_no_light() {
    for material in ["glass: {thin: true}", "principled: {base_color: 1, transmission: 1, roughness: 0, thin: true}"] {
        let pane = |z: i32| {
            format!("rectangle: {{corner: [-9, -9, {z}], edges: [[18, 0, 0], [0, 18, 0]], material: {{{material}}}}}")
        };
        let objects = (0..3).map(pane).collect::<Vec<_>>().join(", ");
        let image = picture(scene(&format!(
            "{{picture: {{width: 3, height: 3}}, render: {{max_depth: 9}}, background: 0.5, ambient: 0, lights: [], \
             camera: {{position: [0, 0, 5], look_at: [0, 0, 0], fov: 5}}, objects: [{objects}]}}"
        )));
        let most = image.pixels.iter().map(|pixel| pixel.max_component()).fold(0.0, f32::max);
        assert!((0.49..0.500_01).contains(&most), "{material}: {most}");
    }
}
