//! Meshes, particles and solids.

use super::{Maker, Temper};
use durer::math::{DVec3, Rgb};
use durer::scene::{
    Data, Mesh, MeshData, MeshNormals, MeshPart, Object, ObjectKind, Operation, ParticleKind, Particles, Shape, Sizes,
    Solid,
};
use std::sync::Arc;

/// How deep solids nest.
const DEEPEST: usize = 4;

impl Maker<'_, '_> {
    /// A single-precision coordinate.
    fn offset(&mut self) -> f32 {
        self.number().clamp(-1e12, 1e12) as f32
    }

    fn offsets(&mut self) -> [f32; 3] {
        [self.offset(), self.offset(), self.offset()]
    }

    /// Triangles between vertices, both at random.
    pub(super) fn mesh(&mut self) -> Mesh {
        let positions = self.some(6, Self::offsets);
        let count = positions.len();
        let fields = self.dice.byte();
        let each = |bit: u8| if fields >> bit & 1 == 1 { count } else { 0 };
        let normals = (0..each(0)).map(|_| self.direction().as_vec3().to_array()).collect();
        let uvs = (0..each(1)).map(|_| [self.offset(), self.offset()].map(|x| x.clamp(-1e6, 1e6))).collect();
        let colors = (0..each(2)).map(|_| self.color()).collect();
        let vertex = |maker: &mut Self| maker.dice.below(count) as u32;
        let triangles = match self.temper {
            // No triangle twice.
            Temper::Everyday => (2..count as u32).map(|at| [at - 2, at - 1, at]).collect(),
            Temper::Extreme => self.some(8, |maker| [vertex(maker), vertex(maker), vertex(maker)]),
        };
        let parts = match self.dice.one_in(3) {
            true if !triangles.is_empty() => {
                vec![MeshPart { name: None, first: 0, count: 1, material: self.option(Maker::material_id) }]
            }
            true | false => Vec::new(),
        };
        let origin = if self.dice.one_in(4) { self.point() } else { DVec3::ZERO };
        let data = MeshData { origin, positions, triangles, normals, uvs, colors, parts };
        Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) }
    }

    /// A tetrahedron of vertices at random, inside out or not.
    fn closed_mesh(&mut self) -> Mesh {
        let positions = (0..4).map(|_| self.offsets()).collect();
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let data = MeshData { positions, triangles, ..MeshData::default() };
        Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) }
    }

    pub(super) fn particles(&mut self) -> Particles {
        let bases = self.some(9, Maker::point);
        let count = bases.len();
        let tops: Vec<DVec3> = bases.iter().map(|base| *base + self.direction()).collect();
        let (bases, tops) = (Data::inline(bases), Data::inline(tops));
        let (radii, open) = (self.sizes(count), self.dice.one_in(2));
        let kind = match self.dice.below(4) {
            0 => ParticleKind::Spheres { centers: bases, radii },
            1 => ParticleKind::Cylinders { bases, tops, radii, open },
            2 => {
                let top_radii = if self.dice.one_in(2) { Sizes::Same(0.0) } else { self.sizes(count) };
                ParticleKind::Cones { bases, tops, radii, top_radii, open }
            }
            _ => ParticleKind::Capsules { bases, tops, radii },
        };
        let colors = self.option(|maker| Data::inline((0..count).map(|_| maker.color()).collect::<Vec<Rgb>>()));
        Particles { file: None, kind, colors }
    }

    fn sizes(&mut self, count: usize) -> Sizes {
        match self.dice.one_in(2) {
            true => Sizes::Same(self.size()),
            false => Sizes::Each(Data::inline((0..count).map(|_| self.size()).collect::<Vec<_>>())),
        }
    }

    pub(super) fn solid(&mut self, depth: usize) -> Solid {
        let operation = self.dice.one_of(&[Operation::Union, Operation::Intersection, Operation::Difference]);
        Solid { operation, operands: self.some(3, |maker| maker.operand(depth + 1)) }
    }

    fn operand(&mut self, depth: usize) -> Object {
        let deep = depth < DEEPEST;
        let kind = match self.dice.below(8) {
            5 => ObjectKind::Mesh(self.closed_mesh()),
            6 if deep => ObjectKind::Group(self.some(2, |maker| maker.operand(depth + 1))),
            7 if deep => ObjectKind::Solid(self.solid(depth)),
            _ => ObjectKind::Shape(self.closed_shape()),
        };
        let mut placed = self.placed(kind);
        // The very same place again, so that surfaces coincide.
        if self.temper == Temper::Extreme && self.dice.one_in(4) {
            placed.transform.steps.clear();
        }
        placed
    }

    fn closed_shape(&mut self) -> Shape {
        match self.shape() {
            Shape::Cylinder { base, top, radius, open: _ } => Shape::Cylinder { base, top, radius, open: false },
            Shape::Cone { base, top, base_radius, top_radius, open: _ } => {
                Shape::Cone { base, top, base_radius, top_radius, open: false }
            }
            Shape::Disc { center, radius, .. } => Shape::Sphere { center, radius },
            Shape::Rectangle { corner, edges: [a, b] } => {
                let size = DVec3::new(a.x, a.x.min(b.z), b.z);
                Shape::Box { min: corner, max: corner + size }
            }
            Shape::Triangle { vertices: [a, ..], .. } => Shape::Plane { point: a, normal: self.direction() },
            closed @ (Shape::Plane { .. } | Shape::Sphere { .. } | Shape::Box { .. } | Shape::Torus { .. }) => closed,
        }
    }
}
