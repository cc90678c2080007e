//! One ray against eight axis-aligned boxes, in single precision but conservatively: never a miss that is a hit.

use crate::{Bounds, Ray};
use fearless_simd::{Simd, f32x8, prelude::*};

/// Eight boxes: for each axis the lower planes, then the upper planes, rounded outward to single precision.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Boxes {
    planes: [[[f32; 8]; 2]; 3],
}

impl Boxes {
    /// Eight boxes that nothing hits.
    pub(crate) const EMPTY: Boxes = Boxes { planes: [[[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]]; 3] };

    /// Puts a box into a slot.
    pub(crate) fn set(&mut self, slot: usize, bounds: &Bounds) {
        for axis in 0..3 {
            self.planes[axis][0][slot] = round_down(bounds.min[axis]);
            self.planes[axis][1][slot] = round_up(bounds.max[axis]);
        }
    }
}

/// What of a ray the box test needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    /// 1 if the ray runs towards smaller coordinates, so that it meets upper planes first.
    near: [usize; 3],
    /// The origin, rounded so that near planes seem nearer and far planes farther.
    origin_for_near: [f32; 3],
    origin_for_far: [f32; 3],
    inverse: [f32; 3],
}

/// Each distance is the product of a difference and an inverse; their roundings, that of the direction and that of the
/// product are each at most 2⁻²⁴ of it (the inverse counts twice). Near and far may err in opposite directions.
pub(crate) const FAR_SLACK: f32 = 1.0 + 12.0 * (f32::EPSILON / 2.0);

impl BoxRay {
    pub(crate) fn new(ray: &Ray) -> BoxRay {
        let mut out = BoxRay { near: [0; 3], origin_for_near: [0.0; 3], origin_for_far: [0.0; 3], inverse: [0.0; 3] };
        for axis in 0..3 {
            let (low, high) = (round_down(ray.origin[axis]), round_up(ray.origin[axis]));
            let direction = ray.direction[axis] as f32;
            // A finite stand-in for 1/0 keeps 0 · ∞ out; the ray then leaves the slab practically never.
            out.inverse[axis] = (1.0 / direction).clamp(-f32::MAX, f32::MAX);
            let backward = direction.is_sign_negative();
            out.near[axis] = usize::from(backward);
            (out.origin_for_near[axis], out.origin_for_far[axis]) = if backward { (low, high) } else { (high, low) };
        }
        out
    }

    /// Which of the boxes the ray may meet between 0 and `t_max`, one bit each, and where it may enter each.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]) {
        let mut enter = f32x8::splat(simd, 0.0);
        let mut leave = f32x8::splat(simd, t_max);
        for axis in 0..3 {
            let near = self.near[axis];
            let near_planes = f32x8::simd_from(simd, boxes.planes[axis][near & 1]);
            let far_planes = f32x8::simd_from(simd, boxes.planes[axis][(near ^ 1) & 1]);
            let inverse = f32x8::splat(simd, self.inverse[axis]);
            let from_near = f32x8::splat(simd, self.origin_for_near[axis]);
            let from_far = f32x8::splat(simd, self.origin_for_far[axis]);
            enter = enter.max((near_planes - from_near) * inverse);
            leave = leave.min((far_planes - from_far) * inverse);
        }
        let hit = enter.simd_le(leave * f32x8::splat(simd, FAR_SLACK));
        (hit.to_bitmask(), enter.into())
    }
}

/// The greatest single-precision number that is not above `x`.
pub(crate) fn round_down(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The least single-precision number that is not below `x`.
pub(crate) fn round_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x { nearest.next_up() } else { nearest }
}
