//! All rays through one point: which primitives can they meet?
//!
//! The rays of a pinhole camera start in one point and the shadow rays of a point light end in one. Around such a point
//! a cube is divided into cells, each with a list of the primitives that are seen through it; a ray then needs to be
//! tested against these only, mostly none. After Haines and Greenberg, "The Light Buffer", IEEE CG&A 6(9), 1986.

use crate::Bounds;
use durer_math::DVec3;

/// Cells along an edge of the cube: a cell is about a degree wide.
const CELLS: usize = 64;

/// With more bounded primitives than this the lists get long and the tree is the better way.
pub(crate) const MOST_PRIMITIVES: usize = 1024;

/// A cell that more primitives are seen through has no list; its rays go through the tree.
const LONGEST_LIST: u32 = 12;

/// Projections are widened by this much of the cube's half edge, for the rounding of rays and of the division.
const MARGIN: f64 = 1e-9;

/// A point, and the primitives seen from it in each direction.
#[derive(Clone, Debug)]
pub struct Vantage {
    /// For each cell where its list starts in `ids`; one more at the end.
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Vantage {
    /// What is seen of these boxes from a point; they are named by the ids given with them.
    pub(crate) fn new(point: DVec3, boxes: &[(u32, Bounds)]) -> Vantage {
        let mut counts = vec![0; 6 * CELLS * CELLS];
        for (_, bounds) in boxes {
            for_each_cell(point, bounds, |cell| counts[cell] += 1);
        }
        let mut starts = Vec::with_capacity(counts.len() + 1);
        let mut total = 0;
        for count in counts {
            starts.push(total);
            total += count;
        }
        starts.push(total);
        let mut next = starts.clone();
        let mut ids = vec![0; total as usize];
        for (id, bounds) in boxes {
            for_each_cell(point, bounds, |cell| {
                ids[next[cell] as usize] = *id;
                next[cell] += 1;
            });
        }
        Vantage { starts, ids }
    }

    /// The primitives that a ray from the point in this direction can meet; `None` if they are too many to list.
    #[inline(always)]
    pub(crate) fn candidates(&self, direction: DVec3) -> Option<&[u32]> {
        let cell = cell_of(direction);
        let (start, end) = (self.starts[cell], self.starts[cell + 1]);
        if end - start > LONGEST_LIST { None } else { Some(&self.ids[start as usize..end as usize]) }
    }
}

/// The cell that a direction passes through. Faces come in the order -x, +x, -y, +y, -z, +z; on a face the other two
/// coordinates count in their order.
#[inline(always)]
fn cell_of(d: DVec3) -> usize {
    let a = d.abs();
    let (axis, depth, s, t) = if a.x >= a.y && a.x >= a.z {
        (0, d.x, d.y, d.z)
    } else if a.y >= a.z {
        (1, d.y, d.x, d.z)
    } else {
        (2, d.z, d.x, d.y)
    };
    let scale = (CELLS / 2) as f64 / depth.abs();
    let index = |x: f64| ((x * scale + (CELLS / 2) as f64) as usize).min(CELLS - 1);
    let face = 2 * axis + usize::from(depth > 0.0);
    (face * CELLS + index(t)) * CELLS + index(s)
}

/// Calls `visit` for every cell through which a box may be seen, by interval arithmetic on its projection.
fn for_each_cell(point: DVec3, bounds: &Bounds, mut visit: impl FnMut(usize)) {
    let (low, high) = ((bounds.min - point).to_array(), (bounds.max - point).to_array());
    for face in 0..6 {
        let axis = face / 2;
        // Depths in front of this face.
        let (near, far) = if face % 2 == 1 { (low[axis], high[axis]) } else { (-high[axis], -low[axis]) };
        if far < 0.0 {
            continue;
        }
        let near = near.max(0.0);
        let [s, t] = [(axis == 0) as usize, if axis == 2 { 1 } else { 2 }];
        let (Some(columns), Some(rows)) = (cells(low[s], high[s], near, far), cells(low[t], high[t], near, far)) else {
            continue;
        };
        for row in rows {
            for column in columns.clone() {
                visit((face * CELLS + row) * CELLS + column);
            }
        }
    }
}

/// The cells that the quotients of [low, high] by [near, far] fall into, if any; 0 ≤ near ≤ far.
fn cells(low: f64, high: f64, near: f64, far: f64) -> Option<std::ops::RangeInclusive<usize>> {
    // A quotient is least for the least numerator over the depth that makes it so. 0/0 stands for "anything".
    let least = low / if low > 0.0 { far } else { near };
    let greatest = high / if high > 0.0 { near } else { far };
    let least = if least.is_nan() { -1.0 } else { least } - MARGIN;
    let greatest = if greatest.is_nan() { 1.0 } else { greatest } + MARGIN;
    if least > 1.0 || greatest < -1.0 {
        return None;
    }
    let index = |x: f64| (((x + 1.0) * (CELLS / 2) as f64) as usize).min(CELLS - 1);
    Some(index(least)..=index(greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_that_passes_through_a_box_finds_it_listed() {
        let mut state = 1u64;
        let mut random = |low: f64, high: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((state >> 11) as f64 / (1u64 << 53) as f64)
        };
        for case in 0..2000 {
            let point = DVec3::new(random(-9.0, 9.0), random(-9.0, 9.0), random(-9.0, 9.0));
            let (a, b) = (
                DVec3::new(random(-9.0, 9.0), random(-9.0, 9.0), random(-9.0, 9.0)),
                DVec3::new(random(-9.0, 9.0), random(-9.0, 9.0), random(-9.0, 9.0)),
            );
            let mut bounds = Bounds::of_points([a, b]);
            if case % 3 == 0 {
                bounds.max.y = bounds.min.y; // flat
            }
            let vantage = Vantage::new(point, &[(7, bounds)]);
            for _ in 0..20 {
                let inside = bounds.min + bounds.size() * DVec3::new(random(0., 1.), random(0., 1.), random(0., 1.));
                assert_eq!(vantage.candidates((inside - point).normalize()), Some(&[7][..]), "{point} {bounds:?}");
            }
        }
    }

    #[test]
    fn a_box_in_front_is_not_listed_behind() {
        let bounds = Bounds { min: DVec3::new(4.0, -1.0, -1.0), max: DVec3::new(6.0, 1.0, 1.0) };
        let vantage = Vantage::new(DVec3::ZERO, &[(0, bounds)]);
        assert_eq!(vantage.candidates(DVec3::X).map(<[u32]>::len), Some(1));
        for away in [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::new(1.0, 0.5, 0.0)] {
            assert_eq!(vantage.candidates(away).map(<[u32]>::len), Some(0));
        }
    }

    #[test]
    fn crowded_cells_give_no_list() {
        let bounds = Bounds { min: DVec3::new(4.0, -1.0, -1.0), max: DVec3::new(6.0, 1.0, 1.0) };
        let vantage = Vantage::new(DVec3::ZERO, &[(0, bounds); 13]);
        assert_eq!(vantage.candidates(DVec3::X), None);
    }
}
