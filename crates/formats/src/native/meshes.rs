//! Triangle meshes: from a model file, or written out.

use super::decode::{Decoder, Fields};
use super::models;
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, choice_value, fields, record, record_value};
use super::tree::{Node, NodeKind};
use super::value::{Item, Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use crate::models::shade;
use durer_math::{DVec3, Rgb};
use durer_scene::{MaterialId, Mesh, MeshData, MeshNormals, MeshPart};
use serde_json::{Value as Json, json};
use std::rc::Rc;
use std::sync::Arc;

choice! { MeshNormals, "kind of normals";
    File "file": "Those of the file, or `vertex_normals`; flat triangles if there are none.", example "normals: file", {}
    Smooth "smooth": "The same; if there are none, the mean of the triangles around each vertex.", example "normals: smooth", {}
    Flat "flat": "Flat triangles.", example "normals: flat", {}
}
choice_value!(MeshNormals, MeshNormals::File);

/// A mesh as a scene file says it.
pub(crate) struct Written {
    file: Option<String>,
    normals: MeshNormals,
    origin: Option<DVec3>,
    vertices: Option<Vertices>,
    triangles: Option<Vec<[u32; 3]>>,
    vertex_normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    colors: Vec<Rgb>,
    parts: Vec<MeshPart>,
}

record!(Written {
    file: Option<String> = None => "A model file that holds one mesh: .obj, .ply, .stl, .gltf or .glb. Use `import` for one that holds more.";
    normals: MeshNormals = MeshNormals::File => "What normals it is shaded with.";
    vertices: Option<Vertices> = None => "Without `file`: the vertices, kept in single precision.";
    origin: Option<DVec3> = None => "What `vertices` are relative to. Without it, they are kept relative to their middle if they lie far from zero.";
    triangles: Option<Vec<[u32; 3]>> = None => "Three vertices each, by their numbers from 0; counter-clockwise seen from the front.";
    vertex_normals: Vec<[f32; 3]> = Vec::new() => "A normal for each vertex, of any length but zero.";
    uvs: Vec<[f32; 2]> = Vec::new() => "Texture coordinates for each vertex.";
    colors: Vec<Rgb> = Vec::new() => "A color for each vertex. They take the place of the color of the material.";
    parts: Vec<MeshPart> = Vec::new() => "Runs of triangles with materials of their own, in order.";
});

record!(MeshPart {
    name: Option<String> = None => "A name, for messages.";
    first: u32 => "Its first triangle, from 0.";
    count: u32 => "Number of triangles.";
    material: Option<MaterialId> = None => "Its material; the mesh's own, if it has one, overrides it.";
});
record_value!(MeshPart, "a part", MeshPart { name: None, first: 0, count: 0, material: None });

impl Item for MeshPart {
    const PLURAL: &'static str = "parts";
}

/// Vertices in both precisions: to go through double precision would round some of them twice.
#[derive(Clone, Debug, Default, PartialEq)]
struct Vertices {
    narrow: Vec<[f32; 3]>,
    /// Empty if they are to be written.
    wide: Vec<DVec3>,
}

impl Value for Vertices {
    fn noun() -> String {
        Vec::<DVec3>::noun()
    }
    fn stand_in() -> Self {
        Vertices::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let wide = Vec::<DVec3>::decode(node, cx)?;
        let NodeKind::Sequence(items) = &node.kind else { return None };
        let narrow = items.iter().zip(&wide).map(|(item, wide)| narrow(item, *wide)).collect();
        Some(Vertices { narrow, wide })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        self.narrow.encode(writer)
    }
    fn schema() -> Json {
        json!({ "type": "array", "items": DVec3::schema() })
    }
    fn advice(node: &Node) -> Option<String> {
        Vec::<DVec3>::advice(node)
    }
}

/// A vertex, straight to single precision.
fn narrow(node: &Node, wide: DVec3) -> [f32; 3] {
    let mut vertex = wide.to_array().map(|x| x as f32);
    if let NodeKind::Sequence(items) = &node.kind {
        for (slot, item) in vertex.iter_mut().zip(items) {
            *slot = number_text(item).and_then(|text| text.parse().ok()).unwrap_or(*slot);
        }
    }
    vertex
}

/// What vertices are kept relative to: zero, unless they lie so far from it that single precision would be too coarse.
fn origin_of(vertices: &[DVec3]) -> DVec3 {
    let low = vertices.iter().fold(DVec3::INFINITY, |low, vertex| low.min(*vertex));
    let high = vertices.iter().fold(DVec3::NEG_INFINITY, |high, vertex| high.max(*vertex));
    let farthest = low.abs().max(high.abs()).max_element();
    if vertices.is_empty() || farthest <= 64.0 * (high - low).max_element() {
        return DVec3::ZERO;
    }
    // In single precision itself, so that to add it back is exact.
    DVec3::from_array(((low + high) * 0.5).to_array().map(|x| f64::from(x as f32)))
}

/// The fields that only a mesh without file has.
const INLINE: [&str; 7] = ["vertices", "origin", "triangles", "vertex_normals", "uvs", "colors", "parts"];

impl Written {
    /// The mesh, with what a file has.
    pub(crate) fn resolve(self, from: &mut Fields<'_, '_, '_>) -> Mesh {
        let normals = self.normals;
        if let Some(file) = &self.file {
            if let Some(key) = INLINE.into_iter().find(|key| from.has(key)) {
                let message = format!("`file` and `{key}` contradict each other");
                let complaint =
                    Complaint::error(from.span_of(key), message).help("a mesh is in a file, or written out");
                from.break_with(complaint.also(from.span_of("file"), "the file"));
            }
            let data = models::mesh(file, normals, from.span_of("file"), from.cx).unwrap_or_else(|| {
                from.doubt();
                Arc::default()
            });
            return Mesh { file: self.file, normals, data };
        }
        for key in ["vertices", "triangles"] {
            if !from.has(key) {
                from.lack(&format!("`{key}`, or `file`"));
                break;
            }
        }
        Mesh { file: None, normals, data: Arc::new(self.into_data()) }
    }

    fn into_data(self) -> MeshData {
        let Written { vertices, triangles, uvs, colors, parts, .. } = self;
        let (Vertices { narrow, wide }, triangles) = (vertices.unwrap_or_default(), triangles.unwrap_or_default());
        let chosen = origin_of(&wide);
        let is_relative = self.origin.is_none() && chosen != DVec3::ZERO;
        let offset = |vertex: &DVec3| (*vertex - chosen).to_array().map(|x| x as f32);
        let positions = if is_relative { wide.iter().map(offset).collect() } else { narrow };
        let origin = self.origin.unwrap_or(chosen);
        let count = positions.len();
        let mut data = MeshData { origin, positions, triangles, normals: self.vertex_normals, uvs, colors, parts };
        // The check says what is wrong with others.
        if data.triangles.as_flattened().iter().all(|vertex| (*vertex as usize) < count) {
            shade(&mut data, self.normals);
        }
        data
    }
}

impl From<&Mesh> for Written {
    fn from(mesh: &Mesh) -> Written {
        let is_written = mesh.file.is_none();
        let data = if is_written { MeshData::clone(&mesh.data) } else { MeshData::default() };
        let MeshData { origin, positions, triangles, normals, uvs, colors, parts } = data;
        let wide: Vec<DVec3> = positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        let is_chosen = origin == DVec3::ZERO && origin_of(&wide) == DVec3::ZERO;
        Written {
            file: mesh.file.clone(),
            normals: mesh.normals,
            origin: (!is_chosen).then_some(origin),
            vertices: is_written.then_some(Vertices { narrow: positions, wide: Vec::new() }),
            triangles: is_written.then_some(triangles),
            vertex_normals: normals,
            uvs,
            colors,
            parts,
        }
    }
}
