//! Separable filters over planes of numbers. Beyond the border the plane goes on with its last pixels.

use durer_math::functions::exp;

/// One number for each pixel: rows from the top, pixels from the left.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f32>,
}

/// An odd number of weights, the middle one for the pixel itself.
pub(super) struct Kernel {
    weights: Vec<f32>,
}

impl Kernel {
    /// A Gaussian whose weights sum to 1, and the sum before they were made so.
    pub(super) fn gaussian(deviation: f64, radius: usize) -> (Kernel, f64) {
        let weights = sampled(radius, |x| bell(x / deviation));
        let sum: f64 = weights.iter().sum();
        (Kernel::scaled(&weights, 1.0 / sum, 1.0 / sum), sum)
    }

    /// A Gaussian's first derivative, its positive weights scaled to sum to 1 and its negative ones to sum to -1.
    pub(super) fn first_derivative(deviation: f64, radius: usize) -> Kernel {
        Kernel::balanced(&sampled(radius, |x| -x * bell(x / deviation)))
    }

    /// A Gaussian's second derivative, scaled like the first.
    pub(super) fn second_derivative(deviation: f64, radius: usize) -> Kernel {
        Kernel::balanced(&sampled(radius, |x| ((x / deviation) * (x / deviation) - 1.0) * bell(x / deviation)))
    }

    fn balanced(weights: &[f64]) -> Kernel {
        let positive: f64 = weights.iter().filter(|&&w| w > 0.0).sum();
        let negative: f64 = weights.iter().filter(|&&w| w < 0.0).sum();
        Kernel::scaled(weights, 1.0 / positive, -1.0 / negative)
    }

    fn scaled(weights: &[f64], if_positive: f64, if_negative: f64) -> Kernel {
        let scale = |&w: &f64| (w * if w > 0.0 { if_positive } else { if_negative }) as f32;
        Kernel { weights: weights.iter().map(scale).collect() }
    }

    fn radius(&self) -> usize {
        self.weights.len() / 2
    }
}

/// The function at the whole numbers from `-radius` to `radius`.
fn sampled(radius: usize, function: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * radius).map(|i| function(i as f64 - radius as f64)).collect()
}

/// The bell curve of deviation 1, not normalized.
fn bell(x: f64) -> f64 {
    f64::from(exp((-0.5 * x * x) as f32))
}

impl Plane {
    /// A plane of rows of `width` values.
    pub(super) fn new(width: usize, values: Vec<f32>) -> Plane {
        Plane { width, values }
    }

    /// Adds `other` times `scale`.
    pub(super) fn add_scaled(&mut self, other: &Plane, scale: f32) {
        add_scaled(&mut self.values, &other.values, scale);
    }

    /// Each row under the kernel.
    pub(super) fn along_rows(&self, kernel: &Kernel) -> Plane {
        let radius = kernel.radius();
        let mut result = vec![0.0; self.values.len()];
        let mut padded = Vec::with_capacity(self.width + 2 * radius);
        for (row, out) in self.values.chunks_exact(self.width).zip(result.chunks_exact_mut(self.width)) {
            padded.clear();
            padded.resize(radius, row[0]);
            padded.extend_from_slice(row);
            padded.resize(self.width + 2 * radius, row[self.width - 1]);
            for (shifted, &weight) in padded.windows(self.width).zip(&kernel.weights) {
                add_scaled(out, shifted, weight);
            }
        }
        Plane::new(self.width, result)
    }

    /// Each column under the kernel.
    pub(super) fn along_columns(&self, kernel: &Kernel) -> Plane {
        let mut result = vec![0.0; self.values.len()];
        let last = self.values.len() / self.width - 1;
        for (y, out) in result.chunks_exact_mut(self.width).enumerate() {
            for (i, &weight) in kernel.weights.iter().enumerate() {
                let from = (y + i).saturating_sub(kernel.radius()).min(last);
                add_scaled(out, &self.values[from * self.width..][..self.width], weight);
            }
        }
        Plane::new(self.width, result)
    }
}

/// Adds `values` times `scale` to `sums`, one by one: a loop that compilers turn into vector instructions.
fn add_scaled(sums: &mut [f32], values: &[f32], scale: f32) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += scale * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_sum_to_what_they_should() {
        let sum = |kernel: &Kernel| kernel.weights.iter().sum::<f32>();
        let size = |kernel: &Kernel| kernel.weights.iter().map(|w| w.abs()).sum::<f32>();
        let (gaussian, _) = Kernel::gaussian(2.5, 8);
        assert!((sum(&gaussian) - 1.0).abs() < 1e-6);
        for kernel in [Kernel::first_derivative(2.5, 8), Kernel::second_derivative(2.5, 8)] {
            assert!(sum(&kernel).abs() < 1e-6 && (size(&kernel) - 2.0).abs() < 1e-6);
            assert_eq!(kernel.weights.len(), 17);
        }
    }

    #[test]
    fn a_single_spot_shows_the_kernel() {
        let kernel = Kernel { weights: vec![1.0, 2.0, 4.0] };
        let spot = Plane::new(3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(spot.along_rows(&kernel).values[3..6], [4.0, 2.0, 1.0]);
        let columns = spot.along_columns(&kernel).values;
        assert_eq!([columns[1], columns[4], columns[7]], [4.0, 2.0, 1.0]);
    }

    #[test]
    fn the_border_goes_on() {
        let (kernel, _) = Kernel::gaussian(3.0, 9);
        let plane = Plane::new(2, vec![0.5; 6]);
        for value in plane.along_rows(&kernel).along_columns(&kernel).values {
            assert!((value - 0.5).abs() < 1e-6);
        }
    }
}
