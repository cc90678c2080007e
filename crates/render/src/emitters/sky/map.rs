//! Aiming at what is bright in an environment map.
//!
//! The map is divided in cells; the density of directions is the same everywhere in a cell and proportional to the mean
//! luminance there, as it is seen: bilinear between the middles of pixels. So no direction that gives light is left out.

use crate::textures::Environment;
use durer_math::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// The most cells along a side; pixels of larger maps share cells.
const MOST_COLUMNS: u32 = 4096;
const MOST_ROWS: u32 = 2048;

/// Chances of cells.
#[derive(Clone, Debug)]
pub(super) struct Map {
    columns: usize,
    /// For each row, from straight down to straight up, the chance of the rows below it; and 1.
    below: Vec<f64>,
    /// For each row, the chances of what is left of each cell but the first; and 1. Row after row.
    left: Vec<f32>,
    /// The mean luminance of all directions.
    mean: f64,
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
            let sum: f64 = cells.iter().sum();
            let mut before = 0.0;
            let part = |cell: &f64| {
                before += cell;
                if sum > 0.0 { (before / sum) as f32 } else { 0.0 }
            };
            let left: Vec<f32> = cells.iter().map(part).collect();
            (sum, left)
        };
        let rows: Vec<(f64, Vec<f32>)> = (0..rows as u32).into_par_iter().map(row).collect();
        let sum: f64 = rows.iter().map(|(sum, _)| sum).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let (mut below, mut before) = (Vec::with_capacity(rows.len()), 0.0);
        for (row, _) in &rows {
            before += row;
            below.push(before / sum);
        }
        let left = rows.into_iter().flat_map(|(_, left)| left).collect();
        // Each row weighs its cells by heights of bands, which are 2 in all.
        Some(Map { columns, below, left, mean: sum / (2.0 * f64::from(width)) })
    }

    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.left[row * self.columns..(row + 1) * self.columns]
    }

    /// A direction, and its density per solid angle.
    pub(super) fn sample(&self, environment: &Environment, at: DVec2) -> Option<(DVec3, f64)> {
        let row = self.below.partition_point(|&below| below <= at.y).min(self.below.len() - 1);
        let cells = self.row(row);
        let column = cells.partition_point(|&left| f64::from(left) <= at.x).min(self.columns - 1);
        let (row_from, row_chance) = self.row_chance(row);
        let (cell_from, cell_chance) = chance(cells, column);
        let within = |at: f64, from: f64, chance: f64| ((at - from) / chance).clamp(0.0, 1.0);
        let (low, high) = self.heights(environment, row);
        let y = low + (high - low) * within(at.y, row_from, row_chance);
        let [left, right] = self.sides(environment, column);
        let u = left + (right - left) * within(at.x, cell_from, cell_chance);
        let pdf = row_chance * cell_chance / ((high - low) * TAU * (right - left));
        (pdf > 0.0 && pdf.is_finite()).then(|| (environment.direction(u, y), pdf))
    }

    /// The density, per solid angle, with which [`Map::sample`] finds a direction.
    pub(super) fn pdf(&self, environment: &Environment, direction: DVec3) -> f64 {
        let [width, height] = environment.size();
        let [u, v] = environment.place(direction);
        let index = |part: f64, pixels: u32, most: u32, cells: usize| {
            let pixel = ((part * f64::from(pixels)) as usize).min(pixels as usize - 1);
            (pixel / pixels.div_ceil(most) as usize).min(cells - 1)
        };
        let column = index(u, width, MOST_COLUMNS, self.columns);
        let row = index(v, height, MOST_ROWS, self.below.len());
        let (_, row_chance) = self.row_chance(row);
        let (_, cell_chance) = chance(self.row(row), column);
        let (low, high) = self.heights(environment, row);
        let [left, right] = self.sides(environment, column);
        row_chance * cell_chance / ((high - low) * TAU * (right - left))
    }

    /// The chance of the rows below, and of this one.
    fn row_chance(&self, row: usize) -> (f64, f64) {
        let from = if row == 0 { 0.0 } else { self.below[row - 1] };
        (from, self.below[row] - from)
    }

    /// The y of the directions at the lower and the upper end of a row.
    fn heights(&self, environment: &Environment, row: usize) -> (f64, f64) {
        let [_, height] = environment.size();
        let step = height.div_ceil(MOST_ROWS) as usize;
        let end = |row: usize| ((row * step) as u32).min(height);
        (Environment::height_of(end(row), height), Environment::height_of(end(row + 1), height))
    }

    /// The left and the right end of a column, in parts of the width.
    fn sides(&self, environment: &Environment, column: usize) -> [f64; 2] {
        let [width, _] = environment.size();
        let step = width.div_ceil(MOST_COLUMNS) as usize;
        [column, column + 1].map(|column| f64::from(((column * step) as u32).min(width)) / f64::from(width))
    }
}

/// The chance of the cells to the left, and of this one.
fn chance(cells: &[f32], column: usize) -> (f64, f64) {
    let from = if column == 0 { 0.0 } else { f64::from(cells[column - 1]) };
    (from, f64::from(cells[column]) - from)
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
