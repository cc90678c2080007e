//! Fog, boundaries that are but partly there or not at all, bodies within bodies, and the clamp: against closed forms.

use super::*;
use crate::integrators::whitted::Whitted;
use durer_math::functions;
use durer_scene::{Attenuation, Falloff, Fog, MaterialId};

/// What glows with this radiance and gives back nothing.
fn glowing(radiance: f32) -> Material {
    Material { emission: Emission::of(Rgb::gray(radiance)), ..matte(Rgb::BLACK) }
}

/// A square wall across the view, so far from the eye.
fn wall(distance: f64, material: u32) -> Object {
    let corner = DVec3::new(-9.0, -9.0, -distance);
    of(Shape::Rectangle { corner, edges: [DVec3::X * 18.0, DVec3::Y * 18.0] }, material)
}

fn of(shape: Shape, material: u32) -> Object {
    Object { material: Some(MaterialId(material)), ..Object::new(ObjectKind::Shape(shape)) }
}

fn ball(distance: f64, radius: f64, material: u32) -> Object {
    of(Shape::Sphere { center: DVec3::NEG_Z * distance, radius }, material)
}

/// The eye at the origin, looking along -z in the dark.
fn before(materials: Vec<Material>, objects: Vec<Object>) -> Scene {
    Scene {
        materials,
        objects,
        background: Background::Color(Rgb::BLACK),
        camera: Some(Camera { position: DVec3::ZERO, look_at: DVec3::NEG_Z, ..Default::default() }),
        lights: Vec::new(),
        render: RenderSettings {
            integrator: durer_scene::Integrator::Path(durer_scene::PathSettings {
                max_depth: 100,
                ..Default::default()
            }),
            ..Default::default()
        },
        ..Scene::default()
    }
}

#[track_caller]
fn shows(scene: &Scene, samples: u32, expected: f64, slack: f64) {
    let found = mean_to(100, &compile(&scene.clone().check().unwrap()), samples);
    assert!((f64::from(found.g) / expected - 1.0).abs() < slack, "{found:?}, not {expected}");
}

fn exponential(distance: f64, color: f32) -> Option<Fog> {
    Some(Fog::Exponential { color: Rgb::gray(color), distance })
}

/// Light L at a distance d behind fog of color c is L e + c (1 - e) with e = exp(-d/D).
#[test]
fn fog_veils_what_glows() {
    for (distance, thickness) in [(5.0, 3.0), (10.0, 20.0)] {
        let e = f64::from(functions::exp((-distance / thickness) as f32));
        let scene = Scene { fog: exponential(thickness, 0.25), ..before(vec![glowing(2.0)], vec![wall(distance, 0)]) };
        shows(&scene, 4, 2.0 * e + 0.25 * (1.0 - e), 1e-5);
    }
}

/// A white wall under a lamp at distance h in front of it: what falls there is I e(h)/h² from the lamp, and c from all other
/// directions, where fog goes on forever.
#[test]
fn fog_veils_lamps_and_lights_what_is_in_it() {
    let kind = LightKind::Point { position: DVec3::NEG_Z * 3.0, falloff: Falloff::InverseSquare, radius: 0.0 };
    let lamp = Light { name: None, color: Rgb::WHITE, strength: Strength::RadiantIntensity(4.0), kind };
    let (distance, color) = (6.0, 0.3_f64);
    let plane = of(Shape::Plane { point: DVec3::NEG_Z * 5.0, normal: DVec3::Z }, 0);
    let scene = Scene {
        fog: exponential(distance, color as f32),
        lights: vec![lamp],
        ..before(vec![matte(Rgb::WHITE)], vec![plane])
    };
    let e = |length: f64| f64::from(functions::exp((-length / distance) as f32));
    let at_wall = 4.0 * e(2.0) / 4.0 / std::f64::consts::PI + color;
    shows(&scene, 4000, at_wall * e(5.0) + color * (1.0 - e(5.0)), 1e-3);
}

/// The same light found in two ways: a glowing ball before a white wall in fog is as bright by aiming as by chance alone.
#[test]
fn fog_is_the_same_for_light_that_is_aimed_at() {
    let scene = |integrator| {
        let objects = vec![wall(5.0, 0), of(Shape::Sphere { center: DVec3::new(1.5, 0.0, -3.5), radius: 0.8 }, 1)];
        let mut scene = before(vec![matte(Rgb::WHITE), glowing(5.0)], objects);
        scene.fog = Some(Fog::Linear { color: Rgb::BLACK, start: 1.0, end: 7.0 });
        scene.render.integrator = integrator;
        compile(&scene.check().unwrap())
    };
    let aimed = mean_to(
        2,
        &scene(durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 2, ..Default::default() })),
        4000,
    )
    .g;
    // No integrator that aims, no emitters.
    let chance = mean_to(2, &scene(durer_scene::Integrator::Depth), 60_000).g;
    assert!((aimed / chance - 1.0).abs() < 0.03, "{aimed}, not {chance}");
}

/// Panes that take nothing away leave linear fog as it is, however often they divide the way: half of the light at 20 of 10 to
/// 30.
#[test]
fn panes_in_fog_change_nothing() {
    let clear = Material::of(MaterialKind::Classic(Classic {
        color: Paint::Color(Rgb::BLACK),
        transparency: Rgb::WHITE,
        ..Classic::default()
    }));
    let panes = || [5.0, 12.0, 16.0].map(|distance| wall(distance, 1));
    let fog = Some(Fog::Linear { color: Rgb::gray(0.125), start: 10.0, end: 30.0 });
    for panes in [Vec::new(), panes().to_vec()] {
        let objects = [vec![wall(20.0, 0)], panes].concat();
        let scene = Scene { fog, ..before(vec![glowing(2.0), clear.clone()], objects) };
        shows(&scene, 4, 1.0 + 0.0625, 1e-5);
    }
}

/// A ball that is not there, or that bends and reflects nothing, changes nothing that is seen through it in fog: as little in
/// front of the wall as around the eye, by both integrators.
#[test]
fn what_is_not_there_leaves_fog_as_it_is() {
    let glass = |ior: f64| Material::of(MaterialKind::Glass(Glass { ior, ..Glass::default() }));
    let nowhere = |opacity: Paint, material: Material| Material { opacity, ..material };
    let bubble = Classic {
        color: Paint::Color(Rgb::BLACK),
        transparency: Rgb::WHITE,
        ior: Some(1.0),
        fresnel: true,
        ..Classic::default()
    };
    let black = Paint::Color(Rgb::BLACK);
    let balls = [
        ("matte, opacity 0", nowhere(black, matte(Rgb::WHITE))),
        ("glass, opacity 0", nowhere(black, glass(1.5))),
        ("matte, cut out", nowhere(Paint::Texture(durer_scene::TextureId(0)), matte(Rgb::WHITE))),
        ("glass, cut out", nowhere(Paint::Texture(durer_scene::TextureId(0)), glass(1.5))),
        ("glass, ior 1", glass(1.0)),
        ("classic, ior 1", Material::of(MaterialKind::Classic(bubble))),
    ];
    let linear = |start, end| Some(Fog::Linear { color: Rgb::gray(0.125), start, end });
    let fogs = [linear(10.0, 30.0), linear(0.0, 25.0), exponential(15.0, 0.25)];
    let path = durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 20, ..Default::default() });
    for (fog, integrator) in fogs.iter().flat_map(|fog| [path, durer_scene::Integrator::Whitted].map(|i| (*fog, i))) {
        let seen = |objects: Vec<Object>, material: &Material| {
            let mut scene = before(vec![glowing(2.0), material.clone()], objects);
            let nothing = durer_scene::Pattern::Checker { colors: [black; 2], size: 1.0, space: Default::default() };
            scene.textures = vec![durer_scene::Texture { name: None, pattern: nothing, transform: Default::default() }];
            (scene.fog, scene.render.integrator) = (fog, integrator);
            let scene = compile(&scene.check().unwrap());
            let ray = scene.camera.ray(durer_math::DVec2::new(300.0, 220.0));
            let (sampler, counts) = (Sampler::new(0, (0, 0), 0), &mut crate::observer::RayCounts::default());
            match integrator {
                durer_scene::Integrator::Path(settings) => {
                    PathTracer(settings).radiance(&scene, &ray, Known::Nothing, &sampler, counts)
                }
                _ => Whitted.radiance(&scene, &ray, Known::Nothing, &sampler, counts),
            }
        };
        for (name, material) in &balls {
            let without = seen(vec![wall(20.0, 0)], material).g;
            assert!(without > 0.3 && without < 1.5, "{without}");
            // Around the eye what has holes is there, and glass.
            let around = (*name != "glass, cut out").then(|| ball(0.0, 2.0, 1));
            for ball in around.into_iter().chain([ball(14.0, 3.0, 1)]) {
                let with = seen(vec![wall(20.0, 0), ball], material).g;
                assert!((with - without).abs() < 1e-5, "{name} in {fog:?} by {integrator:?}: {with}, not {without}");
            }
        }
    }
}

/// What another medium hides is not there: it does not glow, neither for the eye nor for what could aim at it.
#[test]
fn hidden_boundaries_do_not_glow() {
    let glass = |priority: i32| Material::of(MaterialKind::Glass(Glass { priority, ..Glass::default() }));
    let inner = |priority| Material { emission: Emission::of(Rgb::WHITE), ..glass(priority) };
    let seen = |priority| {
        let scene = before(vec![glass(1), inner(priority)], vec![ball(5.0, 2.0, 0), ball(5.0, 1.0, 1)]);
        mean(&compile(&scene.check().unwrap()), 200)
    };
    assert_eq!(seen(0), Rgb::BLACK);
    // Where it is there, both of its sides are seen out of glass, where radiance is 1.5² times as great, through 0.96.
    let expected = 2.0 * 0.96 / 2.25;
    assert!((seen(2).g - expected).abs() < 0.05, "{:?}, not about {expected}", seen(2));
}

/// A cloud of which half is there takes its part from light that enters through it, and nothing from what goes past: in the
/// picture of both integrators and in shadows alike.
#[test]
fn what_goes_past_enters_nothing() {
    let cloud = Material {
        opacity: Paint::Color(Rgb::gray(0.5)),
        ..Material::of(MaterialKind::Classic(Classic {
            color: Paint::Color(Rgb::BLACK),
            transparency: Rgb::WHITE,
            attenuation: Some(Attenuation { color: Rgb::gray(0.5), distance: 1.0 }),
            ..Classic::default()
        }))
    };
    // Two lengths of it, in the middle of the view.
    let seen = before(vec![glowing(4.0), cloud.clone()], vec![wall(20.0, 0), ball(10.0, 1.0, 1)]);
    // Half of it enters, of which a quarter is left.
    let left = 0.5 * 0.25 + 0.5;
    shows(&seen, 4000, 4.0 * left, 0.03);
    let compiled = compile(&Scene { render: RenderSettings::default(), ..seen }.check().unwrap());
    let (ray, sampler) = (compiled.camera.ray(durer_math::DVec2::new(320.0, 240.0)), Sampler::new(0, (0, 0), 0));
    let classic =
        Whitted.radiance(&compiled, &ray, Known::Nothing, &sampler, &mut crate::observer::RayCounts::default());
    assert!((f64::from(classic.g) - 4.0 * left).abs() < 1e-5, "{classic:?}");

    // Straight behind it a lamp: from the wall, which is white, the lamp is seen through two lengths as well.
    let kind = LightKind::Directional { direction: DVec3::NEG_Z };
    let lamp = Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(1.0), kind };
    let mut lit = before(vec![matte(Rgb::WHITE), cloud], vec![wall(20.0, 0), ball(10.0, 1.0, 1)]);
    lit.lights = vec![lamp];
    // The eye is before the cloud as the lamp is: through it there, and back.
    shows(&lit, 4000, left * left, 0.03);
}

/// A body that lets half of the light through, in a ball of glass, in a white sky: nothing is lost, whatever bends light where.
#[test]
fn half_clear_bodies_in_glass_vanish_in_a_white_sky() {
    let white = Paint::Color(Rgb::WHITE);
    let half = Paint::Color(Rgb::gray(0.5));
    for roughness in [0.0, 0.4] {
        let roughness = Paint::Color(Rgb::gray(roughness));
        let body = Principled { base_color: white, transmission: half, roughness, ior: 1.8, ..Default::default() };
        let materials = vec![
            Material::of(MaterialKind::Glass(Glass::default())),
            Material::of(MaterialKind::Principled(Box::new(body))),
        ];
        let mut scene = before(materials, vec![ball(5.0, 1.0, 0), ball(5.0, 0.6, 1)]);
        scene.background = Background::Color(Rgb::WHITE);
        let found = mean_to(1000, &compile(&scene.check().unwrap()), 12_000);
        let off = (found - Rgb::WHITE).map(f32::abs).max_component();
        assert!(off < 0.04, "{found:?}");
    }
}

/// Rough glass with a roughness at which lights are aimed at through it, and through the holes of which half is.
fn half_open_glass(roughness: f32) -> Material {
    let glass = Glass { roughness: Paint::Color(Rgb::gray(roughness)), ..Glass::default() };
    Material { opacity: Paint::Color(Rgb::gray(0.5)), ..Material::of(MaterialKind::Glass(glass)) }
}

/// Radiance in glass is 1.5² times as great as outside, through its holes, too: those who look for a lamp see half of it through
/// one, so much brighter; and one half squared from outside through both sides, where nothing is entered.
#[test]
fn radiance_changes_through_holes_in_glass() {
    let mut scene = before(vec![half_open_glass(0.4)], vec![ball(5.0, 1.0, 0)]);
    scene.background = Background::Color(Rgb::WHITE);
    let scene = compile(&scene.check().unwrap());
    let mut inside = Media::default();
    let _ = inside.cross(0, true);
    let from = |z: f64| durer_geometry::Ray { origin: DVec3::NEG_Z * z, direction: DVec3::NEG_Z };
    let through = |media: &Media, z: f64| visibility(&scene, media, &from(z), 20.0, None);
    assert_eq!(through(&inside, 5.0), Rgb::gray(0.5 * 2.25));
    assert_eq!(through(&Media::default(), 0.0), Rgb::gray(0.25));
}

/// Half-open rough glass loses nothing: in a white sky it is not to be seen.
#[test]
fn half_open_rough_glass_vanishes_in_a_white_sky() {
    for roughness in [0.3, 0.7] {
        let mut scene = before(vec![half_open_glass(roughness)], vec![ball(5.0, 1.0, 0)]);
        scene.background = Background::Color(Rgb::WHITE);
        let found = mean_to(1000, &compile(&scene.check().unwrap()), 60_000);
        assert!((found.g - 1.0).abs() < 0.005, "{roughness}: {found:?}");
    }
}

/// What shows nothing but ambient light, as unlit things of glTF do, shows its color here, too; in mirrors as well.
#[test]
fn unlit_things_show_their_color() {
    let color = Rgb::new(0.5, 0.25, 1.0);
    let unlit = Classic { color: Paint::Color(color), ambient: 1.0, diffuse: 0.0, ..Classic::default() };
    let mut scene = before(vec![Material::of(MaterialKind::Classic(unlit))], vec![wall(5.0, 0)]);
    assert_eq!(mean(&compile(&scene.clone().check().unwrap()), 4), color);
    scene.ambient = Rgb::new(0.5, 0.5, 0.25);
    assert_eq!(mean(&compile(&scene.check().unwrap()), 4), color * Rgb::new(0.5, 0.5, 0.25));
}

/// A pane with a picture on it that is brighter than white lets as much pass as one with a white picture.
#[test]
fn bright_pictures_on_panes_take_nothing_from_what_passes() {
    let texels = durer_imaging::Texels::F32(vec![[20.0; 3]]);
    let bitmap = durer_imaging::Bitmap { width: 1, height: 1, texels, alpha: None };
    let image = durer_scene::ImageTexture {
        image: durer_scene::ImageId(0),
        mapping: Default::default(),
        wrap: durer_scene::Wrap::Repeat,
        filter: durer_scene::Filter::Nearest,
        encoding: durer_scene::Encoding::Linear,
        channels: Default::default(),
        tint: Rgb::WHITE,
    };
    let pattern = durer_scene::Pattern::Image(image);
    let pane = Classic {
        color: Paint::Texture(durer_scene::TextureId(0)),
        transparency: Rgb::gray(0.5),
        diffuse: 1.0,
        ..Classic::default()
    };
    let mut scene =
        before(vec![glowing(2.0), Material::of(MaterialKind::Classic(pane))], vec![wall(9.0, 0), wall(5.0, 1)]);
    scene.textures = vec![durer_scene::Texture { name: None, pattern, transform: Default::default() }];
    let bitmap = std::sync::Arc::new(bitmap);
    scene.images = vec![durer_scene::ImageAsset { file: "bright.exr".to_owned(), bitmap }];
    shows(&scene, 2000, 1.0, 0.05);
}

/// The clamp leaves what comes from one surface: the lamp itself, its mirror image, what it lights; and holds what comes by two.
#[test]
fn the_clamp_holds_only_what_comes_by_several_surfaces() {
    let mirror = Material::of(MaterialKind::Mirror(Mirror { color: Paint::Color(Rgb::WHITE) }));
    let materials = vec![glowing(10.0), mirror, matte(Rgb::WHITE)];
    let seen = |objects: Vec<Object>| {
        let mut scene = before(materials.clone(), objects);
        scene.render.integrator = durer_scene::Integrator::Path(durer_scene::PathSettings {
            max_depth: 20,
            clamp: Some(1.0),
            ..Default::default()
        });
        let scene = compile(&scene.check().unwrap());
        let ray = scene.camera.ray(durer_math::DVec2::new(320.0, 240.0));
        let tracer = PathTracer(durer_scene::PathSettings { max_depth: 20, clamp: Some(1.0), ..Default::default() });
        let mut counts = crate::observer::RayCounts::default();
        let each =
            |sample| tracer.radiance(&scene, &ray, Known::Nothing, &Sampler::new(0, (0, 0), sample), &mut counts);
        (0..2000).map(each).fold(0.0, |sum, found| sum + f64::from(found.g)) / 2000.0
    };
    let behind = |distance: f64, id: u32| {
        let corner = DVec3::new(-9.0, -9.0, distance);
        of(Shape::Rectangle { corner, edges: [DVec3::X * 18.0, DVec3::Y * 18.0] }, id)
    };
    assert_eq!(seen(vec![wall(5.0, 0)]), 10.0);
    // By one mirror.
    assert_eq!(seen(vec![wall(5.0, 1), behind(5.0, 0)]), 10.0);
    // By two: to one mirror at 45°, to another beside it, and on to the lamp in front of that.
    let tilted = |x: f64| {
        let corner = DVec3::new(x - 1.0, -1.0, -6.0);
        of(Shape::Rectangle { corner, edges: [DVec3::new(2.0, 0.0, 2.0), DVec3::Y * 2.0] }, 1)
    };
    let found = seen(vec![tilted(0.0), tilted(-4.0), wall(15.0, 0), behind(5.0, 0)]);
    assert_eq!(found, 1.0);
    // A white wall under the glowing one sees little else than that: direct light of about 10, not held.
    let found = seen(vec![wall(1.0, 2), behind(1.0, 0)]);
    assert!(found > 8.0, "{found}");
}
