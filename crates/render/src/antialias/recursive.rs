//! The seed's anti-aliasing: four samples in the quarters of a square; where they differ, each quarter again.

use super::{Antialias, Sample, Samples};
use durer_math::{DVec2, Rgb};

/// Compares sample 0 with the other three. If one differs by more than `threshold` and the square was divided fewer
/// than `max_depth` times, the four samples are thrown away and every quarter is treated in the same way.
///
/// Where every comparison fails, a pixel costs 4 (4^(`max_depth` + 1) - 1) / 3 rays.
pub(crate) struct Recursive {
    pub(crate) threshold: f32,
    pub(crate) max_depth: u32,
}

/// Middles of the quarters, in units of the square's side: upper left, upper right, lower left, lower right.
const QUARTERS: [(f64, f64); 4] = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];

impl Antialias for Recursive {
    fn certain(&self, corner: DVec2, points: &mut Vec<DVec2>) {
        points.extend(quarters(corner, 1.0));
    }

    fn pixel(&self, corner: DVec2, samples: &mut impl Samples) {
        self.square(corner, 1.0, 0, samples);
    }
}

impl Recursive {
    fn square(&self, corner: DVec2, side: f64, divisions: u32, samples: &mut impl Samples) {
        let four = quarters(corner, side).map(|point| samples.take(point));
        samples.divided(divisions);
        let differs = |s: &Sample| difference(four[0].color, s.color) > self.threshold;
        if divisions < self.max_depth && four[1..].iter().any(differs) {
            for (x, y) in QUARTERS {
                let quarter = corner + DVec2::new(x - 0.25, y - 0.25) * side;
                self.square(quarter, side * 0.5, divisions + 1, samples);
            }
        } else {
            // The area of a quarter: a power of two, so weighting loses nothing.
            let weight = (side * side * 0.25) as f32;
            for sample in four {
                samples.keep(weight, sample);
            }
        }
    }
}

/// Middles of the quarters of a square.
fn quarters(corner: DVec2, side: f64) -> [DVec2; 4] {
    QUARTERS.map(|(x, y)| corner + DVec2::new(x, y) * side)
}

/// The sum of the differences of the components, of colours as they are (linear).
fn difference(a: Rgb, b: Rgb) -> f32 {
    let d = (a - b).map(f32::abs);
    d.r + d.g + d.b
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture that is a function of place.
    struct Pictured<F> {
        picture: F,
        count: u32,
        weights: f32,
        pixel: f32,
        depth: u32,
    }

    impl<F: Fn(DVec2) -> f32> Samples for Pictured<F> {
        fn take(&mut self, at: DVec2) -> Sample {
            self.count += 1;
            Sample { color: Rgb::gray((self.picture)(at)), index: self.count - 1 }
        }
        fn keep(&mut self, weight: f32, sample: Sample) {
            self.weights += weight;
            self.pixel += weight * sample.color.r;
        }
        fn divided(&mut self, depth: u32) {
            self.depth = self.depth.max(depth);
        }
    }

    /// Rays taken, the sum of the weights, and the pixel.
    fn run(max_depth: u32, picture: impl Fn(DVec2) -> f32) -> (u32, f32, f32) {
        let mut samples = Pictured { picture, count: 0, weights: 0.0, pixel: 0.0, depth: 0 };
        Recursive { threshold: 0.3, max_depth }.pixel(DVec2::ZERO, &mut samples);
        (samples.count, samples.weights, samples.pixel)
    }

    #[test]
    fn full_recursion_costs_what_the_series_says() {
        for depth in 0..=5u32 {
            // Stripes at twice the finest lattice: neighbours differ at every level.
            let finest = f64::from(4u32 << depth);
            let noisy = |at: DVec2| ((at.x * finest) as u64 * 7 + (at.y * finest) as u64 * 13) as f32 * 10.0;
            let (count, weights, _) = run(depth, noisy);
            assert_eq!(count, 4 * (4u32.pow(depth + 1) - 1) / 3);
            assert_eq!(weights, 1.0);
        }
    }

    #[test]
    fn an_even_square_costs_four() {
        assert_eq!(run(5, |_| 0.5), (4, 1.0, 0.5));
    }

    #[test]
    fn half_a_square_is_found_to_be_half() {
        // An edge along the middle: the first level differs, the quarters do not.
        assert_eq!(run(5, |at| if at.x < 0.5 { 1.0 } else { 0.0 }), (20, 1.0, 0.5));
    }

    #[test]
    fn only_the_first_sample_is_compared() {
        // 0.2 below and above the first: no difference of more than 0.3 to it, though 0.4 between the two.
        let picture = |at: DVec2| match (at.x < 0.5, at.y < 0.5) {
            (true, true) => 0.5,
            (false, true) => 0.43,
            (true, false) => 0.57,
            (false, false) => 0.5,
        };
        assert_eq!(run(5, picture).0, 4);
    }
}
