//! Things by the million, and the files that they come from.

use super::{color, direction, number, object_of, point, shape, size};
use durer_formats::{AssetError, Assets};
use durer_math::{DVec3, Rgb};
use durer_scene::*;
use proptest::collection::vec;
use proptest::prelude::*;
use std::sync::Arc;

/// One picture for all names but those of the files here.
pub(crate) struct Files;

pub(crate) const PICTURE: &str = "a: picture.pfm";
const POINTS: &str = "points.npy";
const RUN: &str = "run.csv";
const ATOMS: &str = "atoms.xyz";
const ENDS: &str = "ends.csv";
const BUNNY: &str = "bunny.ply";

const RUN_TEXT: &str =
    "px,py,pz,size,r,g,b,top_radius\n1,2,3,0.5,255,0,0,0.5\n4,5,6,0.25,0,255,0,0.25\n7,8,9,2,0,0,255,2\n";
const ATOMS_TEXT: &str = "3\nwater\nO 0 0 0.5\nH 1 0 0\nH -1 0 0\n";
const ENDS_TEXT: &str = "x0;y0;z0;x1;y1;z1;radius\n0;0;0;0;1;0;0.5\n1;0;0;1;1;0;0.25\n2;0;0;2;1;0;0.125\n";
const BUNNY_TEXT: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

impl Assets for Files {
    fn read(&self, name: &str, _: u64) -> Result<Vec<u8>, AssetError> {
        Ok(match name {
            POINTS => points_file(),
            RUN => RUN_TEXT.into(),
            ATOMS => ATOMS_TEXT.into(),
            ENDS => ENDS_TEXT.into(),
            BUNNY => BUNNY_TEXT.into(),
            _ => {
                let mut bytes = b"PF\n2 1\n-1.0\n".to_vec();
                (0..6).for_each(|i| bytes.extend((i as f32 / 8.0).to_le_bytes()));
                bytes
            }
        })
    }
}

fn points_file() -> Vec<u8> {
    let header = format!("{:117}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3), }");
    let numbers = (1..=9).flat_map(|i| (i as f32).to_le_bytes());
    [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes()].concat().into_iter().chain(numbers).collect()
}

/// 1 to 9.
fn nine() -> Vec<DVec3> {
    vec![DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0), DVec3::new(7.0, 8.0, 9.0)]
}

fn in_file<T>(file: &str, columns: &[&str], values: Vec<T>) -> Data<T> {
    let columns = columns.iter().map(|column| (*column).to_owned()).collect();
    Data { file: Some(DataFile { file: file.to_owned(), columns }), values: values.into() }
}

fn points() -> BoxedStrategy<Data<DVec3>> {
    prop_oneof![
        vec(point().prop_map(|p| p % 1e6), 3).prop_map(Data::inline),
        Just(in_file(POINTS, &[], nine())),
        Just(in_file(RUN, &[], nine())),
        Just(in_file(RUN, &["px", "2", "PZ"], nine())),
        Just(in_file(ATOMS, &["radius", "y", "y"], vec![DVec3::X * 0.66, DVec3::X * 0.31, DVec3::X * 0.31])),
    ]
    .boxed()
}

fn sizes() -> BoxedStrategy<Sizes> {
    prop_oneof![
        Just(Sizes::Same(1.0)),
        size().prop_map(Sizes::Same),
        vec(size(), 3).prop_map(|sizes| Sizes::Each(Data::inline(sizes))),
        Just(Sizes::Each(in_file(RUN, &[], vec![0.5, 0.25, 2.0]))),
        Just(Sizes::Each(in_file(POINTS, &["1"], vec![1.0, 4.0, 7.0]))),
    ]
    .boxed()
}

fn colors() -> BoxedStrategy<Option<Data<Rgb>>> {
    let primary = vec![Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 1.0, 0.0), Rgb::new(0.0, 0.0, 1.0)];
    prop_oneof![
        Just(None),
        vec(color(), 3).prop_map(|colors| Some(Data::inline(colors))),
        Just(Some(in_file(RUN, &[], primary)))
    ]
    .boxed()
}

/// Particles with or without a file of their own, some of whose columns are overridden.
pub(crate) fn particles() -> BoxedStrategy<Particles> {
    let flags = || (any::<bool>(), any::<bool>(), any::<bool>());
    let balls =
        (points(), sizes(), colors(), flags(), any::<bool>()).prop_map(|(centers, radii, colors, own, file)| {
            let [own_centers, own_radii, own_colors] = [own.0, own.1, own.2].map(|own| own && file);
            let places = vec![DVec3::Z * 0.5, DVec3::X, DVec3::NEG_X];
            let srgb = durer_imaging::linear_from_srgb(13.0 / 255.0);
            let looks = vec![Rgb::new(1.0, srgb, srgb), Rgb::WHITE, Rgb::WHITE];
            let centers = if own_centers { in_file(ATOMS, &[], places) } else { centers };
            let radii = if own_radii { Sizes::Each(in_file(ATOMS, &[], vec![0.66, 0.31, 0.31])) } else { radii };
            let colors = if own_colors { Some(in_file(ATOMS, &[], looks)) } else { colors };
            Particles { file: file.then(|| ATOMS.to_owned()), kind: ParticleKind::Spheres { centers, radii }, colors }
        });
    let lines = (
        vec((point().prop_map(|p| p % 1e3), direction()), 3),
        sizes(),
        sizes(),
        colors(),
        flags(),
        0..3,
        any::<bool>(),
    );
    let lines = lines.prop_map(|(ends, radii, top_radii, colors, (own_ends, own_radii, file), kind, open)| {
        let column = |x: &[f64; 3], y| x.iter().map(|x| DVec3::new(*x, y, 0.0)).collect();
        let (bases, tops) = if own_ends && file {
            let x = [0.0, 1.0, 2.0];
            (in_file(ENDS, &[], column(&x, 0.0)), in_file(ENDS, &[], column(&x, 1.0)))
        } else {
            let tops = ends.iter().map(|(base, by)| *base + *by).collect::<Vec<_>>();
            (Data::inline(ends.iter().map(|(base, _)| *base).collect::<Vec<_>>()), Data::inline(tops))
        };
        let radii = if own_radii && file { Sizes::Each(in_file(ENDS, &[], vec![0.5, 0.25, 0.125])) } else { radii };
        let kind = match kind {
            0 => ParticleKind::Cylinders { bases, tops, radii, open },
            1 => ParticleKind::Cones { bases, tops, radii, top_radii, open },
            _ => ParticleKind::Capsules { bases, tops, radii },
        };
        Particles { file: file.then(|| ENDS.to_owned()), kind, colors }
    });
    prop_oneof![balls, lines].boxed()
}

fn single() -> BoxedStrategy<f32> {
    prop_oneof![number().prop_map(|x| x as f32), -1.0_f32..1.0, Just(0.1)].boxed()
}

/// Meshes that are written out.
fn written_mesh(materials: u32) -> BoxedStrategy<Mesh> {
    let vertices = 3_usize..9;
    let of = move |count: usize| {
        let triple = || [single(), single(), single()];
        let maybe = move |is: bool| if is { count } else { 0 };
        let normal = (0.1_f32..9.0, single(), single()).prop_map(|(x, y, z)| [x, y % 1e6, z % 1e6]);
        let uv = [-9_f32..9.0, -9_f32..9.0];
        let index = 0..count as u32;
        let lists = any::<[bool; 3]>().prop_flat_map(move |[normals, uvs, colors]| {
            (vec(normal.clone(), maybe(normals)), vec(uv.clone(), maybe(uvs)), vec(color(), maybe(colors)))
        });
        let origin = prop_oneof![Just(DVec3::ZERO), point().prop_map(|p| p % 1e11)];
        let part = (
            0_u32..2,
            0_u32..3,
            prop::option::of((0..materials).prop_map(MaterialId)),
            prop::option::of(super::text()),
        );
        let triangles = vec([index.clone(), index.clone(), index], 0..9);
        (vec(triple(), count), triangles, lists, origin, vec(part, 0..3), any::<bool>())
    };
    let make = |(positions, triangles, (normals, uvs, colors), origin, parts, is_smooth): (
        _,
        Vec<_>,
        (Vec<_>, _, _),
        _,
        Vec<_>,
        _,
    )| {
        let mode = match normals.is_empty() {
            true if is_smooth => MeshNormals::Flat,
            false if is_smooth => MeshNormals::Smooth,
            _ => MeshNormals::File,
        };
        let mut end = 0;
        let mut made = Vec::new();
        for (gap, count, material, name) in parts {
            let first = end + gap;
            if first + count <= triangles.len() as u32 {
                end = first + count;
                made.push(MeshPart { name, first, count, material });
            }
        }
        let data = MeshData { origin, positions, triangles, normals, uvs, colors, parts: made };
        Mesh { file: None, normals: mode, data: Arc::new(data) }
    };
    vertices.prop_flat_map(of).prop_map(make).boxed()
}

/// The mesh in the file, known to the last bit.
fn bunny(normals: MeshNormals) -> Mesh {
    let data = MeshData {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        normals: if normals == MeshNormals::Smooth { vec![[0.0, 0.0, 1.0]; 3] } else { Vec::new() },
        ..MeshData::default()
    };
    Mesh { file: Some(BUNNY.to_owned()), normals, data: Arc::new(data) }
}

pub(crate) fn mesh(materials: u32) -> BoxedStrategy<Mesh> {
    let modes = vec![MeshNormals::File, MeshNormals::Smooth, MeshNormals::Flat];
    prop_oneof![written_mesh(materials), prop::sample::select(modes).prop_map(bunny)].boxed()
}

pub(crate) fn instances(objects: BoxedStrategy<Object>, materials: u32) -> BoxedStrategy<Instances> {
    let angles =
        || vec([-360.0..360.0, -360.0..360.0, -360.0..360.0].prop_map(DVec3::from_array), 3).prop_map(Data::inline);
    let rotations = prop_oneof![angles(), Just(in_file(POINTS, &[], nine()))];
    let ids = vec((0..materials).prop_map(MaterialId), 0..3);
    (vec(objects, 0..3), points(), prop::option::of(rotations), sizes(), ids)
        .prop_map(|(objects, positions, rotations, scales, materials)| Instances {
            objects,
            positions,
            rotations,
            scales,
            materials,
        })
        .boxed()
}

/// Each triangle once more, from behind: so every edge joins two that run along it in opposite directions.
fn two_sided(mesh: Mesh) -> Mesh {
    let mut data = MeshData::clone(&mesh.data);
    data.triangles.extend(mesh.data.triangles.iter().map(|&[a, b, c]| [a, c, b]));
    Mesh { data: Arc::new(data), ..mesh }
}

/// Solids of closed shapes, meshes, groups and solids.
pub(crate) fn solid(materials: u32) -> BoxedStrategy<Solid> {
    let closed = shape().prop_filter("closed", Shape::is_closed).prop_map(ObjectKind::Shape);
    let encloses = |mesh: &Mesh| mesh.data.open_edges() == Some(0);
    let mesh = written_mesh(materials).prop_map(two_sided).prop_filter("closed", encloses);
    let leaf = object_of(prop_oneof![closed, mesh.prop_map(ObjectKind::Mesh)].boxed(), materials);
    let tree = leaf.prop_recursive(2, 6, 3, move |inner| {
        let group = vec(inner.clone(), 1..3).prop_map(ObjectKind::Group);
        object_of(prop_oneof![group, combined(inner.boxed()).prop_map(ObjectKind::Solid)].boxed(), materials)
    });
    combined(tree.boxed())
}

fn combined(operands: BoxedStrategy<Object>) -> BoxedStrategy<Solid> {
    let operation = prop::sample::select(vec![Operation::Union, Operation::Intersection, Operation::Difference]);
    (operation, vec(operands, 1..4)).prop_map(|(operation, operands)| Solid { operation, operands }).boxed()
}
