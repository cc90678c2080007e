//! Axis-aligned boxes that bound things.

use crate::simd::boxes::Box32;
use durer_math::{DAffine3, DVec3};

/// An axis-aligned box, from `min` to `max`; empty if `min > max` in some coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl From<Box32> for Bounds {
    fn from(narrow: Box32) -> Bounds {
        let wide = |corner: [f32; 3]| DVec3::from(corner.map(f64::from));
        Bounds { min: wide(narrow.min()), max: wide(narrow.max()) }
    }
}

impl Bounds {
    /// Contains nothing; the neutral element of [`Bounds::union`].
    pub const EMPTY: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around some points.
    pub fn of_points(points: impl IntoIterator<Item = DVec3>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, |b, p| Bounds { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The smallest box around both.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// True if it contains no point.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// The middle.
    pub fn center(&self) -> DVec3 {
        (self.min + self.max) * 0.5
    }

    /// The lengths of the edges; zero if empty.
    pub fn size(&self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { self.max - self.min }
    }

    /// Half the surface area, for the surface area heuristic; zero if empty.
    pub fn half_area(&self) -> f64 {
        let d = self.size();
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// A box around the image of this one under `map`, widened by what rounding may take away.
    pub fn transformed(&self, map: &DAffine3) -> Bounds {
        if self.is_empty() {
            return *self;
        }
        let (center, half) = (self.center(), self.size() * 0.5);
        let m = map.matrix3;
        let middle = map.transform_point3(center);
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        let slack = (middle.abs() + reach) * 1e-14;
        Bounds { min: middle - reach - slack, max: middle + reach + slack }
    }
}
