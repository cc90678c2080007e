//! Pixels that stand alone, in bands: for filters that need the samples of neighbors beside the pixel's own.

use super::own::PixelSamples;
use super::{Antialias, Rows, Sample, Samples, Splat};
use crate::eye::Eye;
use crate::film::{Account, Region};
use durer_math::DVec2;

/// Makes bands of pixels that stand alone.
pub(crate) struct Alone<A> {
    antialias: A,
    pixels: PixelSamples,
}

impl<A: Antialias> Alone<A> {
    pub(crate) fn new(antialias: A) -> Alone<A> {
        Alone { antialias, pixels: PixelSamples::new() }
    }
}

impl<A: Antialias> Rows for Alone<A> {
    fn sample(
        &mut self,
        eye: &impl Eye,
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let pixels = PixelSamples::make(band, account, stop, |x, y, account| {
            let (mut splats, depth) = list(eye, &self.antialias, (x, y), account);
            splats.retain(|splat| splat.weight != 0.0);
            (splats, depth)
        });
        pixels.map(|pixels| self.pixels = pixels).is_some()
    }

    fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>) {
        splats.extend_from_slice(&self.pixels.of(x, y).0);
    }

    fn depth(&self, x: u32, y: u32) -> u8 {
        self.pixels.of(x, y).1
    }
}

/// All samples that a pixel takes, with the weights of those that it keeps, and how often it was divided.
pub(crate) fn list(
    eye: &impl Eye,
    antialias: &impl Antialias,
    (x, y): (u32, u32),
    account: &mut Account,
) -> (Vec<Splat>, u8) {
    let mut listed = Listed { eye, account, splats: Vec::new(), depth: 0 };
    antialias.pixel(DVec2::new(f64::from(x), f64::from(y)), &mut listed);
    (listed.splats, listed.depth)
}

/// The samples of one pixel, written down.
struct Listed<'a, E> {
    eye: &'a E,
    account: &'a mut Account,
    splats: Vec<Splat>,
    depth: u8,
}

impl<E: Eye> Samples for Listed<'_, E> {
    fn take(&mut self, at: DVec2) -> Sample {
        let look = self.eye.look(at, self.account);
        self.splats.push(Splat { at, weight: 0.0, color: look.color, is_finite: look.is_finite });
        Sample { color: look.color, index: self.splats.len() as u32 - 1 }
    }

    fn keep(&mut self, weight: f32, sample: Sample) {
        self.splats[sample.index as usize].weight += weight;
    }

    fn divided(&mut self, depth: u32) {
        self.depth = self.depth.max(u8::try_from(depth).unwrap_or(u8::MAX));
    }
}
