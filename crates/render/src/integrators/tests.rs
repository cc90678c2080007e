//! The simple integrators, by what is known of simple scenes.

use super::Integrator;
use super::ambient_occlusion::AmbientOcclusion;
use super::depth::Depth;
use crate::compile::{CompiledScene, compile};
use crate::holes::Known;
use crate::observer::RayCounts;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::{DVec3, Rgb};
use durer_scene::{Camera, Object, ObjectKind, Scene, Shape};

fn scene(shapes: &[Shape]) -> CompiledScene {
    let objects = shapes.iter().map(|shape| Object::new(ObjectKind::Shape(*shape))).collect();
    compile(&Scene { objects, camera: Some(Camera::default()), ..Scene::default() }.check().unwrap())
}

fn floor() -> Shape {
    Shape::Plane { point: DVec3::ZERO, normal: DVec3::Y }
}

/// Ambient occlusion at the origin, seen from a little above it.
fn occlusion(shapes: &[Shape], distance: f64) -> f32 {
    const SAMPLES: u32 = 8192;
    let scene = scene(shapes);
    let ray = Ray { origin: DVec3::new(0.01, 0.01, 0.0), direction: DVec3::new(-1.0, -1.0, 0.0).normalize() };
    let sum = (0..SAMPLES).fold(Rgb::BLACK, |sum, sample| {
        let sampler = Sampler::new(0, (0, 0), sample);
        let known = Known::Nothing;
        sum + AmbientOcclusion { distance }.radiance(&scene, &ray, known, &sampler, &mut RayCounts::default())
    });
    sum.g / SAMPLES as f32
}

/// A colored pane hides a share of the sky, not a color of it.
#[test]
fn occlusion_behind_colored_panes_is_gray() {
    use durer_scene::{Classic, Material, MaterialId, MaterialKind};
    let transparency = Rgb::new(0.9, 0.3, 0.1);
    let red = Material::of(MaterialKind::Classic(Classic { transparency, ..Classic::default() }));
    let pane = Shape::Plane { point: DVec3::Y * 2.0, normal: DVec3::Y };
    let objects = vec![
        Object::new(ObjectKind::Shape(floor())),
        Object { material: Some(MaterialId(0)), ..Object::new(ObjectKind::Shape(pane)) },
    ];
    let materials = vec![red];
    let scene = Scene { objects, materials, camera: Some(Camera::default()), ..Scene::default() };
    let scene = compile(&scene.check().unwrap());
    let ray = Ray { origin: DVec3::new(0.01, 0.01, 0.0), direction: DVec3::new(-1.0, -1.0, 0.0).normalize() };
    let integrator = AmbientOcclusion { distance: f64::INFINITY };
    let sampler = Sampler::new(0, (0, 0), 0);
    let found = integrator.radiance(&scene, &ray, Known::Nothing, &sampler, &mut RayCounts::default());
    assert_eq!(found, Rgb::gray(transparency.luminance()));
}

/// A ball straight above a surface hides the part (r / h)² of what falls on it, with its middle at height h.
#[test]
fn a_ball_hides_as_much_sky_as_its_form_factor_says() {
    for (radius, height) in [(1.0, 2.0), (2.0, 2.5), (0.5, 3.0)] {
        let ball = Shape::Sphere { center: DVec3::Y * height, radius };
        let seen = f64::from(occlusion(&[floor(), ball], f64::INFINITY));
        let expected = 1.0 - (radius / height) * (radius / height);
        assert!((seen - expected).abs() < 0.015, "{radius}, {height}: {seen}, not {expected}");
        assert_eq!(occlusion(&[floor(), ball], (height - radius) * 0.99), 1.0, "nothing is so near");
    }
}

#[test]
fn an_open_sky_is_white_and_a_closed_box_black() {
    assert_eq!(occlusion(&[floor()], f64::INFINITY), 1.0);
    assert_eq!(occlusion(&[], f64::INFINITY), 1.0);
    let shell = Shape::Sphere { center: DVec3::ZERO, radius: 9.0 };
    assert_eq!(occlusion(&[floor(), shell], f64::INFINITY), 0.0);
    assert_eq!(occlusion(&[floor(), shell], 8.0), 1.0);
}

/// White at the near end of the scene, dark at its far end, still darker behind it, black for nothing.
#[test]
fn depth_lies_between_the_ends_of_the_scene() {
    let ball = |z: f64| Shape::Sphere { center: DVec3::new(0.0, 0.0, z), radius: 1.0 };
    let wall = Shape::Plane { point: DVec3::NEG_Z * 110.0, normal: DVec3::Z };
    // The default camera stands in the origin and looks along -z.
    let scene = scene(&[ball(-10.0), ball(-58.0), wall]);
    let gray = |origin: DVec3, direction: DVec3| {
        let (ray, sampler) = (Ray { origin, direction }, Sampler::new(0, (0, 0), 0));
        Depth::of(&scene).radiance(&scene, &ray, Known::Nothing, &sampler, &mut RayCounts::default()).g
    };
    let near = |a: f32, b: f64| assert!((f64::from(a) - b).abs() < 1e-6, "{a}, not {b}");
    near(gray(DVec3::ZERO, DVec3::NEG_Z), 1.0);
    near(gray(DVec3::NEG_Z * 20.0, DVec3::NEG_Z), 1.0 - 0.9 * 48.0 / 50.0);
    near(gray(DVec3::X * 5.0, DVec3::NEG_Z), 0.1 * 50.0 / 101.0);
    near(gray(DVec3::ZERO, DVec3::Z), 0.0);
}
