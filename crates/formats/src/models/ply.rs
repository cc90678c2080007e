//! PLY, the Stanford polygon format: a header that says what follows, then numbers as text or bytes.

mod header;
mod table;
#[cfg(test)]
mod tests;
mod values;

pub(crate) use table::table;

use super::gathered::{Gathered, Triangles, model_of_mesh, nothing};
use super::polygons::Triangulator;
use super::text::Cursor;
use super::vertices::Positions;
use super::warnings::Warnings;
use super::{Model, ModelError};
use crate::Limits;
use durer_imaging::linear_from_srgb;
use durer_math::{DVec3, Rgb};
use header::{Element, Encoding, Header, NumberType};
use values::{Ascii, Binary, Trouble, Values, error, length, skip};

/// The names that the list of a face's vertices has.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads the mesh in a PLY file.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(super) fn read(file: &str, bytes: &[u8], limits: &Limits) -> Result<Model, ModelError> {
    let header = Header::read(bytes)?;
    match header.encoding {
        Encoding::Ascii => {
            let values = Ascii { bytes, cursor: Cursor::new(bytes, header.end) };
            Reader::new(&header, values, bytes.len(), limits)?.read(file)
        }
        Encoding::LittleEndian => {
            Reader::new(&header, Binary::<false> { bytes, at: header.end }, bytes.len(), limits)?.read(file)
        }
        Encoding::BigEndian => {
            Reader::new(&header, Binary::<true> { bytes, at: header.end }, bytes.len(), limits)?.read(file)
        }
    }
}

/// What a number of a vertex means, as its place in a row: x, y, z; the normal; red, green, blue; u, v; and one for all
/// that means nothing to us.
const NAMES: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["u", "s", "texture_u", "texture_s", "texcoord_u", "u0"],
    &["v", "t", "texture_v", "texture_t", "texcoord_v", "v0"],
];
const NORMAL: usize = 3;
const COLOR: usize = 6;
const UV: usize = 9;
const IGNORED: usize = 11;

/// What the vertices of a file have.
struct Layout {
    /// For each property its place in a row.
    places: Vec<usize>,
    has_normals: bool,
    has_uvs: bool,
    /// The type of the colors, if there are any.
    colors: Option<NumberType>,
}

impl Layout {
    fn of(element: &Element) -> Result<Layout, ModelError> {
        let found = NAMES.map(|names| element.scalar(names));
        if found[..3].contains(&None) {
            let error = ModelError::new("the vertices of this file lack a property x, y or z");
            return Err(error.at(super::FilePlace::Line(element.line)));
        }
        let mut places = vec![IGNORED; element.properties.len()];
        for (place, property) in found.iter().enumerate() {
            if let Some(property) = property {
                places[*property] = place;
            }
        }
        let has = |from: usize, to: usize| found[from..to].iter().all(Option::is_some);
        let colors = found[COLOR].filter(|_| has(COLOR, UV)).map(|red| element.properties[red].kind);
        Ok(Layout { places, has_normals: has(NORMAL, COLOR), has_uvs: has(UV, IGNORED), colors })
    }
}

struct Reader<'h, V> {
    header: &'h Header,
    values: V,
    vertices: &'h Element,
    layout: Layout,
    positions: Positions,
    mesh: Gathered,
    triangles: Triangles,
    triangulator: Triangulator,
    /// Faces with fewer than three corners.
    too_few: u64,
    /// The vertices of the face at hand, and their places.
    corners: Vec<u32>,
    places: Vec<DVec3>,
    warnings: Warnings,
}

impl<'h, V: Values> Reader<'h, V> {
    fn new(header: &'h Header, values: V, bytes: usize, limits: &'h Limits) -> Result<Self, ModelError> {
        let vertices = header.elements.iter().find(|element| element.name == "vertex");
        let vertices = vertices.ok_or_else(|| ModelError::new("there is no element `vertex` in this file"))?;
        if vertices.count > u64::from(u32::MAX) {
            return Err(ModelError::new(format!("{} vertices are more than can be numbered", vertices.count)));
        }
        let layout = Layout::of(vertices)?;
        // What the file holds was compared to its length with the header.
        let count = vertices.count as usize;
        let mut mesh = Gathered::default();
        mesh.normals.reserve(if layout.has_normals { count } else { 0 });
        mesh.uvs.reserve(if layout.has_uvs { count } else { 0 });
        mesh.colors.reserve(if layout.colors.is_some() { count } else { 0 });
        let faces = header.elements.iter().filter(|element| element.list(&INDICES).is_some());
        // Three corners take four bytes at least.
        let faces = faces.map(|element| element.count).max().unwrap_or(0).min(bytes as u64 / 4);
        Ok(Reader {
            header,
            values,
            vertices,
            layout,
            positions: Positions::with_capacity(count),
            mesh,
            triangles: Triangles::with_capacity(faces as usize, limits),
            triangulator: Triangulator::new(bytes),
            too_few: 0,
            corners: Vec::new(),
            places: Vec::new(),
            warnings: Warnings::default(),
        })
    }

    fn read(mut self, file: &str) -> Result<Model, ModelError> {
        self.read_elements()?;
        if self.triangles.len() == 0 {
            let error = ModelError::new("this file has no faces, so there is nothing to see");
            return Err(error.help("points without faces can be shown as particles: `spheres`"));
        }
        if self.too_few > 0 {
            self.warnings.add(format!("{} faces have fewer than three corners; they are left out", self.too_few));
        }
        if self.triangulator.rushed > 0 {
            let rushed = self.triangulator.rushed;
            self.warnings.add(format!("{rushed} faces are too intricate to be cut into triangles well"));
        }
        let mesh = Gathered { placed: self.positions.place(), triangles: self.triangles.into_list(), ..self.mesh };
        let mesh = mesh.into_mesh(&mut self.warnings);
        Ok(model_of_mesh(file, mesh, nothing(), self.warnings.into_list()))
    }

    /// Reads vertices and faces in the order of the file; but faces that stand before the vertices after them, since
    /// to cut polygons takes the places of their corners.
    fn read_elements(&mut self) -> Result<(), ModelError> {
        let mut early = Vec::new();
        let mut has_vertices = false;
        for element in &self.header.elements {
            let is_face = element.list(&INDICES).is_some();
            if std::ptr::eq(element, self.vertices) {
                self.read_vertices()?;
                has_vertices = true;
            } else if is_face && has_vertices {
                self.read_faces(element)?;
            } else {
                if is_face {
                    early.push((self.values.at(), element));
                }
                self.note_what_is_lost(element);
                skip(&mut self.values, element)?;
            }
        }
        for (at, element) in early {
            self.values.go_to(at);
            self.read_faces(element)?;
        }
        Ok(())
    }

    fn note_what_is_lost(&mut self, element: &Element) {
        if element.name == "face" && element.list(&["texcoord"]).is_some() {
            self.warnings.add("texture coordinates of the corners of faces (`texcoord`) are left out");
        }
    }

    fn read_vertices(&mut self) -> Result<(), ModelError> {
        let element = self.vertices;
        let srgb: Vec<f32> = (0..=255_u8).map(|byte| linear_from_srgb(f32::from(byte) / 255.0)).collect();
        let mut row = [0.0; IGNORED + 1];
        for index in 0..element.count {
            let start = self.values.at();
            self.read_row(&mut row).map_err(|trouble| error(&mut self.values, trouble, element, index))?;
            let [x, y, z, nx, ny, nz, red, green, blue, u, v, _] = row;
            self.positions.push([x, y, z]).map_err(|message| {
                ModelError::new(format!("vertex {index} at {message}")).at(self.values.place(start))
            })?;
            if self.layout.has_normals {
                self.mesh.normals.push([nx as f32, ny as f32, nz as f32]);
            }
            if self.layout.has_uvs {
                self.mesh.uvs.push([u as f32, v as f32]);
            }
            if let Some(kind) = self.layout.colors {
                self.mesh.colors.push(color(kind, [red, green, blue], &srgb));
            }
        }
        Ok(())
    }

    #[inline]
    fn read_row(&mut self, row: &mut [f64; IGNORED + 1]) -> Result<(), Trouble> {
        for (property, place) in self.vertices.properties.iter().zip(&self.layout.places) {
            match property.length {
                None => row[*place] = self.values.next(property.kind)?,
                Some(kind) => {
                    let count = length(&mut self.values, kind, property.kind)?;
                    self.values.skip(property.kind, count)?;
                }
            }
        }
        Ok(())
    }

    fn read_faces(&mut self, element: &Element) -> Result<(), ModelError> {
        self.note_what_is_lost(element);
        let list = element.list(&INDICES);
        let is_strip = element.name.starts_with("tristrip");
        for index in 0..element.count {
            for (at, property) in element.properties.iter().enumerate() {
                let start = self.values.at();
                let done = match property.length {
                    None => self.values.skip(property.kind, 1),
                    Some(kind) => length(&mut self.values, kind, property.kind).and_then(|count| {
                        if list == Some(at) {
                            self.read_corners(property.kind, count)
                        } else {
                            self.values.skip(property.kind, count)
                        }
                    }),
                };
                done.map_err(|trouble| error(&mut self.values, trouble, element, index))?;
                if list == Some(at) {
                    self.add_face(is_strip).map_err(|vertex| {
                        let count = self.vertices.count;
                        let message = format!("{} {index} has a vertex {vertex}", element.name);
                        let message = format!("{message}, but vertices are numbered from 0 to {}", count.max(1) - 1);
                        ModelError::new(message).at(self.values.place(start))
                    })?;
                }
            }
            self.triangles.within_limit()?;
        }
        Ok(())
    }

    /// Reads the vertices of a face; what is none becomes one that does not exist.
    #[inline]
    fn read_corners(&mut self, kind: NumberType, count: u64) -> Result<(), Trouble> {
        self.corners.clear();
        for _ in 0..count {
            let index = self.values.next(kind)?;
            let whole = index as u32;
            self.corners.push(if f64::from(whole) == index { whole } else { NONE });
        }
        Ok(())
    }

    /// Adds the face whose corners have been read. Gives the vertex that does not exist, if one does not.
    #[inline]
    fn add_face(&mut self, is_strip: bool) -> Result<(), String> {
        let count = self.vertices.count as u32;
        if is_strip {
            return self.add_strip(count);
        }
        if let Some(wrong) = self.corners.iter().find(|vertex| **vertex >= count) {
            return Err(name_of(*wrong));
        }
        match *self.corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [] | [_] | [_, _] => self.too_few += 1,
            _ => {
                self.places.clear();
                self.places.extend(self.corners.iter().map(|vertex| self.positions.get(*vertex as usize)));
                let (corners, triangles) = (&self.corners, &mut self.triangles);
                self.triangulator.cut(&self.places, |triangle| triangles.push(triangle.map(|at| corners[at])));
            }
        }
        Ok(())
    }

    /// Adds a strip: each vertex makes a triangle with the two before it, in turn one way round and the other; -1 starts
    /// another strip. Triangles with a vertex twice only serve to turn the strip.
    fn add_strip(&mut self, count: u32) -> Result<(), String> {
        for strip in self.corners.split(|vertex| *vertex == NONE) {
            if let Some(wrong) = strip.iter().find(|vertex| **vertex >= count) {
                return Err(name_of(*wrong));
            }
            for (at, triangle) in strip.windows(3).enumerate() {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
                if a != b && b != c && a != c {
                    self.triangles.push(if at % 2 == 0 { [a, b, c] } else { [b, a, c] });
                }
            }
        }
        Ok(())
    }
}

/// Stands for a number that is no vertex; there are never so many.
const NONE: u32 = u32::MAX;

fn name_of(vertex: u32) -> String {
    if vertex == NONE { "that is no whole number from 0 on".to_owned() } else { vertex.to_string() }
}

/// A color of this type: whole numbers are encoded for screens, others linear.
#[inline]
fn color(kind: NumberType, components: [f64; 3], srgb: &[f32]) -> Rgb {
    let [r, g, b] = match (kind, kind.greatest()) {
        (NumberType::U8, _) => components.map(|x| srgb[usize::from(x as u8)]),
        (_, Some(greatest)) => components.map(|x| linear_from_srgb((x / greatest) as f32)),
        (_, None) => components.map(|x| x as f32),
    };
    Rgb::new(r, g, b)
}
