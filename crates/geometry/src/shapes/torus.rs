//! The torus about the y axis with major radius 1.
//!
//! A ray meets it where a quartic is zero. Closed formulas for its roots cancel badly, and near a thin tube even the
//! quartic's value does. So the quartic serves only to find where it turns, which cuts the ray into pieces with at most
//! one crossing each; signs at the cuts and the crossing itself come from g = (ρ - 1)² + y² - r², with ρ the distance
//! from the axis, which is as exact for a thin tube as for a thick one.

use super::Shape;
use super::sphere::longitude;
use crate::{Bounds, Crossing, Ray};
use durer_math::functions::atan2;
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// The points within `tube_radius` of the unit circle in the plane y = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Torus {
    /// Radius of the tube, in (0, 1).
    pub(crate) tube_radius: f64,
}

/// The ray with s, the length from its point nearest to the torus' center, as parameter: all numbers are then of the
/// order of 1, and the quartic has no cubic term.
struct Line {
    nearest: DVec3,
    unit: DVec3,
    tube_radius: f64,
}

impl Line {
    fn at(&self, s: f64) -> DVec3 {
        self.nearest + self.unit * s
    }

    /// g and its derivative along the ray.
    #[inline]
    fn value_and_slope(&self, s: f64) -> (f64, f64) {
        let (p, u) = (self.at(s), self.unit);
        let rho = (p.x * p.x + p.z * p.z).sqrt();
        let slope = if rho > 0.0 { (rho - 1.0) * (p.x * u.x + p.z * u.z) / rho } else { 0.0 };
        (inside_by(p, rho, self.tube_radius), 2.0 * (slope + p.y * u.y))
    }

    fn is_inside(&self, s: f64) -> bool {
        self.value_and_slope(s).0 < 0.0
    }

    /// Where (|p|² + 1 - r²)² - 4 ρ², the product of g and a positive factor, turns: the roots in ascending order of
    /// a quarter of its derivative, s³ + p s + q. With three roots the middle one is a maximum, the others are minima;
    /// a single one is a minimum, given as `reach` or -`reach` if further out.
    #[inline]
    fn turns(&self, reach: f64) -> Turns {
        let k = self.nearest.length_squared() + 1.0 - self.tube_radius * self.tube_radius;
        let p = k - 2.0 * (self.unit.x * self.unit.x + self.unit.z * self.unit.z);
        let q = -2.0 * (self.nearest.x * self.unit.x + self.nearest.z * self.unit.z);
        cubic_roots(p, q, reach)
    }

    /// The first piece of the line in which it goes in, from `start` outside.
    #[inline]
    fn way_in(&self, turns: &Turns, start: f64) -> Option<Piece> {
        let dips = |outside: f64, minimum: f64| {
            (minimum > outside && self.is_inside(minimum)).then_some(Piece { outside, inside: minimum })
        };
        match *turns {
            Turns::One { minimum } => dips(start, minimum),
            Turns::Three { minima: [first, second], maximum } => {
                dips(start, first).or_else(|| dips(start.max(maximum), second))
            }
        }
    }

    /// The first piece of the line in which it goes out, from `start` inside.
    #[inline]
    fn way_out(&self, turns: &Turns, start: f64, reach: f64) -> Piece {
        match *turns {
            Turns::Three { maximum, .. } if maximum > start && !self.is_inside(maximum) => {
                Piece { outside: maximum, inside: start }
            }
            Turns::Three { maximum, .. } => Piece { outside: reach, inside: start.max(maximum) },
            Turns::One { .. } => Piece { outside: reach, inside: start },
        }
    }

    /// The only crossing in a piece: Newton's method on g, halving the piece whenever a step would leave it. It starts
    /// where a parabola through both ends, with its vertex at the inner end, is zero.
    fn crossing(&self, piece: Piece) -> f64 {
        let Piece { mut outside, mut inside } = piece;
        let (g_inside, g_outside) = (self.value_and_slope(inside).0, self.value_and_slope(outside).0);
        let share = (g_inside / (g_inside - g_outside)).max(0.0).sqrt();
        let mut s = inside + (outside - inside) * if share <= 1.0 { share } else { 0.5 };
        for _ in 0..100 {
            let (g, slope) = self.value_and_slope(s);
            if g < 0.0 {
                inside = s;
            } else {
                outside = s;
            }
            let newton = s - g / slope;
            if (newton - s).abs() <= 2.0 * f64::EPSILON || (outside - inside).abs() <= 2.0 * f64::EPSILON {
                break;
            }
            let between = (newton < inside) != (newton < outside);
            s = if between { newton } else { 0.5 * (inside + outside) };
        }
        s
    }
}

/// A piece of the line, from a place outside the tube to one inside, in either order, with one crossing in between.
#[derive(Clone, Copy)]
struct Piece {
    outside: f64,
    inside: f64,
}

/// g at a point at distance `rho` from the axis: below 0 inside the tube.
#[inline]
fn inside_by(p: DVec3, rho: f64, tube_radius: f64) -> f64 {
    (rho - 1.0) * (rho - 1.0) + p.y * p.y - tube_radius * tube_radius
}

/// Places where the quartic turns.
enum Turns {
    One { minimum: f64 },
    Three { minima: [f64; 2], maximum: f64 },
}

/// The real roots of s³ + p s + q. Of three, the outermost is simple and found first by Newton's method from beyond,
/// where it approaches from one side only; the other two solve the quadratic that remains. A single root is sought
/// within `reach` only; one further out is given as `reach`.
#[inline]
fn cubic_roots(p: f64, q: f64, reach: f64) -> Turns {
    // Roots mirror with the sign of q; take it so that the outermost root is positive.
    let sign = if q > 0.0 { -1.0 } else { 1.0 };
    let q = -q.abs();
    let m2 = -p / 3.0;
    let three = m2 > 0.0 && q * q <= 4.0 * m2 * m2 * m2;
    let start = if three {
        2.0 * m2.sqrt()
    } else if p > 0.0 {
        (-q / p).min(reach)
    } else {
        reach
    };
    let outer = newton_from_beyond(p, q, start);
    if !three {
        return Turns::One { minimum: sign * outer };
    }
    let big = -0.5 * (outer + (12.0 * m2 - 3.0 * outer * outer).max(0.0).sqrt());
    let small = if big < 0.0 { (-q / outer) / big } else { 0.0 };
    Turns::Three { minima: if sign > 0.0 { [big, outer] } else { [-outer, -big] }, maximum: sign * small }
}

/// The root of s³ + p s + q that a step of Newton's method approaches from above, from `start` at or beyond it.
#[inline]
fn newton_from_beyond(p: f64, q: f64, start: f64) -> f64 {
    let mut s = start;
    for _ in 0..60 {
        let step = ((s * s + p) * s + q) / (3.0 * s * s + p);
        if step.is_nan() || step <= 1e-16 {
            break;
        }
        s -= step;
    }
    s
}

/// A ray that comes near the torus.
struct Approach {
    line: Line,
    /// Where on the line the ray starts, and how long its direction is.
    origin: f64,
    length: f64,
    /// The torus lies between -`reach` and `reach`.
    reach: f64,
    /// Where to start looking, and whether that is inside.
    start: f64,
    inside: bool,
}

impl Approach {
    fn turns(&self) -> Turns {
        self.line.turns(self.reach)
    }

    /// The ray's parameter at the crossing in a piece.
    fn parameter(&self, piece: Piece) -> f64 {
        (self.line.crossing(piece) - self.origin) / self.length
    }
}

impl Torus {
    #[inline]
    fn approach(&self, ray: &Ray) -> Option<Approach> {
        let (o, d, r) = (ray.origin, ray.direction, self.tube_radius);
        if o.y.abs() > r && o.y * d.y >= 0.0 {
            return None;
        }
        let d2 = d.length_squared();
        let to_nearest = -o.dot(d) / d2;
        let nearest = o + d * to_nearest;
        let reach = (1.0 + r) * (1.0 + 1e-9);
        if nearest.length_squared() > reach * reach {
            return None;
        }
        let length = d2.sqrt();
        let origin = -to_nearest * length;
        if origin >= reach {
            return None;
        }
        let line = Line { nearest, unit: d / length, tube_radius: r };
        let rho = (o.x * o.x + o.z * o.z).sqrt();
        let inside = origin > -reach && inside_by(o, rho, r) < 0.0;
        Some(Approach { line, origin, length, reach, start: origin.max(-reach), inside })
    }
}

impl Shape for Torus {
    fn bounds(&self) -> Bounds {
        let reach = 1.0 + self.tube_radius;
        let corner = DVec3::new(reach, self.tube_radius, reach);
        Bounds { min: -corner, max: corner }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let approach = self.approach(ray)?;
        let (turns, start) = (approach.turns(), approach.start);
        let piece = if approach.inside {
            approach.line.way_out(&turns, start, approach.reach)
        } else {
            approach.line.way_in(&turns, start)?
        };
        let t = approach.parameter(piece);
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, p: DVec3, _part: u32) -> (DVec3, DVec3) {
        let rho = (p.x * p.x + p.z * p.z).sqrt();
        // Smaller than the rounding where it lies, its axis may be hit, or the middle of its tube.
        let center = if rho > 0.0 { DVec3::new(p.x / rho, 0.0, p.z / rho) } else { DVec3::X };
        let normal = if p == center { DVec3::Y } else { (p - center).normalize() };
        (center + normal * self.tube_radius, normal)
    }

    /// Longitude, and the angle about the tube: 0 and 1 at the inner equator, 1/4 at the bottom, 1/2 at the outer
    /// equator, 3/4 on top.
    fn uv(&self, p: DVec3, _part: u32) -> DVec2 {
        let rho = (p.x * p.x + p.z * p.z).sqrt();
        DVec2::new(longitude(p), (atan2(p.y, rho - 1.0) + PI) / (2.0 * PI))
    }

    fn contains(&self, p: DVec3) -> bool {
        inside_by(p, (p.x * p.x + p.z * p.z).sqrt(), self.tube_radius) < 0.0
    }

    /// Each piece ends where the next is sought from: nothing is found twice, and nothing is skipped. If what is found
    /// first lies behind the origin, that is on the surface but for rounding and on the other side than it seemed.
    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        let Some(approach) = self.approach(ray) else { return false };
        let (line, turns) = (&approach.line, approach.turns());
        let (mut from, mut inside, mut starts_inside) = (approach.start, approach.inside, approach.inside);
        loop {
            let piece = if inside {
                line.way_out(&turns, from, approach.reach)
            } else {
                let Some(piece) = line.way_in(&turns, from) else { return starts_inside };
                piece
            };
            let t = approach.parameter(piece);
            if t > 0.0 {
                visit(Crossing { t, part: 0 });
            } else {
                starts_inside = !starts_inside;
            }
            if !inside {
                from = piece.inside;
            } else if t > 0.0 {
                from = piece.outside;
            }
            inside = !inside;
        }
    }

    /// With u = 2⁻⁵³: ρ and the moved origin are known to about 6 u each, g to 4 u r beyond what that makes of it, or
    /// 2 u of distance, and a point is put on the tube to 4 u. Twice their sum.
    fn rounding(&self, _part: u32) -> f64 {
        18.0 * f64::EPSILON
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Known, Random};
    use super::*;

    fn depth(p: DVec3, r: f64) -> f64 {
        let rho = (p.x * p.x + p.z * p.z).sqrt();
        ((rho - 1.0) * (rho - 1.0) + p.y * p.y).sqrt() - r
    }

    #[test]
    fn keeps_the_laws() {
        for r in [0.1, 0.25, 0.5, 0.9] {
            let level = |p: DVec3| depth(p, r);
            let known = Known { shape: &Torus { tube_radius: r }, levels: &[&level] };
            known.hits_obey_the_equation();
            known.crossings_match_sampling(&level, true, |_| true);
            known.far_rays_are_precise(false);
            known.crossings_are_those_found_one_by_one();
        }
    }

    /// Rays that leave outwards from the half that is curved outwards in every direction do not come back to it;
    /// wherever they start, what they meet first is met from outside. Rays that go in come out.
    #[test]
    fn leaves_and_enters_once_even_if_thin() {
        let mut random = Random(13);
        for r in [1e-6, 1e-3, 0.1, 0.5, 0.999] {
            let torus = Torus { tube_radius: r };
            let offset = torus.rounding(0) * 1.01;
            for _ in 0..20_000 {
                let ring = random.direction() * DVec3::new(1.0, 0.0, 1.0);
                let tube = random.direction();
                let center = ring.normalize();
                let across = center * tube.x.abs() + DVec3::Y * tube.y;
                let (p, n) = torus.surface(center + across.normalize() * r, 0);
                let v = random.direction();
                let cosine = random.power(-9.0, 0.0);
                let out = n * cosine + (v - n * v.dot(n)).normalize() * (1.0 - cosine * cosine).sqrt();
                let back = torus.intersect(&Ray { origin: p + n * offset, direction: out }, f64::INFINITY);
                assert_eq!(back, None, "r = {r}: left at {p} along {out} (cosine {cosine})");
                let inward = Ray { origin: p - n * offset, direction: -out };
                let exit = torus.intersect(&inward, f64::INFINITY).expect("what is inside comes out");
                let q = inward.at(exit.t);
                let (_, m) = torus.surface(q, 0);
                assert!(depth(q, r).abs() < torus.rounding(0), "r = {r}: {inward:?} comes out at {q}");
                assert!(m.dot(inward.direction) > -1e-7, "r = {r}: {inward:?} comes out at {q}");
            }
        }
    }

    #[test]
    fn through_the_tube_and_the_hole() {
        let torus = Torus { tube_radius: 0.25 };
        let hit = |origin, direction| torus.intersect(&Ray { origin, direction }, f64::INFINITY).map(|hit| hit.t);
        let near = |t: Option<f64>, expected: f64| t.is_some_and(|t| (t - expected).abs() < 1e-14);
        let from_left = |x| hit(DVec3::new(x, 0.0, 0.0), DVec3::X);
        assert!(near(from_left(-3.0), 1.75) && near(from_left(-1.0), 0.25));
        assert!(near(from_left(0.0), 0.75) && near(from_left(1.0), 0.25));
        assert_eq!(from_left(2.0), None);
        assert_eq!(hit(DVec3::new(0.0, 5.0, 0.0), DVec3::NEG_Y), None, "down the hole");
        assert!(near(hit(DVec3::new(0.6, 5.0, 0.8), DVec3::NEG_Y), 4.75));
        assert_eq!(hit(DVec3::new(-3.0, 0.250_001, 0.0), DVec3::X), None, "just above");
    }

    #[test]
    fn texture_coordinates() {
        let at = |x, y, z| Torus { tube_radius: 0.25 }.uv(DVec3::new(x, y, z), 0);
        assert_eq!(at(1.25, 0.0, 0.0), DVec2::new(0.5, 0.5));
        assert_eq!(at(0.0, 0.25, -1.0), DVec2::new(0.25, 0.75));
        assert_eq!(at(0.0, -0.25, 1.0), DVec2::new(0.75, 0.25));
        assert_eq!(at(0.75, 0.0, 0.0), DVec2::new(0.5, 1.0));
    }
}
