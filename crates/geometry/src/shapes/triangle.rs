//! A single triangle, in world space.
//!
//! The test is that of Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: the triangle is
//! sheared so that the ray becomes the z axis, and the signs of three edge functions decide. Triangles that share an
//! edge compute the same number for it but for its sign, so no ray passes between them. The paper computes an edge
//! function of 0 again in higher precision; here that is not needed: of two products, rounding may make the larger and
//! the smaller equal but never change their order, so a sign is right or the number is 0, and 0 counts as inside.
//!
//! A triangle seen edge-on, or without area, has edge functions that are rounding and nothing else: it is not hit. Its
//! neighbors are, on the edges that they share.

use super::Shape;
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// A triangle with corners a, b, c and normal (b - a) × (c - a).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// The corners, in world space.
    pub(crate) vertices: [DVec3; 3],
    /// Texture coordinates at the corners.
    pub(crate) uvs: [DVec2; 3],
}

/// The sum of the edge functions, which is twice the area that is seen, must be more than this of the sum of the products
/// that they are differences of: many times what rounding leaves.
pub(crate) const LEAST_AREA: f64 = 1.0 / (1u64 << 46) as f64;

/// The axis along which a direction is longest.
#[inline(always)]
pub(crate) fn longest(direction: [f64; 3]) -> usize {
    let [x, y, z] = direction.map(f64::abs);
    if x > y && x > z {
        0
    } else if y > z {
        1
    } else {
        2
    }
}

impl Triangle {
    /// The weights of b and c at the point of the triangle's plane nearest to `point`.
    pub(crate) fn weights(&self, point: DVec3) -> (f64, f64) {
        let [a, b, c] = self.vertices;
        let (ab, ac, ap) = (b - a, c - a, point - a);
        let normal = ab.cross(ac);
        let scale = 1.0 / normal.length_squared();
        (ap.cross(ac).dot(normal) * scale, ab.cross(ap).dot(normal) * scale)
    }
}

impl Shape for Triangle {
    fn bounds(&self) -> Bounds {
        Bounds::of_points(self.vertices)
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let z = longest(ray.direction.to_array());
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inverse = 1.0 / ray.direction[z];
        let (shear_x, shear_y) = (ray.direction[x] * inverse, ray.direction[y] * inverse);
        // Each corner seen from the origin, sheared.
        let seen = |corner: DVec3| {
            let p = corner - ray.origin;
            (p[x] - shear_x * p[z], p[y] - shear_y * p[z], p[z])
        };
        let [(ax, ay, az), (bx, by, bz), (cx, cy, cz)] = self.vertices.map(seen);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let products =
            (cx * by).abs() + (cy * bx).abs() + (ax * cy).abs() + (ay * cx).abs() + (bx * ay).abs() + (by * ax).abs();
        let area = u + v + w;
        let t = (u * az + v * bz + w * cz) / area * inverse;
        (area.abs() > products * LEAST_AREA && t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        let [a, b, c] = self.vertices;
        let (ab, ac) = (b - a, c - a);
        let (v, w) = self.weights(point);
        (a + ab * v + ac * w, ab.cross(ac).normalize())
    }

    fn uv(&self, point: DVec3, _part: u32) -> DVec2 {
        let (v, w) = self.weights(point);
        self.uvs[0] * (1.0 - v - w) + self.uvs[1] * v + self.uvs[2] * w
    }

    fn contains(&self, _point: DVec3) -> bool {
        false
    }

    /// Coordinates are rounded with their own size; edge functions with the square of the longest edge, which tilts the
    /// plane that the test sees by the ratio of that square to the area. For slivers the latter counts; beyond some
    /// ratio a triangle is as good as none.
    fn rounding(&self, _part: u32) -> f64 {
        let [a, b, c] = self.vertices;
        let size = self.vertices.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
        let edge2 = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
        let twice_area = (b - a).cross(c - a).length();
        let slenderness = (edge2 / twice_area).min(1e8);
        8.0 * f64::EPSILON * (size + edge2.sqrt() * slenderness)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Known, Random};
    use super::*;

    fn of(vertices: [DVec3; 3]) -> Triangle {
        Triangle { vertices, uvs: [DVec2::new(1.0, 2.0), DVec2::new(3.0, 2.0), DVec2::new(1.0, 6.0)] }
    }

    #[test]
    fn keeps_the_laws() {
        for vertices in [
            [DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.01, 0.27, 0.97), DVec3::new(1.0, 0.0, -0.5)],
            [DVec3::ZERO, DVec3::X * 0.97, DVec3::Y * 0.93],
            [DVec3::new(0.9, -0.9, 0.9), DVec3::new(-0.8, 0.9, 1.0), DVec3::new(0.1, 0.2, -1.0)],
        ] {
            let [a, b, c] = vertices;
            let n = (b - a).cross(c - a).normalize();
            let level = |p: DVec3| (p - a).dot(n);
            let within = |p: DVec3| {
                let right_of = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(n) > 0.0;
                right_of(a, b) && right_of(b, c) && right_of(c, a)
            };
            let known = Known { shape: &of(vertices), levels: &[&level] };
            known.hits_obey_the_equation();
            known.crossings_match_sampling(&level, false, within);
            known.leaves_and_enters_once(false);
        }
    }

    #[test]
    fn no_ray_passes_between_neighbors() {
        let mut random = Random(14);
        for i in 0..100_000 {
            let scale = random.power(-3.0, 3.0);
            let shift = random.in_cube() * if i % 2 == 0 { 0.0 } else { 1e3 };
            let mut corner = || random.in_cube() * scale + shift;
            let (a, b, c) = (corner(), corner(), corner());
            let origin = corner();
            let on_edge = a + (b - a) * random.between(0.01, 0.99);
            // Across the edge from c, wherever off the plane.
            let d = on_edge + (on_edge - c) * random.between(0.1, 1.0) + random.in_cube() * (0.01 * scale);
            let ray = Ray { origin, direction: on_edge - origin };
            let hits = [[a, b, c], [b, a, d]].map(|v| of(v).intersect(&ray, f64::INFINITY).is_some());
            // Seen from the side, both may lie on the same side of the edge; then the ray passes by on the other.
            let view = (b - a).cross(ray.direction);
            if view.dot(c - a) * view.dot(d - a) < 0.0 {
                assert!(hits[0] || hits[1], "{ray:?} passes between {c} and {d} through the edge from {a} to {b}");
            }
        }
    }

    #[test]
    fn slivers_far_away_do_not_hit_themselves() {
        let mut random = Random(15);
        let mut tried = 0;
        for _ in 0..20_000 {
            let thin = random.power(-6.0, 0.0);
            let shift = random.in_cube() * random.power(-2.0, 4.0);
            let (a, ab) = (random.in_cube() + shift, random.direction());
            let triangle = of([a, a + ab, a + ab * random.between(0.0, 1.0) + random.direction() * thin]);
            let [a, b, c] = triangle.vertices;
            let (v, w) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            let inside = a + (b - a) * (v * (1.0 - w)) + (c - a) * w;
            let (p, n) = triangle.surface(inside, 0);
            let n = n.normalize();
            for cosine in [random.power(-9.0, 0.0), random.between(0.0, 1.0)] {
                let u = random.direction();
                let out = n * cosine + (u - n * u.dot(n)).normalize() * (1.0 - cosine * cosine).sqrt();
                for side in [1.0, -1.0] {
                    let ray = Ray { origin: p + n * (side * triangle.rounding(0)), direction: out * side };
                    assert_eq!(triangle.intersect(&ray, f64::INFINITY), None, "{ray:?} left {triangle:?}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 1_000);
    }

    #[test]
    fn degenerate_triangles_and_edge_on_rays_miss() {
        let line = of([DVec3::ZERO, DVec3::X, DVec3::X * 2.0]);
        let flat = of([DVec3::ZERO, DVec3::X, DVec3::Y]);
        let down = Ray { origin: DVec3::new(0.5, 1.0, 0.0), direction: DVec3::NEG_Y };
        assert_eq!(line.intersect(&down, f64::INFINITY), None);
        assert_eq!(flat.intersect(&down, f64::INFINITY), None);
        assert!(line.rounding(0).is_finite());
    }

    #[test]
    fn texture_coordinates_follow_the_corners() {
        let triangle = of([DVec3::ZERO, DVec3::X * 2.0, DVec3::Z * 2.0]);
        assert_eq!(triangle.uv(DVec3::ZERO, 0), DVec2::new(1.0, 2.0));
        assert_eq!(triangle.uv(DVec3::new(1.0, 0.0, 0.5), 0), DVec2::new(2.0, 3.0));
        assert_eq!(triangle.surface(DVec3::new(1.0, 1e-9, 0.5), 0), (DVec3::new(1.0, 0.0, 0.5), DVec3::Y * -1.0));
    }
}
