//! The door to rendering: every number usable, every id in range; all problems found at once, each with its place.

use crate::{ImageId, MaterialId, Scene, TextureId};

/// A scene that can be rendered: its ids are in range, nothing refers to itself, and its numbers are usable.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedScene(Scene);

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What is wrong, as a short phrase: "radius must be above 0".
    pub message: String,
    /// What to do about it, if that can be said.
    pub help: Option<String>,
}

/// A place in a scene: the way from the scene, or from a material, texture or image, down to one value. Field names
/// are those of scene files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The steps of the way, outermost first.
    pub steps: Vec<Step>,
}

/// One step of a [`Place`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A field, by its name.
    Field(&'static str),
    /// An element of a list.
    Index(usize),
    /// A material, wherever it is defined; the first step.
    Material(MaterialId),
    /// A texture, wherever it is defined; the first step.
    Texture(TextureId),
    /// An image; the first step.
    Image(ImageId),
}
