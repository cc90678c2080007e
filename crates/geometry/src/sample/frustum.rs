//! Aiming at a cone, cylinder or frustum: by the area of what is seen of it.

use super::disc::in_ring;
use super::{Chosen, Shows, Target, per_solid_angle};
use crate::Bounds;
use durer_math::functions::{acos, atan2, cos, sin};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// About the y axis, from y = 0 to y = 1. Part 0 is the side, 1 the base, 2 the top.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frustum {
    /// At base and top.
    radii: [f64; 2],
    open: bool,
    shows: Shows,
    /// About the areas, in the world, of the side, the base and the top.
    areas: [f64; 3],
}

/// What is seen of it from somewhere.
struct Seen {
    /// Half of the range of angles about the axis in which the side is seen; 0 if it is not.
    half_range: f64,
    /// The chances of side, base and top.
    chances: [f64; 3],
    /// False if no side faces away from there.
    hides: bool,
}

impl Frustum {
    /// `stretches` are those of areas perpendicular to the axes, from here to the world.
    pub(super) fn new(radii: [f64; 2], open: bool, shows: Shows, [x, y, z]: [f64; 3]) -> Frustum {
        let slope = radii[1] - radii[0];
        // The mean square of how the side is stretched, all around.
        let square = (0.5 * (x * x + z * z) + slope * slope * y * y) / (1.0 + slope * slope);
        let side = PI * (radii[0] + radii[1]) * (1.0 + slope * slope).sqrt() * square.sqrt();
        let cap = |radius: f64| if open { 0.0 } else { PI * radius * radius * y };
        Frustum { radii, open, shows, areas: [side, cap(radii[0]), cap(radii[1])] }
    }

    pub(super) fn area(&self) -> f64 {
        self.areas.into_iter().sum()
    }

    pub(super) fn bounds(&self) -> Bounds {
        let radius = self.radii[0].max(self.radii[1]);
        Bounds { min: DVec3::new(-radius, 0.0, -radius), max: DVec3::new(radius, 1.0, radius) }
    }

    fn slope(&self) -> f64 {
        self.radii[1] - self.radii[0]
    }

    fn radius_at(&self, y: f64) -> f64 {
        self.radii[0] + self.slope() * y
    }

    fn seen(&self, from: DVec3) -> Seen {
        let (radius, distance) = (self.radius_at(from.y), (from.x * from.x + from.z * from.z).sqrt());
        let inside = from.y > 0.0 && from.y < 1.0 && distance < radius;
        let hides = !self.open && self.shows == Shows::OneSide && !inside;
        let mut weights = self.areas;
        let mut half_range = PI;
        if hides {
            // A point of the side faces someone if the cosine of the angle between both, about the axis, is above
            // radius/distance.
            half_range = if radius >= distance {
                0.0
            } else if radius <= -distance {
                PI
            } else {
                acos(radius / distance)
            };
            weights[0] *= half_range / PI;
            weights[1] *= f64::from(u8::from(from.y < 0.0));
            weights[2] *= f64::from(u8::from(from.y > 1.0));
        }
        let all: f64 = weights.into_iter().sum();
        Seen { half_range, chances: weights.map(|weight| if all > 0.0 { weight / all } else { 0.0 }), hides }
    }

    fn normal(&self, point: DVec3, part: u32) -> DVec3 {
        if part == 0 {
            let across = DVec2::new(point.x, point.z).normalize_or(DVec2::X);
            DVec3::new(across.x, -self.slope(), across.y).normalize()
        } else {
            DVec3::Y
        }
    }

    fn pdf_of(&self, seen: &Seen, from: DVec3, point: DVec3, part: u32) -> f64 {
        let normal = self.normal(point, part);
        let per_area = match part {
            0 => {
                if seen.hides && normal.dot(from - point) < 0.0 {
                    return 0.0;
                }
                let slope = self.slope();
                let side = seen.half_range * (self.radii[0] + self.radii[1]) * (1.0 + slope * slope).sqrt();
                seen.chances[0] / side
            }
            1 => seen.chances[1] / (PI * self.radii[0] * self.radii[0]),
            _ => seen.chances[2] / (PI * self.radii[1] * self.radii[1]),
        };
        if per_area.is_finite() { per_solid_angle(per_area, from, point, normal) } else { 0.0 }
    }

    /// A point of the side: its height has a density like the radius there.
    fn on_side(&self, around: f64, half_range: f64, at: DVec2) -> DVec3 {
        let [base, top] = self.radii;
        let radius = (base * base + at.x * (top * top - base * base)).sqrt();
        // Of (radius - base)/(top - base) the form that is good for cylinders, too.
        let height = (at.x * (base + top) / (radius + base)).clamp(0.0, 1.0);
        let height = if height.is_nan() { 0.0 } else { height };
        let angle = around + half_range * (2.0 * at.y - 1.0);
        DVec3::new(radius * cos(angle), height, radius * sin(angle))
    }
}

impl Target for Frustum {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let seen = self.seen(from);
        let [side, base, top] = seen.chances;
        let (point, part) = if at.x < side {
            let at = DVec2::new(at.x / side, at.y);
            let around = if from.x == 0.0 && from.z == 0.0 { 0.0 } else { atan2(from.z, from.x) };
            (self.on_side(around, seen.half_range, at), 0)
        } else if at.x < side + base || top == 0.0 {
            let place = in_ring(0.0, self.radii[0], DVec2::new(((at.x - side) / base).min(1.0), at.y));
            (DVec3::new(place.x, 0.0, place.y), 1)
        } else {
            let place = in_ring(0.0, self.radii[1], DVec2::new(((at.x - side - base) / top).min(1.0), at.y));
            (DVec3::new(place.x, 1.0, place.y), 2)
        };
        if seen.chances[part as usize] == 0.0 {
            return None;
        }
        Some(Chosen { point, part, pdf: self.pdf_of(&seen, from, point, part) })
    }

    fn pdf(&self, from: DVec3, point: DVec3, part: u32) -> f64 {
        self.pdf_of(&self.seen(from), from, point, part)
    }
}
