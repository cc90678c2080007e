//! What cannot be seen because nothing is there: lists without entries, triangles without area.

use super::Step;
use super::values::Checker;
use crate::{Background, Import, Instances, Mesh, MeshData, Object, ObjectKind, ParticleKind, Particles};
use durer_math::DVec3;
use std::sync::Arc;

pub(super) fn remark(c: &mut Checker<'_>) {
    let scene = c.scene;
    c.field("objects", |c| {
        if scene.objects.is_empty() && !matches!(scene.background, Background::Image(_)) {
            let help = "add some, such as `objects: [sphere: {radius: 1}]`";
            c.problem_with_help("nothing to see: the scene has no objects", help);
        }
        all(c, &scene.objects);
    });
}

fn all(c: &mut Checker<'_>, objects: &[Object]) {
    for (at, object) in objects.iter().enumerate() {
        c.at(Step::Index(at), |c| c.field(object.kind.word(), |c| kind(c, &object.kind)));
    }
}

fn kind(c: &mut Checker<'_>, kind: &ObjectKind) {
    match kind {
        ObjectKind::Shape(_) => {}
        ObjectKind::Group(members) => list(c, members, "this group is empty"),
        ObjectKind::Mesh(mesh) => self::mesh(c, mesh),
        ObjectKind::Particles(many) => particles(c, many),
        ObjectKind::Instances(Instances { objects, positions, .. }) => {
            if positions.values.is_empty() {
                let help = "each position, such as `[1, 0, 0]`, makes a copy";
                c.field("positions", |c| c.problem_with_help("nothing is copied: there are no positions", help));
            }
            list(c, objects, "nothing is copied: there are no objects");
        }
        ObjectKind::Import(Import { objects, lights, camera, .. }) => {
            if lights.is_empty() && camera.is_none() && !objects.iter().any(shows) {
                c.field("file", |c| c.problem("there is nothing to see in this model"));
            }
        }
        ObjectKind::Solid(solid) => c.field("objects", |c| all(c, &solid.operands)),
    }
}

fn list(c: &mut Checker<'_>, objects: &[Object], message: &str) {
    c.field("objects", |c| {
        if objects.is_empty() {
            c.problem_with_help(message, "put objects into the list, or take it away");
        }
        all(c, objects);
    });
}

fn mesh(c: &mut Checker<'_>, mesh: &Mesh) {
    if !c.meshes.insert(Arc::as_ptr(&mesh.data) as usize) {
        return;
    }
    let wrong = match (mesh.data.triangles.is_empty(), has_area(&mesh.data)) {
        (true, _) => "there is nothing to see of this mesh: it has no triangles",
        (false, false) => "there is nothing to see of this mesh: none of its triangles has an area",
        (false, true) => return,
    };
    let field = if mesh.file.is_some() { "file" } else { "triangles" };
    c.field(field, |c| c.problem_with_help(wrong, "three vertices that are not on one line make a triangle"));
}

fn has_area(mesh: &MeshData) -> bool {
    let corner = |vertex: u32| DVec3::from(mesh.positions[vertex as usize].map(f64::from));
    mesh.triangles.iter().any(|&[a, b, c]| {
        let (a, b, c) = (corner(a), corner(b), corner(c));
        (b - a).cross(c - a) != DVec3::ZERO
    })
}

fn particles(c: &mut Checker<'_>, particles: &Particles) {
    if !particles.kind.is_empty() {
        return;
    }
    let field = match particles.kind {
        ParticleKind::Spheres { .. } => "centers",
        ParticleKind::Cylinders { .. } | ParticleKind::Cones { .. } | ParticleKind::Capsules { .. } => "bases",
    };
    let message = format!("there are no {}: the list of {field} is empty", particles.kind.word());
    c.field(field, |c| c.problem_with_help(message, "each entry makes one"));
}

/// True if there is anything in it. Whether triangles have an area is not asked: many objects may share them.
fn shows(object: &Object) -> bool {
    match &object.kind {
        ObjectKind::Shape(_) => true,
        ObjectKind::Group(members) => members.iter().any(shows),
        ObjectKind::Mesh(mesh) => !mesh.data.triangles.is_empty(),
        ObjectKind::Particles(particles) => !particles.kind.is_empty(),
        ObjectKind::Instances(Instances { objects, positions, .. }) => {
            !positions.values.is_empty() && objects.iter().any(shows)
        }
        ObjectKind::Import(import) => import.objects.iter().any(shows),
        ObjectKind::Solid(solid) => solid.operands.iter().any(shows),
    }
}
