//! From the solids of a scene to those of geometry.

use super::contents::{Content, Contents};
use super::looks::{Origin, runs};
use durer_geometry::{Operand, Operation, Primitive};
use durer_math::DAffine3;
use durer_scene::{Object, ObjectKind, Solid};

/// The solid as geometry knows it, in its object's space.
pub(super) fn build(solid: &Solid, contents: &Contents) -> Primitive {
    Primitive::solid(combined(solid, contents, &DAffine3::IDENTITY), &DAffine3::IDENTITY)
}

fn combined(solid: &Solid, contents: &Contents, solid_from_object: &DAffine3) -> Operand {
    let operation = match solid.operation {
        durer_scene::Operation::Union => Operation::Union,
        durer_scene::Operation::Intersection => Operation::Intersection,
        durer_scene::Operation::Difference => Operation::Difference,
    };
    Operand::Combined(operation, operands(&solid.operands, contents, solid_from_object))
}

fn operands(objects: &[Object], contents: &Contents, solid_from_parent: &DAffine3) -> Vec<Operand> {
    objects.iter().map(|object| operand(object, contents, solid_from_parent)).collect()
}

fn operand(object: &Object, contents: &Contents, solid_from_parent: &DAffine3) -> Operand {
    let solid_from_object = *solid_from_parent * object.transform.to_affine();
    match &object.kind {
        ObjectKind::Group(members) => {
            Operand::Combined(Operation::Union, operands(members, contents, &solid_from_object))
        }
        ObjectKind::Solid(solid) => combined(solid, contents, &solid_from_object),
        kind => match contents.get(kind) {
            // A mesh finds out here which way is out.
            Some(content) if content.is_closed() => Operand::Shape(content.place(&solid_from_object)),
            Some(_) => Operand::Combined(Operation::Union, Vec::new()),
            None => Operand::Combined(Operation::Union, Vec::new()),
        },
    }
}

/// The runs of parts with the same material, in order: the first part of each, and the material. `inherited` is what
/// operands without a material of their own have. `origins` become the operands.
pub(super) fn details(
    solid: &Solid,
    placed: &Primitive,
    contents: &Contents,
    inherited: u32,
    origins: &mut Vec<Origin>,
) -> Vec<(u32, u32)> {
    let mut leaves = Vec::new();
    add_leaves(&solid.operands, contents, (inherited, DAffine3::IDENTITY), &mut leaves);
    let mut all_runs = Vec::new();
    let placed = placed.leaf_starts().into_iter().zip(leaves);
    let origin = |(first_part, leaf): (u32, Leaf<'_>)| {
        let runs = match leaf.content.mesh_data() {
            Some(data) => runs(data, leaf.own, leaf.around),
            None => vec![(0, leaf.own.unwrap_or(leaf.around))],
        };
        all_runs.extend(runs.iter().map(|&(part, material)| (first_part + part, material)));
        let (map, colors) = (leaf.solid_from_object, leaf.content.colors());
        let operand_from_solid = (map != DAffine3::IDENTITY).then(|| map.inverse());
        Origin { first_part, colors, operand_from_solid }
    };
    let found: Vec<Origin> = placed.map(origin).collect();
    if found.is_empty() {
        // Nothing is inside, and nothing will be hit.
        return vec![(0, inherited)];
    }
    *origins = found;
    all_runs.dedup_by_key(|&mut (_, material)| material);
    all_runs
}

/// A shape that a solid is made of.
struct Leaf<'s> {
    content: Content<'s>,
    solid_from_object: DAffine3,
    own: Option<u32>,
    /// The material of what is around it.
    around: u32,
}

/// The leaves, in the order in which [`build`] gives them.
fn add_leaves<'s>(
    objects: &'s [Object],
    contents: &Contents,
    (around, solid_from_parent): (u32, DAffine3),
    leaves: &mut Vec<Leaf<'s>>,
) {
    for object in objects {
        let own = object.material.map(|id| id.0);
        let solid_from_object = solid_from_parent * object.transform.to_affine();
        let inside = (own.unwrap_or(around), solid_from_object);
        match &object.kind {
            ObjectKind::Group(members) => add_leaves(members, contents, inside, leaves),
            ObjectKind::Solid(solid) => add_leaves(&solid.operands, contents, inside, leaves),
            kind => {
                let leaf = |content| Leaf { content, solid_from_object, own, around };
                leaves.extend(contents.get(kind).map(leaf));
            }
        }
    }
}
