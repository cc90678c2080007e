//! JPEG: read by `zune-jpeg`, written by the `image` crate.
//!
//! The reader is called directly, since `image` leaves its vector instructions on, whose roundings are not promised to be
//! the same on every machine, and lets files pass that end too early.

use ::image::codecs::jpeg::JpegEncoder;
use ::image::metadata::Orientation;
use ::image::{DynamicImage, ExtendedColorType, RgbImage};
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::quantize::bytes_from_linear;
use crate::{Bitmap, DecodeError, DecodeLimits, EncodeError, EncodeOptions, FileFacts, FileFormat, Image, Texels};

pub(crate) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let options = DecoderOptions::default()
        .set_use_unsafe(false)
        .set_strict_mode(true)
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| decode_error(&error, bytes))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| corrupt("there is no size".into()))?;
    limits.check(width as u32, height as u32, 3)?;
    if !has_end(bytes) {
        return Err(DecodeError::Truncated);
    }
    let samples = decoder.decode().map_err(|error| decode_error(&error, bytes))?;
    let orientation = decoder.exif().and_then(|exif| Orientation::from_exif_chunk(exif));
    let upright = upright(width as u32, height as u32, samples, orientation)?;
    let texels = upright.as_raw().as_chunks::<3>().0.to_vec();
    Ok(Bitmap { width: upright.width(), height: upright.height(), texels: Texels::U8(texels), alpha: None })
}

pub(crate) fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    let mut decoder =
        JpegDecoder::new_with_options(ZCursor::new(bytes), DecoderOptions::default().set_use_unsafe(false));
    decoder.decode_headers().map_err(|error| decode_error(&error, bytes))?;
    let info = decoder.info().ok_or_else(|| corrupt("there is no size".into()))?;
    let (width, height) = (u32::from(info.width), u32::from(info.height));
    let orientation = decoder.exif().and_then(|exif| Orientation::from_exif_chunk(exif));
    let size = match orientation {
        Some(
            Orientation::Rotate90 | Orientation::Rotate270 | Orientation::Rotate90FlipH | Orientation::Rotate270FlipH,
        ) => (height, width),
        Some(_) | None => (width, height),
    };
    let samples = match info.components {
        1 => "gray, 8 bits",
        4 => "CMYK, 8 bits each",
        _ => "RGB, 8 bits each",
    };
    Ok(FileFacts::plain(FileFormat::Jpeg, size, samples))
}

/// The picture turned as the camera says that it was held.
fn upright(
    width: u32,
    height: u32,
    samples: Vec<u8>,
    orientation: Option<Orientation>,
) -> Result<RgbImage, DecodeError> {
    let image = RgbImage::from_raw(width, height, samples).ok_or_else(|| corrupt("pixels are missing".into()))?;
    match orientation {
        None | Some(Orientation::NoTransforms) => Ok(image),
        Some(orientation) => {
            let mut image = DynamicImage::ImageRgb8(image);
            image.apply_orientation(orientation);
            Ok(image.into_rgb8())
        }
    }
}

/// True if the mark of the end comes after the first scan starts. Data of scans never contain it.
fn has_end(bytes: &[u8]) -> bool {
    const START_OF_SCAN: u8 = 0xda;
    const END_OF_IMAGE: [u8; 2] = [0xff, 0xd9];
    // Walk over the segments before the first scan by their lengths: a preview in one of them has an end of its own.
    let mut rest = bytes.get(2..).unwrap_or_default();
    loop {
        match rest {
            [0xff, START_OF_SCAN, ..] => return rest.windows(2).any(|pair| pair == END_OF_IMAGE),
            // Fill bytes, and marks without a length.
            [0xff, 0xff, ..] => rest = &rest[1..],
            [0xff, 0x01 | 0xd0..=0xd7, ..] => rest = &rest[2..],
            [0xff, _, high, low, ..] => {
                let length = usize::from(*high) << 8 | usize::from(*low);
                rest = rest.get(2 + length..).unwrap_or_default();
            }
            // Stray bytes between segments, which decoders skip.
            [_, ..] => rest = &rest[1..],
            [] => return false,
        }
    }
}

fn corrupt(detail: String) -> DecodeError {
    DecodeError::Corrupt { format: FileFormat::Jpeg, detail }
}

fn decode_error(error: &DecodeErrors, bytes: &[u8]) -> DecodeError {
    match error {
        DecodeErrors::ExhaustedData => DecodeError::Truncated,
        _ if !has_end(bytes) => DecodeError::Truncated,
        DecodeErrors::Unsupported(_) => {
            let detail = "another coding than baseline or progressive Huffman".to_owned();
            DecodeError::Unsupported { format: FileFormat::Jpeg, detail }
        }
        DecodeErrors::ZeroError => corrupt("there are no pixels".into()),
        DecodeErrors::HuffmanDecode(_) | DecodeErrors::MCUError(_) => corrupt("the pixel data are damaged".into()),
        DecodeErrors::DqtError(_) => corrupt("a quantization table is damaged".into()),
        DecodeErrors::SosError(_) | DecodeErrors::SofError(_) => corrupt("a header is damaged".into()),
        DecodeErrors::IllegalMagicBytes(_) => corrupt("it does not begin as a JPEG does".into()),
        DecodeErrors::LargeDimensions(_) => corrupt("it is too large".into()),
        DecodeErrors::Format(words) => corrupt(words.clone()),
        DecodeErrors::FormatStatic(words) => corrupt((*words).to_owned()),
        DecodeErrors::TooSmallOutput(..) | DecodeErrors::IoErrors(_) => corrupt("it is damaged".into()),
    }
}

pub(crate) fn encode(image: &Image, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    const LONGEST: u32 = 65535;
    let Image { width, height, .. } = *image;
    if width > LONGEST || height > LONGEST {
        return Err(EncodeError::TooLarge { format: FileFormat::Jpeg, width, height });
    }
    let samples = bytes_from_linear(&image.pixels, options.transfer);
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, options.jpeg_quality.clamp(1, 100))
        .encode(&samples, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| EncodeError::Failed { format: FileFormat::Jpeg, detail: error.to_string() })?;
    Ok(bytes)
}
