//! Rays and where they hit.

use durer_math::{DAffine3, DVec3};

/// A half-line: the points `origin + t · direction` with t > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes. Of unit length in world space; any length but zero in a shape's own space, so that t means the
    /// same point in both.
    pub direction: DVec3,
}

impl Ray {
    /// The point at parameter `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// The same ray in another space; parameters keep their meaning.
    pub fn transformed(&self, map: &DAffine3) -> Ray {
        Ray { origin: map.transform_point3(self.origin), direction: map.transform_vector3(self.direction) }
    }
}

/// Where a ray meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The ray's parameter there.
    pub t: f64,
    /// Which of the shape's surfaces it is (a face of a box, side or cap of a cylinder); meaning is the shape's own.
    pub part: u32,
}
