//! STL, the format of stereolithography: triangles without any connection, as text or bytes.
//!
//! The normals in it are ignored. Many programs write none or wrong ones; the order of the corners decides.

#[cfg(test)]
mod tests;

use super::gathered::{Gathered, Triangles, model_of_mesh, nothing};
use super::polygons::Triangulator;
use super::text::{Cursor, line_of, shown};
use super::vertices::{Distinct, Key, Positions, bits_of, check_place};
use super::warnings::Warnings;
use super::{FilePlace, Model, ModelError};
use crate::Limits;
use durer_math::DVec3;
use durer_scene::MeshPart;

/// Bytes before the first triangle of a binary file: 80 that mean nothing, and the count.
const HEADER: usize = 84;
/// Bytes of a triangle: a normal, three corners, and two that mean nothing.
const FACET: usize = 50;

/// True if bytes are, by all appearance, an STL file.
pub(super) fn looks_like_it(bytes: &[u8]) -> bool {
    is_text(bytes) || count(bytes).is_some_and(|count| Some(bytes.len()) == length(count))
}

/// Reads the mesh in an STL file.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(super) fn read(file: &str, bytes: &[u8], limits: &Limits) -> Result<Model, ModelError> {
    // The header of a binary file may begin with `solid` too; but then its length fits its count.
    let fits = count(bytes).is_some_and(|count| Some(bytes.len()) == length(count));
    if is_text(bytes) && !fits { read_text(file, bytes, limits) } else { read_binary(file, bytes, limits) }
}

/// True for text that begins as STL files do.
fn is_text(bytes: &[u8]) -> bool {
    let mut cursor = Cursor::new(bytes, 0);
    let has_word = cursor.word_of_text().eq_ignore_ascii_case(b"solid");
    has_word && !bytes[..bytes.len().min(HEADER)].contains(&0)
}

/// The number of triangles that the header of a binary file counts.
fn count(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(HEADER - 4..)?.first_chunk()?))
}

/// The length of a binary file of this many triangles.
fn length(count: u32) -> Option<usize> {
    (count as usize).checked_mul(FACET)?.checked_add(HEADER)
}

fn read_binary(file: &str, bytes: &[u8], limits: &Limits) -> Result<Model, ModelError> {
    let Some(count) = count(bytes) else {
        let error =
            ModelError::new("this is no STL file: it neither begins with `solid` nor has the header of a binary one");
        return Err(error.at(FilePlace::Byte(0)).help("is it a file of another format, with a wrong ending?"));
    };
    let facets = &bytes[HEADER..];
    if facets.len() / FACET < count as usize {
        let message = format!("the file ends after {} of {count} triangles", facets.len() / FACET);
        return Err(ModelError::new(message).at(FilePlace::Byte(bytes.len() as u64)).help(super::LOST));
    }
    let mut warnings = Warnings::default();
    let rest = facets.len() - count as usize * FACET;
    if rest > 0 {
        warnings.add(format!("{rest} bytes behind the last of {count} triangles are left out"));
    }
    let mut builder = Builder::<[f32; 3]>::with_capacity(count as usize, limits);
    for (index, facet) in facets.chunks_exact(FACET).take(count as usize).enumerate() {
        let corner = |at: usize| [12 * at + 12, 12 * at + 16, 12 * at + 20].map(|at| float(facet, at));
        builder.add([corner(0), corner(1), corner(2)]).map_err(|message| {
            let at = HEADER + index * FACET;
            ModelError::new(format!("in triangle {index} {message}")).at(FilePlace::Byte(at as u64))
        })?;
    }
    builder.finish(file, warnings)
}

#[inline]
fn float(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// Welds triangles as they come: corners with the same bits are one vertex.
struct Builder<P: Place> {
    distinct: Distinct<P::Bits>,
    triangles: Triangles,
    parts: Vec<MeshPart>,
}

/// A corner in the precision of the file.
trait Place: Copy {
    type Bits: Key;

    /// The bits of it, the same for -0 as for 0.
    fn bits(self) -> Self::Bits;

    /// In double precision.
    fn wide(bits: Self::Bits) -> [f64; 3];
}

impl Place for [f32; 3] {
    type Bits = [u32; 3];

    #[inline]
    fn bits(self) -> [u32; 3] {
        bits_of(self)
    }

    fn wide(bits: [u32; 3]) -> [f64; 3] {
        bits.map(|bits| f32::from_bits(bits).into())
    }
}

impl Place for [f64; 3] {
    type Bits = [u64; 3];

    #[inline]
    fn bits(self) -> [u64; 3] {
        // -0 + 0 is 0.
        self.map(|x| (x + 0.0).to_bits())
    }

    fn wide(bits: [u64; 3]) -> [f64; 3] {
        bits.map(f64::from_bits)
    }
}

impl<P: Place> Builder<P> {
    /// Room for closed surfaces, which have half as many vertices as triangles.
    fn with_capacity(count: usize, limits: &Limits) -> Builder<P> {
        let distinct = Distinct::with_capacity(count / 2 + 3);
        Builder { distinct, triangles: Triangles::with_capacity(count, limits), parts: Vec::new() }
    }

    /// Adds a triangle, or says what is wrong with a corner of it.
    #[inline]
    fn add(&mut self, corners: [P; 3]) -> Result<(), String> {
        let mut triangle = [0; 3];
        for (vertex, corner) in triangle.iter_mut().zip(corners) {
            *vertex = self.vertex(corner)?;
        }
        self.triangles.push(triangle);
        Ok(())
    }

    #[inline]
    fn vertex(&mut self, corner: P) -> Result<u32, String> {
        let bits = corner.bits();
        check_place(P::wide(bits)).map_err(|message| format!("the corner {message}"))?;
        self.distinct.number(bits).ok_or_else(|| "there are more corners than can be numbered".to_owned())
    }

    fn finish(self, file: &str, mut warnings: Warnings) -> Result<Model, ModelError> {
        self.triangles.within_limit()?;
        if self.triangles.len() == 0 {
            return Err(ModelError::new("this file has no triangles, so there is nothing to see"));
        }
        let mut positions = Positions::with_capacity(self.distinct.len());
        for bits in self.distinct.keys() {
            positions.push(P::wide(*bits)).map_err(ModelError::new)?;
        }
        let triangles = self.triangles.into_list();
        let mesh = Gathered { placed: positions.place(), triangles, parts: self.parts, ..Gathered::default() };
        let mesh = mesh.into_mesh(&mut warnings);
        Ok(model_of_mesh(file, mesh, nothing(), warnings.into_list()))
    }
}

fn read_text(file: &str, bytes: &[u8], limits: &Limits) -> Result<Model, ModelError> {
    // The shortest triangle has some 60 bytes; usual ones have 250.
    let builder = Builder::with_capacity(bytes.len() / 250, limits);
    let cursor = Cursor::new(bytes, 0);
    let mut reader = TextReader { bytes, cursor, builder, triangulator: Triangulator::new(bytes.len()), first: 0 };
    let mut warnings = Warnings::default();
    reader.read_solids(&mut warnings)?;
    reader.builder.finish(file, warnings)
}

struct TextReader<'a> {
    bytes: &'a [u8],
    cursor: Cursor<'a>,
    builder: Builder<[f64; 3]>,
    triangulator: Triangulator,
    /// The first triangle of the solid at hand.
    first: u32,
}

impl<'a> TextReader<'a> {
    fn read_solids(&mut self, warnings: &mut Warnings) -> Result<(), ModelError> {
        loop {
            let word = self.cursor.word_of_text();
            if word.is_empty() {
                return Ok(());
            }
            self.expect(word, b"solid")?;
            // Some files are one long line.
            let name = self.cursor.rest_of_line_before(b"facet").into_owned();
            let is_ended = self.read_facets()?;
            self.end_solid(name);
            self.builder.triangles.within_limit()?;
            if !is_ended {
                warnings.add("the last solid has no end; the file may have been cut short");
                return Ok(());
            }
        }
    }

    /// Makes a part of the triangles since the last solid, if it has a name.
    fn end_solid(&mut self, name: String) {
        let triangles = self.builder.triangles.len();
        let (first, count) = (self.first, triangles - self.first);
        if count > 0 && !name.is_empty() {
            self.builder.parts.push(MeshPart { name: Some(name), first, count, material: None });
        }
        self.first = triangles;
    }

    /// Reads up to the end of the solid; false if the file ends before.
    fn read_facets(&mut self) -> Result<bool, ModelError> {
        loop {
            let word = self.cursor.word_of_text();
            if word.eq_ignore_ascii_case(b"facet") {
                self.read_facet()?;
            } else if word.eq_ignore_ascii_case(b"endsolid") {
                // Its name once more.
                self.cursor.rest_of_line();
                return Ok(true);
            } else if word.is_empty() {
                return Ok(false);
            } else {
                return Err(self.unexpected(word, "facet"));
            }
        }
    }

    /// Reads a facet behind its first word. Some programs write more than three corners.
    fn read_facet(&mut self) -> Result<(), ModelError> {
        let start = self.cursor.at();
        // The normal: whatever stands there.
        let mut word = self.cursor.word_of_text();
        while !word.eq_ignore_ascii_case(b"outer") && !word.is_empty() {
            word = self.cursor.word_of_text();
        }
        self.expect(word, b"outer")?;
        let word = self.cursor.word_of_text();
        self.expect(word, b"loop")?;
        let mut corners = [[0.0; 3]; 3];
        let mut more: Vec<[f64; 3]> = Vec::new();
        let mut count = 0;
        loop {
            let word = self.cursor.word_of_text();
            if !word.eq_ignore_ascii_case(b"vertex") {
                self.expect(word, b"endloop")?;
                break;
            }
            let corner = self.read_corner()?;
            match corners.get_mut(count) {
                Some(place) => *place = corner,
                None => more.push(corner),
            }
            count += 1;
        }
        let word = self.cursor.word_of_text();
        self.expect(word, b"endfacet")?;
        let added = match count {
            3 => self.builder.add(corners),
            0..3 => Err(format!("this facet has {count} corners; it takes three to make a triangle")),
            _ => self.add_polygon(&[&corners[..], &more].concat()),
        };
        added.map_err(|message| self.error_at(start, message))
    }

    fn read_corner(&mut self) -> Result<[f64; 3], ModelError> {
        let mut corner = [0.0; 3];
        for x in &mut corner {
            let Some(number) = self.cursor.number_of_text() else {
                let word = self.cursor.word_of_text();
                return Err(self.unexpected(word, "a number"));
            };
            *x = number;
        }
        Ok(corner)
    }

    fn add_polygon(&mut self, corners: &[[f64; 3]]) -> Result<(), String> {
        let vertices =
            corners.iter().map(|corner| self.builder.vertex(*corner)).collect::<Result<Vec<u32>, String>>()?;
        let places: Vec<DVec3> = corners.iter().copied().map(DVec3::from_array).collect();
        let triangles = &mut self.builder.triangles;
        self.triangulator.cut(&places, |triangle| triangles.push(triangle.map(|at| vertices[at])));
        Ok(())
    }

    #[inline]
    fn expect(&self, word: &[u8], expected: &[u8]) -> Result<(), ModelError> {
        if word.eq_ignore_ascii_case(expected) { Ok(()) } else { Err(self.unexpected(word, &shown(expected))) }
    }

    #[cold]
    fn unexpected(&self, word: &[u8], expected: &str) -> ModelError {
        match word {
            [] => self.error(format!("the file ends where `{expected}` should stand")),
            _ => self.error(format!("expected `{expected}`, not `{}`", shown(word))),
        }
    }

    /// An error at the word that has just been read.
    fn error(&self, message: String) -> ModelError {
        self.error_at(self.cursor.at(), message)
    }

    fn error_at(&self, at: usize, message: String) -> ModelError {
        ModelError::new(message).at(FilePlace::Line(line_of(self.bytes, at)))
    }
}
