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
    Background, Emission, Light, LightKind, Material, MaterialId, MaterialKind, Matte, Mesh, MeshData, NormalMap,
    Object, ObjectKind, Paint, Relief, Scene, Shape, Strength,
};
use std::sync::Arc;

/// By how much the relief of the square leans, towards x.
const LEAN_DEGREES: f64 = 40.0;

/// A white square that faces up, with relief that leans; from above its middle.
fn leaning(degrees: f64) -> Scene {
    let lean = degrees.to_radians();
    let texture = Paint::Color(Rgb::new(0.5 + 0.5 * sin(lean) as f32, 0.5, 0.5 + 0.5 * cos(lean) as f32));
    let relief = Some(Relief::NormalMap(NormalMap { texture, strength: 1.0 }));
    let corner = DVec3::new(-9.0, 0.0, 9.0);
    let square = Shape::Rectangle { corner, edges: [DVec3::X * 18.0, DVec3::Z * -18.0] };
    white(ObjectKind::Shape(square), relief)
}

/// Something white in the dark, to be drawn by path tracing.
fn white(kind: ObjectKind, relief: Option<Relief>) -> Scene {
    let white = Matte { color: Paint::Color(Rgb::WHITE), ..Matte::default() };
    let mut scene = Scene {
        materials: vec![Material { relief, ..Material::of(MaterialKind::Matte(white)) }],
        objects: vec![Object { material: Some(MaterialId(0)), ..Object::new(kind) }],
        background: Background::Color(Rgb::BLACK),
        ambient: Rgb::BLACK,
        camera: Some(Default::default()),
        lights: Vec::new(),
        ..Scene::default()
    };
    scene.render.integrator =
        durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 2, ..Default::default() });
    scene
}

fn ray() -> Ray {
    Ray { origin: DVec3::new(0.3, 5.0, 0.2), direction: DVec3::NEG_Y }
}

fn seen(scene: &CompiledScene, integrator: &impl Integrator, samples: u32) -> f64 {
    seen_along(&ray(), scene, integrator, samples)
}

fn seen_along(ray: &Ray, scene: &CompiledScene, integrator: &impl Integrator, samples: u32) -> f64 {
    let each = |index| {
        let sampler = Sampler::new(1, (3, 4), index);
        integrator.radiance(scene, ray, Known::Nothing, &sampler, &mut RayCounts::default()).g
    };
    (0..samples).map(each).map(f64::from).sum::<f64>() / f64::from(samples)
}

const TRACER: PathTracer = PathTracer(durer_scene::PathSettings { max_depth: 2, ..durer_scene::PathSettings::DEFAULT });

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
        let aimed = seen(
            &scene(durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 2, ..Default::default() })),
            &TRACER,
            8000,
        );
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

/// A ball of six by twelve facets, with the normals of the ball.
fn coarse_ball() -> ObjectKind {
    const ROWS: u32 = 6;
    const COLUMNS: u32 = 12;
    let point = |row: u32, column: u32| {
        let [down, around] = [f64::from(row) / f64::from(ROWS), 2.0 * f64::from(column) / f64::from(COLUMNS)]
            .map(|turns| turns * std::f64::consts::PI);
        [sin(down) * cos(around), cos(down), -sin(down) * sin(around)].map(|x| x as f32)
    };
    let positions: Vec<[f32; 3]> =
        (0..=ROWS).flat_map(|row| (0..COLUMNS).map(move |column| point(row, column))).collect();
    let at = |row: u32, column: u32| row * COLUMNS + column % COLUMNS;
    let facets = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column)));
    let triangles = facets.flat_map(|(row, column)| {
        let [a, b] = [at(row, column), at(row, column + 1)];
        let [c, d] = [at(row + 1, column + 1), at(row + 1, column)];
        let both = [[a, d, c], [a, c, b]];
        // At the poles one of the two has no area.
        both.into_iter().enumerate().filter(move |(half, _)| match row {
            0 => *half == 0,
            _ => row < ROWS - 1 || *half == 1,
        })
    });
    let triangles = triangles.map(|(_, triangle)| triangle).collect();
    let data = MeshData { normals: positions.clone(), positions, triangles, ..MeshData::default() };
    ObjectKind::Mesh(Mesh { file: None, normals: Default::default(), data: Arc::new(data) })
}

/// However coarse, what is shaded as a ball is lit as a ball: by the cosine to the normal that shading has, up to where that is 0.
/// Neither does a facet's own plane cut it off, nor is another facet in the way.
#[test]
fn a_coarse_ball_is_lit_as_a_ball() {
    for (path, to_light) in
        [(false, DVec3::new(1.0, 0.6, 0.9)), (true, DVec3::new(-0.3, 0.2, 1.0)), (false, DVec3::new(1.0, -0.3, 0.2))]
    {
        let to_light = to_light.normalize();
        let mut scene = white(coarse_ball(), None);
        let kind = LightKind::Directional { direction: -to_light };
        scene.lights = vec![Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(1.0), kind }];
        if !path {
            scene.render.integrator = durer_scene::Integrator::Whitted;
        }
        let scene = compile(&scene.check().unwrap());
        let full = scene.materials[0].diffuse.max(if path { 1.0 } else { 0.0 });
        let (mut lit, mut low) = (0, 0);
        for place in 0..2500_u32 {
            let [x, y] = [place % 50, place / 50].map(|at| (f64::from(at) + 0.37) / 25.0 - 1.0);
            let ray = Ray { origin: DVec3::new(x, y, 5.0), direction: DVec3::NEG_Z };
            let Some(hit) = scene.world.closest_hit(&ray, f64::INFINITY, u32::MAX, None) else { continue };
            let shading = Shading::at(&scene, &ray, &hit);
            let cosine = shading.normal().dot(to_light);
            let found = if path { seen_along(&ray, &scene, &TRACER, 1) } else { seen_along(&ray, &scene, &Whitted, 1) };
            let expected = f64::from(full) * cosine.max(0.0);
            assert!((found - expected).abs() < 1e-5, "{found}, not {expected}, at {x}, {y}");
            lit += u32::from(cosine > 0.0);
            low += u32::from(cosine > 0.0 && shading.face.dot(to_light) < 0.0);
        }
        assert!(lit > 300 && low > 10, "{lit} are lit, of which {low} would not be by their facet's plane");
    }
}

/// Where something else is as near as the rounder surface, rays do not start behind it.
#[test]
fn nothing_leaks_through_what_touches() {
    let mut scene = white(coarse_ball(), None);
    let lift = |scene: &Scene, from: f64| {
        let scene = compile(&scene.clone().check().unwrap());
        let ray = Ray { origin: DVec3::new(0.05, 0.1, from), direction: DVec3::NEG_Z };
        let hit = scene.world.closest_hit(&ray, f64::INFINITY, u32::MAX, None).unwrap();
        let shading = Shading::at(&scene, &ray, &hit);
        (shading.surface.point.z, shading.smooth.map_or(0.0, |smooth| smooth.lift.length()))
    };
    let (at, free) = lift(&scene, 5.0);
    assert!(free > 0.01 && free < 0.3, "{free}");
    let wall = |z: f64| Object::new(ObjectKind::Shape(Shape::Plane { point: DVec3::Z * z, normal: DVec3::Z }));
    scene.objects.push(wall(at + 2.0 * free));
    assert!((lift(&scene, at + 0.2 * free).1 - free).abs() < 1e-9, "what is beyond changes nothing");
    scene.objects.push(wall(at + 0.5 * free));
    assert_eq!(lift(&scene, at + 0.2 * free).1, 0.0);
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
