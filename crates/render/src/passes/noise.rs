//! How much of a picture is noise, and where more samples are to go.
//!
//! Noise is, for a pixel, the standard error of its luminance over the root of its luminance, both with the picture's exposure:
//! in the white of the screen 0.02 is one in fifty. That of some pixels is the root of the mean of their squares.
//!
//! Decided is for cells of 8 × 8 pixels on a grid that begins at the picture's corner. A cell takes samples until its noise is
//! low enough in two passes running, and until that has once been so for each of the eight cells around it: light that is met
//! rarely (a small lamp, a caustic) may be missed by all samples of a cell, and is found by those of its neighbors. What a
//! neighbor says is a matter of its own samples alone, so no cell depends on more than those around it; that is how parts of a
//! picture decide as the whole does ([`Around`]).

use super::around::Around;
use crate::compile::CompiledScene;
use crate::film::{Calm, Film, Region, Sums};
use durer_math::functions::pow;

/// Edge of a cell, in pixels.
pub(crate) const CELL: u32 = 8;

/// Before a pixel has so many samples nothing is known.
const LEAST_SAMPLES: u32 = 32;

/// In so many passes running noise must be low enough.
pub(crate) const PASSES: u8 = 2;

/// What is added to brightness: darker differences are not seen.
const DARK: f64 = 1e-3;

/// What light is multiplied by.
fn factor(exposure: f32) -> f64 {
    f64::from(pow(2.0, exposure))
}

impl Film {
    /// The noise of all of its pixels, as goals for noise measure it, for a picture with so many stops of exposure: the
    /// standard error over the root of the brightness. `None` if it has no samples, or too few to tell.
    pub fn noise(&self, exposure: f32) -> Option<f64> {
        let sums = self.sums().filter(|sums| sums.least_and_most().0 > 1)?;
        Some(Noise { exposure: factor(exposure), target: 0.0 }.of(sums, 0..sums.taken.len()))
    }
}

/// A goal for noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    /// What colors are multiplied by before they are looked at.
    exposure: f64,
    /// The noise that is let pass.
    target: f64,
}

impl Noise {
    pub(crate) fn new(scene: &CompiledScene, target: f32) -> Noise {
        Noise { exposure: factor(scene.picture.exposure), target: f64::from(target) }
    }

    /// The square of the noise of a pixel.
    fn of_pixel(self, sums: &Sums, pixel: usize) -> f64 {
        let luminance = f64::from(sums.mean(pixel).luminance()).max(0.0) * self.exposure;
        sums.variance(pixel) * self.exposure * self.exposure / (luminance + DARK)
    }

    /// The noise of some pixels together: the root of the mean of their squares.
    pub(crate) fn of(self, sums: &Sums, pixels: impl Iterator<Item = usize>) -> f64 {
        let (sum, count) =
            pixels.fold((0.0, 0_u32), |(sum, count), pixel| (sum + self.of_pixel(sums, pixel), count + 1));
        (sum / f64::from(count.max(1))).sqrt()
    }

    /// What is known of a cell when all of its pixels have so many samples more than at the last look.
    pub(super) fn judged(self, before: Calm, sums: &Sums, samples: u32, pixels: impl Iterator<Item = usize>) -> Calm {
        if samples < LEAST_SAMPLES || samples <= before.samples {
            return before;
        }
        let is_low = self.of(sums, pixels) <= self.target;
        let passes = if is_low { (before.passes + 1).min(PASSES) } else { 0 };
        let first = if before.first == 0 && passes == PASSES { samples } else { before.first };
        Calm { samples, passes, first }
    }
}

/// What is known of a cell when the next pass is chosen.
#[derive(Clone, Copy, Debug)]
struct Cell {
    /// Its part in the film; `None` if it lies beside it.
    part: Option<Region>,
    /// The fewest and the most samples that pixels of this part have.
    taken: (u32, u32),
    calm: Calm,
}

impl Cell {
    /// True if it was calm by the time that pixels had so many samples.
    fn was_calm_at(&self, samples: u32) -> bool {
        (1..=samples).contains(&self.calm.first)
    }
}

/// All cells that have to do with a film: its own and those around them.
pub(super) struct Cells<'a> {
    noise: Noise,
    sums: &'a Sums,
    region: Region,
    /// Row by row.
    cells: Vec<Cell>,
    /// How many are in a row.
    across: usize,
}

/// The columns and rows of the cells that a region has pixels of, and of those around them, as far as the picture goes.
pub(super) fn cells_around(region: Region, (width, height): (u32, u32)) -> Region {
    let reach = |from: u32, length: u32, most: u32| {
        let first = (from / CELL).saturating_sub(1);
        let last = ((from + length - 1) / CELL + 1).min((most - 1) / CELL);
        (first, last + 1 - first)
    };
    let ((x, width), (y, height)) = (reach(region.x, region.width, width), reach(region.y, region.height, height));
    Region { x, y, width, height }
}

/// The pixels of the cell in this column and row.
pub(super) fn pixels_of_cell((column, row): (u32, u32), (width, height): (u32, u32)) -> Region {
    let (x, y) = (column * CELL, row * CELL);
    Region { x, y, width: CELL.min(width - x), height: CELL.min(height - y) }
}

impl Noise {
    /// Looks at the cells of a film that lie in it as a whole, where they have more samples than at the last look.
    pub(super) fn look_at(self, film: &mut Film) {
        let region = film.region();
        let Some(sums) = film.sums_mut() else { return };
        let mut calm = std::mem::take(&mut sums.calm);
        calm.resize(region.cells(CELL).count(), Calm::default());
        for (cell, calm) in region.cells(CELL).zip(&mut calm) {
            let pixels = || cell.pixel_places().map(|(x, y)| region.index_of(x, y));
            let (least, most) = least_and_most(sums, pixels());
            if least == most {
                *calm = self.judged(*calm, sums, least, pixels());
            }
        }
        sums.calm = calm;
    }
}

fn least_and_most(sums: &Sums, pixels: impl Iterator<Item = usize>) -> (u32, u32) {
    pixels.map(|pixel| sums.taken[pixel]).fold((u32::MAX, 0), |(least, most), n| (least.min(n), most.max(n)))
}

impl<'a> Cells<'a> {
    /// Those of a film that was [looked at](Noise::look_at).
    pub(super) fn new(noise: Noise, film: &'a Film, around: &Around, picture: (u32, u32)) -> Option<Cells<'a>> {
        let (region, sums) = (film.region(), film.sums()?);
        let grid = cells_around(region, picture);
        let (left, top) = (region.x / CELL, region.y / CELL);
        let across = ((region.x + region.width - 1) / CELL + 1 - left) as usize;
        let cells = grid.pixel_places().map(|(column, row)| {
            let part = pixels_of_cell((column, row), picture).intersection(region);
            let Some(part) = part else {
                return Cell { part, taken: (0, 0), calm: around.calm((column, row)).unwrap_or_default() };
            };
            let index = (row - top) as usize * across + (column - left) as usize;
            let calm = around.calm((column, row)).unwrap_or_else(|| sums.calm.get(index).copied().unwrap_or_default());
            let taken = least_and_most(sums, part.pixel_places().map(|(x, y)| region.index_of(x, y)));
            Cell { part: Some(part), taken, calm }
        });
        Some(Cells { noise, sums, region, cells: cells.collect(), across: grid.width as usize })
    }

    /// The cells of the film that want more samples, if a pixel may have `most`: their indices.
    fn restless(&self, most: u32) -> Vec<usize> {
        let wants = |index: &usize| {
            let Cell { part, taken: (least, uneven), calm } = self.cells[*index];
            let is_calm = || calm.samples == least && calm.passes == PASSES;
            part.is_some()
                && least < most
                && (least != uneven || !is_calm() || !self.near(*index).all(|cell| cell.was_calm_at(least)))
        };
        (0..self.cells.len()).filter(wants).collect()
    }

    /// A cell and those around it.
    fn near(&self, index: usize) -> impl Iterator<Item = &Cell> {
        let (column, row) = (index % self.across, index / self.across);
        let columns = column.saturating_sub(1)..(column + 2).min(self.across);
        let rows = row.saturating_sub(1)..(row + 2).min(self.cells.len() / self.across);
        rows.flat_map(move |row| columns.clone().map(move |column| &self.cells[row * self.across + column]))
    }

    /// How many samples each pixel of the film is to have next, and how many there will be in the end as far as can be told,
    /// if none has more than `most` and the next pass takes no more than `in_time`. `None` if it is enough.
    pub(super) fn goals(&self, most: u32, in_time: u64) -> Option<(Vec<u32>, u64)> {
        let restless = self.restless(most);
        // Cells that a pass was cut short of come first: what those ahead of them are to do depends on them.
        let least = restless.iter().map(|&index| self.cells[index].taken.0).min()?;
        let next: Vec<&Cell> =
            restless.iter().map(|&index| &self.cells[index]).filter(|cell| cell.taken.0 == least).collect();
        let pixels: u64 = next.iter().filter_map(|cell| cell.part).map(|part| part.pixels()).sum();
        let more = u32::try_from(in_time / pixels.max(1)).unwrap_or(u32::MAX);
        if more == 0 {
            return None;
        }
        let goal = super::after(least).min(most).min(least.saturating_add(more));
        let mut goals = self.sums.taken.clone();
        for (x, y) in next.iter().filter_map(|cell| cell.part).flat_map(Region::pixel_places) {
            let taken = &mut goals[self.region.index_of(x, y)];
            *taken = goal.max(*taken);
        }
        let expected: u64 = restless.iter().map(|&index| self.expected(&self.cells[index], most)).sum::<u64>()
            + self.taken_by_calm(&restless);
        Some((goals, expected))
    }

    /// The samples that a restless cell will have in the end, as far as its own noise tells.
    fn expected(&self, cell: &Cell, most: u32) -> u64 {
        let (Some(part), (least, _)) = (cell.part, cell.taken) else { return 0 };
        let at_least = f64::from(super::after(least).max(2 * LEAST_SAMPLES).min(most));
        let needed = if least < LEAST_SAMPLES {
            at_least
        } else {
            let noise = self.noise.of(self.sums, part.pixel_places().map(|(x, y)| self.region.index_of(x, y)));
            let times = noise / self.noise.target;
            (f64::from(least) * times * times).clamp(at_least, f64::from(most).max(at_least))
        };
        part.pixels() * needed as u64
    }

    /// The samples of the other cells.
    fn taken_by_calm(&self, restless: &[usize]) -> u64 {
        let of_restless: u64 = restless
            .iter()
            .filter_map(|&index| self.cells[index].part)
            .flat_map(Region::pixel_places)
            .map(|(x, y)| u64::from(self.sums.taken[self.region.index_of(x, y)]))
            .sum();
        self.sums.samples().saturating_sub(of_restless)
    }
}

#[cfg(test)]
mod tests;
