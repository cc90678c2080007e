//! How far a circle turns light that comes to it in its plane.
//!
//! Whoever looks at a ball or across a cylinder along some ray sees it turned in one plane, that of the ray and the middle, and by
//! how much depends on one number: where the ray meets the circle. So all rays that leave in a given direction are the roots of one
//! equation, and none is missed. (For shapes in general they are looked for by walking: Zeltner, Georgiev and Jakob, "Specular
//! Manifold Sampling", SIGGRAPH 2020; that light may be found so is an old idea: Mitchell and Hanrahan, "Illumination from Curved
//! Reflectors", SIGGRAPH 1992.)
//!
//! The circle has radius 1 and is seen from a point at distance 1/q. A ray starts at an angle t to the line to the middle and meets
//! the circle at the angle θ to its normal, where sin t = q sin θ; when it leaves it has the angle o to that line, counted in the
//! same sense as t. Turned back by the circle, o = t + π - 2θ; through it, with the index n, o = t - 2(θ - θ') with
//! sin θ = n sin θ'. The latter first grows with θ if the point is near, and then falls; in t it is concave.
//!
//! Angles are pairs of sine and cosine: square roots are faster than the functions of angles, and as exact.

use arrayvec::ArrayVec;
use durer_math::functions::{acos, asin, cos, sin};
use std::f64::consts::{PI, TAU};

/// Sine and cosine of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Angle {
    pub(super) sin: f64,
    pub(super) cos: f64,
}

impl Angle {
    const ZERO: Angle = Angle { sin: 0.0, cos: 1.0 };
    const RIGHT: Angle = Angle { sin: 1.0, cos: 0.0 };

    /// With this sine, from 0 to a right angle.
    pub(super) fn of_sine(sin: f64) -> Angle {
        Angle { sin, cos: ((1.0 - sin) * (1.0 + sin)).max(0.0).sqrt() }
    }

    pub(super) fn plus(self, other: Angle) -> Angle {
        Angle { sin: self.sin * other.cos + self.cos * other.sin, cos: self.cos * other.cos - self.sin * other.sin }
    }

    pub(super) fn negative(self) -> Angle {
        Angle { sin: -self.sin, ..self }
    }

    fn minus(self, other: Angle) -> Angle {
        self.plus(other.negative())
    }

    fn twice(self) -> Angle {
        self.plus(self)
    }

    /// Halfway to another, less than half a turn away.
    fn halfway(self, other: Angle) -> Angle {
        let (sin, cos) = (self.sin + other.sin, self.cos + other.cos);
        let scale = 1.0 / (sin * sin + cos * cos).sqrt();
        Angle { sin: sin * scale, cos: cos * scale }
    }

    /// A little more, by what is almost this angle.
    fn a_little_more(self, by: f64) -> Angle {
        let half = 0.5 * by;
        let scale = 1.0 / (1.0 + half * half);
        self.plus(Angle { sin: 2.0 * half * scale, cos: (1.0 - half * half) * scale })
    }

    /// True if it is larger; both are above minus half a turn, up to half a turn.
    fn is_above(self, other: Angle) -> bool {
        match (self.sin >= 0.0, other.sin >= 0.0) {
            (true, true) => self.cos < other.cos,
            (false, false) => self.cos > other.cos,
            (is_positive, _) => is_positive,
        }
    }
}

/// A circle, seen from a point outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    /// Its radius over the distance of its middle; less than 1.
    pub(super) q: f64,
    /// The index of refraction inside, over that outside, if light is to go through; else it is turned back.
    pub(super) eta: Option<f64>,
}

/// A ray that has met a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// θ.
    pub(super) met: Angle,
    /// t.
    pub(super) start: Angle,
    /// o.
    pub(super) end: Angle,
    /// do/dθ.
    rise: f64,
}

impl Turned {
    /// |do/dt|.
    pub(super) fn spread(&self, q: f64) -> f64 {
        (self.rise * self.start.cos / (q * self.met.cos)).abs()
    }
}

/// More steps are never needed: each halves what is left, at least.
const MOST_STEPS: u32 = 60;
/// After a step of Newton's that is smaller than this, what is wrong is less than its square.
const SMALL: f64 = 1e-7;

impl Circle {
    /// What becomes of the ray that meets it under an angle.
    pub(super) fn turn(&self, met: Angle) -> Turned {
        let start = Angle::of_sine(self.q * met.sin);
        let slower = self.q * met.cos / start.cos;
        match self.eta {
            None => {
                let end = start.minus(met.twice());
                Turned { met, start, end: Angle { sin: -end.sin, cos: -end.cos }, rise: slower - 2.0 }
            }
            Some(eta) => {
                let inside = Angle::of_sine((met.sin / eta).min(1.0));
                let end = start.minus(met.minus(inside).twice());
                Turned { met, start, end, rise: slower - 2.0 * (1.0 - met.cos / (eta * inside.cos)) }
            }
        }
    }

    /// All rays that leave at this angle, from 0 to half a turn: each with the side on which it starts, 1 or -1. (On the side of 1,
    /// t and o are as they are; on the other they are counted the other way round.)
    pub(super) fn rays(&self, end: Angle) -> ArrayVec<(f64, Turned), 3> {
        let mut rays = ArrayVec::new();
        let mut look = |side: f64, from: Angle, to: Angle| {
            let wanted = if side > 0.0 { end } else { end.negative() };
            rays.extend(self.root(wanted, from, to).map(|ray| (side, ray)));
        };
        match self.eta {
            None => look(1.0, Angle::ZERO, Angle::RIGHT),
            Some(_) => {
                let turning = self.turning_point();
                if turning != Angle::ZERO {
                    look(1.0, Angle::ZERO, turning);
                    look(1.0, turning, Angle::RIGHT);
                }
                look(-1.0, turning, Angle::RIGHT);
            }
        }
        rays
    }

    /// Up to which θ the angle of light that has gone through grows.
    fn turning_point(&self) -> Angle {
        if self.turn(Angle::ZERO).rise <= 0.0 {
            return Angle::ZERO;
        }
        let (mut low, mut high) = (Angle::ZERO, Angle::RIGHT);
        for _ in 0..MOST_STEPS {
            let middle = low.halfway(high);
            *if self.turn(middle).rise > 0.0 { &mut low } else { &mut high } = middle;
        }
        low
    }

    /// The θ between two angles where the ray leaves at `wanted`, if it rises or falls all the way: Newton's method, and
    /// halves where that leads astray.
    fn root(&self, wanted: Angle, from: Angle, to: Angle) -> Option<Turned> {
        let is_above = |ray: &Turned| ray.end.is_above(wanted);
        let first = self.turn(from);
        let starts_above = is_above(&first);
        if is_above(&self.turn(to)) == starts_above {
            return None;
        }
        let (mut low, mut high) = (from, to);
        // Where it is seen small, the angle grows with θ almost evenly at first.
        let guess = from.a_little_more(sine_between(first.end, wanted) / first.rise);
        let mut met = if is_between(guess, low, high) { guess } else { low.halfway(high) };
        for _ in 0..MOST_STEPS {
            let ray = self.turn(met);
            *if is_above(&ray) == starts_above { &mut low } else { &mut high } = met;
            let step = sine_between(ray.end, wanted) / ray.rise;
            let next = met.a_little_more(step);
            met = match is_between(next, low, high) {
                true if step.abs() < SMALL => return Some(self.turn(next)),
                true => next,
                false => low.halfway(high),
            };
        }
        Some(self.turn(met))
    }
}

/// The inside of a circle, seen from a point in it at this distance from the middle, in parts of the radius: a ray is turned back
/// several times, each time by as much, in the sense in which the middle lies.
///
/// A ray starts at an angle s to the line to the middle, and meets the circle at the angle ψ to its normal, where sin ψ = q sin s.
/// After k times it has the angle s + 2 k ψ + k π. That rises with s where cos s is above a number, and falls elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    /// Less than 1.
    pub(super) q: f64,
    /// k.
    pub(super) times: u32,
}

impl Inside {
    /// The angle with which a ray ends, from that with which it starts.
    fn end(&self, start: f64) -> f64 {
        let times = f64::from(self.times);
        start + 2.0 * times * asin(self.q * sin(start)) + times * PI
    }

    /// The derivative of that.
    pub(super) fn rise(&self, start: Angle) -> f64 {
        let met = Angle::of_sine(self.q * start.sin);
        1.0 + 2.0 * f64::from(self.times) * self.q * start.cos / met.cos
    }

    /// All angles, from -π to π, of rays that end with this one.
    pub(super) fn starts(&self, end: f64) -> ArrayVec<f64, MOST_STARTS> {
        let mut starts = ArrayVec::new();
        let four = 4.0 * f64::from(self.times) * f64::from(self.times);
        let turning = ((1.0 - self.q * self.q) / (self.q * self.q * (four - 1.0))).sqrt();
        let turning = if self.times > 0 && turning < 1.0 { acos(-turning) } else { PI };
        let mut look = |from: f64, to: f64| {
            let (first, last) = (self.end(from), self.end(to));
            let (low, high) = (first.min(last), first.max(last));
            let mut wanted = end + TAU * ((low - end) / TAU).ceil();
            while wanted < high {
                debug_assert!(!starts.is_full());
                let _ = starts.try_push(self.root(wanted, from, to));
                wanted += TAU;
            }
        };
        look(-turning, turning);
        if turning < PI {
            look(turning, TAU - turning);
        }
        starts
    }

    /// The start between two, where the end rises or falls all the way, of a ray that ends so.
    fn root(&self, wanted: f64, from: f64, to: f64) -> f64 {
        let rises = self.end(from) < self.end(to);
        let (mut low, mut high) = (from, to);
        let mut start = 0.5 * (low + high);
        for _ in 0..MOST_STEPS {
            let off = wanted - self.end(start);
            *if (off > 0.0) == rises { &mut low } else { &mut high } = start;
            let (sin, cos) = (sin(start), cos(start));
            let step = off / self.rise(Angle { sin, cos });
            let next = start + step;
            start = match next > low && next < high {
                true if step.abs() < SMALL => return next,
                true => next,
                false => 0.5 * (low + high),
            };
        }
        start
    }
}

/// With k times there are 2 k + 1 at most, and k is 3 at most.
pub(super) const MOST_STARTS: usize = 7;

/// The sine of the angle from one to another; infinite if that is more than a right angle.
fn sine_between(from: Angle, to: Angle) -> f64 {
    let between = to.minus(from);
    if between.cos > 0.0 { between.sin } else { f64::INFINITY }
}

/// True of an angle between two that are less than half a turn apart.
fn is_between(angle: Angle, low: Angle, high: Angle) -> bool {
    angle.minus(low).sin > 0.0 && high.minus(angle).sin > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::functions::atan2;

    fn angle(of: f64) -> Angle {
        Angle { sin: sin(of), cos: cos(of) }
    }

    fn radians(angle: Angle) -> f64 {
        atan2(angle.sin, angle.cos)
    }

    /// o by the formulas at the top.
    fn end(circle: &Circle, met: f64) -> f64 {
        let start = asin(circle.q * sin(met));
        match circle.eta {
            None => start + PI - 2.0 * met,
            Some(eta) => start - 2.0 * (met - asin(sin(met) / eta)),
        }
    }

    const CIRCLES: [Circle; 7] = [
        Circle { q: 0.01, eta: Some(1.5) },
        Circle { q: 0.3, eta: Some(1.33) },
        Circle { q: 0.7, eta: Some(1.5) },
        Circle { q: 0.99, eta: Some(1.5) },
        Circle { q: 0.9, eta: Some(2.4) },
        Circle { q: 0.02, eta: None },
        Circle { q: 0.95, eta: None },
    ];

    #[test]
    fn every_ray_is_found_by_where_it_goes_and_no_other() {
        for circle in CIRCLES {
            for step in 1..400 {
                let wanted = PI * f64::from(step) / 400.0;
                let found = circle.rays(angle(wanted));
                // As many as times that the angle passes it.
                let places = |side: f64| {
                    let at = |step: u32| side * end(&circle, 0.5 * PI * f64::from(step) / 20_000.0) - wanted;
                    (0..20_000).filter(|&step| at(step) * at(step + 1) < 0.0).count()
                };
                assert_eq!(found.len(), places(1.0) + places(-1.0), "{circle:?} {wanted}");
                for (side, ray) in found {
                    let met = radians(ray.met);
                    assert!((side * end(&circle, met) - wanted).abs() < 1e-12, "{circle:?} {wanted} {ray:?}");
                    assert!((sin(radians(ray.start)) - circle.q * sin(met)).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn spread_is_the_derivative() {
        for circle in CIRCLES {
            for step in 1..100 {
                let met = 0.5 * PI * f64::from(step) / 100.0;
                let h = 1e-5;
                let start = |met: f64| asin(circle.q * sin(met));
                let slope = (end(&circle, met + h) - end(&circle, met - h)) / (start(met + h) - start(met - h));
                let spread = circle.turn(angle(met)).spread(circle.q);
                assert!((spread - slope.abs()).abs() < 1e-6 * (1.0 + spread), "{circle:?} {met}: {spread} {slope}");
            }
        }
    }

    #[test]
    fn every_ray_inside_is_found_by_where_it_goes() {
        for (q, times) in [(0.0, 1), (0.2, 0), (0.3, 1), (0.7, 1), (0.99, 1), (0.3, 2), (0.9, 2), (0.05, 3), (0.95, 3)]
        {
            let inside = Inside { q, times };
            for step in 1..200 {
                let wanted = PI * f64::from(step) / 200.0;
                let found = inside.starts(wanted);
                let off = |step: u32| {
                    let off = inside.end(PI * (f64::from(step) / 10_000.0 - 1.0)) - wanted;
                    (off / TAU, (off / TAU).floor())
                };
                // Whole turns that it passes; none is a jump.
                let passed = (0..20_000).filter(|&step| off(step).1 != off(step + 1).1).count();
                assert_eq!(found.len(), passed, "{inside:?} {wanted}: {found:?}");
                for start in found {
                    let turns = (inside.end(start) - wanted) / TAU;
                    assert!((turns - turns.round()).abs() < 1e-12, "{inside:?} {wanted} {start}");
                    let h = 1e-6;
                    let slope = (inside.end(start + h) - inside.end(start - h)) / (2.0 * h);
                    let rise = inside.rise(Angle { sin: sin(start), cos: cos(start) });
                    assert!((rise - slope).abs() < 1e-5 * (1.0 + slope.abs()), "{inside:?} {start}: {rise} {slope}");
                }
            }
        }
    }

    /// The formula against a ray that is followed.
    #[test]
    fn rays_inside_go_where_they_are_followed_to() {
        for (q, start, times) in [(0.3, 0.7, 1), (0.8, -1.2, 2), (0.5, 2.8, 3), (0.9, -2.0, 1)] {
            // The point is at -q on the x axis, and the middle is seen along that.
            let (mut x, mut y, mut dx, mut dy) = (-q, 0.0, cos(start), sin(start));
            for _ in 0..times {
                let along = x * dx + y * dy;
                let t = (along * along + 1.0 - x * x - y * y).sqrt() - along;
                (x, y) = (x + t * dx, y + t * dy);
                let on = dx * x + dy * y;
                (dx, dy) = (dx - 2.0 * on * x, dy - 2.0 * on * y);
            }
            let turns = (Inside { q, times }.end(start) - atan2(dy, dx)) / TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{q} {start} {times}: {turns}");
        }
    }
}
