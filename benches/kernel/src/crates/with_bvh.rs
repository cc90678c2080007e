//! The crate bvh. Its iterators give the shapes whose boxes a ray meets; a query that knows the nearest hit so far makes
//! them leave out what is farther.

use crate::shapes::{self, Shape};
use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh, BvhNode};
use durer_bench_kernel::measure::{self, Kernel};
use durer_bench_kernel::print::Lines;
use durer_bench_kernel::rays::Ray;
use durer_bench_kernel::scene::{Scene, Things};
use glam::Vec3A;
use nalgebra::{Point3, Vector3};
use std::cell::Cell;

/// Builds a scene and measures it, if it is to be repeated at all.
pub(crate) fn measure(scene: &Scene, repeats: usize) {
    let lines = Lines { program: "bvh", variant: "", scene: &scene.name };
    lines.scene(scene.count(), &scene.hashes());
    match &scene.things {
        Things::Triangles(mesh) => finish(lines, scene, repeats, &shapes::triangles(mesh)),
        Things::Spheres(spheres) => finish(lines, scene, repeats, &shapes::balls(spheres)),
    }
}

fn finish<S: Shape>(lines: Lines<'_>, scene: &Scene, repeats: usize, shapes: &[S]) {
    let (seconds, built) = measure::build(repeats, || Built::new(shapes));
    lines.build(seconds, built.memory(), 0);
    if repeats > 0 {
        measure::all(lines, scene, &built, repeats);
    }
}

/// A shape with its number and its place in the tree, which the crate wants to be kept here.
#[derive(Clone, Copy)]
struct Leaf<S> {
    shape: S,
    number: u32,
    node: usize,
}

impl<S: Shape> Bounded<f32, 3> for Leaf<S> {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [min, max] = self.shape.corners().map(|corner| Point3::from(corner.to_array()));
        Aabb::with_bounds(min, max)
    }
}

impl<S: Shape> BHShape<f32, 3> for Leaf<S> {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// A ray that ends at the nearest hit so far.
struct Query {
    ray: bvh::ray::Ray<f32, 3>,
    end: Cell<f32>,
}

impl Query {
    /// As it is: the crate's own constructor would change the length of the direction, and with it all distances.
    #[inline]
    fn new(ray: &Ray, t_max: f32) -> Query {
        let direction = Vector3::from(ray.direction);
        let ray = bvh::ray::Ray {
            origin: Point3::from(ray.origin),
            direction,
            inv_direction: direction.map(|component| 1.0 / component),
        };
        Query { ray, end: Cell::new(t_max) }
    }
}

impl IntersectsAabb<f32, 3> for Query {
    #[inline]
    fn intersects_aabb(&self, aabb: &Aabb<f32, 3>) -> bool {
        self.ray.intersection_slice_for_aabb(aabb).is_some_and(|(enter, _)| enter <= self.end.get())
    }
}

/// A tree and its shapes.
struct Built<S> {
    tree: Bvh<f32, 3>,
    leaves: Vec<Leaf<S>>,
}

impl<S: Shape> Built<S> {
    fn new(shapes: &[S]) -> Built<S> {
        let leaf = |(number, &shape): (usize, &S)| Leaf { shape, number: number as u32, node: 0 };
        let mut leaves: Vec<Leaf<S>> = shapes.iter().enumerate().map(leaf).collect();
        Built { tree: Bvh::build(&mut leaves), leaves }
    }

    fn memory(&self) -> usize {
        self.tree.nodes.len() * size_of::<BvhNode<f32, 3>>() + size_of_val(self.leaves.as_slice())
    }

    #[inline]
    fn hit(&self, ray: &Ray) -> Option<(f32, u32)> {
        let query = Query::new(ray, f32::INFINITY);
        let [origin, direction]: [Vec3A; 2] = shapes::parts(ray);
        let mut best = None;
        for leaf in self.tree.traverse_iterator(&query, &self.leaves) {
            if let Some(t) = leaf.shape.intersect(origin, direction, query.end.get()) {
                query.end.set(t);
                best = Some((t, leaf.number));
            }
        }
        best
    }
}

impl<S: Shape> Kernel for Built<S> {
    #[inline]
    fn closest(&self, ray: &Ray) -> Option<f64> {
        self.hit(ray).map(|(t, _)| f64::from(t))
    }

    #[inline]
    fn any(&self, ray: &Ray, t_max: f32) -> bool {
        let query = Query::new(ray, t_max);
        let [origin, direction] = shapes::parts(ray);
        let mut leaves = self.tree.traverse_iterator(&query, &self.leaves);
        leaves.any(|leaf| leaf.shape.intersect(origin, direction, t_max).is_some())
    }

    fn first(&self, ray: &Ray) -> Option<u32> {
        self.hit(ray).map(|(_, number)| number)
    }
}
