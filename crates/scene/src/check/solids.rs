//! Solids: every operand has an inside.

use super::objects::all;
use super::values::{Around, Checker};
use super::{Step, objects};
use crate::{MeshData, Object, ObjectKind, Shape, Solid};
use std::sync::Arc;

pub(super) fn check(c: &mut Checker<'_>, solid: &Solid, inside: Around, depth: usize) {
    c.field("objects", |c| {
        if solid.operands.is_empty() {
            c.problem(format!("`{}` needs at least one object", solid.operation.word()));
        }
        all(c, &solid.operands, inside, depth + 1);
        closed(c, &solid.operands, depth + 1);
    });
}

/// That all of these have an inside; solids among them are checked for themselves.
fn closed(c: &mut Checker<'_>, operands: &[Object], depth: usize) {
    if depth > objects::DEEPEST {
        return;
    }
    for (at, operand) in operands.iter().enumerate() {
        c.at(Step::Index(at), |c| {
            let word = operand.kind.word();
            c.field(word, |c| match &operand.kind {
                ObjectKind::Shape(shape) if !shape.is_closed() => _ = open(c, word, shape),
                ObjectKind::Particles(_) | ObjectKind::Instances(_) | ObjectKind::Import(_) => {
                    let help = "solids are made of closed shapes, closed meshes, solids, and groups of these";
                    c.problem_with_help(format!("`{word}` cannot be part of a solid"), help);
                }
                ObjectKind::Mesh(mesh) => _ = whole(c, &mesh.data),
                ObjectKind::Group(members) => c.field("objects", |c| closed(c, members, depth + 1)),
                ObjectKind::Shape(_) | ObjectKind::Solid(_) => {}
            });
        });
    }
}

fn open(c: &mut Checker<'_>, word: &str, shape: &Shape) -> bool {
    let message = format!("this {word} has no inside, so it cannot be part of a solid");
    match shape {
        Shape::Cylinder { .. } | Shape::Cone { .. } => {
            c.field("open", |c| c.problem_with_help(message, "leave out `open: true`"))
        }
        _ => {
            c.problem_with_help(message, "use a shape that encloses something, or a plane, behind which all is inside")
        }
    }
}

fn whole(c: &mut Checker<'_>, mesh: &Arc<MeshData>) -> bool {
    // What else is wrong with it has been said.
    if mesh.triangles.iter().flatten().any(|&vertex| vertex as usize >= mesh.positions.len()) {
        return false;
    }
    let help = "close it where it was made: fill its holes, join its seams, and turn its triangles the same way around";
    let open = *c.open_edges.entry(Arc::as_ptr(mesh) as usize).or_insert_with(|| mesh.open_edges());
    match open {
        Some(0) => true,
        Some(open) => {
            let edges = if open == 1 { "1 edge does" } else { &format!("{open} edges do") };
            let message = format!("this mesh is not closed: {edges} not join two triangles that face the same way");
            c.problem_with_help(format!("{message}, so it cannot be part of a solid"), help)
        }
        None => c.problem_with_help("this mesh encloses nothing, so it cannot be part of a solid".to_owned(), help),
    }
}
