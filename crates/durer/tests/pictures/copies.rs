//! Instances: copies of objects, each the same to the bit as the object in its place.

use crate::objects::{ball, copies, group, instances, mesh, moved, with, with_material};
use crate::support::{Front, Numbers, assert_color, look_in, scene};
use durer::math::DVec3;
use durer::scene::{Data, Instances, MaterialId, Object, Scene, Sizes, TransformStep};

const ROOM: &str = "
lights: [point: {position: [3, 4, 5]}]
render: {max_depth: 6}
materials:
  striped: {color: {stripes: {width: 0.2, axis: [1, 1, 0]}}, specular: 0.5}
  glass: {transparency: 0.9, ior: 1.5}
  red: {color: [1, 0, 0], ambient: 1, diffuse: 0}
  green: {color: [0, 1, 0], ambient: 1, diffuse: 0}
  blue: {color: [0, 0, 1], ambient: 1, diffuse: 0}
objects: [plane: {point: [0, 0, -4], normal: [0, 0, 1]}]
";

fn numbers(seed: u64, count: usize, reach: f64) -> Vec<DVec3> {
    let mut numbers = Numbers(seed);
    let mut next = || numbers.signed() * reach;
    (0..count).map(|_| DVec3::new(next(), next(), next())).collect()
}

/// Some different things, themselves turned and scaled.
fn things() -> Vec<Object> {
    let shapes = scene("objects: [box: {min: [-1, -1, -1]}, torus: {}, sphere: {center: [1.5, 0, 0], radius: 0.5}]");
    let turn = |object| {
        let step = TransformStep::Rotate { axis: DVec3::new(1.0, 2.0, 3.0), degrees: 25.0 };
        moved(object, vec![step, TransformStep::Scale(DVec3::new(0.3, 0.2, 0.4))])
    };
    let mut all: Vec<Object> = shapes.objects.into_iter().chain([mesh(ball(8))]).map(turn).collect();
    all[0] = with_material(all[0].clone(), 0);
    all[2] = with_material(all[2].clone(), 1);
    all
}

/// What instances say, said with groups and their transforms.
fn written_out(instances: &Instances) -> Vec<Object> {
    let copy = |index: usize| {
        let about = |axis, degrees| TransformStep::Rotate { axis, degrees };
        let mut steps = vec![TransformStep::Scale(DVec3::splat(instances.scales.get(index)))];
        if let Some(Data { values, .. }) = &instances.rotations {
            let turn = values[index];
            steps.extend([about(DVec3::X, turn.x), about(DVec3::Y, turn.y), about(DVec3::Z, turn.z)]);
        }
        steps.push(TransformStep::Translate(instances.positions.values[index]));
        moved(group(instances.objects.clone()), steps)
    };
    (0..instances.positions.values.len()).map(copy).collect()
}

fn assert_same(a: Scene, b: Scene) {
    let [a, b] = [a, b].map(|scene| Front::of(scene, 64, 4.0).image);
    assert!(a == b, "to the last bit");
}

#[test]
fn copies_are_their_objects_in_their_places() {
    for (rotations, scales) in [
        (None, Sizes::Same(1.0)),
        (Some(numbers(5, 20, 300.0)), Sizes::Same(0.7)),
        (
            Some(numbers(6, 20, 90.0)),
            Sizes::Each(Data::inline((1..=20).map(|i| f64::from(i) * 0.1).collect::<Vec<_>>())),
        ),
    ] {
        let rotations = rotations.map(Data::inline);
        let all = Instances { rotations, scales, ..copies(things(), numbers(3, 20, 2.0)) };
        let written = written_out(&all);
        assert_same(with(scene(ROOM), [instances(all)]), with(scene(ROOM), written));
    }
}

#[test]
fn copies_of_copies_are_copies() {
    let inner = copies(things(), numbers(8, 3, 0.6));
    let steps = vec![TransformStep::Rotate { axis: DVec3::Y, degrees: 30.0 }, TransformStep::Scale(DVec3::splat(0.5))];
    let outer = |inner: Vec<Object>| {
        let inner = moved(group(inner), steps.clone());
        Instances { rotations: Some(Data::inline(numbers(9, 7, 90.0))), ..copies(vec![inner], numbers(10, 7, 1.5)) }
    };
    let written = written_out(&outer(written_out(&inner)));
    assert_same(with(scene(ROOM), [instances(outer(vec![instances(inner)]))]), with(scene(ROOM), written));
}

/// First about x: the point (0, 1, 0) goes to (0, 0, 1); then about y to (1, 0, 0); then about z to (0, 1, 0).
#[test]
fn copies_turn_about_x_then_y_then_z_after_scaling_and_before_moving() {
    let point = scene("objects: [sphere: {center: [0, 1, 0], radius: 0.01}]").objects;
    let at = |turn: DVec3, place: [f64; 3]| {
        let rotations = Some(Data::inline(vec![turn]));
        let scales = Sizes::Same(2.0);
        let all = Instances { rotations, scales, ..copies(point.clone(), vec![DVec3::new(10.0, 0.0, 0.0)]) };
        let [x, y, z] = place;
        let scene = with(scene("lights: []"), [instances(all)]);
        let seen = look_in(scene, [x + 0.5, y + 0.7, z + 3.0], place);
        let reach = (seen.hit().point - DVec3::from(place)).length();
        assert!((reach - 0.02).abs() < 1e-9, "{reach}");
    };
    at(DVec3::ZERO, [10.0, 2.0, 0.0]);
    at(DVec3::new(90.0, 0.0, 0.0), [10.0, 0.0, 2.0]);
    at(DVec3::new(90.0, 90.0, 0.0), [12.0, 0.0, 0.0]);
    at(DVec3::new(90.0, 90.0, 90.0), [10.0, 2.0, 0.0]);
}

/// Copies 0, 2, 4 … bring red, the others green, to whatever they are copies of.
#[test]
fn materials_of_copies_come_in_turn_and_override_all_within() {
    let [red, green] = [2, 3].map(MaterialId);
    let row: Vec<DVec3> = (0..5).map(|i| DVec3::new(3.0 * f64::from(i), 0.0, 0.0)).collect();
    let two_parts = durer::scene::MeshData {
        parts: vec![crate::objects::part(0, 60, Some(4)), crate::objects::part(60, 60, Some(0))],
        ..ball(8)
    };
    let sphere = scene("objects: [sphere]").objects.remove(0);
    for thing in [with_material(sphere.clone(), 4), mesh(two_parts), sphere, with_material(mesh(ball(8)), 1)] {
        let inner = Instances { materials: vec![MaterialId(4)], ..copies(vec![thing], vec![DVec3::ZERO]) };
        let all = Instances { materials: vec![red, green], ..copies(vec![instances(inner)], row.clone()) };
        let scene = with(scene(ROOM), [with_material(instances(all), 4)]);
        for (copy, place) in row.iter().enumerate() {
            let seen = look_in(scene.clone(), [place.x, 0.0, 3.0], [place.x + 0.1, 0.2, 0.0]);
            assert_color(seen.color, if copy % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] });
            assert_eq!(seen.hit().shape, copy + 1);
        }
    }
}

/// A copy of glass is filled with glass even where the object is not, and the other way round.
#[test]
fn materials_of_copies_decide_about_media() {
    let text = "background: 1
lights: []
materials: {glass: {transparency: 1, attenuation: {color: 0.5, distance: 1}}, clear: {transparency: 1}}";
    let places = vec![DVec3::ZERO, DVec3::new(5.0, 0.0, 0.0)];
    for thing in [scene("objects: [sphere]").objects.remove(0), mesh(crate::objects::cube([-1.0; 3], [1.0; 3]))] {
        let materials = vec![MaterialId(0), MaterialId(1)];
        let all = Instances { materials, ..copies(vec![with_material(thing, 1)], places.clone()) };
        let scene = with(scene(text), [instances(all)]);
        assert_color(look_in(scene.clone(), [0.0, 0.0, 3.0], [0.0, 0.0, 0.0]).color, [0.25; 3]);
        assert_color(look_in(scene, [5.0, 0.0, 3.0], [5.0, 0.0, 0.0]).color, [1.0; 3]);
    }
}
