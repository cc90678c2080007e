//! Functions of eight numbers at once: the arithmetic of [`durer_math::functions`], operation by operation, so that each lane
//! has the bits that its number would have alone.

use fearless_simd::{Simd, f32x8, f64x8, i64x8, prelude::*};
use std::f64::consts::{LN_2, LOG2_E};

/// Adding this rounds to a whole number, which then stands in the lowest bits.
const ROUND: f64 = (3_u64 << 51) as f64;

/// `functions::exp`.
#[inline(always)]
pub(crate) fn exp<S: Simd>(simd: S, x: f32x8<S>) -> f32x8<S> {
    let power = single(exp2_of(simd, double(x) * LOG2_E));
    let power = x.simd_gt(f32x8::splat(simd, 88.8)).select(f32x8::splat(simd, f32::INFINITY), power);
    x.simd_lt(f32x8::splat(simd, -87.3)).select(f32x8::splat(simd, 0.0), power)
}

/// `functions::pow_wide` of finite numbers, for bases above 0.
#[inline(always)]
pub(crate) fn pow_wide<S: Simd>(simd: S, base: f64x8<S>, exponent: f32x8<S>) -> f32x8<S> {
    let power = double(exponent) * log2_of(simd, base);
    let result = exp2_of(simd, power);
    let result = power.simd_gt(f64x8::splat(simd, 128.0)).select(f64x8::splat(simd, f64::INFINITY), result);
    single(power.simd_lt(f64x8::splat(simd, -150.0)).select(f64x8::splat(simd, 0.0), result))
}

#[inline(always)]
fn exp2_of<S: Simd>(simd: S, x: f64x8<S>) -> f64x8<S> {
    let rounded = x + ROUND;
    let r = (x - (rounded - ROUND)) * LN_2;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (r + 1.0) + r2 * (r * (1.0 / 6.0) + 0.5);
    let high = (r * (1.0 / 120.0) + 1.0 / 24.0) + r2 * (r * (1.0 / 5040.0) + 1.0 / 720.0);
    let two_to_n: f64x8<S> = ((rounded.bitcast::<i64x8<S>>() << 52) + i64x8::splat(simd, 1023 << 52)).bitcast();
    (low + r4 * high + (r4 * r4) * (1.0 / 40320.0)) * two_to_n
}

#[inline(always)]
fn log2_of<S: Simd>(simd: S, x: f64x8<S>) -> f64x8<S> {
    let root_of_half = i64x8::splat(simd, 0x3fe6_a09e_667f_3bcd);
    let mantissa = i64x8::splat(simd, (1 << 52) - 1);
    let shifted = x.bitcast::<i64x8<S>>() - root_of_half;
    // A whole number added to the bits of a great enough one is added to its value.
    let exponent = (shifted >> 52) + i64x8::splat(simd, ROUND.to_bits() as i64);
    let exponent = exponent.bitcast::<f64x8<S>>() - ROUND;
    let m: f64x8<S> = ((shifted & mantissa) + root_of_half).bitcast();
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let mut sum = f64x8::splat(simd, 1.0 / 13.0);
    for k in [1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0] {
        sum = sum * s2 + k;
    }
    exponent + s * 2.0 * sum * LOG2_E
}

/// In double precision.
#[inline(always)]
pub(crate) fn double<S: Simd>(x: f32x8<S>) -> f64x8<S> {
    x.combine(x).widen().0
}

/// Rounded to single precision.
#[inline(always)]
pub(crate) fn single<S: Simd>(x: f64x8<S>) -> f32x8<S> {
    x.narrow(x).split().0
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_geometry::{LANES, SimdLevel, World};
    use durer_math::functions;
    use fearless_simd::dispatch;

    /// What `dispatch!` wants, of each level that this machine has.
    fn levels() -> impl Iterator<Item = fearless_simd::Level> {
        SimdLevel::available().into_iter().map(|simd| {
            let plan = durer_geometry::Plan { simd, ..durer_geometry::Plan::default() };
            World::build(Vec::new(), plan).simd()
        })
    }

    #[test]
    fn each_lane_has_the_bits_of_its_number_alone() {
        for level in levels() {
            for i in 0..30_000 {
                let x: [f32; LANES] = std::array::from_fn(|lane| (i - 20_000) as f32 * 0.01 + lane as f32 * 0.001);
                let found: [f32; LANES] = dispatch!(level, simd => exp(simd, x.simd_into(simd)).into());
                assert_eq!(found.map(f32::to_bits), x.map(|x| functions::exp(x).to_bits()), "{x:?}");
                let base: [f64; LANES] =
                    std::array::from_fn(|lane| (f64::from(i) + 1.0) * [1e-9, 1e-6, 4e-5, 1e-3][lane % 4]);
                let exponent = [0.0, 0.5, 1.0, 40.0, 2.4, 1e4, 7.0, 1e7];
                let found: [f32; LANES] =
                    dispatch!(level, simd => pow_wide(simd, base.simd_into(simd), exponent.simd_into(simd)).into());
                let alone: [f32; LANES] = std::array::from_fn(|lane| functions::pow_wide(base[lane], exponent[lane]));
                assert_eq!(found.map(f32::to_bits), alone.map(f32::to_bits), "{base:?} to the power {exponent:?}");
            }
        }
    }
}
