//! The unit disc in the plane y = 0, with a round hole if wanted.

use super::{Shape, plane};
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// The points with y = 0 and `inner_radius` ≤ r ≤ 1, with normal +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disc {
    /// Radius of the hole, in [0, 1).
    pub(crate) inner_radius: f64,
}

impl Shape for Disc {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 0.0, 1.0) }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let t = plane::meet(ray, t_max)?;
        let x = ray.origin.x + t * ray.direction.x;
        let z = ray.origin.z + t * ray.direction.z;
        let r2 = x * x + z * z;
        (r2 <= 1.0 && r2 >= self.inner_radius * self.inner_radius).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        (DVec3::new(point.x, 0.0, point.z), DVec3::Y)
    }

    /// The square around the disc, as for the caps of a cylinder: an image keeps its shape.
    fn uv(&self, point: DVec3, _part: u32) -> DVec2 {
        DVec2::new((point.x + 1.0) * 0.5, (point.z + 1.0) * 0.5)
    }

    fn contains(&self, _point: DVec3) -> bool {
        false
    }

    /// Zero, as for the plane.
    fn rounding(&self) -> f64 {
        0.0
    }
}
