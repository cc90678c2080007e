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
}

impl Planes {
    /// Four planes that nothing meets.
    pub(crate) const EMPTY: Planes = Planes { normal: [[0.0; 4]; 3], point: [[0.0; 4]; 3] };

    /// Puts a plane into a slot.
    pub(crate) fn set(&mut self, slot: usize, normal: DVec3, point: DVec3) {
        for axis in 0..3 {
            self.normal[axis][slot] = normal[axis];
            self.point[axis][slot] = point[axis];
        }
    }

    /// Which planes the ray meets with 0 < t < `t_max`, one bit each, and where.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64) -> (u64, [f64; 4]) {
        let load = |lanes: &[f64; 4]| f64x4::simd_from(simd, *lanes);
        let splat = |x: f64| f64x4::splat(simd, x);
        let [nx, ny, nz] = [load(&self.normal[0]), load(&self.normal[1]), load(&self.normal[2])];
        let height = nx * (splat(ray.origin.x) - load(&self.point[0]))
            + ny * (splat(ray.origin.y) - load(&self.point[1]))
            + nz * (splat(ray.origin.z) - load(&self.point[2]));
        let rate = nx * splat(ray.direction.x) + ny * splat(ray.direction.y) + nz * splat(ray.direction.z);
        let t = -height / rate;
        let hit = t.simd_gt(splat(0.0)) & t.simd_lt(splat(t_max));
        (hit.to_bitmask(), t.into())
    }
}
