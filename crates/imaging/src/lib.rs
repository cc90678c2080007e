//! Pictures in memory, the files they come from and go to, and how two of them differ.
//!
//! An [`Image`] is linear light for people and programs to look at; a [`Bitmap`] is what a file held, as it held it,
//! for textures. [`decode`] and [`encode`] work on bytes in memory; opening and writing files is the caller's job.

mod about;
mod bitmap;
mod color;
mod compare;
mod decode;
mod encode;
mod false_color;
mod files;
mod flip;
mod image;
mod layer_view;
mod layers;
mod quantize;
mod tone_mapping;

pub use about::{FileFacts, about};
pub use bitmap::{Alpha, Bitmap, Texels};
pub use color::{Transfer, linear_from_srgb, srgb_from_linear};
pub use compare::{CompareError, Difference, compare};
pub use decode::{DecodeError, DecodeLimits, decode};
pub use encode::{EncodeError, EncodeOptions, ExrSamples, FileFormat, PngDepth, encode, encode_with_alpha};
pub use false_color::false_color;
pub use flip::ErrorMap;
pub use image::Image;
pub use layer_view::{LayerView, Meaning};
pub use layers::{BEAUTY, Channel, Layer, LayerFacts, Layers, Samples, decode_layers, encode_layers, layer_facts};
pub use tone_mapping::ToneMapping;
