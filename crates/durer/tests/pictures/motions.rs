//! A picture does not depend on where in the world it is taken, nor on the unit of length.

use crate::support::{Numbers, greatest_difference, picture, scene};
use durer::Scene;
use durer::math::{DAffine3, DMat3, DVec3, rotation};
use durer::scene::{Camera, LightKind, Object, ObjectKind, Projection, Transform, TransformStep};

const WORLD: &str = "
camera: {position: [0.5, 1.5, 5], look_at: [0, 0.3, 0], fov: 45}
picture: {width: 40, height: 32}
render: {antialias: none, max_depth: 6}
background: [0.3, 0.5, 0.7]
lights:
  - point: {position: [3, 4, 5], intensity: 0.5}
  - spot: {position: [-3, 5, 2], target: [0, 0, 0], half_angle: 25, inner_half_angle: 15, intensity: 0.5}
  - directional: {direction: [-1, -3, 1], intensity: 0.3}
objects:
  - plane: {point: [0, -1, 0], material: {color: {checker: {size: 0.77}}}}
  - sphere: {center: [0.1, 0, 1.2], radius: 0.5, material: {transparency: 0.8, ior: 1.5, specular: 0.5}}
  - sphere: {center: [-1.3, 0, 0], radius: 0.6, material: {color: tomato, transparency: 0.4, specular: 0.5}}
  - box: {min: [0.6, -1, -0.5], max: [1.4, 0.2, 0.4], material: {color: {marble: {size: 0.5}}}}
  - cylinder: {base: [-0.4, -1, -1], top: [-0.2, 1, -1.2], radius: 0.4, material: {color: gold, reflection: 0.4}}
  - cone: {base: [1.9, -1, -1.7], top: [1.8, 1, -1.5], radius: 0.5, top_radius: 0.2, material: {color: navy}}
  - torus: {center: [-1.2, 0.9, -0.5], axis: [0.3, 1, 1], radius: 0.5, tube_radius: 0.15, material: {color: green}}
  - triangle: {vertices: [[-3, -1, -3], [3, -1, -3.3], [0, 3, -3]], material: {color: teal, reflection: 0.3}}
  - disc: {center: [1.2, 0.9, 0.3], normal: [0.2, 0.4, 1], radius: 0.4, inner_radius: 0.2, material: {color: pink}}
  - rectangle: {corner: [-2, -0.8, 0.9], edges: [[0.6, 0.1, 0], [0, 0.7, -0.2]], material: {color: brown}}
";

/// All of a scene moved: things, lights and eye. The map keeps angles; `scale` is how it changes lengths.
fn moved(mut scene: Scene, map: &DAffine3, scale: f64) -> Scene {
    let (point, direction) = (|p| map.transform_point3(p), |d| map.matrix3 * d);
    let Camera { position, look_at, up, projection, lens } = scene.camera.expect("a camera");
    let projection = match projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: height * scale },
        angle => angle,
    };
    let up = direction(up).normalize();
    scene.camera = Some(Camera { position: point(position), look_at: point(look_at), up, projection, lens });
    for light in &mut scene.lights {
        match &mut light.kind {
            LightKind::Point { position, .. } => *position = point(*position),
            LightKind::Spot { position, target, .. } => (*position, *target) = (point(*position), point(*target)),
            LightKind::Directional { direction: to } => *to = direction(*to),
        }
    }
    let (m, t) = (map.matrix3, map.translation);
    let rows = [0, 1, 2].map(|i| [m.x_axis[i], m.y_axis[i], m.z_axis[i], t[i]]);
    let mut group = Object::new(ObjectKind::Group(scene.objects));
    group.transform = Transform { steps: vec![TransformStep::Matrix(rows)] };
    scene.objects = vec![group];
    scene
}

/// The largest difference that moving makes to the picture.
#[track_caller]
fn difference_by(map: &DAffine3, scale: f64, projection: Projection) -> f32 {
    let mut world = scene(WORLD);
    if let Some(camera) = &mut world.camera {
        camera.projection = projection;
    }
    greatest_difference(&picture(moved(world.clone(), map, scale)), &picture(world))
}

const PROJECTIONS: [Projection; 2] =
    [Projection::FieldOfView { degrees: 45.0 }, Projection::Orthographic { height: 4.0 }];

#[test]
fn turning_and_moving_the_world_with_its_eye_changes_nothing() {
    let mut numbers = Numbers(2);
    for round in 0..12 {
        let mut vector = || DVec3::new(numbers.signed(), numbers.signed(), numbers.signed());
        let (axis, shift) = (vector().normalize(), vector() * 10.0);
        let turn = rotation(axis, 3.0 * numbers.signed());
        let difference = difference_by(&DAffine3::from_mat3_translation(turn, shift), 1.0, PROJECTIONS[round % 2]);
        assert!(difference < 1e-5, "round {round}, axis {axis}, shift {shift}: {difference}");
    }
}

#[test]
fn the_unit_of_length_changes_nothing() {
    for power in -3..=6 {
        let scale = 10.0_f64.powi(power);
        for projection in PROJECTIONS {
            let map = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::splat(scale)));
            let difference = difference_by(&map, scale, projection);
            assert!(difference < 1e-5, "10^{power}, {projection:?}: {difference}");
        }
    }
}

#[test]
fn a_mirrored_world_seen_by_a_mirrored_eye_is_the_mirrored_picture() {
    let original = picture(scene(WORLD));
    let mirror = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
    let mirrored = picture(moved(scene(WORLD), &mirror, 1.0));
    let mut turned = mirrored.clone();
    for (row, y) in mirrored.rows().zip(0..) {
        for (color, x) in row.iter().rev().zip(0..) {
            turned.set(x, y, *color);
        }
    }
    let difference = greatest_difference(&turned, &original);
    assert!(difference < 1e-5, "{difference}");
    assert!(greatest_difference(&mirrored, &original) > 0.1, "the scene itself is not symmetric");
}
