//! Objects: shapes and groups of them.

use crate::{Import, Instances, MaterialId, Mesh, Particles, Transform};
use durer_math::{DVec2, DVec3};

/// A shape or a group, placed in its parent's space.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name, for messages and `explain`.
    pub name: Option<String>,
    /// Its material; `None` takes that of the nearest group that has one, or the default material.
    pub material: Option<MaterialId>,
    /// From its own space to its parent's.
    pub transform: Transform,
    /// What it is.
    pub kind: ObjectKind,
}

/// What an object is.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjectKind {
    /// One exact shape.
    Shape(Shape),
    /// Objects that move together.
    Group(Vec<Object>),
    /// A triangle mesh.
    Mesh(Mesh),
    /// Simple shapes by the million.
    Particles(Particles),
    /// Copies of objects.
    Instances(Instances),
    /// What a file of another kind holds.
    Import(Import),
    /// Closed shapes combined to one.
    Solid(Solid),
}

/// Closed objects combined to one solid: constructive solid geometry.
///
/// Each operand is a closed shape, a closed mesh, another solid, or a group of such, which stands for their union. A
/// surface keeps the material of the operand that it comes from; what is inside is that of the solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// How the operands are combined.
    pub operation: Operation,
    /// Two or more objects (one will do).
    pub operands: Vec<Object>,
}

/// The set operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in any of the operands.
    Union,
    /// What is in all of the operands.
    Intersection,
    /// What is in the first operand but in none of the others.
    Difference,
}

impl Operation {
    /// The word for it in scene files and messages.
    pub fn word(self) -> &'static str {
        match self {
            Operation::Union => "union",
            Operation::Intersection => "intersection",
            Operation::Difference => "difference",
        }
    }
}

impl ObjectKind {
    /// The word for this kind in scene files and messages.
    pub fn word(&self) -> &'static str {
        match self {
            ObjectKind::Shape(shape) => shape.word(),
            ObjectKind::Group(_) => "group",
            ObjectKind::Mesh(_) => "mesh",
            ObjectKind::Particles(particles) => particles.kind.word(),
            ObjectKind::Instances(_) => "instances",
            ObjectKind::Import(_) => "import",
            ObjectKind::Solid(solid) => solid.operation.word(),
        }
    }
}

/// The exact shapes, in the object's own space. Closed ones have an inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The infinite plane of the points p with `normal · (p - point) = 0`; its inside is where that is negative.
    Plane {
        /// A point on it.
        point: DVec3,
        /// The direction it faces (any length but zero).
        normal: DVec3,
    },
    /// A ball.
    Sphere {
        /// Its middle.
        center: DVec3,
        /// Its radius, above 0.
        radius: f64,
    },
    /// A box along the axes, between two opposite corners.
    Box {
        /// One corner.
        min: DVec3,
        /// The opposite corner; every coordinate greater than that of `min`.
        max: DVec3,
    },
    /// A cylinder between the middles of its two ends.
    Cylinder {
        /// Middle of one end.
        base: DVec3,
        /// Middle of the other end.
        top: DVec3,
        /// Its radius, above 0.
        radius: f64,
        /// True takes the two caps away.
        open: bool,
    },
    /// A cone, or a frustum if `top_radius` is not 0.
    Cone {
        /// Middle of the base.
        base: DVec3,
        /// The apex, or the middle of the top.
        top: DVec3,
        /// Radius at the base, not negative.
        base_radius: f64,
        /// Radius at the top, not negative; not both radii are 0.
        top_radius: f64,
        /// True takes the caps away.
        open: bool,
    },
    /// A flat disc, or an annulus if `inner_radius` is not 0.
    Disc {
        /// Its middle.
        center: DVec3,
        /// The direction it faces (any length but zero).
        normal: DVec3,
        /// Its radius, above 0.
        radius: f64,
        /// Radius of the hole, from 0 to less than `radius`.
        inner_radius: f64,
    },
    /// The flat rectangle (or parallelogram) of the points `corner + a·edges[0] + b·edges[1]`, a and b from 0 to 1.
    /// It faces the direction `edges[0] × edges[1]`.
    Rectangle {
        /// One corner.
        corner: DVec3,
        /// The two edges that start at that corner.
        edges: [DVec3; 2],
    },
    /// A flat triangle. It faces the side from which its vertices run counter-clockwise.
    Triangle {
        /// Its vertices.
        vertices: [DVec3; 3],
        /// Texture coordinates at the vertices; `None` stands for (0,0), (1,0), (0,1).
        uvs: Option<[DVec2; 3]>,
    },
    /// A ring with a round cross-section.
    Torus {
        /// Its middle.
        center: DVec3,
        /// The direction of its axis of symmetry (any length but zero).
        axis: DVec3,
        /// From the middle to the middle of the tube, above 0.
        radius: f64,
        /// Radius of the tube, above 0 and less than `radius`.
        tube_radius: f64,
    },
}

impl Object {
    /// An object without name, material or transform.
    pub fn new(kind: ObjectKind) -> Object {
        Object { name: None, material: None, transform: Transform::default(), kind }
    }
}

impl Shape {
    /// The word for this kind of shape in scene files and messages.
    pub fn word(&self) -> &'static str {
        match self {
            Shape::Plane { .. } => "plane",
            Shape::Sphere { .. } => "sphere",
            Shape::Box { .. } => "box",
            Shape::Cylinder { .. } => "cylinder",
            Shape::Cone { .. } => "cone",
            Shape::Disc { .. } => "disc",
            Shape::Rectangle { .. } => "rectangle",
            Shape::Triangle { .. } => "triangle",
            Shape::Torus { .. } => "torus",
        }
    }

    /// True for shapes that have an inside.
    pub fn is_closed(&self) -> bool {
        match self {
            Shape::Plane { .. } | Shape::Sphere { .. } | Shape::Box { .. } | Shape::Torus { .. } => true,
            Shape::Cylinder { open, .. } | Shape::Cone { open, .. } => !open,
            Shape::Disc { .. } | Shape::Rectangle { .. } | Shape::Triangle { .. } => false,
        }
    }
}
