//! From samples to pixels: how much each sample counts in which pixel.
//!
//! With the box, a pixel is the mean of its own area. Wider filters weigh the samples of neighbors, too: each by the area
//! that it stands for times the filter's value at its place; divided by the sum of all these weights, so that an even
//! surface stays what it is (Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition, section 8.8).

use crate::antialias::{Rows, Splat};
use crate::eye::Eye;
use crate::film::{Account, Region};
use durer_math::functions::{cos, exp};
use durer_math::{DVec2, Rgb};
use durer_scene::PixelFilter;
use std::collections::VecDeque;

/// A filter, compiled: what a sample counts at a distance from the middle of a pixel, along one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernel {
    pub(crate) filter: PixelFilter,
}

impl Kernel {
    /// Up to where it is not 0, in pixels from the middle.
    pub(crate) fn radius(self) -> f64 {
        match self.filter {
            PixelFilter::Box => 0.5,
            PixelFilter::Tent { radius }
            | PixelFilter::Gaussian { radius, .. }
            | PixelFilter::Mitchell { radius }
            | PixelFilter::BlackmanHarris { radius } => radius,
        }
    }

    /// True if a pixel is the mean of its own area.
    pub(crate) fn is_box(self) -> bool {
        self.filter == PixelFilter::Box
    }

    /// How many pixels beyond its own it reaches.
    fn reach(self) -> u32 {
        (self.radius() - 0.5).ceil() as u32
    }

    pub(crate) fn at(self, distance: f64) -> f64 {
        let x = distance.abs();
        if x >= self.radius() {
            return 0.0;
        }
        match self.filter {
            PixelFilter::Box => 1.0,
            PixelFilter::Tent { radius } => radius - x,
            PixelFilter::Gaussian { radius, sigma } => {
                let bell = |x: f64| f64::from(exp((-x * x / (2.0 * sigma * sigma)) as f32));
                bell(x) - bell(radius)
            }
            PixelFilter::Mitchell { radius } => mitchell(2.0 * x / radius),
            PixelFilter::BlackmanHarris { radius } => {
                // Harris, "On the use of windows for harmonic analysis", Proc. IEEE 66(1), 1978: four terms, -92 dB.
                let turn = std::f64::consts::PI * (x / radius + 1.0);
                0.358_75 - 0.488_29 * cos(turn) + 0.141_28 * cos(2.0 * turn) - 0.011_68 * cos(3.0 * turn)
            }
        }
    }
}

/// Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, with B = C = 1/3; 0 from 2 on.
fn mitchell(x: f64) -> f64 {
    if x < 1.0 {
        (21.0 * x * x * x - 36.0 * x * x + 16.0) / 18.0
    } else {
        (-7.0 * x * x * x + 36.0 * x * x - 60.0 * x + 32.0) / 18.0
    }
}

/// Makes pixels of the samples of bands.
pub(crate) struct Reconstruction<R> {
    rows: R,
    kernel: Kernel,
    picture: (u32, u32),
    /// The columns that are sampled.
    columns: (u32, u32),
    /// Samples of rows that were sampled, for filters that reach beyond a pixel; the number of the first.
    sampled: VecDeque<RowSplats>,
    first_row: u32,
    /// Rows from here on were not sampled.
    next_row: Option<u32>,
}

/// The samples of a row of pixels.
struct RowSplats {
    /// Where those of each pixel end.
    ends: Vec<usize>,
    splats: Vec<Splat>,
    depths: Vec<u8>,
}

impl RowSplats {
    fn of(&self, pixel: usize) -> &[Splat] {
        let start = if pixel == 0 { 0 } else { self.ends[pixel - 1] };
        &self.splats[start..self.ends[pixel]]
    }
}

impl<R: Rows> Reconstruction<R> {
    /// Of pixels in a region of a picture of this size.
    pub(crate) fn new(rows: R, filter: PixelFilter, region: Region, picture: (u32, u32)) -> Reconstruction<R> {
        let kernel = Kernel { filter };
        let around = region.grown(kernel.reach(), picture);
        let columns = (around.x, around.x + around.width);
        Reconstruction { rows, kernel, picture, columns, sampled: VecDeque::new(), first_row: 0, next_row: None }
    }

    /// Samples all that pixels of a band need; bands must follow each other downward. False if `stop` said so.
    pub(crate) fn sample(
        &mut self,
        eye: &impl Eye,
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let needed = band.grown(self.kernel.reach(), self.picture);
        let (x, width) = (self.columns.0, self.columns.1 - self.columns.0);
        let y = self.next_row.unwrap_or(needed.y).max(needed.y);
        let bottom = needed.y + needed.height;
        if y < bottom && !self.rows.sample(eye, Region { x, y, width, height: bottom - y }, account, stop) {
            return false;
        }
        self.next_row = Some(bottom);
        if !self.kernel.is_box() {
            self.keep(needed.y, y..bottom);
        }
        true
    }

    /// Keeps the samples of new rows, and forgets those above a row.
    fn keep(&mut self, first: u32, new: std::ops::Range<u32>) {
        while self.first_row < first && self.sampled.pop_front().is_some() {
            self.first_row += 1;
        }
        if self.sampled.is_empty() {
            self.first_row = new.start;
        }
        for y in new {
            let mut row = RowSplats { ends: Vec::new(), splats: Vec::new(), depths: Vec::new() };
            for x in self.columns.0..self.columns.1 {
                self.rows.splats(x, y, &mut row.splats);
                row.ends.push(row.splats.len());
                row.depths.push(self.rows.depth(x, y));
            }
            self.sampled.push_back(row);
        }
    }

    /// How often a pixel was divided.
    pub(crate) fn depth(&self, x: u32, y: u32) -> u8 {
        match self.kernel.is_box() {
            true => self.rows.depth(x, y),
            false => self.sampled[(y - self.first_row) as usize].depths[(x - self.columns.0) as usize],
        }
    }

    /// The samples that a pixel is made of, with their weights, which add up to 1: the pixel is the sum of their colours,
    /// each times its weight, in this order.
    pub(crate) fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>) {
        splats.clear();
        if self.kernel.is_box() {
            self.rows.splats(x, y, splats);
        } else {
            let center = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let around = Region { x, y, width: 1, height: 1 }.grown(self.kernel.reach(), self.picture);
            for (x, y) in around.pixel_places() {
                let row = &self.sampled[(y - self.first_row) as usize];
                splats.extend(row.of((x - self.columns.0) as usize).iter().map(|splat| {
                    let away = splat.at - center;
                    let weight = splat.weight * (self.kernel.at(away.x) * self.kernel.at(away.y)) as f32;
                    Splat { weight, ..*splat }
                }));
            }
        }
        if !self.kernel.is_box() || splats.iter().any(|splat| !splat.is_finite) {
            normalize(splats);
        }
    }
}

/// Leaves out what is not finite, and makes the weights of all else add up to 1.
pub(crate) fn normalize(splats: &mut [Splat]) {
    for splat in &mut *splats {
        splat.weight = if splat.is_finite { splat.weight } else { 0.0 };
    }
    let sum: f64 = splats.iter().map(|splat| f64::from(splat.weight)).sum();
    // Where the good samples have next to no weight together, as may be in the outer half of Mitchell's filter, they say
    // nothing of the pixel: it is black, as if it had none.
    let least: f64 = 1e-3 * splats.iter().map(|splat| f64::from(splat.weight.abs())).sum::<f64>();
    if sum <= least {
        splats.iter_mut().for_each(|splat| splat.weight = 0.0);
    } else {
        splats.iter_mut().for_each(|splat| splat.weight = (f64::from(splat.weight) / sum) as f32);
    }
}

/// The pixel that these samples make.
pub(crate) fn color_of(splats: &[Splat]) -> Rgb {
    splats.iter().fold(Rgb::BLACK, |sum, splat| sum + splat.color * splat.weight)
}
