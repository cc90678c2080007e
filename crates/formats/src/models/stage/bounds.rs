//! The box around the meshes of a model.

use durer_math::{DAffine3, DVec3};
use durer_scene::{Import, MeshData, Object, ObjectKind};

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Bounds {
    const NOTHING: Bounds = Bounds { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn add(&mut self, point: DVec3) {
        self.low = self.low.min(point);
        self.high = self.high.max(point);
    }

    pub(super) fn center(&self) -> DVec3 {
        (self.low + self.high) * 0.5
    }

    /// From the center to a corner.
    pub(super) fn radius(&self) -> f64 {
        (self.high - self.low).length() * 0.5
    }

    pub(super) fn corners(&self) -> [DVec3; 8] {
        let ends = [self.low, self.high];
        [0, 1, 2, 3, 4, 5, 6, 7].map(|bits| DVec3::new(ends[bits & 1].x, ends[bits >> 1 & 1].y, ends[bits >> 2].z))
    }

    /// The box around what becomes of this box.
    pub(super) fn moved(&self, outer_from_inner: &DAffine3) -> Bounds {
        let mut moved = Bounds::NOTHING;
        self.corners().iter().for_each(|corner| moved.add(outer_from_inner.transform_point3(*corner)));
        moved
    }
}

/// The box around all triangles in some objects; the unit cube around the origin if there are none. Vertices that no
/// triangle uses do not count: programs leave them behind anywhere.
pub(super) fn bounds_of(objects: &[Object]) -> Bounds {
    let mut bounds = Bounds::NOTHING;
    add_all(objects, DAffine3::IDENTITY, &mut bounds);
    if bounds.low.is_finite() && bounds.high.is_finite() {
        bounds
    } else {
        Bounds { low: DVec3::splat(-0.5), high: DVec3::splat(0.5) }
    }
}

fn add_all(objects: &[Object], outer: DAffine3, bounds: &mut Bounds) {
    for object in objects {
        let world_from_object = outer * object.transform.to_affine();
        match &object.kind {
            ObjectKind::Mesh(mesh) => add_mesh(&mesh.data, world_from_object, bounds),
            ObjectKind::Group(objects) | ObjectKind::Import(Import { objects, .. }) => {
                add_all(objects, world_from_object, bounds);
            }
            // No model file makes such.
            ObjectKind::Shape(_) | ObjectKind::Particles(_) | ObjectKind::Instances(_) | ObjectKind::Solid(_) => {}
        }
    }
}

fn add_mesh(mesh: &MeshData, world_from_object: DAffine3, bounds: &mut Bounds) {
    let mut is_used = vec![false; mesh.positions.len()];
    mesh.triangles.iter().flatten().for_each(|vertex| is_used[*vertex as usize] = true);
    for (position, _) in mesh.positions.iter().zip(is_used).filter(|(_, is_used)| *is_used) {
        let place = mesh.origin + DVec3::from_array(position.map(f64::from));
        bounds.add(world_from_object.transform_point3(place));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_scene::{Mesh, MeshNormals, Transform, TransformStep};
    use std::sync::Arc;

    #[test]
    fn transforms_and_origins_count_and_unused_vertices_do_not() {
        let data = MeshData {
            origin: DVec3::new(100.0, 0.0, 0.0),
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [900.0; 3]],
            triangles: vec![[0, 1, 2]],
            ..MeshData::default()
        };
        let mesh = Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) };
        let steps = |step| Transform { steps: vec![step] };
        let inner = Object {
            transform: steps(TransformStep::Translate(DVec3::new(-100.0, 0.0, 3.0))),
            ..Object::new(ObjectKind::Mesh(mesh))
        };
        let group = Object {
            transform: steps(TransformStep::Scale(DVec3::new(-2.0, 2.0, 2.0))),
            ..Object::new(ObjectKind::Group(vec![inner]))
        };
        let bounds = bounds_of(&[group]);
        assert_eq!(bounds, Bounds { low: DVec3::new(-2.0, 0.0, 6.0), high: DVec3::new(0.0, 4.0, 6.0) });
    }

    #[test]
    fn nothing_has_some_bounds() {
        assert_eq!(bounds_of(&[]).center(), DVec3::ZERO);
    }
}
