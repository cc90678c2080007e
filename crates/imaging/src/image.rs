//! A picture in linear light.

use durer_math::{Fingerprint, Rgb};

/// A picture in linear light: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` colours, row by row.
    pub pixels: Vec<Rgb>,
}

impl Image {
    /// A black picture.
    pub fn new(width: u32, height: u32) -> Image {
        Image { width, height, pixels: vec![Rgb::BLACK; width as usize * height as usize] }
    }

    /// A picture of these colours, row by row from the top; `None` if there are not `width * height` of them.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<Rgb>) -> Option<Image> {
        let image = Image { width, height, pixels };
        image.has_all_pixels().then_some(image)
    }

    /// A picture whose pixel (x, y) is `color(x, y)`; called row by row from the top.
    pub fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> Rgb) -> Image {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| color(x, y)).collect();
        Image { width, height, pixels }
    }

    /// The colour of the pixel in column `x` from the left and row `y` from the top.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Rgb {
        self.pixels[self.index(x, y)]
    }

    /// Sets the colour of the pixel in column `x` from the left and row `y` from the top.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn set(&mut self, x: u32, y: u32, color: Rgb) {
        let index = self.index(x, y);
        self.pixels[index] = color;
    }

    /// The rows from the top, each of `width` colours; none if the picture is empty.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[Rgb]> + ExactSizeIterator {
        self.pixels.chunks_exact(self.width.max(1) as usize)
    }

    /// That of the picture to the last bit: of width, height and all numbers, each in four bytes, the lowest first.
    pub fn fingerprint(&self) -> Fingerprint {
        let mut bytes = Vec::with_capacity(8 + 12 * self.pixels.len());
        bytes.extend([self.width, self.height].into_iter().flat_map(u32::to_le_bytes));
        bytes.extend(self.pixels.iter().flat_map(|pixel| pixel.to_array()).flat_map(f32::to_le_bytes));
        Fingerprint::of(&bytes)
    }

    /// True if `pixels` has the length that width and height promise.
    pub(crate) fn has_all_pixels(&self) -> bool {
        self.pixels.len() as u64 == u64::from(self.width) * u64::from(self.height)
    }

    fn index(&self, x: u32, y: u32) -> usize {
        assert!(x < self.width && y < self.height, "({x}, {y}) is outside {} × {}", self.width, self.height);
        y as usize * self.width as usize + x as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_in_rows_from_the_top() {
        let mut image = Image::from_fn(3, 2, |x, y| Rgb::new(x as f32, y as f32, 0.0));
        assert_eq!(image.pixel(2, 1), Rgb::new(2.0, 1.0, 0.0));
        assert_eq!(image.pixels[5], image.pixel(2, 1));
        image.set(0, 1, Rgb::WHITE);
        assert_eq!(image.pixels[3], Rgb::WHITE);
        assert_eq!(image.rows().len(), 2);
        assert_eq!(image.rows().next_back().map(|row| row[0]), Some(Rgb::WHITE));
    }

    #[test]
    fn the_number_of_pixels_must_fit() {
        assert!(Image::from_pixels(2, 2, vec![Rgb::BLACK; 4]).is_some());
        assert!(Image::from_pixels(2, 2, vec![Rgb::BLACK; 3]).is_none());
        assert_eq!(Image::new(0, 5).rows().len(), 0);
    }
}
