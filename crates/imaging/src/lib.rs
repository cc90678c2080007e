//! Pictures in memory, the files they come from and go to, and how two of them differ.
//!
//! An [`Image`] is linear light for people and programs to look at; a [`Bitmap`] is what a file held, as it held it,
//! for textures.

mod bitmap;
mod color;
mod compare;
mod decode;
mod encode;
mod flip;
mod image;

pub use bitmap::{Bitmap, Texels};
pub use color::{Transfer, srgb_from_linear, linear_from_srgb};
pub use compare::{Difference, compare};
pub use decode::{DecodeError, DecodeLimits, decode};
pub use encode::{EncodeError, EncodeOptions, FileFormat, encode};
pub use image::Image;
