//! All ways of anti-aliasing on pictures that are functions of place.

use super::adaptive::{Adaptive, small::SmallThings};
use super::alone::Alone;
use super::grid::Grid;
use super::pov::{Pov1, Pov2};
use super::recursive::Recursive;
use super::{Rows, Splat};
use crate::eye::{Eye, Look};
use crate::film::{Account, Region};
use crate::reconstruct::{Reconstruction, color_of};
use durer_math::functions::{atan2, cos, exp, sin};
use durer_math::{DVec2, Rgb};
use durer_scene::PixelFilter;
use std::sync::Mutex;

/// A gray picture, given by a function of place in pixels; notes where it is looked at.
struct Painted<F> {
    gray: F,
    has_things: bool,
    looked: Mutex<Vec<(u64, u64)>>,
}

impl<F: Fn(DVec2) -> f32 + Sync> Painted<F> {
    fn new(gray: F, has_things: bool) -> Painted<F> {
        Painted { gray, has_things, looked: Mutex::new(Vec::new()) }
    }
}

impl<F: Fn(DVec2) -> f32 + Sync> Eye for Painted<F> {
    fn looks(&self, points: &[DVec2], looks: &mut Vec<Look>, account: &mut Account) {
        account.rays.eye += points.len() as u64;
        self.looked.lock().unwrap().extend(points.iter().map(|at| (at.x.to_bits(), at.y.to_bits())));
        looks.extend(points.iter().map(|&at| {
            let gray = (self.gray)(at);
            let is_finite = gray.is_finite();
            let gray = if is_finite { gray } else { 0.0 };
            let color = Rgb::gray(gray);
            // What is white is a thing before what is black.
            let is_thing = self.has_things && gray > 0.5;
            let (seen, thing, depth) = ([gray; 3], u32::from(!is_thing), if is_thing { 0.5 } else { 1.0 });
            Look { color, seen, thing, piece: thing, hides: true, depth, normal: [0.0; 3], is_finite }
        }));
    }
}

const SIZE: u32 = 48;
const WHOLE: Region = Region { x: 0, y: 0, width: SIZE, height: SIZE };

/// What became of a picture: its pixels, row by row, and where was looked.
struct Made {
    pixels: Vec<f32>,
    looked: Vec<(u64, u64)>,
}

impl Made {
    fn by(eye: &Painted<impl Fn(DVec2) -> f32 + Sync>, rows: impl Rows, filter: PixelFilter) -> Made {
        let mut reconstruction = Reconstruction::new(rows, filter, WHOLE, (SIZE, SIZE));
        let mut pixels = Vec::new();
        let mut splats: Vec<Splat> = Vec::new();
        for band in WHOLE.bands() {
            assert!(reconstruction.sample(eye, band, &mut Account::default(), &|| false));
            for (x, y) in band.pixel_places() {
                reconstruction.splats(x, y, &mut splats);
                pixels.push(color_of(&splats).r);
            }
        }
        Made { pixels, looked: eye.looked.lock().unwrap().clone() }
    }

    fn pixel(&self, x: u32, y: u32) -> f32 {
        self.pixels[(y * SIZE + x) as usize]
    }

    fn rays_a_pixel(&self) -> f64 {
        self.looked.len() as f64 / f64::from(SIZE * SIZE)
    }

    fn error(&self, truth: &[f32]) -> f64 {
        let squares = self.pixels.iter().zip(truth).map(|(a, b)| f64::from(a - b) * f64::from(a - b));
        (squares.sum::<f64>() / truth.len() as f64).sqrt()
    }
}

fn adaptive(small: &SmallThings) -> Adaptive<'_> {
    Adaptive::new(0.03, 4, (SIZE, SIZE), small)
}

/// The means of pixels, by so many samples that their error does not matter.
fn truth(gray: impl Fn(DVec2) -> f32) -> Vec<f32> {
    const N: u32 = 64;
    let cells = || (0..N).map(|i| (f64::from(i) + 0.5) / f64::from(N));
    let mean = |(x, y): (u32, u32)| {
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let samples = cells().flat_map(|dy| cells().map(move |dx| corner + DVec2::new(dx, dy)));
        (samples.map(|at| f64::from(gray(at))).sum::<f64>() / f64::from(N * N)) as f32
    };
    WHOLE.pixel_places().map(mean).collect()
}

fn edges(at: DVec2) -> f32 {
    let mut gray = 0.2_f32;
    for (i, (angle, offset)) in [(0.3, 12.0), (1.1, 30.0), (2.2, 9.0), (0.05, 35.0), (1.5, 18.0)].iter().enumerate() {
        let (s, c) = (sin(*angle), cos(*angle));
        if at.x * c + at.y * s > *offset {
            gray = 1.0 - gray * (0.3 + 0.15 * i as f32);
        }
    }
    gray
}

fn star(at: DVec2) -> f32 {
    let from = at - DVec2::splat(24.3);
    let turn = atan2(from.y, from.x) / std::f64::consts::TAU * 18.0;
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
    let r2 = (at - DVec2::splat(24.0)).length_squared();
    (0.5 + 0.5 * cos(std::f64::consts::PI * r2 / 48.0)) as f32
}

/// The discs of [`discs`].
fn all_discs() -> impl Iterator<Item = (DVec2, f64)> {
    (0..SIZE / 4).flat_map(|y| (0..SIZE / 4).map(move |x| disc_of(DVec2::new(x.into(), y.into()))))
}

/// Of the methods to compare with: rays a pixel and error.
fn others(gray: impl Fn(DVec2) -> f32 + Sync + Copy, truth: &[f32]) -> [(f64, f64); 2] {
    let measured = |made: Made| (made.rays_a_pixel(), made.error(truth));
    let eye = || Painted::new(gray, false);
    let recursive = Alone::new(Recursive { threshold: 0.3, max_depth: 5 });
    let seed = measured(Made::by(&eye(), recursive, PixelFilter::Box));
    [seed, measured(Made::by(&eye(), Pov2::new(0.3, 5), PixelFilter::Box))]
}

#[test]
fn fewer_rays_than_others_and_less_error() {
    type Picture = fn(DVec2) -> f32;
    let pictures: [(&str, Picture); 4] =
        [("edges", edges), ("star", star), ("discs", discs), ("zone plate", zone_plate)];
    for (name, picture) in pictures {
        let truth = truth(picture);
        let has_things = name == "discs";
        let small = if has_things { SmallThings::discs(all_discs(), SIZE) } else { SmallThings::default() };
        let made = Made::by(&Painted::new(picture, has_things), adaptive(&small), PixelFilter::Box);
        let (rays, error) = (made.rays_a_pixel(), made.error(&truth));
        let [(seed_rays, seed_error), (pov_rays, pov_error)] = others(picture, &truth);
        assert!(rays <= seed_rays && error <= seed_error / 3.0, "{name}: {rays} {error}, not {seed_rays} {seed_error}");
        let of_pov_error = match name {
            "edges" => 1.0,
            "discs" => 0.2,
            _ => continue,
        };
        let is_better = rays <= pov_rays && error <= of_pov_error * pov_error;
        assert!(is_better, "{name}: {rays} {error}, not {pov_rays} {pov_error}");
    }
}

#[test]
fn no_ray_is_traced_twice() {
    let small = SmallThings::discs(all_discs(), SIZE);
    for picture in [discs, star, edges, zone_plate] {
        let mut looked = Made::by(&Painted::new(picture, true), adaptive(&small), PixelFilter::Box).looked;
        let count = looked.len();
        looked.sort_unstable();
        looked.dedup();
        assert_eq!(looked.len(), count);
    }
}

#[test]
fn an_even_picture_takes_two_rays_a_pixel_and_is_exact() {
    let small = SmallThings::default();
    let ramp = |at: DVec2| (0.01 * at.x + 0.005 * at.y) as f32;
    let made = Made::by(&Painted::new(ramp, false), adaptive(&small), PixelFilter::Box);
    assert_eq!(made.looked.len() as u32, SIZE * SIZE + (SIZE + 1) * (SIZE + 1));
    for (x, y) in WHOLE.pixel_places() {
        let middle = ramp(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        assert!((made.pixel(x, y) - middle).abs() < 1e-6);
    }
}

/// The part of a pixel on one side of a line, by clipping its square.
fn covered(x: u32, y: u32, normal: DVec2, offset: f64) -> f64 {
    let (x, y) = (f64::from(x), f64::from(y));
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(dx, dy)| DVec2::new(x + dx, y + dy));
    let height = |p: DVec2| p.dot(normal) - offset;
    let mut kept = Vec::new();
    for i in 0..4 {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        if height(a) <= 0.0 {
            kept.push(a);
        }
        if (height(a) <= 0.0) != (height(b) <= 0.0) {
            kept.push(a + (b - a) * (height(a) / (height(a) - height(b))));
        }
    }
    let turned = kept.iter().cycle().skip(1);
    kept.iter().zip(turned).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs() * 0.5
}

#[test]
fn straight_edges_are_as_exact_as_their_ends_are_found() {
    let small = SmallThings::default();
    for turn in 0..24 {
        let angle = 0.05 + 0.261 * f64::from(turn);
        let normal = DVec2::new(cos(angle), sin(angle));
        let offset = DVec2::splat(24.0).dot(normal) + 0.37;
        let half = |at: DVec2| if at.dot(normal) <= offset { 1.0 } else { 0.0 };
        let made = Made::by(&Painted::new(half, false), adaptive(&small), PixelFilter::Box);
        assert!(made.rays_a_pixel() < 2.6, "{}", made.rays_a_pixel());
        for (x, y) in WHOLE.pixel_places() {
            let (found, exact) = (f64::from(made.pixel(x, y)), covered(x, y, normal, offset));
            // Where a line cuts off less of a pixel than its samples see, it may be missed: an eighth of a side squared.
            assert!((found - exact).abs() < 0.008, "({x}, {y}) at {angle}: {found}, not {exact}");
        }
    }
}

#[test]
fn arcs_are_areas() {
    let small = SmallThings::default();
    for radius in [0.8, 1.3, 2.0, 5.0, 15.0] {
        let center = DVec2::new(24.2, 23.7);
        let disc = |at: DVec2| if (at - center).length() < radius { 1.0 } else { 0.0 };
        let made = Made::by(&Painted::new(disc, false), adaptive(&small), PixelFilter::Box);
        let area: f64 = made.pixels.iter().map(|&p| f64::from(p)).sum();
        let exact = std::f64::consts::PI * radius * radius;
        // So far off is the edge in the mean, in pixels.
        let off = (area - exact) / (std::f64::consts::TAU * radius);
        assert!(off.abs() < 0.005, "{radius}: {area}, not {exact}");
    }
}

/// However small, a disc leaves a trace.
#[test]
fn no_small_disc_is_missed() {
    for radius in [0.4, 0.2, 0.1, 0.05, 0.02, 0.01] {
        let center = |square: DVec2| disc_of(square).0;
        let disc = |at: DVec2| if (at - center((at / 4.0).floor())).length() < radius { 1.0 } else { 0.0 };
        let small = SmallThings::discs(all_discs().map(|(at, _)| (at, radius)), SIZE);
        let made = Made::by(&Painted::new(disc, true), adaptive(&small), PixelFilter::Box);
        for (at, _) in all_discs() {
            let (x, y) = (at.x as u32, at.y as u32);
            let around = WHOLE.pixel_places().filter(|&(a, b)| a.abs_diff(x) <= 1 && b.abs_diff(y) <= 1);
            let light: f32 = around.map(|(x, y)| made.pixel(x, y)).sum();
            assert!(light > 0.0, "a disc of radius {radius} at {at}");
        }
    }
}

/// Of a surface that ends on a line down the middle of the picture, a pixel sees what the filter has on its side.
#[test]
fn filters_weigh_an_edge_as_their_integrals_say() {
    /// From minus infinity to x, of the whole.
    fn integral(kernel: impl Fn(f64) -> f64, x: f64) -> f64 {
        let sum = |to: f64| {
            const STEPS: i32 = 4000;
            let step = (to + 4.0) / f64::from(STEPS);
            (0..STEPS).map(|i| kernel(-4.0 + (f64::from(i) + 0.5) * step)).sum::<f64>() * step
        };
        sum(x) / sum(4.0)
    }
    let tent = |x: f64| (1.0 - x.abs()).max(0.0);
    let bell = |x: f64| {
        let at = |x: f64| f64::from(exp((-x * x / 0.5) as f32));
        if x.abs() < 1.5 { at(x) - at(1.5) } else { 0.0 }
    };
    // The general form, with B = C = 1/3.
    let mitchell = |x: f64| {
        let (b, c, x) = (1.0 / 3.0, 1.0 / 3.0, x.abs());
        if x < 1.0 {
            (12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x + (6.0 - 2.0 * b)
        } else if x < 2.0 {
            (-b - 6.0 * c) * x * x * x
                + (6.0 * b + 30.0 * c) * x * x
                + (-12.0 * b - 48.0 * c) * x
                + (8.0 * b + 24.0 * c)
        } else {
            0.0
        }
    };
    type Kernel<'a> = (PixelFilter, &'a dyn Fn(f64) -> f64);
    let kernels: [Kernel<'_>; 3] = [
        (PixelFilter::Tent { radius: 1.0 }, &tent),
        (PixelFilter::Gaussian { radius: 1.5, sigma: 0.5 }, &bell),
        (PixelFilter::Mitchell { radius: 2.0 }, &mitchell),
    ];
    let half = |at: DVec2| if at.x < 24.0 { 1.0 } else { 0.0 };
    for (filter, kernel) in kernels {
        let made = Made::by(&Painted::new(half, false), Alone::new(Grid::new(16)), filter);
        for x in 20..28 {
            let (found, exact) = (f64::from(made.pixel(x, 9)), integral(kernel, 24.0 - f64::from(x) - 0.5));
            assert!((found - exact).abs() < 2e-3, "{filter:?} {x}: {found}, not {exact}");
        }
    }
}

#[test]
fn no_filter_changes_an_even_surface() {
    let filters = [
        PixelFilter::Box,
        PixelFilter::Tent { radius: 1.7 },
        PixelFilter::Gaussian { radius: 3.0, sigma: 1.0 },
        PixelFilter::Mitchell { radius: 2.0 },
        PixelFilter::BlackmanHarris { radius: 1.5 },
    ];
    let small = SmallThings::default();
    for filter in filters {
        let made = Made::by(&Painted::new(|_| 0.7, false), adaptive(&small), filter);
        assert!(made.pixels.iter().all(|pixel| (pixel - 0.7).abs() < 1e-6), "{filter:?}");
    }
}

/// The most rays that methods 1 and 2 take in a pixel: their manual's numbers, less what it has wrong.
#[test]
fn the_methods_of_pov_ray_take_as_many_rays_as_they_do_there() {
    let noise = |at: DVec2| (sin(at.x * 12.9898 + at.y * 78.233) * 43758.5453).rem_euclid(1.0) as f32;
    for (depth, rays) in [(1, 4), (2, 9), (3, 25), (4, 81)] {
        let made = Made::by(&Painted::new(noise, false), Pov2::new(0.0, depth), PixelFilter::Box);
        // Corners are shared, all else is the pixel's own.
        assert_eq!(made.looked.len() as u32, (SIZE + 1) * (SIZE + 1) + SIZE * SIZE * (rays - 4), "depth {depth}");
    }
    for depth in [1, 3] {
        let made = Made::by(&Painted::new(noise, false), Pov1::new(0.0, depth, (SIZE, SIZE)), PixelFilter::Box);
        assert_eq!(made.looked.len() as u32, SIZE * SIZE * (1 + depth * depth), "depth {depth}");
    }
}

/// A sample that is no number leaves the pixel to the others.
#[test]
fn what_is_not_finite_is_left_out() {
    let small = SmallThings::default();
    let hole = |at: DVec2| if (at - DVec2::splat(20.5)).length() < 0.1 { f32::NAN } else { 0.25 };
    let broken = Made::by(&Painted::new(hole, false), adaptive(&small), PixelFilter::Box);
    assert!(broken.pixels.iter().all(|pixel| (pixel - 0.25).abs() < 1e-6));
    let grid = Made::by(&Painted::new(hole, false), Alone::new(Grid::new(3)), PixelFilter::Tent { radius: 1.0 });
    assert!(grid.pixels.iter().all(|pixel| (pixel - 0.25).abs() < 1e-6));
}
