//! What must not change a picture: how large the world is, how it is turned, and what things are called.
//!
//! Sizes and turns change how numbers round, so that no picture can stay the same to the bit. What holds is this: a color
//! changes by rounding only, unless the place that it was looked at is on an edge, of a thing, a shadow, a texture or a
//! reflection; and there, moving the picture by a ten-millionth of a pixel changes it, too. So a pixel that differs
//! is excused only if the unchanged scene has an edge there, as the pictures moved a little show.

use durer::imaging::Image;
use durer::math::{DVec3, Rgb};
use durer::scene::{Antialias, Import, Integrator, Light, LightKind, Object, ObjectKind, Scene};
use durer_trials::scenes::{Temper, maps, scene};
use durer_trials::{Dice, picture};

/// The greatest difference by rounding: of a component, or of a component's own size. Sixteen scales of noise, bright
/// highlights and four reflections lie between the last bit and this.
const ROUNDING: f32 = 2e-5;
/// What is on an edge changes if moved by this part of a pixel.
const BESIDE: f64 = 1e-7;
const SEEDS: u64 = 400;

/// A scene that looks the same wherever the edge of a decision is not: no threshold of weights, of contrast.
fn sample(seed: u64) -> Scene {
    let mut scene = maps::with_plain_background(scene(&mut Dice::of_seed(seed), Temper::Everyday));
    scene.render.antialias = Antialias::None;
    // Chance is not continuous; and relief is made of small differences, of which rounding is a large part.
    scene.render.integrator = Integrator::Whitted;
    scene.materials.iter_mut().for_each(|material| material.relief = None);
    scene.render.light_samples = 0;
    for light in &mut scene.lights {
        if let LightKind::Point { radius, .. } | LightKind::Spot { radius, .. } = &mut light.kind {
            *radius = 0.0;
        }
    }
    scene.render.min_weight = 0.0;
    (scene.picture.width, scene.picture.height) = (16, 16);
    without_imported_lights(&mut scene.objects);
    scene
}

/// Lights of models move with the model; how bright they are does not follow from that.
fn without_imported_lights(objects: &mut [Object]) {
    for object in objects {
        match &mut object.kind {
            ObjectKind::Import(Import { objects, lights, camera, .. }) => {
                lights.retain(|_: &Light| false);
                *camera = None;
                without_imported_lights(objects);
            }
            ObjectKind::Group(members) => without_imported_lights(members),
            ObjectKind::Instances(copies) => without_imported_lights(&mut copies.objects),
            ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) | ObjectKind::Solid(_) => {}
        }
    }
}

fn render(scene: &Scene) -> Image {
    picture(&scene.clone().check().expect("a scene that can be rendered")).expect("a picture")
}

fn differ(a: Rgb, b: Rgb) -> bool {
    let size = a.max_component().max(b.max_component()).max(1.0);
    (a - b).map(f32::abs).max_component() > ROUNDING * size
}

/// The pixels of which a change cannot be excused by an edge.
fn changed(scene: &Scene, before: &Image, after: &Image) -> Vec<usize> {
    let differing = |other: &Image| -> Vec<usize> {
        (0..before.pixels.len()).filter(|&at| differ(before.pixels[at], other.pixels[at])).collect()
    };
    let mut open = differing(after);
    for turn in 0..8 {
        if open.is_empty() {
            break;
        }
        let angle = f64::from(turn) * std::f64::consts::FRAC_PI_4 + 0.3;
        let (right, down) = (durer::math::functions::cos(angle), durer::math::functions::sin(angle));
        let edges = differing(&render(&maps::nudged(scene.clone(), right * BESIDE, down * BESIDE)));
        open.retain(|at| !edges.contains(at));
    }
    open
}

/// Fails for all seeds of which a scene looks other than before.
fn looks_the_same(what: &str, change: impl Fn(Scene, u64) -> Scene) {
    let mut wrong = Vec::new();
    let (mut colors, mut excused) = (0, 0);
    for seed in 0..SEEDS {
        let scene = sample(seed);
        let before = render(&scene);
        colors += usize::from(before.pixels.iter().any(|pixel| differ(*pixel, before.pixels[0])));
        let after = render(&change(scene.clone(), seed));
        excused += before.pixels.iter().zip(&after.pixels).filter(|(a, b)| differ(**a, **b)).count();
        let changed = changed(&scene, &before, &after);
        if let Some(&at) = changed.first() {
            wrong.push(format!(
                "seed {seed}: {} pixels, {:?} became {:?}",
                changed.len(),
                before.pixels[at],
                after.pixels[at]
            ));
        }
    }
    assert!(colors > SEEDS as usize * 3 / 4, "only {colors} pictures show anything");
    assert!(wrong.is_empty(), "{what}: {wrong:#?}");
    assert!(excused < SEEDS as usize / 4, "{what}: {excused} pixels differ: edges should be met but seldom");
}

#[test]
fn the_size_of_the_world_does_not_matter() {
    for factor in [1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3] {
        looks_the_same(&format!("{factor} times as large"), |scene, _| maps::scaled(scene, factor));
    }
}

#[test]
fn the_turn_of_the_world_does_not_matter() {
    looks_the_same("turned", |scene, seed| {
        let mut dice = Dice::of_seed(seed ^ 0xabcd);
        let axis = DVec3::new(dice.within(0.1, 1.0), dice.within(-1.0, 1.0), dice.within(-1.0, 1.0));
        maps::turned(scene, axis, dice.within(-180.0, 180.0))
    });
}

#[test]
fn names_do_not_matter_to_the_bit() {
    for seed in 0..SEEDS {
        let scene = sample(seed);
        assert_eq!(render(&scene), render(&maps::renamed(scene.clone(), "ä")), "seed {seed}");
    }
}

/// The comparison can fail: an eye moved by a hundredth is seen.
#[test]
fn other_changes_are_seen() {
    let seen = (0..SEEDS).filter(|&seed| {
        let scene = sample(seed);
        let mut moved = scene.clone();
        moved.camera.as_mut().expect("a camera").position.x += 1e-2;
        !changed(&scene, &render(&scene), &render(&moved)).is_empty()
    });
    assert!(seen.count() > SEEDS as usize / 2);
}
