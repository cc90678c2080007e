//! Where in and around a pixel its samples are taken: as often as the filter says (filter importance sampling: Ernst,
//! Stamminger and Greiner, "Filter Importance Sampling", RT 2006). So each sample belongs to one pixel, and all count alike,
//! but for the sign where the filter is below 0.

use crate::reconstruct::Kernel;
use durer_math::DVec2;
use durer_scene::PixelFilter;

/// A filter, to be sampled.
#[derive(Clone, Debug)]
pub(crate) struct FilterSampling {
    kernel: Kernel,
    /// Distances from the middle with as much of the filter's absolute value between each and the next, from the left end
    /// to the right one; empty for the box.
    knots: Vec<f64>,
}

/// The number of steps between knots, and of those that the filter is added up in.
const STEPS: usize = 1024;
const FINE_STEPS: usize = 1 << 15;

impl FilterSampling {
    pub(crate) fn new(filter: PixelFilter) -> FilterSampling {
        let kernel = Kernel { filter };
        FilterSampling { kernel, knots: if kernel.is_box() { Vec::new() } else { knots(kernel) } }
    }

    /// The place of a sample in the picture, for a pixel and a point of the unit square; true if it counts negatively.
    pub(crate) fn place(&self, (x, y): (u32, u32), point: DVec2) -> (DVec2, bool) {
        let corner = DVec2::new(f64::from(x), f64::from(y));
        if self.knots.is_empty() {
            return (corner + point, false);
        }
        let away = DVec2::new(self.along(point.x), self.along(point.y));
        let is_negative = (self.kernel.at(away.x) < 0.0) != (self.kernel.at(away.y) < 0.0);
        (corner + 0.5 + away, is_negative)
    }

    /// A distance from the middle, along one axis.
    fn along(&self, number: f64) -> f64 {
        let place = number * STEPS as f64;
        let step = (place as usize).min(STEPS - 1);
        let (from, to) = (self.knots[step], self.knots[step + 1]);
        from + (to - from) * (place - step as f64)
    }
}

fn knots(kernel: Kernel) -> Vec<f64> {
    let radius = kernel.radius();
    let width = 2.0 * radius / FINE_STEPS as f64;
    // In the middle of each fine step.
    let heights = || (0..FINE_STEPS).map(|step| kernel.at((step as f64 + 0.5) * width - radius).abs());
    let whole: f64 = heights().sum();
    let mut knots = Vec::with_capacity(STEPS + 1);
    knots.push(-radius);
    let mut sum = 0.0;
    for (step, height) in heights().enumerate() {
        while knots.len() < STEPS && sum + height >= whole * knots.len() as f64 / STEPS as f64 {
            let part = (whole * knots.len() as f64 / STEPS as f64 - sum) / height;
            knots.push((step as f64 + part) * width - radius);
        }
        sum += height;
    }
    knots.resize(STEPS + 1, radius);
    knots
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILTERS: [PixelFilter; 5] = [
        PixelFilter::Box,
        PixelFilter::Tent { radius: 1.0 },
        PixelFilter::Gaussian { radius: 1.5, sigma: 0.5 },
        PixelFilter::Mitchell { radius: 2.0 },
        PixelFilter::BlackmanHarris { radius: 1.5 },
    ];

    /// As often as the filter's integral over a strip says, signs counted, on a lattice of points.
    #[test]
    fn places_are_as_frequent_as_the_filter_says() {
        for filter in FILTERS {
            let sampling = FilterSampling::new(filter);
            let kernel = Kernel { filter };
            let radius = kernel.radius();
            let integral = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| {
                let width = (to - from) / 1e4;
                (0..10_000).map(|step| f(kernel.at(from + (f64::from(step) + 0.5) * width))).sum::<f64>() * width
            };
            let absolute = integral(-radius, radius, &f64::abs);
            for strip in 0..8 {
                let (from, to) = (f64::from(strip) / 4.0 - 1.0, f64::from(strip + 1) / 4.0 - 1.0);
                let (from, to) = (from * radius, to * radius);
                let (mut found, points) = (0.0, 1 << 14);
                for point in 0..points {
                    // Through the middle of the pixel, where no filter is negative.
                    let at = DVec2::new((f64::from(point) + 0.5) / f64::from(points), 0.5);
                    let (place, is_negative) = sampling.place((7, 3), at);
                    assert!((place.y - 3.5).abs() < 1e-6, "{filter:?}: {place}");
                    if (from..to).contains(&(place.x - 7.5)) {
                        found += if is_negative { -1.0 } else { 1.0 } / f64::from(points);
                    }
                }
                let expected = integral(from, to, &|height| height) / absolute;
                assert!((found - expected).abs() < 1e-3, "{filter:?}, {strip}: {found}, not {expected}");
            }
        }
    }

    #[test]
    fn all_places_lie_within_the_filter() {
        for filter in FILTERS {
            let (sampling, radius) = (FilterSampling::new(filter), Kernel { filter }.radius());
            for number in [0.0, 1e-9, 0.25, 0.5, 1.0 - 1.0 / 4_294_967_296.0] {
                let away = sampling.place((0, 0), DVec2::splat(number)).0 - 0.5;
                assert!(away.abs().max_element() <= radius, "{filter:?}, {number}: {away}");
            }
        }
    }
}
