//! Fog: c' = F + (c - F)·visible, on every segment of the path by that segment's own length.

use crate::support::{assert_color, look};

const FOG: [f64; 3] = [0.75, 0.7, 0.8];
const EXPONENTIAL: &str = "fog: {exponential: {color: [0.75, 0.7, 0.8], distance: 20}}";
const LINEAR: &str = "fog: {linear: {color: [0.75, 0.7, 0.8], start: 5, end: 25}}";
const WALL: [f64; 3] = [0.9, 0.1, 0.0];

/// Things here glow in their own colour.
const SCENE: &str = "
background: [0.2, 0.3, 0.4]
lights: []
objects:
  - rectangle:
      corner: [-5, -5, 0]
      edges: [[10, 0, 0], [0, 10, 0]]
      material: {color: [0.9, 0.1, 0], ambient: 1}
";

fn veiled(color: [f64; 3], visible: f64) -> [f64; 3] {
    std::array::from_fn(|i| FOG[i] + (color[i] - FOG[i]) * visible)
}

fn seen(fog: &str, from: [f64; 3], to: [f64; 3]) -> durer::math::Rgb {
    look(&format!("{fog}{SCENE}"), from, to).color
}

#[test]
fn exponential_fog_leaves_one_part_in_e_at_its_distance() {
    for distance in [0.5, 10.0, 20.0, 100.0] {
        let expected = veiled(WALL, (-distance / 20.0_f64).exp());
        assert_color(seen(EXPONENTIAL, [0.0, 0.0, distance], [0.0, 0.0, 0.0]), expected);
    }
    // Along the ray, not along the view.
    assert_color(seen(EXPONENTIAL, [3.0, 0.0, 4.0], [0.0, 0.0, 0.0]), veiled(WALL, (-0.25_f64).exp()));
}

#[test]
fn linear_fog_grows_from_its_start_to_its_end() {
    for (distance, visible) in [(1.0, 1.0), (5.0, 1.0), (10.0, 0.75), (20.0, 0.25), (25.0, 0.0), (30.0, 0.0)] {
        assert_color(seen(LINEAR, [0.0, 0.0, distance], [0.0, 0.0, 0.0]), veiled(WALL, visible));
    }
}

#[test]
fn of_the_background_nothing_is_left() {
    for fog in [EXPONENTIAL, LINEAR] {
        assert_color(seen(fog, [0.0, 0.0, 10.0], [0.0, 0.0, 20.0]), FOG);
    }
    assert_color(seen("", [0.0, 0.0, 10.0], [0.0, 0.0, 20.0]), [0.2, 0.3, 0.4]);
}

/// 10 to the mirror, 15 from there to the wall: the mirror shows 0.8 of what the second segment brings.
#[test]
fn in_a_mirror_each_segment_has_its_own_fog() {
    let mirror = "  - plane: {point: [0, 0, 15], normal: [0, 0, 1], material: {color: 0, reflection: 0.8}}\n";
    for (fog, first, second) in [(EXPONENTIAL, (-0.5_f64).exp(), (-0.75_f64).exp()), (LINEAR, 0.75, 0.5)] {
        let reflected = veiled(WALL, second).map(|c| 0.8 * c);
        let text = format!("{fog}{SCENE}{mirror}");
        assert_color(look(&text, [0.0, 0.0, 5.0], [0.0, 0.0, 15.0]).color, veiled(reflected, first));
    }
}

/// 8 to the ball, 4 through it, 6 to the wall; each face blends 0.3 of its own with 0.7 of what is behind.
#[test]
fn there_is_fog_inside_clear_things() {
    let ball = "  - sphere: {center: [0, 0, 8], radius: 2, material: {color: 0.5, ambient: 1, transparency: 0.7}}\n";
    let exponential = |d: f64| (-d / 20.0).exp();
    let linear = |d: f64| ((25.0 - d) / 20.0).clamp(0.0, 1.0);
    let face = |behind: [f64; 3]| behind.map(|c| 0.3 * 0.5 + 0.7 * c);
    for (fog, visible) in [(EXPONENTIAL, &exponential as &dyn Fn(f64) -> f64), (LINEAR, &linear)] {
        let inside = veiled(face(veiled(WALL, visible(6.0))), visible(4.0));
        let expected = veiled(face(inside), visible(8.0));
        assert_color(look(&format!("{fog}{SCENE}{ball}"), [0.0, 0.0, 18.0], [0.0, 0.0, 0.0]).color, expected);
    }
}

/// Half of a ball is there and glows, and what shows past it is at the end of one straight way: 8 to the ball, 4 in it, 6 behind.
#[test]
fn past_what_is_there_in_part_fog_goes_on() {
    let ball = "  - sphere: {center: [0, 0, 8], radius: 2, material: {color: 0.5, ambient: 1, opacity: 0.5}}\n";
    let exponential = |d: f64| (-d / 20.0).exp();
    let linear = |d: f64| ((25.0 - d) / 20.0).clamp(0.0, 1.0);
    for (fog, visible) in [(EXPONENTIAL, &exponential as &dyn Fn(f64) -> f64), (LINEAR, &linear)] {
        let [near, far, wall] =
            [veiled([0.5; 3], visible(8.0)), veiled([0.5; 3], visible(12.0)), veiled(WALL, visible(18.0))];
        let expected = std::array::from_fn(|i| 0.5 * near[i] + 0.25 * far[i] + 0.25 * wall[i]);
        assert_color(look(&format!("{fog}{SCENE}{ball}"), [0.0, 0.0, 18.0], [0.0, 0.0, 0.0]).color, expected);
    }
}

/// Light on its way from the lamp is not weakened.
#[test]
fn fog_does_not_dim_the_light_of_lamps() {
    let text = format!(
        "{EXPONENTIAL}
lights: [point: {{position: [0, 0, 1000]}}]
objects: [plane: {{normal: [0, 0, 1], material: {{color: 1, ambient: 0, diffuse: 1}}}}]"
    );
    let expected = veiled([1.0; 3], (-0.25_f64).exp());
    assert_color(look(&text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, expected);
}
