//! Aiming at what is bright in an environment map.
//!
//! The map is divided in cells, each of which is chosen as often as it gives light, as it is seen: bilinear between the middles of
//! pixels. So no direction that gives light is left out. Within a cell places of the picture are all alike.
//!
//! Cells are found by the inverse of their distribution, so that well distributed numbers become well distributed places. It is
//! kept in few bits, for what takes the time is waiting for memory.

use crate::textures::Environment;
use durer_math::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// The most cells along a side; pixels of larger maps share cells.
const MOST_COLUMNS: u32 = 4096;
const MOST_ROWS: u32 = 2048;

/// Chances of cells.
#[derive(Clone, Debug)]
pub(super) struct Map {
    /// Of rows, from straight down to straight up.
    rows: Steps,
    /// Of the cells of each row.
    cells: Vec<Steps>,
    /// The mean luminance of all directions.
    mean: f64,
}

/// A distribution of whole numbers from 0, in parts of [`ALL`]: what is above 0 has a part at least.
#[derive(Clone, Debug)]
struct Steps {
    /// The parts of each number and those before it; whole blocks, and [`ALL`] at the end.
    ends: Box<[u16]>,
    /// The last of each block.
    blocks: Box<[u16]>,
}

/// All parts of a distribution.
const ALL: u16 = u16::MAX;
/// So many numbers are a cache line.
const BLOCK: usize = 32;

impl Steps {
    /// One that is proportional to these weights, none of which is negative, and no more than [`MOST_COLUMNS`].
    fn new(weights: &[f64]) -> Steps {
        let all: f64 = weights.iter().sum();
        let something = weights.iter().filter(|&&weight| weight > 0.0).count();
        // A part for each that is something; the rest by weight.
        let rest = f64::from(ALL) - something as f64;
        let (mut parts, mut sum) = (0.0, 0.0);
        let mut ends: Vec<u16> = Vec::with_capacity(weights.len().next_multiple_of(BLOCK));
        for &weight in weights {
            parts += f64::from(u8::from(weight > 0.0));
            sum += weight;
            ends.push((parts + (sum / all * rest).floor().clamp(0.0, rest)) as u16);
        }
        if let Some(last) = weights.iter().rposition(|&weight| weight > 0.0) {
            ends[last..].fill(ALL);
        }
        ends.resize(weights.len().next_multiple_of(BLOCK), ALL);
        let blocks = ends.chunks(BLOCK).filter_map(|block| block.last().copied()).collect();
        Steps { ends: ends.into(), blocks }
    }

    /// The number that one from 0 to less than 1 chooses, what is left of that one, from 0 to 1, and the chance.
    #[inline]
    fn choose(&self, at: f64) -> (usize, f64, f64) {
        let at = at * f64::from(ALL);
        let whole = (at as u16).min(ALL - 1);
        // All are looked at, which is faster than to stop at the right one.
        let below = |ends: &[u16]| usize::from(ends.iter().map(|&end| u16::from(end <= whole)).sum::<u16>());
        let block = below(&self.blocks) * BLOCK;
        let chosen = block + below(&self.ends[block..block + BLOCK]);
        let from = self.from(chosen);
        let parts = f64::from(self.ends[chosen] - from);
        (chosen, ((at - f64::from(from)) / parts).clamp(0.0, 1.0), parts / f64::from(ALL))
    }

    /// The chance of a number.
    #[inline]
    fn chance(&self, number: usize) -> f64 {
        f64::from(self.ends[number] - self.from(number)) / f64::from(ALL)
    }

    fn from(&self, number: usize) -> u16 {
        if number == 0 { 0 } else { self.ends[number - 1] }
    }
}

impl Map {
    /// `None` if there is no light in it.
    pub(super) fn new(environment: &Environment) -> Option<Map> {
        let [width, height] = environment.size();
        let (across, up) = (width.div_ceil(MOST_COLUMNS), height.div_ceil(MOST_ROWS));
        let (columns, rows) = (width.div_ceil(across) as usize, height.div_ceil(up) as usize);
        let row = |row: u32| {
            let mut cells = vec![0.0_f64; columns];
            for at in row * up..((row + 1) * up).min(height) {
                let band = band(at, height);
                add_row(environment, at, &mut cells, across, band);
            }
            (cells.iter().sum(), Steps::new(&cells))
        };
        let rows: Vec<(f64, Steps)> = (0..rows as u32).into_par_iter().map(row).collect();
        let (light, cells): (Vec<f64>, Vec<Steps>) = rows.into_iter().unzip();
        let sum: f64 = light.iter().sum();
        // Each row weighs its cells by heights of bands, which are 2 in all.
        let mean = sum / (2.0 * f64::from(width));
        (sum > 0.0 && sum.is_finite()).then(|| Map { rows: Steps::new(&light), cells, mean })
    }

    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    /// A place of the picture, the direction there, and its density per solid angle.
    pub(super) fn sample(&self, environment: &Environment, at: DVec2) -> Option<([f64; 2], DVec3, f64)> {
        let (row, from_below, row_chance) = self.rows.choose(at.y);
        let (column, from_left, cell_chance) = self.cells[row].choose(at.x);
        let [across, up] = sides(environment, column, row);
        let within = |[low, high]: [f64; 2], part: f64| low + (high - low) * part;
        let place = [within(across, from_left), within(up, from_below)];
        let (direction, radius) = environment.direction(place);
        let pdf = row_chance * cell_chance / solid_angle(across, up, radius);
        (pdf > 0.0 && pdf.is_finite()).then_some((place, direction, pdf))
    }

    /// The density, per solid angle, with which [`Map::sample`] finds the direction that is at a place of the picture.
    pub(super) fn pdf(&self, environment: &Environment, [u, v]: [f64; 2], direction: DVec3) -> f64 {
        let [width, height] = environment.size();
        let index = |part: f64, pixels: u32, most: u32| {
            let pixel = ((part * f64::from(pixels)) as u32).min(pixels - 1);
            (pixel / pixels.div_ceil(most)) as usize
        };
        let (column, row) = (index(u, width, MOST_COLUMNS), index(v, height, MOST_ROWS));
        let [across, up] = sides(environment, column, row);
        let chance = self.rows.chance(row) * self.cells[row].chance(column);
        chance / solid_angle(across, up, DVec2::new(direction.x, direction.z).length())
    }
}

/// The ends of a column and of a row of cells, in parts of the picture.
fn sides(environment: &Environment, column: usize, row: usize) -> [[f64; 2]; 2] {
    let [width, height] = environment.size();
    let ends = |cell: usize, pixels: u32, most: u32| {
        let step = pixels.div_ceil(most) as usize;
        [cell, cell + 1].map(|cell| f64::from(((cell * step) as u32).min(pixels)) / f64::from(pixels))
    };
    [ends(column, width, MOST_COLUMNS), ends(row, height, MOST_ROWS)]
}

/// What a cell between these sides fills, as places of the picture count at a direction with so long a part across the
/// vertical: straight up and down many places are one direction, and a little more than none keeps densities finite.
fn solid_angle([left, right]: [f64; 2], [low, high]: [f64; 2], radius: f64) -> f64 {
    TAU * (right - left) * PI * (high - low) * radius.max(1e-9)
}

/// How far a row of pixels reaches in y.
fn band(row: u32, height: u32) -> f64 {
    Environment::height_of(row + 1, height) - Environment::height_of(row, height)
}

/// Adds what is seen in a row of pixels to cells of `across` pixels each. The mean of what is bilinear between the middles of
/// pixels, over one of them, is 3/4 of its own and 1/8 of each neighbor's, in both directions.
fn add_row(environment: &Environment, row: u32, cells: &mut [f64], across: u32, band: f64) {
    let [width, height] = environment.size();
    let luminance = |column: u32, row: u32| {
        let seen = f64::from(environment.pixel(column, row).luminance());
        if seen > 0.0 && seen.is_finite() { seen } else { 0.0 }
    };
    let (lower, upper) = (row.saturating_sub(1), (row + 1).min(height - 1));
    let column = |at: u32| 0.125 * luminance(at, lower) + 0.75 * luminance(at, row) + 0.125 * luminance(at, upper);
    let (mut before, mut here) = (column(width - 1), column(0));
    let first = here;
    for at in 0..width {
        let after = if at + 1 < width { column(at + 1) } else { first };
        cells[(at / across) as usize] += (0.125 * before + 0.75 * here + 0.125 * after) * band;
        (before, here) = (here, after);
    }
}
