//! Anti-aliasing: where in a pixel rays are sent, and how their colours become the pixel's.

pub(crate) mod grid;
pub(crate) mod recursive;

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

    /// Adds a sample to the pixel, times a weight. The pixel is the sum of these, in this order.
    fn keep(&mut self, weight: f32, sample: Sample);
}

/// A way to make a pixel from samples.
pub(crate) trait Antialias: Sync {
    /// The points of the pixel whose upper left corner is at `corner` that are sampled whatever is seen there, in the order
    /// in which [`Antialias::pixel`] takes them, and before all others.
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>);

    /// Samples the pixel whose upper left corner is at `corner`, in pixels.
    fn pixel(&self, corner: DVec2, samples: &mut impl Samples);
}
