//! A picture in linear light.

use durer_math::Rgb;

/// A picture in linear light: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` colours, row by row.
    pub pixels: Vec<Rgb>,
}
