//! Tiles on all cores. Threads live here and change no result: a pixel depends on nothing but scene and place.

use crate::antialias::{Antialias, grid::Grid, recursive::Recursive};
use crate::compile::CompiledScene;
use crate::film::{Film, Region, Tile};
use crate::integrators::{Integrator, whitted::Whitted};
use crate::observer::RayCounts;
use crate::pixel::render_pixel;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Edge of a tile, in pixels: small enough to share out evenly, large enough that sharing costs nothing.
const TILE: u32 = 32;

/// How to go about rendering; changes no pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderOptions {
    /// Number of threads; `None` takes one for each core.
    pub threads: Option<usize>,
    /// Part of the picture to render; `None` renders all of it.
    pub region: Option<Region>,
}

/// Hears of progress, and may stop the rendering. Called from several threads.
pub trait Progress: Sync {
    /// So many pixels of so many are finished.
    fn finished(&self, _pixels: u64, _of: u64) {}

    /// True stops the rendering after the tiles that are being worked on.
    fn stop(&self) -> bool {
        false
    }
}

/// Nobody listens.
impl Progress for () {}

/// What can keep a render from starting.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RenderError {
    /// The region is empty or reaches beyond the picture, whose width and height are given.
    RegionOutside {
        /// The region asked for.
        region: Region,
        /// Width and height of the picture.
        picture: (u32, u32),
    },
    /// The system refused to start the threads.
    Threads(String),
}

impl std::fmt::Display for RenderError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RenderError::RegionOutside { region: Region { x, y, width, height }, picture: (w, h) } => {
                write!(f, "the region {x},{y},{width},{height} does not lie within the picture of {w}×{h} pixels")
            }
            RenderError::Threads(why) => write!(f, "cannot start threads: {why}"),
        }
    }
}

impl std::error::Error for RenderError {}

/// Renders the scene, or a region of it. If `progress` stops it, the film holds what was finished.
pub fn render(scene: &CompiledScene, options: &RenderOptions, progress: &dyn Progress) -> Result<Film, RenderError> {
    let (width, height) = scene.picture_size();
    let region = options.region.unwrap_or(Region { x: 0, y: 0, width, height });
    let fits = |start: u32, length: u32, limit: u32| length > 0 && start < limit && length <= limit - start;
    if !fits(region.x, region.width, width) || !fits(region.y, region.height, height) {
        return Err(RenderError::RegionOutside { region, picture: (width, height) });
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| RenderError::Threads(error.to_string()))?;
    let film = Mutex::new(Film::new(region));
    let total = u64::from(region.width) * u64::from(region.height);
    pool.install(|| {
        tiles(region).into_par_iter().for_each(|tile| {
            if !progress.stop() {
                let tile = render_tile(scene, tile);
                let finished = {
                    let mut film = film.lock().unwrap_or_else(PoisonError::into_inner);
                    film.put(&tile);
                    film.finished_pixels()
                };
                progress.finished(finished, total);
            }
        });
    });
    Ok(film.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Cuts a region into tiles, row by row.
fn tiles(region: Region) -> Vec<Region> {
    let starts =
        |from: u32, length: u32| (0..length).step_by(TILE as usize).map(move |d| (from + d, TILE.min(length - d)));
    starts(region.y, region.height)
        .flat_map(|(y, height)| starts(region.x, region.width).map(move |(x, width)| Region { x, y, width, height }))
        .collect()
}

/// Chooses the anti-aliasing once, outside of the loops.
fn render_tile(scene: &CompiledScene, region: Region) -> Tile {
    match scene.settings.antialias {
        durer_scene::Antialias::None => render_tile_with(scene, region, &Whitted, &Grid { n: 1 }),
        durer_scene::Antialias::Grid { n } => render_tile_with(scene, region, &Whitted, &Grid { n }),
        durer_scene::Antialias::Recursive { threshold, max_depth } => {
            render_tile_with(scene, region, &Whitted, &Recursive { threshold, max_depth })
        }
    }
}

fn render_tile_with<I: Integrator, A: Antialias>(
    scene: &CompiledScene,
    region: Region,
    integrator: &I,
    antialias: &A,
) -> Tile {
    let mut tile = Tile {
        region,
        pixels: Vec::with_capacity(region.width as usize * region.height as usize),
        rays: RayCounts::default(),
        bad_samples: 0,
        first_bad_pixel: None,
    };
    for y in region.y..region.y + region.height {
        for x in region.x..region.x + region.width {
            let pixel = render_pixel(scene, (integrator, antialias), (x, y), &mut tile.rays);
            tile.pixels.push(pixel.color);
            if pixel.bad_samples > 0 {
                tile.bad_samples += pixel.bad_samples;
                tile.first_bad_pixel = tile.first_bad_pixel.or(Some((x, y)));
            }
        }
    }
    tile
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_a_region_once() {
        let region = Region { x: 5, y: 7, width: 70, height: 33 };
        let mut seen = vec![0; 70 * 33];
        for tile in tiles(region) {
            for y in tile.y..tile.y + tile.height {
                for x in tile.x..tile.x + tile.width {
                    seen[((y - 7) * 70 + x - 5) as usize] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&n| n == 1));
    }
}
