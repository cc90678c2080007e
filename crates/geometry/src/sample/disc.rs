//! Aiming at a disc, by area.

use super::{Chosen, Target, per_solid_angle};
use durer_math::functions::{cos, sin};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// The points with y = 0 and `inner_radius` ≤ r ≤ 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disc {
    pub(super) inner_radius: f64,
}

impl Disc {
    pub(super) fn area(&self) -> f64 {
        PI * (1.0 - self.inner_radius * self.inner_radius)
    }
}

/// Uniform between two radii: x and z.
pub(super) fn in_ring(inner: f64, outer: f64, at: DVec2) -> DVec2 {
    let (low, high) = (inner * inner, outer * outer);
    let radius = (low + at.x * (high - low)).sqrt();
    let angle = 2.0 * PI * at.y;
    DVec2::new(radius * cos(angle), radius * sin(angle))
}

impl Target for Disc {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let place = in_ring(self.inner_radius, 1.0, at);
        let point = DVec3::new(place.x, 0.0, place.y);
        Some(Chosen { point, part: 0, pdf: self.pdf(from, point, 0) })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        per_solid_angle(1.0 / self.area(), from, point, DVec3::Y)
    }
}
