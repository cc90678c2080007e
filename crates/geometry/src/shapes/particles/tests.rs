//! Particles keep the laws of single shapes, and are hit where those are hit; the tree and every instruction set find what
//! testing all one by one finds, to the last bit.

mod as_single_shapes;
mod laws;
mod places;
mod rays_that_leave;
mod trees;

use super::super::testing::{Known, Random};
use super::*;
use crate::{Primitive, SimdLevel, Surface, World};
use durer_math::functions::cbrt;
use durer_math::{DAffine3, DMat3, rotation};
use std::sync::Arc;

/// What a particle is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum One {
    Sphere(DVec3, f64),
    Frustum([DVec3; 2], [f64; 2]),
    Tube([DVec3; 2], [f64; 2]),
    Capsule([DVec3; 2], f64),
}

/// The kinds, to be gone through.
const KINDS: [u32; 4] = [0, 1, 2, 3];

impl One {
    fn set(self) -> Particles {
        set(SimdLevel::best(), &[self])
    }

    /// The same as single shapes placed by `map`; a capsule is several.
    fn singles(self, map: &DAffine3) -> Vec<Primitive> {
        match self {
            One::Sphere(center, radius) => vec![Primitive::sphere(center, radius, map)],
            One::Frustum([base, top], radii) if radii[0] == radii[1] => {
                vec![Primitive::cylinder(base, top, radii[0], false, map)]
            }
            One::Frustum([base, top], radii) => vec![Primitive::cone(base, top, radii, false, map)],
            One::Tube([base, top], radii) if radii[0] == radii[1] => {
                vec![Primitive::cylinder(base, top, radii[0], true, map)]
            }
            One::Tube([base, top], radii) => vec![Primitive::cone(base, top, radii, true, map)],
            One::Capsule([base, top], radius) => vec![
                Primitive::sphere(base, radius, map),
                Primitive::sphere(top, radius, map),
                Primitive::cylinder(base, top, radius, false, map),
            ],
        }
    }

    /// About how large it is.
    fn size(self) -> f64 {
        match self {
            One::Sphere(_, radius) => radius,
            One::Frustum([base, top], radii) | One::Tube([base, top], radii) => {
                (top - base).length() + radii[0].max(radii[1])
            }
            One::Capsule([base, top], radius) => (top - base).length() + radius,
        }
    }

    /// Below 0 inside; outside no more than the distance, and convex. Tubes are taken as closed.
    fn depth(self, p: DVec3) -> f64 {
        match self {
            One::Sphere(center, radius) => (p - center).length() - radius,
            One::Frustum([base, top], radii) | One::Tube([base, top], radii) => {
                let (length, up) = ((top - base).length(), (top - base).normalize());
                let slope = (radii[1] - radii[0]) / length;
                let height = (p - base).dot(up);
                let away = (p - base).cross(up).length();
                let side = (away - radii[0] - slope * height) / (1.0 + slope * slope).sqrt();
                side.max(-height).max(height - length)
            }
            One::Capsule([base, top], radius) => {
                let along = (p - base).dot(top - base) / (top - base).length_squared();
                (p - base.lerp(top, along.clamp(0.0, 1.0))).length() - radius
            }
        }
    }

    /// From one end to the other; any direction for a sphere.
    fn axis(self) -> DVec3 {
        match self {
            One::Sphere(..) => DVec3::Y,
            One::Frustum([base, top], _) | One::Tube([base, top], _) | One::Capsule([base, top], _) => top - base,
        }
    }

    /// The direction of a straight line in the side.
    fn generator(self, around: DVec3) -> DVec3 {
        let out = self.axis().cross(around).normalize();
        match self {
            One::Frustum(_, radii) | One::Tube(_, radii) => self.axis() + out * (radii[1] - radii[0]),
            One::Sphere(..) | One::Capsule(..) => self.axis(),
        }
    }

    fn center(self) -> DVec3 {
        match self {
            One::Sphere(center, _) => center,
            One::Frustum([base, top], _) | One::Tube([base, top], _) | One::Capsule([base, top], _) => {
                (base + top) * 0.5
            }
        }
    }
}

/// Particles of the kind of the first.
fn set(level: SimdLevel, all: &[One]) -> Particles {
    let ends = |index: usize| match all[index] {
        One::Sphere(center, radius) => ([center; 2], [radius; 2]),
        One::Frustum(ends, radii) | One::Tube(ends, radii) => (ends, radii),
        One::Capsule(ends, radius) => (ends, [radius; 2]),
    };
    let round = |index: usize| (ends(index).0, ends(index).1[0]);
    match all[0] {
        One::Sphere(..) => Particles::spheres(all.len(), level.into(), |index| (round(index).0[0], round(index).1)),
        One::Frustum(..) => Particles::frusta(all.len(), false, level.into(), ends),
        One::Tube(..) => Particles::frusta(all.len(), true, level.into(), ends),
        One::Capsule(..) => Particles::capsules(all.len(), level.into(), round),
    }
}

fn single_precision(v: DVec3) -> DVec3 {
    wide(narrow(v))
}

impl Random {
    /// A particle whose numbers are the same in single precision.
    fn particle(&mut self, kind: u32, at: DVec3, size: f64) -> One {
        let center = single_precision(at);
        let mut radius = || f64::from((self.between(0.2, 1.0) * size) as f32);
        let (base_radius, mut top_radius) = (radius(), radius());
        match self.between(0.0, 4.0) as u32 {
            0 => top_radius = base_radius,
            1 => top_radius = 0.0,
            _ => {}
        }
        let radii = if self.between(0.0, 1.0) < 0.5 { [base_radius, top_radius] } else { [top_radius, base_radius] };
        let way = match self.between(0.0, 6.0) as usize {
            axis @ 0..3 => DVec3::AXES[axis],
            _ => self.direction(),
        };
        let ends = [center, single_precision(center + way * (size * self.between(0.5, 4.0)))];
        match kind {
            0 => One::Sphere(center, base_radius),
            1 => One::Frustum(ends, radii),
            2 => One::Tube(ends, radii),
            _ => One::Capsule(ends, base_radius),
        }
    }

    fn map(&mut self) -> DAffine3 {
        let stretch = DVec3::new(self.between(0.3, 2.0), self.between(-2.0, -0.3), self.between(0.3, 2.0));
        let turn = rotation(self.direction(), self.between(0.0, 6.0)) * DMat3::from_diagonal(stretch);
        DAffine3::from_mat3_translation(turn * rotation(self.direction(), 1.0), self.in_cube() * 10.0)
    }

    fn particles(&mut self, kind: u32, count: usize) -> Vec<One> {
        let size = 1.0 / cbrt(count as f64);
        (0..count)
            .map(|_| {
                let at = self.in_cube();
                self.particle(kind, at, size)
            })
            .collect()
    }
}
