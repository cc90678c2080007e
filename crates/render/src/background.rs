//! What rays that leave the scene see.

use durer_math::{DVec3, Rgb};
use durer_scene::Background;

/// The background in a direction of unit length.
pub(crate) fn background(background: &Background, direction: DVec3) -> Rgb {
    match *background {
        Background::Color(color) => color,
        Background::Gradient { bottom, top } => bottom.lerp(top, (0.5 * (direction.y + 1.0)) as f32),
    }
}
