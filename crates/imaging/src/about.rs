//! What a picture file says of itself, without a look at its pixels.

use crate::decode::recognise;
use crate::files::{exr, hdr, jpeg, pfm, png};
use crate::{DecodeError, FileFormat};

/// What a picture file says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFacts {
    /// The kind of file.
    pub format: FileFormat,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// What a pixel is made of, in words: `RGB, 8 bits each`.
    pub samples: String,
    /// Pairs of keyword and text, as [`EncodeOptions::metadata`](crate::EncodeOptions::metadata) has them. Those of PNG and
    /// EXR; from the other formats none are read.
    pub metadata: Vec<(String, String)>,
}

/// What the header of a picture file says, whichever format its content says it is.
///
/// # Errors
/// If the bytes do not begin as a file of a known format, or its header is broken. What comes after may be.
pub fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    match recognise(bytes)? {
        FileFormat::Png => png::about(bytes),
        FileFormat::Jpeg => jpeg::about(bytes),
        FileFormat::Hdr => hdr::about(bytes),
        FileFormat::Exr => exr::about(bytes),
        FileFormat::Pfm => pfm::about(bytes),
    }
}

impl FileFacts {
    /// Those of a file without metadata.
    pub(crate) fn plain(format: FileFormat, (width, height): (u32, u32), samples: &str) -> FileFacts {
        FileFacts { format, width, height, samples: samples.to_owned(), metadata: Vec::new() }
    }
}
