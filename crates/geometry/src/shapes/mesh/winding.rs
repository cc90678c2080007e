//! How often a ray goes into a closed mesh and out of it, on edges and at corners, too.
//!
//! A ray through an edge meets both triangles there, one through a corner all around it. To count each passage once, the
//! ray is moved aside by less than any number, and the same way for all triangles ("simulation of simplicity",
//! Edelsbrunner and Mücke 1990): where an edge function is 0, the direction of the edge decides. All signs are exact for
//! the corners as they are seen from the ray, which are the same for all triangles that share them. So passages in and
//! out always add up, and their sum ahead of a point is the winding number around it.

use super::super::triangle::longest;
use crate::Ray;
use durer_math::DVec3;

/// A ray as edge functions see it: turned so that its longest coordinate is the last, and sheared to run along that.
pub(super) struct Line {
    axes: [usize; 3],
    origin: DVec3,
    shear: [f64; 2],
    inverse: f64,
}

impl Line {
    pub(super) fn new(ray: &Ray) -> Line {
        let z = longest(ray.direction.to_array());
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inverse = 1.0 / ray.direction[z];
        let shear = [ray.direction[x] * inverse, ray.direction[y] * inverse];
        Line { axes: [x, y, z], origin: ray.origin, shear, inverse }
    }

    /// Where the ray, moved aside, passes through a triangle, and whether it does so from behind.
    pub(super) fn passage(&self, corners: [DVec3; 3]) -> Option<(f64, bool)> {
        let [x, y, z] = self.axes;
        let seen = |corner: DVec3| {
            let p = corner - self.origin;
            ([p[x] - self.shear[0] * p[z], p[y] - self.shear[1] * p[z]], p[z])
        };
        let [(a, az), (b, bz), (c, cz)] = corners.map(seen);
        let of_edges = [side(a, b), side(b, c), side(c, a)];
        if of_edges != [1; 3] && of_edges != [-1; 3] {
            return None;
        }
        let (u, v, w) = (cross(b, c).abs(), cross(c, a).abs(), cross(a, b).abs());
        let area = u + v + w;
        let depth = if area > 0.0 { (u * az + v * bz + w * cz) / area } else { az };
        Some((depth * self.inverse, (of_edges[0] > 0) == (self.inverse > 0.0)))
    }
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// On which side of the edge from `a` to `b` the origin lies, once it is moved a little along x and much less along y: 1 if
/// on its left, -1 if on its right, 0 if the edge has no length.
fn side(a: [f64; 2], b: [f64; 2]) -> i32 {
    let (first, second) = (a[0] * b[1], a[1] * b[0]);
    let by = |difference: f64| i32::from(difference > 0.0) - i32::from(difference < 0.0);
    let exact = match by(first - second) {
        0 => by(rounded_off(a[0], b[1], first) - rounded_off(a[1], b[0], second)),
        sign => sign,
    };
    match (exact, by(b[1] - a[1])) {
        (0, 0) => by(b[0] - a[0]),
        (0, up) => -up,
        (sign, _) => sign,
    }
}

/// What a product lost by rounding, exactly (Dekker 1971).
fn rounded_off(a: f64, b: f64, product: f64) -> f64 {
    let split = |x: f64| {
        let shifted = x * 134_217_729.0;
        let high = shifted - (shifted - x);
        (high, x - high)
    };
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)
}
