//! Closed forms that path tracing must come to.

mod media;

use super::*;
use crate::compile::compile;
use durer_scene::{
    Background, Camera, Classic, Emission, Glass, Light, LightKind, Material, MaterialKind, Matte, Metal, Mirror,
    Object, ObjectKind, Paint, Plastic, Principled, RenderSettings, Scene, Shape, Strength,
};

fn matte(color: Rgb) -> Material {
    Material::of(MaterialKind::Matte(Matte { color: Paint::Color(color), ..Matte::default() }))
}

fn mean(scene: &CompiledScene, samples: u32) -> Rgb {
    mean_to(1000, scene, samples)
}

/// With no more segments than this.
fn mean_to(max_depth: u32, scene: &CompiledScene, samples: u32) -> Rgb {
    let tracer = PathTracer(durer_scene::PathSettings { max_depth, ..Default::default() });
    let ray = scene.camera.ray(durer_math::DVec2::new(320.0, 240.0));
    let estimates = (0..samples).map(|index| {
        let sampler = Sampler::new(0, (0, 0), index);
        tracer.radiance(scene, &ray, Known::Nothing, &sampler, &mut crate::observer::RayCounts::default())
    });
    estimates.fold(Rgb::BLACK, |sum, estimate| sum + estimate) * (1.0 / samples as f32)
}

/// From inside of a ball that gives off light L and gives back the part ρ, L/(1 - ρ) is seen everywhere.
#[test]
fn a_furnace_glows_as_its_series_says() {
    let color = Rgb::new(0.2, 0.5, 0.8);
    let material = Material { emission: Emission::of(Rgb::WHITE), ..matte(color) };
    let ball = Object {
        material: Some(durer_scene::MaterialId(0)),
        ..Object::new(ObjectKind::Shape(Shape::Sphere { center: durer_math::DVec3::ZERO, radius: 3.0 }))
    };
    let scene = Scene {
        materials: vec![material],
        objects: vec![ball],
        camera: Some(Default::default()),
        lights: Vec::new(),
        ..Scene::default()
    };
    let found = mean(&compile(&scene.check().unwrap()), 4096);
    for (found, albedo) in found.to_array().into_iter().zip(color.to_array()) {
        let expected = 1.0 / (1.0 - albedo);
        assert!((found / expected - 1.0).abs() < 0.03, "{found}, not {expected}");
    }
}

/// Under a white sky a convex white body looks white.
#[test]
fn a_white_ball_vanishes_in_a_white_sky() {
    let material = matte(Rgb::WHITE);
    let ball = Object {
        material: Some(durer_scene::MaterialId(0)),
        ..Object::new(ObjectKind::Shape(Shape::Sphere { center: durer_math::DVec3::NEG_Z * 5.0, radius: 1.0 }))
    };
    let background = Background::Color(Rgb::WHITE);
    let scene = Scene {
        materials: vec![material],
        objects: vec![ball],
        background,
        camera: Some(Default::default()),
        lights: Vec::new(),
        ..Scene::default()
    };
    let found = mean(&compile(&scene.check().unwrap()), 64);
    assert!((found - Rgb::WHITE).map(f32::abs).max_component() < 1e-5, "{found:?}");
}

/// A lamp gives a matte surface that faces it the radiance that the classic integrator gives it.
#[test]
fn lamps_are_as_bright_as_classic_ones() {
    let kind = LightKind::Directional { direction: durer_math::DVec3::NEG_Z };
    let lamp = Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(0.5), kind };
    let (point, normal) = (durer_math::DVec3::NEG_Z * 5.0, durer_math::DVec3::Z);
    let wall = Object::new(ObjectKind::Shape(Shape::Plane { point, normal }));
    let background = Background::Color(Rgb::BLACK);
    let scene = Scene {
        objects: vec![wall],
        background,
        camera: Some(Default::default()),
        lights: vec![lamp],
        ..Scene::default()
    };
    let found = mean(&compile(&scene.check().unwrap()), 4);
    // Default color 0.8, of which 0.8 is given back.
    assert!((found - Rgb::gray(0.32)).map(f32::abs).max_component() < 1e-6, "{found:?}");
}

/// What is seen of a ball of this material straight ahead, under a sky.
fn ball_under(sky: Background, material: Material) -> CompiledScene {
    let ball = Object {
        material: Some(durer_scene::MaterialId(0)),
        ..Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::new(0.3, 0.2, -5.0), radius: 1.0 }))
    };
    let render = RenderSettings {
        integrator: durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 1000, ..Default::default() }),
        ..Default::default()
    };
    let scene = Scene {
        materials: vec![material],
        objects: vec![ball],
        background: sky,
        camera: Some(Default::default()),
        lights: Vec::new(),
        render,
        ..Scene::default()
    };
    compile(&scene.check().unwrap())
}

/// The furnace test for bodies: glass takes nothing away, however rough it is and whatever it is filled with.
#[test]
fn clear_bodies_vanish_in_a_white_sky() {
    for roughness in [0.0, 0.3, 0.8] {
        for (ior, thin) in [(1.5, false), (0.8, false), (2.4, false), (1.5, true)] {
            let glass = Glass { ior, thin, roughness: Paint::Color(Rgb::gray(roughness)), ..Glass::default() };
            let scene = ball_under(Background::Color(Rgb::WHITE), Material::of(MaterialKind::Glass(glass)));
            let found = mean(&scene, 16_000);
            let off = (found - Rgb::WHITE).map(f32::abs).max_component();
            assert!(off < 0.04, "roughness {roughness}, ior {ior}: {found:?}");
        }
    }
}

/// The same for opaque ones: what is white gives back all.
#[test]
fn white_bodies_vanish_in_a_white_sky() {
    let white = Paint::Color(Rgb::WHITE);
    for roughness in [0.0, 0.5, 1.0] {
        let roughness = Paint::Color(Rgb::gray(roughness));
        let conductor = durer_scene::Conductor::Reflectance(white);
        let principled = Principled { base_color: white, roughness, ..Default::default() };
        let clear = Principled { transmission: white, ..principled };
        for kind in [
            MaterialKind::Matte(Matte { color: white, roughness }),
            MaterialKind::Metal(Metal { conductor, roughness, ..Default::default() }),
            MaterialKind::Plastic(Plastic { color: white, roughness, ..Default::default() }),
            MaterialKind::Mirror(Mirror { color: white }),
            MaterialKind::Principled(Box::new(principled)),
            MaterialKind::Principled(Box::new(Principled { metallic: white, ..principled })),
            MaterialKind::Principled(Box::new(clear)),
            MaterialKind::Principled(Box::new(Principled { thin: true, ..clear })),
        ] {
            let scene = ball_under(Background::Color(Rgb::WHITE), Material::of(kind.clone()));
            let off = (mean(&scene, 4000) - Rgb::WHITE).map(f32::abs).max_component();
            assert!(off < 0.05, "{kind:?}: {off}");
        }
    }
}

/// Two boundaries of a pane of glass let 1 - 2R/(1 + R) through: with R = 0.04, 0.92308 of a lamp straight behind it, and
/// as much of the sky.
#[test]
fn lamps_and_sky_shine_through_panes_alike() {
    let pane = Glass { thin: true, ..Glass::default() };
    let clear = Classic { transparency: Rgb::WHITE, ior: Some(1.5), fresnel: true, ..Classic::default() };
    for kind in [MaterialKind::Glass(pane), MaterialKind::Classic(clear)] {
        let rectangle =
            |z: f64| Shape::Rectangle { corner: DVec3::new(-9.0, -9.0, z), edges: [DVec3::X * 18.0, DVec3::Y * 18.0] };
        let with = |shape: Shape, id: u32| Object {
            material: Some(durer_scene::MaterialId(id)),
            ..Object::new(ObjectKind::Shape(shape))
        };
        let kind_of_light = LightKind::Directional { direction: DVec3::Z };
        let lamp = Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(1.0), kind: kind_of_light };
        let scene = Scene {
            materials: vec![matte(Rgb::WHITE), Material::of(kind)],
            // The eye is between a wall and the pane, and the lamp behind the pane.
            objects: vec![with(rectangle(-5.0), 0), with(rectangle(-7.0), 1)],
            background: Background::Color(Rgb::BLACK),
            camera: Some(Camera {
                position: DVec3::new(0.0, 0.0, -6.0),
                look_at: DVec3::new(0.0, 0.0, -5.0),
                ..Default::default()
            }),
            lights: vec![lamp],
            render: RenderSettings {
                integrator: durer_scene::Integrator::Path(durer_scene::PathSettings {
                    max_depth: 2,
                    ..Default::default()
                }),
                ..Default::default()
            },
            ..Scene::default()
        };
        let scene = compile(&scene.check().unwrap());
        let found = mean_to(2, &scene, 16);
        assert!((found.g - 0.923_08).abs() < 1e-4, "{found:?}");
    }
}

/// Wine that is poured into a glass and goes a little into it bends light as if it touched it: the glass has the higher
/// priority, and hides what of the wine's surface is in it. A wine as dense as air leaves only the glass's own boundaries.
#[test]
fn priorities_hide_what_is_inside() {
    let sphere = |radius: f64, id: u32| Object {
        material: Some(durer_scene::MaterialId(id)),
        ..Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::NEG_Z * 5.0, radius }))
    };
    let glass =
        |ior: f64, priority: i32| Material::of(MaterialKind::Glass(Glass { ior, priority, ..Glass::default() }));
    let seen = |objects: Vec<Object>, inner: i32| {
        let scene = Scene {
            materials: vec![glass(1.5, 1), glass(2.0, inner)],
            objects,
            background: Background::Color(Rgb::BLACK),
            camera: Some(Default::default()),
            lights: Vec::new(),
            render: RenderSettings {
                integrator: durer_scene::Integrator::Path(durer_scene::PathSettings {
                    max_depth: 100,
                    ..Default::default()
                }),
                ..Default::default()
            },
            ..Scene::default()
        };
        let scene = compile(&scene.check().unwrap());
        let ray = scene.camera.ray(durer_math::DVec2::new(330.0, 250.0));
        let tracer = PathTracer(durer_scene::PathSettings { max_depth: 100, ..Default::default() });
        let mut counts = crate::observer::RayCounts::default();
        for sample in 0..4000 {
            tracer.radiance(&scene, &ray, Known::Nothing, &Sampler::new(0, (0, 0), sample), &mut counts);
        }
        counts.reflected
    };
    let alone = seen(vec![sphere(1.0, 0)], 0);
    assert!(alone > 0);
    // The same random numbers are met later on the way, so there are only about as many.
    let hidden = seen(vec![sphere(1.0, 0), sphere(0.5, 1)], 0);
    let real = seen(vec![sphere(1.0, 0), sphere(0.5, 1)], 2);
    assert!(real > hidden + hidden / 4, "{alone} alone, {hidden} with one hidden inside, {real} with one inside");
    assert!(hidden.abs_diff(alone) < alone / 4, "{alone} alone, {hidden} with one hidden inside");
}
