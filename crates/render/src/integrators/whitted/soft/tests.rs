//! Soft light on a matte floor: what the path tracer shows of it, too.

use crate::compile::{CompiledScene, compile};
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::integrators::path::PathTracer;
use crate::integrators::whitted::Whitted;
use crate::observer::RayCounts;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::{
    Background, Emission, Falloff, Light, LightKind, Material, MaterialId, MaterialKind, Matte, Object, ObjectKind,
    Paint, Scene, Shape, Strength,
};

/// A gray floor at y = 0 and things above it, of which the last glows.
fn scene(shapes: &[Shape], integrator: durer_scene::Integrator) -> Scene {
    let matte = |gray: f32| {
        let color = Paint::Color(Rgb::gray(gray));
        Material::of(MaterialKind::Matte(Matte { color, ..Matte::default() }))
    };
    let (point, normal) = (DVec3::ZERO, DVec3::Y);
    let mut objects = vec![Object::new(ObjectKind::Shape(Shape::Plane { point, normal }))];
    objects[0].material = Some(MaterialId(0));
    for (index, &shape) in shapes.iter().enumerate() {
        let material = if index + 1 == shapes.len() { MaterialId(2) } else { MaterialId(1) };
        objects.push(Object { material: Some(material), ..Object::new(ObjectKind::Shape(shape)) });
    }
    let glowing = Material { emission: Emission::of(Rgb::gray(3.0)), ..matte(0.0) };
    let mut scene = Scene {
        materials: vec![matte(0.5), matte(0.0), glowing],
        objects,
        background: Background::Color(Rgb::BLACK),
        ambient: Rgb::BLACK,
        lights: Vec::new(),
        camera: Some(Default::default()),
        ..Scene::default()
    };
    scene.render.integrator = integrator;
    scene.render.light_samples = 64;
    scene
}

fn floor_at(scene: &CompiledScene, integrator: &impl Integrator, place: DVec2, samples: u32) -> f32 {
    let ray = Ray { origin: DVec3::new(place.x, 1e-2, place.y), direction: DVec3::NEG_Y };
    let one = |index: u32| {
        let sampler = Sampler::new(0, (1, 1), index);
        integrator.radiance(scene, &ray, Known::Nothing, &sampler, &mut RayCounts::default()).g
    };
    (0..samples).map(one).sum::<f32>() / samples as f32
}

/// In the light, in half shadow and in shadow.
#[track_caller]
fn both_agree(make: impl Fn(durer_scene::Integrator) -> Scene, places: &[DVec2]) {
    let compiled = |integrator| compile(&make(integrator).check().unwrap());
    let classic = compiled(durer_scene::Integrator::Whitted);
    let true_one =
        compiled(durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 2, ..Default::default() }));
    for &place in places {
        let found = floor_at(&classic, &Whitted, place, 64);
        let expected = floor_at(
            &true_one,
            &PathTracer(durer_scene::PathSettings { max_depth: 2, ..Default::default() }),
            place,
            4096,
        );
        assert!((found - expected).abs() < 0.02 * expected + 1e-3, "{found}, not {expected}, at {place}");
    }
}

const PLACES: [DVec2; 5] =
    [DVec2::new(3.0, 0.0), DVec2::new(1.5, 0.3), DVec2::new(1.0, 0.0), DVec2::new(0.5, -0.4), DVec2::ZERO];

#[test]
fn glowing_shapes_cast_the_shadows_that_they_cast() {
    let blocker = Shape::Disc { center: DVec3::Y, normal: DVec3::Y, radius: 0.7, inner_radius: 0.0 };
    let (corner, edges) = (DVec3::new(-0.5, 2.0, -0.5), [DVec3::X, DVec3::Z]);
    let lights = [Shape::Sphere { center: DVec3::Y * 2.5, radius: 0.4 }, Shape::Rectangle { corner, edges }];
    for light in lights {
        both_agree(|integrator| scene(&[blocker, light], integrator), &PLACES);
    }
}

#[test]
fn lamps_with_a_radius_do_so_too() {
    let blocker = Shape::Disc { center: DVec3::Y, normal: DVec3::Y, radius: 0.7, inner_radius: 0.0 };
    // What glows is out of sight.
    let far = Shape::Sphere { center: DVec3::NEG_Y * 9.0, radius: 0.1 };
    for falloff in [Falloff::None, Falloff::InverseSquare] {
        let kind = LightKind::Point { position: DVec3::Y * 2.5, falloff, radius: 0.4 };
        let lamp = Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(2.0), kind };
        both_agree(|integrator| Scene { lights: vec![lamp.clone()], ..scene(&[blocker, far], integrator) }, &PLACES);
    }
}

/// More lights than get rays of their own.
#[test]
fn many_shapes_share_their_rays() {
    let balls: Vec<Shape> = (0..40)
        .map(|index: u32| {
            let place = DVec2::new(f64::from(index % 8) - 3.5, f64::from(index / 8) - 2.0);
            Shape::Sphere { center: DVec3::new(place.x, 1.0 + 0.1 * place.y, place.y), radius: 0.2 }
        })
        .collect();
    let make = |integrator| {
        let mut scene = scene(&balls, integrator);
        scene.objects.iter_mut().skip(1).for_each(|object| object.material = Some(MaterialId(2)));
        scene
    };
    both_agree(make, &PLACES);
}

/// No shadow rays but those of point lights: nothing glows for others, and lamps are points.
#[test]
fn no_light_samples_is_the_classic_picture() {
    let light = Shape::Sphere { center: DVec3::Y * 2.5, radius: 0.4 };
    let mut scene = scene(&[light], durer_scene::Integrator::Whitted);
    scene.render.light_samples = 0;
    let kind = LightKind::Point { position: DVec3::new(0.0, 1.0, 0.0), falloff: Falloff::None, radius: 0.5 };
    scene.lights.push(Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(2.0), kind });
    let compiled = compile(&scene.check().unwrap());
    assert_eq!(floor_at(&compiled, &Whitted, DVec2::ZERO, 1), 1.0);
}
