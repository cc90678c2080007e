//! Triangle meshes.

use crate::MaterialId;
use durer_math::{DVec3, Rgb};
use std::sync::Arc;

/// A mesh, and where it came from. Copies share its data; so do all objects that name the same file.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The file that holds it; `None` if the scene file lists it itself.
    pub file: Option<String>,
    /// How it is shaded. `data` has the normals, or none, that follow from this.
    pub normals: MeshNormals,
    /// Vertices and triangles.
    pub data: Arc<MeshData>,
}

/// What normals a mesh is shaded with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeshNormals {
    /// Those of the file; flat triangles if it has none.
    #[default]
    File,
    /// Those of the file; if it has none, the mean of the triangles around each vertex, weighted by their angles.
    Smooth,
    /// Flat triangles.
    Flat,
}

/// Triangles that share vertices.
///
/// Coordinates are single-precision offsets from a double-precision point, so that meshes far from the origin lose
/// nothing. Every triangle names vertices that exist; `normals`, `uvs` and `colors` are empty or have one entry for each
/// vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// What all positions are relative to, in the object's space.
    pub origin: DVec3,
    /// The vertices.
    pub positions: Vec<[f32; 3]>,
    /// Three vertices each; counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Shading normals, of any length but zero.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; v grows upwards.
    pub uvs: Vec<[f32; 2]>,
    /// Linear colours. They take the place of a material's plain colour, and multiply its texture.
    pub colors: Vec<Rgb>,
    /// Runs of triangles with a material or a name of their own, in order and without overlap.
    pub parts: Vec<MeshPart>,
}

/// A run of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshPart {
    /// Its name in the file.
    pub name: Option<String>,
    /// Its first triangle.
    pub first: u32,
    /// Number of triangles.
    pub count: u32,
    /// Its material; the object's own, if it has one, overrides it, and it overrides that of the groups around.
    pub material: Option<MaterialId>,
}

/// A file with objects of its own: a model, with the cameras and lights in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The file.
    pub file: String,
    /// What it holds, in the space of the importing object. Its materials and textures are in the scene's lists, without
    /// names.
    pub objects: Vec<crate::Object>,
    /// Its lights, in the same space; they shine beside those of the scene.
    pub lights: Vec<crate::Light>,
    /// Its first camera, in the same space; used if the scene has none.
    pub camera: Option<crate::Camera>,
}
