//! Transfer functions between linear light and the numbers in picture files.

/// How linear light becomes the numbers of a picture file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// The transfer curve of sRGB (IEC 61966-2-1), which screens expect.
    #[default]
    Srgb,
    /// The numbers as they are.
    Linear,
}
