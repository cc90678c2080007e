//! What a primitive answers as an operand of a solid, in whose space it then is placed.

use super::{Kind, Primitive, Surface, largest, outward_normal};
use crate::shapes::Shape;
use crate::shapes::solid::{Operand, Solid};
use crate::{Bounds, Crossing, Ray};
use durer_math::{DAffine3, DVec3};
use std::sync::Arc;

/// How far apart, in its canonical space, a shape may see points that should be one: `constant` + `slope` · the largest
/// coordinate of what was mapped there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    constant: f64,
    slope: f64,
    /// The norm of the map from the canonical space.
    stretch: f64,
}

impl Noise {
    fn at(&self, reach: f64) -> f64 {
        self.constant + self.slope * reach
    }

    /// In the primitive's surroundings, along a unit normal of its surface.
    pub(crate) fn along(&self, primitive: &Primitive, normal: DVec3, reach: f64) -> f64 {
        // The canonical normal is that of the world under the transpose, which shrinks by the stretch of a step.
        self.at(reach) * (primitive.world_from_shape.transpose() * normal).length()
    }

    /// In the primitive's surroundings, in any direction.
    pub(crate) fn across(&self, reach: f64) -> f64 {
        self.at(reach) * self.stretch
    }
}

impl Primitive {
    /// Closed shapes combined to one. Operands are placed in the object's space.
    pub fn solid(operand: Operand, world_from_object: &DAffine3) -> Primitive {
        let (solid, middle) = Solid::build(operand);
        let frame = DAffine3::from_translation(middle);
        Primitive::place(Kind::Solid(Arc::new(solid)), &(*world_from_object * frame))
    }

    /// For a solid, which of its leaves (counted from 0 in the order in which they were given) a crossing's part belongs
    /// to; 0 for other shapes.
    pub fn leaf_of(&self, part: u32) -> usize {
        match &self.kind {
            Kind::Solid(solid) => solid.leaf_of(part),
            _ => 0,
        }
    }

    /// For a solid, the first part of each leaf; for other shapes that of the whole.
    pub fn leaf_starts(&self) -> Vec<u32> {
        match &self.kind {
            Kind::Solid(solid) => solid.leaf_starts().collect(),
            _ => vec![0],
        }
    }

    /// Calls `visit` for every crossing of a closed shape with t > 0, in any order; gives whether the ray starts inside.
    /// In the order of t each leads from inside to outside or back.
    pub fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        each_kind!(&self.kind, shape => shape.crossings(&self.ray_in_shape(ray), visit))
    }

    /// The surface at the point of `part` nearest to one that is on it but for rounding.
    pub(crate) fn surface_near(&self, point: DVec3, part: u32) -> Surface {
        each_kind!(&self.kind, shape => self.surface_of(shape, point, part))
    }

    pub(crate) fn part_count(&self) -> u32 {
        each_kind!(&self.kind, shape => shape.part_count())
    }

    /// The outward unit normal of a face in which the ray lies, but for its own rounding, for all t in `range`.
    pub(crate) fn face_along(&self, ray: &Ray, range: (f64, f64), noise: &Noise, reach: f64) -> Option<DVec3> {
        let ray = self.ray_in_shape(ray);
        let face = each_kind!(&self.kind, shape => shape.face_along(&ray, range, noise.at(reach)));
        face.map(|normal| outward_normal(&self.shape_from_world, normal).0)
    }

    /// A box around what is inside it: for a half-space that an axis is perpendicular to, infinite on one side only.
    pub(crate) fn bounds_of_inside(&self) -> Bounds {
        let mut bounds = self.bounds();
        let Some([normal, point]) = self.as_plane() else { return bounds };
        for axis in 0..3 {
            if normal[axis].abs() == largest(normal) && normal.length_squared() == normal[axis] * normal[axis] {
                let slack = 1e-14 * largest(point);
                match normal[axis] > 0.0 {
                    true => bounds.max[axis] = point[axis] + slack,
                    false => bounds.min[axis] = point[axis] - slack,
                }
            }
        }
        bounds
    }

    /// Moved, and how far in its canonical space it may see points that should be one: by the shape's own arithmetic, by
    /// how far the two maps are from being inverse to each other, by applying them, and because its place was rounded
    /// before it was moved.
    pub(crate) fn moved(mut self, by: DVec3) -> (Primitive, Noise) {
        const UNITS: f64 = 16.0 * f64::EPSILON;
        let [stretch, shape_norm] = self.norms;
        let bounds = each_kind!(&self.kind, shape => shape.bounds());
        let size = largest(bounds.min).max(largest(bounds.max));
        let place = largest(self.origin);
        self.origin += by;
        let place = place + largest(self.origin);
        let mapping = UNITS * shape_norm;
        let noise = if size.is_finite() {
            // 24 ulps of the size are more than what any of the shapes asks for.
            let own = (24.0 * f64::EPSILON + self.residual + mapping * stretch) * size;
            Noise { constant: own + mapping * place, slope: mapping, stretch }
        } else {
            // A half-space: canonical coordinates are as large as the map makes them.
            let per_length = (self.residual + mapping * stretch) * shape_norm;
            let constant = per_length * largest(self.origin) + mapping * place;
            Noise { constant, slope: per_length + mapping, stretch }
        };
        (self, noise)
    }
}
