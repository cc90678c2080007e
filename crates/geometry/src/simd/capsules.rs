//! One ray against four capsules, in double precision.
//!
//! A capsule is a cylinder with a ball around each end, three convex solids, and convex itself: the piece of a ray in it
//! goes from where the first of the three is entered to where the last is left. Where they overlap nothing depends on which
//! of them a ray is rounded to, so there is no seam.

use super::blocks::{Block, Hits, Spans, WideRay};
use super::frusta::{Axes, Seen};
use super::spheres::Quadratics;
use fearless_simd::{Simd, f64x4, prelude::*};

/// The numbers of a capsule: the centers of its half balls, its radius.
pub(crate) const NUMBERS: usize = 7;

/// Which capsules the ray meets with 0 < t < `t_max`. They have one face.
#[inline(always)]
pub(crate) fn hits<S: Simd>(simd: S, capsules: &Block<NUMBERS>, ray: &WideRay<S>, t_max: f64) -> Hits {
    let (ends, radius) = ([capsules.vectors(simd, 0), capsules.vectors(simd, 3)], capsules.column(simd, 6));
    let axes = Axes::new(simd, ends, radius, ray);
    if axes.near.to_bitmask() == 0 {
        return Hits::NONE;
    }
    let zero = f64x4::splat(simd, 0.0);
    let tube = Tubes::new(simd, &axes, radius, ray);
    // A ray that misses the endless tube misses the balls; without an axis there are balls only.
    let passing = axes.near & (tube.endless.met | axes.squared_length.simd_eq(zero));
    if passing.to_bitmask() == 0 {
        return Hits::NONE;
    }
    let below = Quadratics::round(simd, axes.from_base, radius, ray).spans(simd);
    let above = Quadratics::round(simd, axes.from_base - axes.axis, radius, ray).spans(simd);
    let all = tube.spans(simd).around(simd, &below).around(simd, &above);
    let t = all.enter.simd_gt(zero).select(all.enter, all.exit);
    let hit = passing & all.met & t.simd_gt(zero) & t.simd_lt(f64x4::splat(simd, t_max));
    Hits { which: hit.to_bitmask() as u32, t: t.into(), faces: [0; 2] }
}

/// Four cylinders between bases and tops.
#[derive(Clone, Copy)]
struct Tubes<S: Simd> {
    seen: Seen<S>,
    endless: Quadratics<S>,
}

impl<S: Simd> Tubes<S> {
    #[inline(always)]
    fn new(simd: S, axes: &Axes<S>, radius: f64x4<S>, ray: &WideRay<S>) -> Tubes<S> {
        let seen = Seen::new(simd, axes, axes.from_base, ray);
        let (zero, a) = (f64x4::splat(simd, 0.0), seen.across.square());
        // Parallel to the axis nothing is divided by a: all points are as near, and the balls say where the ends are.
        let per_a = a.simd_gt(zero).select(f64x4::splat(simd, 1.0) / a, zero);
        Tubes { seen, endless: Quadratics::new(simd, (seen.away, seen.across), (a, per_a), radius) }
    }

    #[inline(always)]
    fn spans(&self, simd: S) -> Spans<S> {
        let (side, (slab, _)) = (self.endless.spans(simd), self.seen.slabs(simd));
        let enter = slab.enter.simd_gt(side.enter).select(slab.enter, side.enter);
        let exit = slab.exit.simd_lt(side.exit).select(slab.exit, side.exit);
        Spans { met: side.met & slab.met & enter.simd_lt(exit), enter, exit }
    }
}

impl<S: Simd> Spans<S> {
    /// The smallest spans around both.
    #[inline(always)]
    fn around(&self, simd: S, other: &Spans<S>) -> Spans<S> {
        let (ours, theirs) = (self.or_nothing(simd), other.or_nothing(simd));
        Spans { met: ours.met | theirs.met, enter: ours.enter.min(theirs.enter), exit: ours.exit.max(theirs.exit) }
    }

    /// With ends that no union keeps where nothing is met.
    #[inline(always)]
    fn or_nothing(&self, simd: S) -> Spans<S> {
        let infinity = f64x4::splat(simd, f64::INFINITY);
        let (enter, exit) = (self.met.select(self.enter, infinity), self.met.select(self.exit, -infinity));
        Spans { met: self.met, enter, exit }
    }
}
