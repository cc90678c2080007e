//! From the bytes of a picture file to a [`Bitmap`]: which format it is, how large it may be, what can be wrong with it.
//!
//! The format is recognised by content, since names lie. Every reader in `files/` checks the size in the header against
//! [`DecodeLimits`] before it allocates anything of that size.

use thiserror::Error;

use crate::Bitmap;
use crate::encode::FileFormat;
use crate::files::{exr, hdr, jpeg, pfm, png};

/// How large a picture file may be once decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DecodeLimits {
    /// The most pixels, width times height.
    pub max_pixels: u64,
    /// The most bytes of decoded colours: 3, 6 or 12 for each pixel, by the file's precision; 4, 8 or 16 with alpha.
    pub max_bytes: u64,
}

impl Default for DecodeLimits {
    /// 64 million pixels and a gibibyte.
    fn default() -> DecodeLimits {
        DecodeLimits { max_pixels: 64_000_000, max_bytes: 1 << 30 }
    }
}

impl DecodeLimits {
    /// The number of pixels of a picture of this size, if it is not empty and within the limits.
    pub(crate) fn check(&self, width: u32, height: u32, bytes_per_pixel: u64) -> Result<usize, DecodeError> {
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 {
            return Err(DecodeError::NoPixels { width, height });
        }
        if pixels > self.max_pixels {
            return Err(DecodeError::TooManyPixels { width, height, limit: self.max_pixels });
        }
        match usize::try_from(pixels) {
            Ok(count) if pixels.saturating_mul(bytes_per_pixel) <= self.max_bytes => Ok(count),
            _ => Err(DecodeError::TooManyBytes { width, height, limit: self.max_bytes }),
        }
    }
}

/// Why bytes are not a picture we can use.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// There are no bytes at all.
    #[error("the file is empty")]
    Empty,
    /// The first bytes are those of no format we read.
    #[error("not a PNG, JPEG, HDR, EXR or PFM file")]
    UnknownFormat,
    /// The header claims a width or height of zero.
    #[error("a picture of {width} × {height} pixels has none to use")]
    NoPixels {
        /// Width in the header.
        width: u32,
        /// Height in the header.
        height: u32,
    },
    /// More pixels than [`DecodeLimits::max_pixels`].
    #[error("{width} × {height} pixels are more than the limit of {}", in_words(*limit))]
    TooManyPixels {
        /// Width in the header.
        width: u32,
        /// Height in the header.
        height: u32,
        /// The limit.
        limit: u64,
    },
    /// More bytes than [`DecodeLimits::max_bytes`].
    #[error("{width} × {height} pixels need more than the limit of {limit} bytes")]
    TooManyBytes {
        /// Width in the header.
        width: u32,
        /// Height in the header.
        height: u32,
        /// The limit.
        limit: u64,
    },
    /// The file stops before the picture does.
    #[error("the file ends too early")]
    Truncated,
    /// The file breaks the rules of its format.
    #[error("broken {}: {detail}", format.name())]
    Corrupt {
        /// The format it was recognised as.
        format: FileFormat,
        /// What is broken.
        detail: String,
    },
    /// The file may be right, but uses something that we do not read.
    #[error("{} with {detail} cannot be read", format.name())]
    Unsupported {
        /// The format it was recognised as.
        format: FileFormat,
        /// What it uses.
        detail: String,
    },
}

/// A count as people say it: "64 million".
fn in_words(count: u64) -> String {
    if count >= 1_000_000 && count.is_multiple_of(1_000_000) {
        format!("{} million", count / 1_000_000)
    } else {
        count.to_string()
    }
}

/// Reads a PNG, JPEG, Radiance HDR, EXR or PFM file, whichever its content says it is.
///
/// Embedded colour profiles and gamma notes are ignored: the colours come as stored. Rotation notes of cameras (Exif)
/// are followed, so that a photo lies as viewers show it.
///
/// # Errors
/// If the bytes are not a complete, correct file of one of these formats, or more than `limits` allow. The size is
/// checked before memory for the pixels is allocated.
pub fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    match recognise(bytes)? {
        FileFormat::Png => png::decode(bytes, limits),
        FileFormat::Jpeg => jpeg::decode(bytes, limits),
        FileFormat::Hdr => hdr::decode(bytes, limits),
        FileFormat::Exr => exr::decode(bytes, limits),
        FileFormat::Pfm => pfm::decode(bytes, limits),
    }
}

/// The format by the first bytes.
pub(crate) fn recognise(bytes: &[u8]) -> Result<FileFormat, DecodeError> {
    const SIGNATURES: [(&[u8], FileFormat); 6] = [
        (b"\x89PNG\r\n\x1a\n", FileFormat::Png),
        (b"\xff\xd8\xff", FileFormat::Jpeg),
        (b"#?", FileFormat::Hdr),
        (b"\x76\x2f\x31\x01", FileFormat::Exr),
        (b"PF", FileFormat::Pfm),
        (b"Pf", FileFormat::Pfm),
    ];
    if bytes.is_empty() {
        return Err(DecodeError::Empty);
    }
    let known = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature));
    known.map(|&(_, format)| format).ok_or(DecodeError::UnknownFormat)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_files_are_refused_in_plain_words() {
        let message = |bytes: &[u8]| decode(bytes, &DecodeLimits::default()).map_err(|e| e.to_string());
        assert_eq!(message(b""), Err("the file is empty".into()));
        for bytes in [b"GIF89a".as_slice(), b"\0", b"P", b"<svg/>", b"\x89PNG\n"] {
            assert_eq!(message(bytes), Err("not a PNG, JPEG, HDR, EXR or PFM file".into()));
        }
    }

    #[test]
    fn limits_say_what_they_are() {
        let limits = DecodeLimits::default();
        assert_eq!(limits.check(8000, 8000, 12).ok(), Some(64_000_000));
        let error = limits.check(60000, 60000, 3).unwrap_err();
        assert_eq!(error.to_string(), "60000 × 60000 pixels are more than the limit of 64 million");
        let error = DecodeLimits { max_pixels: u64::MAX, max_bytes: 1000 }.check(u32::MAX, u32::MAX, 12).unwrap_err();
        assert!(error.to_string().ends_with("need more than the limit of 1000 bytes"), "{error}");
        let error = DecodeLimits { max_pixels: 1_500_000, max_bytes: 1000 }.check(1 << 30, 3, 12).unwrap_err();
        assert!(error.to_string().ends_with("more than the limit of 1500000"), "{error}");
        assert!(matches!(limits.check(0, 7, 3), Err(DecodeError::NoPixels { width: 0, height: 7 })));
    }
}
