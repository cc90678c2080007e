//! The lattice of places that neighboring pixels share: their corners and their centers.

use crate::eye::{Eye, Look};
use crate::film::{Account, Region};
use crate::schedule::in_parallel_chunks;
use durer_math::DVec2;
use std::collections::{HashMap, VecDeque};
use std::hash::{BuildHasherDefault, Hasher};

/// Units in a pixel: all places of samples are whole numbers of them, so equal places are found to be equal.
pub(crate) const UNIT: u32 = 1 << 16;
const HALF: u32 = UNIT / 2;

/// A point of the picture, in units from its upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Place {
    pub(crate) y: u32,
    pub(crate) x: u32,
}

impl Place {
    /// The upper left corner of a pixel.
    pub(crate) fn corner(x: u32, y: u32) -> Place {
        Place { y: y * UNIT, x: x * UNIT }
    }

    /// The middle of a pixel.
    pub(crate) fn center(x: u32, y: u32) -> Place {
        Place { y: y * UNIT + HALF, x: x * UNIT + HALF }
    }

    pub(crate) fn offset(self, x: u32, y: u32) -> Place {
        Place { y: self.y + y, x: self.x + x }
    }

    /// In pixels; exact.
    pub(crate) fn point(self) -> DVec2 {
        DVec2::new(f64::from(self.x), f64::from(self.y)) / f64::from(UNIT)
    }
}

/// Something for each of some places. It is only ever asked for single places: the order of hash maps is nobody's business.
pub(crate) type ByPlace<T> = HashMap<Place, T, BuildHasherDefault<PlaceHasher>>;

/// Quick, and good enough for places.
#[derive(Default)]
pub(crate) struct PlaceHasher(u64);

impl Hasher for PlaceHasher {
    fn finish(&self) -> u64 {
        let mixed = self.0.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u32(byte.into()));
    }

    fn write_u32(&mut self, number: u32) {
        self.0 = self.0.rotate_left(32).wrapping_mul(0xff51_afd7_ed55_8ccd) ^ u64::from(number);
    }
}

/// What is seen at the corners or the centers of some rows of pixels.
pub(crate) struct LatticeRows {
    first_column: u32,
    first_row: u32,
    rows: VecDeque<Vec<Look>>,
}

/// Columns and rows of a lattice, each from the first to before the second.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub(crate) columns: (u32, u32),
    pub(crate) rows: (u32, u32),
}

impl Span {
    /// The centers of a region.
    pub(crate) fn centers(region: Region) -> Span {
        Span { columns: (region.x, region.x + region.width), rows: (region.y, region.y + region.height) }
    }

    /// The corners of a region.
    pub(crate) fn corners(region: Region) -> Span {
        Span { columns: (region.x, region.x + region.width + 1), rows: (region.y, region.y + region.height + 1) }
    }
}

/// Blocks of neighbors, whose rays go nearly the same way, are looked at together.
const BLOCK: (u32, u32) = (4, 2);

impl LatticeRows {
    pub(crate) fn new() -> LatticeRows {
        LatticeRows { first_column: 0, first_row: 0, rows: VecDeque::new() }
    }

    pub(crate) fn get(&self, column: u32, row: u32) -> &Look {
        &self.rows[(row - self.first_row) as usize][(column - self.first_column) as usize]
    }

    /// Looks at what is missing of a span, and forgets the rows above it.
    pub(crate) fn extend(&mut self, eye: &impl Eye, span: Span, place: fn(u32, u32) -> Place, account: &mut Account) {
        let Span { columns: (left, right), rows: (top, bottom) } = span;
        while self.first_row < top && self.rows.pop_front().is_some() {
            self.first_row += 1;
        }
        if self.rows.is_empty() {
            (self.first_column, self.first_row) = (left, top);
        }
        let from = self.first_row + self.rows.len() as u32;
        let missing = Span { columns: (left, right), rows: (from, bottom) };
        let nodes: Vec<(u32, u32)> = in_blocks(missing).collect();
        let points: Vec<DVec2> = nodes.iter().map(|&(column, row)| place(column, row).point()).collect();
        let looks = in_parallel_chunks(&points, account, |points, looks, account| eye.looks(points, looks, account));
        let blank = looks.first().copied();
        let new = (from..bottom).filter_map(|_| Some(vec![blank?; (right - left) as usize]));
        self.rows.extend(new);
        for ((column, row), look) in nodes.into_iter().zip(looks) {
            self.rows[(row - self.first_row) as usize][(column - left) as usize] = look;
        }
    }
}

/// The nodes of a span, block by block.
fn in_blocks(span: Span) -> impl Iterator<Item = (u32, u32)> {
    let Span { columns: (left, right), rows: (top, bottom) } = span;
    (top..bottom).step_by(BLOCK.1 as usize).flat_map(move |y| {
        (left..right).step_by(BLOCK.0 as usize).flat_map(move |x| {
            (y..bottom.min(y + BLOCK.1))
                .flat_map(move |row| (x..right.min(x + BLOCK.0)).map(move |column| (column, row)))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_a_span_once() {
        let mut nodes: Vec<_> = in_blocks(Span { columns: (3, 12), rows: (5, 10) }).collect();
        assert_eq!(nodes[..5], [(3, 5), (4, 5), (5, 5), (6, 5), (3, 6)]);
        nodes.sort_unstable();
        let all: Vec<_> = (3..12).flat_map(|x| (5..10).map(move |y| (x, y))).collect();
        assert_eq!(nodes, all);
    }

    #[test]
    fn places_are_exact() {
        assert_eq!(Place::corner(65_534, 3).point(), DVec2::new(65_534.0, 3.0));
        assert_eq!(Place::center(65_534, 65_534).point(), DVec2::splat(65_534.5));
        assert!(Place::corner(5, 0) < Place::corner(0, 1));
    }
}
