//! From the shapes of a scene to those of geometry.

use durer_geometry::Primitive;
use durer_math::{DAffine3, DVec2};
use durer_scene::Shape;

/// The shape as geometry knows it, in the world.
pub(super) fn place(shape: &Shape, world: &DAffine3) -> Primitive {
    match *shape {
        Shape::Plane { point, normal } => Primitive::plane(point, normal, world),
        Shape::Sphere { center, radius } => Primitive::sphere(center, radius, world),
        Shape::Box { min, max } => Primitive::cuboid(min, max, world),
        Shape::Cylinder { base, top, radius, open } => Primitive::cylinder(base, top, radius, open, world),
        Shape::Cone { base, top, base_radius, top_radius, open } => {
            Primitive::cone(base, top, [base_radius, top_radius], open, world)
        }
        Shape::Disc { center, normal, radius, inner_radius } => {
            Primitive::disc(center, normal, [inner_radius, radius], world)
        }
        Shape::Rectangle { corner, edges } => Primitive::rectangle(corner, edges, world),
        Shape::Triangle { vertices, uvs } => {
            Primitive::triangle(vertices, uvs.unwrap_or([DVec2::ZERO, DVec2::X, DVec2::Y]), world)
        }
        Shape::Torus { center, axis, radius, tube_radius } => {
            Primitive::torus(center, axis, [radius, tube_radius], world)
        }
    }
}
