//! The same grid of samples in every pixel; one sample in its middle is the grid of 1 × 1.

use super::{Antialias, Samples};
use durer_math::DVec2;

/// `n` × `n` samples, each in the middle of its cell.
pub(crate) struct Grid {
    pub(crate) n: u32,
}

impl Antialias for Grid {
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>) {
        self.each_point(corner, |point| points.push(point));
    }

    fn pixel(&self, corner: DVec2, samples: &mut impl Samples) {
        let weight = 1.0 / (self.n * self.n) as f32;
        self.each_point(corner, |point| {
            let sample = samples.take(point);
            samples.keep(weight, sample);
        });
    }
}

impl Grid {
    #[inline(always)]
    fn each_point(&self, corner: DVec2, mut visit: impl FnMut(DVec2)) {
        let cell = 1.0 / f64::from(self.n);
        for row in 0..self.n {
            for column in 0..self.n {
                visit(corner + DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * cell);
            }
        }
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
        Grid { n: 2 }.pixel(DVec2::new(10.0, 20.0), &mut places);
        assert_eq!(places.taken, [(10.25, 20.25), (10.75, 20.25), (10.25, 20.75), (10.75, 20.75)]);
        assert_eq!(places.weights, 1.0);
    }
}
