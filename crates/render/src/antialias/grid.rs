//! The same grid of samples in every pixel; one sample in its middle is the grid of 1 × 1.

use super::{Antialias, Samples};
use durer_math::DVec2;

/// `n` × `n` samples, each in the middle of its cell.
pub(crate) struct Grid {
    /// Of the cells along a side of the pixel, in units of it.
    middles: Vec<f64>,
    /// Of a sample.
    weight: f32,
}

impl Grid {
    /// So many samples along a side.
    pub(crate) fn new(n: u32) -> Grid {
        let cell = 1.0 / f64::from(n);
        Grid { middles: (0..n).map(|i| (f64::from(i) + 0.5) * cell).collect(), weight: 1.0 / (n * n) as f32 }
    }

    #[inline(always)]
    fn each_point(&self, corner: DVec2, mut visit: impl FnMut(DVec2)) {
        for &y in &self.middles {
            for &x in &self.middles {
                visit(corner + DVec2::new(x, y));
            }
        }
    }
}

impl Antialias for Grid {
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>) {
        self.each_point(corner, |point| points.push(point));
    }

    #[inline]
    fn pixel(&self, corner: DVec2, samples: &mut impl Samples) {
        self.each_point(corner, |point| {
            let sample = samples.take(point);
            samples.keep(self.weight, sample);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::antialias::Sample;
    use durer_math::Rgb;

    #[derive(Default)]
    struct Places {
        taken: Vec<(f64, f64)>,
        weights: f32,
    }

    impl Samples for Places {
        fn take(&mut self, at: DVec2) -> Sample {
            self.taken.push((at.x, at.y));
            Sample { color: Rgb::BLACK, index: 0 }
        }
        fn keep(&mut self, weight: f32, _: Sample) {
            self.weights += weight;
        }
        fn divided(&mut self, depth: u32) {
            assert_eq!(depth, 0);
        }
    }

    #[test]
    fn samples_are_the_middles_of_the_cells() {
        let mut places = Places::default();
        Grid::new(2).pixel(DVec2::new(10.0, 20.0), &mut places);
        assert_eq!(places.taken, [(10.25, 20.25), (10.75, 20.25), (10.25, 20.75), (10.75, 20.75)]);
        assert_eq!(places.weights, 1.0);
    }
}
