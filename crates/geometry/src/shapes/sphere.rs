//! The unit sphere.

use super::Shape;
use super::span::Span;
use crate::{Bounds, Crossing, Ray};
use durer_math::functions::{asin, atan2};
use durer_math::{DVec2, DVec3};
use std::f64::consts::PI;

/// The unit sphere around the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere;

/// The angle about the y axis as a texture coordinate from 0 to 1: 0 and 1 at -x, 1/4 at -z, 1/2 at +x, 3/4 at +z.
pub(super) fn longitude(point: DVec3) -> f64 {
    (atan2(point.z, point.x) + PI) / (2.0 * PI)
}

/// The direction from the middle to a point. Of a ball that is smaller than the rounding where it lies, a hit may be the
/// middle itself: then any direction is as good.
#[inline]
pub(super) fn outward(from_middle: DVec3) -> DVec3 {
    let length = from_middle.length();
    if length > 0.0 { from_middle / length } else { DVec3::Y }
}

/// |p|² - 1 along a ray, as a t² + 2 b t + c, and b² - a c.
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
    discriminant: f64,
}

/// The quadratic along a ray; `None` if the ray starts outside and goes away.
///
/// The sign of c says whether the ray starts inside, and with that which root is wanted; each root is taken in the form
/// that has no difference in it. The discriminant comes from the point of the ray nearest to the center, which does not
/// cancel for an origin far away: Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
/// ch. 7.
#[inline]
fn along(ray: &Ray) -> Option<Quadratic> {
    let (o, d) = (ray.origin, ray.direction);
    let b = o.dot(d);
    let c = o.length_squared() - 1.0;
    if c > 0.0 && b >= 0.0 {
        return None;
    }
    let a = d.length_squared();
    let nearest = o - d * (b / a);
    Some(Quadratic { a, b, c, discriminant: a * (1.0 - nearest.length_squared()) })
}

/// The piece of the ray inside. Its ends are those that `intersect` finds, bit for bit.
fn span(ray: &Ray) -> Option<Span> {
    let Quadratic { a, b, c, discriminant } = along(ray)?;
    let between = |enter, exit| Some(Span { enter, exit, enter_part: 0, exit_part: 0 });
    if c > 0.0 {
        if discriminant < 0.0 {
            return None;
        }
        let q = discriminant.sqrt() - b;
        return between(c / q, q / a);
    }
    let root = discriminant.max(0.0).sqrt();
    between(f64::NEG_INFINITY, if b > 0.0 { -c / (root + b) } else { (root - b) / a })
}

impl Shape for Sphere {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let Quadratic { a, b, c, discriminant } = along(ray)?;
        let t = if c > 0.0 {
            if discriminant < 0.0 {
                return None;
            }
            c / (discriminant.sqrt() - b)
        } else {
            let root = discriminant.max(0.0).sqrt();
            if b > 0.0 { -c / (root + b) } else { (root - b) / a }
        };
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        let snapped = outward(point);
        (snapped, snapped)
    }

    /// Longitude, and latitude from 0 at -y to 1 at +y.
    fn uv(&self, point: DVec3, _part: u32) -> DVec2 {
        let y = outward(point).y.clamp(-1.0, 1.0);
        DVec2::new(longitude(point), asin(y) / PI + 0.5)
    }

    fn contains(&self, point: DVec3) -> bool {
        point.length_squared() < 1.0
    }

    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        span(ray).is_some_and(|span| span.ends(visit))
    }

    /// With u = 2⁻⁵³: normalizing leaves |p| within 4 u of 1; o·o - 1 is computed to 4 u, or 2 u of distance; the point
    /// nearest to the center likewise to 5 u. Twice their sum.
    fn rounding(&self, _part: u32) -> f64 {
        11.0 * f64::EPSILON
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Known, Random};
    use super::*;

    const KNOWN: Known<'_> = Known { shape: &Sphere, levels: &[&depth] };

    fn depth(p: DVec3) -> f64 {
        p.length() - 1.0
    }

    /// Of things smaller than the rounding where they lie, the middle may be hit.
    #[test]
    fn middles_have_a_surface_of_some_direction() {
        use super::super::{cylinder::Cylinder, torus::Torus};
        let (ring, tube) = (Torus { tube_radius: 0.5 }, Cylinder { open: true });
        let shapes: [(&dyn Shape, DVec3); 5] = [
            (&Sphere, DVec3::ZERO),
            (&tube, DVec3::ZERO),
            (&tube, DVec3::Y * 0.3),
            (&ring, DVec3::ZERO),
            (&ring, DVec3::X),
        ];
        for (shape, middle) in shapes {
            let (point, normal) = shape.surface(middle, 0);
            assert!(point.is_finite() && (normal.length() - 1.0).abs() < 1e-15, "{point} {normal}");
            assert!(shape.uv(middle, 0).is_finite());
        }
    }

    #[test]
    fn keeps_the_laws() {
        KNOWN.hits_obey_the_equation();
        KNOWN.crossings_match_sampling(&depth, true, |_| true);
        KNOWN.leaves_and_enters_once(true);
        KNOWN.crossings_are_those_found_one_by_one();
        KNOWN.far_rays_are_precise(true);
    }

    #[test]
    fn is_hit_where_pythagoras_says() {
        let mut random = Random(11);
        for _ in 0..10_000 {
            let (distance, height) = (random.between(1.0, 1e4), random.between(-1.1, 1.1));
            let ray = Ray { origin: DVec3::new(height, 0.0, -distance), direction: DVec3::Z };
            let hit = Sphere.intersect(&ray, f64::INFINITY);
            let half_chord = (1.0 - height * height).sqrt();
            match hit {
                Some(hit) => assert!((hit.t - (distance - half_chord)).abs() < 4e-16 * distance, "{ray:?}: {hit:?}"),
                None => assert!(height.abs() > 1.0, "{ray:?}"),
            }
        }
    }

    #[test]
    fn texture_coordinates() {
        let at = |x, y, z| Sphere.uv(DVec3::new(x, y, z), 0);
        assert_eq!(at(1.0, 0.0, 0.0), DVec2::new(0.5, 0.5));
        assert_eq!(at(-1.0, 0.0, 0.0), DVec2::new(1.0, 0.5));
        assert_eq!(at(0.0, 0.0, -1.0), DVec2::new(0.25, 0.5));
        assert_eq!(at(0.0, 0.0, 1.0), DVec2::new(0.75, 0.5));
        assert_eq!((at(0.0, 1.0, 0.0).y, at(0.0, -1.0, 0.0).y), (1.0, 0.0));
    }
}
