//! What objects are made of, made once for all that share it.

use super::GeometryMemory;
use super::looks::Colors;
use super::{particles, shapes, solids};
use durer_geometry::{Mesh, MeshSource, Plan, Primitive};
use durer_math::DAffine3;
use durer_scene::{MeshData, Object, ObjectKind, Particles, Shape, Solid};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// The meshes of a scene, each built once however many objects show it.
pub(super) struct Contents {
    /// In the order in which they first appear.
    meshes: Vec<Arc<Mesh>>,
    /// Where the mesh of some data is in that list, by the data's address.
    indices: HashMap<usize, usize>,
    /// How trees are built.
    plan: Plan,
}

/// A shape of any kind, in its object's space.
pub(super) enum Content<'s> {
    Shape(&'s Shape),
    Mesh(Arc<Mesh>, &'s Arc<MeshData>),
    Particles(Arc<durer_geometry::Particles>, &'s Particles),
    /// Built in its object's space.
    Solid(Box<Primitive>, &'s Solid),
}

/// A scene's mesh as geometry reads it, without a copy.
#[derive(Debug)]
struct Shared(Arc<MeshData>);

impl MeshSource for Shared {
    fn positions(&self) -> &[[f32; 3]] {
        &self.0.positions
    }

    fn triangles(&self) -> &[[u32; 3]] {
        &self.0.triangles
    }

    fn normals(&self) -> &[[f32; 3]] {
        &self.0.normals
    }

    fn uvs(&self) -> &[[f32; 2]] {
        &self.0.uvs
    }

    fn enclosed_volume(&self) -> Option<f64> {
        (self.0.open_edges() == Some(0)).then(|| self.0.volume())
    }
}

impl Contents {
    /// Builds what these objects are made of, with the threads of the current pool.
    pub(super) fn of(objects: &[Object], plan: Plan) -> Contents {
        let (mut indices, mut found) = (HashMap::new(), Vec::new());
        each_mesh(objects, &mut |data| {
            indices.entry(address(data)).or_insert_with(|| {
                found.push(data.clone());
                found.len() - 1
            });
        });
        let build = |data: Arc<MeshData>| Arc::new(Mesh::build(Arc::new(Shared(data)), plan));
        Contents { meshes: found.into_par_iter().map(build).collect(), indices, plan }
    }

    /// Bytes of the meshes, and how many triangles they have.
    pub(super) fn memory(&self) -> GeometryMemory {
        GeometryMemory {
            meshes: self.meshes.iter().map(|mesh| mesh.memory()).sum(),
            triangles: self.meshes.iter().map(|mesh| mesh.source().triangles().len()).sum(),
            ..GeometryMemory::default()
        }
    }

    /// What an object is made of; `None` if there is nothing of it.
    pub(super) fn get<'s>(&self, kind: &'s ObjectKind) -> Option<Content<'s>> {
        match kind {
            ObjectKind::Shape(shape) => Some(Content::Shape(shape)),
            ObjectKind::Mesh(mesh) => {
                let index = *self.indices.get(&address(&mesh.data))?;
                Some(Content::Mesh(self.meshes[index].clone(), &mesh.data))
            }
            ObjectKind::Particles(particles) => (!particles.kind.is_empty())
                .then(|| Content::Particles(Arc::new(particles::build(particles, self.plan)), particles)),
            ObjectKind::Solid(solid) => Some(Content::Solid(Box::new(solids::build(solid, self)), solid)),
            ObjectKind::Group(_) | ObjectKind::Instances(_) | ObjectKind::Import(_) => None,
        }
    }
}

impl Content<'_> {
    /// It, placed in the world.
    pub(super) fn place(&self, world: &DAffine3) -> Primitive {
        match self {
            Content::Shape(shape) => shapes::place(shape, world),
            Content::Mesh(mesh, data) => Primitive::mesh(mesh.clone(), data.origin, world),
            Content::Particles(particles, _) => Primitive::particles(particles.clone(), world),
            Content::Solid(solid, _) => solid.placed(world),
        }
    }

    /// Adds the bytes of particles and solids; meshes may be shared by several objects.
    pub(super) fn add_memory(&self, memory: &mut GeometryMemory) {
        match self {
            Content::Particles(particles, many) => {
                memory.particles += particles.memory();
                memory.particle_count += many.kind.len();
            }
            Content::Solid(solid, _) => memory.solids += solid.shared_memory(),
            Content::Shape(_) | Content::Mesh(..) => {}
        }
    }

    /// True if it has an inside.
    pub(super) fn is_closed(&self) -> bool {
        match self {
            Content::Shape(shape) => shape.is_closed(),
            Content::Mesh(mesh, _) => mesh.is_closed(),
            Content::Particles(_, particles) => particles::are_closed(particles),
            Content::Solid(..) => true,
        }
    }

    /// True if shading has normals of its own.
    pub(super) fn is_smooth(&self) -> bool {
        match self {
            Content::Shape(_) | Content::Particles(..) | Content::Solid(..) => false,
            Content::Mesh(_, data) => !data.normals.is_empty(),
        }
    }

    /// The colours that it brings.
    pub(super) fn colors(&self) -> Colors {
        match self {
            Content::Mesh(_, data) if !data.colors.is_empty() => Colors::Vertices(Arc::clone(data)),
            Content::Particles(_, Particles { colors: Some(colors), .. }) => Colors::Particles(colors.values.clone()),
            Content::Shape(_) | Content::Mesh(..) | Content::Particles(..) | Content::Solid(..) => Colors::None,
        }
    }

    /// The lists of a mesh.
    pub(super) fn mesh_data(&self) -> Option<&MeshData> {
        match self {
            Content::Mesh(_, data) => Some(data),
            Content::Shape(_) | Content::Particles(..) | Content::Solid(..) => None,
        }
    }
}

fn address(data: &Arc<MeshData>) -> usize {
    Arc::as_ptr(data) as usize
}

/// Calls `visit` for the data of all meshes that have triangles.
fn each_mesh<'s>(objects: &'s [Object], visit: &mut impl FnMut(&'s Arc<MeshData>)) {
    for object in objects {
        match &object.kind {
            ObjectKind::Mesh(mesh) if !mesh.data.triangles.is_empty() => visit(&mesh.data),
            ObjectKind::Group(members) => each_mesh(members, visit),
            ObjectKind::Instances(instances) => each_mesh(&instances.objects, visit),
            ObjectKind::Import(import) => each_mesh(&import.objects, visit),
            ObjectKind::Solid(solid) => each_mesh(&solid.operands, visit),
            ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => {}
        }
    }
}
