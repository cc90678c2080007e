//! What has been gathered so far: the only thing that changes while rendering.

mod merge;
mod region;
mod sums;
mod taken;

use crate::observer::RayCounts;
use durer_imaging::Image;
use durer_math::{DVec2, Rgb};
use std::cmp::Ordering::Equal;

pub use merge::{FilmOutline, MergeError, Merging};
pub use region::Region;
pub(crate) use region::TILE;
pub use sums::{Calm, Part, SampleRange, Sums};
pub(crate) use sums::{PixelSums, SampledTile};

/// The colours of a region's pixels, in linear light, and an account of how they came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    region: Region,
    pixels: Vec<Rgb>,
    /// How often each pixel was divided.
    depths: Vec<u8>,
    /// Which tiles are finished, row by row.
    finished: Vec<bool>,
    /// How many pixels they have.
    finished_pixels: u64,
    account: Account,
    /// Of integrators that take samples; `pixels` are their means then.
    sums: Option<Sums>,
    /// All that were taken.
    samples: u64,
}

/// A [`Film`] taken apart, to be stored and put together again. The default is that of nothing at all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmParts {
    /// Part of the picture that it is; not empty.
    pub region: Region,
    /// Colours in linear light, row by row: one for each pixel, or none if there are sums, from which they follow.
    pub pixels: Vec<Rgb>,
    /// How often each pixel was divided: as many.
    pub depths: Vec<u8>,
    /// Which tiles are finished, row by row: as many as [`Region::tile_count`] says. With sums all are, or none.
    pub finished: Vec<bool>,
    /// Rays traced.
    pub rays: RayCounts,
    /// Samples whose colour was not finite.
    pub bad_samples: u64,
    /// The first of them; there is one exactly if there are any.
    pub first_bad_sample: Option<BadSample>,
    /// Of integrators that take samples.
    pub sums: Option<Sums>,
}

/// How pixels came about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Account {
    pub(crate) rays: RayCounts,
    pub(crate) bad_samples: u64,
    pub(crate) first_bad_sample: Option<BadSample>,
}

/// A sample whose colour was not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadSample {
    /// Where it is, in pixels from the picture's upper left corner.
    pub at: DVec2,
}

/// A finished rectangle of pixels, to be put on the film: one tile, or some side by side.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) region: Region,
    pub(crate) pixels: Vec<Rgb>,
    /// None if no pixel was divided.
    pub(crate) depths: Vec<u8>,
    pub(crate) account: Account,
}

impl Tile {
    /// One without pixels as yet.
    pub(crate) fn new(region: Region) -> Tile {
        let length = region.pixels() as usize;
        Tile { region, pixels: Vec::with_capacity(length), depths: Vec::new(), account: Account::default() }
    }
}

impl Account {
    pub(crate) fn add(&mut self, other: &Account) {
        self.rays.add(&other.rays);
        self.bad_samples = self.bad_samples.saturating_add(other.bad_samples);
        let first = [self.first_bad_sample, other.first_bad_sample].into_iter().flatten();
        self.first_bad_sample = first.min_by(|a, b| (a.at.y, a.at.x).partial_cmp(&(b.at.y, b.at.x)).unwrap_or(Equal));
    }

    /// Notes a sample that is not finite.
    pub(crate) fn bad_sample(&mut self, at: DVec2) {
        self.add(&Account { bad_samples: 1, first_bad_sample: Some(BadSample { at }), ..Account::default() });
    }
}

impl Film {
    /// A black film, of which nothing is finished.
    pub(crate) fn new(region: Region) -> Film {
        let length = region.width as usize * region.height as usize;
        Film {
            region,
            pixels: vec![Rgb::BLACK; length],
            depths: vec![0; length],
            finished: vec![false; region.tiles().count()],
            finished_pixels: 0,
            account: Account::default(),
            sums: None,
            samples: 0,
        }
    }

    /// A black film for these samples, none of which is taken.
    pub(crate) fn of_samples(region: Region, samples: SampleRange, direct: bool) -> Film {
        Film { sums: Some(Sums::new(Part { region, samples }, direct)), ..Film::new(region) }
    }

    /// Puts a film together; `None` if the parts do not fit each other.
    pub fn from_parts(parts: FilmParts) -> Option<Film> {
        let FilmParts { region, pixels, depths, finished, rays, bad_samples, first_bad_sample, sums } = parts;
        let lies_somewhere = region.is_somewhere();
        let length = if sums.is_some() { 0 } else { region.pixels() };
        let all_there = pixels.len() as u64 == length
            && depths.len() == pixels.len()
            && finished.len() as u64 == region.tile_count();
        let account_adds_up = (bad_samples > 0) == first_bad_sample.is_some();
        let account = Account { rays, bad_samples, first_bad_sample };
        if !(lies_somewhere && all_there && account_adds_up) {
            return None;
        }
        let tiles = region.tiles().zip(&finished).filter(|(_, finished)| **finished);
        let finished_pixels = tiles.map(|(tile, _)| tile.pixels()).sum();
        let Some(sums) = sums else {
            return Some(Film { region, pixels, depths, finished, finished_pixels, account, sums: None, samples: 0 });
        };
        let is_finished = finished_pixels == region.pixels();
        if !(is_finished || finished_pixels == 0) || !sums.fit(region, is_finished) {
            return None;
        }
        let pixels: Vec<Rgb> = (0..sums.taken.len()).map(|pixel| sums.mean(pixel)).collect();
        let (depths, samples) = (vec![0; pixels.len()], sums.samples());
        Some(Film { region, pixels, depths, finished, finished_pixels, account, sums: Some(sums), samples })
    }

    /// Adds samples of pixels.
    pub(crate) fn add(&mut self, tile: &SampledTile) {
        let Some(sums) = &mut self.sums else { return };
        for ((x, y), more) in tile.region.pixel_places().zip(&tile.pixels) {
            let pixel = self.region.index_of(x, y);
            sums.add(pixel, more);
            self.samples = self.samples.saturating_add(more.taken.into());
            self.pixels[pixel] = sums.mean(pixel);
        }
        self.account.add(&tile.account);
    }

    /// No more samples are to come. If all pixels have as many, the film is one of these. Not for
    /// films that noise ends: whether all of their pixels have as many depends on which part of the picture they are.
    pub(crate) fn finish_samples(&mut self) {
        if let Some(sums) = &mut self.sums {
            sums.close();
        }
        self.finish();
    }

    /// Nothing more is to come.
    pub(crate) fn finish(&mut self) {
        if let Some(sums) = &mut self.sums {
            sums.calm = Vec::new();
        }
        self.finished.fill(true);
        self.finished_pixels = self.region.pixels();
    }

    /// Puts a finished rectangle on the film, which begins at the corner of a tile and ends at the edges of tiles. Nothing of
    /// it is there before.
    pub(crate) fn put(&mut self, tile: &Tile) {
        let Region { x, y, width, .. } = tile.region;
        let width = width as usize;
        let first = (y - self.region.y) as usize * self.region.width as usize + (x - self.region.x) as usize;
        let starts = || (first..).step_by(self.region.width as usize);
        for (start, colors) in starts().zip(tile.pixels.chunks(width)) {
            self.pixels[start..start + width].copy_from_slice(colors);
        }
        for (start, depths) in starts().zip(tile.depths.chunks(width)) {
            self.depths[start..start + width].copy_from_slice(depths);
        }
        let across = self.region.width.div_ceil(TILE);
        for part in tile.region.tiles() {
            let (column, row) = ((part.x - self.region.x) / TILE, (part.y - self.region.y) / TILE);
            let finished = &mut self.finished[(row * across + column) as usize];
            self.finished_pixels += if *finished { 0 } else { part.pixels() };
            *finished = true;
        }
        self.account.add(&tile.account);
    }

    /// The tiles that are not finished, row by row.
    pub(crate) fn unfinished_tiles(&self) -> Vec<Region> {
        self.region.tiles().zip(&self.finished).filter(|(_, finished)| !**finished).map(|(tile, _)| tile).collect()
    }

    /// The rows of tiles that are not finished.
    pub(crate) fn unfinished_bands(&self) -> Vec<Region> {
        let across = self.region.width.div_ceil(TILE) as usize;
        let rows = self.region.bands().zip(self.finished.chunks(across));
        rows.filter(|(_, finished)| !finished.iter().all(|&done| done)).map(|(band, _)| band).collect()
    }

    /// Part of the picture that this is.
    pub fn region(&self) -> Region {
        self.region
    }

    /// The colours of its pixels in linear light, row by row; black where nothing is finished.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// Which of its tiles are finished, row by row.
    pub fn finished_tiles(&self) -> &[bool] {
        &self.finished
    }

    /// Pixels that are finished; the others are black, or lack some of their samples.
    pub fn finished_pixels(&self) -> u64 {
        self.finished_pixels
    }

    /// The sums of its samples, if it was made by an integrator that takes samples.
    pub fn sums(&self) -> Option<&Sums> {
        self.sums.as_ref()
    }

    /// The same, to be written.
    pub(crate) fn sums_mut(&mut self) -> Option<&mut Sums> {
        self.sums.as_mut()
    }

    /// How far it has come: its finished pixels, or the samples that it has.
    pub fn done(&self) -> u64 {
        if self.sums.is_some() { self.samples } else { self.finished_pixels }
    }

    /// True if every pixel is finished.
    pub fn is_complete(&self) -> bool {
        self.finished.iter().all(|&finished| finished)
    }

    /// Rays traced, by kind.
    pub fn rays(&self) -> RayCounts {
        self.account.rays
    }

    /// Samples whose colour was not finite. They are left out of their pixels.
    pub fn bad_samples(&self) -> u64 {
        self.account.bad_samples
    }

    /// The first such sample, row by row.
    pub fn first_bad_sample(&self) -> Option<BadSample> {
        self.account.first_bad_sample
    }

    /// How often each pixel was divided to look closer, row by row; 0 where a pixel was not.
    pub fn depths(&self) -> &[u8] {
        &self.depths
    }

    /// Does something with the picture, in linear light, without a copy of it.
    pub fn with_picture<T>(&mut self, work: impl FnOnce(&Image) -> T) -> T {
        let pixels = std::mem::take(&mut self.pixels);
        let image = Image { width: self.region.width, height: self.region.height, pixels };
        let done = work(&image);
        self.pixels = image.pixels;
        done
    }

    /// The picture, in linear light.
    pub fn develop(self) -> Image {
        Image { width: self.region.width, height: self.region.height, pixels: self.pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_that_do_not_fit_make_no_film() {
        let region = Region { x: 5, y: 7, width: 70, height: 40 };
        let film = Film::new(region);
        let parts = || FilmParts {
            region,
            pixels: film.pixels().to_vec(),
            depths: film.depths().to_vec(),
            finished: film.finished_tiles().to_vec(),
            rays: film.rays(),
            bad_samples: film.bad_samples(),
            first_bad_sample: film.first_bad_sample(),
            sums: None,
        };
        assert_eq!(region.tile_count(), 6);
        assert_eq!(Film::from_parts(parts()).as_ref(), Some(&film));
        let wrong: [fn(&mut FilmParts); 7] = [
            |parts| parts.region.width = 69,
            |parts| parts.region.x = u32::MAX,
            |parts| parts.pixels.truncate(2799),
            |parts| parts.depths.push(0),
            |parts| parts.finished.truncate(5),
            |parts| parts.bad_samples = 1,
            |parts| parts.first_bad_sample = Some(BadSample { at: DVec2::ZERO }),
        ];
        for spoil in wrong {
            let mut parts = parts();
            spoil(&mut parts);
            assert_eq!(Film::from_parts(parts), None);
        }
    }

    #[test]
    fn what_is_put_on_the_film_is_finished() {
        let mut film = Film::new(Region { x: 5, y: 7, width: 70, height: 40 });
        let put = |film: &mut Film, region: Region| {
            let length = region.pixels() as usize;
            let (pixels, depths) = (vec![Rgb::WHITE; length], vec![1; length]);
            film.put(&Tile { region, pixels, depths, account: Account::default() });
        };
        assert_eq!((film.unfinished_tiles().len(), film.unfinished_bands().len()), (6, 2));
        put(&mut film, Region { x: 69, y: 39, width: 6, height: 8 });
        assert_eq!((film.finished_pixels(), film.unfinished_tiles().len(), film.unfinished_bands().len()), (48, 5, 2));
        put(&mut film, Region { x: 5, y: 7, width: 70, height: 32 });
        assert_eq!(film.unfinished_bands(), [Region { x: 5, y: 39, width: 70, height: 8 }]);
        assert_eq!(film.unfinished_tiles().len(), 2);
        put(&mut film, Region { x: 5, y: 39, width: 70, height: 8 });
        assert!(film.is_complete() && film.finished_pixels() == 2800);
        assert!(film.develop().pixels.iter().all(|&pixel| pixel == Rgb::WHITE));
    }
}
