//! Surfaces that are there in part: what is not there lets light pass as if it were empty space.

use crate::objects::{mesh, square, with, with_material};
use crate::support::{Front, assert_color, assert_gray, look, look_in, scene, visibility};
use durer::math::Rgb;
use durer::scene::{Antialias, MeshData, Scene};
use durer::{NotTraced, RayKind};

fn sheet(opacity: &str) -> String {
    format!(
        "background: [0.1, 0.5, 1]
lights: []
objects:
  - rectangle:
      corner: [-1, -1, 0]
      edges: [[2, 0, 0], [0, 2, 0]]
      material: {{color: [0.9, 0.4, 0.2], ambient: 1, {opacity}}}"
    )
}

#[test]
fn three_tenths_of_a_surface_leave_seven_of_what_is_behind() {
    let seen = look(&sheet("opacity: 0.3"), [0.2, 0.1, 5.0], [0.2, 0.1, 0.0]);
    let blend = |own: f64, behind: f64| 0.3 * own + 0.7 * behind;
    assert_color(seen.color, [blend(0.9, 0.1), blend(0.4, 0.5), blend(0.2, 1.0)]);
    let [behind] = seen.ray.children.as_slice() else { panic!("one ray goes on") };
    assert_eq!((behind.kind, behind.direction), (RayKind::Transmitted, seen.ray.direction));
    assert_eq!(seen.hit().opacity, Rgb::gray(0.3));
    // Opacity may be a color.
    let seen = look(&sheet("opacity: [1, 0.5, 0]"), [0.2, 0.1, 5.0], [0.2, 0.1, 0.0]);
    assert_color(seen.color, [0.9, 0.45, 1.0]);
}

/// 0.3 of a mirror, of glass, of a lamp.
#[test]
fn all_that_a_surface_does_is_weighed() {
    let from = ([0.2, 0.1, 5.0], [0.2, 0.1, 0.0]);
    let mirror = look(&sheet("opacity: 0.3, reflection: 0.5"), from.0, from.1);
    assert_color(mirror.color, [0.3 * (0.9 + 0.05) + 0.07, 0.3 * (0.4 + 0.25) + 0.35, 0.3 * (0.2 + 0.5) + 0.7]);
    let lamp = look(&sheet("opacity: 0.3, emission: 2"), from.0, from.1);
    assert_color(lamp.color, [0.3 * 2.9 + 0.07, 0.3 * 2.4 + 0.35, 0.3 * 2.2 + 0.7]);
    let pane = look(&sheet("opacity: 0.3, transparency: 0.5"), from.0, from.1);
    assert_color(pane.color, [0.3 * 0.5 + 0.07, 0.3 * 0.45 + 0.35, 0.3 * 0.6 + 0.7]);
}

/// Light that passes beside a surface is not bent and loses nothing to what the surface encloses.
#[test]
fn what_is_not_there_bounds_no_medium() {
    let ball = |opacity: &str| {
        let text = format!(
            "background: 1
lights: []
objects: [sphere: {{material: {{transparency: 1, ior: 1.5, attenuation: {{color: 0.5, distance: 1}}, {opacity}}}}}]"
        );
        look(&text, [0.5, 0.0, 5.0], [0.5, 0.0, 0.0])
    };
    let whole = f64::from(ball("ambient: 0").color.r);
    let empty = ball("opacity: 0");
    assert_gray(empty.color, 1.0);
    assert_eq!((empty.ray.holes.len(), empty.ray.children.len()), (2, 0));
    // In by the surface and out by it; in by it and out beside it; in beside it and out by it or beside it.
    let half = ball("opacity: 0.5");
    let chord = 2.0 * (1.0 - (0.5_f64 / 1.5).powi(2)).sqrt();
    assert_gray(half.color, 0.25 * whole + 0.25 * 0.5_f64.powf(chord) + 0.5);
    assert!((whole - 0.5_f64.powf(chord)).abs() < 1e-6);
}

#[test]
fn a_surface_that_is_whole_by_its_opacity_is_as_without() {
    let plain = sheet("specular: 0.5, reflection: 0.3").replace("lights: []", "lights: [point: {position: [1, 2, 3]}]");
    let whole = |opacity: &str| Front::of(scene(&plain.replace("ambient: 1", opacity)), 32, 3.0).image;
    assert!(whole("ambient: 1, opacity: 1") == whole("ambient: 1"));
    assert!(whole("ambient: 1, opacity: {checker: {colors: [1, 1]}}") == whole("ambient: 1"));
}

/// Squares of 0.5, the first of which is there, the next not. The light comes from the right at atan 0.3.
const GRID: &str = "
background: 0
lights: [directional: {direction: [-0.3, 0, -1]}]
objects:
  - plane: {normal: [0, 0, 1], material: {color: 1, ambient: 0, diffuse: 1}}
  - rectangle:
      corner: [-2, -2, 1]
      edges: [[4, 0, 0], [0, 4, 0]]
      material: {color: [1, 0, 0], ambient: 0, diffuse: 1, opacity: {checker: {size: 0.5, colors: [1, 0]}}}
";

#[test]
fn holes_have_sharp_edges_and_so_have_their_shadows() {
    let there = |x: f64, y: f64| ((x / 0.5).floor() + (y / 0.5).floor()).rem_euclid(2.0) == 0.0;
    let cosine = 1.0 / 1.09_f64.sqrt();
    // 1.0 / 0.5 is even, so z does not matter.
    for (x, y, color) in Front::of(scene(GRID), 100, 3.0).points() {
        let expected = match (there(x, y), there(x + 0.3, y)) {
            (true, _) => [cosine, 0.0, 0.0],
            (false, true) => [0.0; 3],
            (false, false) => [cosine; 3],
        };
        assert_color(color, expected);
    }
}

#[test]
fn shadows_are_as_dark_as_what_throws_them_is_there() {
    let under = |thing: &str| {
        let text = format!("lights: [point: {{position: [0, 10, 0]}}]\nobjects:\n  - plane: {{}}\n  - {thing}");
        visibility(&text, [0.1, 0.3, 0.0], [0.1, 0.0, 0.0])
    };
    assert_gray(under("disc: {center: [0, 5, 0], material: {opacity: 0.3}}"), 0.7);
    assert_gray(under("sphere: {center: [0, 5, 0], radius: 1, material: {opacity: 0.3}}"), 0.49);
    assert_color(under("disc: {center: [0, 5, 0], material: {opacity: [1, 0.5, 0]}}"), [0.0, 0.5, 1.0]);
    assert_gray(under("disc: {center: [0, 5, 0], material: {opacity: 0.5, transparency: 0.5}}"), 0.75);
    let textured = "{gradient: {colors: [0, 0.8], axis: [1, 0, 0], length: 0.2}}";
    // The light goes through the disc at x = 0.05, a quarter of the way.
    assert_gray(under(&format!("disc: {{center: [0, 5, 0], material: {{opacity: {textured}}}}}")), 0.8);
    // Far sides and near sides of a ball, each by its own place.
    let ball = format!("sphere: {{center: [0, 5, 0], radius: 1, material: {{opacity: {textured}}}}}");
    let [near, far] = [0.06_f64, 0.04].map(|x| 1.0 - 0.8 * x / 0.2);
    assert!((f64::from(under(&ball).r) - near * far).abs() < 1e-3);
}

/// Half of the ball is there: its lower half in the first text, its upper half in the second. Seen from below, light enters
/// the medium by the surface and leaves it by a hole, or goes in by a hole and is in no medium.
#[test]
fn media_are_left_through_holes_but_not_entered() {
    let text = "
lights: [directional: {direction: [0, -1, 0]}]
objects:
  - plane: {}
  - sphere:
      center: [0, 5, 0]
      material:
        transparency: 1
        attenuation: {color: 0.5, distance: 1}
        opacity: {stripes: {axis: [0, 1, 0], width: 5, colors: [1, 0]}}
";
    assert_gray(visibility(text, [0.1, 0.3, 0.0], [0.0, 0.0, 0.0]), 0.25);
    let upside_down = text.replace("colors: [1, 0]", "colors: [0, 1]");
    assert_gray(visibility(&upside_down, [0.1, 0.3, 0.0], [0.0, 0.0, 0.0]), 1.0);
    // And so it is for the eye, with the sky for a background.
    for (text, expected) in [(text, 0.25), (&upside_down, 1.0)] {
        let text = text.replace("- plane: {}", "- plane: {point: [0, -1, 0]}");
        let seen = look(&format!("background: 1{text}"), [0.0, 2.0, 0.0], [0.0, 5.0, 0.0]);
        assert_gray(seen.color, expected);
    }
}

/// Fifty sheets with holes, one behind the other, and a depth of 1.
fn leaves(opacity: &str) -> Scene {
    let mut leaves = MeshData::default();
    for leaf in 0..50 {
        let (square, first) = (square(), leaves.positions.len() as u32);
        leaves.positions.extend(square.positions.iter().map(|&[x, y, _]| [x, y, leaf as f32 * 0.01]));
        leaves.triangles.extend(square.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    }
    let text = format!(
        "render: {{max_depth: 1}}\nbackground: 0.25\nlights: []\nfog: {{exponential: {{color: 0, distance: 4}}}}
materials: {{leaf: {{color: 1, ambient: 1, opacity: {opacity}}}}}
objects: [plane: {{point: [0, 0, -1], normal: [0, 0, 1], material: {{color: 1, ambient: 1}}}}]"
    );
    with(scene(&text), [with_material(mesh(leaves), 0)])
}

#[test]
fn holes_cost_no_depth_and_interrupt_no_fog() {
    let seen = look_in(leaves("{checker: {size: 0.5, colors: [1, 0]}}"), [0.7, 0.1, 3.0], [0.7, 0.1, 0.0]);
    assert_gray(seen.color, (-1.0_f64).exp());
    assert_eq!((seen.ray.holes.len(), seen.hit().shape), (50, 0));
    assert!((seen.hit().distance - 4.0).abs() < 1e-9);
    assert!((seen.ray.holes[0].distance - 2.51).abs() < 1e-6);
    let seen = look_in(leaves("0.5"), [0.7, 0.1, 3.0], [0.7, 0.1, 0.0]);
    assert_eq!(seen.ray.not_traced, [(RayKind::Transmitted, seen.ray.not_traced[0].1, NotTraced::TooDeep)]);
}

#[test]
fn nothing_is_left_of_what_is_all_hole() {
    let text = "lights: [point: {position: [3, 4, 5]}]\nobjects:\n  - plane: {point: [0, -1, 0]}\n";
    let ball = |opacity: &str| Front::of(scene(&format!("{text}{opacity}")), 32, 3.0).image;
    assert!(ball("  - sphere: {material: {reflection: 0.5, opacity: 0}}") == ball(""));
}

#[test]
fn every_sample_has_its_own_holes() {
    let mut scene = scene(GRID);
    scene.render.antialias = Antialias::Grid { n: 4 };
    let compiled = crate::support::compile(scene);
    let pixel = durer::explain(&compiled, 320, 240).expect("a pixel");
    assert_eq!(pixel.sum(), pixel.color);
}
