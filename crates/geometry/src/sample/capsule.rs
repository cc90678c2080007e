//! Aiming at a capsule, by the area of what is seen of its side and that of its half balls.

use super::ball::on_sphere;
use super::{Chosen, Target, per_solid_angle};
use crate::Bounds;
use durer_math::functions::{acos, atan2, cos, sin};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// All points no further than 1 from the y axis between y = 0 and y = `length`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    pub(super) length: f64,
}

impl Capsule {
    pub(super) fn area(&self) -> f64 {
        2.0 * PI * (2.0 + self.length)
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::NEG_ONE, max: DVec3::new(1.0, self.length + 1.0, 1.0) }
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let on_axis = DVec3::new(0.0, point.y.clamp(0.0, self.length), 0.0);
        (point - on_axis).normalize_or(DVec3::X)
    }

    /// Half of the range of angles in which the side is seen, the part of points that is chosen there, and whether what
    /// faces away is hidden.
    fn seen(&self, from: DVec3) -> (f64, f64, bool) {
        let distance = (from.x * from.x + from.z * from.z).sqrt();
        let on_axis = DVec3::new(0.0, from.y.clamp(0.0, self.length), 0.0);
        let outside = (from - on_axis).length_squared() > 1.0;
        let half_range = match outside {
            false => PI,
            true if distance <= 1.0 => 0.0,
            true => acos(1.0 / distance),
        };
        let side = 2.0 * half_range * self.length;
        (half_range, side / (side + 4.0 * PI), outside)
    }
}

impl Target for Capsule {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let (half_range, side, _) = self.seen(from);
        let point = if at.x < side {
            let around = if from.x == 0.0 && from.z == 0.0 { 0.0 } else { atan2(from.z, from.x) };
            let angle = around + half_range * (2.0 * at.y - 1.0);
            DVec3::new(cos(angle), self.length * (at.x / side), sin(angle))
        } else {
            let on_ball = on_sphere(DVec2::new((at.x - side) / (1.0 - side), at.y));
            if on_ball.y > 0.0 { on_ball + DVec3::Y * self.length } else { on_ball }
        };
        let pdf = self.pdf(from, point, 0);
        (pdf > 0.0).then_some(Chosen { point, part: 0, pdf })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        let (half_range, side, hides) = self.seen(from);
        let normal = self.normal(point);
        if hides && normal.dot(from - point) < 0.0 {
            return 0.0;
        }
        let on_side = point.y > 0.0 && point.y < self.length;
        let per_area = if on_side { side / (2.0 * half_range * self.length) } else { (1.0 - side) / (4.0 * PI) };
        if per_area.is_finite() { per_solid_angle(per_area, from, point, normal) } else { 0.0 }
    }
}
