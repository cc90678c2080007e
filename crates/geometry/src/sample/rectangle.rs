//! Aiming at a rectangle: uniform in the solid angle that it fills; or by area from where that is hardly something else, which
//! costs a quarter.
//!
//! Ureña, Fajardo and King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013. Its angles are computed
//! by `atan2` of what their sines and cosines are in terms of corners, which loses no digits near the rectangle's plane; their
//! sums by one `atan2` each, of what the angles are as complex numbers multiplied.

use super::{Chosen, FAR, Target, per_solid_angle};
use crate::Bounds;
use durer_math::functions::{atan2, cos_sin_of_turns};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// The points with y = 0, 0 ≤ x ≤ `lengths[0]` and 0 ≤ z ≤ `lengths[1]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    pub(super) lengths: [f64; 2],
}

/// Solid angles below this are too small for what rounding leaves of a sum of angles: there area serves as well.
const SMALL: f64 = 1e-7;

/// A rectangle seen from the origin, in a plane at some height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The least and the greatest of both coordinates.
    x: [f64; 2],
    y: [f64; 2],
    /// Above 0 if it can be seen.
    height: f64,
    /// 2π less two of the angles of the spherical rectangle.
    rest: f64,
    /// In steradians; NaN in the plane of the rectangle.
    pub(super) solid_angle: f64,
}

impl Seen {
    pub(super) fn new(x: [f64; 2], y: [f64; 2], height: f64) -> Seen {
        // Sine and cosine of the angle at a corner, times the same.
        let corner = |x: f64, y: f64| [height * (x * x + y * y + height * height).sqrt(), x * y];
        let turned = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * d + b * c, b * d - a * c];
        let other_way = |[sine, cosine]: [f64; 2]| [sine, -cosine];
        // Two angles from 0 to π each, whose sum is from 0 to 2π; all four are 2π more than the solid angle.
        let first = turned(corner(x[0], y[1]), other_way(corner(x[0], y[0])));
        let second = turned(corner(x[1], y[0]), other_way(corner(x[1], y[1])));
        let all = turned(scaled(first), scaled(second));
        let rest = 2.0 * PI - positive(atan2(first[0], first[1]));
        let solid_angle = positive(atan2(all[0], all[1]));
        Seen { x, y, height, rest, solid_angle }
    }

    /// What it weighs from so far away that all its points are seen alike.
    pub(super) fn weight_from_afar(&self) -> f64 {
        self.area() * self.height
    }

    fn area(&self) -> f64 {
        (self.x[1] - self.x[0]) * (self.y[1] - self.y[0])
    }

    fn is_small(&self) -> bool {
        self.solid_angle.is_nan() || self.solid_angle < SMALL
    }

    /// Coordinates of a point in the plane.
    pub(super) fn sample(&self, at: DVec2) -> DVec2 {
        let ([x0, x1], [y0, y1], h) = (self.x, self.y, self.height);
        if self.is_small() {
            return DVec2::new(x0 + at.x * (x1 - x0), y0 + at.y * (y1 - y0));
        }
        // Of the two planes through the origin and the sides along x, the cosines to the rectangle's.
        let (low, high) = (-y0 / (h * h + y0 * y0).sqrt(), y1 / (h * h + y1 * y1).sqrt());
        let (cosine, sine) = cos_sin_of_turns((at.x * self.solid_angle + self.rest) * (0.5 / PI));
        let f = (cosine * low - high) / sine;
        // The cosine to the x axis of the plane through the y axis in which the point is, is one over the root of f² + low²: its
        // tangent gives x. A clamp undoes what was rounded.
        let x = (h / (f * f + low * low - 1.0).max(0.0).sqrt()).copysign(f).clamp(x0, x1);
        let x = if x.is_nan() { x0 } else { x };
        let d2 = x * x + h * h;
        let sine = |y: f64| y / (d2 + y * y).sqrt();
        let s = sine(y0) + at.y * (sine(y1) - sine(y0));
        let left = 1.0 - s * s;
        let y = if left > 1e-12 {
            (s * (d2 / left).sqrt()).clamp(y0, y1)
        } else if s > 0.0 {
            y1
        } else {
            y0
        };
        DVec2::new(x, y)
    }

    /// Density per solid angle of a point in the plane.
    pub(super) fn pdf(&self, point: DVec2) -> f64 {
        if !self.is_small() {
            return 1.0 / self.solid_angle;
        }
        let squared = point.length_squared() + self.height * self.height;
        if self.height > 0.0 { squared * squared.sqrt() / (self.height * self.area()) } else { 0.0 }
    }
}

/// An angle from 0 to 2π.
fn positive(angle: f64) -> f64 {
    if angle < 0.0 { angle + 2.0 * PI } else { angle }
}

/// A complex number of any size with one about as long as 1.
fn scaled([a, b]: [f64; 2]) -> [f64; 2] {
    let size = a.abs().max(b.abs());
    if size > 0.0 { [a / size, b / size] } else { [a, b] }
}

impl Rectangle {
    pub(super) fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::ZERO, max: DVec3::new(self.lengths[0], 0.0, self.lengths[1]) }
    }

    fn seen(&self, from: DVec3) -> Seen {
        let [x, z] = self.lengths;
        Seen::new([-from.x, x - from.x], [-from.z, z - from.z], from.y.abs())
    }

    /// True if no point of it is much farther away than another.
    fn is_far(&self, from: DVec3) -> bool {
        let ends = |at: f64, length: f64| {
            let (a, b) = (at * at, (at - length) * (at - length));
            [if at > 0.0 && at < length { 0.0 } else { a.min(b) }, a.max(b)]
        };
        let ([x0, x1], [z0, z1]) = (ends(from.x, self.lengths[0]), ends(from.z, self.lengths[1]));
        let height = from.y * from.y;
        x1 + z1 + height <= FAR * (x0 + z0 + height)
    }
}

impl Target for Rectangle {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        if from.y == 0.0 {
            return None;
        }
        let [x, z] = self.lengths;
        if self.is_far(from) {
            let point = DVec3::new(at.x * x, 0.0, at.y * z);
            return Some(Chosen { point, part: 0, pdf: per_solid_angle(1.0 / (x * z), from, point, DVec3::Y) });
        }
        let seen = self.seen(from);
        let place = seen.sample(at);
        let point = DVec3::new(from.x + place.x, 0.0, from.z + place.y);
        Some(Chosen { point, part: 0, pdf: seen.pdf(place) })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        if self.is_far(from) {
            return per_solid_angle(1.0 / (self.lengths[0] * self.lengths[1]), from, point, DVec3::Y);
        }
        self.seen(from).pdf(DVec2::new(point.x - from.x, point.z - from.z))
    }
}
