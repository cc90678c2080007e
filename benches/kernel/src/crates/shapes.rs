//! Ray against triangle and ball in single precision, for crates that leave that to their users.

use durer_bench_kernel::meshes::Mesh;
use durer_bench_kernel::rays::Ray;
use glam::Vec3A;

/// What a tree is built over.
pub(crate) trait Shape: Copy {
    /// The least and the greatest coordinates.
    fn corners(&self) -> [Vec3A; 2];

    /// Where a ray meets it with 0 < t < `t_max`.
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32>;
}

/// A triangle as a corner and two edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    corner: Vec3A,
    edges: [Vec3A; 2],
}

/// All triangles of a mesh.
pub(crate) fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let triangle = |vertices: &[u32; 3]| {
        let [a, b, c] = vertices.map(|vertex| Vec3A::from(mesh.positions[vertex as usize]));
        Triangle { corner: a, edges: [b - a, c - a] }
    };
    mesh.triangles.iter().map(triangle).collect()
}

impl Shape for Triangle {
    fn corners(&self) -> [Vec3A; 2] {
        let (a, [b, c]) = (self.corner, self.edges.map(|edge| self.corner + edge));
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// Möller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
    #[inline]
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32> {
        let [along_u, along_v] = self.edges;
        let across = direction.cross(along_v);
        let inverse = 1.0 / along_u.dot(across);
        let from_corner = origin - self.corner;
        let u = from_corner.dot(across) * inverse;
        let other = from_corner.cross(along_u);
        let v = direction.dot(other) * inverse;
        let t = along_v.dot(other) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < t_max).then_some(t)
    }
}

/// A ball.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    center: Vec3A,
    radius: f32,
}

/// All balls.
pub(crate) fn balls(spheres: &[[f32; 4]]) -> Vec<Ball> {
    spheres.iter().map(|&[x, y, z, radius]| Ball { center: Vec3A::new(x, y, z), radius }).collect()
}

impl Shape for Ball {
    fn corners(&self) -> [Vec3A; 2] {
        [self.center - self.radius, self.center + self.radius]
    }

    /// From the ray's point nearest to the center, as `benches/embree` does it.
    #[inline]
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32> {
        let from_center = origin - self.center;
        let squared = direction.length_squared();
        let nearest = -from_center.dot(direction) / squared;
        let aside = from_center + direction * nearest;
        let discriminant = self.radius * self.radius - aside.length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let half = (discriminant / squared).sqrt();
        [nearest - half, nearest + half].into_iter().find(|&t| t > 0.0 && t < t_max)
    }
}

/// Origin and direction.
pub(crate) fn parts(ray: &Ray) -> [Vec3A; 2] {
    [ray.origin, ray.direction].map(Vec3A::from)
}
