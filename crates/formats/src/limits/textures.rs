//! Images: what is left for them, and what to say of those that are too large.

use super::{Limit, Limits};
use durer_imaging::{DecodeError, DecodeLimits};

/// What one more image may take if others take so many bytes.
pub(crate) fn left(limits: &Limits, taken: u64) -> DecodeLimits {
    DecodeLimits { max_pixels: u64::MAX, max_bytes: limits.max_texture_bytes.saturating_sub(taken) }
}

/// What to do about an image that cannot be had.
pub(crate) fn help(error: &DecodeError) -> Option<String> {
    match error {
        DecodeError::TooManyBytes { .. } | DecodeError::TooManyPixels { .. } => {
            let key = Limit::Textures.key();
            Some(format!("if you trust this scene, raise the limit for all images: `--limits {key}=…`"))
        }
        DecodeError::UnknownFormat => Some("convert it to one of these, for example in an image editor".to_owned()),
        DecodeError::Empty | DecodeError::Truncated => {
            Some("part of it has been lost: copy or download it again".to_owned())
        }
        DecodeError::Corrupt { .. } | DecodeError::Unsupported { .. } => {
            Some("open it in an image editor and save it again, as PNG or as OpenEXR".to_owned())
        }
        // Errors may grow in number.
        _ => None,
    }
}
