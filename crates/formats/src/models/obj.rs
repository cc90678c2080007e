//! OBJ, Wavefront's format: lists of places, texture coordinates and normals, and faces that name an entry of each.
//!
//! What the format says of curves, surfaces and smoothing groups is left out; the rest is read in one pass.

mod corners;
#[cfg(test)]
mod tests;

use super::gathered::{Gathered, Triangles, model_of_mesh};
use super::material_library::Library;
use super::polygons::Triangulator;
use super::text::{Cursor, shown};
use super::vertices::{Positions, check_place};
use super::warnings::Warnings;
use super::{FilePlace, Model, ModelError};
use crate::{Assets, Limits};
use corners::{ABSENT, Corner, Corners};
use durer_imaging::linear_from_srgb;
use durer_math::{DVec3, Rgb};
use durer_scene::{MaterialId, MeshPart};
use std::collections::BTreeMap;

/// Reads the mesh in an OBJ file, and the materials that it uses.
///
/// # Errors
///
/// The first thing that is wrong with it. What is wrong with material libraries and images only gives warnings.
pub(super) fn read(file: &str, bytes: &[u8], assets: &dyn Assets, limits: &Limits) -> Result<Model, ModelError> {
    let mut reader = Reader::new(bytes, Library::new(file, assets, limits), limits);
    loop {
        reader.statement()?;
        if !reader.cursor.next_line() {
            break;
        }
    }
    reader.finish(file)
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    /// Where the statement at hand begins.
    start: usize,
    places: Vec<[f64; 3]>,
    /// Colors of places as the file has them; for the first places at least, if for any.
    colors: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    corners: Corners,
    triangles: Triangles,
    triangulator: Triangulator,
    /// The corners of the face at hand as vertices of the mesh, and their places.
    face: Vec<u32>,
    face_places: Vec<DVec3>,
    parts: Vec<Part>,
    /// The name of the last object or group, and the last material.
    name: Option<String>,
    material: Option<u32>,
    material_names: Vec<String>,
    material_numbers: BTreeMap<String, u32>,
    library: Library<'a>,
    warnings: Warnings,
}

/// A run of triangles, up to the next.
struct Part {
    first: u32,
    name: Option<String>,
    material: Option<u32>,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], library: Library<'a>, limits: &Limits) -> Reader<'a> {
        Reader {
            cursor: Cursor::of_lines(bytes),
            start: 0,
            places: Vec::new(),
            colors: Vec::new(),
            uvs: Vec::new(),
            normals: Vec::new(),
            corners: Corners::default(),
            triangles: Triangles::with_capacity(0, limits),
            triangulator: Triangulator::new(bytes.len()),
            face: Vec::new(),
            face_places: Vec::new(),
            parts: Vec::new(),
            name: None,
            material: None,
            material_names: Vec::new(),
            material_numbers: BTreeMap::new(),
            library,
            warnings: Warnings::default(),
        }
    }

    #[inline]
    fn statement(&mut self) -> Result<(), ModelError> {
        self.start = self.cursor.at();
        match self.cursor.word() {
            b"v" => self.place(),
            b"f" | b"fo" => self.face(),
            b"vt" => self.uv(),
            b"vn" => self.normal(),
            b"" => Ok(()),
            other => {
                self.rare_statement(other);
                Ok(())
            }
        }
    }

    fn rare_statement(&mut self, word: &[u8]) {
        match word {
            b"o" | b"g" => {
                // Each part has its own copy, so that a long name could fill all memory.
                let name: String = self.cursor.rest_of_line().chars().take(LONGEST_NAME).collect();
                self.name = (!name.is_empty()).then_some(name);
                self.start_part();
            }
            b"usemtl" => {
                let name = self.cursor.rest_of_line().into_owned();
                self.material = (!name.is_empty()).then(|| self.number_of_material(name));
                self.start_part();
            }
            b"mtllib" => self.open_libraries(),
            // Smoothing groups, and how programs of 1990 were to show things.
            b"s" | b"mg" | b"lod" | b"shadow_obj" | b"trace_obj" | b"bevel" | b"c_interp" | b"d_interp" => {}
            b"l" | b"p" => self.warnings.add("points and lines are left out"),
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" => {
                self.warnings.add("free-form curves and surfaces are left out");
            }
            other => self.warnings.add(format!("`{}` is no statement of an OBJ file; it is left out", shown(other))),
        }
    }

    fn number_of_material(&mut self, name: String) -> u32 {
        if let Some(number) = self.material_numbers.get(&name) {
            return *number;
        }
        let number = self.material_names.len() as u32;
        self.material_numbers.insert(name.clone(), number);
        self.material_names.push(name);
        number
    }

    /// Opens the library, or libraries, that are named: names may have blanks in them, and blanks stand between names.
    fn open_libraries(&mut self) {
        let names = self.cursor.rest_of_line().into_owned();
        let names = names.trim_matches('"');
        if names.contains(char::is_whitespace) && !self.library.has_file(names) {
            names.split_whitespace().for_each(|name| self.library.open(name, &mut self.warnings));
        } else if !names.is_empty() {
            self.library.open(names, &mut self.warnings);
        }
    }

    /// The name or the material changes: what follows is another part.
    fn start_part(&mut self) {
        let part = Part { first: self.triangles.len(), name: self.name.clone(), material: self.material };
        match self.parts.last_mut() {
            // Nothing came since the last change.
            Some(last) if last.first == part.first => *last = part,
            Some(last) if last.name == part.name && last.material == part.material => {}
            _ => self.parts.push(part),
        }
    }

    /// A place: three coordinates, a weight for curves perhaps, and a color perhaps.
    fn place(&mut self) -> Result<(), ModelError> {
        let place = self.numbers()?;
        check_place(place).map_err(|message| self.error(format!("vertex {} at {message}", self.places.len() + 1)))?;
        self.places.push(place);
        let mut more = [0.0; 4];
        let mut count = 0;
        while let (Some(slot), Some(number)) = (more.get_mut(count), self.cursor.number()) {
            *slot = number;
            count += 1;
        }
        if count >= 3 {
            // Three are a color; of four, the last is its alpha.
            self.colors.resize(self.places.len() - 1, MISSING_COLOR);
            self.colors.push([more[0] as f32, more[1] as f32, more[2] as f32]);
        }
        Ok(())
    }

    fn uv(&mut self) -> Result<(), ModelError> {
        // The second is 0 unless it is said, the third is for textures in space.
        let u = self.cursor.number().ok_or_else(|| self.expected_number())?;
        let v = self.cursor.number().unwrap_or(0.0);
        self.uvs.push([u as f32, v as f32]);
        Ok(())
    }

    fn normal(&mut self) -> Result<(), ModelError> {
        let normal = self.numbers()?;
        self.normals.push(normal.map(|x| x as f32));
        Ok(())
    }

    #[inline]
    fn numbers(&mut self) -> Result<[f64; 3], ModelError> {
        let mut numbers = [0.0; 3];
        for number in &mut numbers {
            let Some(next) = self.cursor.number() else { return Err(self.expected_number()) };
            *number = next;
        }
        Ok(numbers)
    }

    fn face(&mut self) -> Result<(), ModelError> {
        self.face.clear();
        loop {
            self.cursor.skip_blanks();
            if self.cursor.is_between_words() {
                break;
            }
            let corner = self.corner()?;
            let vertex = self.corners.vertex(corner);
            let vertex = vertex.ok_or_else(|| self.error("there are more vertices than can be numbered"))?;
            self.face.push(vertex);
        }
        match *self.face {
            [a, b, c] => self.triangles.push([a, b, c]),
            [] | [_] | [_, _] => self.warnings.add("faces with fewer than three corners are left out"),
            _ => self.polygon(),
        }
        self.triangles.within_limit().map_err(|error| error.at(FilePlace::Line(self.cursor.line())))
    }

    fn polygon(&mut self) {
        self.face_places.clear();
        let place_of = |vertex: &u32| DVec3::from_array(self.places[self.corners.get(*vertex).place as usize]);
        self.face_places.extend(self.face.iter().map(place_of));
        let (face, triangles) = (&self.face, &mut self.triangles);
        self.triangulator.cut(&self.face_places, |triangle| triangles.push(triangle.map(|at| face[at])));
    }

    /// A corner, as in `3`, `3/1`, `3//2` or `3/1/2`.
    #[inline]
    fn corner(&mut self) -> Result<Corner, ModelError> {
        let start = self.cursor.at();
        let mut numbers = [None; 3];
        numbers[0] = self.cursor.integer_here();
        if numbers[0].is_some() && self.cursor.skip(b'/') {
            numbers[1] = self.cursor.integer_here();
            if self.cursor.skip(b'/') {
                numbers[2] = self.cursor.integer_here();
            }
        }
        let [Some(place), uv, normal] = numbers else { return Err(self.expected_corner(start)) };
        if !self.cursor.is_between_words() {
            return Err(self.expected_corner(start));
        }
        Ok(Corner {
            place: self.resolve(place, self.places.len(), "vertex")?,
            uv: uv.map_or(Ok(ABSENT), |uv| self.resolve(uv, self.uvs.len(), "texture coordinate"))?,
            normal: normal.map_or(Ok(ABSENT), |normal| self.resolve(normal, self.normals.len(), "normal"))?,
        })
    }

    /// The index, from 0, of an entry that is counted from 1, or backwards from -1, the last before this line.
    #[inline]
    fn resolve(&self, number: i64, count: usize, what: &str) -> Result<u32, ModelError> {
        let index = if number > 0 { number - 1 } else { number + count as i64 };
        if number != 0 && (0..count.min(ABSENT as usize) as i64).contains(&index) {
            Ok(index as u32)
        } else {
            Err(self.no_such_entry(number, count, what))
        }
    }

    #[cold]
    fn no_such_entry(&self, number: i64, count: usize, what: &str) -> ModelError {
        let error = self.error(format!("{what} {number} does not exist: {count} come before this line"));
        if number == 0 { error.help("entries are counted from 1") } else { error }
    }

    #[cold]
    fn expected_corner(&self, start: usize) -> ModelError {
        let mut cursor = self.cursor.clone();
        cursor.go_to(start);
        let word = shown(cursor.word());
        self.error(format!("expected a corner such as `1`, `1/2`, `1//3` or `1/2/3`, not `{word}`"))
    }

    #[cold]
    fn expected_number(&self) -> ModelError {
        match self.cursor.clone().word() {
            [] => self.error("expected a number, but the line ends"),
            word => self.error(format!("expected a number, not `{}`", shown(word))),
        }
    }

    /// An error in the statement at hand.
    fn error(&self, message: impl Into<String>) -> ModelError {
        let mut cursor = self.cursor.clone();
        cursor.go_to(self.start);
        ModelError::new(message).at(FilePlace::Line(cursor.line()))
    }

    fn finish(mut self, file: &str) -> Result<Model, ModelError> {
        if self.triangles.len() == 0 {
            let error = ModelError::new("this file has no faces, so there is nothing to see");
            return Err(error.help("save it with its faces, lines that begin with `f`; curves and lines are not drawn"));
        }
        if self.triangulator.rushed > 0 {
            let rushed = self.triangulator.rushed;
            self.warnings.add(format!("{rushed} faces are too intricate to be cut into triangles well"));
        }
        let parts = self.parts();
        let mesh = Gathered {
            uvs: self.entries(&self.uvs, |corner| corner.uv, [0.0; 2]),
            // What is no normal becomes that of the triangle.
            normals: self.entries(&self.normals, |corner| corner.normal, [0.0; 3]),
            colors: self.vertex_colors(),
            placed: {
                let mut positions = Positions::with_capacity(self.corners.all().len());
                for corner in self.corners.all() {
                    positions.push(self.places[corner.place as usize]).map_err(ModelError::new)?;
                }
                positions.place()
            },
            triangles: self.triangles.into_list(),
            parts,
        };
        let mesh = mesh.into_mesh(&mut self.warnings);
        Ok(model_of_mesh(file, mesh, self.library.scene, self.warnings.into_list()))
    }

    /// For each vertex its entry of a list; nothing if no vertex has one.
    fn entries<T: Copy>(&self, list: &[T], index: impl Fn(&Corner) -> u32, absent: T) -> Vec<T> {
        let indices = || self.corners.all().iter().map(&index);
        if indices().all(|index| index == ABSENT) {
            return Vec::new();
        }
        indices().map(|index| list.get(index as usize).copied().unwrap_or(absent)).collect()
    }

    /// Linear colors of the vertices. Those of files are encoded for screens, as sculpting programs write them; from 0 to
    /// 1, or, which shows by greater numbers, from 0 to 255.
    fn vertex_colors(&self) -> Vec<Rgb> {
        if self.colors.is_empty() {
            return Vec::new();
        }
        let greatest = self.colors.iter().flatten().copied().fold(0.0, f32::max);
        let scale = if greatest > 1.0 { 1.0 / 255.0 } else { 1.0 };
        let color = |corner: &Corner| {
            let color = self.colors.get(corner.place as usize).filter(|color| color[0] >= 0.0);
            color.map_or(Rgb::WHITE, |color| Rgb::from(color.map(|x| linear_from_srgb(x * scale))))
        };
        self.corners.all().iter().map(color).collect()
    }

    /// The parts that have triangles, and a name or a material.
    fn parts(&mut self) -> Vec<MeshPart> {
        let materials = self.materials();
        let ends = self.parts.iter().skip(1).map(|part| part.first).chain([self.triangles.len()]);
        let runs = self.parts.iter().zip(ends);
        let parts = runs.map(|(part, end)| MeshPart {
            name: part.name.clone(),
            first: part.first,
            count: end - part.first,
            material: part.material.and_then(|number| materials[number as usize]),
        });
        parts.filter(|part| part.count > 0 && (part.name.is_some() || part.material.is_some())).collect()
    }

    /// The materials that are used, by number. They are looked for at the end, since their libraries may come late.
    fn materials(&mut self) -> Vec<Option<MaterialId>> {
        let mut is_used = vec![false; self.material_names.len()];
        let ends = self.parts.iter().skip(1).map(|part| part.first).chain([self.triangles.len()]);
        for (part, end) in self.parts.iter().zip(ends) {
            if let Some(number) = part.material.filter(|_| end > part.first) {
                is_used[number as usize] = true;
            }
        }
        let names = self.material_names.iter().zip(is_used);
        names
            .map(|(name, is_used)| if is_used { self.library.material(name, &mut self.warnings) } else { None })
            .collect()
    }
}

/// Characters of the name of a part that are kept.
const LONGEST_NAME: usize = 100;

/// Stands for the color of a place that has none.
const MISSING_COLOR: [f32; 3] = [-1.0; 3];
