//! What imported files bring: objects, lights and cameras, all in the importing object's place.

use crate::objects::{copies, group, import, imported, instances, moved, with};
use crate::support::{Front, look_in, picture, scene};
use durer::math::DVec3;
use durer::scene::{Camera, Import, Object, TransformStep};

/// Twice as large, turned by 90° about y, then moved: (x, y, z) goes to (2z + 1, 2y, 3 - 2x).
fn placed(object: Object) -> Object {
    let turn = TransformStep::Rotate { axis: DVec3::Y, degrees: 90.0 };
    moved(
        object,
        vec![TransformStep::Scale(DVec3::splat(2.0)), turn, TransformStep::Translate(DVec3::new(1.0, 0.0, 3.0))],
    )
}

const THINGS: &str = "objects: [sphere: {radius: 0.5}, plane: {point: [0, -0.5, 0]}]";

#[test]
fn imported_lights_shine_from_their_place_beside_those_of_the_scene() {
    let own = "lights: [point: {position: [0, 9, 9], intensity: 0.3}]";
    let in_file = scene(
        "lights:
  - spot: {position: [1, 2, 3], target: [0, 0, 0], half_angle: 30, falloff: inverse_square, intensity: 60}
  - directional: {direction: [1, -2, 0], intensity: 0.5}",
    );
    let in_world = scene(
        "lights:
  - point: {position: [0, 9, 9], intensity: 0.3}
  - spot: {position: [7, 4, 1], target: [1, 0, 3], half_angle: 30, falloff: inverse_square, intensity: 60}
  - directional: {direction: [0, -4, -2], intensity: 0.5}",
    );
    let objects = scene(THINGS).objects;
    let file = Import { lights: in_file.lights, ..import(objects.clone()) };
    let a = with(scene(own), [group(vec![placed(imported(file))])]);
    let b = with(in_world, [placed(group(objects))]);
    let [a, b] = [a, b].map(|scene| Front::of(scene, 64, 6.0).image);
    assert!(crate::support::greatest_difference(&a, &b) < 1e-5);
}

#[test]
fn the_first_camera_in_a_file_is_that_of_a_scene_without_one() {
    let at = |position: DVec3, look_at: DVec3| Camera { position, look_at, ..Camera::default() };
    let objects = scene(THINGS).objects;
    let file = |camera| imported(Import { camera: Some(camera), ..import(objects.clone()) });
    let in_file = at(DVec3::new(2.0, 1.0, 0.5), DVec3::ZERO);
    let second = at(DVec3::new(0.0, 7.0, 1.0), DVec3::ZERO);
    let text = "picture: {width: 40, height: 30}\nlights: [directional: {direction: [1, -2, -3]}]";
    let all = || with(scene(text), [placed(group(vec![file(in_file.clone()), file(second.clone())]))]);
    let mut told = all();
    told.camera = Some(at(DVec3::new(2.0, 2.0, -1.0), DVec3::new(1.0, 0.0, 3.0)));
    assert!(crate::support::greatest_difference(&picture(all()), &picture(told)) < 1e-5);
    let mut own = all();
    own.camera = Some(at(DVec3::new(0.0, 3.0, 9.0), DVec3::ZERO));
    assert!(picture(own) != picture(all()), "the scene's own camera wins");
}

/// A thousand copies of a lamp post are no thousand lights.
#[test]
fn files_that_are_copied_bring_neither_lights_nor_cameras() {
    let lights = scene("lights: [point: {position: [0, 2, 0]}]").lights;
    let file = imported(Import { lights, camera: Some(Camera::default()), ..import(scene(THINGS).objects) });
    let scene = with(scene("lights: []"), [instances(copies(vec![file], vec![DVec3::ZERO, DVec3::X]))]);
    let seen = look_in(scene, [0.1, 0.0, 3.0], [0.1, 0.0, 0.0]);
    assert_eq!(seen.ray.lights, []);
}
