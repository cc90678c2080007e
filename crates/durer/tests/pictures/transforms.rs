//! Moved, turned, stretched and mirrored things, against formulas and against each other.

use crate::support::{Front, assert_gray, difference, greatest_difference, scene};

fn glowing(objects: &str) -> durer::Scene {
    scene(&format!("background: 0\nlights: []\nobjects:\n{objects}"))
}

/// Every pixel: inside of ((x', y') / (2, 0.5))² = 1, with (x', y') turned back by 30°.
#[test]
fn a_stretched_and_turned_ball_covers_its_ellipse() {
    let scene = glowing(
        "  - sphere:
      material: {color: 1, ambient: 1}
      transform: [scale: [2, 0.5, 1], rotate: {z: 30}, translate: [0.3, -0.2, 5]]",
    );
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    for (x, y, color) in Front::of(scene, 120, 5.0).points() {
        let (u, v) = (x - 0.3, y + 0.2);
        let (a, b) = ((u * cos + v * sin) / 2.0, (v * cos - u * sin) / 0.5);
        assert_gray(color, if a * a + b * b < 1.0 { 1.0 } else { 0.0 });
    }
}

/// A sheared ball: |M⁻¹p| = 1 seen along z is an ellipse of the quadratic form (M Mᵀ)⁻¹ of x and y.
#[test]
fn a_sheared_ball_covers_its_ellipse() {
    let scene = glowing(
        "  - sphere:
      material: {color: 1, ambient: 1}
      transform: [matrix: [[1, 0.8, 0.3, 0], [0, 0.6, 0.5, 0], [0.2, 0, 1, 0]]]",
    );
    // The upper left of M Mᵀ, inverted by hand.
    let (xx, xy, yy) = (1.0 + 0.64 + 0.09, 0.8 * 0.6 + 0.3 * 0.5, 0.36 + 0.25);
    let determinant = xx * yy - xy * xy;
    for (x, y, color) in Front::of(scene, 120, 4.0).points() {
        let form = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
        assert_gray(color, if form < 1.0 { 1.0 } else { 0.0 });
    }
}

/// Normals of stretched things: the ellipsoid x²/4 + y²·4 + z² = 1 has the normal (x/4, 4y, z).
#[test]
fn a_stretched_ball_is_lit_by_its_own_normals() {
    let text = "
background: 0
lights: [directional: {direction: [-1, -2, -2]}]
objects: [sphere: {material: {color: 1}, transform: [scale: [2, 0.5, 1]]}]
";
    for (x, y, color) in Front::of(scene(text), 60, 4.0).points() {
        let z2 = 1.0 - x * x / 4.0 - 4.0 * y * y;
        if z2 > 0.0 {
            let normal = [x / 4.0, 4.0 * y, z2.sqrt()];
            let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let cosine = (normal[0] + 2.0 * normal[1] + 2.0 * normal[2]) / 3.0 / length;
            assert_gray(color, 0.2 + 0.8 * cosine.max(0.0));
        }
    }
}

/// Things of every kind, none of them symmetric, with things of their own to show.
const STILL_LIFE: &str = "
    - sphere: {center: [0.3, 0.2, 0.5], radius: 0.5, material: {color: tomato, specular: 0.6}}
    - box: {min: [-1, -0.8, -0.5], max: [-0.2, 0, 0.4], material: {color: {checker: {size: 0.3}}}}
    - cylinder: {base: [0.5, -0.9, 0], top: [0.9, -0.1, 0.3], radius: 0.3, material: {color: gold, reflection: 0.3}}
    - cone: {base: [-0.6, 0.1, 0], top: [-0.4, 1, 0.2], radius: 0.4, top_radius: 0.1, material: {color: navy}}
    - torus: {center: [0.6, 0.8, 0], axis: [0.3, 1, 1], radius: 0.3, tube_radius: 0.1, material: {color: green}}
    - triangle: {vertices: [[-1, 1, -1], [1, -1, -1], [1, 1.2, -1]], material: {color: teal}}
    - disc: {center: [0, -0.5, 1], normal: [0.2, 0.4, 1], radius: 0.3, inner_radius: 0.1, material: {color: pink}}
    - rectangle: {corner: [-1.2, 0.2, 0.5], edges: [[0.3, 0.1, 0], [0, 0.5, 0.2]], material: {color: brown}}
    - plane: {point: [0, -1, 0], normal: [0.1, 1, 0.1], material: {color: silver}}
";

fn still_life(before: &str, light: &str) -> durer::imaging::Image {
    let text = format!(
        "background: [0.1, 0.2, 0.3]
lights: [directional: {{direction: {light}}}]
objects:
- group:
    {before}
    objects:{STILL_LIFE}"
    );
    Front::of(scene(&text), 64, 2.6).image
}

#[test]
fn nested_groups_multiply() {
    let nested = "transform: [rotate: {z: 20}, translate: [0.1, 0.2, 0]]
    objects:
    - group:
        transform: [scale: [1.2, 0.8, 1], rotate: {y: 30}]
        objects:
        - group:
            transform: [translate: [0.2, 0, 0.1], rotate: {axis: [1, 1, 0], angle: 40}]
            objects:";
    let indented = STILL_LIFE.replace("\n    ", "\n            ");
    let text = format!(
        "background: [0.1, 0.2, 0.3]\nlights: [directional: {{direction: [-1, -1, -2]}}]\nobjects:\n- group:\n    {nested}{indented}"
    );
    let nested = Front::of(scene(&text), 64, 2.6).image;
    let in_one = "transform: [translate: [0.2, 0, 0.1], rotate: {axis: [1, 1, 0], angle: 40},
      scale: [1.2, 0.8, 1], rotate: {y: 30}, rotate: {z: 20}, translate: [0.1, 0.2, 0]]";
    assert!(greatest_difference(&nested, &still_life(in_one, "[-1, -1, -2]")) < 1e-5);
    let other_order = in_one.replace("rotate: {y: 30}, rotate: {z: 20}", "rotate: {z: 20}, rotate: {y: 30}");
    assert!(greatest_difference(&nested, &still_life(&other_order, "[-1, -1, -2]")) > 0.1);
}

#[test]
fn negative_scale_is_a_mirror_image() {
    for (mirrored, light) in
        [("[-1, 1, 1]", "[1, -1, -2]"), ("[1, -1, 1]", "[-1, 1, -2]"), ("[-1, -1, 1]", "[1, 1, -2]")]
    {
        let image = still_life(&format!("transform: [scale: {mirrored}]"), light);
        let original = still_life("transform: []", "[-1, -1, -2]");
        let last = image.width - 1;
        for y in 0..image.height {
            for x in 0..image.width {
                let from = (
                    if mirrored.starts_with("[-1") { last - x } else { x },
                    if mirrored.contains(" -1") { last - y } else { y },
                );
                let (found, expected) = (image.pixel(x, y), original.pixel(from.0, from.1));
                assert!(difference(found, expected) < 1e-5, "{mirrored} ({x}, {y}): {found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn a_group_gives_its_material_to_those_that_have_none() {
    let scene = glowing(
        "  - group:
      material: {color: 0.5, ambient: 1}
      objects:
        - rectangle: {corner: [-1, -1, 0], edges: [[1, 0, 0], [0, 2, 0]]}
        - rectangle: {corner: [0, -1, 0], edges: [[1, 0, 0], [0, 2, 0]], material: {color: 0.25, ambient: 1}}",
    );
    for (x, _, color) in Front::of(scene, 10, 2.0).points() {
        assert_gray(color, if x < 0.0 { 0.5 } else { 0.25 });
    }
}
