//! How two pictures differ, as numbers and as a map.
//!
//! Pictures are compared as seen on a screen: each component clamped to 0..1 (NaN is black) and sRGB-encoded. So two
//! colours beyond white are the same, and differences in the dark count as much as the eye gives them.

use durer_math::Rgb;
use thiserror::Error;

use crate::flip::{self, ErrorMap};
use crate::{Image, srgb_from_linear};

/// How much two pictures differ, as seen: see [`compare`].
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The largest absolute difference of a component of a pixel, from 0 to 1.
    pub max: f64,
    /// Column and row of the first pixel, row by row from the top, that has the largest difference; (0, 0) if the
    /// pictures are the same.
    pub max_at: (u32, u32),
    /// The mean of the absolute differences over all pixels and components.
    pub mean: f64,
    /// The root of the mean of the squared differences over all pixels and components.
    pub rms: f64,
    /// The share of pixels with any difference at all, from 0 to 1.
    pub differing_share: f64,
    /// The mean of [`flip`](Difference::flip).
    pub flip_mean: f64,
    /// The FLIP error of each pixel.
    pub flip: ErrorMap,
}

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CompareError {
    /// Width or height differ.
    #[error("the pictures differ in size: {} × {} and {} × {} pixels", a.0, a.1, b.0, b.1)]
    Sizes {
        /// Width and height of the first.
        a: (u32, u32),
        /// Width and height of the second.
        b: (u32, u32),
    },
    /// The length of [`Image::pixels`] is not width times height.
    #[error("a picture has not as many colors as its size says")]
    WrongPixelCount,
}

/// Compares two pictures of the same size, as seen on a screen: clamped to 0..1 and sRGB-encoded. Symmetric, but for
/// rounding. Beside plain differences it gives the FLIP error for 67 pixels per degree of visual angle, the paper's
/// default: a monitor of 0.7 m width and 3840 pixels, seen from 0.7 m.
///
/// # Errors
/// If the sizes differ or a picture has not as many colours as its size says.
pub fn compare(a: &Image, b: &Image) -> Result<Difference, CompareError> {
    if (a.width, a.height) != (b.width, b.height) {
        return Err(CompareError::Sizes { a: (a.width, a.height), b: (b.width, b.height) });
    }
    if !a.has_all_pixels() || !b.has_all_pixels() {
        return Err(CompareError::WrongPixelCount);
    }
    let sums = Sums::of(a, b);
    let pixels = a.pixels.len().max(1) as f64;
    let flip = flip::error_map(a, b);
    Ok(Difference {
        max: sums.max,
        max_at: (sums.max_index as u32 % a.width.max(1), (sums.max_index / a.width.max(1) as usize) as u32),
        mean: sums.absolute / (3.0 * pixels),
        rms: (sums.squared / (3.0 * pixels)).sqrt(),
        differing_share: sums.differing as f64 / pixels,
        flip_mean: flip.mean(),
        flip,
    })
}

/// What is gathered pixel by pixel, always in the same order.
#[derive(Default)]
struct Sums {
    max: f64,
    max_index: usize,
    absolute: f64,
    squared: f64,
    differing: usize,
}

impl Sums {
    fn of(a: &Image, b: &Image) -> Sums {
        let mut sums = Sums::default();
        for (index, (&a, &b)) in a.pixels.iter().zip(&b.pixels).enumerate() {
            if a != b {
                sums.add(index, as_seen(a), as_seen(b));
            }
        }
        sums
    }

    fn add(&mut self, index: usize, a: Rgb, b: Rgb) {
        for (a, b) in a.to_array().into_iter().zip(b.to_array()) {
            let difference = (f64::from(a) - f64::from(b)).abs();
            self.absolute += difference;
            self.squared += difference * difference;
            if difference > self.max {
                (self.max, self.max_index) = (difference, index);
            }
        }
        self.differing += usize::from(a != b);
    }
}

/// The colour that a screen shows: clamped and sRGB-encoded.
fn as_seen(color: Rgb) -> Rgb {
    clamped(color).map(srgb_from_linear)
}

/// The colour that a screen shows, in linear light: clamped, NaN becoming black.
pub(crate) fn clamped(color: Rgb) -> Rgb {
    color.map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_from_srgb;

    fn gray(srgb: f32) -> Rgb {
        Rgb::gray(linear_from_srgb(srgb))
    }

    #[test]
    fn identical_pictures_do_not_differ() {
        let image = Image::from_fn(40, 30, |x, y| Rgb::new(x as f32 / 40.0, y as f32 / 30.0, (x * y % 7) as f32 * 0.3));
        let d = compare(&image, &image).unwrap();
        assert_eq!((d.max, d.max_at, d.mean, d.rms), (0.0, (0, 0), 0.0, 0.0));
        assert_eq!((d.differing_share, d.flip_mean), (0.0, 0.0));
        assert!(d.flip.values.iter().all(|&error| error == 0.0));
    }

    #[test]
    fn one_pixel_in_one_component() {
        let black = Image::new(10, 4);
        let mut other = black.clone();
        other.set(7, 2, Rgb::new(0.0, linear_from_srgb(0.6), 0.0));
        let d = compare(&black, &other).unwrap();
        assert!((d.max - 0.6).abs() < 1e-6 && d.max_at == (7, 2), "{d:?}");
        assert!((d.mean - 0.6 / 120.0).abs() < 1e-8);
        assert!((d.rms - 0.6 / 120f64.sqrt()).abs() < 1e-7);
        assert_eq!(d.differing_share, 1.0 / 40.0);
        assert!(d.flip_mean > 0.0 && d.flip_mean < 1.0);
    }

    #[test]
    fn gray_against_gray_everywhere() {
        let a = Image { width: 3, height: 3, pixels: vec![gray(0.25); 9] };
        let b = Image { width: 3, height: 3, pixels: vec![gray(0.75); 9] };
        let d = compare(&a, &b).unwrap();
        for number in [d.max, d.mean, d.rms] {
            assert!((number - 0.5).abs() < 1e-6, "{d:?}");
        }
        assert_eq!((d.max_at, d.differing_share), ((0, 0), 1.0));
    }

    #[test]
    fn what_cannot_be_seen_is_no_difference() {
        let of = |pixels: [f32; 3]| Image { width: 3, height: 1, pixels: pixels.map(Rgb::gray).to_vec() };
        let d = compare(&of([1.0, 0.0, 0.0]), &of([9.0, -3.0, f32::NAN])).unwrap();
        assert_eq!((d.max, d.differing_share, d.flip_mean), (0.0, 0.0, 0.0));
    }

    #[test]
    fn sizes_must_agree() {
        let error = compare(&Image::new(4, 3), &Image::new(3, 4)).unwrap_err();
        assert_eq!(error.to_string(), "the pictures differ in size: 4 × 3 and 3 × 4 pixels");
        let broken = Image { width: 4, height: 3, pixels: Vec::new() };
        assert_eq!(compare(&Image::new(4, 3), &broken), Err(CompareError::WrongPixelCount));
        assert_eq!(compare(&Image::new(0, 0), &Image::new(0, 0)).map(|d| d.flip_mean), Ok(0.0));
    }
}
