//! The memory that a scene is said to need is not less than what its geometry then takes.

use durer::math::DVec3;
use durer::scene::{
    Data, Instances, Mesh, MeshData, MeshNormals, Object, ObjectKind, ParticleKind, Particles, Scene, Shape, Sizes,
};
use durer_trials::Dice;
use durer_trials::scenes::{Temper, scene};
use std::sync::Arc;

const MANY: usize = 20_000;

/// Bytes needed and bytes taken, without what the film needs.
fn needed_and_taken(mut scene: Scene) -> Option<(u64, u64)> {
    (scene.picture.width, scene.picture.height) = (1, 1);
    let checked = scene.check().ok()?;
    let taken = durer::compile(&checked).geometry_memory().total() as u64;
    Some((durer::memory_needed(checked.scene()), taken))
}

fn points() -> Vec<DVec3> {
    let mut dice = Dice::of_seed(1);
    dice.some(MANY, |dice| DVec3::new(dice.unit(), dice.unit(), dice.unit()) * 100.0)
}

fn ball() -> Object {
    Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))
}

fn copies() -> Object {
    Object::new(ObjectKind::Instances(Instances {
        objects: vec![ball()],
        positions: Data::inline(points()),
        rotations: None,
        scales: Sizes::Same(1.0),
        materials: Vec::new(),
    }))
}

fn particles() -> Object {
    let bases = points();
    let tops: Vec<DVec3> = bases.iter().map(|base| *base + DVec3::Y).collect();
    let (bases, tops, radii) = (Data::inline(bases), Data::inline(tops), Sizes::Same(0.1));
    let kind = ParticleKind::Cones { bases, tops, radii: radii.clone(), top_radii: radii, open: false };
    Object::new(ObjectKind::Particles(Particles { file: None, kind, colors: None }))
}

fn mesh() -> Object {
    let positions = points().iter().map(|point| point.to_array().map(|x| x as f32)).collect();
    let triangles = (0..MANY as u32 - 2).map(|at| [at, at + 1, at + 2]).collect();
    let data = MeshData { positions, triangles, ..MeshData::default() };
    Object::new(ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) }))
}

#[test]
fn many_things_take_what_was_said_and_not_much_less() {
    for object in [copies(), particles(), mesh(), Object::new(ObjectKind::Group(vec![ball(); MANY]))] {
        let word = object.kind.word();
        let (needed, taken) = needed_and_taken(Scene { objects: vec![object], ..Scene::default() }).unwrap();
        assert!((taken..20 * taken).contains(&needed), "{word}: {needed} bytes were said, {taken} taken");
    }
}

#[test]
fn scenes_at_random_take_no_more_than_was_said() {
    let scenes = (0..300).map(|seed| scene(&mut Dice::of_seed(seed), Temper::Everyday));
    for (seed, scene) in scenes.enumerate() {
        let Some((needed, taken)) = needed_and_taken(scene) else { continue };
        assert!(needed >= taken, "seed {seed}: {needed} bytes were said, {taken} taken");
    }
}
