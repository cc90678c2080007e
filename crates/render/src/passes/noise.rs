//! How much of a picture is noise, and where more samples are to go.
//!
//! Decided is for cells of 8 × 8 pixels, by all of their samples together: a single pixel knows too little of its own noise.
//! Cells begin at the picture's corner and know nothing of each other, so that parts of a picture decide as the whole does.

use crate::compile::CompiledScene;
use crate::film::{Film, Region, Sums};
use durer_math::functions::pow;

/// Edge of a cell, in pixels.
pub(crate) const CELL: u32 = 8;

/// Before a pixel has so many samples nothing is known.
const LEAST_SAMPLES: u32 = 16;

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

    /// The square of the noise of a pixel: the standard error of its luminance, over the root of that, as screens and eyes
    /// have it. At the white of the screen, 0.01 is one in a hundred.
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

    /// How many samples each pixel of a region is to have next, and how many there will be in the end as far as can be
    /// told, if none has more than `most`.
    pub(super) fn goals(self, region: Region, sums: &Sums, most: u32) -> (Vec<u32>, u64) {
        let mut goals = sums.taken.clone();
        let mut expected = 0;
        for cell in region.cells(CELL) {
            let pixels = || cell.pixel_places().map(|(x, y)| region.index_of(x, y));
            let least = pixels().map(|pixel| sums.taken[pixel]).min().unwrap_or(0);
            let all_alike = pixels().all(|pixel| sums.taken[pixel] == least);
            let noise = self.of(sums, pixels());
            let is_enough = least >= most || (all_alike && least >= LEAST_SAMPLES && noise <= self.target);
            let goal = if is_enough { least } else { super::after(least).min(most) };
            pixels().for_each(|pixel| goals[pixel] = goals[pixel].max(goal));
            let needed = if least < LEAST_SAMPLES || is_enough {
                f64::from(goal.max(LEAST_SAMPLES.min(most)))
            } else {
                (f64::from(least) * (noise / self.target) * (noise / self.target)).clamp(goal.into(), most.into())
            };
            expected += cell.pixels() * needed as u64;
        }
        (goals, expected)
    }
}
