//! Where samples go: rare light is found, parts of a picture are those of the whole, and cells stop when their neighbors agree.

use super::*;
use crate::compile::compile;
use crate::film::{SampleRange, SampledTile};
use crate::holes::Known;
use crate::integrators::Integrator;
use crate::observer::Observer;
use crate::passes::{Goal, render_samples};
use crate::sampler::{Purpose, Sampler};
use crate::schedule::{Progress, RenderOptions, render, render_on};
use durer_geometry::Ray;
use durer_math::{DVec3, Rgb};
use durer_scene::{Background, Object, ObjectKind, Picture, Scene, Shape};
use std::sync::atomic::{AtomicU64, Ordering};

fn scene(width: u32, height: u32, noise: f32, samples: u32) -> CompiledScene {
    let mut scene = Scene {
        background: Background::Color(Rgb::new(1.0, 0.5, 0.25)),
        objects: vec![Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))],
        picture: Picture { width, height, ..Picture::default() },
        ..Scene::default()
    };
    scene.render.integrator =
        durer_scene::Integrator::Path(durer_scene::PathSettings { max_depth: 4, ..Default::default() });
    (scene.render.samples, scene.render.noise) = (Some(samples), Some(noise));
    compile(&scene.check().unwrap())
}

/// Light that one sample in a thousand meets, and nothing else.
struct Rare;

impl Rare {
    const CHANCE: f64 = 1e-3;
    const LIGHT: f32 = 1500.0;
}

impl Integrator for Rare {
    fn radiance<O: Observer>(&self, _: &CompiledScene, _: &Ray, _: Known<'_>, sampler: &Sampler, _: &mut O) -> Rgb {
        // Fractions of large multiples know nothing of how evenly the numbers themselves are spread.
        let at = sampler.two(1, Purpose::Direction);
        let mixed = at.x * 7919.0 + at.y * 104_729.0 + sampler.one(1, Purpose::Lobe) * 1_299_709.0;
        if mixed - mixed.floor() < Rare::CHANCE { Rgb::gray(Rare::LIGHT) } else { Rgb::BLACK }
    }
}

/// Most cells meet none of it with their first 16 samples, which was once taken for an end.
#[test]
fn rare_light_is_not_missed() {
    let (width, height) = (40, 24);
    let scene = scene(width, height, 1.0, 4096);
    let samples = SampleRange { start: 0, end: 4096 };
    let mut film = Film::of_samples(Region { x: 0, y: 0, width, height }, samples, false);
    render_samples((&scene, &Rare), Goal { samples, noise: Some(1.0), time: None }, &mut film, &());
    let pixels = film.pixels();
    let mean = pixels.iter().map(|pixel| f64::from(pixel.r)).sum::<f64>() / pixels.len() as f64;
    let truth = Rare::CHANCE * f64::from(Rare::LIGHT);
    let dark = film
        .region()
        .cells(CELL)
        .filter(|cell| cell.pixel_places().all(|(x, y)| film.pixels()[film.region().index_of(x, y)].is_black()));
    assert_eq!(dark.count(), 0, "cells without light");
    assert!((mean / truth - 1.0).abs() < 0.15, "{mean} in place of {truth}");
}

/// Crops that no grid knows of, stopped anywhere.
#[test]
fn any_part_is_that_part_of_the_whole() {
    let scene = scene(61, 47, 0.02, 400);
    let options = |region| RenderOptions { threads: Some(2), region, ..RenderOptions::default() };
    let whole = render(&scene, &options(None), &()).unwrap();
    let (least, most) = whole.sums().unwrap().least_and_most();
    assert!(least == 64 && most > 96, "{least} {most}");
    let region = |x, y, width, height| Region { x, y, width, height };
    let parts = [region(8, 16, 40, 24), region(19, 13, 9, 21), region(60, 46, 1, 1), region(0, 5, 61, 3)];
    for part in parts {
        let alone = render(&scene, &options(Some(part)), &()).unwrap();
        for (x, y) in part.pixel_places() {
            let (own, other) = (part.index_of(x, y), whole.region().index_of(x, y));
            let taken = |film: &Film, pixel: usize| {
                film.sums().map(|sums| (sums.taken[pixel], sums.colors[pixel], sums.squares[pixel]))
            };
            assert_eq!(taken(&alone, own), taken(&whole, other), "{part:?}: {x},{y}");
        }
        for tiles in [3, 12] {
            let stopped = render(&scene, &options(Some(part)), &After(AtomicU64::new(tiles))).unwrap();
            assert_eq!(render_on(&scene, stopped, &options(None), &()).unwrap(), alone);
        }
    }
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

/// A film of 5 × 5 cells. Those that are noisy have bright light in every other sample of the first of their pixels.
struct Made {
    film: Film,
    picture: (u32, u32),
}

impl Made {
    fn new() -> Made {
        let region = Region { x: 0, y: 0, width: 40, height: 40 };
        let samples = SampleRange { start: 0, end: 1000 };
        Made { film: Film::of_samples(region, samples, false), picture: (40, 40) }
    }

    /// Takes what the goals say, and gives the cells that were sampled.
    fn pass(&mut self, noisy: &[(u32, u32)]) -> Vec<(u32, u32)> {
        let noise = Noise { exposure: 1.0, target: 0.05 };
        noise.look_at(&mut self.film);
        let around = Around::nothing();
        let Some((goals, _)) = Cells::new(noise, &self.film, &around, self.picture).unwrap().goals(1000, u64::MAX)
        else {
            return Vec::new();
        };
        let region = self.film.region();
        let taken = self.film.sums().unwrap().taken.clone();
        let mut pixels = Vec::new();
        for (at, (x, y)) in region.pixel_places().enumerate() {
            let mut pixel = crate::film::PixelSums::default();
            let is_noisy = noisy.contains(&(x / CELL, y / CELL)) && x % CELL == 0 && y % CELL == 0;
            for n in taken[at]..goals[at] {
                let color = if is_noisy && n % 2 == 0 { Rgb::gray(100.0) } else { Rgb::gray(0.5) };
                pixel.add(color, Rgb::BLACK, false).unwrap();
            }
            pixels.push(pixel);
        }
        self.film.add(&SampledTile { region, pixels, account: Default::default() });
        let sampled = region.cells(CELL).filter(|cell| {
            let pixel = region.index_of(cell.x, cell.y);
            taken[pixel] < goals[pixel]
        });
        sampled.map(|cell| (cell.x / CELL, cell.y / CELL)).collect()
    }
}

#[test]
fn neighbors_of_noise_go_on_and_others_stop() {
    let mut made = Made::new();
    // 1, 2, 4, 8, 16, 32, 64: the same everywhere.
    for _ in 0..7 {
        assert_eq!(made.pass(&[(1, 1), (4, 2)]).len(), 25);
    }
    let around: Vec<(u32, u32)> = [
        (0, 0),
        (1, 0),
        (2, 0),
        (0, 1),
        (1, 1),
        (2, 1),
        (3, 1),
        (4, 1),
        (0, 2),
        (1, 2),
        (2, 2),
        (3, 2),
        (4, 2),
        (3, 3),
        (4, 3),
    ]
    .to_vec();
    for _ in 0..4 {
        assert_eq!(made.pass(&[(1, 1), (4, 2)]), around);
    }
    // What was noise is none; the mean of more and more samples knows it in the end, and all of it stops.
    let mut passes = 0;
    while !made.pass(&[]).is_empty() {
        passes += 1;
    }
    let (least, most) = made.film.sums().unwrap().least_and_most();
    assert!(passes >= 2 && least == 64 && (200..1000).contains(&most), "{passes} {least} {most}");
}

/// A cell that was calm for one pass only is not calm; and one that was once calm in two lets its neighbors rest, though it
/// goes on itself.
#[test]
fn calm_is_two_passes_running() {
    let noise = Noise { exposure: 1.0, target: 0.05 };
    let sums_of = |spread: f32| {
        let region = Region { x: 0, y: 0, width: 1, height: 1 };
        let mut film = Film::of_samples(region, SampleRange { start: 0, end: 9 }, false);
        let mut pixel = crate::film::PixelSums::default();
        for n in 0..32 {
            pixel.add(Rgb::gray(if n % 2 == 0 { 0.5 + spread } else { 0.5 - spread }), Rgb::BLACK, false).unwrap();
        }
        film.add(&SampledTile { region, pixels: vec![pixel], account: Default::default() });
        film.sums().unwrap().clone()
    };
    let (calm, noisy) = (sums_of(0.01), sums_of(0.45));
    let mut state = Calm::default();
    let mut next = |sums: &Sums, samples: u32| {
        state = noise.judged(state, sums, samples, 0..1);
        (state.passes, state.first)
    };
    assert_eq!(next(&calm, 16), (0, 0), "too early to tell");
    assert_eq!(next(&calm, 32), (1, 0));
    assert_eq!(next(&calm, 32), (1, 0), "the same look");
    assert_eq!(next(&noisy, 64), (0, 0));
    assert_eq!(next(&calm, 96), (1, 0));
    assert_eq!(next(&calm, 128), (2, 128));
    assert_eq!(next(&noisy, 160), (0, 128));
}
