//! What the readers of meshes gather: triangles in parts, up to the limit, and the mesh that comes of them.

use super::normals::mend;
use super::vertices::Placed;
use super::warnings::Warnings;
use super::{Model, ModelError};
use crate::{Exceeded, Limit, Limits};
use durer_math::Rgb;
use durer_scene::{Mesh, MeshData, MeshNormals, MeshPart, Object, ObjectKind, Scene};
use std::sync::Arc;

/// Triangles, and how many there may be.
#[derive(Clone, Debug)]
pub(crate) struct Triangles {
    list: Vec<[u32; 3]>,
    most: u64,
    refused: bool,
}

impl Triangles {
    /// None yet, and room for this many.
    pub(crate) fn with_capacity(count: usize, limits: &Limits) -> Triangles {
        // Parts count triangles in 32 bits.
        let most = limits.max_primitives.min(u64::from(u32::MAX));
        Triangles { list: Vec::with_capacity(count.min(most as usize)), most, refused: false }
    }

    /// Adds one, unless there are too many; then [`within_limit`](Triangles::within_limit) tells.
    #[inline]
    pub(crate) fn push(&mut self, triangle: [u32; 3]) {
        if (self.list.len() as u64) < self.most {
            self.list.push(triangle);
        } else {
            self.refused = true;
        }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> u32 {
        self.list.len() as u32
    }

    /// All of them.
    pub(crate) fn into_list(self) -> Vec<[u32; 3]> {
        self.list
    }

    /// # Errors
    ///
    /// If there were more than allowed.
    #[inline]
    pub(crate) fn within_limit(&self) -> Result<(), ModelError> {
        if self.refused { Err(too_many_triangles(self.most)) } else { Ok(()) }
    }
}

/// Complains about more triangles than allowed.
pub(crate) fn too_many_triangles(most: u64) -> ModelError {
    let exceeded = Exceeded { limit: Limit::Primitives, asked: None, allowed: most };
    ModelError::new(format!("there are more than {most} triangles")).help(exceeded.help())
}

/// A mesh whose vertices have all been read.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    pub(super) placed: Placed,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) colors: Vec<Rgb>,
    pub(super) parts: Vec<MeshPart>,
}

impl Gathered {
    /// The mesh, with what files say badly set right.
    pub(super) fn into_mesh(self, warnings: &mut Warnings) -> MeshData {
        let Gathered { placed: Placed { origin, positions }, triangles, normals, uvs, colors, parts } = self;
        let mut mesh = MeshData { origin, positions, triangles, normals, uvs, colors, parts };
        mend(&mut mesh);
        let wrong = mesh.uvs.iter_mut().filter(|uv| !uv.iter().all(|x| x.abs() <= LARGEST_UV));
        let wrong = wrong.map(|uv| *uv = [0.0; 2]).count();
        if wrong > 0 {
            warnings.add(format!("{wrong} texture coordinates are not numbers of usable size; they became 0"));
        }
        mesh.colors.iter_mut().for_each(|color| *color = color.map(part));
        mesh
    }
}

/// The largest texture coordinate, as for triangles of scene files.
const LARGEST_UV: f32 = 1e6;

/// A component of a color that is given back: from 0 to 1.
pub(super) fn part(component: f32) -> f32 {
    // NaN is not greater than anything.
    if component > 0.0 { component.min(1.0) } else { 0.0 }
}

/// A model that is one mesh.
pub(super) fn model_of_mesh(file: &str, mesh: MeshData, scene: Scene, warnings: Vec<String>) -> Model {
    let mesh = Mesh { file: Some(file.to_owned()), normals: MeshNormals::File, data: Arc::new(mesh) };
    let objects = vec![Object::new(ObjectKind::Mesh(mesh))];
    Model { scene: Scene { objects, ..scene }, warnings }
}

/// A scene with nothing in it, not even light.
pub(super) fn nothing() -> Scene {
    Scene { lights: Vec::new(), ..Scene::default() }
}
