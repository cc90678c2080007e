//! Ambient and diffuse light and highlights (Whitted 1980, Phong 1975).

use crate::support::{assert_color, assert_gray, difference, look};
use durer::Source;
use durer::math::Rgb;

/// n·l = 0.8; r = (-0.6, 0, 0.8), so r·v = 0.8 and the highlight is 0.8^10 = 0.1073741824.
const PLATE: &str = "
ambient: [1, 0.5, 0.25]
lights: [point: {position: [3, 0, 4], color: [1, 0.5, 0.25], intensity: 0.5}]
objects:
  - plane:
      normal: [0, 0, 1]
      material: {color: [0.5, 0.25, 1], ambient: 0.2, diffuse: 0.8, specular: [0.6, 0.3, 0], shininess: 10}
";

const PLATE_SHADE: [f64; 3] = [
    0.2 * 0.5 + 0.5 * (0.8 * 0.5 * 0.8 + 0.6 * 0.107_374_182_4),
    0.2 * 0.5 * 0.25 + 0.25 * (0.8 * 0.25 * 0.8 + 0.3 * 0.107_374_182_4),
    0.2 * 0.25 + 0.125 * (0.8 * 0.8),
];

#[test]
fn ambient_diffuse_and_highlight_add_up() {
    assert_color(look(PLATE, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, PLATE_SHADE);
}

#[test]
fn a_surface_has_two_equal_sides() {
    let turned = PLATE.replace("normal: [0, 0, 1]", "normal: [0, 0, -1]");
    assert_ne!(turned, PLATE);
    assert_color(look(&turned, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, PLATE_SHADE);
}

#[test]
fn light_behind_an_opaque_surface_does_not_reach_its_front() {
    let seen = look(PLATE, [0.0, 0.0, -5.0], [0.0, 0.0, 0.0]);
    assert_color(seen.color, [0.1, 0.025, 0.05]);
    assert_eq!(seen.ray.contributions.len(), 1);
}

/// A clear plate does not stop the light behind it, and r·v = 0.52 > 0: only n·l < 0 keeps the highlight away.
#[test]
fn there_is_no_highlight_from_a_light_behind_a_clear_surface() {
    let text = "
background: 0
lights: [point: {position: [6, 0, -2]}]
objects: [plane: {normal: [0, 0, 1], material: {color: 0.5, specular: 1, shininess: 1, transparency: 0.5}}]
";
    let seen = look(text, [-9.0, 0.0, 1.0], [0.0, 0.0, 0.0]);
    assert_gray(seen.color, 0.5 * 0.2 * 0.5);
    let sources: Vec<Source> = seen.ray.contributions.iter().map(|c| c.source).collect();
    assert_eq!(sources, [Source::Ambient]);
    assert!(seen.ray.lights[0].cosine < 0.0);
}

#[test]
fn the_light_of_several_lights_adds_up() {
    let plate = |lights: &str| {
        let text = format!(
            "lights: [{lights}]\nobjects: [plane: {{normal: [0, 0, 1], material: {{color: 0.5, specular: 0.5}}}}]"
        );
        look(&text, [1.0, 0.0, 3.0], [0.0, 0.0, 0.0]).color
    };
    let lights = [
        "point: {position: [-1, 0, 3], color: [1, 0, 0]}",
        "directional: {direction: [0, -1, -1], color: [0, 1, 0.5], intensity: 0.3}",
        "spot: {position: [1, 1, 1], target: [0, 0, 0], color: [0, 0.25, 1]}",
    ];
    let dark = plate("");
    let one_by_one = lights.iter().fold(dark, |sum, light| sum + plate(light) - dark);
    let together = plate(&lights.join(", "));
    assert!(difference(together, one_by_one) < 1e-6, "{together:?} {one_by_one:?}");
    assert!(difference(together, dark) > 0.3, "and there is light at all");
}

/// The light stands in the mirrored direction of the view: 1^m = 1 whatever the exponent.
#[test]
fn a_highlight_is_full_in_the_mirrored_direction_and_not_tinted_by_the_surface() {
    for shininess in [1, 40, 1000] {
        let text = format!(
            "lights: [point: {{position: [-3, 0, 4], color: [1, 1, 0.5]}}]
objects:
  - plane:
      normal: [0, 0, 1]
      material: {{color: [1, 0, 0], ambient: 0, diffuse: 0, specular: [0, 0.5, 1], shininess: {shininess}}}"
        );
        assert_color(look(&text, [3.0, 0.0, 4.0], [0.0, 0.0, 0.0]).color, [0.0, 0.5, 0.5]);
    }
}

/// c = (1 - t)·shade + t·behind, the highlight being part of shade.
#[test]
fn a_clear_surface_dims_its_own_highlight() {
    let clear = format!("background: 0.4{}", PLATE.replace("shininess: 10}", "shininess: 10, transparency: 0.75}"));
    let expected = PLATE_SHADE.map(|shade| 0.25 * shade + 0.75 * 0.4);
    assert_color(look(&clear, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, expected);
}

/// Without `lights` there are two directional ones: l1 = (-1, 2, 1.5)/√7.25 at 0.75, l2 = (2, 1, 1)/√6 at 0.2.
#[test]
fn a_scene_that_says_nothing_of_lights_has_the_two_of_the_reference() {
    let text = "objects: [plane: {normal: [0, 0, 1]}]";
    let expected = 0.8 * (0.2 + 0.8 * (0.75 * 1.5 / 7.25_f64.sqrt() + 0.2 / 6.0_f64.sqrt()));
    assert_gray(look(text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, expected);
    assert_eq!(look(&format!("lights: []\n{text}"), [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, Rgb::gray(0.8 * 0.2));
}
