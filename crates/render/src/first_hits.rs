//! What the eye's rays hit, found eight neighbors at a time, before the pixels are made.
//!
//! Rays of neighboring pixels go nearly the same way, which the tree makes use of. Only what is sampled for certain is
//! looked up: what anti-aliasing asks for beyond that depends on colors, which are not there yet.

use crate::antialias::Antialias;
use crate::compile::CompiledScene;
use crate::eye::begin;
use crate::film::Region;
use durer_geometry::{Hit, LANES, Packet, Ray};
use durer_math::DVec2;

/// A packet's pixels, across and down.
const BLOCK: (u32, u32) = (4, 2);
/// Pixels with more certain samples are dense enough by themselves that looking ahead only costs room.
const MOST_SAMPLES: usize = 16;

/// For each pixel of a tile the hits of its first rays.
pub(crate) struct FirstHits {
    hits: Vec<Option<Hit>>,
    /// Hits known of a pixel.
    samples: usize,
}

impl FirstHits {
    /// Looks up what is certain to be asked for in a tile: nothing, where there is a quicker way to each single hit.
    pub(crate) fn find(scene: &CompiledScene, antialias: &impl Antialias, tile: Region) -> FirstHits {
        let mut points = Vec::new();
        antialias.certain(DVec2::ZERO, &mut points);
        let samples = points.len();
        if scene.eye_vantage.is_some() || samples > MOST_SAMPLES {
            return FirstHits { hits: Vec::new(), samples: 0 };
        }
        let pixels = tile.width as usize * tile.height as usize;
        let mut found = FirstHits { hits: vec![None; pixels * samples], samples };
        let mut places = Vec::new();
        for block in blocks(tile) {
            points.clear();
            places.clear();
            for (x, y) in pixels_of(block) {
                antialias.certain(DVec2::new(f64::from(x), f64::from(y)), &mut points);
                let pixel = ((y - tile.y) * tile.width + x - tile.x) as usize;
                places.extend(pixel * samples..(pixel + 1) * samples);
            }
            for (points, places) in points.chunks(LANES).zip(places.chunks(LANES)) {
                found.look(scene, points, places);
            }
        }
        found
    }

    fn look(&mut self, scene: &CompiledScene, points: &[DVec2], places: &[usize]) {
        let rays: arrayvec::ArrayVec<Ray, LANES> = points.iter().map(|&point| begin(scene, point).0).collect();
        let hits = scene.world.closest_hits(&Packet::new(&rays), f64::INFINITY, u32::MAX);
        for (&place, hit) in places.iter().zip(hits) {
            self.hits[place] = hit;
        }
    }

    /// The hits of a pixel's first rays, in the order in which they are taken. Pixels are counted row by row.
    pub(crate) fn of_pixel(&self, pixel: usize) -> &[Option<Hit>] {
        &self.hits[pixel * self.samples..(pixel + 1) * self.samples]
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
