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
    /// a single one is a minimum. Those further out than `reach` may be missing, but for the minimum if there is one.
    #[inline]
    fn turns(&self, reach: f64) -> Turns {
        let k = self.nearest.length_squared() + 1.0 - self.tube_radius * self.tube_radius;
        let p = k - 2.0 * (self.unit.x * self.unit.x + self.unit.z * self.unit.z);
        let q = -2.0 * (self.nearest.x * self.unit.x + self.nearest.z * self.unit.z);
        cubic_roots(p, q, reach)
    }

    /// The root of g between `low` and `high`, where its signs differ: Newton's method, halving the bracket whenever a
    /// step would leave it or does not shrink fast enough.
    fn root(&self, mut low: f64, mut high: f64) -> f64 {
        let low_inside = self.is_inside(low);
        let mut s = 0.5 * (low + high);
        for _ in 0..100 {
            let (g, slope) = self.value_and_slope(s);
            if (g < 0.0) == low_inside {
                low = s;
            } else {
                high = s;
            }
            let newton = s - g / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - s).abs() <= f64::EPSILON || high - low <= f64::EPSILON {
                return next;
            }
            s = next;
        }
        s
    }
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

impl Torus {
    /// The first piece of the line, from `start` on, over which the ray goes in or out.
    #[inline]
    fn first_bracket(&self, line: &Line, start: f64, starts_inside: bool, reach: f64) -> Option<(f64, f64)> {
        let turns = line.turns(reach);
        if starts_inside {
            return match turns {
                Turns::Three { maximum, .. } if maximum > start && !line.is_inside(maximum) => Some((start, maximum)),
                Turns::Three { maximum, .. } => Some((start.max(maximum), reach)),
                Turns::One { .. } => Some((start, reach)),
            };
        }
        let dips = |from: f64, minimum: f64| (minimum > from && line.is_inside(minimum)).then_some((from, minimum));
        match turns {
            Turns::One { minimum } => dips(start, minimum),
            Turns::Three { minima: [first, second], maximum } => {
                dips(start, first).or_else(|| dips(start.max(maximum), second))
            }
        }
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
        let (o, d, r) = (ray.origin, ray.direction, self.tube_radius);
        if o.y.abs() > r && o.y * d.y >= 0.0 {
            return None;
        }
        let d2 = d.length_squared();
        let to_nearest = -o.dot(d) / d2;
        let nearest = o + d * to_nearest;
        let reach = (1.0 + r) * (1.0 + 1e-9);
        let nearest2 = nearest.length_squared();
        if nearest2 > reach * reach {
            return None;
        }
        let length = d2.sqrt();
        let origin_s = -to_nearest * length;
        if origin_s >= reach {
            return None;
        }
        let line = Line { nearest, unit: d / length, tube_radius: r };
        let rho = (o.x * o.x + o.z * o.z).sqrt();
        let starts_inside = origin_s > -reach && inside_by(o, rho, r) < 0.0;
        let (low, high) = self.first_bracket(&line, origin_s.max(-reach), starts_inside, reach)?;
        let t = (line.root(low, high) - origin_s) / length;
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, p: DVec3, _part: u32) -> (DVec3, DVec3) {
        let rho = (p.x * p.x + p.z * p.z).sqrt();
        let center = DVec3::new(p.x / rho, 0.0, p.z / rho);
        let normal = (p - center).normalize();
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

    /// With u = 2⁻⁵³: ρ and the moved origin are known to about 6 u each, g to 4 u r beyond what that makes of it, or
    /// 2 u of distance, and a point is put on the tube to 4 u. Twice their sum.
    fn rounding(&self) -> f64 {
        18.0 * f64::EPSILON
    }
}
