//! The door to rendering: every number usable, every id in range; all problems found at once, each with its place.
//!
//! The bounds keep arithmetic in double precision far from overflow and from results that are nothing but rounding:
//!
//! * coordinates and lengths are at most 1e12; radii, widths and distances at least 1e-9; directions at least 1e-9 long;
//! * transforms, each step and all of an object together, are reversible and change no length by more than 1e9;
//! * pictures have at most 65535 pixels a side and 400 million in all;
//! * objects nest at most 64 deep, textures at most 32; instances place at most 20 million things;
//! * a ray splits into at most 100 million rays.

mod bounds;
mod emptiness;
mod instances;
mod lists;
mod materials;
mod meshes;
mod objects;
mod particles;
mod remarks;
mod settings;
mod solids;
mod textures;
mod values;

use crate::{ImageId, MaterialId, Scene, TextureId};
use values::Checker;

/// A scene that can be rendered: its ids are in range, nothing refers to itself, and its numbers are usable.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedScene(Scene);

impl CheckedScene {
    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.0
    }

    /// The scene, to be changed and checked again.
    pub fn into_scene(self) -> Scene {
        self.0
    }

    /// What is worth saying of it although it can be rendered: what will not look as it was probably meant.
    pub fn remarks(&self) -> Vec<Problem> {
        let mut checker = Checker::new(&self.0);
        remarks::remark(&mut checker);
        checker.problems
    }
}

impl Scene {
    /// Checks everything that rendering could trip over.
    ///
    /// # Errors
    ///
    /// All problems, not just the first.
    pub fn check(self) -> Result<CheckedScene, Vec<Problem>> {
        let mut checker = Checker::new(&self);
        settings::check(&mut checker);
        textures::check(&mut checker);
        materials::check(&mut checker);
        objects::check(&mut checker);
        let problems = checker.problems;
        if problems.is_empty() { Ok(CheckedScene(self)) } else { Err(problems) }
    }
}

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What is wrong, as a short phrase: "radius must be above 0".
    pub message: String,
    /// What to do about it, if that can be said.
    pub help: Option<String>,
    /// True if it follows from the one value at its place, whatever stands beside that.
    pub is_of_one_value: bool,
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

impl std::fmt::Display for Place {
    /// As in `objects[3].sphere.radius` or `material 2.color`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (at, step) in self.steps.iter().enumerate() {
            let dot = if at == 0 { "" } else { "." };
            match step {
                Step::Field(name) => write!(f, "{dot}{name}")?,
                Step::Index(index) => write!(f, "[{index}]")?,
                Step::Material(id) => write!(f, "material {}", id.0)?,
                Step::Texture(id) => write!(f, "texture {}", id.0)?,
                Step::Image(id) => write!(f, "image {}", id.0)?,
            }
        }
        Ok(())
    }
}

impl std::fmt::Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}
