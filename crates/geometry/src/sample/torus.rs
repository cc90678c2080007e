//! Aiming at a torus, by area.

use super::{Chosen, Shows, Target, per_solid_angle};
use crate::Bounds;
use durer_math::functions::{cos, sin};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// The points at `tube_radius` from the unit circle in the plane y = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Torus {
    pub(super) tube_radius: f64,
    pub(super) shows: Shows,
}

impl Torus {
    pub(super) fn area(&self) -> f64 {
        4.0 * PI * PI * self.tube_radius
    }

    pub(super) fn bounds(&self) -> Bounds {
        let (r, reach) = (self.tube_radius, 1.0 + self.tube_radius);
        Bounds { min: DVec3::new(-reach, -r, -reach), max: DVec3::new(reach, r, reach) }
    }

    fn is_outside(&self, p: DVec3) -> bool {
        let beside = (p.x * p.x + p.z * p.z).sqrt() - 1.0;
        beside * beside + p.y * p.y > self.tube_radius * self.tube_radius
    }

    fn normal(&self, p: DVec3) -> DVec3 {
        let distance = (p.x * p.x + p.z * p.z).sqrt();
        let on_circle = if distance > 0.0 { DVec3::new(p.x / distance, 0.0, p.z / distance) } else { DVec3::X };
        (p - on_circle).normalize_or(DVec3::Y)
    }

    /// The angle about the tube with a density like the distance from the axis: a + r sin a = 2π u - π, which is Kepler's
    /// equation, by Newton's method held between bounds.
    fn angle(&self, u: f64) -> f64 {
        let (r, goal) = (self.tube_radius, PI * (2.0 * u - 1.0));
        let (mut low, mut high) = (-PI, PI);
        let mut a = goal / (1.0 + r);
        for _ in 0..60 {
            let miss = a + r * sin(a) - goal;
            if miss > 0.0 {
                high = a;
            } else {
                low = a;
            }
            let newton = a - miss / (1.0 + r * cos(a));
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - a).abs() <= 1e-15 {
                break;
            }
            a = next;
        }
        a
    }
}

impl Target for Torus {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let (about_tube, about_axis) = (self.angle(at.x), 2.0 * PI * at.y);
        let distance = 1.0 + self.tube_radius * cos(about_tube);
        let height = self.tube_radius * sin(about_tube);
        let point = DVec3::new(distance * cos(about_axis), height, distance * sin(about_axis));
        let pdf = self.pdf(from, point, 0);
        (pdf > 0.0).then_some(Chosen { point, part: 0, pdf })
    }

    fn pdf(&self, from: DVec3, point: DVec3, _part: u32) -> f64 {
        let normal = self.normal(point);
        if self.shows == Shows::OneSide && normal.dot(from - point) < 0.0 && self.is_outside(from) {
            return 0.0;
        }
        per_solid_angle(1.0 / self.area(), from, point, normal)
    }
}
