//! The anti-aliasing of choice: looks where something is to be seen, and knows an edge when it meets one.
//!
//! Every pixel is seen at its corners, which it shares with its neighbors, and in its middle. What is the same in all five
//! places is done. Where two colours meet along a line, the line is found by bisection on the sides of the square, which
//! takes a few rays where dividing takes hundreds; a side that two pixels share is searched once. Everything else is
//! divided into quarters, each of which is treated in the same way. So are, once, the neighbors of pixels that no line
//! explains; and, until they must be met, squares in which a thing lies that is smaller than the lattice.
//!
//! A whole band of pixels goes through this level by level: no ray is traced twice, all have a weight or decide where an
//! edge is, and threads only ever trace lists of rays.

mod edge;
mod judge;
pub(crate) mod small;

use super::lattice::{ByPlace, LatticeRows, Place, Span, UNIT};
use super::{Rows, Splat};
use crate::eye::{Eye, Look};
use crate::film::{Account, Region};
use crate::schedule::{in_parallel, in_parallel_chunks};
use durer_math::DVec2;
use edge::{Between, Edge, Side};
use judge::{Judge, Verdict};
use small::{OfPixels, SmallThings};

/// The samples of a band of pixels, and what they show.
pub(crate) struct Adaptive<'s> {
    judge: Judge,
    /// How often a pixel may be divided.
    max_depth: u8,
    picture: (u32, u32),
    small: &'s SmallThings,
    /// Those of the band and its neighbors.
    small_of_pixels: OfPixels,
    looks: Looks,
    /// What is between the ends of sides that were searched, by their middles and numbers.
    sides: ByPlace<[Option<Between>; 4]>,
    band: Region,
    /// For each pixel of the band, the range of its shares; empty for those that were not divided and show no edge.
    ranges: Vec<(u32, u32)>,
    shares: Vec<Share>,
    depths: Vec<u8>,
}

/// All that was seen.
struct Looks {
    corners: LatticeRows,
    centers: LatticeRows,
    /// Between those.
    finer: ByPlace<Look>,
}

impl Looks {
    fn get(&self, place: Place) -> Option<&Look> {
        let (column, row) = (place.x / UNIT, place.y / UNIT);
        match (place.x % UNIT, place.y % UNIT) {
            (0, 0) => Some(self.corners.get(column, row)),
            (x, y) if x == UNIT / 2 && y == UNIT / 2 => Some(self.centers.get(column, row)),
            _ => self.finer.get(&place),
        }
    }

    /// What is seen in a place that was looked at.
    fn at(&self, place: Place) -> &Look {
        match self.get(place) {
            Some(look) => look,
            None => unreachable!("places are looked at before they are asked for"),
        }
    }
}

/// A square of the picture: a pixel, or one that pixels are divided into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cell {
    /// Its upper left corner.
    place: Place,
    /// How often the pixel was divided.
    level: u8,
}

impl Cell {
    fn side(self) -> u32 {
        UNIT >> self.level
    }

    /// The four corners, clockwise from the upper left, and the middle.
    fn places(self) -> [Place; 5] {
        let side = self.side();
        [(0, 0), (side, 0), (side, side), (0, side), (side / 2, side / 2)].map(|(x, y)| self.place.offset(x, y))
    }

    /// Its quarters.
    fn quarters(self) -> [Cell; 4] {
        let half = self.side() / 2;
        [(0, 0), (half, 0), (0, half), (half, half)]
            .map(|(x, y)| Cell { place: self.place.offset(x, y), level: self.level + 1 })
    }

    /// The middles of its sides and of its quarters.
    fn new_places(self) -> [Place; 8] {
        let (side, half, quarter) = (self.side(), self.side() / 2, self.side() / 4);
        let far = half + quarter;
        [
            (half, 0),
            (0, half),
            (side, half),
            (half, side),
            (quarter, quarter),
            (far, quarter),
            (quarter, far),
            (far, far),
        ]
        .map(|(x, y)| self.place.offset(x, y))
    }

    fn pixel(self) -> (u32, u32) {
        (self.place.x / UNIT, self.place.y / UNIT)
    }

    /// In pixels of area.
    fn area(self) -> f32 {
        1.0 / (1_u32 << (2 * self.level)) as f32
    }
}

/// What a cell's five samples stand for: an eighth of its area each corner, half of it the middle. These are the parts of
/// the lattice that are closest to them.
const NEAREST: [f32; 5] = [0.125, 0.125, 0.125, 0.125, 0.5];

/// Part of a pixel that a sample stands for.
#[derive(Clone, Copy, Debug)]
struct Share {
    /// Column and row of the pixel, the row first for the order.
    pixel: (u32, u32),
    place: Place,
    weight: f32,
}

/// What becomes of a cell.
enum Outcome {
    /// The shares of its five samples.
    Done([f32; 5]),
    /// Its quarters are looked at, since more is seen than can be told.
    Divided,
    /// Its quarters are looked at, since something may be missed.
    DividedToSee,
}

impl<'s> Adaptive<'s> {
    pub(crate) fn new(threshold: f32, max_depth: u32, picture: (u32, u32), small: &'s SmallThings) -> Adaptive<'s> {
        let max_depth = u8::try_from(max_depth).unwrap_or(u8::MAX);
        Adaptive {
            judge: Judge { threshold },
            max_depth,
            picture,
            small,
            small_of_pixels: OfPixels::default(),
            looks: Looks { corners: LatticeRows::new(), centers: LatticeRows::new(), finer: ByPlace::default() },
            sides: ByPlace::default(),
            band: Region { x: 0, y: 0, width: 0, height: 0 },
            ranges: Vec::new(),
            shares: Vec::new(),
            depths: Vec::new(),
        }
    }

    /// Forgets what is above a row of pixels.
    #[expect(clippy::disallowed_methods, reason = "what is kept does not depend on the order")]
    fn forget_above(&mut self, row: u32) {
        let first = row * UNIT;
        self.looks.finer.retain(|place, _| place.y >= first);
        self.sides.retain(|place, _| place.y >= first);
    }

    /// What becomes of cells, by what is seen in them; finds edges on the way.
    fn outcomes(&mut self, eye: &impl Eye, cells: &[Cell], account: &mut Account) -> Vec<Outcome> {
        let verdicts: Vec<Verdict> = in_parallel(cells, account, |&cell, _| self.verdict(cell));
        self.search_sides(eye, cells, &verdicts, account);
        let judged: Vec<(Cell, Verdict)> = cells.iter().copied().zip(verdicts).collect();
        let found = in_parallel(&judged, account, |&(cell, verdict), account| match verdict {
            Verdict::Flat => (Outcome::Done(NEAREST), Vec::new()),
            Verdict::Mixed => (self.not_explained(cell), Vec::new()),
            Verdict::Missed => (Outcome::DividedToSee, Vec::new()),
            Verdict::Edge(classes) => {
                let mut edge = Edge::new(self, eye, cell, classes);
                match edge.shares(account) {
                    Some(shares) => (Outcome::Done(shares), edge.looked),
                    None => (self.not_explained(cell), edge.looked),
                }
            }
        });
        let keep = |(outcome, looked): (Outcome, Vec<(Place, Look)>)| {
            self.looks.finer.extend(looked);
            outcome
        };
        found.into_iter().map(keep).collect()
    }

    fn not_explained(&self, cell: Cell) -> Outcome {
        match cell.level < self.max_depth {
            // What is small is the likely cause, and known to the neighbors, too.
            true if self.small_of_pixels.has_any(cell) => Outcome::DividedToSee,
            true => Outcome::Divided,
            false => Outcome::Done(NEAREST),
        }
    }

    fn verdict(&self, cell: Cell) -> Verdict {
        let looks = cell.places().map(|place| self.looks.at(place));
        match cell.level < self.depth_needed(cell) {
            true => Verdict::Missed,
            false => self.judge.verdict(looks, cell.level),
        }
    }

    /// How often the pixel must be divided where a cell is, so that no small thing is missed.
    fn depth_needed(&self, cell: Cell) -> u8 {
        self.small.depth_needed(&self.small_of_pixels, cell, || cell.places().map(|place| self.looks.at(place)))
    }

    /// Searches the sides of cells that an edge goes through, each side once.
    fn search_sides(&mut self, eye: &impl Eye, cells: &[Cell], verdicts: &[Verdict], account: &mut Account) {
        let mut sides: Vec<Side> = Vec::new();
        for (&cell, verdict) in cells.iter().zip(verdicts) {
            if let Verdict::Edge(classes) = verdict {
                sides.extend(Side::of(cell, *classes));
            }
        }
        sides.sort_unstable();
        sides.dedup();
        sides.retain(|side| self.between(*side).is_none());
        // Every search begins in the middle, where two searches of one side may meet.
        self.look_at(eye, sides.iter().map(|side| side.middle()).collect(), account);
        let found = in_parallel(&sides, account, |side, account| side.search(self, eye, account));
        for (side, (between, looked)) in sides.iter().zip(found) {
            self.sides.entry(side.middle()).or_default()[side.number()] = Some(between);
            self.looks.finer.extend(looked);
        }
    }

    /// What is between the ends of a side, if it was searched.
    fn between(&self, side: Side) -> Option<Between> {
        self.sides.get(&side.middle())?[side.number()]
    }

    /// Looks at what is needed to treat the quarters of cells.
    fn look_closer(&mut self, eye: &impl Eye, cells: &[Cell], account: &mut Account) {
        self.look_at(eye, cells.iter().flat_map(|cell| cell.new_places()).collect(), account);
    }

    /// Looks at places, but at none again.
    fn look_at(&mut self, eye: &impl Eye, mut places: Vec<Place>, account: &mut Account) {
        places.sort_unstable();
        places.dedup();
        places.retain(|&place| self.looks.get(place).is_none());
        let points: Vec<DVec2> = places.iter().map(|place| place.point()).collect();
        let looks = in_parallel_chunks(&points, account, |points, looks, account| eye.looks(points, looks, account));
        self.looks.finer.extend(places.into_iter().zip(looks));
    }

    /// Notes what a cell's samples stand for.
    fn share(&mut self, cell: Cell, shares: [f32; 5]) {
        let (x, y) = cell.pixel();
        for (place, share) in cell.places().into_iter().zip(shares) {
            self.shares.push(Share { pixel: (y, x), place, weight: share * cell.area() });
        }
    }

    fn index(&self, x: u32, y: u32) -> usize {
        (y - self.band.y) as usize * self.band.width as usize + (x - self.band.x) as usize
    }

    /// Puts the shares of each pixel side by side, those of one sample into one.
    fn gather(&mut self) {
        // Stable, so that what is added up keeps its order.
        self.shares.sort_by_key(|share| (share.pixel, share.place));
        self.shares.dedup_by(|next, first| {
            let same = (next.pixel, next.place) == (first.pixel, first.place);
            if same {
                first.weight += next.weight;
            }
            same
        });
        let mut ranges = vec![(0, 0); self.ranges.len()];
        let mut start = 0;
        for shares in self.shares.chunk_by(|a, b| a.pixel == b.pixel) {
            let (y, x) = shares[0].pixel;
            ranges[self.index(x, y)] = (start, start + shares.len() as u32);
            start += shares.len() as u32;
        }
        self.ranges = ranges;
    }
}

impl Rows for Adaptive<'_> {
    fn sample(
        &mut self,
        eye: &impl Eye,
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let around = band.grown(1, self.picture);
        self.forget_above(around.y);
        self.looks.corners.extend(eye, Span::corners(around), Place::corner, account);
        self.looks.centers.extend(eye, Span::centers(around), Place::center, account);
        self.small_of_pixels = self.small.of_pixels(around);
        let pixels = (band.width * band.height) as usize;
        (self.band, self.ranges, self.depths) = (band, vec![(0, 0); pixels], vec![0; pixels]);
        self.shares.clear();
        let mut cells: Vec<Cell> =
            around.pixel_places().map(|(x, y)| Cell { place: Place::corner(x, y), level: 0 }).collect();
        let mut outcomes = self.outcomes(eye, &cells, account);
        divide_neighbors(around, &mut outcomes);
        let in_band = |cell: &Cell| {
            let (x, y) = cell.pixel();
            (band.x..band.x + band.width).contains(&x) && (band.y..band.y + band.height).contains(&y)
        };
        loop {
            if stop() {
                return false;
            }
            let mut divided = Vec::new();
            for (&cell, outcome) in cells.iter().zip(&outcomes).filter(|(cell, _)| in_band(cell)) {
                match outcome {
                    // Most pixels: their shares are known without a note.
                    Outcome::Done(NEAREST) if cell.level == 0 => {}
                    Outcome::Done(shares) => self.share(cell, *shares),
                    Outcome::Divided | Outcome::DividedToSee => divided.push(cell),
                }
            }
            if divided.is_empty() {
                break;
            }
            for cell in &divided {
                let (x, y) = cell.pixel();
                let index = self.index(x, y);
                self.depths[index] = self.depths[index].max(cell.level + 1);
            }
            self.look_closer(eye, &divided, account);
            cells = divided.iter().flat_map(|cell| cell.quarters()).collect();
            outcomes = self.outcomes(eye, &cells, account);
        }
        self.gather();
        !stop()
    }

    fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>) {
        let splat = |place: Place, weight: f32| {
            let look = self.looks.at(place);
            Splat { at: place.point(), weight, color: look.color, is_finite: look.is_finite }
        };
        let (start, end) = self.ranges[self.index(x, y)];
        if start < end {
            let shares = &self.shares[start as usize..end as usize];
            splats.extend(shares.iter().map(|share| splat(share.place, share.weight)));
        } else {
            let cell = Cell { place: Place::corner(x, y), level: 0 };
            splats.extend(cell.places().into_iter().zip(NEAREST).map(|(place, share)| splat(place, share)));
        }
    }

    fn depth(&self, x: u32, y: u32) -> u8 {
        self.depths[self.index(x, y)]
    }
}

/// Divides the neighbors of pixels that are divided, where they are done: what is between the two may reach into them.
fn divide_neighbors(region: Region, outcomes: &mut [Outcome]) {
    let (width, height) = (region.width as usize, region.height as usize);
    let divided: Vec<bool> = outcomes.iter().map(|outcome| matches!(outcome, Outcome::Divided)).collect();
    for (index, outcome) in outcomes.iter_mut().enumerate() {
        let (x, y) = (index % width, index / width);
        let (columns, rows) = (x.saturating_sub(1)..width.min(x + 2), y.saturating_sub(1)..height.min(y + 2));
        let next_to_divided =
            rows.flat_map(|y| columns.clone().map(move |x| (x, y))).any(|(x, y)| divided[y * width + x]);
        if next_to_divided && matches!(outcome, Outcome::Done(_)) {
            *outcome = Outcome::DividedToSee;
        }
    }
}
