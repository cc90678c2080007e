//! The light of spots on walls.

use crate::support::{Front, assert_gray, look, scene};
use durer::math::DVec3;

fn wall(spot: &str) -> String {
    format!("lights: [spot: {{{spot}}}]\nobjects: [plane: {{normal: [0, 0, 1], material: {{color: 1}}}}]")
}

/// At distance 10, half-angle 15°: a circle of radius 10 tan 15° = 2.679.
#[test]
fn a_spot_draws_a_circle_of_the_radius_of_its_cone() {
    let text = wall("position: [0, 0, 10], target: [0, 0, 0], half_angle: 15");
    let radius = 10.0 * 15.0_f64.to_radians().tan();
    let view = Front::of(scene(&text), 101, 6.0);
    for (x, y, color) in view.points() {
        let r = (x * x + y * y).sqrt();
        let lit = if r < radius { 0.8 * 10.0 / (100.0 + r * r).sqrt() } else { 0.0 };
        assert_gray(color, 0.2 + lit);
    }
    for (r, lit) in [(radius - 1e-7, true), (radius + 1e-7, false)] {
        let seen = look(&text, [r, 0.0, 5.0], [r, 0.0, 0.0]);
        assert_eq!(seen.ray.lights[0].distance.is_some(), lit);
    }
}

/// Every pixel: lit if its direction from the spot is within 20° of the axis.
#[test]
fn a_spot_that_falls_at_a_slant_draws_the_section_of_its_cone() {
    let text = wall("position: [-4, 1, 3], target: [0, 0, 0], half_angle: 20");
    let from = DVec3::new(-4.0, 1.0, 3.0);
    let view = Front::of(scene(&text), 80, 8.0);
    let mut lit = 0;
    for (x, y, color) in view.points() {
        let to = DVec3::new(x, y, 0.0) - from;
        let cosine = to.dot(-from) / (to.length() * from.length());
        let inside = cosine > 20.0_f64.to_radians().cos();
        assert_gray(color, 0.2 + if inside { 0.8 * 3.0 / to.length() } else { 0.0 });
        lit += usize::from(inside);
    }
    assert!((200..3000).contains(&lit), "{lit} pixels: both kinds are in the picture");
}

/// Between the angles, Hermite's 3s² - 2s³ with s linear in the cosine.
#[test]
fn a_soft_spot_fades_from_its_inner_angle_to_its_edge() {
    let text = wall("position: [0, 0, 10], target: [0, 0, 0], half_angle: 30, inner_half_angle: 10");
    let cos = |degrees: f64| degrees.to_radians().cos();
    for degrees in [0.0_f64, 5.0, 9.99, 12.0, 17.0, 20.0, 25.0, 29.0, 30.01, 45.0] {
        let s = ((cos(degrees) - cos(30.0)) / (cos(10.0) - cos(30.0))).clamp(0.0, 1.0);
        let strength = s * s * (3.0 - 2.0 * s);
        let x = 10.0 * degrees.to_radians().tan();
        assert_gray(look(&text, [x, 0.0, 5.0], [x, 0.0, 0.0]).color, 0.2 + 0.8 * strength * cos(degrees));
    }
}

#[test]
fn a_spot_shines_nothing_backward() {
    let text = wall("position: [0, 0, 10], target: [0, 0, 20], half_angle: 89");
    assert_gray(look(&text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, 0.2);
    let all_around = text.replace("half_angle: 89", "half_angle: 180");
    assert_gray(look(&all_around, [1.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, 1.0);
}

#[test]
fn color_and_intensity_multiply() {
    let text = "
lights: [directional: {direction: [0, 0, -5], color: [1, 0.5, 0.25], intensity: 0.5}]
objects: [plane: {normal: [0, 0, 1], material: {color: 1, ambient: 0, diffuse: 0.5}}]
";
    crate::support::assert_color(look(text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, [0.25, 0.125, 0.0625]);
}

/// The seed's sentence: a spotlight throws a round shadow of the ball on the wall.
#[test]
fn a_ball_in_a_spot_throws_a_round_shadow_on_the_wall() {
    let text = wall("position: [0, 0, 10], target: [0, 0, 0], half_angle: 20");
    let text = text.replace("objects: [", "objects: [sphere: {center: [0, 0, 5], radius: 0.5}, ");
    let shadow = 10.0 * 0.1_f64.asin().tan();
    for turn in 0..8 {
        let (sin, cos) = f64::from(turn * 45).to_radians().sin_cos();
        for (r, lit) in [(shadow - 1e-6, 0.0), (shadow + 1e-6, 1.0), (10.0 * 0.36, 1.0)] {
            let (x, y) = (r * cos, r * sin);
            let seen = look(&text, [x, y, 1.0], [x, y, 0.0]);
            assert_gray(seen.ray.lights[0].visibility, lit);
        }
    }
}
