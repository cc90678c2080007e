//! All rays through one point: which primitives can they meet?
//!
//! The rays of a pinhole camera start in one point and the shadow rays of a point light end in one. Around such a point
//! a cube is divided into cells, each with a list of the primitives that are seen through it; a ray then needs to be
//! tested against these only, mostly none. After Haines and Greenberg, "The Light Buffer", IEEE CG&A 6(9), 1986.

use crate::Bounds;
use crate::simd::lanes::Lanes;
use durer_math::DVec3;
use fearless_simd::{Simd, f64x8, prelude::*};

/// Cells along an edge of the cube: a cell is about two degrees wide.
const CELLS: usize = 48;

const CELL_COUNT: usize = 6 * CELLS * CELLS;

/// Which planes are nearest is decided for blocks of so many cells by as many, at once.
const BLOCK: usize = 4;
const BLOCKS: usize = CELLS / BLOCK;

/// With more bounded primitives than this the lists get long and the tree is the better way.
pub(crate) const MOST_BOUNDED: usize = 256;

/// With more planes than this preparing the lists would cost more than it saves.
pub(crate) const MOST_PLANES: usize = 16;

/// A cell that more primitives are seen through has no list; its rays go through the tree.
const LONGEST_LIST: usize = 12;

/// Projections are widened by this much of the cube's half edge, for the rounding of rays and of the
/// look-up, which is in single precision.
const MARGIN: f64 = 1e-6;

/// A point, and the primitives seen from it in each direction.
#[derive(Clone, Debug)]
pub struct Vantage {
    point: DVec3,
    cells: Vec<Cell>,
    /// The lists of all cells, one after the other. There are few enough primitives that 16 bits hold their indices.
    ids: Vec<u16>,
}

/// Where a cell's list is: its start in the lower 24 bits, its length above. Memory that is touched first costs more time than
/// taking this apart.
#[derive(Clone, Copy, Debug, Default)]
struct Cell(u32);

impl Cell {
    #[inline(always)]
    fn start(self) -> usize {
        (self.0 & 0xff_ffff) as usize
    }

    /// Of a list that is too long, more than [`LONGEST_LIST`].
    #[inline(always)]
    fn length(self) -> usize {
        (self.0 >> 24) as usize
    }

    fn starting_at(start: usize) -> Cell {
        Cell(start as u32)
    }

    fn one_more(self) -> Cell {
        if self.length() > LONGEST_LIST { self } else { Cell(self.0 + (1 << 24)) }
    }
}

/// A primitive in a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boxed {
    pub(crate) id: u32,
    pub(crate) bounds: Bounds,
}

/// An infinite plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flat {
    pub(crate) id: u32,
    pub(crate) mask: u32,
    /// True if what lies behind it need not be known. It can only hide planes of its own mask, since a ray may ask for one
    /// mask only.
    pub(crate) hides: bool,
    pub(crate) normal: DVec3,
    pub(crate) point: DVec3,
}

impl Vantage {
    /// What is seen of these primitives from a point.
    pub(crate) fn new(point: DVec3, boxed: &[Boxed], planes: &[Flat]) -> Vantage {
        let nearest = nearest_planes(point, planes);
        let each = |visit: &mut dyn FnMut(usize, u32)| {
            for thing in boxed {
                for_each_cell(point, &thing.bounds, |cell| visit(cell, thing.id));
            }
            for &(block, id) in &nearest {
                block.cells().for_each(|cell| visit(cell, id));
            }
        };
        let mut cells = vec![Cell::default(); CELL_COUNT];
        each(&mut |cell, _| cells[cell] = cells[cell].one_more());
        // Only lists that are short enough to be used take room.
        let mut room = 0;
        for cell in cells.iter_mut().filter(|cell| cell.length() <= LONGEST_LIST) {
            let length = cell.length();
            (*cell, room) = (Cell::starting_at(room), room + length);
        }
        let mut ids = vec![0; room];
        each(&mut |cell, id| {
            let cell = &mut cells[cell];
            if cell.length() <= LONGEST_LIST {
                ids[cell.start() + cell.length()] = id as u16;
                *cell = cell.one_more();
            }
        });
        Vantage { point, cells, ids }
    }

    /// The primitives that can be met between a place and the point; `None` if they are too many to list.
    #[inline(always)]
    pub(crate) fn candidates_towards(&self, place: DVec3) -> Option<&[u16]> {
        // Not from a ray's direction, which is ready only after a root and a division.
        self.candidates(place - self.point)
    }

    /// The primitives that a ray from the point in this direction (of any length) can meet first; `None` if they are too
    /// many to list.
    #[inline(always)]
    pub(crate) fn candidates(&self, direction: DVec3) -> Option<&[u16]> {
        self.listed(cell_of(direction))
    }

    /// The point.
    #[inline(always)]
    pub(crate) fn point(&self) -> DVec3 {
        self.point
    }

    /// The list of a cell, as [`cells_of`] numbers them.
    #[inline(always)]
    pub(crate) fn listed(&self, cell: usize) -> Option<&[u16]> {
        let cell = self.cells[cell];
        if cell.length() > LONGEST_LIST { None } else { self.ids.get(cell.start()..cell.start() + cell.length()) }
    }
}

/// Some cells side by side.
#[derive(Clone, Copy, Debug)]
struct Block {
    face: usize,
    row: usize,
    column: usize,
}

impl Block {
    /// All there are.
    fn all() -> impl Iterator<Item = Block> {
        let faces = (0..6).flat_map(|face| (0..BLOCKS).map(move |row| (face, row)));
        faces.flat_map(|(face, row)| (0..BLOCKS).map(move |column| Block { face, row, column }))
    }

    fn cells(self) -> impl Iterator<Item = usize> {
        (self.row * BLOCK..(self.row + 1) * BLOCK).flat_map(move |row| {
            let first = (self.face * CELLS + row) * CELLS + self.column * BLOCK;
            first..first + BLOCK
        })
    }
}

/// The planes that may be the nearest of their mask somewhere in a block, or that do not hide each other, for each block.
///
/// In a direction d a plane is at 1/t = -n·d / h, with h the height of the point above it: linear in d, so its greatest
/// and least values on a block are at the corners.
fn nearest_planes(point: DVec3, planes: &[Flat]) -> Vec<(Block, u32)> {
    let mut found = Vec::new();
    let mut planes = planes.to_vec();
    planes.sort_by_key(|plane| (plane.mask, plane.hides));
    for group in planes.chunk_by(|a, b| a.mask == b.mask && a.hides == b.hides) {
        let nearness: Vec<DVec3> = group.iter().map(|plane| nearness(plane, point)).collect();
        let mut greatest = vec![0.0; group.len()];
        for block in Block::all() {
            // A plane that is nearer than this nowhere in the block is hidden by another one.
            let mut nearest = 0.0_f64;
            for (nearness, greatest) in nearness.iter().zip(&mut greatest) {
                let range = nearness_range(*nearness, block);
                nearest = if group[0].hides { nearest.max(range.0) } else { 0.0 };
                *greatest = range.1;
            }
            let near = group.iter().zip(&greatest).filter(|(_, greatest)| **greatest >= nearest * (1.0 - MARGIN));
            found.extend(near.map(|(plane, _)| (block, plane.id)));
        }
    }
    found
}

/// What times a direction is one over the distance of a plane; infinite for a plane (all but) through the point, which
/// shadow rays that end there leave out.
fn nearness(plane: &Flat, point: DVec3) -> DVec3 {
    let height = plane.normal.dot(point - plane.point);
    let doubt = MARGIN * plane.normal.length() * (1.0 + point.length() + plane.point.length());
    if height.abs() <= doubt { DVec3::INFINITY } else { plane.normal / -height }
}

/// The least and the greatest value of `nearness · d` over the directions d of a block; for a plane through the point,
/// which neither hides nor is hidden, 0 and infinity.
fn nearness_range(nearness: DVec3, Block { face, row, column }: Block) -> (f64, f64) {
    if !nearness.is_finite() {
        return (0.0, f64::INFINITY);
    }
    let n = nearness.to_array();
    let axis = face / 2;
    let [s, t] = other_axes(axis);
    const HALF: f64 = 1.0 / BLOCKS as f64 + MARGIN;
    let middle = |index: usize| (2 * index + 1) as f64 / BLOCKS as f64 - 1.0;
    let ahead = if face % 2 == 1 { n[axis] } else { -n[axis] };
    let at_middle = ahead + n[s] * middle(column) + n[t] * middle(row);
    let reach = (n[s].abs() + n[t].abs()) * HALF;
    (at_middle - reach, at_middle + reach)
}

/// The two axes that span a face across `axis`.
fn other_axes(axis: usize) -> [usize; 2] {
    [usize::from(axis == 0), if axis == 2 { 1 } else { 2 }]
}

/// The cell that a direction passes through. Faces come in the order -x, +x, -y, +y, -z, +z; on a face the other two
/// coordinates count in their order.
#[inline(always)]
fn cell_of(d: DVec3) -> usize {
    // Single precision serves: its rounding is within the margin.
    let (x, y, z) = (d.x as f32, d.y as f32, d.z as f32);
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    let (axis, depth, s, t) = if az >= ax && az >= ay {
        (2, z, x, y)
    } else if ay >= ax {
        (1, y, x, z)
    } else {
        (0, x, y, z)
    };
    const HALF: f32 = (CELLS / 2) as f32;
    const LAST: f32 = (CELLS - 1) as f32;
    // Adding this rounds to a whole number, which then stands in the lowest bits: cheaper than a checked conversion.
    const ROUND: f32 = (3 << 22) as f32;
    let scale = HALF / depth.abs();
    let index = |along: f32| {
        // Comparisons instead of `max` and `min`, which mind NaNs.
        let cell = along * scale + (HALF - 0.5);
        let cell = if cell > 0.0 { cell } else { 0.0 };
        let cell = if cell < LAST { cell } else { LAST };
        ((cell + ROUND).to_bits() & 0xff) as usize
    };
    let face = 2 * axis + usize::from(depth > 0.0);
    (face * CELLS + index(t)) * CELLS + index(s)
}

/// The cells that eight directions pass through; see [`ROUND`].
#[inline(always)]
pub(crate) fn cells_of<S: Simd>(simd: S, d: Lanes<S>) -> f64x8<S> {
    let (ax, ay, az) = (d.x.abs(), d.y.abs(), d.z.abs());
    let along_z = az.simd_ge(ax) & az.simd_ge(ay);
    let along_y = ay.simd_ge(ax);
    let depth = along_z.select(d.z, along_y.select(d.y, d.x));
    let (s, t) = (along_z.select(d.x, along_y.select(d.x, d.y)), along_z.select(d.y, d.z));
    let scale = f64x8::splat(simd, (CELLS / 2) as f64) / depth.abs();
    let zero = f64x8::splat(simd, 0.0);
    let positive = depth.simd_gt(zero).select(f64x8::splat(simd, 1.0), zero);
    let axis = along_z.select(f64x8::splat(simd, 4.0), along_y.select(f64x8::splat(simd, 2.0), zero));
    let rows = (axis + positive) * CELLS as f64 + whole_index(simd, t * scale);
    rows * CELLS as f64 + whole_index(simd, s * scale) + ROUND
}

/// Adding this rounds to a whole number; a sum of whole numbers and this then has them in its lowest bits.
pub(crate) const ROUND: f64 = (3_u64 << 51) as f64;

/// In which of the cells along an edge numbers from -24 to 24 are, as they are from end to end.
#[inline(always)]
fn whole_index<S: Simd>(simd: S, along: f64x8<S>) -> f64x8<S> {
    let (least, last) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, (CELLS - 1) as f64));
    let cell = along + ((CELLS / 2) as f64 - 0.5);
    let cell = cell.simd_gt(least).select(cell, least);
    let cell = cell.simd_lt(last).select(cell, last);
    (cell + ROUND) - ROUND
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
        let [s, t] = other_axes(axis);
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
    use crate::packet::LANES;

    fn random_numbers(seed: u64) -> impl FnMut(f64, f64) -> f64 {
        let mut state = seed;
        move |low: f64, high: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((state >> 11) as f64 / (1u64 << 53) as f64)
        }
    }

    #[test]
    fn a_ray_that_passes_through_a_box_finds_it_listed() {
        let mut random = random_numbers(1);
        for case in 0..1000 {
            let mut place = || DVec3::new(random(-9.0, 9.0), random(-9.0, 9.0), random(-9.0, 9.0));
            let (point, mut bounds) = (place(), Bounds::of_points([place(), place()]));
            if case % 3 == 0 {
                bounds.max.y = bounds.min.y; // flat
            }
            let vantage = Vantage::new(point, &[Boxed { id: 7, bounds }], &[]);
            for _ in 0..20 {
                let inside = bounds.min + bounds.size() * DVec3::new(random(0., 1.), random(0., 1.), random(0., 1.));
                assert_eq!(vantage.candidates((inside - point).normalize()), Some(&[7][..]), "{point} {bounds:?}");
            }
        }
    }

    /// But for directions so near an edge of a cell that single precision decides otherwise.
    #[test]
    fn eight_directions_pass_through_the_cells_of_each() {
        let mut random = random_numbers(3);
        let mut same = 0;
        for level in crate::SimdLevel::available() {
            for case in 0..200 {
                let mut direction = || DVec3::new(random(-1., 1.), random(-1., 1.), random(-1., 1.));
                let directions: [DVec3; LANES] = match case {
                    0 => [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z, DVec3::ZERO, DVec3::ONE],
                    _ => std::array::from_fn(|_| direction()),
                };
                let columns = [0, 1, 2].map(|axis| directions.map(|direction| direction[axis]));
                let cells: [f64; LANES] = fearless_simd::dispatch!(level.level(), simd => {
                    cells_of(simd, Lanes::load(simd, &columns)).into()
                });
                for (cell, direction) in cells.into_iter().zip(directions) {
                    let cell = (cell - ROUND) as usize;
                    assert!(cell < CELL_COUNT);
                    same += usize::from(cell == cell_of(direction));
                }
            }
            let all = 200 * LANES;
            assert!(same >= all - 2, "{same} of {all}");
            same = 0;
        }
    }

    #[test]
    fn a_box_in_front_is_not_listed_behind() {
        let bounds = Bounds { min: DVec3::new(4.0, -1.0, -1.0), max: DVec3::new(6.0, 1.0, 1.0) };
        let vantage = Vantage::new(DVec3::ZERO, &[Boxed { id: 0, bounds }], &[]);
        assert_eq!(vantage.candidates(DVec3::X).map(<[u16]>::len), Some(1));
        for away in [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::new(1.0, 0.5, 0.0)] {
            assert_eq!(vantage.candidates(away).map(<[u16]>::len), Some(0));
        }
    }

    #[test]
    fn crowded_cells_give_no_list() {
        let bounds = Bounds { min: DVec3::new(4.0, -1.0, -1.0), max: DVec3::new(6.0, 1.0, 1.0) };
        let vantage = Vantage::new(DVec3::ZERO, &[Boxed { id: 0, bounds }; 13], &[]);
        assert_eq!(vantage.candidates(DVec3::X), None);
    }

    #[test]
    fn the_nearest_plane_of_each_mask_is_listed_and_most_others_are_not() {
        let mut random = random_numbers(2);
        let mut listed = 0;
        for _ in 0..20 {
            let mut place = || DVec3::new(random(-9.0, 9.0), random(-9.0, 9.0), random(-9.0, 9.0));
            let point = place();
            let plane = |id: u32| Flat { id, mask: 1 + id % 2, hides: true, normal: place(), point: place() };
            let planes: Vec<Flat> = (0..6).map(plane).collect();
            let vantage = Vantage::new(point, &[], &planes);
            for _ in 0..200 {
                let direction = DVec3::new(random(-1., 1.), random(-1., 1.), random(-1., 1.)).normalize();
                let t = |p: &Flat| -p.normal.dot(point - p.point) / p.normal.dot(direction);
                let candidates = vantage.candidates(direction).unwrap();
                listed += candidates.len();
                for mask in [1, 2] {
                    let hit = planes.iter().filter(|p| p.mask == mask && t(p) > 0.0);
                    if let Some(nearest) = hit.min_by(|a, b| t(a).total_cmp(&t(b))) {
                        assert!(candidates.contains(&(nearest.id as u16)));
                    }
                }
            }
        }
        assert!(listed < 20 * 200 * 5 / 2, "{listed} candidates where at most two are nearest");
    }
}
