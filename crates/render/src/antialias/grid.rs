//! The same grid of samples in every pixel; one sample in its middle is the grid of 1 × 1.

use super::{Antialias, Sample};
use durer_math::DVec2;

/// `n` × `n` samples, each in the middle of its cell.
pub(crate) struct Grid {
    pub(crate) n: u32,
}

impl Antialias for Grid {
    fn pixel(&self, corner: DVec2, mut take: impl FnMut(DVec2) -> Sample, mut keep: impl FnMut(f32, Sample)) {
        let cell = 1.0 / f64::from(self.n);
        let weight = 1.0 / (self.n * self.n) as f32;
        for row in 0..self.n {
            for column in 0..self.n {
                let within = DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * cell;
                keep(weight, take(corner + within));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    #[test]
    fn samples_are_the_middles_of_the_cells() {
        let mut places = Vec::new();
        let mut sum = 0.0;
        let take = |at: DVec2| {
            places.push((at.x, at.y));
            Sample { color: Rgb::BLACK, index: 0 }
        };
        Grid { n: 2 }.pixel(DVec2::new(10.0, 20.0), take, |weight, _| sum += weight);
        assert_eq!(places, [(10.25, 20.25), (10.75, 20.25), (10.25, 20.75), (10.75, 20.75)]);
        assert_eq!(sum, 1.0);
    }
}
