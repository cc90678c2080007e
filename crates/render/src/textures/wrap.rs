//! What is beyond the end of a pattern.

use super::cells::{cell, in_turn};
use durer_scene::Wrap;

/// Brings a place along a pattern that reaches from 0 to 1 back into 0..=1. Repeating, 1 is 0 again (and so is the
/// rounding noise just below it: see [`cell`]).
pub(super) fn wrap_place(wrap: Wrap, x: f64) -> f64 {
    let wrapped = match wrap {
        Wrap::Repeat => x - cell(x) as f64,
        Wrap::Clamp => x,
        Wrap::Mirror => 1.0 - (x - 2.0 * (x * 0.5).floor() - 1.0).abs(),
    };
    // Not `clamp`, which would let NaN through.
    if wrapped > 0.0 { wrapped.min(1.0) } else { 0.0 }
}

/// Brings the number of a pixel in a row of `count` (at least 1) back into the row.
pub(super) fn wrap_pixel(wrap: Wrap, pixel: i64, count: u32) -> u32 {
    let count = i64::from(count);
    let wrapped = match wrap {
        Wrap::Repeat => in_turn(pixel, count),
        Wrap::Clamp => pixel.clamp(0, count - 1),
        Wrap::Mirror => {
            let there_and_back = in_turn(pixel, 2 * count);
            there_and_back.min(2 * count - 1 - there_and_back)
        }
    };
    wrapped as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_beyond_the_ends() {
        for (x, repeat, clamp, mirror) in [
            (-1.25, 0.75, 0.0, 0.75),
            (-0.25, 0.75, 0.0, 0.25),
            (0.0, 0.0, 0.0, 0.0),
            (0.375, 0.375, 0.375, 0.375),
            (1.0, 0.0, 1.0, 1.0),
            (1.25, 0.25, 1.0, 0.75),
            (2.5, 0.5, 1.0, 0.5),
            (f64::NAN, 0.0, 0.0, 0.0),
        ] {
            assert_eq!(wrap_place(Wrap::Repeat, x), repeat, "{x} repeated");
            assert_eq!(wrap_place(Wrap::Clamp, x), clamp, "{x} clamped");
            assert_eq!(wrap_place(Wrap::Mirror, x), mirror, "{x} mirrored");
        }
    }

    #[test]
    fn pixels_beyond_the_ends() {
        let wrapped = |wrap| (-5..8).map(|i| wrap_pixel(wrap, i, 3)).collect::<Vec<_>>();
        assert_eq!(wrapped(Wrap::Repeat), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1]);
        assert_eq!(wrapped(Wrap::Clamp), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2]);
        assert_eq!(wrapped(Wrap::Mirror), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
    }

    #[test]
    fn no_number_leaves_the_pattern() {
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e300, -1e300, 1e19, -1e-300] {
                assert!((0.0..=1.0).contains(&wrap_place(wrap, x)), "{wrap:?} {x}");
            }
            for pixel in [i64::MIN, i64::MIN + 1, -1, i64::MAX - 1, i64::MAX] {
                for count in [1, 3, u32::MAX] {
                    assert!(wrap_pixel(wrap, pixel, count) < count, "{wrap:?} {pixel} of {count}");
                }
            }
        }
    }
}
