//! The rest pose: morph targets with the weights that the file sets, and skins bent by their joints as they stand.

use super::super::ModelError;
use super::accessor::{Accessor, Component, FRACTIONS, MEASURES};
use super::nodes::{Graph, affine};
use super::primitives::Opener;
use super::source::Source;
use super::value::{Place, Value};
use durer_math::{DAffine3, DMat3, DVec3};

/// A morph target that has an effect.
pub(super) struct Target<'s> {
    weight: f64,
    positions: Option<Accessor<'s>>,
    normals: Option<Accessor<'s>>,
}

/// Opens the morph targets of a primitive whose weight is not zero.
pub(super) fn open_targets<'s, 'a>(
    opener: &mut Opener<'s, 'a>,
    primitive: &Value<'a>,
    weights: &[f64],
) -> Result<Vec<Target<'s>>, ModelError> {
    let mut open = Vec::new();
    let targets = primitive.list("targets")?;
    opener.source.budget.spend(targets.len(), 64, primitive.place)?;
    for (index, weight) in weights.iter().copied().enumerate().filter(|(_, weight)| *weight != 0.0) {
        let Some(target) = targets.object(index)? else { break };
        opener.key.push(weight.to_bits());
        let positions = opener.open(&target, "POSITION", &[3], MEASURES)?;
        open.push(Target { weight, positions, normals: opener.open(&target, "NORMAL", &[3], MEASURES)? });
    }
    Ok(open)
}

impl Target<'_> {
    /// Moves the vertices that are used.
    pub(super) fn add_to(&self, used: &[u32], positions: &mut [[f32; 3]], normals: &mut [[f32; 3]]) {
        for (accessor, vectors) in [(&self.positions, positions), (&self.normals, normals)] {
            let Some(accessor) = accessor else { continue };
            for (vertex, vector) in used.iter().zip(vectors) {
                let by = accessor.get::<3>(*vertex as usize);
                for (coordinate, by) in vector.iter_mut().zip(by) {
                    *coordinate = (f64::from(*coordinate) + self.weight * by) as f32;
                }
            }
        }
    }
}

/// Joints that bend meshes.
pub(super) struct Skin {
    place: Place,
    index: usize,
    /// For each joint, the map from the mesh as it was bound to the world.
    joints: Vec<DAffine3>,
}

/// Four joints for each vertex, and how much each of them bends it.
pub(super) struct Bones<'s> {
    joints: Accessor<'s>,
    weights: Accessor<'s>,
}

const JOINTS: [&str; 4] = ["JOINTS_0", "JOINTS_1", "JOINTS_2", "JOINTS_3"];
const WEIGHTS: [&str; 4] = ["WEIGHTS_0", "WEIGHTS_1", "WEIGHTS_2", "WEIGHTS_3"];

impl Skin {
    /// The skin `value`, which is skins[index].
    pub(super) fn of<'a>(
        source: &Source<'a>,
        graph: &Graph,
        index: usize,
        value: &Value<'a>,
    ) -> Result<Skin, ModelError> {
        let list = value.list("joints")?;
        source.budget.spend(list.len(), size_of::<DAffine3>(), list.place)?;
        let field = "inverseBindMatrices";
        let bound = Accessor::open(source, value, field, &[16], &[Component::F32])?.map(|(_, accessor)| accessor);
        if let Some(bound) = &bound
            && bound.count < list.len()
        {
            return Err(bound.place.fault(format!("it has {} matrices for {} joints", bound.count, list.len())));
        }
        let mut joints = Vec::with_capacity(list.len());
        for (at, joint) in list.iter().enumerate() {
            let world_from_joint = graph.world_from_node(joint.as_whole()?, joint.place)?;
            let joint_from_mesh = bound.as_ref().map_or(DAffine3::IDENTITY, |bound| affine(&bound.get(at)));
            joints.push(world_from_joint * joint_from_mesh);
        }
        Ok(Skin { place: value.place, index, joints })
    }

    /// Opens the joints and weights of a primitive's vertices.
    pub(super) fn open_bones<'s, 'a>(
        &self,
        opener: &mut Opener<'s, 'a>,
        attributes: &Value<'a>,
    ) -> Result<Vec<Bones<'s>>, ModelError> {
        let mut bones = Vec::new();
        opener.key.push(self.index as u64);
        for (joints, weights) in JOINTS.into_iter().zip(WEIGHTS) {
            let joints = opener.open(attributes, joints, &[4], &[Component::U8, Component::U16])?;
            let weights = opener.open(attributes, weights, &[4], FRACTIONS)?;
            let (Some(joints), Some(weights)) = (joints, weights) else { break };
            bones.push(Bones { joints, weights: weights.into_fractions() });
        }
        Ok(bones)
    }

    /// Bends the vertices that are used, from the space of the mesh to the world.
    pub(super) fn bend(
        &self,
        bones: &[Bones<'_>],
        used: &[u32],
        positions: &mut [[f32; 3]],
        normals: &mut [[f32; 3]],
        triangles: &mut [[u32; 3]],
    ) -> Result<(), ModelError> {
        let mut mirrored = vec![false; used.len()];
        for (at, vertex) in used.iter().enumerate() {
            let map = self.map_of(bones, *vertex as usize)?;
            positions[at] = single(map.transform_point3(wide(positions[at])));
            mirrored[at] = map.matrix3.determinant() < 0.0;
            if let Some(normal) = normals.get_mut(at) {
                *normal = single(turned(map.matrix3, wide(*normal)));
            }
        }
        for triangle in triangles.iter_mut().filter(|triangle| mirrored[triangle[0] as usize]) {
            triangle.swap(1, 2);
        }
        Ok(())
    }

    /// The map of one vertex: the mean of those of its joints, by their weights.
    fn map_of(&self, bones: &[Bones<'_>], vertex: usize) -> Result<DAffine3, ModelError> {
        let mut sum = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
        let mut total = 0.0;
        for bones in bones {
            let joints = bones.joints.get_whole::<4>(vertex);
            for (joint, weight) in joints.into_iter().zip(bones.weights.get::<4>(vertex)) {
                // Unused entries may name any joint.
                if weight > 0.0 && weight.is_finite() {
                    let Some(map) = self.joints.get(joint as usize) else {
                        let message = format!("vertex {vertex} hangs on joint {joint}, but {} has", self.place);
                        return Err(bones.joints.place.fault(format!("{message} only {}", self.joints.len())));
                    };
                    sum.matrix3 += map.matrix3 * weight;
                    sum.translation += map.translation * weight;
                    total += weight;
                }
            }
        }
        if total == 0.0 {
            return Ok(self.joints.first().copied().unwrap_or(DAffine3::IDENTITY));
        }
        Ok(DAffine3 { matrix3: sum.matrix3 * (1.0 / total), translation: sum.translation * (1.0 / total) })
    }
}

/// A normal under a map: by its cofactors, which need no inverse, to the side that it was on.
fn turned(map: DMat3, normal: DVec3) -> DVec3 {
    let (a, b, c) = (map.x_axis, map.y_axis, map.z_axis);
    let turned = b.cross(c) * normal.x + c.cross(a) * normal.y + a.cross(b) * normal.z;
    let side = if map.determinant() < 0.0 { -1.0 } else { 1.0 };
    turned.try_normalize().unwrap_or(DVec3::ZERO) * side
}

fn wide([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(x.into(), y.into(), z.into())
}

fn single(vector: DVec3) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}
