//! Rotations and frames, built from functions that give the same bits everywhere.

use crate::functions::{cos, sin};
use glam::{DMat3, DVec3};

/// The right-handed rotation by `angle` radians about `axis` (unit length), after Rodrigues. About +y by 90 degrees it
/// takes +z to +x.
pub fn rotation(axis: DVec3, angle: f64) -> DMat3 {
    let (s, c) = (sin(angle), cos(angle));
    let k = axis * (1.0 - c);
    DMat3::from_cols(
        DVec3::new(k.x * axis.x + c, k.x * axis.y + s * axis.z, k.x * axis.z - s * axis.y),
        DVec3::new(k.y * axis.x - s * axis.z, k.y * axis.y + c, k.y * axis.z + s * axis.x),
        DVec3::new(k.z * axis.x + s * axis.y, k.z * axis.y - s * axis.x, k.z * axis.z + c),
    )
}

/// The shortest rotation that takes the unit vector `from` to the unit vector `to`; for opposite vectors, half a turn
/// about some axis perpendicular to both. Exactly the identity for equal vectors.
///
/// After Möller and Hughes, "Efficiently Building a Matrix to Rotate One Vector to Another", 1999.
pub fn rotation_between(from: DVec3, to: DVec3) -> DMat3 {
    let cosine = from.dot(to);
    if cosine < -0.999_999 {
        // Two reflections, through the planes that halve the way by a perpendicular vector.
        let (perpendicular, _) = any_orthonormal_pair(from);
        let (a, b) = (reflection(perpendicular - from), reflection(perpendicular - to));
        return b * a;
    }
    if cosine < 0.0 {
        // Reflections, through the plane across `from` and through that across the middle: exact where the form below
        // divides by little.
        return reflection(from + to) * reflection(from);
    }
    let v = from.cross(to);
    let h = 1.0 / (1.0 + cosine);
    DMat3::from_cols(
        DVec3::new(cosine + h * v.x * v.x, h * v.x * v.y + v.z, h * v.x * v.z - v.y),
        DVec3::new(h * v.x * v.y - v.z, cosine + h * v.y * v.y, h * v.y * v.z + v.x),
        DVec3::new(h * v.x * v.z + v.y, h * v.y * v.z - v.x, cosine + h * v.z * v.z),
    )
}

/// The Householder reflection through the plane perpendicular to `across` (any length but zero).
fn reflection(across: DVec3) -> DMat3 {
    let k = 2.0 / across.length_squared();
    DMat3::from_cols(
        DVec3::X - across * (k * across.x),
        DVec3::Y - across * (k * across.y),
        DVec3::Z - across * (k * across.z),
    )
}

/// Two unit vectors perpendicular to the unit vector `n` and to each other, so that `(a, b, n)` is right-handed.
///
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
pub fn any_orthonormal_pair(n: DVec3) -> (DVec3, DVec3) {
    let sign = 1.0_f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), DVec3::new(b, sign + n.y * n.y * a, -n.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-14, "{a} != {b}");
    }

    #[test]
    fn quarter_turns_are_right_handed() {
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_near(rotation(DVec3::X, quarter) * DVec3::Y, DVec3::Z);
        assert_near(rotation(DVec3::Y, quarter) * DVec3::Z, DVec3::X);
        assert_near(rotation(DVec3::Z, quarter) * DVec3::X, DVec3::Y);
    }

    #[test]
    fn the_shortest_rotation_reaches_its_target() {
        let directions = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, -0.8)];
        for from in directions {
            assert_eq!(rotation_between(from, from) * from, from);
            for to in directions {
                let m = rotation_between(from, to);
                assert_near(m * from, to);
                assert!((m.determinant() - 1.0).abs() < 1e-14, "a rotation, not a mirror");
                assert!((m.transpose() * m - DMat3::IDENTITY).abs_diff_eq(DMat3::ZERO, 1e-14));
            }
        }
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for n in [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::new(0.48, -0.64, -0.6)] {
            let (a, b) = any_orthonormal_pair(n);
            assert_near(a.cross(b), n);
            assert!(a.dot(n).abs() < 1e-15 && (a.length() - 1.0).abs() < 1e-15);
        }
    }
}
