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
        for inner_radius in [0.0, 0.5, 0.9] {
            let known = Known { shape: &Disc { inner_radius }, levels: &[&|p| p.y] };
            known.hits_obey_the_equation();
            known.crossings_match_sampling(&|p| p.y, false, |p| {
                let r = (p.x * p.x + p.z * p.z).sqrt();
                r < 1.0 && r >= inner_radius
            });
            known.leaves_and_enters_once(false);
        }
    }

    #[test]
    fn the_edges_belong_to_it() {
        let down = |x, inner_radius| {
            let ray = Ray { origin: DVec3::new(x, 1.0, 0.0), direction: DVec3::NEG_Y };
            Disc { inner_radius }.intersect(&ray, 100.0).map(|hit| hit.t)
        };
        assert_eq!((down(1.0, 0.5), down(0.5, 0.5), down(0.0, 0.0)), (Some(1.0), Some(1.0), Some(1.0)));
        assert_eq!((down(1.000_001, 0.5), down(0.499_999, 0.5)), (None, None));
    }

    #[test]
    fn texture_coordinates_span_the_square_around_it() {
        let at = |x, z| Disc { inner_radius: 0.25 }.uv(DVec3::new(x, 0.0, z), 0);
        assert_eq!((at(-1.0, 0.0), at(0.0, 1.0)), (DVec2::new(0.0, 0.5), DVec2::new(0.5, 1.0)));
    }
}
