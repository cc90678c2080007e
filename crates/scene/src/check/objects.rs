//! Objects: their shapes, transforms and materials.

use super::values::{Around, Checker};
use super::{Step, instances, meshes, particles, settings, solids};
use crate::{Import, MaterialId, Object, ObjectKind, Shape};
use durer_math::{DVec2, DVec3};

/// How deep objects may nest.
pub(super) const DEEPEST: usize = 64;

pub(super) fn check(c: &mut Checker<'_>) {
    let objects = &c.scene.objects;
    c.field("objects", |c| {
        all(c, objects, Around::WORLD, 1);
        instances::count(c, objects);
    });
}

/// Objects in a list, `depth` being 1 for those of the scene.
pub(super) fn all(c: &mut Checker<'_>, objects: &[Object], around: Around, depth: usize) {
    for (at, one) in objects.iter().enumerate() {
        c.at(Step::Index(at), |c| object(c, one, around, depth));
    }
}

fn object(c: &mut Checker<'_>, object: &Object, around: Around, depth: usize) {
    c.field(object.kind.word(), |c| {
        if depth > DEEPEST {
            c.problem(format!("groups may nest at most {DEEPEST} deep"));
            return;
        }
        c.field("material", |c| material(c, object.material));
        let inside = c.transform(&object.transform, around);
        match &object.kind {
            ObjectKind::Shape(shape) => self::shape(c, shape),
            ObjectKind::Group(members) => c.field("objects", |c| all(c, members, inside, depth + 1)),
            ObjectKind::Mesh(mesh) => meshes::check(c, mesh),
            ObjectKind::Particles(many) => particles::check(c, many),
            ObjectKind::Instances(copies) => instances::check(c, copies, inside, depth),
            ObjectKind::Import(import) => self::import(c, import, inside, depth),
            ObjectKind::Solid(solid) => solids::check(c, solid, inside, depth),
        }
    });
}

/// That a material exists.
pub(super) fn material(c: &mut Checker<'_>, material: Option<MaterialId>) {
    if let Some(MaterialId(id)) = material
        && id as usize >= c.scene.materials.len()
    {
        c.problem(format!("there is no material {id}"));
    }
}

/// What is in a file has no place but the name of the file.
fn import(c: &mut Checker<'_>, import: &Import, inside: Around, depth: usize) {
    c.field("file", |c| {
        c.field("objects", |c| all(c, &import.objects, inside, depth + 1));
        for (at, light) in import.lights.iter().enumerate() {
            c.field("lights", |c| c.at(Step::Index(at), |c| settings::light(c, light)));
        }
        if let Some(camera) = &import.camera {
            c.field("camera", |c| settings::camera(c, camera));
        }
    });
}

fn shape(c: &mut Checker<'_>, shape: &Shape) {
    match *shape {
        Shape::Plane { point, normal } => _ = c.point("point", point) & c.direction("normal", normal),
        Shape::Sphere { center, radius } => _ = c.point("center", center) & c.size("radius", radius),
        Shape::Box { min, max } => {
            if c.point("min", min) & c.point("max", max) {
                cuboid(c, max - min);
            }
        }
        Shape::Cylinder { base, top, radius, open: _ } => {
            ends(c, base, top);
            c.size("radius", radius);
        }
        Shape::Cone { base, top, base_radius, top_radius, open: _ } => {
            ends(c, base, top);
            let sizes = c.size_or_zero("radius", base_radius) & c.size_or_zero("top_radius", top_radius);
            if sizes && base_radius == 0.0 && top_radius == 0.0 {
                c.field("radius", |c| c.problem("radius and top_radius must not both be 0"));
            }
        }
        Shape::Disc { center, normal, radius, inner_radius } => {
            c.point("center", center);
            c.direction("normal", normal);
            let sizes = c.size("radius", radius) & c.size_or_zero("inner_radius", inner_radius);
            if sizes {
                c.require(inner_radius < radius, "inner_radius", "inner_radius must be less than radius");
            }
        }
        Shape::Rectangle { corner, edges } => {
            c.point("corner", corner);
            c.field("edges", |c| {
                let mut fine = true;
                let help = "edges go from the corner along two sides, for example `edges: [[2, 0, 0], [0, 0, -2]]`";
                for (at, edge) in edges.into_iter().enumerate() {
                    fine &= c.at(Step::Index(at), |c| match edge == DVec3::ZERO {
                        true => c.problem_with_help("an edge must not be zero: the rectangle has no area", help),
                        false => c.direction_here("an edge", edge),
                    });
                }
                if fine && is_flat(edges[0], edges[1]) {
                    let message = "the two edges must point in different directions: the rectangle has no area";
                    c.problem_with_help(message, help);
                }
            });
        }
        Shape::Triangle { vertices, uvs } => {
            triangle(c, vertices);
            let usable = |uv: &DVec2| uv.is_finite() && uv.abs().max_element() <= 1e6;
            let fine = uvs.is_none_or(|uvs| uvs.iter().all(usable));
            c.require(fine, "uvs", "texture coordinates must be at most 1e6 in size");
        }
        Shape::Torus { center, axis, radius, tube_radius } => {
            c.point("center", center);
            c.direction("axis", axis);
            let sizes = c.size("radius", radius) & c.size("tube_radius", tube_radius);
            if sizes {
                c.require(tube_radius < radius, "tube_radius", "tube_radius must be less than radius");
            }
        }
    }
}

fn cuboid(c: &mut Checker<'_>, extent: DVec3) {
    let axes = [("x", extent.x), ("y", extent.y), ("z", extent.z)];
    for (axis, extent) in axes {
        if extent < 1e-9 {
            let message = format!("{axis} of max must be greater than {axis} of min");
            let help = "for something flat, use a rectangle";
            c.field("max", |c| c.problem_with_help(message, if extent == 0.0 { help } else { "swap the two" }));
            return;
        }
    }
}

fn ends(c: &mut Checker<'_>, base: DVec3, top: DVec3) {
    if c.point("base", base) & c.point("top", top) {
        c.apart(("top", top), ("base", base));
    }
}

fn triangle(c: &mut Checker<'_>, vertices: [DVec3; 3]) {
    c.field("vertices", |c| {
        let mut fine = true;
        for (at, vertex) in vertices.into_iter().enumerate() {
            fine &= c.at(Step::Index(at), |c| c.point_here("a vertex", vertex));
        }
        let [a, b, d] = vertices;
        if fine && is_flat(b - a, d - a) {
            let help = "move one of them away from the line through the others, or leave the triangle out";
            c.problem_with_help("the three vertices must not lie on one line: the triangle has no area", help);
        }
    });
}

/// True if the two span no area to speak of.
fn is_flat(a: DVec3, b: DVec3) -> bool {
    let (a_length, b_length) = (a.length(), b.length());
    a_length < 1e-9 || b_length < 1e-9 || a.cross(b).length() <= 1e-12 * a_length * b_length
}
