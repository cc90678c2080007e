//! What frusta and capsules have in common: an axis between two points.

use durer_math::{DAffine3, DMat3, DVec3, rotation_between};

/// The way from one point to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) base: DVec3,
    pub(super) top: DVec3,
}

impl Axis {
    /// How long it is.
    pub(super) fn length(&self) -> f64 {
        (self.top - self.base).length()
    }

    /// From base to top, of unit length; some direction if they are the same point.
    pub(super) fn up(&self) -> DVec3 {
        let length = self.length();
        if length > 0.0 { (self.top - self.base) / length } else { DVec3::Y }
    }

    /// How far a point is above the base, and the way from the axis to it.
    pub(super) fn split(&self, point: DVec3) -> (f64, DVec3) {
        let (up, from_base) = (self.up(), point - self.base);
        let height = from_base.dot(up);
        (height, from_base - up * height)
    }

    /// A point as seen from the base, turned so that the axis is +y: as single cones turn it.
    pub(super) fn upright(&self, point: DVec3) -> DVec3 {
        rotation_between(DVec3::Y, self.up()).transpose() * (point - self.base)
    }

    /// The map that takes the origin to the base and the y axis to this one, and stretches along the axes before it turns.
    pub(super) fn frame(&self, stretch: DVec3) -> DAffine3 {
        let turn = rotation_between(DVec3::Y, self.up());
        DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(stretch), self.base)
    }

    /// The largest coordinate of either end.
    pub(super) fn largest(&self) -> f64 {
        self.base.abs().max(self.top.abs()).max_element()
    }
}
