//! Aiming at a triangle: uniform in the solid angle that it fills, or by area from where that is hardly something else.
//!
//! Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995. The solid angle is by van Oosterom and Strackee, "The
//! Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2), 1983.

use super::{Chosen, FAR, Target, per_solid_angle};
use durer_math::functions::{atan2, cos, sin};
use durer_math::{DVec2, DVec3};

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    corners: [DVec3; 3],
    /// Twice its area times its unit normal.
    cross: DVec3,
}

/// Where directions hardly differ, area serves as well and loses no digits; and where nearly all of the half-space is filled,
/// from just above it.
const SMALL: f64 = 1e-4;
const LARGE: f64 = 6.2;

impl Triangle {
    pub(super) fn new(corners: [DVec3; 3]) -> Triangle {
        let [a, b, c] = corners;
        Triangle { corners, cross: (b - a).cross(c - a) }
    }

    pub(super) fn corners(&self) -> [DVec3; 3] {
        self.corners
    }

    pub(super) fn area(&self) -> f64 {
        0.5 * self.cross.length()
    }

    pub(super) fn middle(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        a + ((b - a) + (c - a)) / 3.0
    }

    /// True if no point of it is much farther away than another, by the ball around its middle.
    fn is_far(&self, from: DVec3) -> bool {
        // (d + r)² ≤ FAR (d - r)², where d ≥ RATIO r.
        const RATIO: f64 = 5.83;
        const { assert!((RATIO + 1.0) * (RATIO + 1.0) <= FAR * (RATIO - 1.0) * (RATIO - 1.0)) };
        let middle = self.middle();
        let squared = |corner: DVec3| (corner - middle).length_squared();
        let [a, b, c] = self.corners.map(squared);
        (from - middle).length_squared() >= RATIO * RATIO * a.max(b).max(c)
    }

    /// The directions of the corners, of unit length, and the solid angle; `None` if that is too small or too large, or from
    /// so far that area serves as well.
    fn seen(&self, from: DVec3) -> Option<([DVec3; 3], f64)> {
        if self.is_far(from) {
            return None;
        }
        let [a, b, c] = self.corners.map(|corner| (corner - from).normalize_or_zero());
        let triple = a.dot(b.cross(c)).abs();
        let solid_angle = 2.0 * atan2(triple, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        (solid_angle > SMALL && solid_angle < LARGE).then_some(([a, b, c], solid_angle))
    }

    fn pdf_by_area(&self, from: DVec3, point: DVec3) -> f64 {
        let twice = self.cross.length();
        per_solid_angle(2.0 / twice, from, point, self.cross / twice)
    }

    /// A direction from the spherical triangle.
    fn direction([a, b, c]: [DVec3; 3], solid_angle: f64, at: DVec2) -> DVec3 {
        let (to_b, to_c) = (a.cross(b), a.cross(c));
        // The angle at a.
        let alpha = atan2(to_b.cross(to_c).length(), to_b.dot(to_c));
        let (sin_alpha, cos_alpha) = (sin(alpha), cos(alpha));
        let part = at.x * solid_angle - alpha;
        let (s, t) = (sin(part), cos(part));
        let (u, v) = (t - cos_alpha, s + sin_alpha * a.dot(b));
        let q = ((v * t - u * s) * cos_alpha - v) / ((v * s + u * t) * sin_alpha);
        let q = if q.is_nan() { 1.0 } else { q.clamp(-1.0, 1.0) };
        let new_c = a * q + (c - a * a.dot(c)).normalize_or_zero() * (1.0 - q * q).sqrt();
        let less = at.y * (1.0 - new_c.dot(b));
        b * (1.0 - less) + (new_c - b * new_c.dot(b)).normalize_or_zero() * (less * (2.0 - less)).max(0.0).sqrt()
    }
}

impl Target for Triangle {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let [a, b, c] = self.corners;
        let Some((corners, solid_angle)) = self.seen(from) else {
            let root = at.x.sqrt();
            let point = a + (b - a) * (root * (1.0 - at.y)) + (c - a) * (root * at.y);
            return Some(Chosen { point, part: 0, pdf: self.pdf_by_area(from, point) });
        };
        let direction = Triangle::direction(corners, solid_angle, at);
        let length = (a - from).dot(self.cross) / direction.dot(self.cross);
        (length > 0.0 && length.is_finite()).then_some(Chosen {
            point: from + direction * length,
            part: 0,
            pdf: 1.0 / solid_angle,
        })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        match self.seen(from) {
            Some((_, solid_angle)) => 1.0 / solid_angle,
            None => self.pdf_by_area(from, point),
        }
    }
}
