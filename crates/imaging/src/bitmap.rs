//! What a picture file held, as it held it.

use durer_math::Rgb;

use crate::{Image, Transfer};

/// The pixels of a picture file, as stored: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// `width * height` colours.
    pub texels: Texels,
    /// How much of each pixel is there; `None` if all of all is.
    pub alpha: Option<Alpha>,
}

/// An alpha channel, in the precision of the file: `width * height` numbers, which know no transfer curve. Colours are
/// not multiplied by it nor divided; in most PNG they are without it, in most EXR with it.
#[derive(Clone, Debug, PartialEq)]
pub enum Alpha {
    /// Of 255.
    U8(Vec<u8>),
    /// Of 65535.
    U16(Vec<u16>),
    /// Of 1.
    F32(Vec<f32>),
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

impl Alpha {
    /// Number of pixels.
    #[allow(clippy::len_without_is_empty)] // a picture has pixels
    pub fn len(&self) -> usize {
        match self {
            Alpha::U8(numbers) => numbers.len(),
            Alpha::U16(numbers) => numbers.len(),
            Alpha::F32(numbers) => numbers.len(),
        }
    }

    /// That of the pixel with this index: 0 where nothing is, 1 where all is.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn get(&self, index: usize) -> f32 {
        match self {
            Alpha::U8(numbers) => f32::from(numbers[index]) / 255.0,
            Alpha::U16(numbers) => f32::from(numbers[index]) / 65535.0,
            Alpha::F32(numbers) => numbers[index],
        }
    }
}

impl Bitmap {
    /// Bytes that the pixels take.
    pub fn memory(&self) -> u64 {
        let texels = match &self.texels {
            Texels::U8(texels) => size_of_val(texels.as_slice()),
            Texels::U16(texels) => size_of_val(texels.as_slice()),
            Texels::F32(texels) => size_of_val(texels.as_slice()),
        };
        let alphas = match &self.alpha {
            Some(Alpha::U8(numbers)) => size_of_val(numbers.as_slice()),
            Some(Alpha::U16(numbers)) => size_of_val(numbers.as_slice()),
            Some(Alpha::F32(numbers)) => size_of_val(numbers.as_slice()),
            None => 0,
        };
        (texels + alphas) as u64
    }

    /// The picture in linear light, `transfer` being how the file's whole numbers were made from it. Floating-point
    /// texels are linear already and stay as they are.
    pub fn to_image(&self, transfer: Transfer) -> Image {
        let pixels = match &self.texels {
            Texels::U8(texels) => {
                let linear: Vec<f32> = (0..=255u8).map(|v| linear_from_u8(v, transfer)).collect();
                texels.iter().map(|texel| Rgb::from(texel.map(|v| linear[usize::from(v)]))).collect()
            }
            Texels::U16(texels) => {
                texels.iter().map(|texel| Rgb::from(texel.map(|v| linear_from_u16(v, transfer)))).collect()
            }
            Texels::F32(texels) => texels.iter().map(|&texel| Rgb::from(texel)).collect(),
        };
        Image { width: self.width, height: self.height, pixels }
    }
}

fn linear_from_u8(value: u8, transfer: Transfer) -> f32 {
    transfer.linear_from_stored(f32::from(value) / 255.0)
}

fn linear_from_u16(value: u16, transfer: Transfer) -> f32 {
    transfer.linear_from_stored(f32::from(value) / 65535.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(texels: Texels, transfer: Transfer) -> Rgb {
        Bitmap { width: 1, height: 1, texels, alpha: None }.to_image(transfer).pixel(0, 0)
    }

    #[test]
    fn every_depth_reaches_black_and_white() {
        for transfer in [Transfer::Srgb, Transfer::Linear] {
            assert_eq!(one(Texels::U8(vec![[0, 255, 0]]), transfer), Rgb::new(0.0, 1.0, 0.0));
            assert_eq!(one(Texels::U16(vec![[0, 65535, 0]]), transfer), Rgb::new(0.0, 1.0, 0.0));
        }
    }

    #[test]
    fn floats_are_linear_whatever_is_asked() {
        let texels = Texels::F32(vec![[0.5, -1.0, 7.0]]);
        assert_eq!(one(texels.clone(), Transfer::Srgb), Rgb::new(0.5, -1.0, 7.0));
        assert_eq!(one(texels, Transfer::Linear), Rgb::new(0.5, -1.0, 7.0));
    }

    #[test]
    fn alpha_reaches_0_and_1_in_every_depth() {
        for alpha in [Alpha::U8(vec![0, 255]), Alpha::U16(vec![0, 65535]), Alpha::F32(vec![0.0, 1.0])] {
            assert_eq!((alpha.len(), alpha.get(0), alpha.get(1)), (2, 0.0, 1.0));
        }
        assert_eq!(Alpha::U8(vec![51]).get(0), 0.2);
    }

    #[test]
    fn whole_numbers_follow_the_curve() {
        let srgb = one(Texels::U8(vec![[188, 188, 188]]), Transfer::Srgb);
        assert!((srgb.r - 0.502_886).abs() < 1e-5, "{srgb:?}");
        assert_eq!(one(Texels::U8(vec![[51, 51, 51]]), Transfer::Linear), Rgb::gray(0.2));
    }
}
