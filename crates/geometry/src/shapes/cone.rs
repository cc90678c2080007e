//! The cone or frustum about the y axis, from its base at y = 0 to its top at y = 1; a lampshade if open.

use super::Shape;
use super::cylinder::first_of_side;
use super::span::{INSET, Span, into_cap};
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
        let (enter, exit) = if c <= 0.0 && w >= 0.0 && !(c == 0.0 && parallel && b == 0.0) {
            (f64::NEG_INFINITY, exit_from_inside(a, b, c, dw))
        } else {
            enter_from_outside(a, b, c, dw)?
        };
        Some(Span { enter, exit, enter_part: 0, exit_part: 0 })
    }

    /// The nearest point of the side, and the normal there; at an apex the normal is the axis.
    fn side_at(&self, p: DVec3) -> (DVec3, DVec3) {
        let k = self.slope();
        let r = (p.x * p.x + p.z * p.z).sqrt();
        let beyond = (r - self.radius_at(p.y)) / (1.0 + k * k);
        let y = (p.y + k * beyond).clamp(1.0 - INSET, INSET);
        if r == 0.0 {
            let (tip, up) = if k < 0.0 { (1.0, 1.0) } else { (0.0, -1.0) };
            return (DVec3::new(0.0, tip, 0.0), DVec3::new(0.0, up, 0.0));
        }
        let (x, z) = (p.x / r, p.z / r);
        let w = self.radius_at(y);
        (DVec3::new(x * w, y, z * w), DVec3::new(x, -k, z))
    }
}

/// Where a ray that starts in the cone leaves it. The discriminant may be below 0 by rounding only.
#[inline]
fn exit_from_inside(a: f64, b: f64, c: f64, dw: f64) -> f64 {
    let widening = a <= 0.0 && dw >= 0.0;
    if b > 0.0 && !widening {
        -c / (b + (b * b - a * c).max(0.0).sqrt())
    } else if a > 0.0 {
        ((b * b - a * c).max(0.0).sqrt() - b) / a
    } else {
        f64::INFINITY
    }
}

/// Where a ray that starts outside the cone, perhaps in the opposite one, enters and leaves it.
#[inline]
fn enter_from_outside(a: f64, b: f64, c: f64, dw: f64) -> Option<(f64, f64)> {
    let discriminant = b * b - a * c;
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
            let slab = Span::slab(near.origin.y, near.direction.y, HEIGHTS, (1, 2))?;
            self.endless(&near)?.and(slab).first()?
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

    /// With u = 2⁻⁵³: putting a point on the side leaves it within 5 u; x² + z² - w² is computed to 8 u times its
    /// radius, half of that in distance, and w itself to 2 u. Twice their sum.
    fn rounding(&self) -> f64 {
        11.0 * f64::EPSILON
    }
}
