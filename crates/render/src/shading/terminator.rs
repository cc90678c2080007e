//! Tests of what is kept of light where normals are not the surface's own.

use super::*;
use crate::compile::compile;
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::integrators::path::PathTracer;
use crate::integrators::whitted::Whitted;
use crate::observer::RayCounts;
use crate::sampler::Sampler;
use durer_math::functions::{cos, sin};
use durer_scene::{
    Background, Emission, Light, LightKind, Material, MaterialId, MaterialKind, Matte, Mesh, MeshData, Object,
    ObjectKind, Paint, Scene, Shape, Strength,
};
use std::sync::Arc;

/// By how much the normals of the square lean, towards x.
const LEAN_DEGREES: f64 = 40.0;

/// A white square that faces up, with normals that lean; from above its middle.
fn leaning(degrees: f64) -> Scene {
    let lean = degrees.to_radians();
    let data = MeshData {
        positions: vec![[-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]],
        normals: vec![[sin(lean) as f32, cos(lean) as f32, 0.0]; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..MeshData::default()
    };
    let mesh = Mesh { file: None, normals: Default::default(), data: Arc::new(data) };
    let white = Matte { color: Paint::Color(Rgb::WHITE), ..Matte::default() };
    let mut scene = Scene {
        materials: vec![Material::of(MaterialKind::Matte(white))],
        objects: vec![Object { material: Some(MaterialId(0)), ..Object::new(ObjectKind::Mesh(mesh)) }],
        background: Background::Color(Rgb::BLACK),
        ambient: Rgb::BLACK,
        camera: Some(Default::default()),
        lights: Vec::new(),
        ..Scene::default()
    };
    scene.render.integrator = durer_scene::Integrator::Path { max_depth: 2, clamp: None };
    scene
}

fn ray() -> Ray {
    Ray { origin: DVec3::new(0.3, 5.0, 0.2), direction: DVec3::NEG_Y }
}

fn seen(scene: &CompiledScene, integrator: &impl Integrator, samples: u32) -> f64 {
    let each = |index| {
        let sampler = Sampler::new(1, (3, 4), index);
        integrator.radiance(scene, &ray(), Known::Nothing, &sampler, &mut RayCounts::default()).g
    };
    (0..samples).map(each).map(f64::from).sum::<f64>() / f64::from(samples)
}

const TRACER: PathTracer = PathTracer { max_depth: 2, clamp: None };

/// A lamp that sinks towards the side to which normals lean: it fades before it sets, without steps, under both integrators.
#[test]
fn lamps_fade_before_they_set() {
    let lit = |elevation: f64, path: bool| {
        let (up, aside) = (sin(elevation.to_radians()), cos(elevation.to_radians()));
        let kind = LightKind::Directional { direction: DVec3::new(-aside, -up, 0.0) };
        let mut scene = leaning(LEAN_DEGREES);
        scene.lights = vec![Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(1.0), kind }];
        if path {
            return seen(&compile(&scene.check().unwrap()), &TRACER, 4);
        }
        scene.render.integrator = durer_scene::Integrator::Whitted;
        seen(&compile(&scene.check().unwrap()), &Whitted, 1)
    };
    for path in [false, true] {
        let all: Vec<f64> = (0..=90).map(|elevation| lit(f64::from(elevation) - 0.5, path)).collect();
        assert_eq!(all[0], 0.0);
        // Without fading, cos 50° = 0.64 would be there from the beginning.
        assert!(all[1] < 0.05, "{}", all[1]);
        for pair in all.windows(2) {
            assert!((pair[1] - pair[0]).abs() < 0.05 * all[50], "a step from {} to {}", pair[0], pair[1]);
        }
        // High up nothing is taken away.
        let full = |elevation: f64| cos((90.0 - LEAN_DEGREES - elevation).to_radians());
        assert!((all[70] / all[80] - full(69.5) / full(79.5)).abs() < 1e-6);
    }
}

/// Both ways to find light agree, from low lamps, too: aiming at a glowing ball, and meeting it by chance.
#[test]
fn aiming_finds_what_chance_finds() {
    for (x, y) in [(4.0, 1.2), (3.0, 3.0), (-3.0, 2.0)] {
        let scene = |integrator| {
            let mut scene = leaning(LEAN_DEGREES);
            let glow = Material {
                emission: Emission::of(Rgb::WHITE),
                ..Material::of(MaterialKind::Matte(Matte { color: Paint::Color(Rgb::BLACK), ..Matte::default() }))
            };
            scene.materials.push(glow);
            let ball = Shape::Sphere { center: DVec3::new(x, y, 0.0), radius: 1.0 };
            scene.objects.push(Object { material: Some(MaterialId(1)), ..Object::new(ObjectKind::Shape(ball)) });
            scene.render.integrator = integrator;
            compile(&scene.check().unwrap())
        };
        let aimed = seen(&scene(durer_scene::Integrator::Path { max_depth: 2, clamp: None }), &TRACER, 8000);
        let chance = seen(&scene(durer_scene::Integrator::Depth), &TRACER, 80_000);
        assert!((aimed / chance - 1.0).abs() < 0.05, "{aimed}, not {chance}, at {x}, {y}");
    }
}

/// From a white sky no more comes back than falls there; less where normals lean, all where they do not.
#[test]
fn nothing_gives_back_more_than_it_gets() {
    let mut before = 1.0 + 1e-6;
    for degrees in [0.0, 10.0, 30.0, 60.0] {
        let scene = Scene { background: Background::Color(Rgb::WHITE), ..leaning(degrees) };
        let found = seen(&compile(&scene.check().unwrap()), &TRACER, 8000);
        assert!(found <= before, "{found} after {before}, leaning by {degrees}°");
        // Of a sphere of directions seen from the normal, the part behind the true plane is lost at least: (1 - cos)/2.
        let most = 0.5 * (1.0 + cos(degrees.to_radians()));
        assert!(found <= most + 0.01 && found > 0.6 * most, "{found}, at most {most}, leaning by {degrees}°");
        before = found;
    }
}

/// Surfaces that are shaded as they are keep all, to the last bit.
#[test]
fn exact_surfaces_keep_all() {
    let scene = compile(&leaning(0.0).check().unwrap());
    let hit = scene.world.closest_hit(&ray(), f64::INFINITY, u32::MAX, None).unwrap();
    let mut shading = Shading::at(&scene, &ray(), &hit);
    shading.smooth = None;
    for x in [-1.0, 0.0, 0.5, 1.0, 1e9] {
        assert_eq!(shading.kept(DVec3::new(x, 1.0, 0.3).normalize()), 1.0);
    }
}
