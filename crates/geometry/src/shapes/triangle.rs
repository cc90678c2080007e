//! A single triangle, in world space.
//!
//! The test is that of Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: the triangle is
//! sheared so that the ray becomes the z axis, and the signs of three edge functions decide. Triangles that share an
//! edge compute the same number for it but for its sign, so no ray passes between them. The paper computes an edge
//! function of 0 again in higher precision; here that is not needed: of two products, rounding may make the larger and
//! the smaller equal but never change their order, so a sign is right or the number is 0, and 0 counts as inside.

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

/// The axes (x, y, z) with z the direction's longest.
#[inline]
fn axes_along(direction: DVec3) -> (usize, usize, usize) {
    let d = direction.abs();
    if d.x > d.y && d.x > d.z {
        (1, 2, 0)
    } else if d.y > d.z {
        (2, 0, 1)
    } else {
        (0, 1, 2)
    }
}

impl Triangle {
    /// The weights of b and c at the point of the triangle's plane nearest to `point`.
    fn weights(&self, point: DVec3) -> (f64, f64) {
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
        let (x, y, z) = axes_along(ray.direction);
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
        // The division is by zero if the ray lies in the triangle's plane; no comparison below then is true.
        let t = (u * az + v * bz + w * cz) / (u + v + w) * inverse;
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn surface(&self, point: DVec3, _part: u32) -> (DVec3, DVec3) {
        let [a, b, c] = self.vertices;
        let (ab, ac) = (b - a, c - a);
        let (v, w) = self.weights(point);
        (a + ab * v + ac * w, ab.cross(ac))
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
    fn rounding(&self) -> f64 {
        let [a, b, c] = self.vertices;
        let size = self.vertices.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
        let edge2 = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
        let twice_area = (b - a).cross(c - a).length();
        let slenderness = (edge2 / twice_area).min(1e8);
        8.0 * f64::EPSILON * (size + edge2.sqrt() * slenderness)
    }
}
