//! The unit square in the plane y = 0, with a corner at the origin; under a transform, any parallelogram.

use super::{Shape, plane};
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// The points with y = 0, 0 ≤ x ≤ 1 and 0 ≤ z ≤ 1, with normal +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle;

impl Shape for Rectangle {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::ZERO, max: DVec3::new(1.0, 0.0, 1.0) }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let t = plane::meet(ray, t_max)?;
        let x = ray.origin.x + t * ray.direction.x;
        let z = ray.origin.z + t * ray.direction.z;
        (x >= 0.0 && x <= 1.0 && z >= 0.0 && z <= 1.0).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        (DVec3::new(point.x, 0.0, point.z), DVec3::Y)
    }

    /// (x, z): from 0 to 1 along each edge.
    fn uv(&self, point: DVec3, _part: u32) -> DVec2 {
        DVec2::new(point.x, point.z)
    }

    fn contains(&self, _point: DVec3) -> bool {
        false
    }

    /// Zero, as for the plane.
    fn rounding(&self) -> f64 {
        0.0
    }
}
