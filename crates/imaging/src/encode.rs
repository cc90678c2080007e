//! From an [`Image`] to the bytes of a picture file.

use std::path::Path;

use thiserror::Error;

use crate::files::{exr, hdr, jpeg, pfm, png};
use crate::{Image, Transfer};

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
    /// The usual choices for a format: sRGB, PNG with 8 bits, EXR in half precision, JPEG of quality 92, no metadata.
    pub fn new(format: FileFormat) -> EncodeOptions {
        EncodeOptions {
            format,
            transfer: Transfer::Srgb,
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
    /// The length of [`Image::pixels`] is not width times height.
    #[error("a picture of {width} × {height} pixels comes with {count} colors")]
    WrongPixelCount {
        /// Width.
        width: u32,
        /// Height.
        height: u32,
        /// The number of colours.
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
/// PNG and JPEG clamp to black and white, and NaN becomes black. EXR and PFM keep every number; HDR has no negative
/// ones and no NaN, which become 0.
///
/// # Errors
/// If the picture is empty, too large for the format, or not consistent, or if a keyword of the metadata is not allowed.
pub fn encode(image: &Image, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let Image { width, height, .. } = *image;
    if width == 0 || height == 0 {
        return Err(EncodeError::NoPixels { width, height });
    }
    if !image.has_all_pixels() {
        return Err(EncodeError::WrongPixelCount { width, height, count: image.pixels.len() });
    }
    match options.format {
        FileFormat::Png => png::encode(image, options),
        FileFormat::Jpeg => jpeg::encode(image, options),
        FileFormat::Exr => exr::encode(image, options),
        FileFormat::Hdr => Ok(hdr::encode(image)),
        FileFormat::Pfm => Ok(pfm::encode(image)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

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
