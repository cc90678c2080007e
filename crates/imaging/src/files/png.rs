//! PNG, by the `png` crate; the rows of pixels by our own.

mod rows;

use ::png::chunk::IDAT;
use ::png::{BitDepth, ColorType, DecodingError, EncodingError, SrgbRenderingIntent, Transformations};
use std::io::{Cursor, ErrorKind};

use crate::{
    Alpha, Bitmap, DecodeError, DecodeLimits, EncodeError, EncodeOptions, FileFacts, FileFormat, Image, PngDepth,
    Texels, Transfer,
};

pub(crate) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let mut decoder = ::png::Decoder::new(Cursor::new(bytes));
    // Palettes become colours, 1 to 4 bits become 8, a transparent colour becomes an alpha channel.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info().map_err(decode_error)?;
    let (width, height) = (header.width, header.height);
    let bytes_per_sample = if header.bit_depth == BitDepth::Sixteen { 2 } else { 1 };
    limits.check(width, height, 3 * bytes_per_sample)?;
    decoder.set_limits(::png::Limits { bytes: usize::try_from(limits.max_bytes).unwrap_or(usize::MAX) });
    let mut reader = decoder.read_info().map_err(decode_error)?;
    // The crate panics over others.
    let is_whole = |palette: &[u8]| palette.len().is_multiple_of(3) && palette.len() <= 3 * 256;
    if !reader.info().palette.as_deref().is_none_or(is_whole) {
        return Err(corrupt("the palette is damaged".into()));
    }
    let (color, depth) = reader.output_color_type();
    // Only now it is known whether a palette or a transparent colour makes an alpha channel.
    let has_alpha = matches!(color, ColorType::GrayscaleAlpha | ColorType::Rgba);
    limits.check(width, height, bytes_per_sample * if has_alpha { 4 } else { 3 })?;
    let size = reader.output_buffer_size().ok_or_else(|| corrupt("the size is too large".into()))?;
    let mut samples = vec![0; size];
    reader.next_frame(&mut samples).map_err(decode_error)?;
    // Damage after the picture shows as well: the file must end as it should.
    reader.finish().map_err(decode_error)?;
    let (texels, alpha) = if depth == BitDepth::Sixteen {
        let words: Vec<u16> = samples.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        (Texels::U16(colors(&words, color)), alphas(&words, color, u16::MAX).map(Alpha::U16))
    } else {
        (Texels::U8(colors(&samples, color)), alphas(&samples, color, u8::MAX).map(Alpha::U8))
    };
    Ok(Bitmap { width, height, texels, alpha })
}

pub(crate) fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    let mut reader = ::png::Decoder::new(Cursor::new(bytes)).read_info().map_err(decode_error)?;
    // Texts may stand behind the pixels too. Whether those are whole is not asked here.
    let _ = reader.finish();
    let info = reader.info();
    let color = match info.color_type {
        ColorType::Grayscale => "gray",
        ColorType::Rgb => "RGB",
        ColorType::Indexed => "palette",
        ColorType::GrayscaleAlpha => "gray and alpha",
        ColorType::Rgba => "RGB and alpha",
    };
    let each = if matches!(info.color_type, ColorType::Grayscale | ColorType::Indexed) { "" } else { " each" };
    let samples = format!("{color}, {} bits{each}", info.bit_depth as u8);
    let plain = info.uncompressed_latin1_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone()));
    let packed = info.compressed_latin1_text.iter();
    let packed = packed.filter_map(|chunk| Some((chunk.keyword.clone(), chunk.get_text().ok()?)));
    let other = info.utf8_text.iter().filter_map(|chunk| Some((chunk.keyword.clone(), chunk.get_text().ok()?)));
    let metadata = plain.chain(packed).chain(other).collect();
    Ok(FileFacts { metadata, ..FileFacts::plain(FileFormat::Png, (info.width, info.height), &samples) })
}

/// Colours from samples.
fn colors<T: Copy>(samples: &[T], color: ColorType) -> Vec<[T; 3]> {
    match color {
        // The EXPAND transformation leaves no palette.
        ColorType::Grayscale | ColorType::Indexed => samples.iter().map(|&v| [v; 3]).collect(),
        ColorType::Rgb => samples.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
        ColorType::GrayscaleAlpha => samples.chunks_exact(2).map(|p| [p[0]; 3]).collect(),
        ColorType::Rgba => samples.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect(),
    }
}

/// Alphas from samples, if any is less than `opaque`.
fn alphas<T: Copy + PartialEq>(samples: &[T], color: ColorType, opaque: T) -> Option<Vec<T>> {
    let channels = match color {
        ColorType::Grayscale | ColorType::Indexed | ColorType::Rgb => return None,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgba => 4,
    };
    let alphas = || samples.chunks_exact(channels).map(|pixel| pixel[channels - 1]);
    alphas().any(|alpha| alpha != opaque).then(|| alphas().collect())
}

fn corrupt(detail: String) -> DecodeError {
    DecodeError::Corrupt { format: FileFormat::Png, detail }
}

fn decode_error(error: DecodingError) -> DecodeError {
    match error {
        DecodingError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => DecodeError::Truncated,
        DecodingError::LimitsExceeded => corrupt("it needs too much memory".into()),
        DecodingError::IoError(error) => corrupt(error.to_string()),
        DecodingError::Format(error) => corrupt(in_plain_words(&error.to_string()).into()),
        DecodingError::Parameter(_) => corrupt("its parts do not fit together".into()),
    }
}

/// The decoder's message begins with or contains this: what is wrong. Its own words show insides of the decoder.
const PLAIN_WORDS: &[(&str, &str)] = &[
    ("CRC error", "a checksum does not match"),
    ("Invalid PNG signature", "it does not begin as a PNG does"),
    ("Corrupt deflate stream", "the pixel data are damaged"),
    ("does not have enough data", "there are fewer pixels than its header says"),
    ("IDAT or fdAT chunk is missing", "there are no pixels in it"),
    ("palette", "the palette is missing or too short"),
    ("Invalid image dimensions", "its size is not valid"),
    ("Invalid color", "its header is damaged"),
    ("Invalid bit depth", "its header is damaged"),
    ("method", "it is compressed in an unknown way"),
    ("Unrecognized critical chunk", "it needs a part of the format that is not known"),
    ("before IHDR", "its header is missing"),
];

fn in_plain_words(message: &str) -> &'static str {
    PLAIN_WORDS.iter().find(|(part, _)| message.contains(part)).map_or("a damaged chunk", |(_, words)| words)
}

/// Bytes in a chunk of compressed rows; the format allows no more.
const LONGEST_CHUNK: usize = (1 << 31) - 1;

/// Colors are straight: not multiplied by alpha.
pub(crate) fn encode(image: &Image, alpha: Option<&[f32]>, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, image.width, image.height);
    encoder.set_color(if alpha.is_some() { ColorType::Rgba } else { ColorType::Rgb });
    encoder.set_depth(match options.png_depth {
        PngDepth::Eight => BitDepth::Eight,
        PngDepth::Sixteen => BitDepth::Sixteen,
    });
    if options.transfer == Transfer::Srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    for (keyword, text) in &options.metadata {
        add_text(&mut encoder, keyword, text)?;
    }
    let mut writer = encoder.write_header().map_err(|error| encode_error(&error))?;
    let rows = rows::compressed(image, alpha, options).map_err(|error| encode_error(&error.into()))?;
    for part in rows.chunks(LONGEST_CHUNK) {
        writer.write_chunk(IDAT, part).map_err(|error| encode_error(&error))?;
    }
    writer.finish().map_err(|error| encode_error(&error))?;
    Ok(bytes)
}

/// Adds a text: as tEXt if it is ASCII, as iTXt, which is UTF-8, if not. A keyword must be printable ASCII here, which
/// both kinds can hold.
fn add_text(encoder: &mut ::png::Encoder<'_, &mut Vec<u8>>, keyword: &str, text: &str) -> Result<(), EncodeError> {
    let is_allowed = (1..=79).contains(&keyword.len())
        && keyword.bytes().all(|byte| byte == b' ' || byte.is_ascii_graphic())
        && keyword.trim_ascii() == keyword;
    if !is_allowed {
        return Err(EncodeError::Keyword { keyword: keyword.to_owned() });
    }
    // A zero byte would end the text.
    let text = text.replace('\0', "");
    let keyword = keyword.to_owned();
    let added =
        if text.is_ascii() { encoder.add_text_chunk(keyword, text) } else { encoder.add_itxt_chunk(keyword, text) };
    added.map_err(|error| encode_error(&error))
}

fn encode_error(error: &EncodingError) -> EncodeError {
    EncodeError::Failed { format: FileFormat::Png, detail: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Found by fuzzing: the crate reads such a file up to a panic.
    #[test]
    fn palettes_of_parts_of_colors_are_refused() {
        let of_palette = |length: usize| {
            let mut bytes = Vec::new();
            let mut encoder = ::png::Encoder::new(&mut bytes, 4, 1);
            encoder.set_color(ColorType::Indexed);
            encoder.set_depth(BitDepth::One);
            encoder.set_palette(vec![7; length]);
            encoder.write_header().and_then(|mut writer| writer.write_image_data(&[0])).unwrap();
            decode(&bytes, &DecodeLimits::default()).map(|bitmap| bitmap.width)
        };
        assert_eq!(of_palette(6).unwrap(), 4);
        for length in [1, 7, 28, 771] {
            assert!(of_palette(length).is_err(), "{length}");
        }
    }

    #[test]
    fn damage_is_told_in_plain_words() {
        let image = Image { width: 20, height: 20, pixels: vec![durer_math::Rgb::WHITE; 400] };
        let good = encode(&image, None, &EncodeOptions::default()).unwrap();
        assert!(decode(&good, &DecodeLimits::default()).is_ok());
        for at in 0..good.len() {
            let mut bad = good.clone();
            bad[at] ^= 0x41;
            if let Err(error) = decode(&bad, &DecodeLimits::default()) {
                let text = error.to_string();
                assert!(!text.contains(['{', '"', '(']) && !text.contains("ChunkType"), "{at}: {text}");
            }
        }
    }
}
