//! Objects that no text describes: made here, number by number.

use durer::math::{DVec3, Rgb};
use durer::scene::{
    Data, Import, Instances, MaterialId, Mesh, MeshData, MeshNormals, MeshPart, Object, ObjectKind, ParticleKind,
    Particles, Scene, Sizes, Transform, TransformStep,
};
use std::sync::Arc;

pub(crate) fn mesh(data: MeshData) -> Object {
    shared_mesh(&Arc::new(data))
}

pub(crate) fn shared_mesh(data: &Arc<MeshData>) -> Object {
    Object::new(ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data: data.clone() }))
}

pub(crate) fn group(objects: Vec<Object>) -> Object {
    Object::new(ObjectKind::Group(objects))
}

pub(crate) fn copies(objects: Vec<Object>, positions: Vec<DVec3>) -> Instances {
    let positions = Data::inline(positions);
    Instances { objects, positions, rotations: None, scales: Sizes::Same(1.0), materials: Vec::new() }
}

pub(crate) fn instances(instances: Instances) -> Object {
    Object::new(ObjectKind::Instances(instances))
}

pub(crate) fn import(objects: Vec<Object>) -> Import {
    Import { file: "model.glb".to_owned(), objects, lights: Vec::new(), camera: None }
}

pub(crate) fn imported(import: Import) -> Object {
    Object::new(ObjectKind::Import(import))
}

pub(crate) fn particles(kind: ParticleKind, colors: Option<Vec<Rgb>>) -> Object {
    Object::new(ObjectKind::Particles(Particles { file: None, kind, colors: colors.map(Data::inline) }))
}

pub(crate) fn with_material(object: Object, material: u32) -> Object {
    Object { material: Some(MaterialId(material)), ..object }
}

pub(crate) fn moved(object: Object, steps: Vec<TransformStep>) -> Object {
    Object { transform: Transform { steps }, ..object }
}

/// The scene with these objects after its own.
pub(crate) fn with(mut scene: Scene, objects: impl IntoIterator<Item = Object>) -> Scene {
    scene.objects.extend(objects);
    scene
}

pub(crate) fn part(first: u32, count: u32, material: Option<u32>) -> MeshPart {
    MeshPart { name: None, first, count, material: material.map(MaterialId) }
}

/// The box between two corners, as twelve triangles that face outwards.
pub(crate) fn cube(min: [f32; 3], max: [f32; 3]) -> MeshData {
    let corner = |i: usize| std::array::from_fn(|axis| if i >> axis & 1 == 0 { min[axis] } else { max[axis] });
    let quads: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    MeshData { positions: (0..8).map(corner).collect(), triangles, ..MeshData::default() }
}

/// The unit ball by longitude and latitude, with the ball's own normals.
pub(crate) fn ball(steps: u32) -> MeshData {
    let point = |i: u32, j: u32| {
        let (longitude, latitude) = (
            f64::from(i) / f64::from(2 * steps) * std::f64::consts::TAU,
            (f64::from(j) / f64::from(steps) - 0.5) * std::f64::consts::PI,
        );
        // The poles are points, so that the mesh is closed.
        let (sin, cos) = if j.is_multiple_of(steps) { (latitude.signum(), 0.0) } else { latitude.sin_cos() };
        [(cos * longitude.sin()) as f32, sin as f32, (cos * longitude.cos()) as f32]
    };
    let row = 2 * steps + 1;
    let positions: Vec<[f32; 3]> = (0..=steps).flat_map(|j| (0..row).map(move |i| point(i % (2 * steps), j))).collect();
    let quad = |i: u32, j: u32| {
        let a = j * row + i;
        [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]
    };
    let triangles = (0..steps).flat_map(|j| (0..2 * steps).flat_map(move |i| quad(i, j))).collect();
    MeshData { normals: positions.clone(), positions, triangles, ..MeshData::default() }
}

/// A square in the xy plane from -1 to 1, facing +z.
pub(crate) fn square() -> MeshData {
    let positions = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    MeshData { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..MeshData::default() }
}
