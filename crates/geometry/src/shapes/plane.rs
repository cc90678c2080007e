//! The plane y = 0. Its outside is above; rays hit it from both sides.

use super::Shape;
use super::span::{Span, plane_along};
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// The plane y = 0 with normal +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane;

/// The parameter at which a ray meets the plane y = 0, if 0 < t < `t_max`. Its sign is exact: that of a quotient.
#[inline]
pub(super) fn meet(ray: &Ray, t_max: f64) -> Option<f64> {
    let t = -ray.origin.y / ray.direction.y;
    (t > 0.0 && t < t_max).then_some(t)
}

impl Shape for Plane {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        meet(ray, t_max).map(|t| Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        (DVec3::new(point.x, 0.0, point.z), DVec3::Y)
    }

    /// The point's own x and z.
    fn uv(&self, point: DVec3, _part: u32) -> DVec2 {
        DVec2::new(point.x, point.z)
    }

    /// The half-space below.
    fn contains(&self, point: DVec3) -> bool {
        point.y < 0.0
    }

    /// The half-space is a span without one of its ends.
    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        let (y, rate) = (ray.origin.y, ray.direction.y);
        if rate == 0.0 {
            return y < 0.0;
        }
        let t = -y / rate;
        let (enter, exit) = if rate < 0.0 { (t, f64::INFINITY) } else { (f64::NEG_INFINITY, t) };
        Span { enter, exit, enter_part: 0, exit_part: 0 }.ends(visit)
    }

    fn face_along(&self, ray: &Ray, range: (f64, f64), width: f64) -> Option<DVec3> {
        plane_along(ray.origin.y, ray.direction.y, (0.0, 0.0), range, width).map(|_| DVec3::Y)
    }

    /// Zero: a point on it has y = 0 exactly, and that is what `intersect` looks at.
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
        let known = Known { shape: &Plane, levels: &[&|p| p.y] };
        known.hits_obey_the_equation();
        known.crossings_match_sampling(&|p| p.y, true, |_| true);
        known.leaves_and_enters_once(false);
        known.crossings_are_those_found_one_by_one();
    }

    #[test]
    fn parallel_rays_miss() {
        for y in [0.0, -0.0, 1e-300, 1.0, -1.0] {
            let ray = Ray { origin: DVec3::new(0.0, y, 0.0), direction: DVec3::new(1.0, 0.0, -1.0) };
            assert_eq!(Plane.intersect(&ray, f64::INFINITY), None);
        }
    }

    #[test]
    fn texture_coordinates_are_those_of_the_point() {
        assert_eq!(Plane.uv(DVec3::new(3.5, 0.0, -2.0), 0), DVec2::new(3.5, -2.0));
    }
}
