//! From points of the unit square to directions.

use durer_math::functions::{cos_sin_near_zero, cos_sin_of_turns};
use durer_math::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_4, PI};

/// A point of the unit disc, evenly spread. Neighbors stay neighbors: Shirley and Chiu, "A Low Distortion Map Between Disk
/// and Square", 1997.
#[inline]
pub(crate) fn disc(at: DVec2) -> DVec2 {
    let (a, b) = (2.0 * at.x - 1.0, 2.0 * at.y - 1.0);
    // The square is divided into four triangles; in each one coordinate is the radius, and the ratio the angle from its axis.
    let is_across = a.abs() > b.abs();
    let (radius, other) = if is_across { (a, b) } else { (b, a) };
    if radius == 0.0 {
        return DVec2::ZERO;
    }
    let (cos, sin) = cos_sin_near_zero(other / radius * FRAC_PI_4);
    let (along, aside) = (radius * cos, radius * sin);
    if is_across { DVec2::new(along, aside) } else { DVec2::new(aside, along) }
}

/// A direction above the surface, as often as its cosine says. Malley's method.
#[inline]
pub(crate) fn cosine_hemisphere(at: DVec2) -> DVec3 {
    let p = disc(at);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// The density of [`cosine_hemisphere`], per solid angle.
#[inline]
pub(crate) fn cosine_pdf(cos: f64) -> f64 {
    cos.max(0.0) / PI
}

/// A direction above the surface, all alike. The density is [`EVEN_PDF`].
#[inline]
pub(crate) fn even_hemisphere(at: DVec2) -> DVec3 {
    let radius = (at.x * (2.0 - at.x)).max(0.0).sqrt();
    let (cos, sin) = cos_sin_of_turns(at.y);
    DVec3::new(radius * cos, radius * sin, 1.0 - at.x)
}

/// The density of [`even_hemisphere`], per solid angle.
pub(crate) const EVEN_PDF: f64 = 0.5 / PI;
