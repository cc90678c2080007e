//! Transfer functions between linear light and the numbers in picture files.

use durer_math::functions::pow;

/// How linear light becomes the numbers of a picture file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// The transfer curve of sRGB (IEC 61966-2-1), which screens expect.
    #[default]
    Srgb,
    /// The numbers as they are.
    Linear,
}

impl Transfer {
    /// The number stored for an amount of linear light, where 1 is white. Not clamped.
    pub fn stored_from_linear(self, linear: f32) -> f32 {
        match self {
            Transfer::Srgb => srgb_from_linear(linear),
            Transfer::Linear => linear,
        }
    }

    /// The amount of linear light that a stored number stands for, where 1 is white. Not clamped.
    pub fn linear_from_stored(self, stored: f32) -> f32 {
        match self {
            Transfer::Srgb => linear_from_srgb(stored),
            Transfer::Linear => stored,
        }
    }
}

/// The sRGB number for an amount of linear light, by the two pieces of IEC 61966-2-1; 0 ↦ 0 and 1 ↦ 1.
///
/// Not clamped: above 1 the power goes on, below 0 the straight piece does. NaN stays NaN.
pub fn srgb_from_linear(linear: f32) -> f32 {
    // In single precision 1.055 - 0.055 is not 1, so white would not stay white: hence double.
    if linear <= 0.003_130_8 { 12.92 * linear } else { (1.055 * f64::from(pow(linear, 1.0 / 2.4)) - 0.055) as f32 }
}

/// The amount of linear light of an sRGB number, by the two pieces of IEC 61966-2-1; 0 ↦ 0 and 1 ↦ 1.
///
/// Not clamped: above 1 the power goes on, below 0 the straight piece does. NaN stays NaN.
pub fn linear_from_srgb(srgb: f32) -> f32 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { pow(((f64::from(srgb) + 0.055) / 1.055) as f32, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        let pairs =
            [(0.0, 0.0), (1.0, 1.0), (0.5, 0.735_357), (0.18, 0.461_356_13), (0.214_041_14, 0.5), (0.001, 0.012_92)];
        for (linear, srgb) in pairs {
            assert!((srgb_from_linear(linear) - srgb).abs() < 2e-7, "{linear}");
            assert!((linear_from_srgb(srgb) - linear).abs() < 2e-7, "{srgb}");
        }
    }

    #[test]
    fn white_and_black_are_exact() {
        assert_eq!((srgb_from_linear(0.0), srgb_from_linear(1.0)), (0.0, 1.0));
        assert_eq!((linear_from_srgb(0.0), linear_from_srgb(1.0)), (0.0, 1.0));
    }

    #[test]
    fn the_two_directions_are_inverse() {
        for i in 0..=65_535 {
            let s = i as f32 / 65_535.0;
            assert!((srgb_from_linear(linear_from_srgb(s)) - s).abs() < 6e-7, "{s}");
        }
    }

    #[test]
    fn outside_zero_to_one() {
        assert_eq!(srgb_from_linear(-1.0), -12.92);
        assert!(srgb_from_linear(2.0) > 1.3);
        assert!(srgb_from_linear(f32::NAN).is_nan() && linear_from_srgb(f32::NAN).is_nan());
    }
}
