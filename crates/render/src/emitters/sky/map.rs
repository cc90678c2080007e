//! Aiming at what is bright in an environment map.
//!
//! The map is divided in tiles, and those in cells. A tile is chosen as often as it lights a surface that [faces](facing) about as
//! the receiver does, by the cosine, so that little is wasted on what is behind it; a cell in it as often as it gives light, as it
//! is seen: bilinear between the middles of pixels. So no direction that gives light is left out. Within a cell places of the
//! picture are all alike. (Choosing by the product of light and cosine goes back to Clarberg et al., "Wavelet Importance Sampling",
//! SIGGRAPH 2005.)
//!
//! Cells are found by the inverse of their distribution, so that well distributed numbers become well distributed places. It is
//! kept in few bits, for what takes the time is waiting for memory.

use crate::emitters::Receiver;
use crate::textures::Environment;
use durer_math::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// The most cells along a side; pixels of larger maps share cells.
const MOST_COLUMNS: u32 = 4096;
const MOST_ROWS: u32 = 2048;

/// The most tiles along a side.
const TILES_ACROSS: usize = 16;
const TILES_UP: usize = 8;

/// Chances of cells.
#[derive(Clone, Debug)]
pub(super) struct Map {
    /// For each way that a surface may face, and for those that take light from all sides, a distribution of tiles.
    tiles: Distributions,
    /// For each tile that of its rows, from below.
    rows: Distributions,
    /// For each row that of its cells in the tiles that it goes through, one after the other.
    cells: Distributions,
    grid: Grid,
    /// The mean luminance of all directions.
    mean: f64,
}

/// How cells are put together in tiles.
#[derive(Clone, Copy, Debug)]
struct Grid {
    /// Columns and rows of cells in a tile, of the last ones perhaps fewer.
    tile: [usize; 2],
    /// Tiles along the sides.
    tiles: [usize; 2],
}

impl Grid {
    fn new([columns, rows]: [usize; 2]) -> Grid {
        let tile = [columns.div_ceil(TILES_ACROSS), rows.div_ceil(TILES_UP)];
        Grid { tile, tiles: [columns.div_ceil(tile[0]), rows.div_ceil(tile[1])] }
    }
}

/// Ways to face: each side of a cube is divided in so many squared.
const FACINGS_ALONG: usize = 5;
const FACINGS: usize = 6 * FACINGS_ALONG * FACINGS_ALONG;
/// What a tile counts that the middle of a facing does not see, of what it does where it is seen straight: its edges may be seen.
const SEEN_BY_A_HAIR: f64 = 0.02;

/// Which of the ways a unit normal faces.
fn facing(normal: DVec3) -> usize {
    let parts = normal.to_array();
    let axis = (1..3).fold(0, |most, axis| if parts[axis].abs() > parts[most].abs() { axis } else { most });
    let along = |k: usize| {
        let part = parts[(axis + k) % 3] / parts[axis].abs();
        ((0.5 * (part + 1.0) * FACINGS_ALONG as f64) as usize).min(FACINGS_ALONG - 1)
    };
    let side = 2 * axis + usize::from(parts[axis] < 0.0);
    (side * FACINGS_ALONG + along(1)) * FACINGS_ALONG + along(2)
}

/// The middle and the corners of one of the ways to face.
fn normals(facing: usize) -> [DVec3; 5] {
    let (across, rest) = (facing % FACINGS_ALONG, facing / FACINGS_ALONG);
    let (along, side) = (rest % FACINGS_ALONG, rest / FACINGS_ALONG);
    [(0.5, 0.5), (0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)].map(|(a, b)| {
        let place = |number: usize, part: f64| (number as f64 + part) / FACINGS_ALONG as f64 * 2.0 - 1.0;
        let mut normal = [0.0; 3];
        let axis = side / 2;
        normal[axis] = if side % 2 == 0 { 1.0 } else { -1.0 };
        normal[(axis + 1) % 3] = place(along, a);
        normal[(axis + 2) % 3] = place(across, b);
        DVec3::from_array(normal).normalize()
    })
}

/// Distributions of whole numbers from 0, in parts of [`ALL`]: what is above 0 has a part at least. All have as much room.
#[derive(Clone, Debug)]
struct Distributions {
    /// The parts of each number and those before it, in whole blocks, with [`ALL`] at the end; one distribution after the other.
    ends: Vec<u16>,
    /// The last of each block, likewise.
    blocks: Vec<u16>,
    /// How many blocks one distribution has.
    block_count: usize,
}

/// All parts of a distribution.
const ALL: u16 = u16::MAX;
/// So many numbers are a cache line.
const BLOCK: usize = 32;

impl Distributions {
    /// Those that are proportional to these weights, none of which is negative; of each no more than `most`, which is no more than
    /// [`MOST_COLUMNS`]. Some may have fewer.
    fn new<'a>(weights: impl Iterator<Item = &'a [f64]>, most: usize) -> Distributions {
        let mut all = Distributions { ends: Vec::new(), blocks: Vec::new(), block_count: most.div_ceil(BLOCK) };
        weights.for_each(|weights| all.add(weights));
        let last = |block: &[u16]| block.last().copied();
        all.blocks = all.ends.chunks(BLOCK).filter_map(last).collect();
        all
    }

    fn add(&mut self, weights: &[f64]) {
        let start = self.ends.len();
        let all: f64 = weights.iter().sum();
        let something = weights.iter().filter(|&&weight| weight > 0.0).count();
        // A part for each that is something; the rest by weight.
        let rest = f64::from(ALL) - something as f64;
        let (mut parts, mut sum) = (0.0, 0.0);
        for &weight in weights {
            parts += f64::from(u8::from(weight > 0.0));
            sum += weight;
            self.ends.push((parts + (sum / all * rest).floor().clamp(0.0, rest)) as u16);
        }
        if let Some(last) = weights.iter().rposition(|&weight| weight > 0.0) {
            self.ends[start + last..].fill(ALL);
        }
        self.ends.resize(start + self.block_count * BLOCK, ALL);
    }

    /// The number that one from 0 to less than 1 chooses in a distribution, what is left of that one, from 0 to 1, and the
    /// chance.
    #[inline]
    fn choose(&self, which: usize, at: f64) -> (usize, f64, f64) {
        let at = at * f64::from(ALL);
        let whole = (at as u16).min(ALL - 1);
        // All are looked at, which is faster than to stop at the right one.
        let below = |ends: &[u16]| usize::from(ends.iter().map(|&end| u16::from(end <= whole)).sum::<u16>());
        let first = which * self.block_count;
        let block = below(&self.blocks[first..first + self.block_count]);
        let ends = &self.ends[(first + block) * BLOCK..][..BLOCK];
        let number = block * BLOCK + below(ends);
        let from = self.from(which, number);
        let parts = f64::from(self.end(which, number) - from);
        (number, ((at - f64::from(from)) / parts).clamp(0.0, 1.0), parts / f64::from(ALL))
    }

    /// The chance of a number in a distribution.
    #[inline]
    fn chance(&self, which: usize, number: usize) -> f64 {
        f64::from(self.end(which, number) - self.from(which, number)) / f64::from(ALL)
    }

    fn end(&self, which: usize, number: usize) -> u16 {
        self.ends[which * self.block_count * BLOCK + number]
    }

    fn from(&self, which: usize, number: usize) -> u16 {
        if number == 0 { 0 } else { self.end(which, number - 1) }
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
            cells
        };
        let cells: Vec<Vec<f64>> = (0..rows as u32).into_par_iter().map(row).collect();
        let sum: f64 = cells.iter().flatten().sum();
        // Each row weighs its cells by heights of bands, which are 2 in all.
        let mean = sum / (2.0 * f64::from(width));
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let grid = Grid::new([columns, rows]);
        let light_in_tile = |tile: usize| {
            let (across, up) = (tile % grid.tiles[0], tile / grid.tiles[0]);
            let rows = cells.iter().skip(up * grid.tile[1]).take(grid.tile[1]);
            let row = |row: &Vec<f64>| row.iter().skip(across * grid.tile[0]).take(grid.tile[0]).sum();
            rows.map(row).collect::<Vec<f64>>()
        };
        let light: Vec<Vec<f64>> = (0..grid.tiles[0] * grid.tiles[1]).map(light_in_tile).collect();
        let parts = parts(environment, &cells, grid);
        let seen: Vec<Vec<f64>> = (0..=FACINGS).into_par_iter().map(|facing| seen(&parts, facing)).collect();
        Some(Map {
            tiles: Distributions::new(seen.iter().map(Vec::as_slice), light.len()),
            rows: Distributions::new(light.iter().map(Vec::as_slice), grid.tile[1]),
            cells: Distributions::new(cells.iter().flat_map(|row| row.chunks(grid.tile[0])), grid.tile[0]),
            grid,
            mean,
        })
    }

    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    /// A place of the picture, the direction there, and its density per solid angle.
    pub(super) fn sample(
        &self,
        environment: &Environment,
        receiver: &Receiver,
        at: DVec2,
    ) -> Option<([f64; 2], DVec3, f64)> {
        let Grid { tile: [width, height], tiles: [tiles_across, _] } = self.grid;
        let (tile, rest, tile_chance) = self.tiles.choose(facing_of(receiver), at.y);
        let (row, from_below, row_chance) = self.rows.choose(tile, rest.min(1.0_f64.next_down()));
        let (tile_column, row) = (tile % tiles_across, tile / tiles_across * height + row);
        let (column, from_left, cell_chance) = self.cells.choose(row * tiles_across + tile_column, at.x);
        let [across, up] = sides(environment, tile_column * width + column, row);
        let within = |[low, high]: [f64; 2], part: f64| low + (high - low) * part;
        let place = [within(across, from_left), within(up, from_below)];
        let (direction, radius) = environment.direction(place);
        let pdf = tile_chance * row_chance * cell_chance / solid_angle(across, up, radius);
        (pdf > 0.0 && pdf.is_finite()).then_some((place, direction, pdf))
    }

    /// The density, per solid angle, with which [`Map::sample`] finds the direction that is at a place of the picture.
    pub(super) fn pdf(
        &self,
        environment: &Environment,
        receiver: &Receiver,
        [u, v]: [f64; 2],
        direction: DVec3,
    ) -> f64 {
        let [width, height] = environment.size();
        let index = |part: f64, pixels: u32, most: u32| {
            let pixel = ((part * f64::from(pixels)) as u32).min(pixels - 1);
            (pixel / pixels.div_ceil(most)) as usize
        };
        let (column, row) = (index(u, width, MOST_COLUMNS), index(v, height, MOST_ROWS));
        let [across, up] = sides(environment, column, row);
        let Grid { tile: [width, height], tiles: [tiles_across, _] } = self.grid;
        let (tile_column, tile_row) = (column / width, row / height);
        let tile = tile_row * tiles_across + tile_column;
        let chance = self.tiles.chance(facing_of(receiver), tile)
            * self.rows.chance(tile, row % height)
            * self.cells.chance(row * tiles_across + tile_column, column % width);
        chance / solid_angle(across, up, DVec2::new(direction.x, direction.z).length())
    }
}

fn facing_of(receiver: &Receiver) -> usize {
    if receiver.passes { FACINGS } else { facing(receiver.normal) }
}

/// Of each quarter of each tile the light, times directions, and the light.
fn parts(environment: &Environment, cells: &[Vec<f64>], grid: Grid) -> Vec<[(DVec3, f64); 4]> {
    let mut parts = vec![[(DVec3::ZERO, 0.0); 4]; grid.tiles[0] * grid.tiles[1]];
    for (row, cells) in cells.iter().enumerate() {
        for (column, &light) in cells.iter().enumerate() {
            let [across, up] = sides(environment, column, row);
            let (direction, _) = environment.direction([0.5 * (across[0] + across[1]), 0.5 * (up[0] + up[1])]);
            let [x, y] =
                [(column, grid.tile[0]), (row, grid.tile[1])].map(|(at, size)| (at / size, 2 * (at % size) / size));
            let part = &mut parts[y.0 * grid.tiles[0] + x.0][2 * y.1 + x.1];
            *part = (part.0 + direction * light, part.1 + light);
        }
    }
    parts
}

/// How much light each tile gives to surfaces that face in one of the ways; by the last number, how much it gives at all.
fn seen(parts: &[[(DVec3, f64); 4]], facing: usize) -> Vec<f64> {
    if facing == FACINGS {
        return parts.iter().map(|tile| tile.iter().map(|(_, light)| light).sum()).collect();
    }
    let normals = normals(facing);
    let of_part = |(direction, light): &(DVec3, f64)| {
        let cosines = normals.iter().map(|normal| normal.dot(*direction).max(0.0)).sum::<f64>();
        cosines / normals.len() as f64 + SEEN_BY_A_HAIR * light
    };
    parts.iter().map(|tile| tile.iter().map(of_part).sum()).collect()
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
