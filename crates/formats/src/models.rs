//! Model files: triangle meshes, and whole scenes of other programs.
//!
//! Whatever the format, what comes out is a [`Model`]: a fragment of a scene, with lists of its own. [`adopt`] joins it to
//! the scene that names the file.

use crate::{Assets, Limits};
use durer_scene::{Object, Scene};

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

/// Reads the model in `bytes`; the ending of `file`, as the scene says it, tells the format. Files that it refers to are
/// looked for beside it.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(crate) fn read(file: &str, bytes: &[u8], assets: &dyn Assets, limits: &Limits) -> Result<Model, ModelError> {
    let _ = (file, bytes, assets, limits);
    todo!()
}

/// Moves the model's materials, textures and images to the scene's lists; gives its objects, which refer to them there.
pub(crate) fn adopt(model: Scene, scene: &mut Scene) -> Vec<Object> {
    let _ = (model, scene);
    todo!()
}
