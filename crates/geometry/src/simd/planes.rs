//! One ray against four infinite planes, in double precision: the same arithmetic, operation by operation, as a plane's
//! own intersection.

use crate::Ray;
use durer_math::DVec3;
use fearless_simd::{Simd, f64x4, prelude::*};

/// Four planes, component by component. Unused slots have the normal 0, which no ray meets.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Planes {
    normal: [[f64; 4]; 3],
    point: [[f64; 4]; 3],
    /// The primitives that they are.
    pub(crate) ids: [u32; 4],
}

impl Planes {
    /// Four planes that nothing meets.
    pub(crate) const EMPTY: Planes = Planes { normal: [[0.0; 4]; 3], point: [[0.0; 4]; 3], ids: [0; 4] };

    /// Puts a plane into a slot.
    pub(crate) fn set(&mut self, slot: usize, id: u32, normal: DVec3, point: DVec3) {
        self.ids[slot] = id;
        for axis in 0..3 {
            self.normal[axis][slot] = normal[axis];
            self.point[axis][slot] = point[axis];
        }
    }

    /// How high a point is above each plane, in units of the normal's length.
    #[inline(always)]
    fn height<S: Simd>(&self, simd: S, p: DVec3) -> f64x4<S> {
        let along = |axis: usize, x: f64| {
            let from_plane = f64x4::splat(simd, x) - f64x4::from_slice(simd, &self.point[axis]);
            f64x4::from_slice(simd, &self.normal[axis]) * from_plane
        };
        along(0, p.x) + along(1, p.y) + along(2, p.z)
    }

    /// How fast the ray gains height above each plane.
    #[inline(always)]
    fn rate<S: Simd>(&self, simd: S, d: DVec3) -> f64x4<S> {
        let along = |axis: usize, x: f64| f64x4::from_slice(simd, &self.normal[axis]) * f64x4::splat(simd, x);
        along(0, d.x) + along(1, d.y) + along(2, d.z)
    }

    /// Which planes the ray meets with 0 < t < `t_max`, one bit each, and where.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64) -> (u32, [f64; 4]) {
        let t = -self.height(simd, ray.origin) / self.rate(simd, ray.direction);
        let hit = t.simd_gt(f64x4::splat(simd, 0.0)) & t.simd_lt(f64x4::splat(simd, t_max));
        (hit.to_bitmask() as u32, t.into())
    }
}
