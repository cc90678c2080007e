//! Aiming at what is bright in an environment map.
//!
//! The map is divided in cells, each of which is chosen as often as it gives light, as it is seen: bilinear between the middles of
//! pixels. So no direction that gives light is left out. Within a cell places of the picture are all alike.
//!
//! Cells are found by the inverse of their distribution, so that well distributed numbers become well distributed places, from
//! where a table says (Chen and Asau, "On Generating Random Variates from an Empirical Distribution", AIIE Transactions 6(2), 1974).

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
    columns: usize,
    /// For each row, from straight down to straight up, the chance of the rows below it; and 1.
    below: Vec<f64>,
    /// For each row, the chances of what is left of each cell but the first; and 1. Row after row.
    left: Vec<f32>,
    /// Where to look for the row of a number.
    row_guide: Vec<u16>,
    /// Where to look for the column of a number. Row after row.
    column_guides: Vec<u16>,
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
        let left: Vec<f32> = rows.into_iter().flat_map(|(_, left)| left).collect();
        let row_guide = guide(below.iter().copied()).collect();
        let column_guides =
            left.chunks(columns).flat_map(|row| guide(row.iter().map(|&left| f64::from(left)))).collect();
        // Each row weighs its cells by heights of bands, which are 2 in all.
        let mean = sum / (2.0 * f64::from(width));
        Some(Map { columns, below, left, row_guide, column_guides, mean })
    }

    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.left[row * self.columns..(row + 1) * self.columns]
    }

    /// A place of the picture, the direction there, and its density per solid angle.
    pub(super) fn sample(&self, environment: &Environment, at: DVec2) -> Option<([f64; 2], DVec3, f64)> {
        let row = find(&self.row_guide, at.y, |row| self.below[row]);
        let cells = self.row(row);
        let guide = &self.column_guides[row * self.columns..(row + 1) * self.columns];
        let column = find(guide, at.x, |column| f64::from(cells[column]));
        let (row_from, row_chance) = self.row_chance(row);
        let (cell_from, cell_chance) = chance(cells, column);
        let within = |[low, high]: [f64; 2], at: f64, from: f64, chance: f64| {
            low + (high - low) * ((at - from) / chance).clamp(0.0, 1.0)
        };
        let [across, up] = self.sides(environment, column, row);
        let place = [within(across, at.x, cell_from, cell_chance), within(up, at.y, row_from, row_chance)];
        let (direction, radius) = environment.direction(place);
        let pdf = row_chance * cell_chance / solid_angle(across, up, radius);
        (pdf > 0.0 && pdf.is_finite()).then_some((place, direction, pdf))
    }

    /// The density, per solid angle, with which [`Map::sample`] finds the direction that is at a place of the picture.
    pub(super) fn pdf(&self, environment: &Environment, [u, v]: [f64; 2], direction: DVec3) -> f64 {
        let [width, height] = environment.size();
        let index = |part: f64, pixels: u32, most: u32, cells: usize| {
            let pixel = ((part * f64::from(pixels)) as usize).min(pixels as usize - 1);
            (pixel / pixels.div_ceil(most) as usize).min(cells - 1)
        };
        let column = index(u, width, MOST_COLUMNS, self.columns);
        let row = index(v, height, MOST_ROWS, self.below.len());
        let (_, row_chance) = self.row_chance(row);
        let (_, cell_chance) = chance(self.row(row), column);
        let [across, up] = self.sides(environment, column, row);
        row_chance * cell_chance / solid_angle(across, up, DVec2::new(direction.x, direction.z).length())
    }

    /// The chance of the rows below, and of this one.
    fn row_chance(&self, row: usize) -> (f64, f64) {
        let from = if row == 0 { 0.0 } else { self.below[row - 1] };
        (from, self.below[row] - from)
    }

    /// The ends of a column and of a row, in parts of the picture.
    fn sides(&self, environment: &Environment, column: usize, row: usize) -> [[f64; 2]; 2] {
        let [width, height] = environment.size();
        let ends = |cell: usize, pixels: u32, most: u32| {
            let step = pixels.div_ceil(most) as usize;
            [cell, cell + 1].map(|cell| f64::from(((cell * step) as u32).min(pixels)) / f64::from(pixels))
        };
        [ends(column, width, MOST_COLUMNS), ends(row, height, MOST_ROWS)]
    }
}

/// What a cell between these sides fills, as places of the picture count at a direction with so long a part across the
/// vertical: straight up and down many places are one direction, and a little more than none keeps densities finite.
fn solid_angle([left, right]: [f64; 2], [low, high]: [f64; 2], radius: f64) -> f64 {
    TAU * (right - left) * PI * (high - low) * radius.max(1e-9)
}

/// For each of as many equal parts of 0 to 1 as there are ascending numbers, the index of the first that is above where it
/// begins.
fn guide(ends: impl ExactSizeIterator<Item = f64>) -> impl Iterator<Item = u16> {
    let count = ends.len();
    let mut ends = ends.peekable();
    let mut index = 0;
    (0..count).map(move |part| {
        let from = part as f64 / count as f64;
        while ends.next_if(|&end| end <= from).is_some() {
            index += 1;
        }
        index.min(count - 1) as u16
    })
}

/// The index of the first of ascending numbers that is above one from 0 to less than 1; of the last if none is.
#[inline]
fn find(guide: &[u16], at: f64, end: impl Fn(usize) -> f64) -> usize {
    let count = guide.len();
    let mut index = usize::from(guide[((at * count as f64) as usize).min(count - 1)]);
    while index + 1 < count && end(index) <= at {
        index += 1;
    }
    index
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
