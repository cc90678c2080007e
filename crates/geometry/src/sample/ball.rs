//! Aiming at the unit ball: at the cone that it fills, or from inside by area.

use super::{Chosen, Shows, Target, per_solid_angle};
use durer_math::functions::{cos, sin};
use durer_math::{DVec2, DVec3, any_orthonormal_pair};
use std::f64::consts::PI;

/// Uniform on the unit sphere.
pub(super) fn on_sphere(at: DVec2) -> DVec3 {
    let y = 1.0 - 2.0 * at.x;
    let across = (1.0 - y * y).max(0.0).sqrt();
    let angle = 2.0 * PI * at.y;
    DVec3::new(across * cos(angle), y, across * sin(angle))
}

/// 1 less the cosine of the half-angle under which the unit ball is seen at this distance, squared, from its middle.
fn cone(squared: f64) -> f64 {
    let sine2 = 1.0 / squared;
    sine2 / (1.0 + (1.0 - sine2).max(0.0).sqrt())
}

/// The ball, by what of it is seen.
impl Target for Shows {
    /// Shirley, Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15(1), 1996.
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let squared = from.length_squared();
        if *self == Shows::BothSides || squared <= 1.0 {
            let point = on_sphere(at);
            return Some(Chosen { point, part: 0, pdf: self.pdf(from, point, 0) });
        }
        let distance = squared.sqrt();
        let whole = cone(squared);
        // 1 - cosine, which small cones need to the last bit.
        let less = at.x * whole;
        let (cosine, sine2) = (1.0 - less, less * (2.0 - less));
        let axis = from / -distance;
        let (u, v) = any_orthonormal_pair(axis);
        let angle = 2.0 * PI * at.y;
        let direction = axis * cosine + (u * cos(angle) + v * sin(angle)) * sine2.sqrt();
        let length = distance * cosine - (1.0 - squared * sine2).max(0.0).sqrt();
        let point = (from + direction * length).normalize();
        Some(Chosen { point, part: 0, pdf: 1.0 / (2.0 * PI * whole) })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        let squared = from.length_squared();
        if *self == Shows::BothSides || squared <= 1.0 {
            per_solid_angle(1.0 / (4.0 * PI), from, point, point.normalize_or_zero())
        } else if point.dot(from) < point.length_squared() {
            0.0
        } else {
            1.0 / (2.0 * PI * cone(squared))
        }
    }
}
