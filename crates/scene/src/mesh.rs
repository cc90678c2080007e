//! Triangle meshes.

use crate::MaterialId;
use durer_math::{DVec3, Rgb};
use std::collections::HashMap;
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

impl MeshData {
    /// The most triangles of one mesh.
    pub const MOST_TRIANGLES: usize = 1 << 28;

    /// How many edges do not join two triangles that run along them in opposite directions; with none the mesh has an inside.
    /// `None` if no triangle has an area.
    ///
    /// Corners at the same place count as one, whatever their numbers are; triangles without area do not count.
    pub fn open_edges(&self) -> Option<usize> {
        let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
        // Adding 0 makes -0 and 0 the same.
        let mut number = |position: [f32; 3]| {
            let next = numbers.len() as u32;
            *numbers.entry(position.map(|x| (x + 0.0).to_bits())).or_insert(next)
        };
        let places: Vec<u32> = self.positions.iter().map(|&position| number(position)).collect();
        let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| places[vertex as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *edges.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { -1 };
            }
        }
        #[expect(clippy::disallowed_methods, reason = "a count is the same in any order")]
        (!edges.is_empty()).then(|| edges.values().filter(|&&balance| balance != 0).count())
    }

    /// The volume inside, if the mesh has one; negative if its triangles face inward.
    pub fn volume(&self) -> f64 {
        let corner = |vertex: u32| DVec3::from(self.positions[vertex as usize].map(f64::from));
        let sixfold = |&[a, b, c]: &[u32; 3]| corner(a).dot(corner(b).cross(corner(c)));
        self.triangles.iter().map(sixfold).sum::<f64>() / 6.0
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron whose corners are listed once for each triangle.
    fn tetrahedron() -> MeshData {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let positions = faces.iter().flatten().map(|&corner: &usize| corners[corner]).collect();
        let triangles = (0..4).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        MeshData { positions, triangles, ..MeshData::default() }
    }

    #[test]
    fn edges_are_open_at_holes_and_along_flipped_triangles() {
        let whole = tetrahedron();
        assert_eq!(whole.open_edges(), Some(0));
        let holed = MeshData { triangles: whole.triangles[1..].to_vec(), ..whole.clone() };
        assert_eq!(holed.open_edges(), Some(3));
        let mut flipped = whole.clone();
        flipped.triangles[2].swap(0, 1);
        assert_eq!(flipped.open_edges(), Some(3));
        let mut with_needle = whole.clone();
        with_needle.triangles.push([0, 0, 1]);
        assert_eq!(with_needle.open_edges(), Some(0));
        assert_eq!(MeshData { triangles: vec![[0, 0, 1]], ..whole }.open_edges(), None);
        assert_eq!(MeshData::default().open_edges(), None);
        let mut turned = tetrahedron();
        turned.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert_eq!((tetrahedron().volume(), turned.volume()), (1.0 / 6.0, -1.0 / 6.0));
    }
}
