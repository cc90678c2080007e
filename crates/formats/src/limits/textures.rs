//! Images: what is left for them, and what to say of those that are too large.

use super::{Limit, Limits};
use durer_imaging::{DecodeError, DecodeLimits};

/// What one more image may take if others take so many bytes.
pub(crate) fn left(limits: &Limits, taken: u64) -> DecodeLimits {
    DecodeLimits { max_pixels: u64::MAX, max_bytes: limits.max_texture_bytes.saturating_sub(taken) }
}

/// What to do about an image that cannot be had.
pub(crate) fn help(error: &DecodeError) -> Option<String> {
    let key = Limit::Textures.key();
    let too_large = matches!(error, DecodeError::TooManyBytes { .. } | DecodeError::TooManyPixels { .. });
    too_large.then(|| format!("if you trust this scene, raise the limit for all images: `--limits {key}=…`"))
}
