//! The cylinder about the y axis with radius 1, from y = -1 to y = 1; a tube if open.

use super::Shape;
use super::span::{INSET, Span, into_cap, plane_along};
use super::sphere::longitude;
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// x² + z² ≤ 1 and -1 ≤ y ≤ 1. Part 0 is the side, 1 the cap at the bottom, 2 the cap on top.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cylinder {
    /// Without caps: only the side is there, and rays meet it from both sides.
    pub(crate) open: bool,
}

const HEIGHTS: (f64, f64) = (-1.0, 1.0);

/// The ray's span in the endless cylinder; `None` if it misses or leaves it behind. The quadratic as for the sphere,
/// but in the plane of x and z.
#[inline]
fn endless(ray: &Ray) -> Option<Span> {
    let (ox, oz, dx, dz) = (ray.origin.x, ray.origin.z, ray.direction.x, ray.direction.z);
    let b = ox * dx + oz * dz;
    let c = ox * ox + oz * oz - 1.0;
    let outside = c > 0.0;
    if outside && b >= 0.0 {
        return None;
    }
    let a = dx * dx + dz * dz;
    let span = |enter, exit| Some(Span { enter, exit, enter_part: 0, exit_part: 0 });
    if a == 0.0 {
        // Along the axis. A ray in the surface itself counts as outside.
        return if c < 0.0 { span(f64::NEG_INFINITY, f64::INFINITY) } else { None };
    }
    let back = b / a;
    let (nx, nz) = (ox - dx * back, oz - dz * back);
    let discriminant = a * (1.0 - (nx * nx + nz * nz));
    if outside {
        if discriminant < 0.0 {
            return None;
        }
        let q = discriminant.sqrt() - b;
        span(c / q, q / a)
    } else {
        let root = discriminant.max(0.0).sqrt();
        span(f64::NEG_INFINITY, if b > 0.0 { -c / (root + b) } else { (root - b) / a })
    }
}

/// The piece of the ray inside the closed cylinder; `None` if it lies behind or the ray misses.
#[inline]
fn closed(ray: &Ray) -> Option<Span> {
    let slab = Span::slab(ray.origin.y, ray.direction.y, HEIGHTS, (1, 2))?;
    Some(endless(ray)?.and(slab))
}

/// The first crossing with an endless surface, of those ahead that have their y between `low` and `high`.
#[inline]
pub(super) fn first_of_side(ray: &Ray, side: Span, (low, high): (f64, f64)) -> Option<Crossing> {
    let reached = |t: f64| {
        let y = ray.origin.y + t * ray.direction.y;
        t > 0.0 && y >= low && y <= high
    };
    [side.enter, side.exit].into_iter().find(|&t| reached(t)).map(|t| Crossing { t, part: 0 })
}

impl Shape for Cylinder {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let hit = if self.open { first_of_side(ray, endless(ray)?, HEIGHTS)? } else { closed(ray)?.first()? };
        (hit.t < t_max).then_some(hit)
    }

    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        match part {
            0 => {
                let from_axis = (point.x * point.x + point.z * point.z).sqrt();
                let scale = 1.0 / from_axis;
                // Thinner than the rounding where it lies, its axis may be hit.
                let normal = if from_axis > 0.0 { DVec3::new(point.x * scale, 0.0, point.z * scale) } else { DVec3::X };
                (DVec3::new(normal.x, point.y.clamp(-INSET, INSET), normal.z), normal)
            }
            1 => (into_cap(point, -1.0, 1.0), DVec3::NEG_Y),
            _ => (into_cap(point, 1.0, 1.0), DVec3::Y),
        }
    }

    /// On the side longitude, and height from 0 to 1; on the caps the square around the disc, in x and z.
    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        match part {
            0 => DVec2::new(longitude(point), (point.y + 1.0) * 0.5),
            _ => DVec2::new((point.x + 1.0) * 0.5, (point.z + 1.0) * 0.5),
        }
    }

    fn contains(&self, p: DVec3) -> bool {
        !self.open && p.x * p.x + p.z * p.z < 1.0 && p.y.abs() < 1.0
    }

    fn part_count(&self) -> u32 {
        3
    }

    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        !self.open && closed(ray).is_some_and(|span| span.ends(visit))
    }

    fn face_along(&self, ray: &Ray, range: (f64, f64), width: f64) -> Option<DVec3> {
        let cap = plane_along(ray.origin.y, ray.direction.y, HEIGHTS, range, width).map(|side| DVec3::Y * side);
        cap.or_else(|| {
            let [from, to] = [range.0, range.1].map(|t| ray.at(t) * DVec3::new(1.0, 0.0, 1.0));
            let along = (from.length() - 1.0).abs() <= width && (to - from).length() <= width;
            along.then(|| from.normalize())
        })
    }

    /// As for the sphere, whose reasoning holds for x and z alone.
    fn rounding(&self, _part: u32) -> f64 {
        11.0 * f64::EPSILON
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Known, Random};
    use super::*;

    const CLOSED: Known<'_> =
        Known { shape: &Cylinder { open: false }, levels: &[&side, &|p| -1.0 - p.y, &|p| p.y - 1.0] };
    const OPEN: Known<'_> = Known { shape: &Cylinder { open: true }, levels: &[&side] };

    fn side(p: DVec3) -> f64 {
        (p.x * p.x + p.z * p.z).sqrt() - 1.0
    }

    fn depth(p: DVec3) -> f64 {
        side(p).max(p.y.abs() - 1.0)
    }

    #[test]
    fn closed_keeps_the_laws() {
        CLOSED.hits_obey_the_equation();
        CLOSED.crossings_match_sampling(&depth, true, |_| true);
        CLOSED.leaves_and_enters_once(true);
        CLOSED.crossings_are_those_found_one_by_one();
        CLOSED.far_rays_are_precise(true);
    }

    #[test]
    fn open_keeps_the_laws() {
        OPEN.hits_obey_the_equation();
        OPEN.crossings_match_sampling(&side, false, |p| p.y.abs() < 1.0);
    }

    #[test]
    fn rims_have_no_gap() {
        let ring = [(1., 0.), (0., 1.), (-1., 0.), (0., -1.), (0.6, 0.8), (-0.8, 0.6), (0.28, -0.96)];
        let rim: Vec<_> = ring.iter().flat_map(|&(x, z)| [DVec3::new(x, 1.0, z), DVec3::new(x, -1.0, z)]).collect();
        CLOSED.rims_have_no_gap(&rim);
    }

    #[test]
    fn is_hit_from_afar_where_pythagoras_says() {
        let mut random = Random(12);
        for _ in 0..10_000 {
            let (distance, height) = (random.power(1.0, 8.0), random.between(-0.999, 0.999));
            let ray = Ray { origin: DVec3::new(-distance, -distance, height), direction: DVec3::new(1.0, 1.0, 0.0) };
            let hit = Cylinder { open: false }.intersect(&ray, f64::INFINITY).expect("aimed at the inside");
            assert!((hit.t - (distance - (1.0 - height * height).sqrt())).abs() < 4e-16 * distance, "{ray:?}: {hit:?}");
        }
    }

    #[test]
    fn along_the_axis() {
        let down = |x: f64, y: f64| Ray { origin: DVec3::new(x, y, 0.0), direction: DVec3::new(0.0, -2.0, 0.0) };
        let closed = |x, y| Cylinder { open: false }.intersect(&down(x, y), 100.0);
        assert_eq!(closed(0.5, 3.0), Some(Crossing { t: 1.0, part: 2 }));
        assert_eq!(closed(-0.999, 0.0), Some(Crossing { t: 0.5, part: 1 }));
        assert_eq!(closed(1.0, 3.0), None, "in the side");
        assert_eq!(closed(0.0, -1.0), None, "starts on the cap");
        assert_eq!(Cylinder { open: true }.intersect(&down(0.5, 3.0), 100.0), None);
    }

    #[test]
    fn texture_coordinates() {
        let at = |x, y, z, part| Cylinder { open: false }.uv(DVec3::new(x, y, z), part);
        assert_eq!(at(1.0, -1.0, 0.0, 0), DVec2::new(0.5, 0.0));
        assert_eq!(at(0.0, 0.5, -1.0, 0), DVec2::new(0.25, 0.75));
        assert_eq!(at(-1.0, 1.0, 0.0, 2), DVec2::new(0.0, 0.5));
        assert_eq!(at(0.0, -1.0, 1.0, 1), DVec2::new(0.5, 1.0));
    }
}
