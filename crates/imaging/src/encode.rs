//! From an [`Image`] to the bytes of a picture file.

use durer_math::Rgb;
use std::borrow::Cow;
use std::path::Path;

use thiserror::Error;

use crate::files::{exr, hdr, jpeg, pfm, png};
use crate::tone_mapping::Developer;
use crate::{Image, ToneMapping, Transfer};

/// The picture formats that we read and write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// Portable Network Graphics: 8 or 16 bits, no loss beyond that.
    Png,
    /// JPEG: 8 bits, small, with loss.
    Jpeg,
    /// OpenEXR: linear light in half or single precision.
    Exr,
    /// Radiance HDR: linear light, three mantissas of 8 bits with one exponent.
    Hdr,
    /// Portable float map: linear light in single precision, not compressed.
    Pfm,
}

impl FileFormat {
    /// All of them, in the order in which messages name them.
    pub const ALL: [FileFormat; 5] =
        [FileFormat::Png, FileFormat::Jpeg, FileFormat::Exr, FileFormat::Hdr, FileFormat::Pfm];

    /// The format by the extension of a file name; upper and lower case are the same.
    ///
    /// # Errors
    /// If the name has no extension or one of another format; the message names the known ones.
    pub fn from_path(path: &Path) -> Result<FileFormat, EncodeError> {
        match path.extension() {
            Some(extension) => FileFormat::from_extension(&extension.to_string_lossy()),
            None => Err(EncodeError::NoExtension),
        }
    }

    /// The format by an extension without its dot; upper and lower case are the same.
    ///
    /// # Errors
    /// If it is the extension of another format; the message names the known ones.
    pub fn from_extension(extension: &str) -> Result<FileFormat, EncodeError> {
        match extension.to_ascii_lowercase().as_str() {
            "png" => Ok(FileFormat::Png),
            "jpg" | "jpeg" => Ok(FileFormat::Jpeg),
            "exr" => Ok(FileFormat::Exr),
            "hdr" | "pic" => Ok(FileFormat::Hdr),
            "pfm" => Ok(FileFormat::Pfm),
            _ => Err(EncodeError::UnknownExtension { extension: extension.to_owned() }),
        }
    }

    /// The name in messages: "PNG".
    pub fn name(self) -> &'static str {
        match self {
            FileFormat::Png => "PNG",
            FileFormat::Jpeg => "JPEG",
            FileFormat::Exr => "EXR",
            FileFormat::Hdr => "HDR",
            FileFormat::Pfm => "PFM",
        }
    }

    /// The usual extension of file names, without a dot: "png".
    pub fn extension(self) -> &'static str {
        match self {
            FileFormat::Png => "png",
            FileFormat::Jpeg => "jpg",
            FileFormat::Exr => "exr",
            FileFormat::Hdr => "hdr",
            FileFormat::Pfm => "pfm",
        }
    }

    /// True if files of this format hold linear light in floating point, whatever [`EncodeOptions::transfer`] says.
    pub fn is_linear(self) -> bool {
        match self {
            FileFormat::Png | FileFormat::Jpeg => false,
            FileFormat::Exr | FileFormat::Hdr | FileFormat::Pfm => true,
        }
    }
}

/// Bits of a component in a PNG file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngDepth {
    /// 8 bits.
    #[default]
    Eight,
    /// 16 bits.
    Sixteen,
}

/// Numbers in an EXR file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExrSamples {
    /// Half precision: 11 significant bits, up to 65504; larger finite numbers become 65504.
    #[default]
    Half,
    /// Single precision.
    Float,
}

/// How to store a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct EncodeOptions {
    /// The kind of file.
    pub format: FileFormat,
    /// How light becomes numbers in PNG and JPEG. With [`Transfer::Linear`] the raw numbers reach the screen, so the
    /// file carries no gamma note. EXR, HDR and PFM always hold linear light.
    pub transfer: Transfer,
    /// How many stops brighter the picture becomes in PNG and JPEG. EXR, HDR and PFM hold the light of the scene.
    pub exposure: f32,
    /// How light that is brighter than white is shown in PNG and JPEG.
    pub tone_mapping: ToneMapping,
    /// Bits of a component in PNG.
    pub png_depth: PngDepth,
    /// Precision in EXR.
    pub exr_samples: ExrSamples,
    /// Quality of JPEG, from 1 to 100; other numbers are clamped.
    pub jpeg_quality: u8,
    /// Pairs of keyword and text that tell where the picture comes from: text chunks in PNG, lines of the attribute
    /// `comments` in EXR. Other formats leave them out.
    pub metadata: Vec<(String, String)>,
}

impl EncodeOptions {
    /// The usual choices for a format: sRGB, light as it is, PNG with 8 bits, EXR in half precision, JPEG of quality 92, no metadata.
    pub fn new(format: FileFormat) -> EncodeOptions {
        EncodeOptions {
            format,
            transfer: Transfer::Srgb,
            exposure: 0.0,
            tone_mapping: ToneMapping::None,
            png_depth: PngDepth::Eight,
            exr_samples: ExrSamples::Half,
            jpeg_quality: 92,
            metadata: Vec::new(),
        }
    }
}

impl EncodeOptions {
    /// The most bytes that the file of a picture of this size may take, as if nothing could be compressed.
    pub fn most_bytes(&self, width: u32, height: u32) -> u64 {
        let for_each_pixel = match (self.format, self.png_depth, self.exr_samples) {
            (FileFormat::Png, PngDepth::Sixteen, _) | (FileFormat::Exr, _, ExrSamples::Half) => 6,
            (FileFormat::Png, PngDepth::Eight, _) => 3,
            // Noise of the best quality takes almost 4.
            (FileFormat::Jpeg, ..) => 5,
            (FileFormat::Exr, _, ExrSamples::Float) | (FileFormat::Pfm, ..) => 12,
            (FileFormat::Hdr, ..) => 4,
        };
        let raw = for_each_pixel * u64::from(width) * u64::from(height);
        let texts: u64 = self.metadata.iter().map(|(key, text)| (key.len() + 2 * text.len()) as u64).sum();
        // Beside the numbers: what compressors add where they fail, something for each row, and what stands before all.
        raw + raw / 64 + 16 * u64::from(height) + 4096 + texts
    }

    /// As [`EncodeOptions::most_bytes`], with alpha.
    pub fn most_bytes_with_alpha(&self, width: u32, height: u32) -> u64 {
        let bytes = self.most_bytes(width, height);
        bytes + bytes.div_ceil(3)
    }
}

impl Default for EncodeOptions {
    /// The usual choices for PNG.
    fn default() -> EncodeOptions {
        EncodeOptions::new(FileFormat::Png)
    }
}

/// Why a picture cannot be stored.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The file name has no extension to tell the format.
    #[error("the file name has no extension; known are png, jpg, exr, hdr and pfm")]
    NoExtension,
    /// The extension is of no format we write.
    #[error("no picture format has the extension `{extension}`; known are png, jpg, exr, hdr and pfm")]
    UnknownExtension {
        /// The extension, as given.
        extension: String,
    },
    /// Width or height is zero.
    #[error("a picture of {width} × {height} pixels cannot be stored")]
    NoPixels {
        /// Width.
        width: u32,
        /// Height.
        height: u32,
    },
    /// The length of [`Image::pixels`], or of what comes with it, is not width times height.
    #[error("a picture of {width} × {height} pixels comes with {count} values")]
    WrongPixelCount {
        /// Width.
        width: u32,
        /// Height.
        height: u32,
        /// The number of colors, or of alphas.
        count: usize,
    },
    /// The format has no room for so many pixels.
    #[error("{} cannot store {width} × {height} pixels", format.name())]
    TooLarge {
        /// The format.
        format: FileFormat,
        /// Width.
        width: u32,
        /// Height.
        height: u32,
    },
    /// The format cannot say that a part of a pixel is not there.
    #[error("{} has no alpha; PNG and EXR have", format.name())]
    NoAlpha {
        /// The format.
        format: FileFormat,
    },
    /// A keyword of the metadata that PNG does not allow: empty, over 79 characters, or not Latin-1.
    #[error("`{keyword}` cannot be a keyword of the metadata in a PNG file")]
    Keyword {
        /// The keyword.
        keyword: String,
    },
    /// The encoder failed for another reason.
    #[error("cannot write {}: {detail}", format.name())]
    Failed {
        /// The format.
        format: FileFormat,
        /// What the encoder says.
        detail: String,
    },
}

/// Stores a picture as the bytes of a file. The same picture and options give the same bytes, on every machine.
///
/// PNG and JPEG show the picture as [`EncodeOptions::exposure`] and [`EncodeOptions::tone_mapping`] say; they clamp to black
/// and white, and NaN becomes black. EXR and PFM keep every number; HDR has no negative ones and no NaN, which become 0.
///
/// # Errors
/// If the picture is empty, too large for the format, or not consistent, or if a keyword of the metadata is not allowed.
pub fn encode(image: &Image, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    encode_picture(image, None, options)
}

/// As [`encode`], of a picture of which only a part is there: `alpha` has a number for each pixel, from 0 where nothing is to
/// 1 where all is, and the colors are of what is there (associated: black where nothing is, and not divided by alpha).
/// EXR stores them so; PNG stores the colors divided by alpha, since it is defined that way, and then developed.
///
/// # Errors
/// As [`encode`]; if there is not one alpha for each pixel; or if the format has no alpha.
pub fn encode_with_alpha(image: &Image, alpha: &[f32], options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    encode_picture(image, Some(alpha), options)
}

fn encode_picture(image: &Image, alpha: Option<&[f32]>, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let Image { width, height, .. } = *image;
    if width == 0 || height == 0 {
        return Err(EncodeError::NoPixels { width, height });
    }
    let count = alpha.map_or(image.pixels.len(), <[f32]>::len);
    if !image.has_all_pixels() || count != image.pixels.len() {
        return Err(EncodeError::WrongPixelCount { width, height, count });
    }
    let without_alpha = || match alpha {
        Some(_) => Err(EncodeError::NoAlpha { format: options.format }),
        None => Ok(()),
    };
    match options.format {
        FileFormat::Png => png::encode(&developed(image, alpha, options), alpha, options),
        FileFormat::Jpeg => without_alpha().and_then(|()| jpeg::encode(&developed(image, None, options), options)),
        FileFormat::Exr => exr::encode(image, alpha, options),
        FileFormat::Hdr => without_alpha().map(|()| hdr::encode(image)),
        FileFormat::Pfm => without_alpha().map(|()| pfm::encode(image)),
    }
}

/// What a screen shows, in linear light; of the whole of a pixel, whatever its alpha.
fn developed<'i>(image: &'i Image, alpha: Option<&[f32]>, options: &EncodeOptions) -> Cow<'i, Image> {
    let developer = Developer::new(options.tone_mapping, options.exposure);
    let pixels = match alpha {
        None if developer.is_identity() => return Cow::Borrowed(image),
        None => image.pixels.iter().map(|&color| developer.develop(color)).collect(),
        Some(alpha) => {
            let pixels = image.pixels.iter().zip(alpha);
            pixels.map(|(&color, &alpha)| developer.develop(straight(color, alpha))).collect()
        }
    };
    Cow::Owned(Image { pixels, ..*image })
}

/// The color of what is there.
fn straight(color: Rgb, alpha: f32) -> Rgb {
    if alpha > 0.0 { color * (1.0 / alpha) } else { Rgb::BLACK }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_by_name() {
        for format in FileFormat::ALL {
            assert_eq!(FileFormat::from_extension(format.extension()).ok(), Some(format));
        }
        assert_eq!(FileFormat::from_path(Path::new("a/b.c/View.JPEG")).ok(), Some(FileFormat::Jpeg));
        let error = FileFormat::from_path(Path::new("view.bmp")).unwrap_err();
        assert_eq!(
            error.to_string(),
            "no picture format has the extension `bmp`; known are png, jpg, exr, hdr and pfm"
        );
        assert!(matches!(FileFormat::from_path(Path::new("a.b/view")), Err(EncodeError::NoExtension)));
    }

    /// Noise is the worst that there is.
    #[test]
    fn no_file_is_larger_than_it_may_be() {
        let mut state = 1_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        for (width, height) in [(1, 1), (300, 7), (5, 400), (257, 129)] {
            let pixels = (0..width * height).map(|_| Rgb::new(noise(), noise(), noise())).collect();
            let image = Image { width, height, pixels };
            for format in FileFormat::ALL {
                for (png_depth, exr_samples) in
                    [(PngDepth::Eight, ExrSamples::Half), (PngDepth::Sixteen, ExrSamples::Float)]
                {
                    let options =
                        EncodeOptions { png_depth, exr_samples, jpeg_quality: 100, ..EncodeOptions::new(format) };
                    let bytes = encode(&image, &options).unwrap().len() as u64;
                    let most = options.most_bytes(width, height);
                    assert!(bytes <= most, "{format:?}, {width} × {height}: {bytes} of {most} bytes");
                }
            }
        }
    }

    #[test]
    fn no_alpha_where_there_is_none() {
        let image = Image::new(2, 1);
        for format in FileFormat::ALL {
            let encoded = encode_with_alpha(&image, &[1.0, 0.5], &EncodeOptions::new(format));
            match format {
                FileFormat::Png | FileFormat::Exr => assert!(encoded.is_ok(), "{format:?}"),
                FileFormat::Jpeg | FileFormat::Hdr | FileFormat::Pfm => {
                    let message = format!("{} has no alpha; PNG and EXR have", format.name());
                    assert_eq!(encoded.unwrap_err().to_string(), message);
                }
            }
        }
        let wrong = encode_with_alpha(&image, &[1.0], &EncodeOptions::default());
        assert!(matches!(wrong, Err(EncodeError::WrongPixelCount { count: 1, .. })));
    }

    #[test]
    fn empty_and_inconsistent_pictures_are_refused() {
        for format in FileFormat::ALL {
            let options = EncodeOptions::new(format);
            let error = encode(&Image::new(0, 3), &options).unwrap_err();
            assert_eq!(error.to_string(), "a picture of 0 × 3 pixels cannot be stored");
            let wrong = Image { width: 2, height: 2, pixels: vec![Rgb::BLACK; 3] };
            assert!(matches!(encode(&wrong, &options), Err(EncodeError::WrongPixelCount { count: 3, .. })));
        }
    }
}
