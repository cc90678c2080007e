//! Which cell of a regular division is this in? Shared by every pattern that has hard edges.

use durer_math::DVec3;

/// How far below its lower boundary a cell still reaches, in cells.
///
/// Surfaces often lie exactly on a boundary: a table at y = 0 under a checker of cubes, the wall of a cylinder whose
/// radius is a whole number of rings. Their hit points carry rounding noise of some 1e-13, and a bare `floor` would draw
/// that noise as a speckle of both paints. With the margin the boundary and its noise belong to the cell above, and the
/// edges seen elsewhere are displaced by a billionth of a cell, which no picture shows.
const MARGIN: f64 = 1e-9;

/// The number of the cell that holds `x`, with cells of length 1 and cell 0 reaching from 0 to 1: `floor(x)`, but
/// [steady](MARGIN) at the boundaries. Saturates for huge numbers; 0 for NaN.
pub(super) fn cell(x: f64) -> i64 {
    (x + MARGIN).floor() as i64
}

/// Which of `count` things, laid in turn, lies in cell number `cell`. `count` is at least 1, the answer is below it.
pub(super) fn in_turn(cell: i64, count: i64) -> i64 {
    // Most cells asked for are in the first turn, which saves a division.
    if (0..count).contains(&cell) { cell } else { cell.rem_euclid(count) }
}

/// The thing that lies in cell number `cell`, all of them being laid in turn. There is at least one.
pub(super) fn pick<T: Copy>(things: &[T], cell: i64) -> T {
    things[in_turn(cell, things.len() as i64) as usize]
}

/// How far into its cell `x` is, in 0..=1; 0 for what has no such place.
pub(super) fn fraction(x: f64) -> f64 {
    let fraction = x - x.floor();
    // Infinities and NaN end up here as NaN, which `max` drops.
    fraction.max(0.0)
}

/// The vector whose dot product with a point is the distance along `axis` (any length but zero), in units of `step`.
pub(super) fn steps_along(axis: DVec3, step: f64) -> DVec3 {
    // Scaled first, so that the length of a very long or short axis neither overflows nor vanishes.
    let axis = axis / axis.abs().max_element();
    axis / (axis.length() * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_own_their_lower_boundary_and_its_noise() {
        for boundary in [-1000.0, -3.0, 0.0, 1.0, 77.0] {
            for noise in [-1e-10, -1e-13, 0.0, 1e-13, 1e-10, 0.5] {
                assert_eq!(cell(boundary + noise), boundary as i64);
            }
            assert_eq!(cell(boundary - 1e-6), boundary as i64 - 1);
        }
    }

    #[test]
    fn things_take_turns_on_both_sides_of_zero() {
        let turns: Vec<char> = (-4..5).map(|i| pick(&['a', 'b', 'c'], i)).collect();
        assert_eq!(turns, ['c', 'a', 'b', 'c', 'a', 'b', 'c', 'a', 'b']);
        assert_eq!((in_turn(i64::MIN, 1), in_turn(i64::MAX, 2)), (0, 1));
    }

    #[test]
    fn no_number_breaks_them() {
        assert_eq!((cell(f64::NAN), cell(1e300), cell(f64::NEG_INFINITY)), (0, i64::MAX, i64::MIN));
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, -1e-300, 2.75] {
            assert!((0.0..=1.0).contains(&fraction(x)), "{x}");
        }
        assert_eq!((fraction(2.75), fraction(-0.25)), (0.75, 0.75));
    }

    #[test]
    fn any_axis_length_measures_the_same() {
        for axis in [DVec3::X, DVec3::X * 1e200, DVec3::X * 1e-200, DVec3::X * 7.0] {
            assert!((steps_along(axis, 4.0) - DVec3::new(0.25, 0.0, 0.0)).length() < 1e-15);
        }
        let diagonal = steps_along(DVec3::new(3.0, 4.0, 0.0), 2.0);
        assert!((diagonal.dot(DVec3::new(6.0, 8.0, 5.0)) - 5.0).abs() < 1e-14);
    }
}
