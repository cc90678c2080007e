//! One ray against four spheres, in double precision, by the formulas of a single one (see `shapes/sphere.rs`).

use super::blocks::{Block, Hits, Spans, Vectors, WideRay};
use fearless_simd::{Simd, f64x4, mask64x4, prelude::*};

/// The numbers of a sphere: its center, its radius.
pub(crate) const NUMBERS: usize = 4;

/// Which spheres the ray meets with 0 < t < `t_max`.
#[inline(always)]
pub(crate) fn hits<S: Simd>(simd: S, spheres: &Block<NUMBERS>, ray: &WideRay<S>, t_max: f64) -> Hits {
    let from_center = ray.origin - spheres.vectors(simd, 0);
    let along = Quadratics::round(simd, from_center, spheres.column(simd, 3), ray);
    if along.met.to_bitmask() == 0 {
        return Hits::NONE;
    }
    let t = along.first(simd);
    let hit = along.met & t.simd_gt(f64x4::splat(simd, 0.0)) & t.simd_lt(f64x4::splat(simd, t_max));
    Hits { which: hit.to_bitmask() as u32, t: t.into(), faces: [0; 2] }
}

/// What a t² + 2 b t + c along a ray says of four round things: below 0 inside.
#[derive(Clone, Copy)]
pub(crate) struct Quadratics<S: Simd> {
    /// Which are met at all, ahead of the origin.
    pub(crate) met: mask64x4<S>,
    inside: mask64x4<S>,
    a: f64x4<S>,
    per_a: f64x4<S>,
    b: f64x4<S>,
    c: f64x4<S>,
    /// The square of half the chord's length.
    half_chord: f64x4<S>,
}

impl<S: Simd> Quadratics<S> {
    /// Those of spheres, for a ray whose origin is `from_center`, seen from their centers.
    #[inline(always)]
    pub(crate) fn round(simd: S, from_center: Vectors<S>, radius: f64x4<S>, ray: &WideRay<S>) -> Quadratics<S> {
        Quadratics::new(simd, (from_center, ray.direction), (ray.square, ray.per_square), radius)
    }

    /// Given a ray from a point in a direction, and its a and 1 / a.
    ///
    /// The sign of c says whether the ray starts inside. The chord comes from the point of the ray nearest to the center,
    /// which does not cancel for an origin far away.
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        (origin, direction): (Vectors<S>, Vectors<S>),
        (a, per_a): (f64x4<S>, f64x4<S>),
        radius: f64x4<S>,
    ) -> Quadratics<S> {
        let zero = f64x4::splat(simd, 0.0);
        let b = origin.dot(direction);
        let nearest = origin - direction * (b * per_a);
        let squared_radius = radius * radius;
        let c = origin.square() - squared_radius;
        let half_chord = squared_radius - nearest.square();
        let inside = c.simd_le(zero);
        let met = inside | (b.simd_lt(zero) & half_chord.simd_ge(zero));
        Quadratics { met, inside, a, per_a, b, c, half_chord }
    }

    /// The roots that have no difference in them: |c| / q, nearer to the origin, and q / a.
    #[inline(always)]
    fn roots(&self, simd: S) -> (f64x4<S>, f64x4<S>) {
        let q = (self.a * self.half_chord.max(f64x4::splat(simd, 0.0))).sqrt() + self.b.abs();
        (self.c.abs() / q, q * self.per_a)
    }

    /// The first crossings ahead.
    #[inline(always)]
    fn first(&self, simd: S) -> f64x4<S> {
        let (by_c, by_a) = self.roots(simd);
        let leaves = self.inside & self.b.simd_le(f64x4::splat(simd, 0.0));
        leaves.select(by_a, by_c)
    }

    /// The spans inside.
    #[inline(always)]
    pub(crate) fn spans(&self, simd: S) -> Spans<S> {
        let (by_c, by_a) = self.roots(simd);
        let leaving = self.inside & self.b.simd_gt(f64x4::splat(simd, 0.0));
        Spans {
            met: self.met,
            enter: self.inside.select(f64x4::splat(simd, f64::NEG_INFINITY), by_c),
            exit: leaving.select(by_c, by_a),
        }
    }
}
