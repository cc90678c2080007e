//! The picture formats, one per file, each with its reader and its writer.

pub(crate) mod exr;
pub(crate) mod hdr;
pub(crate) mod jpeg;
pub(crate) mod pfm;
pub(crate) mod png;
