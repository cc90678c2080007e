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
        ((0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&z)).then_some(Crossing { t, part: 0 })
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
    fn rounding(&self, _part: u32) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Known;
    use super::*;

    #[test]
    fn keeps_the_laws() {
        let known = Known { shape: &Rectangle, levels: &[&|p| p.y] };
        known.hits_obey_the_equation();
        known.crossings_match_sampling(&|p| p.y, false, |p| p.x.min(p.z) > 0.0 && p.x.max(p.z) < 1.0);
        known.leaves_and_enters_once(false);
    }

    #[test]
    fn the_edges_belong_to_it() {
        let hit = |x, z| {
            let ray = Ray { origin: DVec3::new(x, -1.0, z), direction: DVec3::Y };
            Rectangle.intersect(&ray, 100.0).is_some()
        };
        assert!(hit(0.0, 0.0) && hit(1.0, 1.0) && hit(0.5, 1.0) && hit(0.0, 0.5));
        assert!(!hit(-1e-9, 0.5) && !hit(0.5, 1.000_001));
    }

    #[test]
    fn texture_coordinates_run_along_the_edges() {
        assert_eq!(Rectangle.uv(DVec3::new(0.25, 0.0, 0.75), 0), DVec2::new(0.25, 0.75));
    }
}
