//! All ways of anti-aliasing on pictures that are functions of place.

use super::Rows;
use super::adaptive::{Adaptive, small::SmallThings};
use super::alone::Alone;
use super::grid::Grid;
use super::pov::{Pov1, Pov2};
use super::recursive::Recursive;
use crate::eye::{Eye, Look};
use crate::film::{Account, Region};
use crate::reconstruct::{Reconstruction, color_of};
use durer_math::functions::{atan2, cos, sin};
use durer_math::{DVec2, Rgb};
use durer_scene::PixelFilter;
use std::sync::Mutex;

/// A gray picture, given by a function of place in pixels; notes where it is looked at.
struct Painted<F> {
    gray: F,
    is_deep: bool,
    looked: Mutex<Vec<(u64, u64)>>,
}

impl<F: Fn(DVec2) -> f32 + Sync> Painted<F> {
    fn new(gray: F, is_deep: bool) -> Painted<F> {
        Painted { gray, is_deep, looked: Mutex::new(Vec::new()) }
    }
}

impl<F: Fn(DVec2) -> f32 + Sync> Eye for Painted<F> {
    fn looks(&self, points: &[DVec2], looks: &mut Vec<Look>, account: &mut Account) {
        account.rays.eye += points.len() as u64;
        self.looked.lock().unwrap().extend(points.iter().map(|at| (at.x.to_bits(), at.y.to_bits())));
        looks.extend(points.iter().map(|&at| {
            let gray = (self.gray)(at);
            let color = Rgb::gray(gray);
            // What is white lies before what is black.
            let (seen, depth) = ([gray; 3], if self.is_deep { 1.0 - 0.5 * gray } else { 1.0 });
            Look { color, seen, thing: 0, depth, normal: [0.0; 3], is_finite: gray.is_finite() }
        }));
    }
}

const SIZE: u32 = 96;

/// Rays a pixel, and the root of the mean square error.
fn measure(gray: impl Fn(DVec2) -> f32 + Sync, is_deep: bool, truth: &[f32], rows: impl Rows) -> (f64, f64) {
    let whole = Region { x: 0, y: 0, width: SIZE, height: SIZE };
    let eye = Painted::new(gray, is_deep);
    let mut account = Account::default();
    let mut reconstruction = Reconstruction::new(rows, PixelFilter::Box, whole, (SIZE, SIZE));
    let mut splats = Vec::new();
    let mut squares = 0.0;
    for band in whole.bands() {
        assert!(reconstruction.sample(&eye, band, &mut account, &|| false));
        for (x, y) in band.pixel_places() {
            reconstruction.splats(x, y, &mut splats);
            let error = f64::from(color_of(&splats).r - truth[(y * SIZE + x) as usize]);
            squares += error * error;
        }
    }
    let pixels = f64::from(SIZE * SIZE);
    (account.rays.eye as f64 / pixels, (squares / pixels).sqrt())
}

fn truth(gray: impl Fn(DVec2) -> f32) -> Vec<f32> {
    const N: u32 = 64;
    let whole = Region { x: 0, y: 0, width: SIZE, height: SIZE };
    let mean = |(x, y): (u32, u32)| {
        let mut sum = 0.0;
        for row in 0..N {
            for column in 0..N {
                let within = DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) / f64::from(N);
                sum += f64::from(gray(DVec2::new(f64::from(x), f64::from(y)) + within));
            }
        }
        (sum / f64::from(N * N)) as f32
    };
    whole.pixel_places().map(mean).collect()
}

fn edges(at: DVec2) -> f32 {
    let mut gray = 0.2_f32;
    for (i, (angle, offset)) in [(0.3, 20.0), (1.1, 55.0), (2.2, 15.0), (0.05, 70.0), (1.5, 30.0)].iter().enumerate() {
        let (s, c) = (sin(*angle), cos(*angle));
        if at.x * c + at.y * s > *offset {
            gray = 1.0 - gray * (0.3 + 0.15 * i as f32);
        }
    }
    gray
}

fn star(at: DVec2) -> f32 {
    let from = at - DVec2::splat(48.3);
    let turn = atan2(from.y, from.x) / std::f64::consts::TAU * 36.0;
    if turn.rem_euclid(1.0) < 0.5 { 1.0 } else { 0.0 }
}

fn discs(at: DVec2) -> f32 {
    let (center, radius) = disc_of((at / 4.0).floor());
    if (at - center).length() < radius { 1.0 } else { 0.0 }
}

/// One disc in each square of 4, somewhere.
fn disc_of(square: DVec2) -> (DVec2, f64) {
    let DVec2 { x: column, y: row } = square;
    let noise = |k: f64| (sin(column * 127.1 + row * 311.7 + k * 74.7) * 43758.5453).rem_euclid(1.0);
    let center = DVec2::new(column * 4.0 + 0.7 + 2.6 * noise(1.0), row * 4.0 + 0.7 + 2.6 * noise(2.0));
    (center, 0.1 + 0.5 * noise(3.0))
}

fn zone_plate(at: DVec2) -> f32 {
    let r2 = (at - DVec2::splat(48.0)).length_squared();
    (0.5 + 0.5 * cos(std::f64::consts::PI * r2 / 96.0)) as f32
}

#[test]
#[ignore = "prints a table"]
fn table() {
    type Picture = fn(DVec2) -> f32;
    let pictures: [(&str, Picture); 4] =
        [("edges", edges), ("star", star), ("discs", discs), ("zone plate", zone_plate)];
    let none = SmallThings::default();
    let squares = (0..SIZE / 4).flat_map(|y| (0..SIZE / 4).map(move |x| DVec2::new(x.into(), y.into())));
    let all_discs = SmallThings::discs(squares.map(disc_of), SIZE);
    let size = (SIZE, SIZE);
    for (name, picture) in pictures {
        let truth = truth(picture);
        let show = |mode: &str, (rays, error): (f64, f64)| println!("{name:<12} {mode:<24} {rays:8.2} {error:.5}");
        show("none", measure(picture, name == "discs", &truth, Alone::new(Grid { n: 1 })));
        show("grid 4", measure(picture, name == "discs", &truth, Alone::new(Grid { n: 4 })));
        for max_depth in [1, 5] {
            let rows = Alone::new(Recursive { threshold: 0.3, max_depth });
            show(&format!("recursive {max_depth}"), measure(picture, name == "discs", &truth, rows));
        }
        for depth in [3, 5] {
            show(&format!("pov1 {depth}"), measure(picture, name == "discs", &truth, Pov1::new(0.3, depth, size)));
            show(&format!("pov2 {depth}"), measure(picture, name == "discs", &truth, Pov2::new(0.3, depth)));
        }
        for (threshold, max_depth) in [(0.03, 1), (0.03, 4), (0.05, 2), (0.05, 3), (0.3, 4)] {
            let small = if name == "discs" { &all_discs } else { &none };
            let rows = Adaptive::new(threshold, max_depth, size, small);
            show(&format!("adaptive {threshold} {max_depth}"), measure(picture, name == "discs", &truth, rows));
        }
    }
}
