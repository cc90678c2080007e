//! Particles: each is the exact shape that it stands for, in picture, shadow and glass.

use crate::objects::{copies, instances, moved, particles, with, with_material};
use crate::support::{Front, Numbers, assert_color, assert_gray, difference, look_in, scene};
use durer::Element;
use durer::math::{DVec3, Rgb};
use durer::scene::{Data, Object, ObjectKind, ParticleKind, Scene, Shape, Sizes, TransformStep};

const ROOM: &str = "
lights: [point: {position: [3, 4, 5]}, directional: {direction: [1, -3, -1], intensity: 0.4}]
render: {max_depth: 8}
materials:
  plain: {color: gold, specular: 0.5}
  mirror: {color: 0.2, reflection: 0.7}
  clear: {color: tomato, transparency: [0.8, 0.6, 0.9]}
  glass: {transparency: 0.9, ior: 1.4, fresnel: true, attenuation: {color: [0.4, 0.8, 0.9], distance: 0.5}}
  striped: {color: {stripes: {width: 0.2, axis: [1, 1, 0]}}}
objects:
  - plane: {point: [0, -2, 0], normal: [0.1, 1, 0.05], material: {color: {checker: {size: 0.3}}}}
";

/// Places and sizes that single precision holds exactly: particles are stored in it.
fn exact(value: f64) -> f64 {
    (value * 256.0).round() / 256.0
}

fn places(seed: u64, count: usize, reach: f64) -> Vec<DVec3> {
    let mut numbers = Numbers(seed);
    let mut next = || exact(numbers.signed() * reach);
    (0..count).map(|_| DVec3::new(next(), next(), next())).collect()
}

fn sizes(seed: u64, count: usize) -> Vec<f64> {
    let mut numbers = Numbers(seed);
    (0..count).map(|_| exact(0.1 + 0.2 * numbers.next())).collect()
}

fn shape(shape: Shape) -> Object {
    Object::new(ObjectKind::Shape(shape))
}

/// Sets of all kinds with one size for all or one for each, and the shapes that they stand for.
fn kinds() -> Vec<(ParticleKind, Vec<Shape>)> {
    const COUNT: usize = 12;
    let (a, b, sizes) = (places(1, COUNT, 1.0), places(2, COUNT, 1.0), sizes(3, COUNT));
    let list = |points: &[DVec3]| Data::inline(points.to_vec());
    let each = || Sizes::Each(Data::inline(sizes.clone()));
    let spheres = (0..COUNT).map(|i| Shape::Sphere { center: a[i], radius: sizes[i] }).collect();
    let cylinder = |i: usize, open| Shape::Cylinder { base: a[i], top: b[i], radius: 0.125, open };
    let cone = |i: usize, open| Shape::Cone { base: a[i], top: b[i], base_radius: sizes[i], top_radius: 0.0, open };
    let (bases, tops) = (list(&a), list(&b));
    let cylinders = |open| ParticleKind::Cylinders { bases: list(&a), tops: list(&b), radii: Sizes::Same(0.125), open };
    let cones = ParticleKind::Cones { bases, tops, radii: each(), top_radii: Sizes::Same(0.0), open: false };
    vec![
        (ParticleKind::Spheres { centers: list(&a), radii: each() }, spheres),
        (cylinders(false), (0..COUNT).map(|i| cylinder(i, false)).collect()),
        (cylinders(true), (0..COUNT).map(|i| cylinder(i, true)).collect()),
        (cones, (0..COUNT).map(|i| cone(i, false)).collect()),
    ]
}

/// Where two of them meet, rounding may decide which one is seen; no more than that may differ.
fn assert_alike(a: Scene, b: Scene, context: &str) {
    let [a, b] = [a, b].map(|scene| Front::of(scene, 80, 3.0).image);
    let differing = a.pixels.iter().zip(&b.pixels).filter(|(a, b)| difference(**a, **b) > 1e-4).count();
    assert!(differing <= 4, "{context}: {differing} pixels");
}

#[test]
fn particles_are_their_shapes() {
    for (kind, shapes) in kinds() {
        for material in 0..5 {
            // Where clear things overlap, it matters that what overlaps is one thing or several.
            let context = format!("{} of material {material}", kind.word());
            let many = with_material(particles(kind.clone(), None), material);
            let single = shapes.iter().map(|one| with_material(shape(*one), material));
            assert_alike(with(scene(ROOM), [many]), with(scene(ROOM), single), &context);
        }
    }
}

/// A capsule looks from outside like an open cylinder with a ball at each end.
#[test]
fn capsules_are_cylinders_with_balls() {
    let (a, b) = (places(4, 10, 1.0), places(5, 10, 1.0));
    let (bases, tops) = (Data::inline(a.clone()), Data::inline(b.clone()));
    let many = particles(ParticleKind::Capsules { bases, tops, radii: Sizes::Same(0.125) }, None);
    let single = (0..10).flat_map(|i| {
        let cylinder = Shape::Cylinder { base: a[i], top: b[i], radius: 0.125, open: true };
        [cylinder, Shape::Sphere { center: a[i], radius: 0.125 }, Shape::Sphere { center: b[i], radius: 0.125 }]
    });
    let single: Vec<Object> = single.map(|one| with_material(shape(one), 0)).collect();
    assert_alike(with(scene(ROOM), [with_material(many, 0)]), with(scene(ROOM), single), "capsules");
}

#[test]
fn particles_may_be_stretched_and_copied() {
    let (kind, shapes) = kinds().remove(0);
    let squeeze = |object| moved(object, vec![TransformStep::Scale(DVec3::new(1.0, 0.5, 1.5))]);
    let three = || vec![DVec3::ZERO, DVec3::new(0.5, 0.5, -1.0), DVec3::new(-0.25, -1.0, 0.5)];
    let many = instances(copies(vec![squeeze(with_material(particles(kind, None), 0))], three()));
    let single = shapes.iter().map(|one| squeeze(with_material(shape(*one), 0))).collect();
    assert_alike(with(scene(ROOM), [many]), with(scene(ROOM), [instances(copies(single, three()))]), "copies");
}

fn row(radius: f64, centers: &[f64]) -> ParticleKind {
    let centers = centers.iter().map(|&z| DVec3::new(0.0, 0.0, z)).collect::<Vec<_>>();
    ParticleKind::Spheres { centers: Data::inline(centers), radii: Sizes::Same(radius) }
}

#[test]
fn every_particle_has_its_color() {
    let text = "lights: []
materials:
  plain: {color: gold, ambient: 1}
  textured: {color: {stripes: {colors: [[0.5, 1, 0.25], [0.5, 1, 0.25]]}}, ambient: 1}";
    let centers: Vec<DVec3> = (0..40).map(|i| DVec3::new(f64::from(i), 0.0, 0.0)).collect();
    let kind = ParticleKind::Spheres { centers: Data::inline(centers), radii: Sizes::Same(0.25) };
    let colors: Vec<Rgb> = (0..40).map(|i| Rgb::new(i as f32 / 40.0, 0.5, 1.0 - i as f32 / 40.0)).collect();
    for (material, tint) in [(0, [1.0; 3]), (1, [0.5, 1.0, 0.25])] {
        let many = with_material(particles(kind.clone(), Some(colors.clone())), material);
        let scene = with(scene(text), [many]);
        for i in [0, 1, 7, 38, 39] {
            let x = f64::from(i);
            let seen = look_in(scene.clone(), [x, 0.1, 2.0], [x, 0.1, 0.0]);
            let own = [x / 40.0, 0.5, 1.0 - x / 40.0];
            assert_color(seen.color, std::array::from_fn(|c| tint[c] * own[c]));
            assert_eq!(seen.hit().element, Element::Particle { index: i as u32 });
        }
    }
}

const GLASS: &str = "background: 1
lights: []
render: {max_depth: 20}
materials: {glass: {transparency: 1, attenuation: {color: 0.5, distance: 1}}}";

/// From z = -1 to 1, from 0 to 2, and from 4 to 6, along the axis.
#[test]
fn glass_particles_that_overlap_are_entered_and_left_as_often() {
    let scene = with(scene(GLASS), [with_material(particles(row(1.0, &[0.0, 1.0, 5.0]), None), 0)]);
    let through = |from: f64, to: f64| look_in(scene.clone(), [0.0, 0.0, from], [0.0, 0.0, to]).color;
    assert_gray(through(9.0, 0.0), 0.5_f64.powf(3.0 + 2.0));
    assert_gray(through(3.0, 0.0), 0.5_f64.powf(3.0));
    // The eye is in none, in one, and in two of them.
    assert_gray(through(1.5, 0.0), 0.5_f64.powf(2.5));
    assert_gray(through(0.5, 0.0), 0.5_f64.powf(1.5));
    assert_gray(through(0.5, 7.0), 0.5_f64.powf(1.5 + 2.0));
    assert_gray(through(-0.5, 7.0), 0.5_f64.powf(2.5 + 2.0));
}

#[test]
fn light_goes_through_all_clear_particles() {
    let text = "lights: [directional: {direction: [0, 0, -1]}]
materials: {clear: {transparency: 0.99}}
objects: [plane: {point: [0, 0, -1], normal: [0, 0, 1]}]";
    let centers: Vec<f64> = (0..200).map(|i| f64::from(i) * 0.5).collect();
    let scene = with(scene(text), [with_material(particles(row(0.4, &centers), None), 0)]);
    let seen = look_in(scene, [1.0, 0.0, -0.9], [0.0, 0.0, -1.0]);
    assert!((f64::from(seen.ray.lights[0].visibility.r) - 0.99_f64.powi(400)).abs() < 1e-5);
}
