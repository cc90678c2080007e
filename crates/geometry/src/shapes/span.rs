//! The piece of a ray inside a convex set. A closed shape is an intersection of such sets, so its crossings are the
//! ends of the common piece.
//!
//! The other way, to test side and caps one by one, leaves pinholes: at the rim each part can round the ray to the
//! other's share. Here a ray that enters has entered through some part, whichever set it came into last.

use crate::Crossing;
use durer_math::DVec3;

/// How far inside its bounds a snapped point is kept, as a factor: a point exactly on a rim, moved inwards along one of
/// the two normals there, would still be on the other surface.
pub(super) const INSET: f64 = 1.0 - 4.0 * f64::EPSILON;

/// From `enter` to `exit`, with the parts crossed there. An `enter` that is not positive means no more than that the
/// ray starts inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) enter: f64,
    pub(super) exit: f64,
    pub(super) enter_part: u32,
    pub(super) exit_part: u32,
}

impl Span {
    /// Between the planes at `low` and `high` of one coordinate, given the ray's `origin` and `direction` in it;
    /// `parts` are those of the two planes. `None` if it lies behind the origin, or the ray is parallel and outside or
    /// in one of the planes.
    ///
    /// The early answer also keeps 0 · ∞ away from the products below.
    #[inline]
    pub(super) fn slab(origin: f64, direction: f64, (low, high): (f64, f64), parts: (u32, u32)) -> Option<Span> {
        if (origin >= high && direction >= 0.0) || (origin <= low && direction <= 0.0) {
            return None;
        }
        let inverse = 1.0 / direction;
        let (to_low, to_high) = ((low - origin) * inverse, (high - origin) * inverse);
        Some(if inverse < 0.0 {
            Span { enter: to_high, exit: to_low, enter_part: parts.1, exit_part: parts.0 }
        } else {
            Span { enter: to_low, exit: to_high, enter_part: parts.0, exit_part: parts.1 }
        })
    }

    /// What both have in common; in a tie the part is that of `self`.
    #[inline]
    pub(super) fn and(self, other: Span) -> Span {
        let (enter, enter_part) =
            if other.enter > self.enter { (other.enter, other.enter_part) } else { (self.enter, self.enter_part) };
        let (exit, exit_part) =
            if other.exit < self.exit { (other.exit, other.exit_part) } else { (self.exit, self.exit_part) };
        Span { enter, exit, enter_part, exit_part }
    }

    /// Calls `visit` for the ends ahead of the origin, if the span is not empty; gives whether the ray starts inside.
    pub(super) fn ends(self, visit: &mut dyn FnMut(Crossing)) -> bool {
        let ahead = self.enter < self.exit && self.exit > 0.0;
        if ahead && self.enter > 0.0 {
            visit(Crossing { t: self.enter, part: self.enter_part });
        }
        if ahead && self.exit < f64::INFINITY {
            visit(Crossing { t: self.exit, part: self.exit_part });
        }
        ahead && self.enter <= 0.0
    }

    /// The first end ahead of the origin, if the span is not empty.
    #[inline]
    pub(super) fn first(self) -> Option<Crossing> {
        let (t, part) = if self.enter > 0.0 { (self.enter, self.enter_part) } else { (self.exit, self.exit_part) };
        (self.enter < self.exit && t > 0.0).then_some(Crossing { t, part })
    }
}

/// Which of the two planes at `low` and `high` of one coordinate a ray stays within `width` of for all t in `range`, given
/// its `origin` and `direction` in that coordinate: -1 or 1.
#[inline]
pub(super) fn plane_along(
    origin: f64,
    direction: f64,
    (low, high): (f64, f64),
    range: (f64, f64),
    width: f64,
) -> Option<f64> {
    let (from, to) = (origin + range.0 * direction, origin + range.1 * direction);
    let along = |level: f64| (from - level).abs() <= width && (to - level).abs() <= width;
    if along(high) {
        Some(1.0)
    } else if along(low) {
        Some(-1.0)
    } else {
        None
    }
}

/// Moves a point of a cap in its plane, so that it is no further than `radius` from the y axis.
pub(super) fn into_cap(point: DVec3, y: f64, radius: f64) -> DVec3 {
    let distance = (point.x * point.x + point.z * point.z).sqrt();
    let scale = if distance > radius * INSET { radius / distance * INSET } else { 1.0 };
    DVec3::new(point.x * scale, y, point.z * scale)
}
