//! The crate obvhs: its compressed tree of eight children a node. Shapes are put into the order of the leaves, as its
//! examples do; triangles are its own.

use crate::shapes::{self, Ball, Shape};
use durer_bench_kernel::measure::{self, Kernel};
use durer_bench_kernel::meshes::Mesh;
use durer_bench_kernel::print::Lines;
use durer_bench_kernel::rays::Ray;
use durer_bench_kernel::scene::{Scene, Things};
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::{build_cwbvh, build_cwbvh_from_tris};
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::ray::RayHit;
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use obvhs::{Boundable, BvhBuildParams};
use std::time::Duration;

/// Builds a scene with one of the crate's presets and measures it, if it is to be repeated at all.
pub(crate) fn measure(scene: &Scene, preset: &str, repeats: usize) -> Result<(), String> {
    let params = match preset {
        "fast" => BvhBuildParams::fast_build(),
        "medium" => BvhBuildParams::medium_build(),
        "very-slow" => BvhBuildParams::very_slow_build(),
        _ => return Err(format!("unknown preset `{preset}`: there are fast, medium and very-slow")),
    };
    let lines = Lines { program: "obvhs", variant: preset, scene: &scene.name };
    lines.scene(scene.count(), &scene.hashes());
    match &scene.things {
        Things::Triangles(mesh) => finish(lines, scene, repeats, || of_triangles(mesh, params)),
        Things::Spheres(spheres) => finish(lines, scene, repeats, || of_spheres(spheres, params)),
    }
    Ok(())
}

fn finish<S: Met>(lines: Lines<'_>, scene: &Scene, repeats: usize, make: impl Fn() -> Built<S>) {
    let (seconds, built) = measure::build(repeats, make);
    lines.build(seconds, built.memory(), 0);
    if repeats > 0 {
        measure::all(lines, scene, &built, repeats);
    }
}

fn of_triangles(mesh: &Mesh, params: BvhBuildParams) -> Built<RtTriangle> {
    let corner = |vertex: u32| Vec3A::from(mesh.positions[vertex as usize]);
    let triangle = |[a, b, c]: [u32; 3]| Triangle { v0: corner(a), v1: corner(b), v2: corner(c) };
    let triangles: Vec<Triangle> = mesh.triangles.iter().copied().map(triangle).collect();
    let tree = build_cwbvh_from_tris(&triangles, params, &mut Duration::default());
    Built::new(tree, |index| RtTriangle::from(&triangles[index]))
}

fn of_spheres(spheres: &[[f32; 4]], params: BvhBuildParams) -> Built<Ball> {
    let balls = shapes::balls(spheres);
    let tree = build_cwbvh(&balls, params, &mut Duration::default());
    Built::new(tree, |index| balls[index])
}

impl Boundable for Ball {
    fn aabb(&self) -> Aabb {
        let [min, max] = self.corners();
        Aabb::new(min, max)
    }
}

/// What this crate's rays can meet.
trait Met {
    /// Where; infinity for nowhere.
    fn met(&self, ray: &obvhs::ray::Ray) -> f32;
}

impl Met for RtTriangle {
    #[inline(always)]
    fn met(&self, ray: &obvhs::ray::Ray) -> f32 {
        self.intersect(ray)
    }
}

impl Met for Ball {
    #[inline(always)]
    fn met(&self, ray: &obvhs::ray::Ray) -> f32 {
        self.intersect(ray.origin, ray.direction, ray.tmax).unwrap_or(f32::INFINITY)
    }
}

/// A tree, and shapes in the order of its leaves.
struct Built<S> {
    tree: CwBvh,
    shapes: Vec<S>,
}

impl<S: Met> Built<S> {
    fn new(tree: CwBvh, shape: impl Fn(usize) -> S) -> Built<S> {
        let shapes = tree.primitive_indices.iter().map(|&index| shape(index as usize)).collect();
        Built { tree, shapes }
    }

    fn memory(&self) -> usize {
        self.tree.nodes.len() * size_of::<CwBvhNode>()
            + size_of_val(self.tree.primitive_indices.as_slice())
            + size_of_val(self.shapes.as_slice())
    }

    #[inline]
    fn hit(&self, ray: &Ray) -> Option<RayHit> {
        let [origin, direction] = shapes::parts(ray);
        let mut hit = RayHit::none();
        let ray = obvhs::ray::Ray::new_inf(origin, direction);
        self.tree.ray_traverse(ray, &mut hit, |ray, at| self.shapes[at].met(ray)).then_some(hit)
    }
}

impl<S: Met> Kernel for Built<S> {
    #[inline]
    fn closest(&self, ray: &Ray) -> Option<f64> {
        self.hit(ray).map(|hit| f64::from(hit.t))
    }

    #[inline]
    fn any(&self, ray: &Ray, t_max: f32) -> bool {
        let [origin, direction] = shapes::parts(ray);
        let ray = obvhs::ray::Ray::new(origin, direction, 0.0, t_max);
        !self.tree.ray_traverse_miss(ray, |ray, at| self.shapes[at].met(ray))
    }

    fn first(&self, ray: &Ray) -> Option<u32> {
        self.hit(ray).map(|hit| self.tree.primitive_indices[hit.primitive_id as usize])
    }
}
