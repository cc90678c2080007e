//! The two methods of POV-Ray, to compare with: what version 3.7 does, but for its jitter, which is left out.

use super::lattice::{ByPlace, LatticeRows, Place, Span, UNIT};
use super::own::{OwnSamples, PixelSamples};
use super::{Rows, Splat};
use crate::eye::{Eye, Look};
use crate::film::{Account, Region};
use durer_math::{DVec2, functions::pow};
use std::collections::BTreeMap;

/// Its `Antialias_Gamma`: differences are those of colours so encoded.
const GAMMA: f32 = 2.5;

/// The sum of the differences of the encoded components.
fn difference(a: &Look, b: &Look) -> f32 {
    let encoded = |look: &Look| look.color.to_array().map(|c| if c > 0.0 { pow(c, 1.0 / GAMMA) } else { 0.0 });
    encoded(a).iter().zip(encoded(b)).map(|(a, b)| (a - b).abs()).sum()
}

fn splat(at: DVec2, weight: f32, look: &Look) -> Splat {
    Splat { at, weight, color: look.color, is_finite: look.is_finite }
}

/// Method 1: a ray through the middle of each pixel. Where it differs from that of the pixel to the left or above, both are
/// sampled again on a grid.
pub(crate) struct Pov1 {
    pub(crate) threshold: f32,
    /// Samples along each side of the grid.
    pub(crate) depth: u32,
    picture: (u32, u32),
    centers: LatticeRows,
    closer: PixelSamples,
}

impl Pov1 {
    pub(crate) fn new(threshold: f32, depth: u32, picture: (u32, u32)) -> Pov1 {
        Pov1 { threshold, depth, picture, centers: LatticeRows::new(), closer: PixelSamples::new() }
    }

    fn differs_from_a_neighbor(&self, x: u32, y: u32) -> bool {
        let (width, height) = self.picture;
        let neighbors = [
            (x > 0).then(|| (x - 1, y)),
            (y > 0).then(|| (x, y - 1)),
            (x + 1 < width).then_some((x + 1, y)),
            (y + 1 < height).then_some((x, y + 1)),
        ];
        let own = self.centers.get(x, y);
        neighbors.into_iter().flatten().any(|(x, y)| difference(own, self.centers.get(x, y)) >= self.threshold)
    }

    /// The ray through the middle counts like each of the grid, one of which may go there as well.
    fn grid(&self, eye: &impl Eye, (x, y): (u32, u32), account: &mut Account) -> Vec<Splat> {
        let n = self.depth;
        let weight = 1.0 / (n * n + 1) as f32;
        let point = |row: u32, column: u32| {
            DVec2::new(f64::from(x), f64::from(y))
                + DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) / f64::from(n)
        };
        let points: Vec<DVec2> = (0..n).flat_map(|row| (0..n).map(move |column| point(row, column))).collect();
        let mut looks = Vec::with_capacity(points.len());
        eye.looks(&points, &mut looks, account);
        let first = splat(Place::center(x, y).point(), weight, self.centers.get(x, y));
        let grid = points.iter().zip(&looks).map(|(&at, look)| splat(at, weight, look));
        std::iter::once(first).chain(grid).collect()
    }
}

impl Rows for Pov1 {
    fn sample(
        &mut self,
        eye: &impl Eye,
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let around = band.grown(1, self.picture);
        self.centers.extend(eye, Span::centers(around), Place::center, account);
        let closer =
            PixelSamples::make(band, account, stop, |x, y, account| match self.differs_from_a_neighbor(x, y) {
                true => (self.grid(eye, (x, y), account), 1),
                false => OwnSamples::default(),
            });
        closer.map(|closer| self.closer = closer).is_some()
    }

    fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>) {
        match &self.closer.of(x, y).0[..] {
            [] => splats.push(splat(Place::center(x, y).point(), 1.0, self.centers.get(x, y))),
            closer => splats.extend_from_slice(closer),
        }
    }

    fn depth(&self, x: u32, y: u32) -> u8 {
        self.closer.of(x, y).1
    }
}

/// Method 2: rays through the corners of each pixel. Where two of the four differ, the pixel is cut into quarters, each of
/// which is treated in the same way. Pixels share their corners, but no points on the sides between them.
pub(crate) struct Pov2 {
    pub(crate) threshold: f32,
    /// A pixel has at the most (2^(depth - 1) + 1)² samples.
    pub(crate) depth: u32,
    corners: LatticeRows,
    closer: PixelSamples,
}

impl Pov2 {
    pub(crate) fn new(threshold: f32, depth: u32) -> Pov2 {
        Pov2 { threshold, depth, corners: LatticeRows::new(), closer: PixelSamples::new() }
    }

    fn corners_of(&self, x: u32, y: u32) -> [&Look; 4] {
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(right, down)| self.corners.get(x + right, y + down))
    }

    fn differ(&self, corners: [&Look; 4]) -> bool {
        (0..4).any(|i| (0..i).any(|j| difference(corners[i], corners[j]) >= self.threshold))
    }

    fn divide(&self, eye: &impl Eye, (x, y): (u32, u32), account: &mut Account) -> OwnSamples {
        let place = Place::corner(x, y);
        let (looks, weights) = (ByPlace::default(), BTreeMap::new());
        let mut square = Square { pov: self, eye, account, looks, weights, deepest: 1 };
        for ((right, down), look) in [(0, 0), (UNIT, 0), (0, UNIT), (UNIT, UNIT)].into_iter().zip(self.corners_of(x, y))
        {
            square.looks.insert(place.offset(right, down), *look);
        }
        square.square(place, 1);
        let Square { looks, weights, deepest, .. } = square;
        let splats = weights.iter().map(|(place, &weight)| splat(place.point(), weight, &looks[place])).collect();
        (splats, u8::try_from(deepest - 1).unwrap_or(u8::MAX))
    }
}

/// A pixel that is divided.
struct Square<'a, E> {
    pov: &'a Pov2,
    eye: &'a E,
    account: &'a mut Account,
    looks: ByPlace<Look>,
    weights: BTreeMap<Place, f32>,
    deepest: u32,
}

impl<E: Eye> Square<'_, E> {
    fn look(&mut self, place: Place) -> Look {
        let (eye, account) = (self.eye, &mut *self.account);
        *self.looks.entry(place).or_insert_with(|| eye.look(place.point(), account))
    }

    fn square(&mut self, place: Place, level: u32) {
        self.deepest = self.deepest.max(level);
        let side = UNIT >> (level - 1);
        let places = [(0, 0), (side, 0), (0, side), (side, side)].map(|(x, y)| place.offset(x, y));
        let looks = places.map(|place| self.look(place));
        if level < self.pov.depth && self.pov.differ(looks.each_ref()) {
            let half = side / 2;
            for (x, y) in [(0, 0), (half, 0), (0, half), (half, half)] {
                self.square(place.offset(x, y), level + 1);
            }
        } else {
            // A quarter of the square's area: a power of two, so that adding up loses nothing.
            let weight = 0.25 / (1_u64 << (2 * (level - 1))) as f32;
            for place in places {
                *self.weights.entry(place).or_insert(0.0) += weight;
            }
        }
    }
}

impl Rows for Pov2 {
    fn sample(
        &mut self,
        eye: &impl Eye,
        band: Region,
        account: &mut Account,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        self.corners.extend(eye, Span::corners(band), Place::corner, account);
        let closer = PixelSamples::make(band, account, stop, |x, y, account| {
            match self.depth > 1 && self.differ(self.corners_of(x, y)) {
                true => self.divide(eye, (x, y), account),
                false => OwnSamples::default(),
            }
        });
        closer.map(|closer| self.closer = closer).is_some()
    }

    fn splats(&self, x: u32, y: u32, splats: &mut Vec<Splat>) {
        match &self.closer.of(x, y).0[..] {
            [] => {
                let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(right, down)| Place::corner(x + right, y + down));
                let looks = self.corners_of(x, y);
                splats.extend(corners.iter().zip(looks).map(|(place, look)| splat(place.point(), 0.25, look)));
            }
            closer => splats.extend_from_slice(closer),
        }
    }

    fn depth(&self, x: u32, y: u32) -> u8 {
        self.closer.of(x, y).1
    }
}
