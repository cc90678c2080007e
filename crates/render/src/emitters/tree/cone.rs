//! Cones around the normals of emitters, and of the directions in which they shine.

use super::widened;
use durer_math::DVec3;
use durer_math::functions::{acos, cos, sin};
use std::f64::consts::PI;

/// What sides of surfaces give light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Faces {
    /// That to which the normal points.
    Front,
    /// Both, of bodies: but from outside the inner one is not seen.
    Closed,
    /// Both.
    Both,
}

impl Faces {
    /// What the back gives, if the front gives 1. For bodies it is just not nothing: for those who are inside.
    fn back(self) -> f64 {
        match self {
            Faces::Front => 0.0,
            Faces::Closed => 0.01,
            Faces::Both => 1.0,
        }
    }
}

/// All directions within an angle of an axis: those of normals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    /// Of unit length; zero where all directions are in it.
    pub(crate) axis: DVec3,
    /// Of the half-angle; -1 for all directions.
    pub(crate) cosine: f64,
    /// The cosine of the greatest angle to a normal in which light is given off: 0 for surfaces, which shine in all directions
    /// before them, and more for spots, which do not.
    pub(crate) spread: f64,
    pub(crate) faces: Faces,
}

impl Cone {
    /// All directions.
    pub(crate) const ALL: Cone = Cone { axis: DVec3::ZERO, cosine: -1.0, spread: 0.0, faces: Faces::Closed };

    /// One direction.
    pub(crate) fn of(axis: DVec3, faces: Faces) -> Cone {
        Cone { axis, cosine: 1.0, spread: 0.0, faces }
    }

    /// A spot with these cosines of half-angles: all around its axis it is as bright as on it, up to the `inner` one, and dark
    /// from the `outer` one on.
    pub(crate) fn of_spot(axis: DVec3, inner: f64, outer: f64) -> Cone {
        // The cosine of the difference.
        let spread = inner * outer + ((1.0 - inner * inner).max(0.0) * (1.0 - outer * outer).max(0.0)).sqrt();
        // Those that shine behind what is a right angle from their inner part: the tree's nodes do not tell them from the rest.
        if spread <= 0.0 {
            return Cone::ALL;
        }
        Cone { axis, cosine: inner, spread: spread.min(1.0), faces: Faces::Front }
    }

    /// The most, from 0 to 1, that a surface with a normal in the cone shows in a direction, if that is known but for an angle
    /// with the cosine `blur`.
    pub(super) fn brightness(&self, toward: DVec3, blur: f64) -> f64 {
        if self.cosine <= -1.0 {
            return 1.0;
        }
        let cosine = self.axis.dot(toward);
        let shown = |cosine: f64| match widened(widened(cosine, blur), self.cosine) {
            shown if shown >= self.spread => shown,
            _ => 0.0,
        };
        shown(cosine).max(self.faces.back() * shown(-cosine))
    }

    /// A cone around both.
    pub(super) fn union(self, other: Cone) -> Cone {
        let (faces, spread) = (self.faces.max(other.faces), self.spread.min(other.spread));
        if self.cosine <= -1.0 || other.cosine <= -1.0 {
            return Cone { faces, ..Cone::ALL };
        }
        // Those that shine on both sides have no front.
        let turns = self.faces == Faces::Both && other.faces == Faces::Both && self.axis.dot(other.axis) < 0.0;
        let other_axis = if turns { -other.axis } else { other.axis };
        let [wide, narrow] = [self.cosine, other.cosine].map(|cosine| acos(cosine.clamp(-1.0, 1.0)));
        let between = acos(self.axis.dot(other_axis).clamp(-1.0, 1.0));
        if (between + narrow).min(PI) <= wide {
            return Cone { faces, spread, ..self };
        }
        if (between + wide).min(PI) <= narrow {
            return Cone { axis: other_axis, cosine: other.cosine, spread, faces };
        }
        let half = 0.5 * (wide + between + narrow);
        if half >= PI {
            return Cone { faces, ..Cone::ALL };
        }
        let across = (other_axis - self.axis * self.axis.dot(other_axis)).normalize_or_zero();
        if across == DVec3::ZERO {
            return Cone { faces, ..Cone::ALL };
        }
        let by = half - wide;
        let axis = self.axis * cos(by) + across * sin(by);
        Cone { axis: axis.normalize(), cosine: cos(half), spread, faces }
    }
}
