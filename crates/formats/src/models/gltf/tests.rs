//! Files made for the purpose, read as text and as binary.

mod build;
mod geometry;
mod hostile;
mod poses;
mod scenes;
mod surfaces;

use super::super::{Model, ModelError};
use crate::{Limits, NoAssets};
use build::File;
use durer_math::{DAffine3, DVec3};
use durer_scene::{MeshData, Object, ObjectKind};
use serde_json::json;

fn try_read(bytes: &[u8]) -> Result<Model, ModelError> {
    super::read("model.gltf", bytes, &NoAssets, &Limits::default())
}

/// Reads a file in both containers, which must make no difference.
#[track_caller]
fn read(file: &File) -> Model {
    let from_text = try_read(&file.text()).unwrap();
    let from_binary = try_read(&file.binary()).unwrap();
    assert_eq!(from_text.scene, from_binary.scene);
    assert_eq!(from_text.warnings, from_binary.warnings);
    assert_eq!(from_text.scene.clone().check().err(), None, "it can be rendered");
    from_text
}

/// What is wrong with a file, in either container.
#[track_caller]
fn fault(file: &File) -> String {
    let fault = try_read(&file.text()).expect_err("must be refused");
    assert_eq!(try_read(&file.binary()).err(), Some(fault.clone()));
    fault.message
}

/// All meshes with their places in the world.
fn meshes(objects: &[Object]) -> Vec<(DAffine3, &Object, &MeshData)> {
    fn gather<'a>(objects: &'a [Object], outer: DAffine3, all: &mut Vec<(DAffine3, &'a Object, &'a MeshData)>) {
        for object in objects {
            let world = outer * object.transform.to_affine();
            match &object.kind {
                ObjectKind::Mesh(mesh) => all.push((world, object, &mesh.data)),
                ObjectKind::Group(members) => gather(members, world, all),
                other => panic!("{} in a glTF file", other.word()),
            }
        }
    }
    let mut all = Vec::new();
    gather(objects, DAffine3::IDENTITY, &mut all);
    all
}

/// The only mesh.
#[track_caller]
fn only_mesh(model: &Model) -> &MeshData {
    match &meshes(&model.scene.objects)[..] {
        [(_, _, data)] => data,
        others => panic!("{} meshes", others.len()),
    }
}

/// The first vertex of the first triangle of each mesh, in the world.
fn first_corners(model: &Model) -> Vec<DVec3> {
    let corner = |data: &MeshData| data.positions[data.triangles[0][0] as usize].map(f64::from);
    meshes(&model.scene.objects).iter().map(|(world, _, data)| world.transform_point3(corner(data).into())).collect()
}

#[track_caller]
fn assert_near(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-6, "{a} is not {b}");
}

#[test]
fn a_triangle() {
    let mut file = File::new();
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    file.show(json!({ "attributes": { "POSITION": positions } }));
    let model = read(&file);
    let mesh = only_mesh(&model);
    assert_eq!(mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.colors.is_empty());
    assert_eq!((mesh.origin, mesh.parts.len(), mesh.parts[0].count), (DVec3::ZERO, 1, 1));
    assert_eq!(model.scene.objects[0].material, None);
    assert!(model.scene.lights.is_empty() && model.scene.camera.is_none() && model.warnings.is_empty());
}
