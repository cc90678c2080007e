//! Samples in one run, in many, in parts: the same bits. Noise and time end where they should.

use super::*;
use crate::compile::compile;
use crate::film::{MergeError, SampleRange};
use crate::observer::Observer;
use crate::schedule::{RenderOptions, render, render_on};
use durer_math::{DVec3, Rgb};
use durer_scene::{
    Background, Integrator as Kind, Object, ObjectKind, Picture, PixelFilter, RenderSettings, Scene, Shape,
};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

fn scene(width: u32, height: u32, change: impl FnOnce(&mut RenderSettings)) -> CompiledScene {
    let mut scene = Scene {
        background: Background::Color(Rgb::new(1.0, 0.5, 0.25)),
        objects: vec![Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))],
        picture: Picture { width, height, ..Picture::default() },
        ..Scene::default()
    };
    scene.render.integrator = Kind::Path(durer_scene::PathSettings { max_depth: 4, ..Default::default() });
    scene.render.samples = Some(7);
    change(&mut scene.render);
    compile(&scene.check().unwrap())
}

fn options(threads: usize) -> RenderOptions {
    RenderOptions { threads: Some(threads), ..RenderOptions::default() }
}

/// Stops after so many tiles.
struct After(AtomicU64);

impl Progress for After {
    fn advanced(&self, _: &Film) {
        let _ = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
    }

    fn stop(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

/// A clock that moves by a second with each tile.
struct Ticking(Mutex<f64>);

impl Progress for Ticking {
    fn advanced(&self, _: &Film) {
        *self.0.lock().unwrap() += 1.0;
    }

    fn elapsed(&self) -> Option<f64> {
        Some(*self.0.lock().unwrap())
    }
}

#[test]
fn threads_and_stops_change_nothing() {
    for (filter, reuse) in [(PixelFilter::Box, 1), (PixelFilter::Mitchell { radius: 2.0 }, 1), (PixelFilter::Box, 16)] {
        for noise in [None, Some(0.05)] {
            let scene = scene(70, 45, |settings| {
                settings.integrator =
                    Kind::Path(durer_scene::PathSettings { max_depth: 4, reuse, ..Default::default() });
                (settings.filter, settings.noise) = (filter, noise);
                settings.samples = Some(if noise.is_some() { 100 } else { 7 });
            });
            let whole = render(&scene, &options(1), &()).unwrap();
            assert!(whole.is_complete());
            assert_eq!(render(&scene, &options(3), &()).unwrap(), whole);
            let tiles = AtomicU64::new(5);
            let mut film = render(&scene, &options(1), &After(tiles)).unwrap();
            assert!(!film.is_complete());
            for tiles in [1, 2, 11, 1000] {
                film = render_on(&scene, film, &options(2), &After(AtomicU64::new(tiles))).unwrap();
            }
            assert_eq!(film, whole, "{filter:?} {reuse} {noise:?}");
        }
    }
}

/// Blocks are those of the picture, and end with it.
#[test]
fn each_pixel_is_in_one_block() {
    let picture = (13, 11);
    for edge in [1, 2, 4, 8] {
        for (x, y) in (Region { x: 0, y: 0, width: 13, height: 11 }).pixel_places() {
            let block = block_of((x, y), edge, picture);
            assert!(block.contains((x, y)) && block.x + block.width <= 13 && block.y + block.height <= 11);
            assert!(block.pixel_places().all(|pixel| block_of(pixel, edge, picture) == block), "{edge}, {x} {y}");
            assert!(block.x + block.width == 13 || block.width == edge);
        }
    }
}

/// After any tile, all of the picture can be seen once the first pass is over.
#[test]
fn what_is_there_is_a_picture() {
    let scene = scene(70, 45, |settings| settings.samples = Some(8));
    let film = render(&scene, &options(1), &After(AtomicU64::new(6 + 2))).unwrap();
    assert_eq!(film.sums().unwrap().least_and_most(), (1, 2));
    assert!(film.pixels().iter().all(|pixel| !pixel.is_black()));
    assert_eq!(film.done(), 70 * 45 + 2 * 32 * 32);
}

#[test]
fn a_sample_does_not_depend_on_how_many_there_are() {
    let few = render(&scene(20, 10, |settings| settings.samples = Some(3)), &options(1), &()).unwrap();
    let of_many = RenderOptions { samples: Some(SampleRange { start: 0, end: 3 }), ..options(1) };
    assert_eq!(render(&scene(20, 10, |settings| settings.samples = Some(1000)), &of_many, &()).unwrap(), few);
}

#[test]
fn noise_takes_samples_to_where_it_is() {
    let target = 0.02;
    let scene = scene(64, 48, |settings| (settings.noise, settings.samples) = (Some(target), Some(2000)));
    let film = render(&scene, &options(2), &()).unwrap();
    let sums = film.sums().unwrap();
    let (least, most) = sums.least_and_most();
    assert!(least == 64 && (96..2000).contains(&most), "{least} {most}");
    let noise = Noise::new(&scene, target);
    let region = film.region();
    for cell in region.cells(noise::CELL) {
        let found = noise.of(sums, cell.pixel_places().map(|(x, y)| region.index_of(x, y)));
        assert!(found <= f64::from(target), "{cell:?}: {found}");
    }
}

/// It ends in time with as many samples everywhere, and that many give the same picture.
#[test]
fn time_ends_with_whole_passes() {
    let limited = scene(64, 64, |settings| (settings.time, settings.samples) = (Some(100.0), None));
    let film = render(&limited, &options(1), &Ticking(Mutex::new(3.0))).unwrap();
    assert!(film.is_complete());
    let (least, most) = film.sums().unwrap().least_and_most();
    // Four tiles each second of a pass: there is time for 5 passes, with 1, 1, 2, 4 and 8 samples, and more.
    assert_eq!(least, most);
    assert!(least >= 31, "{least}");
    let counted = render(&scene(64, 64, |settings| settings.samples = Some(least)), &options(1), &()).unwrap();
    assert_eq!(counted, film);
    // With noise, too, of which much is left; then not all have as many.
    let noisy = scene(64, 64, |settings| {
        (settings.time, settings.noise, settings.samples) = (Some(200.0), Some(0.001), None);
    });
    let clock = Ticking(Mutex::new(3.0));
    let film = render(&noisy, &options(1), &clock).unwrap();
    assert!(film.is_complete() && film.sums().unwrap().least_and_most().0 >= 64);
    let over = *clock.0.lock().unwrap();
    assert!(over <= 200.0, "{over}: not even by a part of a pass");
    let late = scene(64, 64, |settings| (settings.time, settings.samples) = (Some(0.5), None));
    let film = render(&late, &options(1), &Ticking(Mutex::new(3.0))).unwrap();
    assert_eq!(film.sums().unwrap().least_and_most(), (1, 1));
}

/// Counts what is asked of it.
struct Counting(AtomicU64);

impl Integrator for Counting {
    fn radiance<O: Observer>(&self, _: &CompiledScene, ray: &Ray, _: Known<'_>, _: &Sampler, _: &mut O) -> Rgb {
        self.0.fetch_add(1, Ordering::Relaxed);
        Rgb::gray(if ray.direction.x > 0.0 { 1.0 } else { 0.5 })
    }
}

/// A crop that aims at noise needs what lies beside it once more; not if the time was over before.
#[test]
fn a_crop_whose_time_is_over_takes_nothing_beside_it() {
    let scene = scene(64, 64, |settings| (settings.noise, settings.samples) = (Some(0.001), Some(500)));
    let region = Region { x: 20, y: 20, width: 10, height: 10 };
    let goal = Goal { samples: SampleRange { start: 0, end: 500 }, noise: Some(0.001), time: Some(50.0) };
    let integrator = Counting(AtomicU64::new(0));
    let mut film = Film::of_samples(region, goal.samples, false);
    render_samples((&scene, &integrator), goal, &mut film, &After(AtomicU64::new(5)));
    assert!(!film.is_complete() && film.done() > 0);
    let run = |clock: f64| {
        let (mut film, before) = (film.clone(), integrator.0.load(Ordering::Relaxed));
        render_samples((&scene, &integrator), goal, &mut film, &Ticking(Mutex::new(clock)));
        assert!(film.is_complete());
        (film.done(), integrator.0.load(Ordering::Relaxed) - before)
    };
    assert_eq!(run(50.0), (film.done(), 0));
    let (done, asked) = run(49.0);
    assert!(asked > done - film.done() && asked > 0, "in time, all beside it is taken: {asked}");
}

#[test]
fn samples_that_nobody_takes_are_refused() {
    let samples = Some(SampleRange { start: 5, end: 5 });
    assert!(render(&scene(8, 8, |_| ()), &RenderOptions { samples, ..options(1) }, &()).is_err());
    let samples = Some(SampleRange { start: 0, end: 5 });
    let whitted = scene(8, 8, |settings| settings.integrator = Kind::Whitted);
    assert!(render(&whitted, &RenderOptions { samples, ..options(1) }, &()).is_err());
}

/// Any cut of the picture and of its samples, in any order: the film of one run.
#[test]
fn parts_make_the_film_of_one_run() {
    let scene = scene(40, 30, |settings| settings.samples = Some(10));
    let part = |x, y, width, height, start, end| {
        let region = Some(Region { x, y, width, height });
        let samples = Some(SampleRange { start, end });
        render(&scene, &RenderOptions { threads: Some(1), region, samples, direct: true }, &()).unwrap()
    };
    let whole = render(&scene, &RenderOptions { direct: true, ..options(2) }, &()).unwrap();
    let parts = [
        part(0, 0, 40, 30, 7, 10),
        part(0, 0, 13, 30, 0, 7),
        part(13, 0, 27, 11, 3, 7),
        part(13, 11, 27, 19, 0, 7),
        part(13, 0, 27, 11, 0, 3),
    ];
    assert_eq!(Film::merge(&parts).as_ref(), Ok(&whole));
    let some = Film::merge(&parts[..3]).unwrap();
    let shuffled = Film::merge(&[parts[2].clone(), parts[0].clone(), parts[1].clone()]).unwrap();
    assert_eq!(some, shuffled);
    let missing: u64 = some.gaps().0.iter().map(|part| part.region.pixels() * u64::from(part.samples.count())).sum();
    assert_eq!(missing + some.done(), whole.done());
    assert!(whole.gaps().0.is_empty());
    assert_eq!(Film::merge(&[some, parts[3].clone(), parts[4].clone()]).as_ref(), Ok(&whole));
}

#[test]
fn films_that_do_not_fit_are_not_merged() {
    let scene = scene(40, 30, |settings| settings.samples = Some(3));
    let film = render(&scene, &options(1), &()).unwrap();
    let overlap = Film::merge(&[film.clone(), film.clone()]);
    assert!(matches!(overlap, Err(MergeError::Overlap { first: 0, second: 1, .. })));
    let unfinished = render(&scene, &options(1), &After(AtomicU64::new(3))).unwrap();
    assert_eq!(Film::merge(&[unfinished]), Err(MergeError::Unfinished(0)));
    assert_eq!(Film::merge(&[]), Err(MergeError::Nothing));
    let samples = Some(SampleRange { start: 3, end: 5 });
    let with_direct = render(&scene, &RenderOptions { samples, direct: true, ..options(1) }, &()).unwrap();
    assert_eq!(Film::merge(&[film, with_direct]), Err(MergeError::OtherKind(1)));
}

/// Under an even sky, a white ball alone sends on direct light only; on a floor it is less than all.
#[test]
fn direct_light_is_a_part_of_all_light() {
    let scene = scene(40, 30, |settings| settings.samples = Some(16));
    let film = render(&scene, &RenderOptions { direct: true, ..options(1) }, &()).unwrap();
    let sums = film.sums().unwrap();
    assert_eq!(film.pixels(), render(&scene, &options(1), &()).unwrap().pixels());
    assert!((0..sums.taken.len()).all(|pixel| sums.direct_mean(pixel) == Some(sums.mean(pixel))));
}
