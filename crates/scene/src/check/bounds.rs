//! Which numbers are usable, and what to say of the others. Without places: lists of millions are checked with these.

use durer_math::{DMat3, DVec3, Rgb};

/// The largest coordinate or length.
pub(super) const LARGEST: f64 = 1e12;
/// The smallest radius, width, distance, or length of a direction.
pub(super) const SMALLEST: f64 = 1e-9;
/// The largest factor by which a transform may change a length.
pub(super) const LARGEST_FACTOR: f64 = 1e9;
/// The brightest light or background.
pub(super) const BRIGHTEST: f32 = 1e6;

/// True if the map, scaled by what is from `least` to `most`, and its inverse change no length by more than the largest
/// factor. (Frobenius norms bound it from above; comparisons are false for NaN.)
pub(super) fn changes_lengths_by(m: DMat3, least: f64, most: f64) -> bool {
    let norm = |m: DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    // √3 is the norm of the identity.
    let limit = LARGEST_FACTOR * 1.75;
    m.is_finite() && m.determinant() != 0.0 && norm(m) * most <= limit && norm(m.inverse()) <= limit * least
}

/// What is wrong with a radius, width or distance.
#[inline]
pub(super) fn wrong_with_size(name: &str, value: f64) -> Option<String> {
    if (SMALLEST..=LARGEST).contains(&value) {
        return None;
    }
    Some(if value > LARGEST {
        format!("{name} must be at most {LARGEST:e}")
    } else if value > 0.0 {
        format!("{name} must be at least {SMALLEST:e}")
    } else {
        format!("{name} must be above 0")
    })
}

/// What is wrong with a size that may also be 0.
#[inline]
pub(super) fn wrong_with_size_or_zero(name: &str, value: f64) -> Option<String> {
    if value < 0.0 {
        return Some(format!("{name} must not be negative"));
    }
    if value == 0.0 { None } else { wrong_with_size(name, value) }
}

/// What is wrong with a factor.
#[inline]
pub(super) fn wrong_with_factor(name: &str, value: f64) -> Option<String> {
    let fine = (1.0 / LARGEST_FACTOR..=LARGEST_FACTOR).contains(&value);
    (!fine).then(|| match value > 0.0 {
        true => format!("{name} must be between {:e} and {LARGEST_FACTOR:e}", 1.0 / LARGEST_FACTOR),
        false => format!("{name} must be above 0"),
    })
}

/// What is wrong with a point.
#[inline]
pub(super) fn wrong_with_point(name: &str, point: DVec3) -> Option<String> {
    if is_near(point) {
        return None;
    }
    Some(match point.is_finite() {
        true => format!("the coordinates of {name} must be at most {LARGEST:e} in size"),
        false => format!("{name} must be finite"),
    })
}

/// What is wrong with a part of light, each component of which goes from 0 to 1.
#[inline]
pub(super) fn wrong_with_fraction(name: &str, color: Rgb) -> Option<String> {
    // Comparisons are false for NaN.
    if color.to_array().iter().all(|component| (0.0..=1.0).contains(component)) {
        return None;
    }
    Some(if !color.is_finite() {
        format!("{name} must be finite")
    } else if color.min_component() < 0.0 {
        format!("{name} must not be negative")
    } else {
        format!("{name} must not be above 1")
    })
}

/// True for points that are finite and not too far away.
#[inline]
pub(super) fn is_near(point: DVec3) -> bool {
    // Comparisons are false for NaN, but the greatest of three numbers need not be NaN.
    point.to_array().iter().all(|x| x.abs() <= LARGEST)
}

/// True for points that do not coincide.
#[inline]
pub(super) fn are_apart(a: DVec3, b: DVec3) -> bool {
    (a - b).length_squared() >= SMALLEST * SMALLEST
}
