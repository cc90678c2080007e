//! Model files: triangle meshes, and whole scenes of other programs.
//!
//! Whatever the format, what comes out is a [`Model`]: a fragment of a scene, with lists of its own. [`adopt`] joins it to
//! the scene that names the file; [`load`] makes a scene of it alone.
//!
//! All formats are read by our own code. Crates for OBJ and PLY exist, but they build a map or a list for each element,
//! which is too slow for millions of them, and tell neither lines nor limits.

mod adopt;
mod gathered;
mod gltf;
mod load;
mod material_library;
mod normals;
mod obj;
pub(crate) mod ply;
mod polygons;
mod stage;
mod stl;
#[cfg(test)]
mod testing;
mod text;
mod vertices;
mod warnings;

pub(crate) use adopt::adopt;
pub(crate) use load::load;
pub(crate) use normals::shade;

use crate::{Assets, Limits};
use durer_scene::Scene;
use std::fmt;

/// What a model file holds.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    /// Objects, materials, textures, images, lights (only those of the file) and the first camera. Everything else in it
    /// means nothing. Materials and textures have no names.
    pub(crate) scene: Scene,
    /// What was left out or done only nearly, one sentence each.
    pub(crate) warnings: Vec<String>,
}

/// Why a model file cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ModelError {
    /// What is wrong: "vertex 9 does not exist".
    pub(crate) message: String,
    /// Where.
    pub(crate) place: Option<FilePlace>,
    /// What to do about it.
    pub(crate) help: Option<String>,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FilePlace {
    /// A line of a text file, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(u64),
}

impl ModelError {
    /// An error of the file as a whole.
    pub(crate) fn new(message: impl Into<String>) -> ModelError {
        ModelError { message: message.into(), place: None, help: None }
    }

    /// The same at a place, unless it has one already.
    pub(crate) fn at(self, place: FilePlace) -> ModelError {
        ModelError { place: self.place.or(Some(place)), ..self }
    }

    /// The same with advice.
    pub(crate) fn help(self, help: impl Into<String>) -> ModelError {
        ModelError { help: Some(help.into()), ..self }
    }
}

impl fmt::Display for ModelError {
    /// As in `line 7: vertex 9 does not exist`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Some(place) => write!(f, "{place}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilePlace::Line(line) => write!(f, "line {line}"),
            FilePlace::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// What to do about a file that ends too early.
const LOST: &str = "part of it has been lost: copy or download it again";

/// The formats of models.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// Wavefront OBJ, with its material libraries.
    Obj,
    /// The Stanford polygon format.
    Ply,
    /// Stereolithography.
    Stl,
    /// glTF 2.0, as text or in one binary file.
    Gltf,
}

impl Format {
    /// The format by the ending of the file's name.
    fn of_name(file: &str) -> Option<Format> {
        let (_, ending) = file.rsplit(['/', '\\']).next()?.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "obj" => Some(Format::Obj),
            "ply" => Some(Format::Ply),
            "stl" => Some(Format::Stl),
            "gltf" | "glb" => Some(Format::Gltf),
            _ => None,
        }
    }

    /// The format by content. OBJ files have nothing that tells them from other text.
    fn of_content(bytes: &[u8]) -> Option<Format> {
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Format::Ply)
        } else if bytes.starts_with(b"glTF") {
            Some(Format::Gltf)
        } else if stl::looks_like_it(bytes) {
            Some(Format::Stl)
        } else {
            None
        }
    }
}

/// True if the name ends as those of model files do.
pub(crate) fn is_model_name(file: &str) -> bool {
    Format::of_name(file).is_some()
}

/// Reads the model in `bytes`; the ending of `file`, as the scene says it, tells the format, or else the content does.
/// Files that it refers to are looked for beside it.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(crate) fn read(file: &str, bytes: &[u8], assets: &dyn Assets, limits: &Limits) -> Result<Model, ModelError> {
    if bytes.is_empty() {
        return Err(ModelError::new("this file is empty").help(LOST));
    }
    // Some editors put a byte order mark before a text.
    let bytes = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(text) if text.starts_with(b"ply") || text.starts_with(b"solid") => text,
        _ => bytes,
    };
    match Format::of_name(file).or_else(|| Format::of_content(bytes)) {
        Some(Format::Obj) => obj::read(file, bytes, assets, limits),
        Some(Format::Ply) => ply::read(file, bytes, limits),
        Some(Format::Stl) => stl::read(file, bytes, limits),
        Some(Format::Gltf) => gltf::read(file, bytes, assets, limits),
        None => {
            let error = ModelError::new("this is no model file that can be read");
            Err(error.help("known are OBJ (.obj), PLY (.ply), STL (.stl) and glTF (.gltf, .glb)"))
        }
    }
}

/// The name of a file that a model names, as the scene would say it: it lies beside the model.
fn beside(file: &str, name: &str) -> String {
    let name = name.replace('\\', "/");
    match file.rsplit_once('/') {
        Some((folder, _)) if !name.starts_with('/') => format!("{folder}/{name}"),
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NoAssets;

    #[test]
    fn endings_tell_formats() {
        assert_eq!(Format::of_name("a.b/C.Obj"), Some(Format::Obj));
        assert_eq!(Format::of_name("bunny.PLY"), Some(Format::Ply));
        assert_eq!(Format::of_name("folder.stl/file"), None);
        assert!(is_model_name("x.glb") && is_model_name("dir\\x.gltf") && !is_model_name("x.yaml"));
    }

    #[test]
    fn content_tells_what_names_do_not() {
        assert_eq!(Format::of_content(b"ply\nformat"), Some(Format::Ply));
        assert_eq!(Format::of_content(b"glTF\x02"), Some(Format::Gltf));
        assert_eq!(Format::of_content(b"solid x\nfacet normal 0 0 1"), Some(Format::Stl));
        let error = read("x.dat", b"\x7fELF", &NoAssets, &Limits::default()).unwrap_err();
        assert!(error.help.unwrap().contains("PLY"));
    }

    #[test]
    fn names_are_relative_to_the_model() {
        assert_eq!(beside("models/a.obj", "..\\tex\\wood.png"), "models/../tex/wood.png");
        assert_eq!(beside("a.obj", "a.mtl"), "a.mtl");
        assert_eq!(beside("models/a.obj", "/etc/passwd"), "/etc/passwd");
    }
}
