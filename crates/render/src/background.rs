//! What rays that leave the scene see.

use crate::textures::Environment;
use durer_math::{DVec3, Rgb};
use durer_scene::Scene;

/// A direction, looked up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Unit length.
    pub(crate) direction: DVec3,
    /// Where it is in the picture, if the background is one.
    pub(crate) place: [f64; 2],
}

/// The background, compiled.
#[derive(Debug)]
pub(crate) enum Background {
    /// The same everywhere.
    Color(Rgb),
    /// Linear in the y component of the direction.
    Gradient {
        /// Straight down.
        bottom: Rgb,
        /// Straight up.
        top: Rgb,
    },
    /// A picture of all directions.
    Image(Environment),
}

impl Background {
    /// That of a scene that passed its check.
    pub(crate) fn compile(scene: &Scene) -> Background {
        match scene.background {
            durer_scene::Background::Color(color) => Background::Color(color),
            durer_scene::Background::Gradient { bottom, top } => Background::Gradient { bottom, top },
            durer_scene::Background::Image(map) => Background::Image(Environment::compile(&map, scene)),
        }
    }

    /// Looks up a direction of unit length.
    pub(crate) fn look(&self, direction: DVec3) -> Look {
        let place = match self {
            Background::Color(_) | Background::Gradient { .. } => [0.0; 2],
            Background::Image(map) => map.place(direction),
        };
        Look { direction, place }
    }

    /// What is seen there.
    pub(crate) fn light(&self, look: &Look) -> Rgb {
        match self {
            Background::Color(_) | Background::Gradient { .. } => self.seen(look.direction),
            Background::Image(map) => map.seen_at(look.place),
        }
    }

    /// What is seen in a direction of unit length.
    pub(crate) fn seen(&self, direction: DVec3) -> Rgb {
        match self {
            Background::Color(color) => *color,
            Background::Gradient { bottom, top } => bottom.lerp(*top, (0.5 * (direction.y + 1.0)) as f32),
            Background::Image(map) => map.seen(direction),
        }
    }
}
