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

/// A way to make a pixel from samples.
///
/// The pixel is the sum of all kept samples, each times its weight, in the order in which they are kept.
pub(crate) trait Antialias: Sync {
    /// Samples the pixel whose upper left corner is at `corner`, in pixels. `take` traces a ray through a point of the
    /// picture; `keep` says with which weight a sample enters the pixel.
    fn pixel(&self, corner: DVec2, take: impl FnMut(DVec2) -> Sample, keep: impl FnMut(f32, Sample));
}
