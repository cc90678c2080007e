//! Errors as colours for people to look at.

use durer_math::Rgb;

use crate::flip::ErrorMap;
use crate::{Image, linear_from_srgb};

/// Coefficients, from the constant on, of polynomials for the sRGB components of the color map magma (van der Walt and
/// Smith, matplotlib, CC0), fitted by Zucker (CC0). The error is below 0.01 almost everywhere.
const MAGMA: [[f32; 3]; 7] = [
    [-0.002_136_485, -0.000_749_655, -0.005_386_128],
    [0.251_660_54, 0.677_523_24, 2.494_026_6],
    [8.353_717, -3.577_719_5, 0.314_467_9],
    [-27.668_733, 14.264_731, -13.649_213],
    [52.176_14, -27.943_606, 12.944_169],
    [-50.768_525, 29.046_583, 4.234_153],
    [18.655_706, -11.489_773, -5.601_961_5],
];

/// A picture of an error map: black is no error, then violet, red, orange, and pale yellow for 1.
pub fn false_color(map: &ErrorMap) -> Image {
    let pixels = map.values.iter().map(|&error| magma(error)).collect();
    Image { width: map.width, height: map.height, pixels }
}

/// The color of a value from 0 to 1; others are clamped, NaN is black.
pub(crate) fn magma(value: f32) -> Rgb {
    let t = if value > 0.0 { value.min(1.0) } else { 0.0 };
    let component = |channel: usize| MAGMA.iter().rev().fold(0.0, |sum, coefficients| sum * t + coefficients[channel]);
    Rgb::new(component(0), component(1), component(2)).map(|srgb| linear_from_srgb(srgb.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::srgb_from_linear;

    #[test]
    fn the_colors_are_those_of_magma() {
        let known = [(0.0, [0.001, 0.000, 0.014]), (0.5, [0.716, 0.215, 0.475]), (1.0, [0.987, 0.991, 0.750])];
        for (value, srgb) in known {
            let ours = magma(value).map(srgb_from_linear).to_array();
            for (a, b) in ours.iter().zip(srgb) {
                assert!((a - b).abs() < 0.025, "{value}: {ours:?}");
            }
        }
    }

    #[test]
    fn more_error_is_brighter() {
        let map = ErrorMap { width: 101, height: 1, values: (0..=100).map(|i| i as f32 / 100.0).collect() };
        let image = false_color(&map);
        assert_eq!((image.width, image.height), (101, 1));
        for pair in image.pixels.windows(2).skip(2) {
            assert!(pair[0].luminance() < pair[1].luminance(), "{pair:?}");
        }
        assert_eq!(magma(f32::NAN), magma(0.0));
    }
}
