//! One ray against four triangles, in double precision: the watertight test of Woop, Benthin and Wald, operation by
//! operation as a single triangle's own (see `shapes/triangle.rs`).
//!
//! Corners are stored in single precision, as files have them, and widened when they are tested: four in double precision
//! take as many instructions as four in single precision would, and nothing is lost.

use crate::Ray;
use fearless_simd::{Simd, f32x4, f64x4, prelude::*};

/// Four triangles. Unused slots repeat the first.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Triangles {
    /// By axis, corner and triangle.
    corners: [[[f32; 4]; 3]; 3],
    /// The numbers of the triangles.
    pub(crate) ids: [u32; 4],
}

impl Triangles {
    /// How many there are in a block.
    pub(crate) const COUNT: usize = 4;

    /// At most four triangles, with their numbers; at least one.
    pub(crate) fn new(triangles: impl IntoIterator<Item = (u32, [[f32; 3]; 3])>) -> Triangles {
        let mut block = Triangles { corners: [[[0.0; 4]; 3]; 3], ids: [0; 4] };
        for (slot, (id, corners)) in triangles.into_iter().enumerate() {
            for slot in slot..4 {
                block.ids[slot] = id;
                for (corner, position) in corners.iter().enumerate() {
                    for (axis, &coordinate) in position.iter().enumerate() {
                        block.corners[axis][corner][slot] = coordinate;
                    }
                }
            }
        }
        block
    }
}

/// What of a ray the triangle test needs: its axes turned so that z is the longest, its shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleRay<S: Simd> {
    axes: [usize; 3],
    origin: [f64x4<S>; 3],
    shear: [f64x4<S>; 2],
    inverse: f64x4<S>,
}

impl<S: Simd> TriangleRay<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &Ray) -> TriangleRay<S> {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        let z = crate::shapes::triangle::longest(direction);
        // Nothing depends on the order of the other two but the sign of all edge functions.
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inverse = 1.0 / direction[z];
        TriangleRay {
            axes: [x, y, z],
            origin: [f64x4::splat(simd, origin[x]), f64x4::splat(simd, origin[y]), f64x4::splat(simd, origin[z])],
            shear: [f64x4::splat(simd, direction[x] * inverse), f64x4::splat(simd, direction[y] * inverse)],
            inverse: f64x4::splat(simd, inverse),
        }
    }

    /// Four corners seen from the origin, sheared so that the ray becomes the z axis.
    #[inline(always)]
    fn seen(&self, simd: S, triangles: &Triangles, corner: usize) -> (f64x4<S>, f64x4<S>, f64x4<S>) {
        let [x, y, z] = self.axes;
        let pz = widen(simd, triangles.corners[z % 3][corner]) - self.origin[2];
        let px = widen(simd, triangles.corners[x % 3][corner]) - self.origin[0] - self.shear[0] * pz;
        let py = widen(simd, triangles.corners[y % 3][corner]) - self.origin[1] - self.shear[1] * pz;
        (px, py, pz)
    }

    /// Which triangles the ray meets with 0 < t < `t_max`, one bit each, and where.
    #[inline(always)]
    pub(crate) fn hits(&self, simd: S, triangles: &Triangles, t_max: f64) -> (u32, [f64; 4]) {
        let (ax, ay, az) = self.seen(simd, triangles, 0);
        let (bx, by, bz) = self.seen(simd, triangles, 1);
        let (cx, cy, cz) = self.seen(simd, triangles, 2);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f64x4::splat(simd, 0.0);
        let inside = (u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero))
            | (u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero));
        if inside.to_bitmask() == 0 {
            return (0, [0.0; 4]);
        }
        // The division is by zero if the ray lies in the triangle's plane; no comparison below then is true.
        let t = (u * az + v * bz + w * cz) / (u + v + w) * self.inverse;
        let hit = inside & t.simd_gt(zero) & t.simd_lt(f64x4::splat(simd, t_max));
        (hit.to_bitmask() as u32, t.into())
    }
}

#[inline(always)]
fn widen<S: Simd>(simd: S, values: [f32; 4]) -> f64x4<S> {
    let (low, high) = simd.widen_f32x4(f32x4::simd_from(simd, values));
    low.combine(high)
}
