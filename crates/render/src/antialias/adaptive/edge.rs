//! A square that an edge goes through: where it does, and what lies on its two sides.

use super::judge::{difference, nearer};
use super::{Adaptive, Cell, NEAREST};
use crate::antialias::lattice::{Place, UNIT};
use crate::eye::{Eye, Look};
use crate::film::Account;
use durer_math::DVec2;

/// On the sides of a pixel an edge is found to one part of 2 to this power, and with each division to one bit less: the
/// area that is wrong becomes smaller with the square by itself.
const BITS: u32 = 7;
/// In the middle an edge is looked for this far from the straight line, in lengths of that line.
const BEND: f64 = 0.4;
/// ... to one part of 2 to this power.
const BEND_BITS: u32 = 4;
/// An edge that is bent by less than this is straight.
const STRAIGHT: f64 = 0.01;
/// An edge that cuts off less than this (its length, in sides of the square) is taken to be straight.
const SHORT: f64 = 0.25;

/// A side of a square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    start: Place,
    length: u32,
    is_vertical: bool,
    /// True if its ends are of different classes.
    is_crossed: bool,
}

/// What there is between the ends of a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Between {
    /// The edge, at this part of the way from left to right or from top to bottom.
    Edge(f64),
    /// The colour of the ends.
    Nothing,
    /// Another colour.
    More,
}

impl Side {
    /// The sides of a cell, clockwise from the upper one.
    pub(super) fn of(cell: Cell, classes: [bool; 5]) -> [Side; 4] {
        let length = cell.side();
        let sides = [(0, 0, false), (length, 0, true), (0, length, false), (0, 0, true)];
        std::array::from_fn(|i| {
            let (x, y, is_vertical) = sides[i];
            let is_crossed = classes[i] != classes[(i + 1) % 4];
            Side { start: cell.place.offset(x, y), length, is_vertical, is_crossed }
        })
    }

    /// The place that a side is known by, together with its number.
    pub(super) fn middle(self) -> Place {
        self.at(self.length / 2)
    }

    pub(super) fn number(self) -> usize {
        2 * usize::from(self.is_vertical) + usize::from(self.is_crossed)
    }

    fn at(self, distance: u32) -> Place {
        if self.is_vertical { self.start.offset(0, distance) } else { self.start.offset(distance, 0) }
    }

    /// Looks at what is between the ends. Gives what it looked at, too.
    pub(super) fn search(
        self,
        samples: &Adaptive<'_>,
        eye: &impl Eye,
        account: &mut Account,
    ) -> (Between, Vec<(Place, Look)>) {
        let mut looked = Vec::new();
        let mut look = |distance: u32| {
            let place = self.at(distance);
            samples.looks.get(place).copied().unwrap_or_else(|| {
                let look = eye.look(place.point(), account);
                looked.push((place, look));
                look
            })
        };
        let ends = [0, self.length].map(|distance| samples.looks.at(self.at(distance)));
        let between = if self.is_crossed { self.edge(ends, &mut look) } else { self.nothing(ends, &mut look, samples) };
        (between, looked)
    }

    /// Where the colour of one end becomes that of the other.
    fn edge(self, ends: [&Look; 2], look: &mut impl FnMut(u32) -> Look) -> Between {
        let level = UNIT.ilog2() - self.length.ilog2();
        let (mut low, mut high) = (0, self.length);
        for _ in 0..BITS.saturating_sub(level).max(2) {
            let middle = low + (high - low) / 2;
            match nearer(&look(middle), ends) {
                Some(false) => low = middle,
                Some(true) => high = middle,
                None => return Between::More,
            }
        }
        Between::Edge(f64::from(low + high) * 0.5 / f64::from(self.length))
    }

    /// Whether the middle is like the ends.
    fn nothing(self, ends: [&Look; 2], look: &mut impl FnMut(u32) -> Look, samples: &Adaptive<'_>) -> Between {
        let middle = look(self.length / 2);
        let most = difference(ends[0], ends[1]) + samples.judge.threshold;
        let is_like = ends.iter().all(|end| difference(end, &middle) <= most);
        if is_like { Between::Nothing } else { Between::More }
    }
}

/// A cell that an edge goes through.
pub(super) struct Edge<'a, 's, E> {
    samples: &'a Adaptive<'s>,
    eye: &'a E,
    cell: Cell,
    classes: [bool; 5],
    pub(super) looked: Vec<(Place, Look)>,
}

impl<'a, 's, E: Eye> Edge<'a, 's, E> {
    pub(super) fn new(samples: &'a Adaptive<'s>, eye: &'a E, cell: Cell, classes: [bool; 5]) -> Edge<'a, 's, E> {
        Edge { samples, eye, cell, classes, looked: Vec::new() }
    }

    /// What the samples stand for, if there is one edge from side to side and nothing else.
    pub(super) fn shares(&mut self, account: &mut Account) -> Option<[f32; 5]> {
        let mut crossed = Vec::with_capacity(2);
        for (index, side) in Side::of(self.cell, self.classes).into_iter().enumerate() {
            match self.samples.between(side)? {
                Between::Edge(t) => crossed.push((index, on_side(index, t))),
                Between::Nothing => {}
                Between::More => return None,
            }
        }
        let [(first, from), (second, to)] = crossed[..] else { return None };
        // From the first end on, clockwise, the corners are of one class until the second end.
        let corners = CORNERS[first + 1..=second].iter().copied();
        let outline: Vec<DVec2> = [from].into_iter().chain(corners).chain([to]).collect();
        let class = self.classes[second];
        let bulge = self.bulge([from, to], class, account)?;
        // The area of the class between the ends.
        let area = (polygon_area(&outline) + bulge).clamp(0.0, 1.0) as f32;
        Some(self.spread(class, area))
    }

    /// The area between the edge and the straight line between its ends, on the far side of the line from the corners of
    /// `class`: as of a parabola, of which one point is looked for. `None` if it is not there.
    fn bulge(&mut self, [from, to]: [DVec2; 2], class: bool, account: &mut Account) -> Option<f64> {
        let along = to - from;
        let length = along.length();
        if length < SHORT {
            return Some(0.0);
        }
        let middle = (from + to) * 0.5;
        // The corners of the class lie to the left of the way from the first end to the second, as y points downward.
        let outward = DVec2::new(-along.y, along.x) / length;
        let reach = BEND * length;
        self.middle_agrees(middle, outward, reach, class)?;
        let mut look = |offset: f64| self.class_at(middle + outward * offset, account);
        let within = STRAIGHT * length;
        let (mut low, mut high) = match (look(-within)? == class, look(within)? == class) {
            (true, false) => return Some(0.0),
            (true, true) => (within, reach),
            (false, false) => (-reach, -within),
            (false, true) => return None,
        };
        // The end that was not looked at yet.
        let is_outward = low > 0.0;
        if (look(if is_outward { high } else { low })? == class) == is_outward {
            return None;
        }
        for _ in 0..BEND_BITS {
            let offset = (low + high) * 0.5;
            if look(offset)? == class { low = offset } else { high = offset }
        }
        let bend = (low + high) * 0.5;
        self.is_round([from, to], outward * bend, is_outward, class, account)?;
        Some(bend * length * (2.0 / 3.0))
    }

    /// `None` if an edge that is bent is not bent evenly: halfway to the ends an arc has three quarters of its bend, a corner
    /// half of it.
    fn is_round(
        &mut self,
        [from, to]: [DVec2; 2],
        bend: DVec2,
        is_outward: bool,
        class: bool,
        account: &mut Account,
    ) -> Option<()> {
        for part in [0.25, 0.75] {
            let point = from + (to - from) * part + bend * 0.62;
            // Between the edge and the straight line it is like the one side if the edge bends outward, else like the other.
            if (self.class_at(point, account)? == class) != is_outward {
                return None;
            }
        }
        Some(())
    }

    /// `None` if the middle of the cell lies clearly on the wrong side of the line.
    fn middle_agrees(&self, on_line: DVec2, outward: DVec2, reach: f64, class: bool) -> Option<()> {
        let offset = (DVec2::splat(0.5) - on_line).dot(outward);
        let expected = if offset < -reach { Some(class) } else { (offset > reach).then_some(!class) };
        expected.is_none_or(|expected| expected == self.classes[4]).then_some(())
    }

    /// The class of what is seen at a point of the cell; of the nearest one in it, if that lies outside.
    fn class_at(&mut self, point: DVec2, account: &mut Account) -> Option<bool> {
        let side = f64::from(self.cell.side());
        // Not on the sides, which belong to two cells.
        let unit = |start: u32, offset: f64| start + (offset * side).round().clamp(1.0, side - 1.0) as u32;
        let place = Place { y: unit(self.cell.place.y, point.y), x: unit(self.cell.place.x, point.x) };
        let look = match self.samples.looks.get(place) {
            Some(look) => *look,
            None => match self.looked.iter().find(|(known, _)| *known == place) {
                Some((_, look)) => *look,
                None => {
                    let look = self.eye.look(place.point(), account);
                    self.looked.push((place, look));
                    look
                }
            },
        };
        // Like the corners that are farthest from the other class.
        let ends = [false, true].map(|class| self.samples.looks.at(self.cell.places()[self.corner_of(class)]));
        nearer(&look, ends)
    }

    /// A corner of a class, the middle one if there are three.
    fn corner_of(&self, class: bool) -> usize {
        let is_one = |corner: usize| self.classes[corner % 4] == class;
        let middle = (0..4).find(|&corner| is_one(corner) && is_one(corner + 1) && is_one(corner + 3));
        middle.or_else(|| (0..4).find(|&corner| is_one(corner))).unwrap_or(0)
    }

    /// Gives each class its area, shared by its samples as the lattice would.
    fn spread(&self, class: bool, area: f32) -> [f32; 5] {
        let of = |wanted: bool| -> f32 {
            NEAREST.iter().zip(self.classes).filter(|(_, class)| *class == wanted).map(|(share, _)| share).sum()
        };
        let (inside, outside) = (area / of(class), (1.0 - area) / of(!class));
        let mut shares = NEAREST;
        for (share, own) in shares.iter_mut().zip(self.classes) {
            *share *= if own == class { inside } else { outside };
        }
        shares
    }
}

/// The corners of a square of side 1, clockwise from the upper left.
const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

/// The point on a side of the unit square, sides counted clockwise from the upper one, at a part of the way from left to
/// right or from top to bottom.
fn on_side(side: usize, t: f64) -> DVec2 {
    match side {
        0 => DVec2::new(t, 0.0),
        1 => DVec2::new(1.0, t),
        2 => DVec2::new(t, 1.0),
        _ => DVec2::new(0.0, t),
    }
}

/// The area of a polygon whose corners go around it clockwise, where y points downward.
fn polygon_area(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>()
}
