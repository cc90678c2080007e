//! Meshes: what they look like, part by part, and what is inside of them.

use crate::objects::{ball, cube, mesh, moved, part, square, with, with_material};
use crate::support::{Front, assert_color, assert_gray, assert_vector, difference, look_in, scene};
use durer::Element;
use durer::imaging::Image;
use durer::math::{DVec3, Rgb};
use durer::scene::{MaterialId, MeshData, Object, Scene, TransformStep};
use std::sync::Arc;

/// A tilted box in a room with a mirror and two lights, of the first material. The floor slopes, for rays may leave the box
/// just as they came, and must not go along it then.
fn room(material: &str, object: Object) -> Scene {
    let text = format!(
        "background: {{bottom: white, top: skyblue}}
lights: [point: {{position: [3, 4, 5]}}, directional: {{direction: [1, -3, -1], intensity: 0.4}}]
render: {{max_depth: 8}}
materials:
  box: {{{material}}}
objects:
  - plane: {{point: [0, -1.2, 0], normal: [0.1, 1, 0.05], material: {{color: {{checker: {{size: 0.3}}}}, reflection: 0.2}}}}
  - plane: {{point: [0, 0, -3], normal: [0, 0, 1], material: {{color: tomato}}}}"
    );
    let turn = TransformStep::Rotate { axis: DVec3::new(1.0, 2.0, 0.5), degrees: 40.0 };
    with(scene(&text), [moved(with_material(object, 0), vec![turn])])
}

fn view(scene: Scene) -> Image {
    Front::of(scene, 64, 3.0).image
}

/// How many pixels differ by more than rounding.
fn differing(a: &Image, b: &Image) -> usize {
    a.pixels.iter().zip(&b.pixels).filter(|(a, b)| difference(**a, **b) > 1e-5).count()
}

fn box_shape() -> Object {
    let [exact, _, _] = scene("objects: [box: {min: [-0.5, -0.75, -0.5], max: [0.5, 0.25, 1]}, plane, plane]")
        .objects
        .try_into()
        .expect("three objects");
    exact
}

fn box_mesh() -> MeshData {
    cube([-0.5, -0.75, -0.5], [0.5, 0.25, 1.0])
}

#[test]
fn a_box_of_triangles_is_a_box() {
    for material in [
        "color: gold, specular: 0.5",
        "color: gold, reflection: 0.6",
        "color: gold, transparency: [0.7, 0.9, 0.4]",
        "color: {stripes: {width: 0.2, colors: [red, white]}}",
    ] {
        let (exact, triangles) = (view(room(material, box_shape())), view(room(material, mesh(box_mesh()))));
        assert_eq!(differing(&exact, &triangles), 0, "{material}");
    }
}

/// Inside of glass, rays that meet an edge to the last bits may leave by either face.
#[test]
fn a_glass_box_of_triangles_is_a_glass_box() {
    for material in [
        "transparency: 0.9, ior: 1.5, fresnel: true",
        "transparency: 1, attenuation: {color: [0.3, 0.8, 0.9], distance: 0.5}",
        "transparency: 0.9, ior: 1.3, attenuation: {color: [0.3, 0.8, 0.9], distance: 0.5}",
    ] {
        let (exact, triangles) = (view(room(material, box_shape())), view(room(material, mesh(box_mesh()))));
        assert!(differing(&exact, &triangles) <= 1, "{material}: {}", differing(&exact, &triangles));
    }
}

#[test]
fn the_eye_may_be_inside_of_a_glass_mesh() {
    let glass = "background: 1\nlights: []\nmaterials: {m: {transparency: 1, attenuation: {color: 0.5, distance: 1}}}";
    let scene = with(scene(glass), [with_material(mesh(cube([-1.0; 3], [1.0; 3])), 0)]);
    assert_gray(look_in(scene.clone(), [0.1, 0.2, 0.5], [0.1, 0.2, 0.0]).color, 0.5_f64.powf(1.5));
    assert_gray(look_in(scene, [0.1, 0.2, 3.0], [0.1, 0.2, 0.0]).color, 0.25);
}

/// Without its lid a box encloses nothing: light goes straight through, and nothing of it is lost.
#[test]
fn an_open_mesh_is_no_medium() {
    let glass = "background: 1
lights: []
materials: {m: {transparency: 1, ior: 1.5, attenuation: {color: 0.5, distance: 1}}}";
    let mut open = cube([-1.0; 3], [1.0; 3]);
    open.triangles.pop();
    let scene = with(scene(glass), [with_material(mesh(open), 0)]);
    let seen = look_in(scene, [0.3, -2.0, 3.0], [0.1, 0.2, 0.0]);
    assert_gray(seen.color, 1.0);
    assert_eq!(seen.after(2).direction, seen.ray.direction);
}

/// A hundred panes in one mesh: light loses at every one of them.
#[test]
fn light_counts_all_surfaces_of_a_mesh() {
    let mut panes = MeshData::default();
    for pane in 0..100 {
        let first = panes.positions.len() as u32;
        let square = square();
        panes.positions.extend(square.positions.iter().map(|&[x, y, _]| [x, y, pane as f32 * 0.01]));
        panes.triangles.extend(square.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    let text = "lights: [directional: {direction: [0, 0, -1]}]
materials: {m: {transparency: 0.99}}
objects: [plane: {point: [0, 0, -1], normal: [0, 0, 1]}]";
    let scene = with(scene(text), [with_material(mesh(panes), 0)]);
    let seen = look_in(scene, [5.0, 0.3, 1.0], [0.2, 0.3, -1.0]);
    assert!((f64::from(seen.ray.lights[0].visibility.r) - 0.99_f64.powi(100)).abs() < 1e-5);
}

const PARTS: &str = "
lights: []
background: 0
materials:
  red: {color: [1, 0, 0], ambient: 1}
  green: {color: [0, 1, 0], ambient: 1}
  blue: {color: [0, 0, 1], ambient: 1}
";
const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREEN: [f64; 3] = [0.0, 1.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];

/// The lower right triangle is part 0, the upper left one part 1.
#[test]
fn parts_have_materials_that_the_object_overrides_and_that_override_the_group() {
    let seen = |parts: &[Option<u32>], object: Option<u32>, group: Option<u32>| {
        let parts = (0..).zip(parts).map(|(first, &material)| part(first, 1, material)).collect();
        let object = Object { material: object.map(MaterialId), ..mesh(MeshData { parts, ..square() }) };
        let group = Object { material: group.map(MaterialId), ..crate::objects::group(vec![object]) };
        let scene = with(scene(PARTS), [group]);
        [[0.5, -0.5], [-0.5, 0.5]].map(|[x, y]| {
            let seen = look_in(scene.clone(), [x, y, 3.0], [x, y, 0.0]);
            (seen.color, seen.hit().material)
        })
    };
    let expect = |found: [(Rgb, Option<MaterialId>); 2], expected: [([f64; 3], Option<u32>); 2]| {
        for ((color, material), (wanted, id)) in found.into_iter().zip(expected) {
            assert_color(color, wanted);
            assert_eq!(material, id.map(MaterialId));
        }
    };
    let default = ([0.8 * 0.2; 3], None);
    expect(seen(&[Some(0), Some(1)], None, Some(2)), [(RED, Some(0)), (GREEN, Some(1))]);
    expect(seen(&[Some(0), Some(1)], Some(2), Some(1)), [(BLUE, Some(2)); 2]);
    expect(seen(&[Some(0), None], None, Some(2)), [(RED, Some(0)), (BLUE, Some(2))]);
    expect(seen(&[Some(0)], None, None), [(RED, Some(0)), default]);
    expect(seen(&[], None, None), [default; 2]);
}

/// A clear half and an opaque half: each stops as much light as it stops.
#[test]
fn parts_of_different_materials_throw_different_shadows() {
    let text = "lights: [directional: {direction: [0, 0, -1]}]
materials: {clear: {transparency: [0.5, 0.25, 1]}, opaque: {}}
objects: [plane: {point: [0, 0, -1], normal: [0, 0, 1]}]";
    let parts = vec![part(0, 1, Some(0)), part(1, 1, Some(1))];
    let scene = with(scene(text), [mesh(MeshData { parts, ..square() })]);
    for (x, expected) in [(0.5, [0.5, 0.25, 1.0]), (-0.5, [0.0; 3]), (1.5, [1.0; 3])] {
        let seen = look_in(scene.clone(), [x + 3.0, -x, 0.0], [x, -x, -1.0]);
        assert_color(seen.ray.lights[0].visibility, expected);
    }
}

/// A bottle with a label: its sides are glass, its bottom is opaque, and light is taken away inside of it.
#[test]
fn a_closed_mesh_is_filled_with_what_fills_its_clear_parts() {
    let text = "background: 1
lights: []
materials:
  label: {color: 0}
  glass: {transparency: 1, attenuation: {color: 0.5, distance: 1}}";
    let parts = vec![part(0, 8, Some(1)), part(8, 2, Some(0)), part(10, 2, Some(1))];
    let scene = with(scene(text), [mesh(MeshData { parts, ..cube([-1.0; 3], [1.0; 3]) })]);
    assert_gray(look_in(scene.clone(), [0.1, 3.0, 0.2], [0.1, 0.0, 0.2]).color, 0.25);
    // The face at z = -1 is the label.
    assert_gray(look_in(scene, [0.1, 0.2, 3.0], [0.1, 0.2, 0.0]).color, 0.0);
}

/// At weights a, b, c the colour is a·red + b·green + c·blue.
#[test]
fn colors_of_vertices_are_interpolated() {
    let rgb = |color: [f64; 3]| Rgb::from(color.map(|c| c as f32));
    let data = MeshData {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        colors: vec![rgb(RED), rgb(GREEN), rgb(BLUE)],
        ..MeshData::default()
    };
    let seen = |paint: &str, x: f64, y: f64| {
        let text = format!("lights: []\nmaterials: {{m: {{color: {paint}, ambient: 1}}}}");
        let turn = TransformStep::Rotate { axis: DVec3::Z, degrees: 90.0 };
        let object = moved(with_material(mesh(data.clone()), 0), vec![turn]);
        look_in(with(scene(&text), [object]), [-y, x, 2.0], [-y, x, 0.0])
    };
    for (x, y) in [(0.2, 0.3), (0.01, 0.98), (0.6, 0.1)] {
        let weights = [1.0 - x - y, x, y];
        assert_color(seen("gold", x, y).color, weights);
        let striped = "{stripes: {colors: [[0.5, 1, 0.25], [0.5, 1, 0.25]]}}";
        assert_color(seen(striped, x, y).color, [0.5 * weights[0], weights[1], 0.25 * weights[2]]);
        let Element::Triangle { index: 0, weights: found } = seen("gold", x, y).hit().element else {
            panic!("triangle")
        };
        assert_vector(DVec3::from(found), weights);
    }
}

/// One mesh, shown thrice, far away and near: the origin that positions are relative to is in double precision.
#[test]
fn meshes_far_away_are_as_exact_as_near() {
    let text = "lights: []\nmaterials: {m: {color: {checker: {size: 0.25}}, ambient: 1}}";
    let data = Arc::new(MeshData { origin: DVec3::new(1e9, 0.0, 0.0), ..square() });
    let object = with_material(crate::objects::shared_mesh(&data), 0);
    let back = moved(object.clone(), vec![TransformStep::Translate(DVec3::new(-1e9, 0.0, 0.0))]);
    let far = look_in(with(scene(text), [object]), [1e9 + 0.3, 0.1, 3.0], [1e9 + 0.3, 0.1, 0.0]);
    let near = look_in(with(scene(text), [back]), [0.3, 0.1, 3.0], [0.3, 0.1, 0.0]);
    assert!((far.hit().point.x - 1e9 - 0.3).abs() < 1e-6);
    assert_eq!(far.color, near.color);
}

#[test]
fn a_mesh_without_triangles_is_not_there() {
    let scene = with(scene("background: 0.25\nlights: []"), [mesh(MeshData::default()), mesh(ball(4))]);
    let seen = look_in(scene, [0.0, 0.0, 3.0], [0.01, 0.02, 0.0]);
    assert_eq!(seen.hit().shape, 0, "the second mesh is the first shape");
}
