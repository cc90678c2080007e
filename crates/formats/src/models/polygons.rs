//! Polygons to triangles.
//!
//! Triangles are themselves, four corners are cut along a diagonal, and all else is done by clipping ears: a corner whose
//! triangle with its two neighbors holds no other corner is cut off, the best shaped first, until three are left
//! (G. H. Meisters, "Polygons have ears", 1975). Fans, which would be simpler, are wrong for concave polygons.

mod clipping;

use clipping::Clipping;
use durer_math::DVec3;

/// Cuts polygons into triangles; keeps its memory from one to the next.
#[derive(Debug)]
pub(crate) struct Triangulator {
    /// Steps left for all polygons of the file together: what is left of patience. Polygons made to be slow, not to be
    /// seen, take time that grows with the square of their corners.
    patience: u64,
    clipping: Clipping,
    /// Polygons that were cut blindly after patience ran out.
    pub(crate) rushed: u64,
}

impl Triangulator {
    /// For a file of this many bytes.
    pub(crate) fn new(bytes: usize) -> Triangulator {
        let patience = 500_000_000 + 200 * bytes as u64;
        Triangulator { patience, clipping: Clipping::default(), rushed: 0 }
    }

    /// Cuts the polygon with these corners into two triangles less than it has corners, and gives the corners of each,
    /// in the polygon's own direction. Corners may be on one line or in one place, and the polygon need not be quite
    /// flat; one that crosses itself is covered somehow.
    pub(crate) fn cut(&mut self, corners: &[DVec3], mut triangle: impl FnMut([usize; 3])) {
        match corners {
            [] | [_] | [_, _] => {}
            [_, _, _] => triangle([0, 1, 2]),
            [a, b, c, d] => {
                let first = quadrilateral([*a, *b, *c, *d]);
                triangle([first, first + 1, first + 2]);
                triangle([first, first + 2, (first + 3) % 4]);
            }
            _ => self.cut_many(corners, &mut triangle),
        }
    }

    fn cut_many(&mut self, corners: &[DVec3], triangle: &mut dyn FnMut([usize; 3])) {
        let normal = newell(corners);
        if self.patience == 0 || normal == DVec3::ZERO || !normal.is_finite() {
            (2..corners.len()).for_each(|last| triangle([0, last - 1, last]));
        } else {
            self.clipping.start(corners, normal);
            self.clipping.clip(&mut self.patience, triangle);
        }
        self.rushed += u64::from(self.patience == 0);
    }
}

/// The first corner, 0 or 1, of the diagonal to cut four corners along: from the one that bends inwards, or else the
/// shorter diagonal.
fn quadrilateral([a, b, c, d]: [DVec3; 4]) -> usize {
    let normal = (c - a).cross(d - b);
    let bend = |before: DVec3, at: DVec3, after: DVec3| (at - before).cross(after - at).dot(normal);
    let bends = [bend(d, a, b), bend(a, b, c), bend(b, c, d), bend(c, d, a)];
    let even = bends[0].min(bends[2]);
    let odd = bends[1].min(bends[3]);
    if even.min(odd) <= 0.0 {
        return usize::from(odd < even);
    }
    usize::from((d - b).length_squared() < (c - a).length_squared())
}

/// Twice the vector area of a polygon, after M. E. Newell: normal to it, and to the plane that fits it best if it is not
/// flat.
fn newell(corners: &[DVec3]) -> DVec3 {
    let Some(first) = corners.first() else {
        return DVec3::ZERO;
    };
    // From the first corner, so that a polygon far away keeps its digits.
    corners.windows(2).map(|pair| (pair[0] - *first).cross(pair[1] - *first)).fold(DVec3::ZERO, |sum, one| sum + one)
}

#[cfg(test)]
mod tests;
