//! What has been gathered so far: the only thing that changes while rendering.

use crate::observer::RayCounts;
use durer_imaging::Image;
use durer_math::Rgb;

/// A rectangle of pixels within a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Left edge, in pixels from the picture's left.
    pub x: u32,
    /// Upper edge, in pixels from the picture's top.
    pub y: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

/// The colours of a region's pixels, in linear light, and an account of how they came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    region: Region,
    pixels: Vec<Rgb>,
    finished: u64,
    rays: RayCounts,
    bad_samples: u64,
    first_bad_pixel: Option<(u32, u32)>,
}

/// A finished rectangle of pixels, to be put on the film.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) region: Region,
    pub(crate) pixels: Vec<Rgb>,
    pub(crate) rays: RayCounts,
    pub(crate) bad_samples: u64,
    pub(crate) first_bad_pixel: Option<(u32, u32)>,
}

impl Film {
    /// A black film.
    pub(crate) fn new(region: Region) -> Film {
        let pixels = vec![Rgb::BLACK; region.width as usize * region.height as usize];
        Film { region, pixels, finished: 0, rays: RayCounts::default(), bad_samples: 0, first_bad_pixel: None }
    }

    pub(crate) fn put(&mut self, tile: &Tile) {
        let width = tile.region.width as usize;
        for (row, colors) in tile.pixels.chunks(width).enumerate() {
            let y = tile.region.y as usize - self.region.y as usize + row;
            let start = y * self.region.width as usize + (tile.region.x - self.region.x) as usize;
            self.pixels[start..start + width].copy_from_slice(colors);
        }
        self.finished += tile.pixels.len() as u64;
        self.rays.add(&tile.rays);
        self.bad_samples += tile.bad_samples;
        let by_row = |&(x, y): &(u32, u32)| (y, x);
        self.first_bad_pixel = self.first_bad_pixel.into_iter().chain(tile.first_bad_pixel).min_by_key(by_row);
    }

    /// Part of the picture that this is.
    pub fn region(&self) -> Region {
        self.region
    }

    /// Pixels that are finished; the others are black.
    pub fn finished_pixels(&self) -> u64 {
        self.finished
    }

    /// True if every pixel is finished.
    pub fn is_complete(&self) -> bool {
        self.finished == self.pixels.len() as u64
    }

    /// Rays traced, by kind.
    pub fn rays(&self) -> RayCounts {
        self.rays
    }

    /// Samples whose colour was not finite. They count as black.
    pub fn bad_samples(&self) -> u64 {
        self.bad_samples
    }

    /// The first pixel, row by row, with such a sample.
    pub fn first_bad_pixel(&self) -> Option<(u32, u32)> {
        self.first_bad_pixel
    }

    /// The picture, in linear light.
    pub fn develop(self) -> Image {
        Image { width: self.region.width, height: self.region.height, pixels: self.pixels }
    }
}
