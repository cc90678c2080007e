//! Ear clipping of one polygon.
//!
//! All is done in the plane of two coordinates, the third being left out: that of the normal's greatest component. No
//! coordinate changes in this, so corners on one line or in one place remain so; and the order of areas around a
//! corner is that in the polygon's own plane.
//!
//! Only corners that are not strictly convex can lie in an ear, so only these are looked at; in a grid, since CAD
//! programs write caps with thousands of corners. A corner in the same place as one of the ear's own counts only if an
//! edge goes from it into the ear: holes are written with a cut to them that is walked in both directions, so its ends
//! come twice.
//!
//! Where a polygon touches itself, rounding must not decide whether a corner is in the way. So at first what is within
//! a small distance counts as on the line, or in the place; only if that leaves no ear does every bit count.

use durer_math::{DVec2, DVec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The polygon that is left, as a ring, and what is known of its corners.
#[derive(Debug, Default)]
pub(super) struct Clipping {
    corners: Vec<Corner>,
    /// How many are left, and how many of them may be in the way of others.
    left: usize,
    hindrances: usize,
    /// What may be ears, the best last, by rank, corner and round; those of an old round no longer count.
    candidates: BinaryHeap<(u32, Reverse<u32>, u32)>,
    /// How near to a line or a place counts as on it.
    tolerance: f64,
    grid: Grid,
}

/// The tolerance, for a polygon of size 1: a few times the rounding of single precision.
const TOLERANCE: f64 = 3e-7;

#[derive(Clone, Copy, Debug)]
struct Corner {
    place: DVec2,
    before: u32,
    after: u32,
    /// Rounds: how often its neighbors have changed.
    round: u32,
    /// The last corner that was found to be in the way of it.
    hindrance: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Cut off already.
    Gone,
    /// Bends as the polygon does.
    Convex,
    /// Straight, or bends the other way: such a corner may be in the way of an ear.
    Hindrance,
}

impl Clipping {
    /// Takes a polygon of at least four corners, and a vector normal to it.
    pub(super) fn start(&mut self, corners: &[DVec3], normal: DVec3) {
        let flatten = flattening(normal);
        let count = corners.len();
        self.left = count;
        self.hindrances = count;
        self.candidates.clear();
        self.corners.clear();
        self.corners.extend(corners.iter().enumerate().map(|(at, corner)| Corner {
            place: flatten(*corner),
            before: ((at + count - 1) % count) as u32,
            after: ((at + 1) % count) as u32,
            round: 0,
            hindrance: at as u32,
            kind: Kind::Hindrance,
        }));
        let places = || self.corners.iter().map(|corner| corner.place);
        let size = places().fold(DVec2::NEG_INFINITY, DVec2::max) - places().fold(DVec2::INFINITY, DVec2::min);
        self.tolerance = TOLERANCE * size.max_element();
        (0..count).for_each(|at| self.classify(at));
        self.grid.fill(&self.corners, self.hindrances);
    }

    /// Cuts off ears until nothing is left.
    pub(super) fn clip(&mut self, patience: &mut u64, triangle: &mut dyn FnMut([usize; 3])) {
        (0..self.corners.len()).for_each(|at| self.judge(at));
        let mut fresh = true;
        while self.left > 2 {
            match self.candidates.pop() {
                Some((_, Reverse(at), round)) if self.corners[at as usize].round == round => {
                    if !self.is_hindered(at as usize, patience) {
                        self.cut(at as usize, triangle);
                        fresh = false;
                    }
                }
                Some(_) => {}
                None if *patience == 0 => self.fan(triangle),
                // Also, an ear may have become one without its own neighbors' doing, where corners touch.
                None if self.tolerance > 0.0 || !fresh => {
                    self.tolerance = 0.0;
                    self.all_left(patience).for_each(|at| self.judge(at));
                    fresh = true;
                }
                // The polygon crosses itself. Any corner will do, but best one that bends the right way.
                None => {
                    let any = self.all_left(patience);
                    if let Some(at) = any.max_by(|a, b| self.bend(*a).total_cmp(&self.bend(*b))) {
                        self.cut(at, triangle);
                    }
                    fresh = false;
                }
            }
        }
    }

    /// Cuts what is left without a look.
    fn fan(&mut self, triangle: &mut dyn FnMut([usize; 3])) {
        let Some(first) = self.corners.iter().position(|corner| corner.kind != Kind::Gone) else {
            return;
        };
        let mut at = self.corners[first].after as usize;
        for _ in 2..self.left {
            let after = self.corners[at].after as usize;
            triangle([first, at, after]);
            at = after;
        }
        self.left = 2;
    }

    /// The corners that are left; to find them takes patience too.
    fn all_left(&self, patience: &mut u64) -> std::vec::IntoIter<usize> {
        *patience = patience.saturating_sub(self.corners.len() as u64);
        let left = (0..self.corners.len()).filter(|at| self.corners[*at].kind != Kind::Gone);
        left.collect::<Vec<_>>().into_iter()
    }

    fn cut(&mut self, at: usize, triangle: &mut dyn FnMut([usize; 3])) {
        let [before, after] = self.neighbors(at);
        triangle([before, at, after]);
        self.become_kind(at, Kind::Gone);
        self.corners[at].round += 1;
        self.corners[before].after = after as u32;
        self.corners[after].before = before as u32;
        self.left -= 1;
        if self.left > 2 {
            self.classify(before);
            self.classify(after);
            // Smaller numbers deserve a smaller grid: what is left may be in a small part of it.
            if self.hindrances * 2 < self.grid.count {
                self.grid.fill(&self.corners, self.hindrances);
            }
            self.judge(before);
            self.judge(after);
        }
    }

    fn neighbors(&self, at: usize) -> [usize; 2] {
        let corner = &self.corners[at];
        [corner.before as usize, corner.after as usize]
    }

    /// The places of a corner and its neighbors.
    fn triangle(&self, at: usize) -> [DVec2; 3] {
        let [before, after] = self.neighbors(at);
        [before, at, after].map(|at| self.corners[at].place)
    }

    /// Twice the area of that triangle, negative if the corner bends the wrong way.
    fn bend(&self, at: usize) -> f64 {
        let [a, b, c] = self.triangle(at);
        area(a, b, c)
    }

    fn classify(&mut self, at: usize) {
        let [a, b, c] = self.triangle(at);
        let is_convex = area(a, b, c) > self.tolerance * longest(a, b, c);
        self.become_kind(at, if is_convex { Kind::Convex } else { Kind::Hindrance });
    }

    fn become_kind(&mut self, at: usize, kind: Kind) {
        let old = std::mem::replace(&mut self.corners[at].kind, kind);
        self.hindrances -= usize::from(old == Kind::Hindrance);
        self.hindrances += usize::from(kind == Kind::Hindrance);
    }

    /// Puts a corner on the list of candidates, in place of what was there of it, unless it bends the wrong way.
    fn judge(&mut self, at: usize) {
        let rank = self.rank(at);
        let corner = &mut self.corners[at];
        corner.round += 1;
        if let Some(rank) = rank {
            self.candidates.push((rank, Reverse(at as u32), corner.round));
        }
    }

    /// How urgently a corner is to be cut off. First of all those where nothing is, in the way of others: in the same
    /// place as a neighbor, or the tip of a way there and back. Then the best shaped. Last those on a straight line,
    /// which make no area with their neighbors, but may with others.
    fn rank(&self, at: usize) -> Option<u32> {
        let [a, b, c] = self.triangle(at);
        let double_area = area(a, b, c);
        if double_area.abs() <= self.tolerance * longest(a, b, c) {
            let is_there = |p, q| is_near(p, q, self.tolerance);
            let there_and_back = is_there(a, b) || is_there(b, c) || (a - b).dot(c - b) > 0.0;
            return Some(if there_and_back { u32::MAX } else { 0 });
        }
        // 1 for equal sides.
        let sides = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
        let quality = double_area * (12.0_f64.sqrt() / sides);
        (double_area > 0.0).then_some(1 + (quality * 1e9) as u32)
    }

    /// True if some other corner lies in the triangle of a corner and its neighbors. This takes time, so it is asked of a
    /// candidate only when its turn has come. When patience is over, the rest is done blindly.
    fn is_hindered(&mut self, at: usize, patience: &mut u64) -> bool {
        let ear = Ear::new(self.triangle(at), self.tolerance);
        if *patience == 0 || ear.is_flat() {
            return false;
        }
        // What was in the way before, or is beside it, often is again.
        let Corner { before, after, .. } = self.corners[self.corners[at].hindrance as usize];
        let known = [self.corners[at].hindrance, before, after];
        if known.into_iter().any(|other| ear.is_hindered_by(other, &self.corners)) {
            return true;
        }
        let found = self.grid.find_hindrance(&self.corners, &ear, patience);
        self.corners[at].hindrance = found.unwrap_or(self.corners[at].hindrance);
        found.is_some()
    }
}

/// A corner and its neighbors, counter-clockwise.
struct Ear {
    triangle: [DVec2; 3],
    /// The box around it.
    low: DVec2,
    high: DVec2,
    tolerance: f64,
    /// The tolerance as twice an area over each side.
    slack: [f64; 3],
}

impl Ear {
    fn new(triangle: [DVec2; 3], tolerance: f64) -> Ear {
        let [a, b, c] = triangle;
        let slack = [b - a, c - b, a - c].map(|side| tolerance * side.length());
        let (low, high) = (a.min(b).min(c) - tolerance, a.max(b).max(c) + tolerance);
        Ear { triangle, low, high, tolerance, slack }
    }

    /// Twice the areas between each side and a point, positive on the inner side.
    #[inline]
    fn areas(&self, p: DVec2) -> [f64; 3] {
        let [a, b, c] = self.triangle;
        [area(a, b, p), area(b, c, p), area(c, a, p)]
    }

    /// True if nothing can lie in it.
    fn is_flat(&self) -> bool {
        let [a, b, c] = self.triangle;
        area(a, b, c) <= self.slack[0].max(self.slack[1]).max(self.slack[2])
    }

    /// True if this corner of the polygon lies in it or on its edge, or in the place of one of its tips with an edge that
    /// goes into it.
    #[inline]
    fn is_hindered_by(&self, at: u32, corners: &[Corner]) -> bool {
        let Corner { place, before, after, kind, .. } = corners[at as usize];
        // Far beyond the tip of a thin triangle its lines alone are not enough.
        let is_near_by = kind == Kind::Hindrance && place.cmpge(self.low).all() && place.cmple(self.high).all();
        if !is_near_by || self.areas(place).iter().zip(self.slack).any(|(area, slack)| *area < -slack) {
            return false;
        }
        let Some(tip) = self.triangle.iter().position(|tip| is_near(place, *tip, self.tolerance)) else {
            return true;
        };
        // The sides that meet in that tip.
        let sides = [tip, (tip + 2) % 3];
        [before, after].into_iter().any(|end| {
            let areas = self.areas(corners[end as usize].place);
            sides.into_iter().all(|side| areas[side] > self.slack[side])
        })
    }
}

/// Leaves out one coordinate so that the polygon runs counter-clockwise.
fn flattening(normal: DVec3) -> impl Fn(DVec3) -> DVec2 {
    let size = normal.abs();
    let axis = match () {
        () if size.x >= size.y && size.x >= size.z => 0,
        () if size.y >= size.z => 1,
        () => 2,
    };
    let mirrored = normal[axis] < 0.0;
    move |p| {
        let [u, v] = [p[(axis + 1) % 3], p[(axis + 2) % 3]];
        if mirrored { DVec2::new(v, u) } else { DVec2::new(u, v) }
    }
}

/// Twice the area of a triangle, negative if it runs clockwise.
#[inline]
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The length of the longest side.
#[inline]
fn longest(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared()).sqrt()
}

/// True if two places are the same, up to a distance along each axis.
#[inline]
fn is_near(p: DVec2, q: DVec2, tolerance: f64) -> bool {
    (p - q).abs().max_element() <= tolerance
}

/// A grid over the polygon with the corners that may be in the way.
#[derive(Debug, Default)]
struct Grid {
    /// How many corners were put in.
    count: usize,
    low: DVec2,
    /// Cells for each unit of length.
    scale: DVec2,
    columns: usize,
    rows: usize,
    /// Where the corners of each cell begin in `items`, and where they end.
    spans: Vec<[u32; 2]>,
    items: Vec<u32>,
}

impl Grid {
    /// Takes those corners that are not convex; no others will be.
    fn fill(&mut self, corners: &[Corner], count: usize) {
        let hindrances = || (0..).zip(corners).filter(|(_, corner)| corner.kind == Kind::Hindrance);
        self.count = count;
        self.lay_out(|| hindrances().map(|(_, corner)| corner.place));
        // Corners by cell: counted, summed up, and put in from behind.
        self.spans.clear();
        self.spans.resize(self.columns * self.rows, [0; 2]);
        self.items.clear();
        self.items.resize(count, 0);
        for (_, corner) in hindrances() {
            let cell = self.cell(corner.place);
            self.spans[cell][1] += 1;
        }
        let mut sum = 0;
        for span in &mut self.spans {
            sum += span[1];
            *span = [sum; 2];
        }
        for (at, corner) in hindrances() {
            let cell = self.cell(corner.place);
            let [start, _] = &mut self.spans[cell];
            *start -= 1;
            self.items[*start as usize] = at;
        }
    }

    /// About as many cells as there are corners to hold, square if the polygon is not too long for that.
    fn lay_out<I: Iterator<Item = DVec2>>(&mut self, places: impl Fn() -> I) {
        let most = self.count.max(1);
        self.low = places().fold(DVec2::INFINITY, DVec2::min);
        let size = places().fold(DVec2::NEG_INFINITY, DVec2::max) - self.low;
        let side = (size.x * size.y / most as f64).sqrt();
        // What is not a number becomes 0, and infinity as many as may be.
        self.columns = ((size.x / side) as usize).clamp(1, most);
        self.rows = ((size.y / side) as usize).clamp(1, most.div_ceil(self.columns));
        self.scale = DVec2::new(self.columns as f64, self.rows as f64) / size;
    }

    fn column_and_row(&self, place: DVec2) -> [usize; 2] {
        let cell = (place - self.low) * self.scale;
        [(cell.x as usize).min(self.columns - 1), (cell.y as usize).min(self.rows - 1)]
    }

    fn cell(&self, place: DVec2) -> usize {
        let [column, row] = self.column_and_row(place);
        row * self.columns + column
    }

    /// A corner that is in the way of an ear. Takes those out of the grid that are no longer in anyone's way.
    fn find_hindrance(&mut self, corners: &[Corner], ear: &Ear, patience: &mut u64) -> Option<u32> {
        let [first_column, first_row] = self.column_and_row(ear.low);
        let [last_column, last_row] = self.column_and_row(ear.high);
        for row in first_row..=last_row {
            let cells = row * self.columns + first_column..=row * self.columns + last_column;
            for [start, end] in &mut self.spans[cells] {
                *patience = patience.saturating_sub(1 + u64::from(*end - *start));
                let mut at = *start;
                while at < *end {
                    let item = self.items[at as usize];
                    if corners[item as usize].kind != Kind::Hindrance {
                        *end -= 1;
                        self.items.swap(at as usize, *end as usize);
                    } else if ear.is_hindered_by(item, corners) {
                        return Some(item);
                    } else {
                        at += 1;
                    }
                }
            }
        }
        None
    }
}
