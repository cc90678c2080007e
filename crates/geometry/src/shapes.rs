//! The exact shapes, one file each, in their canonical spaces.
//!
//! A canonical shape has as few parameters as it can: the unit sphere, the unit cylinder. Size and place are in the
//! transform of the [`Primitive`](crate::Primitive) that holds it, so that non-uniform scale and mirroring need no
//! code here. To add a shape, see CONTRIBUTING.md.

pub(crate) mod cone;
pub(crate) mod cuboid;
pub(crate) mod cylinder;
pub(crate) mod disc;
pub(crate) mod mesh;
pub(crate) mod particles;
pub(crate) mod plane;
pub(crate) mod rectangle;
pub(crate) mod solid;
mod span;
pub(crate) mod sphere;
#[cfg(test)]
pub(crate) mod testing;
pub(crate) mod torus;
pub(crate) mod triangle;

use crate::bvh::traverse::Work;
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};

/// What every shape can answer, in its canonical space.
pub(crate) trait Shape {
    /// The smallest box around it; infinite for a plane.
    fn bounds(&self) -> Bounds;

    /// The nearest crossing with 0 < t < `t_max`, of a ray whose direction has any length.
    ///
    /// The sign of a root is exact for an origin that is off the surface by more than [`Shape::rounding`]: a ray that
    /// starts outside and leaves never finds the surface it left, however shallow its angle. Parts that meet at a seam
    /// leave no gap: closed shapes intersect spans, not parts one by one.
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing>;

    /// As [`Shape::intersect`], adding what it took.
    fn intersect_watched(&self, ray: &Ray, t_max: f64, work: &mut Work) -> Option<Crossing> {
        work.primitives += 1;
        self.intersect(ray, t_max)
    }

    /// True if there is a crossing with 0 < t < `t_max`.
    fn meets(&self, ray: &Ray, t_max: f64) -> bool {
        self.intersect(ray, t_max).is_some()
    }

    /// Puts a point that is on `part` but for rounding back on it, as near as numbers allow, and gives the outward unit
    /// normal there.
    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3);

    /// Texture coordinates of a point on `part`.
    fn uv(&self, point: DVec3, part: u32) -> DVec2;

    /// True for a point inside; always false for a shape without an inside.
    fn contains(&self, point: DVec3) -> bool;

    /// How far from the surface, along its normal, [`Shape::intersect`] may see a point that [`Shape::surface`] gave for
    /// `part`.
    fn rounding(&self, part: u32) -> f64;

    /// [`Shape::rounding`] at one point of `part` with this unit normal, for a shape in which it differs much.
    fn rounding_at(&self, _point: DVec3, _normal: DVec3, part: u32) -> f64 {
        self.rounding(part)
    }

    /// How many parts there are: those of all crossings are below this.
    fn part_count(&self) -> u32 {
        1
    }

    /// Calls `visit` for every crossing of a closed shape with t > 0, in any order; gives whether the ray starts inside.
    /// Does nothing and gives false for a shape without an inside.
    ///
    /// Passed in the order of t, each crossing leads from inside to outside or back. So the answer tells one consistent
    /// story of the ray, whatever was rounded.
    fn crossings(&self, _ray: &Ray, _visit: &mut dyn FnMut(Crossing)) -> bool {
        false
    }

    /// The outward unit normal of a face in which the ray lies, but for `width`, for all t in `range`. Only faces that
    /// contain straight lines need to be looked at.
    fn face_along(&self, _ray: &Ray, _range: (f64, f64), _width: f64) -> Option<DVec3> {
        None
    }
}
