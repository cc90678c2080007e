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

    /// What both contain.
    pub fn intersection(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// The box larger by a margin on every side.
    pub fn widened(self, margin: f64) -> Bounds {
        Bounds { min: self.min - margin, max: self.max + margin }
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

    /// The eight corners.
    pub fn corners(&self) -> [DVec3; 8] {
        let end = |index: usize, bit: usize| if index >> bit & 1 == 0 { self.min } else { self.max };
        std::array::from_fn(|index| DVec3::new(end(index, 0).x, end(index, 1).y, end(index, 2).z))
    }

    /// Half the surface area, for the surface area heuristic; zero if empty.
    pub fn half_area(&self) -> f64 {
        let d = self.size();
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// A box around the image of this one under `map`, widened by what rounding may take away; infinite on every side if
    /// this one is on any.
    pub fn transformed(&self, map: &DAffine3) -> Bounds {
        if self.is_empty() {
            return *self;
        }
        if !(self.min.is_finite() && self.max.is_finite()) {
            return Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        }
        let (center, half) = (self.center(), self.size() * 0.5);
        let m = map.matrix3;
        let middle = map.transform_point3(center);
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        let slack = (middle.abs() + reach) * 1e-14;
        Bounds { min: middle - reach - slack, max: middle + reach + slack }
    }
}
