//! One ray against four triangles, in double precision: the watertight test of Woop, Benthin and Wald, operation by
//! operation as a single triangle's own (see `shapes/triangle.rs`).
//!
//! Corners are stored in single precision, as files have them, and widened when they are tested: four in double precision
//! take as many instructions as four in single precision would, and nothing is lost.

use crate::Ray;
use crate::packet::{LANES, Packet};
use crate::shapes::triangle::{LEAST_AREA, longest};
use fearless_simd::{Simd, f32x4, f64x4, f64x8, mask64x8, prelude::*};

/// Four triangles. Unused slots repeat the first.
#[derive(Clone, Copy, Debug, PartialEq)]
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
            // The first goes into all slots, the others into their own.
            for slot in if slot == 0 { 0..4 } else { slot..slot + 1 } {
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

impl Triangles {
    /// How many of the slots are used.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        1 + self.ids[1..].iter().filter(|&&id| id != self.ids[0]).count()
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
        let z = longest(direction);
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
        let products =
            (cx * by).abs() + (cy * bx).abs() + (ax * cy).abs() + (ay * cx).abs() + (bx * ay).abs() + (by * ax).abs();
        let area = u + v + w;
        let is_seen = area.abs().simd_gt(products * f64x4::splat(simd, LEAST_AREA));
        let t = (u * az + v * bz + w * cz) / area * self.inverse;
        let hit = inside & is_seen & t.simd_gt(zero) & t.simd_lt(f64x4::splat(simd, t_max));
        (hit.to_bitmask() as u32, t.into())
    }
}

/// What of a packet the triangle test needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrianglePacket<S: Simd> {
    axes: [usize; 3],
    origin: [f64x8<S>; 3],
    shear: [f64x8<S>; 2],
    inverse: f64x8<S>,
}

impl<S: Simd> TrianglePacket<S> {
    /// `None` if the rays' longest axes differ.
    #[inline(always)]
    pub(crate) fn new(simd: S, packet: &Packet) -> Option<TrianglePacket<S>> {
        let z = longest(packet.direction.map(|lanes| lanes[0]));
        let mut differ = false;
        for lane in 1..LANES {
            differ |= longest([packet.direction[0][lane], packet.direction[1][lane], packet.direction[2][lane]]) != z;
        }
        if differ {
            return None;
        }
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inverse = f64x8::splat(simd, 1.0) / f64x8::simd_from(simd, packet.direction[z]);
        Some(TrianglePacket {
            axes: [x, y, z],
            origin: [
                f64x8::simd_from(simd, packet.origin[x]),
                f64x8::simd_from(simd, packet.origin[y]),
                f64x8::simd_from(simd, packet.origin[z]),
            ],
            shear: [
                f64x8::simd_from(simd, packet.direction[x]) * inverse,
                f64x8::simd_from(simd, packet.direction[y]) * inverse,
            ],
            inverse,
        })
    }

    /// A corner seen from the origins, sheared so that each ray becomes the z axis.
    #[inline(always)]
    fn seen(&self, simd: S, triangles: &Triangles, corner: usize, slot: usize) -> (f64x8<S>, f64x8<S>, f64x8<S>) {
        let [x, y, z] = self.axes;
        let of = &triangles.corners;
        let pz = f64x8::splat(simd, f64::from(of[z % 3][corner][slot])) - self.origin[2];
        let px = f64x8::splat(simd, f64::from(of[x % 3][corner][slot])) - self.origin[0] - self.shear[0] * pz;
        let py = f64x8::splat(simd, f64::from(of[y % 3][corner][slot])) - self.origin[1] - self.shear[1] * pz;
        (px, py, pz)
    }

    /// Keeps, for each ray, the triangle in a slot if it is met before what was best.
    #[inline(always)]
    pub(crate) fn offer(&self, simd: S, triangles: &Triangles, slot: usize, best: &mut BestLanes<S>) {
        let (inside, t) = self.crossing(simd, triangles, slot);
        let Some(t) = t else { return };
        let part = f64x8::splat(simd, f64::from(triangles.ids[slot]));
        let nearer = t.simd_lt(best.t) | (t.simd_eq(best.t) & part.simd_lt(best.part));
        let wins = inside & t.simd_gt(f64x8::splat(simd, 0.0)) & nearer;
        best.t = simd.select_f64x8(wins, t, best.t);
        best.part = simd.select_f64x8(wins, part, best.part);
    }

    /// Which rays meet the triangle in a slot with 0 < t < `t_max`, one bit each.
    #[inline(always)]
    pub(crate) fn hits(&self, simd: S, triangles: &Triangles, slot: usize, t_max: f64x8<S>) -> u32 {
        let (inside, t) = self.crossing(simd, triangles, slot);
        let Some(t) = t else { return 0 };
        (inside & t.simd_gt(f64x8::splat(simd, 0.0)) & t.simd_lt(t_max)).to_bitmask() as u32
    }

    /// Which rays pass inside of the triangle's edges, and where they meet its plane if there are any.
    #[inline(always)]
    fn crossing(&self, simd: S, triangles: &Triangles, slot: usize) -> (mask64x8<S>, Option<f64x8<S>>) {
        let (ax, ay, az) = self.seen(simd, triangles, 0, slot);
        let (bx, by, bz) = self.seen(simd, triangles, 1, slot);
        let (cx, cy, cz) = self.seen(simd, triangles, 2, slot);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f64x8::splat(simd, 0.0);
        let inside = (u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero))
            | (u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero));
        if inside.to_bitmask() == 0 {
            return (inside, None);
        }
        let products =
            (cx * by).abs() + (cy * bx).abs() + (ax * cy).abs() + (ay * cx).abs() + (bx * ay).abs() + (by * ax).abs();
        let area = u + v + w;
        let is_seen = area.abs().simd_gt(products * f64x8::splat(simd, LEAST_AREA));
        (inside & is_seen, Some((u * az + v * bz + w * cz) / area * self.inverse))
    }
}

/// What is best for each ray of a packet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BestLanes<S: Simd> {
    /// Where; hits beyond it, or as far with a higher number, do not count.
    pub(crate) t: f64x8<S>,
    /// The part that was hit, or -1. Parts are whole numbers that double precision holds exactly.
    pub(crate) part: f64x8<S>,
}

#[inline(always)]
fn widen<S: Simd>(simd: S, values: [f32; 4]) -> f64x4<S> {
    let (low, high) = simd.widen_f32x4(f32x4::simd_from(simd, values));
    low.combine(high)
}
