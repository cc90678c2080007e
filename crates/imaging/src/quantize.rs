//! From linear light to the whole numbers of 8- and 16-bit files, clamped to black and white; NaN becomes black.
//!
//! Eight bits are on the way of every picture that is saved, and computing the sRGB curve takes a power for each
//! component. [`ByteQuantizer`] looks the byte up instead and still gives, for every float, the byte that
//! [`byte_from_linear`] computes: the test at the end compares them.

use crate::Transfer;
use durer_math::Rgb;

/// The byte stored for an amount of linear light, computed the slow way. This is the definition.
pub(crate) fn byte_from_linear(linear: f32, transfer: Transfer) -> u8 {
    // The product is exact in double precision, so this rounds once, halves upward; `as` clamps and maps NaN to 0.
    (f64::from(transfer.stored_from_linear(linear)) * 255.0 + 0.5) as u8
}

/// The bytes of these colours, three each.
pub(crate) fn bytes_from_linear(pixels: &[Rgb], transfer: Transfer) -> Vec<u8> {
    let mut bytes = vec![0; pixels.len() * 3];
    ByteQuantizer::new(transfer).put(pixels, &mut bytes);
    bytes
}

/// Turns linear light into bytes quickly.
pub(crate) enum ByteQuantizer {
    /// By the curve of sRGB.
    Srgb(SrgbQuantizer),
    /// As it is, which is quick.
    Linear,
}

impl ByteQuantizer {
    pub(crate) fn new(transfer: Transfer) -> ByteQuantizer {
        match transfer {
            Transfer::Srgb => ByteQuantizer::Srgb(SrgbQuantizer::new()),
            Transfer::Linear => ByteQuantizer::Linear,
        }
    }

    /// Puts the bytes of some colours, three each.
    #[inline]
    pub(crate) fn put(&self, pixels: &[Rgb], bytes: &mut [u8]) {
        match self {
            ByteQuantizer::Srgb(srgb) => put_each(pixels, bytes, |v| srgb.byte(v)),
            ByteQuantizer::Linear => put_each(pixels, bytes, |v| byte_from_linear(v, Transfer::Linear)),
        }
    }
}

#[inline(always)]
fn put_each(pixels: &[Rgb], bytes: &mut [u8], byte: impl Fn(f32) -> u8) {
    for (pixel, bytes) in pixels.iter().zip(bytes.as_chunks_mut::<3>().0) {
        *bytes = [byte(pixel.r), byte(pixel.g), byte(pixel.b)];
    }
}

/// The 16-bit number stored for an amount of linear light.
pub(crate) fn word_from_linear(linear: f32, transfer: Transfer) -> u16 {
    (f64::from(transfer.stored_from_linear(linear)) * 65535.0 + 0.5) as u16
}

/// Below this every sRGB byte is 0: the first step, to 1, is at 1.5·10⁻⁴.
const SMALLEST: f32 = 1.0 / 8192.0;

/// The largest float below 1, which is white.
const LARGEST: f32 = 1.0_f32.next_down();

/// Floats that agree in all but their last 16 bits share a bucket: 128 buckets for each power of two.
const BUCKET_BITS: u32 = 16;

/// From [`SMALLEST`] up to 1. No two steps share one.
const BUCKETS: usize = ((1.0_f32.to_bits() - SMALLEST.to_bits()) >> BUCKET_BITS) as usize;

/// The floats of one bucket become `below`, from `step` on `below + 1`.
#[derive(Clone, Copy)]
struct Bucket {
    step: f32,
    below: u8,
}

/// Turns linear light into bytes of the sRGB curve quickly.
pub(crate) struct SrgbQuantizer {
    buckets: Box<[Bucket; BUCKETS]>,
}

impl SrgbQuantizer {
    fn new() -> SrgbQuantizer {
        let steps = srgb_steps();
        let bucket = |index: usize| {
            let first = f32::from_bits(SMALLEST.to_bits() + ((index as u32) << BUCKET_BITS));
            let below = steps.partition_point(|&step| step <= first);
            Bucket { step: steps.get(below).copied().unwrap_or(f32::INFINITY), below: below as u8 }
        };
        SrgbQuantizer { buckets: Box::new(std::array::from_fn(bucket)) }
    }

    /// The same byte as [`byte_from_linear`], for every float.
    #[inline(always)]
    fn byte(&self, linear: f32) -> u8 {
        // The first bucket is that of black, also for NaN, and the last that of white.
        let linear = if linear > SMALLEST { linear } else { SMALLEST };
        let linear = if linear < LARGEST { linear } else { LARGEST };
        let bucket = self.buckets[bucket_index(linear).min(BUCKETS - 1)];
        bucket.below + u8::from(linear >= bucket.step)
    }
}

/// The bucket of a float of at least [`SMALLEST`].
fn bucket_index(linear: f32) -> usize {
    ((linear.to_bits() - SMALLEST.to_bits()) >> BUCKET_BITS) as usize
}

/// For each byte from 1 to 255 the smallest float that becomes it, found by bisecting the bits of the floats: of those near
/// the one that the inverse of the curve gives, if it is one of them.
fn srgb_steps() -> Vec<f32> {
    (1..=255u8)
        .map(|byte| {
            let reaches = |bits: u32| byte_from_linear(f32::from_bits(bits), Transfer::Srgb) >= byte;
            let about = Transfer::Srgb.linear_from_stored((f32::from(byte) - 0.5) / 255.0).to_bits();
            let near = (about - 16, about + 16);
            let (mut low, mut high) = if !reaches(near.0) && reaches(near.1) { near } else { (0, 1f32.to_bits()) };
            while high - low > 1 {
                let middle = low + (high - low) / 2;
                if reaches(middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            f32::from_bits(high)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(quantizer: &SrgbQuantizer, bits: u32) {
        let x = f32::from_bits(bits);
        assert_eq!(quantizer.byte(x), byte_from_linear(x, Transfer::Srgb), "{x:e} ({bits:#x})");
    }

    #[test]
    fn no_bucket_has_two_steps() {
        let steps = srgb_steps();
        assert_eq!(steps.len(), 255);
        assert!(steps[0] > SMALLEST);
        for pair in steps.windows(2) {
            assert!(bucket_index(pair[0]) < bucket_index(pair[1]), "{pair:?}");
        }
    }

    #[test]
    fn agrees_with_the_definition_around_every_step() {
        let quantizer = SrgbQuantizer::new();
        for step in srgb_steps() {
            for bits in step.to_bits() - 2000..=step.to_bits() + 2000 {
                check(&quantizer, bits);
            }
        }
    }

    #[test]
    fn agrees_with_the_definition_over_all_floats() {
        let quantizer = SrgbQuantizer::new();
        (0..=u32::MAX).step_by(4093).for_each(|bits| check(&quantizer, bits));
    }

    #[test]
    fn agrees_with_the_definition_for_every_float_from_black_to_white() {
        let quantizer = SrgbQuantizer::new();
        (0..=1f32.to_bits()).for_each(|bits| check(&quantizer, bits));
    }

    #[test]
    fn out_of_range_is_clamped_and_nan_is_black() {
        for transfer in [Transfer::Srgb, Transfer::Linear] {
            let values = [-1.0, -0.0, 1.0, 7.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 0.0, 1.0];
            let colors: Vec<Rgb> = values.as_chunks().0.iter().map(|&[r, g, b]| Rgb::new(r, g, b)).collect();
            assert_eq!(bytes_from_linear(&colors, transfer), [0, 0, 255, 255, 255, 0, 0, 0, 255]);
            let words = [-1.0, 1.0, 7.0, f32::INFINITY, f32::NAN].map(|x| word_from_linear(x, transfer));
            assert_eq!(words, [0, 65535, 65535, 65535, 0]);
        }
    }
}
