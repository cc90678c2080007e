//! Solids made of closed shapes by union, intersection and difference: constructive solid geometry.
//!
//! A ray is followed from crossing to crossing of all operands in order (Roth, "Ray Casting for Modeling Solids", CGIP
//! 18, 1982). Each crossing turns one leaf of the expression on or off, and the solid is crossed where that turns the
//! root. Nothing is ever asked of a point: whether a ray starts inside an operand comes from the same numbers as where
//! it crosses it. The other way, to take each operand's nearest hit and to ask the others whether they contain it, as
//! many programs do, lets two roundings disagree, and they do so where operands meet: there it leaves pinholes and
//! specks. Going on from hit to hit by a state machine (Kensler, "Ray Tracing CSG Objects Using Single Hit
//! Intersections", 2006) avoids that, but needs a step off each surface, and two operands at a time; the shapes here
//! know all their crossings at once.
//!
//! What rounding may do to faces that should coincide is undone in [`walk`]: slices of solid or of nothing that are thinner
//! than what the operands' own arithmetic can tell are not there (the sets are regularized, as Tilove and Requicha put
//! it, to the last bits), and a ray that runs within a face is answered as one beside it is.
//!
//! Each node of the tree knows a box outside of which it cannot matter; a ray that misses it skips what is below. Long
//! unions, also those that are taken away, are made trees by place, so a plate with a thousand holes costs little more
//! than one with ten.

mod build;
mod states;
#[cfg(test)]
mod tests;
mod walk;

pub use build::{Operand, Operation};

use super::Shape;
use crate::primitive::operand::Noise;
use crate::{Bounds, Crossing, Primitive, Ray, Surface};
use durer_math::{DVec2, DVec3};
use states::States;
use walk::Walk;

/// Closed shapes, and how they are combined. Its canonical space is that of the operands, moved.
///
/// Parts are those of the first leaf, then those of the second, and so on.
#[derive(Debug)]
pub(crate) struct Solid {
    /// In the order in which they were given.
    leaves: Vec<Leaf>,
    /// The expression in preorder; empty if nothing can be inside.
    nodes: Vec<Node>,
    bounds: Bounds,
}

/// A shape that the solid is made of.
#[derive(Debug)]
struct Leaf {
    shape: Primitive,
    first_part: u32,
    /// True if the solid lies on its outer side: it is taken away, an odd number of times.
    flipped: bool,
    noise: Noise,
}

/// A node of the expression. Its state is a number: for a leaf 1 or 0, for other nodes how many children speak for it.
/// It is true (inside) if that is at least `needed`.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Beyond this it is false, or it does not matter what it is.
    bounds: Bounds,
    /// Where in the list the next node is that is not below this one.
    end: u32,
    needed: u32,
    /// The state at a point outside of all leaves.
    outside: u32,
    /// Speaks for its parent when false.
    subtracted: bool,
    leaf: Option<u32>,
}

/// Beyond so many radii an origin is moved nearer before coefficients are formed, so that what operands round does not
/// grow with the distance. Nearer origins are left alone, bit for bit.
const FAR: f64 = 16.0;

impl Solid {
    /// The shapes that it is made of, in its canonical space.
    pub(crate) fn shapes(&self) -> impl Iterator<Item = &Primitive> {
        self.leaves.iter().map(|leaf| &leaf.shape)
    }

    /// The leaf that a part belongs to.
    pub(crate) fn leaf_of(&self, part: u32) -> usize {
        self.leaves.partition_point(|leaf| leaf.first_part <= part).saturating_sub(1)
    }

    /// The first part of each leaf.
    pub(crate) fn leaf_starts(&self) -> impl Iterator<Item = u32> {
        self.leaves.iter().map(|leaf| leaf.first_part)
    }

    /// The shape that a part belongs to, in the solid's space, and which of its own parts it is.
    pub(crate) fn shape_of(&self, part: u32) -> (&Primitive, u32) {
        let (leaf, part) = self.leaf_and_part(part);
        (&leaf.shape, part)
    }

    /// True if the leaf that a part belongs to is taken away.
    pub(crate) fn is_flipped(&self, part: u32) -> bool {
        self.leaf_and_part(part).0.flipped
    }

    /// Bytes held.
    pub(crate) fn memory(&self) -> usize {
        size_of_val(self.leaves.as_slice()) + size_of_val(self.nodes.as_slice())
    }

    /// The leaf that a part belongs to, and which of its own parts it is.
    fn leaf_and_part(&self, part: u32) -> (&Leaf, u32) {
        let leaf = &self.leaves[self.leaf_of(part)];
        (leaf, part - leaf.first_part)
    }

    /// The same ray with its origin not too far before the solid, and the parameter of the new origin; `None` if the ray
    /// misses the sphere around it. Never moves a ray at an unbounded solid.
    fn brought_near(&self, ray: &Ray) -> Option<(Ray, f64)> {
        let radius = 0.5 * self.bounds.size().length();
        let from_middle = ray.origin - self.bounds.center();
        // A difference of infinities is no number, and not above anything.
        if !radius.is_finite() || from_middle.length_squared() <= FAR * FAR * radius * radius {
            return Some((*ray, 0.0));
        }
        let d = ray.direction;
        let to_nearest = -from_middle.dot(d) / d.length_squared();
        if to_nearest <= 0.0 || (from_middle + d * to_nearest).length() > radius * 1.001 {
            return None;
        }
        // Back from the nearest point by 2 to 3.5 radii: out of the sphere.
        let t = to_nearest - 2.0 * radius / d.abs().max_element();
        Some((Ray { origin: ray.at(t), direction: d }, t))
    }

    /// Calls `visit` for the crossings in order, until it says that it has enough; gives whether the ray starts inside.
    fn follow(&self, ray: &Ray, mut visit: impl FnMut(Crossing) -> bool) -> bool {
        let Some((near, skipped)) = self.brought_near(ray) else { return false };
        let mut walk = Walk::new(self, near);
        let starts_inside = walk.start();
        while let Some(Crossing { t, part }) = walk.next() {
            if visit(Crossing { t: t + skipped, part }) {
                break;
            }
        }
        starts_inside
    }
}

fn holds(bounds: &Bounds, point: DVec3) -> Option<()> {
    (point.cmpge(bounds.min).all() && point.cmple(bounds.max).all()).then_some(())
}

impl Shape for Solid {
    fn bounds(&self) -> Bounds {
        self.bounds
    }

    #[inline(never)]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let mut first = None;
        self.follow(ray, |crossing| {
            first = Some(crossing);
            true
        });
        // A solid that is cut off at t_max would not show which slices are too thin, so it is cut off here.
        first.filter(|crossing| crossing.t < t_max)
    }

    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        let (leaf, part) = self.leaf_and_part(part);
        let Surface { point, normal, .. } = leaf.shape.surface_near(point, part);
        (point, if leaf.flipped { -normal } else { normal })
    }

    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        let (leaf, part) = self.leaf_and_part(part);
        leaf.shape.uv(point, part)
    }

    fn contains(&self, point: DVec3) -> bool {
        let mut states = States::new(self);
        states.survey(|bounds| holds(bounds, point), |leaf, _, ()| leaf.shape.contains(point));
        states.is_inside()
    }

    /// What it is anywhere in a bounded solid.
    fn rounding(&self, _part: u32) -> f64 {
        let reach = walk::finite_reach(&self.bounds);
        walk::DOUBT * self.leaves.iter().map(|leaf| leaf.noise.across(reach)).fold(0.0, f64::max)
    }

    /// Of all leaves that are near: others may have a face at the same place, and a new ray must be off all of them.
    fn rounding_at(&self, point: DVec3, normal: DVec3, _part: u32) -> f64 {
        let reach = point.abs().max_element();
        let mut most = 0.0_f64;
        let mut weigh = |leaf: &Leaf| most = most.max(leaf.noise.along(&leaf.shape, normal, reach));
        let near = |leaf: &Leaf, _, ()| {
            weigh(leaf);
            false
        };
        States::new(self).survey(|bounds| holds(bounds, point), near);
        walk::DOUBT * most
    }

    fn part_count(&self) -> u32 {
        self.leaves.last().map_or(0, |leaf| leaf.first_part + leaf.shape.part_count())
    }

    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        self.follow(ray, |crossing| {
            visit(crossing);
            false
        })
    }
}
