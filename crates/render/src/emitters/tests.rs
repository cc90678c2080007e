//! Light on a white floor, against closed forms; and one light made in many ways.

mod textured;

use super::*;
use crate::compile::compile;
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::integrators::path::PathTracer;
use crate::observer::RayCounts;
use crate::sampler::Sampler;
use durer_imaging::{Bitmap, Texels};
use durer_scene::{
    Background, Emission, Falloff, ImageAsset, ImageId, Light, LightKind, Material, MaterialId, MaterialKind, Matte,
    Mesh, MeshData, Object, ObjectKind, Paint, Scene, Shape, Sides, Strength, TransformStep,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// A white floor at y = 0 under a black sky.
fn floor() -> Scene {
    let color = Paint::Color(Rgb::WHITE);
    let white = Material::of(MaterialKind::Matte(Matte { color, ..Matte::default() }));
    let (point, normal) = (DVec3::ZERO, DVec3::Y);
    let floor = Object::new(ObjectKind::Shape(Shape::Plane { point, normal }));
    let mut scene = Scene {
        materials: vec![white],
        objects: vec![Object { material: Some(MaterialId(0)), ..floor }],
        background: Background::Color(Rgb::BLACK),
        lights: Vec::new(),
        camera: Some(Default::default()),
        ..Scene::default()
    };
    scene.render.integrator = durer_scene::Integrator::Path(durer_scene::PathSettings::default());
    scene
}

/// Adds something black that glows with radiance 1.
fn add(scene: &mut Scene, kind: ObjectKind, sides: Sides) {
    let color = Paint::Color(Rgb::BLACK);
    let emission = Emission { sides, ..Emission::of(Rgb::WHITE) };
    let black = Material::of(MaterialKind::Matte(Matte { color, ..Matte::default() }));
    scene.materials.push(Material { emission, ..black });
    let material = Some(MaterialId(scene.materials.len() as u32 - 1));
    scene.objects.push(Object { material, ..Object::new(kind) });
}

fn lit_by(shape: Shape) -> Scene {
    let mut scene = floor();
    add(&mut scene, ObjectKind::Shape(shape), Sides::Both);
    scene
}

/// The mean, and its standard error, of paths from just above the floor at the origin.
fn seen(scene: Scene, samples: u32) -> (f64, f64) {
    let scene = compile(&scene.check().unwrap());
    let tracer = PathTracer(durer_scene::PathSettings { max_depth: 2, ..Default::default() });
    let ray = Ray { origin: DVec3::Y * 1e-3, direction: DVec3::NEG_Y };
    let (mut sum, mut squares) = (0.0, 0.0);
    for index in 0..samples {
        let sampler = Sampler::new(1, (5, 6), index);
        let value = tracer.radiance(&scene, &ray, Known::Nothing, &sampler, &mut RayCounts::default());
        let value = f64::from(value.luminance());
        (sum, squares) = (sum + value, squares + value * value);
    }
    let (count, mean) = (f64::from(samples), sum / f64::from(samples));
    (mean, ((squares / count - mean * mean).max(0.0) / count).sqrt())
}

#[track_caller]
fn is_seen(scene: Scene, expected: f64, slack: f64) {
    let (found, error) = seen(scene, 4096);
    assert!((found - expected).abs() < 4.0 * error + 1e-5 * expected, "{found} ± {error}, not {expected}");
    assert!(error < slack * expected, "{found} ± {error} is too noisy");
}

/// What a patch sees of a ball: (radius/distance)² times the cosine, if all of it is above the horizon.
#[test]
fn a_ball_lights_the_floor_by_the_angle_it_fills() {
    for height in [1.1, 3.0, 100.0] {
        is_seen(lit_by(Shape::Sphere { center: DVec3::Y * height, radius: 1.0 }), 1.0 / (height * height), 0.01);
    }
    let aside = DVec3::new(3.0, 4.0, 0.0);
    is_seen(lit_by(Shape::Sphere { center: aside, radius: 1.0 }), 0.8 / 25.0, 0.01);
}

#[test]
fn a_disc_lights_the_floor_by_its_form_factor() {
    for (height, slack) in [(0.2, 0.02), (1.0, 0.01), (30.0, 0.01)] {
        let disc = |radius, inner_radius| Shape::Disc {
            center: DVec3::Y * height,
            normal: DVec3::NEG_Y,
            radius,
            inner_radius,
        };
        let factor = |radius: f64| radius * radius / (radius * radius + height * height);
        is_seen(lit_by(disc(1.0, 0.0)), factor(1.0), slack);
        is_seen(lit_by(disc(1.0, 0.5)), factor(1.0) - factor(0.5), slack);
    }
}

fn rectangle_above(height: f64) -> (Shape, f64) {
    let (a, b) = (1.0, 2.0);
    let corner = DVec3::new(0.0, height, 0.0);
    let term = |a: f64, b: f64| {
        let side = (a * a + height * height).sqrt();
        a / side * durer_math::functions::atan2(b, side)
    };
    // Its front faces down.
    (Shape::Rectangle { corner, edges: [DVec3::X * a, DVec3::Z * b] }, (term(a, b) + term(b, a)) / (2.0 * PI))
}

#[test]
fn a_rectangle_lights_the_floor_by_its_form_factor() {
    for height in [0.01, 0.5, 20.0] {
        let (shape, expected) = rectangle_above(height);
        is_seen(lit_by(shape), expected, 0.02);
    }
}

/// Both halves of what is seen: from the front all, from the back nothing.
#[test]
fn sides_are_kept() {
    let (shape, expected) = rectangle_above(0.5);
    let with = |shape: Shape| {
        let mut scene = floor();
        add(&mut scene, ObjectKind::Shape(shape), Sides::Front);
        scene
    };
    is_seen(with(shape), expected, 0.02);
    let Shape::Rectangle { corner, edges: [a, b] } = shape else { panic!() };
    assert_eq!(seen(with(Shape::Rectangle { corner, edges: [b, a] }), 500).0, 0.0);
}

fn mesh(data: MeshData) -> ObjectKind {
    ObjectKind::Mesh(Mesh { file: None, normals: Default::default(), data: Arc::new(data) })
}

/// The icosphere of so many divisions, as large as the unit sphere.
fn ball_of_triangles(center: DVec3, divisions: u32) -> ObjectKind {
    let (one, golden) = (1.0_f64, 0.5 * (1.0 + 5.0_f64.sqrt()));
    let mut points = Vec::new();
    for (a, b) in [(one, golden), (one, -golden), (-one, golden), (-one, -golden)] {
        points.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)].map(DVec3::normalize));
    }
    // Faces are where three points are next to each other.
    let is_edge = |a: DVec3, b: DVec3| (a - b).length() < 1.1;
    let mut faces: Vec<[DVec3; 3]> = Vec::new();
    for (i, &a) in points.iter().enumerate() {
        for (j, &b) in points.iter().enumerate().skip(i + 1) {
            for &c in points.iter().skip(j + 1) {
                if is_edge(a, b) && is_edge(b, c) && is_edge(c, a) {
                    faces.push(if (b - a).cross(c - a).dot(a) > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..divisions {
        let divided = faces.iter().flat_map(|&[a, b, c]| {
            let [d, e, f] = [a + b, b + c, c + a].map(DVec3::normalize);
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        });
        faces = divided.collect();
    }
    let data = MeshData {
        positions: faces.iter().flatten().map(|p| (*p + center).to_array().map(|x| x as f32)).collect(),
        triangles: (0..faces.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect(),
        ..MeshData::default()
    };
    mesh(data)
}

/// One light many ways: a ball, the same of triangles, and what it looks like from the floor as an environment.
#[test]
fn a_ball_is_the_same_light_as_a_mesh_and_as_an_environment() {
    let center = DVec3::new(1.0, 2.0, 0.5);
    let squared = center.length_squared();
    let expected = center.y / squared.sqrt() / squared;
    is_seen(lit_by(Shape::Sphere { center, radius: 1.0 }), expected, 0.01);

    let mut scene = floor();
    add(&mut scene, ball_of_triangles(center, 3), Sides::Both);
    let (found, error) = seen(scene, 8192);
    // 1280 triangles have one part in a hundred less of a shadow than the ball.
    assert!((found / expected - 0.993).abs() < 4.0 * error / expected + 0.006, "{found} ± {error}, not {expected}");
    assert!(error < 0.02 * expected, "{found} ± {error}");

    let (width, height) = (512_u32, 256_u32);
    let pixel = |at: u32| {
        let (longitude, latitude) = (
            (f64::from(at % width) + 0.5) / f64::from(width) * 2.0 * PI - PI,
            (0.5 - (f64::from(at / width) + 0.5) / f64::from(height)) * PI,
        );
        let (sin, cos) = (durer_math::functions::sin, durer_math::functions::cos);
        let direction = DVec3::new(cos(latitude) * cos(longitude), sin(latitude), cos(latitude) * sin(longitude));
        let along = direction.dot(center);
        let is_met = along > 0.0 && squared - along * along < 1.0;
        [f32::from(u8::from(is_met)); 3]
    };
    let texels = Texels::F32((0..width * height).map(pixel).collect());
    let bitmap = Arc::new(Bitmap { width, height, texels, alpha: None });
    let images = vec![ImageAsset { file: "ball.hdr".to_owned(), bitmap }];
    let map = durer_scene::Environment { image: ImageId(0), rotation_degrees: 0.0, strength: 1.0 };
    let scene = Scene { images, background: Background::Image(map), ..floor() };
    let (found, error) = seen(scene, 4096);
    assert!((found / expected - 1.0).abs() < 4.0 * error / expected + 0.01, "{found} ± {error}, not {expected}");
    assert!(error < 0.01 * expected, "{found} ± {error}");
}

/// A sky over the floor: what a gradient gives from above, by hand.
#[test]
fn skies_light_the_floor() {
    let even = Scene { background: Background::Color(Rgb::gray(0.7)), ..floor() };
    is_seen(even, 0.7, 0.001);
    // ∫ cos (b + (t - b)(1 + cos)/2) over the half-space, over π: b + (t - b)(1/2 + 1/3).
    let (bottom, top) = (0.25, 1.0);
    let background = Background::Gradient { bottom: Rgb::gray(bottom), top: Rgb::gray(top) };
    let expected = f64::from(bottom) + f64::from(top - bottom) * (5.0 / 6.0);
    is_seen(Scene { background, ..floor() }, expected, 0.02);
}

fn lamp(position: DVec3, strength: Strength, falloff: Falloff, radius: f64) -> Light {
    let kind = LightKind::Point { position, falloff, radius };
    Light { name: None, color: Rgb::WHITE, strength, kind }
}

/// Physical lamps give E = I cos/d² and show E/π; with a radius, the same where all of them is seen.
#[test]
fn lamps_give_what_physics_says() {
    let position = DVec3::new(0.6, 0.8, 0.0) * 3.0;
    let expected = 5.0 * 0.8 / 9.0 / PI;
    for radius in [0.0, 0.01, 1.0] {
        let by_intensity = lamp(position, Strength::RadiantIntensity(5.0), Falloff::InverseSquare, radius);
        is_seen(Scene { lights: vec![by_intensity], ..floor() }, expected, 0.01);
        let by_power = lamp(position, Strength::Power(20.0 * std::f32::consts::PI), Falloff::InverseSquare, radius);
        is_seen(Scene { lights: vec![by_power], ..floor() }, expected, 0.01);
        let classic = lamp(position, Strength::Classic(0.4), Falloff::None, radius);
        is_seen(Scene { lights: vec![classic], ..floor() }, 0.4 * 0.8, 0.01);
    }
    let kind = LightKind::Directional { direction: DVec3::new(0.6, -0.8, 0.0) };
    let sun = Light { name: None, color: Rgb::WHITE, strength: Strength::Irradiance(2.0), kind };
    is_seen(Scene { lights: vec![sun], ..floor() }, 2.0 * 0.8 / PI, 0.01);
}

/// Ten thousand emitters, alike but for their place: about as little noise as one of them has.
#[test]
fn ten_thousand_emitters_converge() {
    let mut scene = floor();
    let mut triangles = MeshData::default();
    let mut expected = 0.0;
    for index in 0..10_000_u32 {
        let place = DVec3::new(f64::from(index % 100) - 49.5, 2.0, f64::from(index / 100) - 49.5);
        let size = 0.1;
        let corners = [place, place + DVec3::X * size, place + DVec3::Z * size];
        triangles.positions.extend(corners.map(|p| p.to_array().map(|x| x as f32)));
        triangles.triangles.push([3 * index, 3 * index + 1, 3 * index + 2]);
        let middle = place + (DVec3::X + DVec3::Z) * (size / 3.0);
        let squared = middle.length_squared();
        expected += 0.5 * size * size * 4.0 / (squared * squared) / PI;
    }
    add(&mut scene, mesh(triangles), Sides::Both);
    let (found, error) = seen(scene, 4096);
    assert!((found / expected - 1.0).abs() < 4.0 * error / expected + 2e-3, "{found} ± {error}, not {expected}");
    // With one of them chosen at random, the standard deviation of a sample would be sixteen times the mean.
    assert!(error * 64.0 < 1.2 * expected, "{found} ± {error}");
}

/// A thousand spots over the floor, each of which lights a circle of its own: they are not taken for lamps that shine everywhere.
#[test]
fn a_thousand_spots_converge() {
    let spot = |x: i32, z: i32| {
        let position = DVec3::new(f64::from(x), 1.0, f64::from(z));
        let (target, falloff) = (position - DVec3::Y, Falloff::InverseSquare);
        let (half_angle_degrees, inner_half_angle_degrees) = (20.0, 15.0);
        let kind =
            LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius: 0.0 };
        Light { name: None, color: Rgb::WHITE, strength: Strength::RadiantIntensity(5.0), kind }
    };
    let lights = (-16..16).flat_map(|x| (-16..16).map(move |z| spot(x, z))).collect();
    let (found, error) = seen(Scene { lights, ..floor() }, 1024);
    // Of all of them only that right above is seen from the origin: E = I/d².
    let expected = 5.0 / PI;
    assert!((found / expected - 1.0).abs() < 1e-3 + 4.0 * error / expected, "{found} ± {error}, not {expected}");
    // Were all taken to shine on all sides, the standard deviation of a sample would be four times the mean and more.
    assert!(error * 32.0 < 2.0 * expected, "{found} ± {error}");
}

/// Lamps, shapes and a sky together: each is found as often as its chance says, so that all is there.
#[test]
fn kinds_of_emitters_add_up() {
    let (shape, rectangle) = rectangle_above(0.5);
    let lights = vec![
        lamp(DVec3::Y * 2.0, Strength::Classic(1.0), Falloff::InverseSquare, 0.0),
        lamp(DVec3::new(-3.0, 4.0, 0.0), Strength::Classic(0.2), Falloff::None, 0.0),
        lamp(DVec3::new(0.0, 4.0, -3.0), Strength::Classic(0.1), Falloff::None, 0.2),
    ];
    let background = Background::Color(Rgb::gray(0.3));
    let scene = Scene { lights, background, ..lit_by(shape) };
    // The sky is where the rectangle is not; the first lamp is above a corner of the rectangle: half of it would be moot.
    let expected = 0.3 * (1.0 - rectangle) + rectangle + 0.25 + 0.2 * 0.8 + 0.1 * 0.8;
    let mut moved = scene;
    let last = moved.objects.len() - 1;
    moved.objects[last].transform.steps.push(TransformStep::Translate(DVec3::new(1e-9, 0.0, 1e-9)));
    let (found, error) = seen(moved, 16_384);
    assert!((found - expected).abs() < 4.0 * error, "{found} ± {error}, not {expected}");
    assert!(error < 0.02 * expected, "{found} ± {error}");
}

/// Every exact shape that has an area is a light: aiming finds as much of it as chance does.
#[test]
fn aiming_finds_what_chance_finds() {
    let (center, axis) = (DVec3::new(0.2, 1.2, 0.1), DVec3::new(0.3, 1.0, 0.2));
    let shapes = [
        Shape::Box { min: DVec3::new(-0.5, 0.8, -0.3), max: DVec3::new(0.7, 1.5, 0.6) },
        Shape::Cylinder { base: center, top: center + axis, radius: 0.5, open: false },
        Shape::Cylinder { base: center, top: center + axis, radius: 0.5, open: true },
        Shape::Cone { base: center, top: center + axis, base_radius: 0.6, top_radius: 0.2, open: false },
        Shape::Torus { center, axis, radius: 0.8, tube_radius: 0.3 },
    ];
    for shape in shapes {
        let mut scene = lit_by(shape);
        let (found, error) = seen(scene.clone(), 4096);
        // Without aiming: no integrator that aims, no emitters.
        scene.render.integrator = durer_scene::Integrator::Depth;
        let (expected, chance) = seen(scene, 16_384);
        let error = (error * error + chance * chance).sqrt();
        assert!((found - expected).abs() < 4.0 * error, "{found} ± {error}, not {expected}: {shape:?}");
        assert!(error < 0.03 * expected, "{found} ± {error}");
    }
}
