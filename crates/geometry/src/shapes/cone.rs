//! The cone or frustum about the y axis, from its base at y = 0 to its top at y = 1; a lampshade if open.

use super::Shape;
use super::cylinder::first_of_side;
use super::span::{INSET, Span, into_cap, plane_along};
use super::sphere::longitude;
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// x² + z² ≤ w² and 0 ≤ y ≤ 1, with w = `base_radius` + (`top_radius` - `base_radius`) y. Part 0 is the side, 1 the cap
/// at the base, 2 the cap on top.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    /// Radius at y = 0. The larger of the two radii is 1, the other in [0, 1].
    pub(crate) base_radius: f64,
    /// Radius at y = 1.
    pub(crate) top_radius: f64,
    /// Without caps: only the side is there, and rays meet it from both sides.
    pub(crate) open: bool,
}

const HEIGHTS: (f64, f64) = (0.0, 1.0);

/// Beyond this distance from the middle, squared, a ray's origin is moved nearer before coefficients are formed.
const FAR_SQUARED: f64 = 64.0;

/// Square of the radius of a sphere around every cone's middle: 1² + (1/2)², and some slack.
const REACH_SQUARED: f64 = 1.26;

/// The same ray with its origin near the shape but still before it, and the parameter of the new origin: coefficients
/// of the quadratic then are of the order of 1, and little cancels in its discriminant. `None` if the ray misses the
/// sphere around the shape. Most rays start near enough and are not touched.
#[inline]
fn brought_near(ray: &Ray) -> Option<(Ray, f64)> {
    let from_middle = ray.origin - DVec3::new(0.0, 0.5, 0.0);
    if from_middle.length_squared() <= FAR_SQUARED {
        return Some((*ray, 0.0));
    }
    let d = ray.direction;
    let to_nearest = -from_middle.dot(d) / d.length_squared();
    if to_nearest <= 0.0 || (from_middle + d * to_nearest).length_squared() > REACH_SQUARED {
        return None;
    }
    // Back from the nearest point by 1.5 to 2.6 units of length: out of the sphere around the shape.
    let t = to_nearest - 1.5 / d.abs().max_element();
    Some((Ray { origin: ray.origin + d * t, direction: d }, t))
}

impl Cone {
    fn slope(&self) -> f64 {
        self.top_radius - self.base_radius
    }

    /// The signed radius w at height `y`; negative beyond the apex.
    fn radius_at(&self, y: f64) -> f64 {
        self.base_radius + self.slope() * y
    }

    /// The ray's span in the endless single cone x² + z² ≤ w², w ≥ 0, which is convex; `None` if it misses or leaves it
    /// behind. Along the ray x² + z² - w² is a t² + 2 b t + c.
    ///
    /// If a > 0 the ray is flatter than the cone and the span lies between the two roots. If a < 0 it is steeper: each
    /// of the two opposite cones has one of the roots, and the span is endless on one side. If a is 0 but for rounding,
    /// one root is at infinity.
    #[inline]
    fn endless(&self, ray: &Ray) -> Option<Span> {
        let (ox, oz, dx, dz) = (ray.origin.x, ray.origin.z, ray.direction.x, ray.direction.z);
        let w = self.radius_at(ray.origin.y);
        let dw = self.slope() * ray.direction.y;
        let (dr2, dw2) = (dx * dx + dz * dz, dw * dw);
        let b = ox * dx + oz * dz - w * dw;
        let c = ox * ox + oz * oz - w * w;
        let parallel = (dr2 - dw2).abs() <= 4.0 * f64::EPSILON * (dr2 + dw2);
        let a = if parallel { 0.0 } else { dr2 - dw2 };
        // b² - a c, of whose terms the large ones cancel here before they are formed, near the apex too.
        let (mx, mz, my) = (ox * dw - w * dx, oz * dw - w * dz, ox * dz - oz * dx);
        let along = Quadratic { a, b, c, discriminant: mx * mx + mz * mz - my * my };
        let (enter, exit) = if c <= 0.0 && w >= 0.0 && !(c == 0.0 && parallel && b == 0.0) {
            (f64::NEG_INFINITY, along.exit_from_inside(dw))
        } else {
            along.enter_from_outside(dw)?
        };
        Some(Span { enter, exit, enter_part: 0, exit_part: 0 })
    }

    /// The piece inside the closed cone of a ray that was brought near; `None` if it lies behind or the ray misses.
    #[inline]
    fn closed(&self, near: &Ray) -> Option<Span> {
        let slab = Span::slab(near.origin.y, near.direction.y, HEIGHTS, (1, 2))?;
        Some(self.endless(near)?.and(slab))
    }

    /// How far outside the endless side a point is, for points near it.
    fn height_above_side(&self, p: DVec3) -> f64 {
        let k = self.slope();
        ((p.x * p.x + p.z * p.z).sqrt() - self.radius_at(p.y)) / (1.0 + k * k).sqrt()
    }

    /// The nearest point of the side, and the normal there; at an apex the normal is the axis.
    fn side_at(&self, p: DVec3) -> (DVec3, DVec3) {
        let k = self.slope();
        let r = (p.x * p.x + p.z * p.z).sqrt();
        let beyond = (r - self.radius_at(p.y)) / (1.0 + k * k);
        let y = (p.y + k * beyond).clamp(1.0 - INSET, INSET);
        if r == 0.0 && self.base_radius * self.top_radius == 0.0 {
            let (tip, up) = if k < 0.0 { (1.0, 1.0) } else { (0.0, -1.0) };
            return (DVec3::new(0.0, tip, 0.0), DVec3::new(0.0, up, 0.0));
        }
        let (x, z) = if r > 0.0 { (p.x / r, p.z / r) } else { (1.0, 0.0) };
        let w = self.radius_at(y);
        (DVec3::new(x * w, y, z * w), DVec3::new(x, -k, z).normalize())
    }
}

/// a t² + 2 b t + c, below 0 in the cone and its opposite, and b² - a c.
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
    discriminant: f64,
}

impl Quadratic {
    /// Where a ray that starts in the cone leaves it; w changes by `dw` along it. Below 0 the discriminant can be by
    /// rounding only.
    #[inline]
    fn exit_from_inside(&self, dw: f64) -> f64 {
        let root = self.discriminant.max(0.0).sqrt();
        let widening = self.a <= 0.0 && dw >= 0.0;
        if self.b > 0.0 && !widening {
            -self.c / (self.b + root)
        } else if self.a > 0.0 {
            (root - self.b) / self.a
        } else {
            f64::INFINITY
        }
    }

    /// Where a ray that starts outside the cone, perhaps in the opposite one, enters and leaves it.
    #[inline]
    fn enter_from_outside(&self, dw: f64) -> Option<(f64, f64)> {
        let Quadratic { a, b, c, discriminant } = *self;
        let approaching = c > 0.0 && b < 0.0;
        if a >= 0.0 {
            // c ≤ 0 is the opposite cone, which a ray this flat does not leave for ours.
            if !approaching || discriminant < 0.0 {
                return None;
            }
            let q = discriminant.sqrt() - b;
            return Some((c / q, if a > 0.0 { q / a } else { f64::INFINITY }));
        }
        if dw <= 0.0 {
            return None;
        }
        let root = discriminant.max(0.0).sqrt();
        Some((if approaching { c / (root - b) } else { (b + root) / -a }, f64::INFINITY))
    }
}

impl Shape for Cone {
    fn bounds(&self) -> Bounds {
        Bounds { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::ONE }
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let (near, skipped) = brought_near(ray)?;
        let hit = if self.open {
            first_of_side(&near, self.endless(&near)?, HEIGHTS)?
        } else {
            self.closed(&near)?.first()?
        };
        let t = hit.t + skipped;
        (t < t_max).then_some(Crossing { t, part: hit.part })
    }

    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        match part {
            0 => self.side_at(point),
            1 => (into_cap(point, 0.0, self.base_radius), DVec3::NEG_Y),
            _ => (into_cap(point, 1.0, self.top_radius), DVec3::Y),
        }
    }

    /// On the side longitude, and height from 0 to 1; on the caps the square around the unit circle, in x and z.
    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        match part {
            0 => DVec2::new(longitude(point), point.y),
            _ => DVec2::new((point.x + 1.0) * 0.5, (point.z + 1.0) * 0.5),
        }
    }

    fn contains(&self, p: DVec3) -> bool {
        let w = self.radius_at(p.y);
        !self.open && p.y > 0.0 && p.y < 1.0 && p.x * p.x + p.z * p.z < w * w
    }

    fn part_count(&self) -> u32 {
        3
    }

    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        let Some((near, skipped)) = brought_near(ray) else { return false };
        let mut visit = |hit: Crossing| visit(Crossing { t: hit.t + skipped, part: hit.part });
        !self.open && self.closed(&near).is_some_and(|span| span.ends(&mut visit))
    }

    /// A ray lies in the side if it does at both ends and in the middle, for what it is above it is a hyperbola.
    fn face_along(&self, ray: &Ray, range: (f64, f64), width: f64) -> Option<DVec3> {
        let (y, rate) = (ray.origin.y, ray.direction.y);
        let cap = plane_along(y, rate, HEIGHTS, range, width).map(|side| DVec3::Y * side);
        cap.or_else(|| {
            // Beyond the tip the generator goes on in the opposite cone.
            let slab = Span::slab(y, rate, HEIGHTS, (1, 2))?;
            let (from, to) = (slab.enter.max(range.0), slab.exit.min(range.1));
            let points = [from, 0.5 * (from + to), to].map(|t| ray.at(t));
            let along = from < to && points.iter().all(|&p| self.height_above_side(p).abs() <= width);
            along.then(|| self.side_at(points[1]).1)
        })
    }

    /// With u = 2⁻⁵³: putting a point on the side leaves it within 5 u; x² + z² - w² is computed to 8 u times its
    /// radius, half of that in distance, and w itself to 2 u. Twice their sum.
    fn rounding(&self, _part: u32) -> f64 {
        11.0 * f64::EPSILON
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Known;
    use super::*;

    /// Full and cut cones both ways up, one all but a cylinder, and the cylinder.
    const RADII: [(f64, f64); 7] =
        [(1.0, 0.0), (0.0, 1.0), (1.0, 0.5), (0.25, 1.0), (1.0, 1e-9), (1.0, 0.999_999_9), (1.0, 1.0)];

    fn side(p: DVec3, (base, top): (f64, f64)) -> f64 {
        let k = top - base;
        ((p.x * p.x + p.z * p.z).sqrt() - base - k * p.y) / (1.0 + k * k).sqrt()
    }

    /// Calls `check` with the cone of each pair of radii, and its side's level.
    fn each(open: bool, check: impl Fn(&Cone, &dyn Fn(DVec3) -> f64)) {
        for radii in RADII {
            check(&Cone { base_radius: radii.0, top_radius: radii.1, open }, &|p| side(p, radii));
        }
    }

    #[test]
    fn closed_keeps_the_laws() {
        each(false, |cone, level| {
            let known = Known { shape: cone, levels: &[level, &|p| -p.y, &|p| p.y - 1.0] };
            known.hits_obey_the_equation();
            known.crossings_match_sampling(&|p| level(p).max(-p.y).max(p.y - 1.0), true, |_| true);
            known.leaves_and_enters_once(true);
            known.crossings_are_those_found_one_by_one();
            known.far_rays_are_precise(true);
        });
    }

    #[test]
    fn open_keeps_the_laws() {
        each(true, |cone, level| {
            let known = Known { shape: cone, levels: &[level] };
            known.hits_obey_the_equation();
            known.crossings_match_sampling(level, false, |p| p.y > 0.0 && p.y < 1.0);
        });
    }

    #[test]
    fn rims_and_tips_have_no_gap() {
        let ring = [(1., 0.), (0., 1.), (-1., 0.), (0., -1.), (0.6, 0.8), (-0.8, 0.6), (0.28, -0.96)];
        each(false, |cone, level| {
            let rim: Vec<_> = ring
                .iter()
                .flat_map(|&(x, z)| {
                    [(0.0, cone.base_radius), (1.0, cone.top_radius)].map(|(y, r)| DVec3::new(x * r, y, z * r))
                })
                .collect();
            let known = Known { shape: cone, levels: &[level, &|p| -p.y, &|p| p.y - 1.0] };
            known.rims_have_no_gap(&rim);
        });
    }

    #[test]
    fn along_generator_and_axis() {
        let cone = |open| Cone { base_radius: 1.0, top_radius: 0.0, open };
        let hit = |open, origin, direction| cone(open).intersect(&Ray { origin, direction }, f64::INFINITY);
        let tip = hit(false, DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y).expect("the tip");
        assert_eq!(tip, Crossing { t: 2.0, part: 0 });
        assert_eq!(cone(false).surface(DVec3::Y, tip.part), (DVec3::Y, DVec3::Y));
        assert_eq!(hit(false, DVec3::new(0.0, -1.0, 0.0), DVec3::Y), Some(Crossing { t: 1.0, part: 1 }));
        assert_eq!(hit(true, DVec3::new(0.0, -1.0, 0.0), DVec3::Y), Some(Crossing { t: 2.0, part: 0 }));
        // Parallel to the side from the tip to +x: in from the opposite side, out through the base.
        let along = DVec3::new(1.0, -1.0, 0.0);
        assert_eq!(hit(false, DVec3::new(-1.0, 1.0, 0.0), along), Some(Crossing { t: 0.5, part: 0 }));
        assert_eq!(hit(false, DVec3::new(0.25, 0.5, 0.0), along), Some(Crossing { t: 0.5, part: 1 }));
        assert_eq!(hit(true, DVec3::new(0.25, 0.5, 0.0), along), None);
        // Just above the side it misses, and through the opposite cone's inside likewise.
        assert_eq!(hit(false, DVec3::new(-0.5, 1.5 + 1e-9, 0.0), along), None);
        assert_eq!(hit(false, DVec3::new(-3.0, 1.5, 0.0), DVec3::X), None);
    }

    #[test]
    fn texture_coordinates() {
        let at = |x, y, z, part| Cone { base_radius: 1.0, top_radius: 0.5, open: false }.uv(DVec3::new(x, y, z), part);
        assert_eq!(at(1.0, 0.0, 0.0, 0), DVec2::new(0.5, 0.0));
        assert_eq!(at(0.0, 0.5, -0.75, 0), DVec2::new(0.25, 0.5));
        assert_eq!(at(-0.5, 1.0, 0.0, 2), DVec2::new(0.25, 0.5));
        assert_eq!(at(0.0, 0.0, 1.0, 1), DVec2::new(0.5, 1.0));
    }
}
