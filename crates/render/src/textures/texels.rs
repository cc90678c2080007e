//! The pixels of an image as linear light. They stay as the file stored them and are looked up in a table when asked
//! for, so that a large photograph takes no more memory than its file unpacked.

use durer_imaging::{Bitmap, Texels as Stored, linear_from_srgb};
use durer_math::Rgb;
use durer_scene::{Channels, Encoding};
use std::sync::Arc;

/// The greatest number of a texel, as that of a light: more of it, times others, might be more than single precision
/// holds. Files of floating-point numbers hold any, negative ones among them.
pub(super) const BRIGHTEST: f32 = 1e6;

/// An image's pixels, to be read as linear light.
#[derive(Debug)]
pub(super) struct Texels {
    bitmap: Arc<Bitmap>,
    channels: Channels,
    /// What each number that the file can hold means; empty for floating point, which is linear light already.
    linear_from_stored: Arc<[f32]>,
}

/// The tables made so far, for the images still to come: one for each depth and encoding.
#[derive(Debug, Default)]
pub(super) struct Tables {
    u8_srgb: Option<Arc<[f32]>>,
    u8_linear: Option<Arc<[f32]>>,
    u16_srgb: Option<Arc<[f32]>>,
    u16_linear: Option<Arc<[f32]>>,
}

impl Tables {
    fn get(&mut self, stored: &Stored, encoding: Encoding) -> Arc<[f32]> {
        let (table, greatest) = match (stored, encoding) {
            (Stored::U8(_), Encoding::Srgb) => (&mut self.u8_srgb, u16::from(u8::MAX)),
            (Stored::U8(_), Encoding::Linear) => (&mut self.u8_linear, u16::from(u8::MAX)),
            (Stored::U16(_), Encoding::Srgb) => (&mut self.u16_srgb, u16::MAX),
            (Stored::U16(_), Encoding::Linear) => (&mut self.u16_linear, u16::MAX),
            (Stored::F32(_), Encoding::Srgb | Encoding::Linear) => return Arc::default(),
        };
        let linear_from = |number: u16| {
            let encoded = f32::from(number) / f32::from(greatest);
            match encoding {
                Encoding::Srgb => linear_from_srgb(encoded),
                Encoding::Linear => encoded,
            }
        };
        table.get_or_insert_with(|| (0..=greatest).map(linear_from).collect()).clone()
    }
}

impl Texels {
    pub(super) fn new(bitmap: &Arc<Bitmap>, channels: Channels, encoding: Encoding, tables: &mut Tables) -> Texels {
        let linear_from_stored = match channels {
            Channels::Color | Channels::Red | Channels::Green | Channels::Blue => tables.get(&bitmap.texels, encoding),
            // Alpha is linear whatever the colours are.
            Channels::Alpha => Arc::default(),
        };
        Texels { bitmap: bitmap.clone(), channels, linear_from_stored }
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.bitmap.width, self.bitmap.height]
    }

    /// The colour of a pixel, by its column from the left and its row from below. Both must be within the image.
    pub(super) fn get(&self, column: u32, row_from_below: u32) -> Rgb {
        let row = self.bitmap.height - 1 - row_from_below;
        let index = row as usize * self.bitmap.width as usize + column as usize;
        match self.channels {
            Channels::Color => self.color(index),
            Channels::Red => Rgb::gray(self.color(index).r),
            Channels::Green => Rgb::gray(self.color(index).g),
            Channels::Blue => Rgb::gray(self.color(index).b),
            Channels::Alpha => {
                Rgb::gray(self.bitmap.alpha.as_ref().map_or(1.0, |alpha| alpha.get(index)).clamp(0.0, 1.0))
            }
        }
    }

    fn color(&self, index: usize) -> Rgb {
        let table = &self.linear_from_stored;
        match &self.bitmap.texels {
            Stored::U8(texels) => texels[index].map(|number| table[usize::from(number)]).into(),
            Stored::U16(texels) => texels[index].map(|number| table[usize::from(number)]).into(),
            Stored::F32(texels) => texels[index].map(|number| number.clamp(0.0, BRIGHTEST)).into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_imaging::Alpha;

    fn texels(stored: Stored, encoding: Encoding, tables: &mut Tables) -> Texels {
        let bitmap = Bitmap { width: 1, height: 2, texels: stored, alpha: None };
        Texels::new(&Arc::new(bitmap), Channels::Color, encoding, tables)
    }

    #[test]
    fn alpha_is_gray_and_follows_no_curve() {
        let show = |alpha| {
            let bitmap = Bitmap { width: 1, height: 2, texels: Stored::U8(vec![[9; 3]; 2]), alpha };
            let image = Texels::new(&Arc::new(bitmap), Channels::Alpha, Encoding::Srgb, &mut Tables::default());
            [image.get(0, 1), image.get(0, 0)]
        };
        assert_eq!(show(Some(Alpha::U8(vec![51, 255]))), [Rgb::gray(0.2), Rgb::WHITE]);
        assert_eq!(show(Some(Alpha::U16(vec![13107, 0]))), [Rgb::gray(0.2), Rgb::BLACK]);
        assert_eq!(show(Some(Alpha::F32(vec![0.25, 1.0]))), [Rgb::gray(0.25), Rgb::WHITE]);
        assert_eq!(show(None), [Rgb::WHITE; 2], "a picture without alpha is all there");
    }

    #[test]
    fn rows_count_from_below() {
        let image = texels(Stored::F32(vec![[1.0; 3], [2.0; 3]]), Encoding::Linear, &mut Tables::default());
        assert_eq!((image.get(0, 0), image.get(0, 1)), (Rgb::gray(2.0), Rgb::gray(1.0)));
    }

    #[test]
    fn every_depth_and_encoding_is_read_as_linear_light() {
        let tables = &mut Tables::default();
        let byte = texels(Stored::U8(vec![[0; 3], [255, 188, 51]]), Encoding::Srgb, tables);
        assert_eq!(byte.get(0, 1), Rgb::BLACK);
        let color = byte.get(0, 0);
        assert!((color.r - 1.0).abs() < 1e-6 && (color.g - 0.502_886).abs() < 1e-5, "{color:?}");
        assert!((color.b - 0.033_105).abs() < 1e-6, "{color:?}");

        let word = texels(Stored::U16(vec![[0; 3], [65535, 188 * 257, 51 * 257]]), Encoding::Srgb, tables);
        assert_eq!(word.get(0, 0), color, "the same colours in 16 bits");

        let byte = texels(Stored::U8(vec![[0; 3], [255, 51, 102]]), Encoding::Linear, tables);
        assert_eq!(byte.get(0, 0), Rgb::new(1.0, 0.2, 0.4));
        let word = texels(Stored::U16(vec![[0; 3], [65535, 13107, 26214]]), Encoding::Linear, tables);
        assert_eq!(word.get(0, 0), Rgb::new(1.0, 0.2, 0.4));

        let float = texels(Stored::F32(vec![[0.0; 3], [0.5, 7.0, 0.25]]), Encoding::Srgb, tables);
        assert_eq!(float.get(0, 0), Rgb::new(0.5, 7.0, 0.25), "floating point is linear whatever the scene says");
    }

    #[test]
    fn numbers_no_light_can_have_are_brought_to_those_it_can() {
        let tables = &mut Tables::default();
        let float = texels(Stored::F32(vec![[0.0; 3], [-0.5, f32::MAX, f32::MIN]]), Encoding::Linear, tables);
        assert_eq!(float.get(0, 0), Rgb::new(0.0, 1e6, 0.0));
        let alpha = Some(Alpha::F32(vec![-3.0, 3.0]));
        let bitmap = Bitmap { width: 1, height: 2, texels: Stored::U8(vec![[9; 3]; 2]), alpha };
        let image = Texels::new(&Arc::new(bitmap), Channels::Alpha, Encoding::Linear, tables);
        assert_eq!([image.get(0, 1), image.get(0, 0)], [Rgb::BLACK, Rgb::WHITE]);
    }

    #[test]
    fn images_of_one_kind_share_their_table() {
        let tables = &mut Tables::default();
        let a = texels(Stored::U16(vec![[0; 3], [1; 3]]), Encoding::Srgb, tables);
        let b = texels(Stored::U16(vec![[2; 3], [3; 3]]), Encoding::Srgb, tables);
        assert!(Arc::ptr_eq(&a.linear_from_stored, &b.linear_from_stored));
    }
}
