//! Anti-aliasing: where in a picture rays are sent, and how their colours become those of pixels.
//!
//! There are two families. Of the first, each pixel stands alone: [`Antialias`]. In the second, neighbors share their
//! samples, and look at each other to decide where more are needed: [`Rows`]. Whichever it is, a pixel is the sum of
//! samples times weights, and a sample depends on nothing but the scene and its place.

pub(crate) mod adaptive;
pub(crate) mod alone;
pub(crate) mod grid;
pub(crate) mod lattice;
mod own;
pub(crate) mod pov;
pub(crate) mod recursive;
#[cfg(test)]
mod tests;

use crate::eye::Eye;
use crate::film::{Account, Region};
use durer_math::{DVec2, Rgb};

/// A ray's colour. `index` counts the samples of a pixel in the order they were taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) color: Rgb,
    pub(crate) index: u32,
}

/// What anti-aliasing may ask of the renderer, for one pixel.
pub(crate) trait Samples {
    /// Traces a ray through a point of the picture, in pixels.
    fn take(&mut self, at: DVec2) -> Sample;

    /// Adds a sample to the pixel, times a weight. The pixel is the sum of these, in this order; the weights add up to 1.
    fn keep(&mut self, weight: f32, sample: Sample);

    /// The pixel, or a part of it, is divided so often.
    fn divided(&mut self, depth: u32);
}

/// A way to make a pixel from samples of its own.
pub(crate) trait Antialias: Sync {
    /// The points of the pixel whose upper left corner is at `corner` that are sampled whatever is seen there, in the order
    /// in which [`Antialias::pixel`] takes them, and before all others.
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>);

    /// Samples the pixel whose upper left corner is at `corner`, in pixels.
    fn pixel(&self, corner: DVec2, samples: &mut impl Samples);
}

/// A sample with its weight in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Splat {
    /// Where it was taken, in pixels.
    pub(crate) at: DVec2,
    /// The area that it stands for, in pixels; 0 if it only helped to decide.
    pub(crate) weight: f32,
    pub(crate) color: Rgb,
    /// False if the colour was not finite, and is black in its place.
    pub(crate) is_finite: bool,
}

/// A way to sample pixels that share samples with their neighbors, in bands of rows from top to bottom.
pub(crate) trait Rows: Sync {
    /// Samples the pixels of a band, so that they can be asked for; forgets what no band below it needs. Bands follow each
    /// other without a gap, and are as wide as the first. False if `stop` said so.
    fn sample(&mut self, eye: &impl Eye, band: Region, account: &mut Account, stop: &(dyn Fn() -> bool + Sync))
    -> bool;

    /// Adds the samples of a pixel of the last band. Their weights add up to 1.
    fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>);

    /// How often a pixel of the last band, or a part of it, was divided.
    fn depth(&self, x: u32, y: u32) -> u8;
}
