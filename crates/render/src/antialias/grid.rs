//! The same grid of samples in every pixel; one sample in its middle is the grid of 1 × 1.

use super::{Antialias, Samples};
use durer_math::DVec2;

/// `n` × `n` samples, each in the middle of its cell.
pub(crate) struct Grid {
    pub(crate) n: u32,
}

impl Antialias for Grid {
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>) {
        points.extend(self.points(corner));
    }

    fn pixel(&self, corner: DVec2, samples: &mut impl Samples) {
        let weight = 1.0 / (self.n * self.n) as f32;
        self.points(corner).for_each(|point| {
            let sample = samples.take(point);
            samples.keep(weight, sample);
        });
    }
}

impl Grid {
    fn points(&self, corner: DVec2) -> impl Iterator<Item = DVec2> {
        let n = self.n;
        let cell = 1.0 / f64::from(n);
        let within = move |row: u32, column: u32| DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * cell;
        (0..n).flat_map(move |row| (0..n).map(move |column| corner + within(row, column)))
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
