//! Clear things that light goes through in a straight line: each surface blends its own shade with what is behind.

use crate::support::{Front, assert_color, assert_gray, look, scene};
use durer::{NotTraced, RayKind};

/// Things in these scenes glow in their own colour: all of the ambient light, nothing of other lights.
const OWN: [f64; 3] = [0.9, 0.4, 0.2];
const BEHIND: [f64; 3] = [0.1, 0.5, 1.0];

fn blend(t: [f64; 3], own: [f64; 3], behind: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (1.0 - t[i]) * own[i] + t[i] * behind[i])
}

fn ball(transparency: &str) -> String {
    format!(
        "background: [0.1, 0.5, 1]
lights: []
objects:
  - sphere: {{radius: 1, material: {{color: [0.9, 0.4, 0.2], ambient: 1, transparency: {transparency}}}}}"
    )
}

#[test]
fn both_faces_of_a_clear_ball_blend_three_tenths_of_their_own_with_seven_of_what_is_behind() {
    let once = blend([0.7; 3], OWN, BEHIND);
    let twice = blend([0.7; 3], OWN, once);
    let view = Front::of(scene(&ball("0.7")), 40, 2.5);
    for (x, y, color) in view.points() {
        assert_color(color, if x * x + y * y < 1.0 { twice } else { BEHIND });
    }
}

#[test]
fn transparency_may_be_a_color() {
    let t = [0.9, 0.5, 0.0];
    let expected = blend(t, OWN, blend(t, OWN, BEHIND));
    assert_color(look(&ball("[0.9, 0.5, 0]"), [0.3, 0.2, 5.0], [0.3, 0.2, 0.0]).color, expected);
}

#[test]
fn a_wholly_clear_ball_is_not_to_be_seen() {
    assert_color(look(&ball("1"), [0.3, 0.2, 5.0], [0.3, 0.2, 0.0]).color, BEHIND);
}

#[test]
fn nested_clear_balls_blend_from_the_innermost_out() {
    let text = "
background: [0.1, 0.5, 1]
lights: []
objects:
  - sphere: {radius: 1, material: {color: [0.9, 0.4, 0.2], ambient: 1, transparency: 0.25}}
  - sphere: {radius: 2, material: {color: [0.2, 0.6, 0.4], ambient: 1, transparency: 0.5}}
";
    let outer = |behind| blend([0.5; 3], [0.2, 0.6, 0.4], behind);
    let inner = |behind| blend([0.25; 3], OWN, behind);
    assert_color(look(text, [0.5, 0.0, 5.0], [0.5, 0.0, 0.0]).color, outer(inner(inner(outer(BEHIND)))));
    assert_color(look(text, [1.5, 0.0, 5.0], [1.5, 0.0, 0.0]).color, outer(outer(BEHIND)));
    // From between the two, and from the middle.
    assert_color(look(text, [0.0, 0.0, 1.5], [0.0, 0.0, 0.0]).color, inner(inner(outer(BEHIND))));
    assert_color(look(text, [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]).color, inner(outer(BEHIND)));
}

#[test]
fn without_an_index_of_refraction_the_ray_goes_straight_on() {
    let seen = look(&ball("0.7"), [0.6, -0.3, 5.0], [0.6, -0.3, 0.0]);
    let (inside, behind) = (seen.after(1), seen.after(2));
    assert_eq!([inside.kind, behind.kind], [RayKind::Transmitted; 2]);
    assert_eq!([inside.direction, behind.direction], [seen.ray.direction; 2], "not even rounded");
    assert!(behind.hit.is_none());
}

#[test]
fn what_is_behind_the_last_ray_of_the_chain_counts_as_black() {
    let face = |behind| blend([0.7; 3], OWN, behind);
    let black = [0.0; 3];
    for (max_depth, expected) in [(1, face(black)), (2, face(face(black))), (3, face(face(BEHIND)))] {
        let text = format!("render: {{max_depth: {max_depth}}}\n{}", ball("0.7"));
        let seen = look(&text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]);
        assert_color(seen.color, expected);
        let last = seen.after(max_depth - 1);
        assert_eq!(last.not_traced.first().map(|(_, _, why)| *why), (max_depth < 3).then_some(NotTraced::TooDeep));
    }
}

/// A pane has one surface, not two.
#[test]
fn a_clear_pane_blends_once() {
    let text = "
background: 1
lights: []
objects: [rectangle: {corner: [-1, -1, 0], edges: [[2, 0, 0], [0, 2, 0]], material: {color: 0, transparency: 0.7}}]
";
    assert_gray(look(text, [0.2, 0.1, 5.0], [0.2, 0.1, 0.0]).color, 0.7);
    assert_gray(look(text, [0.2, 0.1, -5.0], [0.2, 0.1, 0.0]).color, 0.7);
}
