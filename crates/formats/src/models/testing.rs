//! What the tests of all formats need: files in memory, bodies of known size, and bytes gone wrong.

use super::{Model, ModelError, read};
use crate::{AssetError, Assets, Limits, NoAssets};
use durer_math::DVec3;
use durer_scene::{MeshData, ObjectKind};

/// Files by name.
pub(super) struct Files<'a>(pub(super) &'a [(&'a str, &'a [u8])]);

impl Assets for Files<'_> {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let found = self.0.iter().find(|(name, _)| *name == relative);
        let (_, bytes) = found.ok_or(AssetError::NotFound)?;
        if bytes.len() as u64 > max_bytes { Err(AssetError::TooLarge(bytes.len() as u64)) } else { Ok(bytes.to_vec()) }
    }
}

/// The model in a file, which must be good.
#[track_caller]
pub(super) fn model(file: &str, bytes: &[u8], assets: &dyn Assets) -> Model {
    match read(file, bytes, assets, &Limits::default()) {
        Ok(model) => {
            assert_is_whole(&model);
            model
        }
        Err(error) => panic!("{error}"),
    }
}

/// The mesh in a file that holds one and gives no warnings.
#[track_caller]
pub(super) fn mesh(file: &str, bytes: &[u8]) -> MeshData {
    let model = model(file, bytes, &NoAssets);
    assert_eq!(model.warnings, [""; 0]);
    mesh_of(&model)
}

/// The only mesh of a model.
#[track_caller]
pub(super) fn mesh_of(model: &Model) -> MeshData {
    assert_eq!(model.scene.objects.len(), 1);
    let ObjectKind::Mesh(mesh) = &model.scene.objects[0].kind else { panic!("not a mesh") };
    MeshData::clone(&mesh.data)
}

/// What is wrong with a file.
#[track_caller]
pub(super) fn error(file: &str, bytes: &[u8]) -> ModelError {
    match read(file, bytes, &NoAssets, &Limits::default()) {
        Ok(_) => panic!("this should have been refused"),
        Err(error) => error,
    }
}

/// Checks what every mesh promises.
#[track_caller]
fn assert_is_whole(model: &Model) {
    let mesh = mesh_of(model);
    let count = mesh.positions.len();
    assert!(!mesh.triangles.is_empty() && mesh.triangles.iter().flatten().all(|vertex| (*vertex as usize) < count));
    for length in [mesh.normals.len(), mesh.uvs.len(), mesh.colors.len()] {
        assert!(length == 0 || length == count, "{length} for {count} vertices");
    }
    assert!(mesh.origin.is_finite() && mesh.positions.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.normals.iter().all(|normal| normal.iter().all(|x| x.is_finite()) && *normal != [0.0; 3]));
    assert!(mesh.uvs.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.colors.iter().all(|color| color.min_component() >= 0.0 && color.max_component() <= 1.0));
    let mut end = 0;
    for part in &mesh.parts {
        assert!(part.first >= end && part.count > 0);
        end = part.first + part.count;
        assert!(part.material.is_none_or(|id| (id.0 as usize) < model.scene.materials.len()));
    }
    assert!(end as usize <= mesh.triangles.len());
}

pub(super) fn corners(mesh: &MeshData, triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|vertex| mesh.origin + DVec3::from_array(mesh.positions[vertex as usize].map(f64::from)))
}

/// The area of all triangles.
pub(super) fn area(mesh: &MeshData) -> f64 {
    let one = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() * 0.5;
    mesh.triangles.iter().map(|triangle| one(corners(mesh, *triangle))).sum()
}

/// What a closed mesh encloses; negative if it is inside out.
pub(super) fn volume(mesh: &MeshData) -> f64 {
    let one = |[a, b, c]: [DVec3; 3]| a.dot(b.cross(c)) / 6.0;
    mesh.triangles.iter().map(|triangle| one(corners(mesh, *triangle))).sum()
}

/// The regular dodecahedron around the origin whose corners include those of the cube of side 2: 20 corners, and 12
/// faces of five.
pub(super) struct Dodecahedron {
    pub(super) corners: Vec<DVec3>,
    pub(super) faces: Vec<[usize; 5]>,
    pub(super) area: f64,
    pub(super) volume: f64,
}

pub(super) fn dodecahedron() -> Dodecahedron {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = || [-1.0, 1.0].into_iter();
    let pairs = || signs().flat_map(move |a| signs().map(move |b| (a, b)));
    let turns = |p: DVec3| [p, DVec3::new(p.z, p.x, p.y), DVec3::new(p.y, p.z, p.x)];
    let mut corners: Vec<DVec3> = pairs().flat_map(|(a, b)| signs().map(move |c| DVec3::new(a, b, c))).collect();
    corners.extend(pairs().flat_map(|(a, b)| turns(DVec3::new(0.0, a / golden, b * golden))));
    let across = pairs().flat_map(|(a, b)| turns(DVec3::new(b * golden, a, 0.0)));
    let faces = across.map(|normal| face_across(&corners, normal)).collect();
    let edge = 2.0 / golden;
    let area = 3.0 * (25.0 + 10.0 * 5.0_f64.sqrt()).sqrt() * edge * edge;
    let volume = (15.0 + 7.0 * 5.0_f64.sqrt()) / 4.0 * edge * edge * edge;
    Dodecahedron { corners, faces, area, volume }
}

/// The five corners furthest along a direction, counter-clockwise seen from there.
fn face_across(corners: &[DVec3], normal: DVec3) -> [usize; 5] {
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_by(|a, b| corners[*b].dot(normal).total_cmp(&corners[*a].dot(normal)));
    order.truncate(5);
    let first = corners[order[0]];
    let center = order.iter().map(|at| corners[*at]).fold(DVec3::ZERO, |sum, p| sum + p) / 5.0;
    let x = (first - center).normalize();
    let y = normal.normalize().cross(x);
    let angle = |at: &usize| {
        let from_center = corners[*at] - center;
        // That of the first must not fall to the end by rounding.
        durer_math::functions::atan2(from_center.dot(y), from_center.dot(x)).rem_euclid(std::f64::consts::TAU - 0.01)
    };
    order.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    [order[0], order[1], order[2], order[3], order[4]]
}

/// Numbers as good as random, the same every time.
pub(super) struct Chance(pub(super) u64);

impl Chance {
    pub(super) fn below(&mut self, most: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % most.max(1) as u64) as usize
    }
}

/// Reads a file cut off at each byte, and changed here and there many times; `pieces` are put in at random. What comes
/// of it is an error or a whole mesh.
#[track_caller]
pub(super) fn assert_survives(file: &str, good: &[u8], pieces: &[&[u8]]) {
    let attempt = |bytes: &[u8]| match read(file, bytes, &NoAssets, &Limits::default()) {
        Ok(model) => assert_is_whole(&model),
        Err(error) => assert!(!error.message.is_empty() && error.message.len() < 1000),
    };
    attempt(good);
    (0..good.len()).for_each(|length| attempt(&good[..length]));
    let mut chance = Chance(good.len() as u64 + 1);
    for _ in 0..3000 {
        let mut bytes = good.to_vec();
        for _ in 0..=chance.below(4) {
            let at = chance.below(bytes.len());
            match chance.below(6) {
                0 => drop(bytes.drain(at..(at + chance.below(20)).min(bytes.len()))),
                1 => drop(bytes.splice(at..at, pieces[chance.below(pieces.len())].iter().copied())),
                2 => drop(bytes.splice(at..at, good[chance.below(good.len())..].iter().copied().take(30))),
                3 => bytes[at] = [0, 0x7f, 0x80, 0xff][chance.below(4)],
                _ => bytes[at] = chance.below(256) as u8,
            }
            if bytes.is_empty() {
                bytes.push(0);
            }
        }
        attempt(&bytes);
    }
}

#[test]
fn the_dodecahedron_is_one() {
    let body = dodecahedron();
    assert_eq!((body.corners.len(), body.faces.len()), (20, 12));
    for face in &body.faces {
        for at in 0..5 {
            let edge = body.corners[face[at]] - body.corners[face[(at + 1) % 5]];
            assert!((edge.length() - (5.0_f64.sqrt() - 1.0)).abs() < 1e-12);
        }
    }
}
