//! What a picture file held, as it held it.

/// The pixels of a picture file, as stored: rows from the top, pixels from the left. Alpha is dropped (and said so).
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// `width * height` colours.
    pub texels: Texels,
    /// True if the file had an alpha channel that is not opaque everywhere; it was dropped.
    pub alpha_dropped: bool,
}

/// Colours in the precision of the file.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// 8 bits a component, of 255.
    U8(Vec<[u8; 3]>),
    /// 16 bits a component, of 65535.
    U16(Vec<[u16; 3]>),
    /// Floating point: linear light, whatever the scene says of the file's encoding.
    F32(Vec<[f32; 3]>),
}
