//! Axis-aligned boxes in single precision: one ray against eight of them, conservatively (never a miss that is a hit), and
//! what the builder of the tree does with them.

use crate::bvh::traverse::Most;
use crate::packet::{LANES, Packet};
use crate::{Bounds, Ray};
use fearless_simd::{Simd, f32x8, prelude::*};

/// An axis-aligned box: the least coordinates, a spare number, the greatest coordinates with their signs changed, a spare
/// number. The union of two is the minimum, lane by lane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Box32(pub(crate) [f32; 8]);

impl Box32 {
    /// Contains nothing.
    pub(crate) const EMPTY: Box32 = Box32([f32::INFINITY; 8]);

    /// The box between two corners.
    pub(crate) fn new(min: [f32; 3], max: [f32; 3]) -> Box32 {
        Box32([min[0], min[1], min[2], 0.0, -max[0], -max[1], -max[2], 0.0])
    }

    /// The smallest box around `bounds`.
    pub(crate) fn around(bounds: &Bounds) -> Box32 {
        Box32::new(bounds.min.to_array().map(round_down), bounds.max.to_array().map(round_up))
    }

    /// The smallest box around both.
    #[inline(always)]
    pub(crate) fn union(self, other: Box32) -> Box32 {
        Box32(std::array::from_fn(|i| if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] }))
    }

    /// Least coordinates.
    pub(crate) fn min(&self) -> [f32; 3] {
        [self.0[0], self.0[1], self.0[2]]
    }

    /// Greatest coordinates.
    pub(crate) fn max(&self) -> [f32; 3] {
        [-self.0[4], -self.0[5], -self.0[6]]
    }

    /// Half the surface area; 0 if empty.
    #[inline(always)]
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|axis| -self.0[axis + 4] - self.0[axis]);
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }
}

/// Eight boxes: for each axis the lower planes, then the upper planes, rounded outward to single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Boxes {
    planes: [[[f32; 8]; 2]; 3],
}

impl Boxes {
    /// Eight boxes that nothing hits.
    pub(crate) const EMPTY: Boxes = Boxes { planes: [[[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]]; 3] };

    /// Puts a box into a slot.
    pub(crate) fn set(&mut self, slot: usize, bounds: &Box32) {
        let (min, max) = (bounds.min(), bounds.max());
        for axis in 0..3 {
            self.planes[axis][0][slot] = min[axis];
            self.planes[axis][1][slot] = max[axis];
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
    /// One over the direction; that for far planes is greater by [`FAR_SLACK`].
    inverse_for_near: [f32; 3],
    inverse_for_far: [f32; 3],
}

/// Each distance is the product of a difference and an inverse; their roundings, that of the direction and that of the
/// product are each at most 2⁻²⁴ of it (inverses are rounded twice). Near and far may err in opposite directions.
pub(crate) const FAR_SLACK: f32 = 1.0 + 16.0 * (f32::EPSILON / 2.0);

/// Far less than anything has extent, and yet enough for a ray along one axis, whose inverse for the others is
/// [`MOST_INVERSE`], to stay as long as it may between planes that it lies in.
const LEAST_DOUBT: f32 = 1e-15;

/// Stands for 1/0 and keeps 0 · ∞ out.
const MOST_INVERSE: f32 = 1e38;

/// How far a rounded coordinate may be from the real one, and what is said of [`LEAST_DOUBT`].
#[inline(always)]
fn doubt(coordinate: f32) -> f32 {
    coordinate.abs() * f32::EPSILON + LEAST_DOUBT
}

#[inline(always)]
fn inverse(direction: f32) -> f32 {
    (1.0 / direction).clamp(-MOST_INVERSE, MOST_INVERSE)
}

impl BoxRay {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> BoxRay {
        let mut out = BoxRay {
            near: [0; 3],
            origin_for_near: [0.0; 3],
            origin_for_far: [0.0; 3],
            inverse_for_near: [0.0; 3],
            inverse_for_far: [0.0; 3],
        };
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        for axis in 0..3 {
            let direction = direction[axis] as f32;
            out.inverse_for_near[axis] = inverse(direction);
            out.inverse_for_far[axis] = out.inverse_for_near[axis] * FAR_SLACK;
            out.near[axis] = usize::from(direction.is_sign_negative());
            // Rounded towards where the ray goes it is nearer to what lies ahead, and against it farther.
            let nearest = origin[axis] as f32;
            let doubt = doubt(nearest).copysign(direction);
            out.origin_for_near[axis] = nearest + doubt;
            out.origin_for_far[axis] = nearest - doubt;
        }
        out
    }

    /// Which of the boxes the ray may meet between 0 and `t_max`, one bit each, and where it may enter each.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]) {
        let ([x, far_x], [y, far_y], [z, far_z]) =
            (self.slab(simd, boxes, 0), self.slab(simd, boxes, 1), self.slab(simd, boxes, 2));
        // In pairs: fewer results wait for each other.
        let enter = x.max(y).max(z.max(f32x8::splat(simd, 0.0)));
        let leave = far_x.min(far_y).min(far_z.min(f32x8::splat(simd, t_max * FAR_SLACK)));
        (enter.simd_le(leave).to_bitmask(), enter.into())
    }

    /// Where the ray enters and leaves the space between the planes of an axis.
    #[inline(always)]
    fn slab<S: Simd>(&self, simd: S, boxes: &Boxes, axis: usize) -> [f32x8<S>; 2] {
        let near = self.near[axis];
        let near_planes = f32x8::simd_from(simd, boxes.planes[axis][near & 1]);
        let far_planes = f32x8::simd_from(simd, boxes.planes[axis][(near ^ 1) & 1]);
        let to_near = near_planes - f32x8::splat(simd, self.origin_for_near[axis]);
        let to_far = far_planes - f32x8::splat(simd, self.origin_for_far[axis]);
        let [near, far] = [self.inverse_for_near[axis], self.inverse_for_far[axis]];
        [to_near * f32x8::splat(simd, near), to_far * f32x8::splat(simd, far)]
    }
}

/// What of a packet the box test needs: the ranges of its rays' origins and inverse directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxPacket {
    near: [usize; 3],
    origin_for_near: [f32; 3],
    origin_for_far: [f32; 3],
    /// The least and the greatest.
    inverse: [[f32; 2]; 3],
    /// When to give up.
    pub(crate) most: Most,
}

impl BoxPacket {
    /// `None` if the rays do not all go the same way along each axis: their ranges would say nothing.
    #[inline(always)]
    pub(crate) fn new(packet: &Packet, most: Most) -> Option<BoxPacket> {
        let mut out = BoxPacket {
            near: [0; 3],
            origin_for_near: [0.0; 3],
            origin_for_far: [0.0; 3],
            inverse: [[0.0; 2]; 3],
            most,
        };
        for axis in 0..3 {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let (mut least, mut greatest) = (f32::INFINITY, f32::NEG_INFINITY);
            let mut backward = 0;
            for lane in 0..LANES {
                let (origin, direction) = (packet.origin[axis][lane], packet.direction[axis][lane] as f32);
                (low, high) = (low.min(origin), high.max(origin));
                let inverse = inverse(direction);
                (least, greatest) = (least.min(inverse), greatest.max(inverse));
                backward += usize::from(direction.is_sign_negative());
            }
            let backward = match backward {
                0 => false,
                LANES => true,
                _ => return None,
            };
            let (low, high) = (low as f32, high as f32);
            let (low, high) = (low - doubt(low), high + doubt(high));
            out.near[axis] = usize::from(backward);
            out.inverse[axis] = [least, greatest];
            (out.origin_for_near[axis], out.origin_for_far[axis]) = if backward { (low, high) } else { (high, low) };
        }
        Some(out)
    }

    /// Which of the boxes some ray may meet between 0 and `t_max`, one bit each, and before where no ray enters each.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]) {
        let mut enter = f32x8::splat(simd, 0.0);
        let mut leave = f32x8::splat(simd, t_max);
        for axis in 0..3 {
            let near = self.near[axis];
            let near_planes = f32x8::simd_from(simd, boxes.planes[axis][near & 1]);
            let far_planes = f32x8::simd_from(simd, boxes.planes[axis][(near ^ 1) & 1]);
            let least = f32x8::splat(simd, self.inverse[axis][0]);
            let greatest = f32x8::splat(simd, self.inverse[axis][1]);
            let to_near = near_planes - f32x8::splat(simd, self.origin_for_near[axis]);
            let to_far = far_planes - f32x8::splat(simd, self.origin_for_far[axis]);
            enter = enter.max((to_near * least).min(to_near * greatest));
            leave = leave.min((to_far * least).max(to_far * greatest));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::testing::Random;
    use crate::simd::level::SimdLevel;
    use durer_math::DVec3;
    use fearless_simd::dispatch;

    /// Rays along an axis in the planes of a box's faces, from places of all sizes, 0 among them.
    #[test]
    fn a_ray_in_the_plane_of_a_face_meets_the_box() {
        let mut random = Random(31);
        for level in SimdLevel::available() {
            for _ in 0..2_000 {
                let place =
                    |random: &mut Random| if random.between(0.0, 4.0) < 1.0 { 0.0 } else { random.power(-6.0, 6.0) };
                let [x, y] = [place(&mut random) as f32, -place(&mut random) as f32];
                let extent = random.power(-3.0, 3.0) as f32;
                let mut boxes = Boxes::EMPTY;
                boxes.set(0, &Box32::new([x, y - extent, 2.0], [x + extent, y, 3.0]));
                boxes.set(1, &Box32::new([x - extent, y, -2.0], [x, y + extent, 3.0]));
                let direction = DVec3::new([0.0, -0.0][random.between(0.0, 2.0) as usize], 0.0, 1.0);
                let ray = Ray { origin: DVec3::new(f64::from(x), f64::from(y), 0.0), direction };
                let packet = BoxPacket::new(&Packet::new(&[ray; 3]), Most::USUAL).expect("all the same");
                let (alone, together) = dispatch!(level.level(), simd => {
                    (BoxRay::new(&ray).hits(simd, &boxes, 1e9).0, packet.hits(simd, &boxes, 1e9).0)
                });
                assert_eq!((alone, together), (0b11, 0b11), "{ray:?}, extent {extent}");
            }
        }
    }
}
