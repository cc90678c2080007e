//! Transcendental functions that give the same bits on every machine.
//!
//! The platform's own differ in their last bits between systems, so pictures may not depend on them; a lint forbids
//! them. Most come from `libm`, which is written in plain arithmetic. [`exp`] and [`pow`] in single precision are ours,
//! because shading calls them for every ray and `libm`'s `pow` is several times slower than needed.

/// Sine of an angle in radians.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent of an angle in radians.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Arc sine, in radians.
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Arc cosine, in radians.
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// The angle of the point (x, y), in radians, in (-π, π].
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Cube root.
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// `base` to the power `exponent`, in double precision.
pub fn pow_double(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// Cosine and sine of an angle in whole turns: of 2π times `turns`, for |turns| ≤ 2⁵⁰, with errors below 3·10⁻¹⁶.
///
/// Quarters of a turn are taken off exactly, which radians do not allow, and what is left, at most an eighth, goes into two
/// Taylor polynomials. Several times as fast as [`sin`] and [`cos`].
#[inline]
pub fn cos_sin_of_turns(turns: f64) -> (f64, f64) {
    // Adding this rounds to a whole number, which then stands in the lowest bits.
    const ROUND: f64 = (3_u64 << 51) as f64;
    let rounded = turns * 4.0 + ROUND;
    let (cosine, sine) = cos_sin_near_zero((turns * 4.0 - (rounded - ROUND)) * std::f64::consts::FRAC_PI_2);
    // Quarters make them change places and signs. Which quarter it is no processor can guess, so that choosing beats jumping.
    let quarter = rounded.to_bits() & 3;
    let (a, b) = if quarter & 1 == 0 { (cosine, sine) } else { (sine, cosine) };
    let with_sign = |x: f64, minus: u64| f64::from_bits(x.to_bits() ^ (minus & 2) << 62);
    (with_sign(a, quarter + 1), with_sign(b, quarter))
}

/// Cosine and sine of an angle of at most π/4 to either side, in radians, with errors below 3·10⁻¹⁶.
#[inline]
pub fn cos_sin_near_zero(x: f64) -> (f64, f64) {
    let x2 = x * x;
    let x4 = x2 * x2;
    // Terms up to the 17th power, those of every other pair apart, so that they do not wait for each other.
    let sine = 1.0 - x2 * (1.0 / 6.0)
        + x4 * ((1.0 / 120.0 - x2 * (1.0 / 5_040.0))
            + x4 * ((1.0 / 362_880.0 - x2 * (1.0 / 39_916_800.0))
                + x4 * (1.0 / 6_227_020_800.0 - x2 * (1.0 / 1_307_674_368_000.0))));
    let cosine = 1.0 - x2 * 0.5
        + x4 * ((1.0 / 24.0 - x2 * (1.0 / 720.0))
            + x4 * ((1.0 / 40_320.0 - x2 * (1.0 / 3_628_800.0))
                + x4 * ((1.0 / 479_001_600.0 - x2 * (1.0 / 87_178_291_200.0)) + x4 * (1.0 / 20_922_789_888_000.0))));
    (cosine, x * sine)
}

/// e to the power `x`, in single precision with a relative error below 2⁻²³; 0 below about -87, infinite above 88.7.
///
/// Cody and Waite's reduction: x = n ln 2 + r with |r| ≤ ln 2 / 2, a polynomial for eʳ, and n put into the exponent.
/// Evaluated in double precision, where a Taylor polynomial of degree 7 leaves an error near 3·10⁻⁹.
#[inline]
pub fn exp(x: f32) -> f32 {
    // Computed first and chosen then, so that loops can do several at once.
    let power = exp2_of(f64::from(x) * std::f64::consts::LOG2_E) as f32;
    if x > 88.8 {
        f32::INFINITY
    } else if x < -87.3 {
        0.0
    } else {
        power
    }
}

/// `base` to the power `exponent`, in single precision with a relative error below 2⁻²², for `base` ≥ 0.
/// `pow(x, 0)` is 1, `pow(0, y)` is 0 for y > 0; a negative base gives NaN.
#[inline]
pub fn pow(base: f32, exponent: f32) -> f32 {
    pow_wide(f64::from(base), exponent)
}

/// [`pow`] of a base in double precision, which matters near 1 under large exponents.
#[inline]
pub fn pow_wide(base: f64, exponent: f32) -> f32 {
    if exponent == 0.0 || base == 1.0 {
        return 1.0;
    }
    if base == 0.0 {
        return if exponent > 0.0 { 0.0 } else { f32::INFINITY };
    }
    if base.is_nan() || base < 0.0 || exponent.is_nan() {
        return f32::NAN;
    }
    if base.is_infinite() {
        return if exponent > 0.0 { f32::INFINITY } else { 0.0 };
    }
    let power = f64::from(exponent) * log2_of(base);
    if power > 128.0 {
        f32::INFINITY
    } else if power < -150.0 {
        0.0
    } else {
        exp2_of(power) as f32
    }
}

/// 2 to the power `x`, for |x| ≤ 1000: a Taylor polynomial of degree 8, by Estrin's scheme, whose steps do not wait for
/// each other as Horner's do.
#[inline]
fn exp2_of(x: f64) -> f64 {
    // Adding this rounds to a whole number, which then stands in the lowest bits.
    const ROUND: f64 = (3_u64 << 51) as f64;
    let rounded = x + ROUND;
    let r = (x - (rounded - ROUND)) * std::f64::consts::LN_2;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (1.0 + r) + r2 * (0.5 + r * (1.0 / 6.0));
    let high = (1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5040.0));
    let two_to_n = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1023 << 52));
    (low + r4 * high + (r4 * r4) * (1.0 / 40320.0)) * two_to_n
}

/// Base-2 logarithm of a positive, normal number: mantissa m in [√½, √2), ln m = 2 artanh((m-1)/(m+1)).
#[inline]
fn log2_of(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    // Shifting by the bits of √½ makes the exponent field count from √½ instead of from 1.
    let shifted = x.to_bits().wrapping_sub(0x3fe6_a09e_667f_3bcd);
    let exponent = (shifted as i64) >> 52;
    let m = f64::from_bits((shifted & MANTISSA).wrapping_add(0x3fe6_a09e_667f_3bcd));
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let mut sum = 1.0 / 13.0;
    for k in [1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0] {
        sum = sum * s2 + k;
    }
    exponent as f64 + 2.0 * s * sum * std::f64::consts::LOG2_E
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exp_is_within_an_ulp_of_libm() {
        for i in -87_000..88_000 {
            let x = i as f32 * 0.001;
            let exact = libm::exp(f64::from(x));
            let error = (f64::from(exp(x)) - exact).abs() / exact;
            assert!(error < 1.2e-7, "exp({x}): relative error {error}");
        }
        assert_eq!((exp(-200.0), exp(0.0), exp(200.0)), (0.0, 1.0, f32::INFINITY));
    }

    #[test]
    fn pow_is_within_two_ulps_of_libm() {
        for i in 1..2_000 {
            let base = i as f32 * 0.001_7;
            for exponent in [0.1, 1.0 / 2.4, 0.5, 1.0, 2.4, 5.0, 40.0, -3.0] {
                let exact = libm::pow(f64::from(base), f64::from(exponent));
                if exact > 1e-37 && exact < 1e38 {
                    let error = (f64::from(pow(base, exponent)) - exact).abs() / exact;
                    assert!(error < 2.4e-7, "pow({base}, {exponent}): relative error {error}");
                }
            }
        }
    }

    #[test]
    fn turns_go_around_the_circle() {
        for i in 0..=10_000 {
            let turns = f64::from(i) * 1e-4;
            let (found, angle) = (cos_sin_of_turns(turns), turns * 2.0 * std::f64::consts::PI);
            let error = (found.0 - libm::cos(angle)).abs().max((found.1 - libm::sin(angle)).abs());
            assert!(error < 1.5e-15, "{turns}: {error}");
        }
        assert_eq!([0.0, 0.25, 0.5, 0.75].map(cos_sin_of_turns), [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]);
    }

    #[test]
    fn pow_at_the_edges() {
        assert_eq!((pow(0.0, 2.0), pow(0.0, 0.0), pow(2.0, 0.0), pow(1.0, 1e9)), (0.0, 1.0, 1.0, 1.0));
        assert_eq!((pow(0.5, 1e6), pow(2.0, 1e6), pow(0.0, -1.0)), (0.0, f32::INFINITY, f32::INFINITY));
        assert!(pow(-1.0, 2.0).is_nan() && pow(f32::NAN, 1.0).is_nan());
    }
}
