//! The same grid of samples in every pixel; one sample in its middle is the grid of 1 × 1.

use super::{Antialias, Samples};
use durer_math::DVec2;

/// `n` × `n` samples, each in the middle of its cell.
pub(crate) struct Grid {
    /// From the corner of the pixel, row by row.
    points: Vec<DVec2>,
    /// Of a sample.
    weight: f32,
}

impl Grid {
    /// So many samples along a side.
    pub(crate) fn new(n: u32) -> Grid {
        let cell = 1.0 / f64::from(n);
        let within = |row: u32, column: u32| DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * cell;
        let points = (0..n).flat_map(|row| (0..n).map(move |column| within(row, column))).collect();
        Grid { points, weight: 1.0 / (n * n) as f32 }
    }
}

impl Antialias for Grid {
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>) {
        points.extend(self.points.iter().map(|&point| corner + point));
    }

    #[inline]
    fn pixel(&self, corner: DVec2, samples: &mut impl Samples) {
        for &point in &self.points {
            let sample = samples.take(corner + point);
            samples.keep(self.weight, sample);
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
        Grid::new(2).pixel(DVec2::new(10.0, 20.0), &mut places);
        assert_eq!(places.taken, [(10.25, 20.25), (10.75, 20.25), (10.25, 20.75), (10.75, 20.75)]);
        assert_eq!(places.weights, 1.0);
    }
}
