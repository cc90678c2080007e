//! The same PNG in fewer bytes.

use png::{BitDepth, ColorType, Compression, Decoder, Encoder, Filter, SrgbRenderingIntent};
use std::io::Cursor;
use std::path::Path;

/// Compresses a PNG of 8-bit colours as well as can be; gives the new size.
pub(crate) fn shrink(path: &Path) -> Result<usize, String> {
    let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let before = std::fs::read(path).map_err(|error| at(&error))?;
    let mut reader = Decoder::new(Cursor::new(before.as_slice())).read_info().map_err(|error| at(&error))?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or_else(|| at(&"too large"))?];
    reader.next_frame(&mut pixels).map_err(|error| at(&error))?;
    let header = reader.info();
    if (header.color_type, header.bit_depth) != (ColorType::Rgb, BitDepth::Eight) {
        return Err(at(&"pictures of the gallery have 8 bits"));
    }
    let (width, height, srgb) = (header.width, header.height, header.srgb.is_some());
    let mut best = before;
    for filter in [Filter::Adaptive, Filter::NoFilter, Filter::Paeth, Filter::Up, Filter::Sub] {
        let bytes = encode((width, height), &pixels, srgb, filter).map_err(|error| at(&error))?;
        if bytes.len() < best.len() {
            best = bytes;
        }
    }
    crate::shell::write(path, &best)?;
    Ok(best.len())
}

fn encode(size: (u32, u32), pixels: &[u8], srgb: bool, filter: Filter) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, size.0, size.1);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.set_filter(filter);
    if srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
