//! The builder's loops over items: finding their common box, counting them into bins, dividing them.
//!
//! The instruction set is chosen once for each part. All operations are minima, sums and products lane by lane, so all
//! sets give the same tree.

use super::boxes::Box32;
use crate::bvh::build::{BuildFor, Item, longest_axis};
use fearless_simd::{Level, Simd, dispatch, f32x4, f32x8, i32x4, mask32x8, prelude::*};
use std::ops::Range;

/// A box around the centers of items, each taken twice as large so that no halving is needed: least coordinates, a spare
/// number, greatest coordinates with their signs changed, a spare number.
pub(crate) type Centers = Box32;

/// The most bins of an axis. More make trees hardly better and cost time.
const MOST_BINS: usize = 32;
/// So many items are counted at least, if there are as many.
const SAMPLE: usize = 1 << 12;
/// Where building must be quick.
const FEW_BINS: usize = 12;

/// Items counted by where their centers lie along each axis.
pub(crate) struct Bins {
    count: usize,
    /// Along which axes cuts are looked for.
    axes: Range<usize>,
    scale: Scale,
    boxes: [[Box32; MOST_BINS]; 3],
    counts: [[u32; MOST_BINS]; 3],
}

/// How a center becomes the number of a bin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    base: [f32; 4],
    factor: [f32; 4],
}

/// A place to divide items at: the bins of an axis before this one, and the rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    axis: usize,
    bin: u32,
    scale: Scale,
    /// Expected cost of the divided part: areas times blocks.
    pub(crate) cost: f32,
}

impl Scale {
    fn new(count: usize, centers: &Centers) -> Scale {
        let mut scale = Scale { base: [0.0; 4], factor: [0.0; 4] };
        for axis in 0..3 {
            let (low, extent) = (centers.0[axis], -centers.0[axis + 4] - centers.0[axis]);
            scale.base[axis] = low;
            // Slightly less than the number of bins, so that the greatest center still lies in the last.
            let factor = 0.99 * count as f32 / extent;
            scale.factor[axis] = if factor.is_finite() { factor } else { 0.0 };
        }
        scale
    }

    #[inline(always)]
    fn bins<S: Simd>(&self, simd: S, center: f32x4<S>) -> [i32; 4] {
        let base = f32x4::simd_from(simd, self.base);
        let factor = f32x4::simd_from(simd, self.factor);
        let along: i32x4<S> = ((center - base) * factor).to_int();
        along.into()
    }
}

impl Bins {
    /// Bins for no items yet; to be used again and again, since to make them anew would take longer than to use them.
    pub(crate) fn new() -> Box<Bins> {
        let scale = Scale { base: [0.0; 4], factor: [0.0; 4] };
        let (boxes, counts) = ([[Box32::EMPTY; MOST_BINS]; 3], [[0; MOST_BINS]; 3]);
        Box::new(Bins { count: 0, axes: 0..0, scale, boxes, counts })
    }

    /// Empties them, for so many items with centers in a box.
    pub(crate) fn prepare(&mut self, items: usize, centers: &Centers, purpose: BuildFor) {
        (self.count, self.axes) = match purpose {
            BuildFor::Preview => {
                let longest = longest_axis(centers);
                (FEW_BINS, longest..longest + 1)
            }
            BuildFor::Picture | BuildFor::ManyRays => ((8 + items / 8).min(MOST_BINS), 0..3),
        };
        self.scale = Scale::new(self.count, centers);
        for (boxes, counts) in self.boxes.iter_mut().zip(&mut self.counts) {
            boxes[..self.count].fill(Box32::EMPTY);
            counts[..self.count].fill(0);
        }
    }
}

/// The cut with the least cost, if any divides the items; `area` is that of all, and so many of them, a power of two, are
/// tested at once.
pub(crate) fn best_cut(level: Level, bins: &Bins, block: usize, area: f32) -> Option<Cut> {
    dispatch!(level, simd => best_cut_with(simd, bins, block, area))
}

#[inline(always)]
fn best_cut_with<S: Simd>(simd: S, bins: &Bins, block: usize, area: f32) -> Option<Cut> {
    debug_assert!(block.is_power_of_two());
    let shift = block.trailing_zeros();
    let empty = f32x8::splat(simd, f32::INFINITY);
    let mut best: Option<Cut> = None;
    for axis in bins.axes.clone().filter(|&axis| bins.scale.factor[axis % 3] > 0.0) {
        let (boxes, counts) = (&bins.boxes[axis % 3], &bins.counts[axis % 3]);
        // Of the bins from each one on: the cost, and how many items they have.
        let mut right = [(0.0, 0); MOST_BINS];
        let (mut bounds, mut count) = (empty, 0);
        for bin in (1..bins.count.min(MOST_BINS)).rev() {
            bounds = bounds.min(f32x8::simd_from(simd, boxes[bin].0));
            count += counts[bin];
            right[bin] = (cost(bounds, count, shift), count);
        }
        (bounds, count) = (empty, 0);
        for bin in 1..bins.count.min(MOST_BINS) {
            bounds = bounds.min(f32x8::simd_from(simd, boxes[bin - 1].0));
            count += counts[bin - 1];
            let (right_cost, right_count) = right[bin];
            let cost = area + cost(bounds, count, shift) + right_cost;
            if count > 0 && right_count > 0 && best.is_none_or(|best| cost < best.cost) {
                best = Some(Cut { axis, bin: bin as u32, scale: bins.scale, cost });
            }
        }
    }
    best
}

/// Half the area of a box times how often 2 to the power of `shift` items are tested; 0 if there are none.
#[inline(always)]
fn cost<S: Simd>(bounds: f32x8<S>, count: u32, shift: u32) -> f32 {
    let (low, high) = bounds.split();
    let [x, y, z, _]: [f32; 4] = (-(low + high)).into();
    let blocks = (count + (1 << shift) - 1) >> shift;
    if blocks == 0 { 0.0 } else { (x * y + y * z + z * x) * blocks as f32 }
}

/// The box around items, and that around their centers.
pub(crate) fn measure(level: Level, items: &[Item]) -> (Box32, Centers) {
    dispatch!(level, simd => measure_with(simd, items))
}

#[inline(always)]
fn measure_with<S: Simd>(simd: S, items: &[Item]) -> (Box32, Centers) {
    let mut sums = Sums::new(simd);
    items.iter().for_each(|item| sums.add(simd, item));
    sums.done()
}

/// What is known of the items of a side.
struct Sums<S: Simd> {
    bounds: f32x8<S>,
    centers: f32x8<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Sums<S> {
        let empty = f32x8::splat(simd, f32::INFINITY);
        Sums { bounds: empty, centers: empty }
    }

    #[inline(always)]
    fn add(&mut self, simd: S, item: &Item) {
        let bounds = f32x8::simd_from(simd, item.0.0);
        self.bounds = self.bounds.min(bounds);
        let center = center_of(bounds);
        self.centers = self.centers.min(center.combine(-center));
    }

    #[inline(always)]
    fn add_if(&mut self, simd: S, is_added: bool, item: &Item) {
        let bounds = f32x8::simd_from(simd, item.0.0);
        let offered = mask32x8::splat(simd, is_added).select(bounds, f32x8::splat(simd, f32::INFINITY));
        self.bounds = self.bounds.min(offered);
        let center = center_of(bounds);
        let center = center.combine(-center);
        let offered = mask32x8::splat(simd, is_added).select(center, f32x8::splat(simd, f32::INFINITY));
        self.centers = self.centers.min(offered);
    }

    #[inline(always)]
    fn done(self) -> (Box32, Centers) {
        (Box32(self.bounds.into()), Box32(self.centers.into()))
    }
}

/// Twice the middle of a box.
#[inline(always)]
fn center_of<S: Simd>(bounds: f32x8<S>) -> f32x4<S> {
    let (low, high) = bounds.split();
    low - high
}

/// Counts items into bins, or, of very many, an even sample: where to cut hardly depends on the others.
pub(crate) fn fill(level: Level, bins: &mut Bins, items: &[Item]) {
    dispatch!(level, simd => fill_with(simd, bins, items));
}

#[inline(always)]
fn fill_with<S: Simd>(simd: S, bins: &mut Bins, items: &[Item]) {
    let step = (items.len() / SAMPLE).max(1);
    for item in items.iter().step_by(step) {
        let bounds = f32x8::simd_from(simd, item.0.0);
        let at = bins.scale.bins(simd, center_of(bounds));
        for axis in bins.axes.clone() {
            let (boxes, counts) = (&mut bins.boxes[axis % 3], &mut bins.counts[axis % 3]);
            let bin = at[axis % 3] as usize & (MOST_BINS - 1);
            let sum = &mut boxes[bin].0;
            *sum = f32x8::simd_from(simd, *sum).min(bounds).into();
            counts[bin] += 1;
        }
    }
}

/// Brings the items before the cut to the front; gives their number and, for both sides, boxes and centers.
pub(crate) fn partition(level: Level, items: &mut [Item], cut: &Cut) -> (usize, [(Box32, Centers); 2]) {
    dispatch!(level, simd => partition_with(simd, items, cut))
}

#[inline(always)]
fn partition_with<S: Simd>(simd: S, items: &mut [Item], cut: &Cut) -> (usize, [(Box32, Centers); 2]) {
    let (mut left, mut right) = (Sums::new(simd), Sums::new(simd));
    let mut start = 0;
    for index in 0..items.len() {
        let item = items[index];
        let at = cut.scale.bins(simd, center_of(f32x8::simd_from(simd, item.0.0)));
        let is_left = (at[cut.axis & 3] as u32) < cut.bin;
        // Every item is swapped and offered to both sides, since no processor can guess to which one the next belongs.
        items[index] = items[start];
        items[start] = item;
        start += usize::from(is_left);
        left.add_if(simd, is_left, &item);
        right.add_if(simd, !is_left, &item);
    }
    (start, [left.done(), right.done()])
}
