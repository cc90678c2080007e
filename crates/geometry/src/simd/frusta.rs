//! One ray against four frusta, in double precision: the side's span from the quadratic as for a single cone, that of the
//! caps' slab, and what they have in common (see `shapes/cone.rs` and `shapes/span.rs`).
//!
//! A frustum has no space of its own here, since a matrix for each would be most of its memory: points are split into
//! what is along the axis, with the height of the frustum as the unit, and the rest, across it.

use super::blocks::{Block, Hits, Spans, Vectors, WideRay};
use fearless_simd::{Simd, f64x4, mask64x4, prelude::*};

/// The numbers of a frustum: the middle of its base, that of its top, the radii at base and top.
pub(crate) const NUMBERS: usize = 8;

/// Four axes, from base to top, that a ray may come near.
#[derive(Clone, Copy)]
pub(crate) struct Axes<S: Simd> {
    /// The particles whose endless cylinders the ray may meet; axes without a length have none, and pass.
    pub(crate) near: mask64x4<S>,
    pub(crate) axis: Vectors<S>,
    pub(crate) squared_length: f64x4<S>,
    /// The ray's origin, seen from the base.
    pub(crate) from_base: Vectors<S>,
    squared_distance: f64x4<S>,
}

/// Errors of the volume below, squared and generous, in units of the product of its factors; and what the sum of two
/// lengths, squared, is more than the square of the first: (b + c)² ≤ 1025 b² + (1 + 1/1024) c².
const VOLUME_DOUBT: f64 = 1025.0 * 64.0 * f64::EPSILON * f64::EPSILON;
const VOLUME_SLACK: f64 = 1.0 + 1.0 / 1024.0;

impl<S: Simd> Axes<S> {
    /// How far the ray's line passes from the axis is the volume that it spans with axis and base over the area that the
    /// directions span. Most particles are done with here, for little.
    #[inline(always)]
    pub(crate) fn new(simd: S, [base, top]: [Vectors<S>; 2], widest: f64x4<S>, ray: &WideRay<S>) -> Axes<S> {
        let (axis, from_base) = (top - base, ray.origin - base);
        let area = axis.cross(ray.direction);
        let volume = from_base.dot(area);
        let (squared_length, squared_distance) = (axis.square(), from_base.square());
        let doubt = f64x4::splat(simd, VOLUME_DOUBT) * squared_length * squared_distance * ray.square;
        let most = f64x4::splat(simd, VOLUME_SLACK) * (widest * widest) * area.square() + doubt;
        Axes { near: (volume * volume).simd_le(most), axis, squared_length, from_base, squared_distance }
    }
}

/// A ray seen from four axes.
#[derive(Clone, Copy)]
pub(crate) struct Seen<S: Simd> {
    /// How high the origin is: 0 at the base, 1 at the top.
    height: f64x4<S>,
    /// How much higher the ray gets while its parameter grows by 1.
    climb: f64x4<S>,
    /// From the axis to the origin, across the axis.
    pub(crate) away: Vectors<S>,
    /// The direction across the axis.
    pub(crate) across: Vectors<S>,
}

impl<S: Simd> Seen<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, axes: &Axes<S>, from_base: Vectors<S>, ray: &WideRay<S>) -> Seen<S> {
        let per_squared_length = f64x4::splat(simd, 1.0) / axes.squared_length;
        let height = axes.axis.dot(from_base) * per_squared_length;
        let climb = axes.axis.dot(ray.direction) * per_squared_length;
        let away = from_base - axes.axis * height;
        let across = ray.direction - axes.axis * climb;
        Seen { height, climb, away, across }
    }

    /// The spans between the planes of bases and tops, and which axes the ray runs down.
    ///
    /// What is parallel to the planes, or leaves them behind, is answered apart, which also keeps 0 · ∞ away.
    #[inline(always)]
    pub(crate) fn slabs(&self, simd: S) -> (Spans<S>, mask64x4<S>) {
        let (zero, one) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, 1.0));
        let above = self.height.simd_ge(one) & self.climb.simd_ge(zero);
        let below = self.height.simd_le(zero) & self.climb.simd_le(zero);
        let per_climb = one / self.climb;
        let (to_base, to_top) = (-self.height * per_climb, (one - self.height) * per_climb);
        let falls = per_climb.simd_lt(zero);
        let (enter, exit) = (falls.select(to_top, to_base), falls.select(to_base, to_top));
        (Spans { met: !(above | below), enter, exit }, falls)
    }

    /// Which crossings at `t` are ahead of the origin, and between base and top.
    #[inline(always)]
    fn on_side(&self, simd: S, t: f64x4<S>) -> mask64x4<S> {
        let (zero, one) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, 1.0));
        let height = self.height + t * self.climb;
        t.simd_gt(zero) & height.simd_ge(zero) & height.simd_le(one)
    }
}

/// The quadratic a t² + 2 b t + c of four endless cones along a ray, below 0 in a cone and its opposite.
#[derive(Clone, Copy)]
struct Cones<S: Simd> {
    /// Which are met at all, ahead of the origin.
    met: mask64x4<S>,
    inside: mask64x4<S>,
    approaching: mask64x4<S>,
    /// Which cones the ray, inside, does not leave where |c| / q is.
    widening: mask64x4<S>,
    a: f64x4<S>,
    b: f64x4<S>,
    c: f64x4<S>,
    discriminant: f64x4<S>,
}

impl<S: Simd> Cones<S> {
    /// As `Cone::endless`, where the reasons are.
    #[inline(always)]
    fn new(simd: S, seen: &Seen<S>, base_radius: f64x4<S>, slope: f64x4<S>) -> Cones<S> {
        let zero = f64x4::splat(simd, 0.0);
        let (w, dw) = (base_radius + slope * seen.height, slope * seen.climb);
        let (dr2, dw2) = (seen.across.square(), dw * dw);
        let b = seen.away.dot(seen.across) - w * dw;
        let c = seen.away.square() - w * w;
        let doubt = f64x4::splat(simd, 4.0 * f64::EPSILON);
        let parallel = (dr2 - dw2).abs().simd_le(doubt * (dr2 + dw2));
        let a = parallel.select(zero, dr2 - dw2);
        // b² - a c, of whose terms the large ones cancel here before they are formed, near the apex too.
        let (mixed, turn) = (seen.away * dw - seen.across * w, seen.away.cross(seen.across));
        let discriminant = mixed.square() - turn.square();
        let glides = c.simd_eq(zero) & parallel & b.simd_eq(zero);
        let inside = c.simd_le(zero) & w.simd_ge(zero) & !glides;
        let approaching = c.simd_gt(zero) & b.simd_lt(zero);
        let flat = a.simd_ge(zero);
        let enters = (flat & approaching & discriminant.simd_ge(zero)) | (a.simd_lt(zero) & dw.simd_gt(zero));
        Cones {
            met: inside | enters,
            inside,
            approaching,
            widening: a.simd_le(zero) & dw.simd_ge(zero),
            a,
            b,
            c,
            discriminant,
        }
    }

    #[inline(always)]
    fn spans(&self, simd: S) -> Spans<S> {
        let (zero, infinity) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, f64::INFINITY));
        let q = self.discriminant.max(zero).sqrt() + self.b.abs();
        let (by_c, by_a) = (self.c.abs() / q, q / self.a.abs());
        let leaving = self.inside & self.b.simd_gt(zero) & !self.widening;
        let narrow = self.a.simd_gt(zero).select(by_a, infinity);
        Spans {
            met: self.met,
            enter: self.inside.select(-infinity, self.approaching.select(by_c, by_a)),
            exit: leaving.select(by_c, narrow),
        }
    }
}

/// Beyond so many radii of the ball around a cone, squared, the origin is moved nearer before coefficients are formed.
const FAR_SQUARED: f64 = 16.0;

/// Where the ray's origin is moved to, seen from the base, and its parameter there: near a cone, but still before it.
///
/// Coefficients then are of the order of its size, and little cancels in the discriminant. Cylinders need no such care.
#[inline(always)]
fn brought_near<S: Simd>(
    simd: S,
    axes: &Axes<S>,
    [widest, slope]: [f64x4<S>; 2],
    ray: &WideRay<S>,
) -> (Vectors<S>, f64x4<S>) {
    let zero = f64x4::splat(simd, 0.0);
    let squared_reach = axes.squared_length + widest * widest;
    let far = axes.squared_distance.simd_gt(squared_reach * f64x4::splat(simd, FAR_SQUARED)) & !slope.simd_eq(zero);
    if far.to_bitmask() == 0 {
        return (axes.from_base, zero);
    }
    let to_nearest = -axes.from_base.dot(ray.direction) * ray.per_square;
    let before = to_nearest - f64x4::splat(simd, 2.0) * (squared_reach * ray.per_square).sqrt();
    let skipped = far.select(before, zero);
    (axes.from_base + ray.direction * skipped, skipped)
}

/// Which frusta the ray meets with 0 < t < `t_max`. Face 0 is the side, 1 the base, 2 the top.
#[inline(always)]
pub(crate) fn hits<S: Simd, const OPEN: bool>(simd: S, frusta: &Block<NUMBERS>, ray: &WideRay<S>, t_max: f64) -> Hits {
    let ends = [frusta.vectors(simd, 0), frusta.vectors(simd, 3)];
    let (base_radius, top_radius) = (frusta.column(simd, 6), frusta.column(simd, 7));
    let widest = base_radius.max(top_radius);
    let axes = Axes::new(simd, ends, widest, ray);
    let passing = axes.near & axes.squared_length.simd_gt(f64x4::splat(simd, 0.0));
    if passing.to_bitmask() == 0 {
        return Hits::NONE;
    }
    let slope = top_radius - base_radius;
    let (from_base, skipped) = brought_near(simd, &axes, [widest, slope], ray);
    let seen = Seen::new(simd, &axes, from_base, ray);
    let cones = Cones::new(simd, &seen, base_radius, slope);
    let met = passing & cones.met;
    if met.to_bitmask() == 0 {
        return Hits::NONE;
    }
    let side = cones.spans(simd);
    let (first, t, faces) = if OPEN { first_of_sides(simd, &seen, &side) } else { first_of_solids(simd, &seen, &side) };
    let t = t + skipped;
    let hit = met & first & t.simd_gt(f64x4::splat(simd, 0.0)) & t.simd_lt(f64x4::splat(simd, t_max));
    Hits { which: hit.to_bitmask() as u32, t: t.into(), faces }
}

/// Which open frusta are crossed ahead, and where first.
#[inline(always)]
fn first_of_sides<S: Simd>(simd: S, seen: &Seen<S>, side: &Spans<S>) -> (mask64x4<S>, f64x4<S>, [u32; 2]) {
    let (enters, leaves) = (seen.on_side(simd, side.enter), seen.on_side(simd, side.exit));
    (enters | leaves, enters.select(side.enter, side.exit), [0; 2])
}

/// Which closed frusta are crossed ahead, where first, and on which caps.
#[inline(always)]
fn first_of_solids<S: Simd>(simd: S, seen: &Seen<S>, side: &Spans<S>) -> (mask64x4<S>, f64x4<S>, [u32; 2]) {
    let (slab, falls) = seen.slabs(simd);
    let by_cap = slab.enter.simd_gt(side.enter);
    let to_cap = slab.exit.simd_lt(side.exit);
    let enter = by_cap.select(slab.enter, side.enter);
    let exit = to_cap.select(slab.exit, side.exit);
    let outside = enter.simd_gt(f64x4::splat(simd, 0.0));
    let met = slab.met & enter.simd_lt(exit);
    // Bit by bit from here on: which end it is, whether that is a cap, and which.
    let (enters, falls) = (outside.to_bitmask() as u32, falls.to_bitmask() as u32);
    let cap = (enters & by_cap.to_bitmask() as u32) | (!enters & to_cap.to_bitmask() as u32);
    let at_top = !(enters ^ falls);
    (met, outside.select(enter, exit), [cap & !at_top, cap & at_top])
}
