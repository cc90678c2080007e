//! What the eye's rays hit, found eight neighbors at a time, before the pixels are made.
//!
//! Rays of neighboring pixels go nearly the same way, which the tree makes use of. Only what is sampled for certain is
//! looked up: what anti-aliasing asks for beyond that depends on colors, which are not there yet.

use crate::ahead::{Ahead, Sum};
use crate::antialias::Antialias;
use crate::compile::CompiledScene;
use crate::eye::begin;
use crate::film::Region;
use crate::holes::Known;
use durer_geometry::{Hit, LANES, Packet, Ray};
use durer_math::DVec2;

/// A packet's pixels, across and down.
const BLOCK: (u32, u32) = (4, 2);
/// Pixels with more certain samples are dense enough by themselves that looking ahead only costs room.
const MOST_SAMPLES: usize = 16;

/// For each pixel of a tile, or of a part of it, the hits of its first rays.
#[derive(Default)]
pub(crate) struct FirstHits {
    hits: Vec<Option<Hit>>,
    /// In scenes with a vantage at the eye, what is known instead of the hits.
    seen: Vec<Ahead>,
    /// Hits known of a pixel.
    samples: usize,
    points: Vec<DVec2>,
}

/// What is known of the first rays of one pixel.
#[derive(Clone, Copy)]
pub(crate) enum FirstRays<'a> {
    /// Their hits.
    Hits(&'a [Option<Hit>]),
    /// More than that: `samples` of them, of which the first has this number.
    Seen { seen: &'a [Ahead], first: usize, samples: usize },
}

impl<'a> FirstRays<'a> {
    /// What is known of one of them.
    #[inline]
    pub(crate) fn known(&self, taken: usize) -> Option<Known<'a>> {
        match *self {
            FirstRays::Hits(hits) => hits.get(taken).map(|&hit| Known::Hit(hit)),
            FirstRays::Seen { seen, first, samples } => {
                let index = first + taken;
                (taken < samples).then(|| Known::Seen(seen[index / LANES].of(index % LANES)))
            }
        }
    }
}

impl FirstRays<'_> {
    /// All that arrives along one of them, if that is known: it is finite.
    #[inline(always)]
    pub(crate) fn sum(&self, taken: usize) -> Option<Sum> {
        match *self {
            FirstRays::Hits(_) => None,
            FirstRays::Seen { samples, .. } if taken >= samples => None,
            FirstRays::Seen { seen, first, .. } => {
                let index = first + taken;
                seen[index / LANES].sum(index % LANES)
            }
        }
    }
}

impl FirstHits {
    /// The parts of a tile, one after the other, that are best looked up at once.
    pub(crate) fn parts(scene: &CompiledScene, tile: Region) -> impl Iterator<Item = Region> {
        // What is known with a vantage takes more room, and finds its neighbors by itself.
        let height = if scene.eye_vantage.is_some() { 1 } else { tile.height };
        let rows = (tile.y..tile.y + tile.height).step_by(height.max(1) as usize);
        rows.map(move |y| Region { y, height, ..tile })
    }

    /// Looks up what is certain to be asked for in a part of a tile.
    pub(crate) fn find(&mut self, scene: &CompiledScene, antialias: &impl Antialias, part: Region) {
        let mut points = std::mem::take(&mut self.points);
        points.clear();
        antialias.certain(DVec2::ZERO, &mut points);
        self.samples = if points.len() > MOST_SAMPLES { 0 } else { points.len() };
        if self.samples > 0 {
            match (&scene.eye_vantage, Ahead::pays(scene)) {
                (None, _) => self.find_hits(scene, antialias, part, &mut points),
                (Some(_), true) => self.look_ahead(scene, antialias, part, &mut points),
                // There is a quick way to each single hit.
                (Some(_), false) => self.samples = 0,
            }
        }
        self.points = points;
    }

    fn look_ahead(&mut self, scene: &CompiledScene, antialias: &impl Antialias, part: Region, points: &mut Vec<DVec2>) {
        points.clear();
        for (x, y) in part.pixel_places() {
            antialias.certain(DVec2::new(f64::from(x), f64::from(y)), points);
        }
        self.seen.resize_with(points.len().div_ceil(LANES), Ahead::default);
        for (points, ahead) in points.chunks(LANES).zip(&mut self.seen) {
            ahead.look(scene, points);
        }
    }

    fn find_hits(&mut self, scene: &CompiledScene, antialias: &impl Antialias, tile: Region, points: &mut Vec<DVec2>) {
        let (samples, pixels) = (self.samples, tile.width as usize * tile.height as usize);
        self.hits.clear();
        self.hits.resize(pixels * samples, None);
        let mut places = Vec::new();
        for block in blocks(tile) {
            points.clear();
            places.clear();
            for (x, y) in pixels_of(block) {
                antialias.certain(DVec2::new(f64::from(x), f64::from(y)), points);
                let pixel = ((y - tile.y) * tile.width + x - tile.x) as usize;
                places.extend(pixel * samples..(pixel + 1) * samples);
            }
            for (points, places) in points.chunks(LANES).zip(places.chunks(LANES)) {
                self.look(scene, points, places);
            }
        }
    }

    fn look(&mut self, scene: &CompiledScene, points: &[DVec2], places: &[usize]) {
        let rays: arrayvec::ArrayVec<Ray, LANES> = points.iter().map(|&point| begin(scene, point).0).collect();
        let hits = scene.world.closest_hits(&Packet::new(&rays), f64::INFINITY, u32::MAX);
        for (&place, hit) in places.iter().zip(hits) {
            self.hits[place] = hit;
        }
    }

    /// The first rays of a pixel of the part, in the order in which they are taken. Pixels are counted row by row.
    pub(crate) fn of_pixel(&self, pixel: usize) -> FirstRays<'_> {
        let (first, samples) = (pixel * self.samples, self.samples);
        match self.seen.is_empty() {
            true => FirstRays::Hits(self.hits.get(first..first + samples).unwrap_or(&[])),
            false => FirstRays::Seen { seen: &self.seen, first, samples },
        }
    }
}

/// Cuts a tile into blocks of a packet's size, or less at its edges.
fn blocks(tile: Region) -> impl Iterator<Item = Region> {
    let Region { x: left, y: top, width, height } = tile;
    (0..height).step_by(BLOCK.1 as usize).flat_map(move |y| {
        (0..width).step_by(BLOCK.0 as usize).map(move |x| Region {
            x: left + x,
            y: top + y,
            width: BLOCK.0.min(width - x),
            height: BLOCK.1.min(height - y),
        })
    })
}

fn pixels_of(block: Region) -> impl Iterator<Item = (u32, u32)> {
    (block.y..block.y + block.height).flat_map(move |y| (block.x..block.x + block.width).map(move |x| (x, y)))
}
