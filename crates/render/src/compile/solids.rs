//! From the solids of a scene to those of geometry.

use super::contents::Contents;
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
            Some(content) => Operand::Shape(content.place(&solid_from_object)),
            None => Operand::Combined(Operation::Union, Vec::new()),
        },
    }
}

/// The first part of each run of parts with the same material, and that; `inherited` is what operands without a material
/// of their own have.
pub(super) fn runs(solid: &Solid, placed: &Primitive, inherited: u32) -> Vec<(u32, u32)> {
    let mut materials = Vec::new();
    each_material(&solid.operands, inherited, &mut materials);
    let mut runs: Vec<(u32, u32)> = placed.leaf_starts().into_iter().zip(materials).collect();
    runs.dedup_by_key(|&mut (_, material)| material);
    if runs.is_empty() { vec![(0, inherited)] } else { runs }
}

/// The materials of the leaves, in the order in which [`build`] gives them.
fn each_material(objects: &[Object], inherited: u32, materials: &mut Vec<u32>) {
    for object in objects {
        let own = object.material.map_or(inherited, |id| id.0);
        match &object.kind {
            ObjectKind::Group(members) => each_material(members, own, materials),
            ObjectKind::Solid(solid) => each_material(&solid.operands, own, materials),
            ObjectKind::Mesh(mesh) if mesh.data.triangles.is_empty() => {}
            _ => materials.push(own),
        }
    }
}
