//! What clear things leave of the light that goes through them to a point: straight, as in the classic model.

use crate::support::{Point, assert_color, look, visibility};

/// A light at height 10, a clear thing under it, a floor.
fn under(objects: &str) -> String {
    format!("lights: [point: {{position: [0, 10, 0]}}]\nobjects:\n  - plane: {{}}\n{objects}")
}

fn ball(material: &str) -> String {
    under(&format!("  - sphere: {{center: [0, 5, 0], radius: 1, material: {{{material}}}}}"))
}

const NEAR_FLOOR: Point = [0.1, 0.3, 0.0];
const FLOOR: Point = [0.1, 0.0, 0.0];

#[test]
fn both_faces_of_a_clear_ball_dim_the_light() {
    assert_color(visibility(&ball("transparency: 0.7"), NEAR_FLOOR, FLOOR), [0.49; 3]);
    assert_color(visibility(&ball("transparency: 0.8, ior: 1.5"), NEAR_FLOOR, FLOOR), [0.64; 3]);
    let seen = look(&ball("transparency: 0.7"), [0.0, 0.3, 0.1], [0.0, 0.0, 0.0]);
    assert_color(seen.color, [0.8 * (0.2 + 0.8 * 0.49); 3]);
}

#[test]
fn colored_transparency_tints_the_shadow() {
    assert_color(visibility(&ball("transparency: [0.9, 0.5, 0]"), NEAR_FLOOR, FLOOR), [0.81, 0.25, 0.0]);
}

#[test]
fn the_color_of_the_surface_does_not() {
    assert_color(visibility(&ball("color: red, transparency: 0.5"), NEAR_FLOOR, FLOOR), [0.25; 3]);
}

#[test]
fn clear_planes_behind_each_other_all_count() {
    let panes: String =
        [2, 4, 6].map(|y| format!("  - plane: {{point: [0, {y}, 0], material: {{transparency: 0.5}}}}\n")).concat();
    assert_color(visibility(&under(&panes), NEAR_FLOOR, FLOOR), [0.125; 3]);
}

#[test]
fn every_clear_surface_on_the_way_counts() {
    let text = under(
        "  - sphere: {center: [0, 7, 0], radius: 1, material: {transparency: 0.5}}
  - box: {min: [-1, 3, -1], max: [1, 5, 1], material: {transparency: [1, 0.5, 0.1]}}
  - disc: {center: [0, 2, 0], radius: 1, material: {transparency: 0.8}}
  - cylinder: {base: [0, 0.5, 0], top: [0, 1, 0], open: true, material: {transparency: 0.1}}",
    );
    // The open cylinder is passed without touching it.
    assert_color(visibility(&text, NEAR_FLOOR, FLOOR), [0.2, 0.05, 0.002]);
}

#[test]
fn something_opaque_behind_something_clear_hides_the_light() {
    for height in [3.0, 7.0] {
        let text = ball("transparency: 0.7") + &format!("\n  - disc: {{center: [0, {height}, 0]}}");
        assert_color(visibility(&text, NEAR_FLOOR, FLOOR), [0.0; 3]);
    }
}

/// Straight under the light the way through the ball is 2 long; color^(2 / distance).
#[test]
fn glass_tints_its_shadow_by_the_length_of_the_way_through_it() {
    let tinted = |rest: &str| ball(&format!("{rest}attenuation: {{color: [0.5, 0.8, 1], distance: 4}}"));
    let left = [0.5_f64.sqrt(), 0.8_f64.sqrt(), 1.0];
    let (above, floor) = ([0.0, 0.3, 0.1], [0.0, 0.0, 0.0]);
    assert_color(visibility(&tinted("transparency: 1, "), above, floor), left);
    assert_color(visibility(&tinted("transparency: 1, ior: 1.5, "), above, floor), left);
    assert_color(visibility(&tinted("transparency: 0.5, "), above, floor), left.map(|c| 0.25 * c));
    // Off the axis: the light's ray through (x, 0, 0) passes the ball's middle at 5 sin a, tan a = x / 10.
    for x in [0.5_f64, 1.0, 1.9] {
        let sin = x / (100.0 + x * x).sqrt();
        let chord = 2.0 * (1.0 - 25.0 * sin * sin).sqrt();
        let left = [0.5_f64.powf(chord / 4.0), 0.8_f64.powf(chord / 4.0), 1.0];
        assert_color(visibility(&tinted("transparency: 1, "), [x, 0.3, 0.0], [x, 0.0, 0.0]), left);
    }
}

/// The top of the small ball is 2 below the face of the large one.
#[test]
fn what_lies_in_glass_is_lit_through_what_is_above_it() {
    let text = "
lights: [point: {position: [0, 10, 0]}]
objects:
  - sphere: {radius: 1}
  - sphere: {radius: 3, material: {transparency: 0.5, attenuation: {color: [0.25, 1, 1], distance: 4}}}
";
    let outside = look(text, [0.0, 8.0, 0.0], [0.0, 0.0, 0.0]);
    assert_color(outside.after(1).lights[0].visibility, [0.25, 0.5, 0.5]);
    let inside = look(text, [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]);
    assert_color(inside.ray.lights[0].visibility, [0.25, 0.5, 0.5]);
}

/// A half-space of water, as a plane: 3 deep at the bottom, and no end of it below.
#[test]
fn the_bottom_of_the_sea_is_lit_through_the_water_above() {
    let text = "
lights: [directional: {direction: [0, -1, 0]}]
objects:
  - plane: {material: {transparency: 1, ior: 1.33, attenuation: {color: [0.125, 0.5, 1], distance: 3}}}
  - disc: {center: [0, -3, 0], radius: 5}
";
    let seen = look(text, [0.0, 8.0, 0.0], [0.0, 0.0, 0.0]);
    assert_color(seen.after(1).lights[0].visibility, [0.125, 0.5, 1.0]);
    // Light from below comes through endless water: only what water does not take away is left.
    let text = text.replace("[0, -1, 0]}]", "[0, 1, 0]}]");
    let below = look(&text, [0.0, -8.0, 0.0], [0.0, 0.0, 0.0]);
    assert_color(below.ray.lights[0].visibility, [0.0, 0.0, 1.0]);
}

/// The point lies on the clear ball itself: no face of it is between the point and a light outside.
#[test]
fn a_clear_surface_does_not_dim_its_own_light_but_through_its_body() {
    let text = "lights: [point: {position: [0, 10, 0]}]\nobjects: [sphere: {material: {transparency: 0.7}}]";
    assert_color(visibility(text, [0.0, 5.0, 0.0], [0.0, 0.0, 0.0]), [1.0; 3]);
    // Its inside, seen through it, has one face before the light.
    let seen = look(text, [0.0, -5.0, 0.1], [0.0, 0.0, 0.1]);
    let inner = seen.after(1);
    assert!(inner.lights[0].cosine < 0.0, "the upper half, seen from within, is turned away from the light");
    let lower = look(text, [0.0, 5.0, 0.1], [0.0, 0.0, 0.1]);
    assert_color(lower.after(1).lights[0].visibility, [0.7; 3]);
}
