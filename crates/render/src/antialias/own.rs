//! The pixels of a band, each sampled by itself.

use super::Splat;
use crate::film::{Account, Region};
use crate::schedule::in_parallel;

/// The samples of the pixels of a band.
pub(super) struct PixelSamples {
    band: Region,
    pixels: Vec<OwnSamples>,
}

/// The samples of a pixel, and how often it was divided. None if it has no samples but those that it shares.
pub(super) type OwnSamples = (Vec<Splat>, u8);

impl PixelSamples {
    pub(super) fn new() -> PixelSamples {
        PixelSamples { band: Region { x: 0, y: 0, width: 0, height: 0 }, pixels: Vec::new() }
    }

    /// Looks at each pixel. `None` if `stop` said so.
    pub(super) fn make(
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
        pixel: impl Fn(u32, u32, &mut Account) -> OwnSamples + Sync,
    ) -> Option<PixelSamples> {
        let places: Vec<(u32, u32)> = band.pixel_places().collect();
        let pixels = in_parallel(&places, account, |&(x, y), account| match stop() {
            true => OwnSamples::default(),
            false => pixel(x, y, account),
        });
        (!stop()).then_some(PixelSamples { band, pixels })
    }

    pub(super) fn of(&self, x: u32, y: u32) -> &OwnSamples {
        &self.pixels[(y - self.band.y) as usize * self.band.width as usize + (x - self.band.x) as usize]
    }
}
