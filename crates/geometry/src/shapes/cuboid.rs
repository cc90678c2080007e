//! The cube from -1 to 1; under a transform, any box.

use super::Shape;
use super::span::{INSET, Span, plane_along};
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// The points with all coordinates in [-1, 1]. Parts 0 to 5 are the faces -x, +x, -y, +y, -z, +z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cuboid;

const RANGE: (f64, f64) = (-1.0, 1.0);

/// The piece of the ray inside; `None` if it lies behind or the ray misses.
#[inline]
fn span(ray: &Ray) -> Option<Span> {
    let (o, d) = (ray.origin, ray.direction);
    let x = Span::slab(o.x, d.x, RANGE, (0, 1))?;
    let y = Span::slab(o.y, d.y, RANGE, (2, 3))?;
    let z = Span::slab(o.z, d.z, RANGE, (4, 5))?;
    Some(x.and(y).and(z))
}

impl Shape for Cuboid {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        span(ray)?.first().filter(|hit| hit.t < t_max)
    }

    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        let axis = (part / 2) as usize;
        let side = if part.is_multiple_of(2) { -1.0 } else { 1.0 };
        let mut snapped = point.clamp(DVec3::splat(-INSET), DVec3::splat(INSET));
        let mut normal = DVec3::ZERO;
        snapped[axis] = side;
        normal[axis] = side;
        (snapped, normal)
    }

    /// Each face is the square from (0, 0) to (1, 1), not mirrored when seen from outside. On the four sides v points
    /// along +y, so an image stands upright; on top v points along -z and on the bottom along +z, as if folded up and
    /// down from the +z face.
    fn uv(&self, p: DVec3, part: u32) -> DVec2 {
        let (u, v) = match part {
            0 => (p.z, p.y),
            1 => (-p.z, p.y),
            2 => (p.x, p.z),
            3 => (p.x, -p.z),
            4 => (-p.x, p.y),
            _ => (p.x, p.y),
        };
        DVec2::new((u + 1.0) * 0.5, (v + 1.0) * 0.5)
    }

    fn contains(&self, point: DVec3) -> bool {
        point.abs().max_element() < 1.0
    }

    fn part_count(&self) -> u32 {
        6
    }

    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        span(ray).is_some_and(|span| span.ends(visit))
    }

    fn face_along(&self, ray: &Ray, range: (f64, f64), width: f64) -> Option<DVec3> {
        let (o, d) = (ray.origin, ray.direction);
        (0..3).find_map(|axis| plane_along(o[axis], d[axis], RANGE, range, width).map(|side| DVec3::AXES[axis] * side))
    }

    /// Zero: on a face the coordinate is ±1 exactly, and the sign of its difference from ±1 is what decides.
    fn rounding(&self, _part: u32) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Known;
    use super::*;

    const KNOWN: Known<'_> = Known {
        shape: &Cuboid,
        levels: &[&|p| -1.0 - p.x, &|p| p.x - 1.0, &|p| -1.0 - p.y, &|p| p.y - 1.0, &|p| -1.0 - p.z, &|p| p.z - 1.0],
    };

    #[test]
    fn keeps_the_laws() {
        KNOWN.hits_obey_the_equation();
        KNOWN.crossings_match_sampling(&|p| p.abs().max_element() - 1.0, true, |_| true);
        KNOWN.leaves_and_enters_once(true);
        KNOWN.crossings_are_those_found_one_by_one();
        KNOWN.far_rays_are_precise(true);
    }

    #[test]
    fn edges_and_corners_have_no_gap() {
        let mut rim = Vec::new();
        for i in 0..27 {
            let p = DVec3::new((i % 3) as f64 - 1.0, (i / 3 % 3) as f64 - 1.0, (i / 9) as f64 - 1.0);
            if p.length_squared() > 1.5 {
                rim.push(p);
            }
        }
        assert_eq!(rim.len(), 12 + 8);
        KNOWN.rims_have_no_gap(&rim);
    }

    #[test]
    fn rays_that_start_on_a_face() {
        let from = |direction| Cuboid.intersect(&Ray { origin: DVec3::new(1.0, 0.25, 0.5), direction }, 100.0);
        assert_eq!(from(DVec3::X), None);
        assert_eq!(from(DVec3::Y), None);
        assert_eq!(from(DVec3::new(1e-9, -1.0, 1.0)), None);
        assert_eq!(from(DVec3::NEG_X), Some(Crossing { t: 2.0, part: 0 }));
        assert_eq!(from(DVec3::new(-1e-9, 1.0, 0.0)), Some(Crossing { t: 0.75, part: 3 }));
    }

    #[test]
    fn texture_coordinates() {
        // The corner of each face that is left and below, seen from outside.
        let corners = [(-1., -1., -1.), (1., -1., 1.), (-1., -1., -1.), (-1., 1., 1.), (1., -1., -1.), (-1., -1., 1.)];
        for (part, (x, y, z)) in corners.into_iter().enumerate() {
            assert_eq!(Cuboid.uv(DVec3::new(x, y, z), part as u32), DVec2::ZERO, "face {part}");
            let mut p = DVec3::splat(0.5);
            p[part / 2] = if part.is_multiple_of(2) { -1.0 } else { 1.0 };
            let (_, n) = Cuboid.surface(p, part as u32);
            let step = |d: DVec3| Cuboid.uv(p + d * 0.5, part as u32) - Cuboid.uv(p, part as u32);
            let up = if part / 2 == 1 { DVec3::Z * -n.y } else { DVec3::Y };
            assert_eq!(step(up), DVec2::new(0.0, 0.25), "face {part}");
            assert_eq!(step(up.cross(n)), DVec2::new(0.25, 0.0), "face {part}");
        }
    }
}
