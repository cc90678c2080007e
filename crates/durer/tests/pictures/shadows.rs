//! Where opaque things keep light away, and how much light there is where they do not.

use crate::support::{assert_gray, assert_vector, look, visibility};
use durer::math::Rgb;

/// A light at height 10, a ball of radius 1 at height 5 under it, a floor.
const LAMP_AND_BALL: &str = "
lights: [point: {position: [0, 10, 0]}]
objects:
  - plane: {material: {color: 1}}
  - sphere: {center: [0, 5, 0], radius: 1}
";

/// Looks at a point of the floor from a little beside it.
fn floor(text: &str, x: f64, z: f64) -> crate::support::Seen {
    let seen = look(text, [x, 0.1, z + 0.1], [x, 0.0, z]);
    assert_vector(seen.hit().point, [x, 0.0, z]);
    seen
}

#[test]
fn behind_something_opaque_there_is_ambient_light_only() {
    let seen = floor(LAMP_AND_BALL, 0.5, 0.5);
    assert_gray(seen.color, 0.2);
    assert_eq!(seen.ray.lights[0].visibility, Rgb::BLACK);
    // In the light: n·l = 10/√(100 + 9).
    assert_gray(floor(LAMP_AND_BALL, 3.0, 0.0).color, 0.2 + 0.8 * 10.0 / 109.0_f64.sqrt());
}

/// The cone around the ball has the half-angle asin(1/5): on the floor, a circle of radius 10 / √24.
#[test]
fn the_shadow_of_a_ball_ends_where_the_tangent_cone_meets_the_floor() {
    let radius = 10.0 / 24.0_f64.sqrt();
    for turn in 0..12 {
        let (sin, cos) = f64::from(turn * 30).to_radians().sin_cos();
        let lit = |r: f64| floor(LAMP_AND_BALL, r * cos, r * sin).ray.lights[0].visibility;
        assert_eq!(lit(radius - 1e-7), Rgb::BLACK);
        assert_eq!(lit(radius + 1e-7), Rgb::WHITE);
    }
}

/// At 45° the shadow of a ball is an ellipse, half as long as √2 and half as wide as 1, as far off as the ball is high.
#[test]
fn parallel_light_draws_the_ball_as_an_ellipse() {
    let text = LAMP_AND_BALL.replace("point: {position: [0, 10, 0]}", "directional: {direction: [2, -2, 0]}");
    let lit = |x: f64, z: f64| floor(&text, x, z).ray.lights[0].visibility;
    for turn in 0..12 {
        let (sin, cos) = f64::from(turn * 30).to_radians().sin_cos();
        let edge = |s: f64| lit(5.0 + s * 2.0_f64.sqrt() * cos, s * sin);
        assert_eq!(edge(1.0 - 1e-7), Rgb::BLACK);
        assert_eq!(edge(1.0 + 1e-7), Rgb::WHITE);
    }
    assert_eq!(lit(0.0, 0.0), Rgb::WHITE, "not under the ball");
    assert_gray(floor(&text, -3.0, 0.0).color, 0.2 + 0.8 * 0.5_f64.sqrt());
    assert_eq!(floor(&text, 0.0, 0.0).ray.lights[0].distance, Some(f64::INFINITY));
}

#[test]
fn what_is_behind_the_light_throws_no_shadow() {
    for (height, expected) in [(4.5, Rgb::BLACK), (5.5, Rgb::WHITE), (6.5, Rgb::WHITE), (2.0, Rgb::BLACK)] {
        let text = format!(
            "lights: [point: {{position: [0, 5, 0]}}]
objects: [plane: {{}}, disc: {{center: [0, {height}, 0], radius: 3}}]"
        );
        let seen = look(&text, [1.0, 0.1, 0.1], [1.0, 0.0, 0.0]);
        assert_eq!(seen.ray.lights[0].visibility, expected, "disc at {height}, light at 5");
    }
}

/// As of a lamp drawn into the scene, or of the point light of a ceiling.
#[test]
fn a_light_that_lies_in_a_surface_is_not_hidden_by_it() {
    for scale in [1e-3, 1.0, 1e3] {
        let text = format!(
            "lights: [point: {{position: [0, {height}, 0]}}]
objects: [plane: {{}}, plane: {{point: [0, {height}, 0]}}]",
            height = 7.3 * scale
        );
        for x in [0.0, 0.3, 1.7, 23.0, 311.0] {
            let seen = look(&text, [x * scale, scale, scale], [x * scale, 0.0, 0.0]);
            assert_eq!(seen.ray.lights[0].visibility, Rgb::WHITE, "x = {x}, scale {scale}");
        }
    }
}

/// Intensity is what arrives at distance 1.
#[test]
fn light_that_falls_off_is_a_quarter_at_twice_the_distance() {
    for (height, arriving) in [(1.0, 0.5), (2.0, 0.125), (4.0, 0.031_25)] {
        let text = format!(
            "lights: [point: {{position: [0, {height}, 0], intensity: 0.5, falloff: inverse_square}}]
objects: [plane: {{material: {{color: 1}}}}]"
        );
        assert_gray(look(&text, [0.0, 0.5, 0.5], [0.0, 0.0, 0.0]).color, 0.2 + 0.8 * arriving);
        // Beside it, at the angle whose cosine is 0.8, the distance is 1.25 times the height.
        let beside = [0.75 * height, 0.0, 0.0];
        let seen = look(&text, [beside[0], 0.5, 0.5], beside);
        assert_gray(seen.color, 0.2 + 0.8 * 0.8 * arriving / 1.5625);
    }
}

/// Nothing is between a convex thing and a light in front of it, nor between its back and itself.
#[test]
fn a_ball_shades_its_own_back() {
    let text = "lights: [point: {position: [0, 0, 10]}]\nobjects: [sphere: {}]";
    for (from, expected) in [([0.0, 0.0, 5.0], Rgb::WHITE), ([0.0, 0.0, -5.0], Rgb::BLACK)] {
        assert_eq!(visibility(text, from, [0.0, 0.0, 0.0]), expected);
    }
    // The light sees the ball up to z = 1/10.
    for (z, lit) in [(0.1 + 1e-6, true), (0.1 - 1e-6, false)] {
        let x = (1.0_f64 - z * z).sqrt();
        let seen = look(text, [4.0 * x, 0.0, 4.0 * z], [0.0, 0.0, 0.0]);
        assert_eq!(seen.ray.lights[0].cosine > 0.0, lit, "z = {z}");
        assert_eq!(seen.ray.lights[0].visibility == Rgb::WHITE, lit, "z = {z}");
    }
}
