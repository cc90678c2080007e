//! Tiles on all cores. Threads live here and change no result: a pixel depends on nothing but scene and place.

use crate::antialias::{Antialias, grid::Grid, recursive::Recursive};
use crate::compile::CompiledScene;
use crate::film::{Film, Region, Tile};
use crate::first_hits::FirstHits;
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
    /// Number of threads; `None` takes those of [`with_threads`] if it is called in there, else one for each core.
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

/// Runs `work` in a pool of so many threads; `None` takes one for each core. All that it calls here uses no others:
/// [`compile`](crate::compile), and [`render`] unless its options ask for a number of their own. In WebAssembly, which has
/// no threads, the caller does the work.
///
/// # Errors
///
/// The system refused to start the threads.
pub fn with_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T, RenderError> {
    if cfg!(target_family = "wasm") {
        return Ok(work());
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    Ok(pool.map_err(|error| RenderError::Threads(error.to_string()))?.install(work))
}

/// Renders the scene, or a region of it. If `progress` stops it, the film holds what was finished.
pub fn render(scene: &CompiledScene, options: &RenderOptions, progress: &dyn Progress) -> Result<Film, RenderError> {
    let film = Film::new(region_of(scene, options)?);
    let render = |tile| render_tile(scene, tile);
    in_tiles(film.region(), options, progress, film, render, |film, tile| film.put(&tile))
}

/// The part of the picture that is asked for.
pub(crate) fn region_of(scene: &CompiledScene, options: &RenderOptions) -> Result<Region, RenderError> {
    let (width, height) = scene.picture_size();
    let region = options.region.unwrap_or(Region { x: 0, y: 0, width, height });
    let fits = |start: u32, length: u32, limit: u32| length > 0 && start < limit && length <= limit - start;
    match fits(region.x, region.width, width) && fits(region.y, region.height, height) {
        true => Ok(region),
        false => Err(RenderError::RegionOutside { region, picture: (width, height) }),
    }
}

/// Cuts a region into tiles, makes something of each, on all threads, and puts it all into `gathered`, tile by tile, until
/// `progress` stops it.
pub(crate) fn in_tiles<G: Send, T: Send>(
    region: Region,
    options: &RenderOptions,
    progress: &dyn Progress,
    gathered: G,
    make: impl Fn(Region) -> T + Sync,
    put: impl Fn(&mut G, T) + Sync,
) -> Result<G, RenderError> {
    let gathered = Mutex::new((gathered, 0));
    let total = u64::from(region.width) * u64::from(region.height);
    let work = || {
        tiles(region).into_par_iter().for_each(|tile| {
            if !progress.stop() {
                let made = make(tile);
                let finished = {
                    let mut gathered = gathered.lock().unwrap_or_else(PoisonError::into_inner);
                    put(&mut gathered.0, made);
                    gathered.1 += u64::from(tile.width) * u64::from(tile.height);
                    gathered.1
                };
                progress.finished(finished, total);
            }
        });
    };
    match options.threads {
        None if rayon::current_thread_index().is_some() => work(),
        threads => with_threads(threads, work)?,
    }
    Ok(gathered.into_inner().unwrap_or_else(PoisonError::into_inner).0)
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
    let first_hits = FirstHits::find(scene, antialias, region);
    for y in region.y..region.y + region.height {
        for x in region.x..region.x + region.width {
            let known = first_hits.of_pixel(tile.pixels.len());
            let pixel = render_pixel(scene, (integrator, antialias), (x, y), known, &mut tile.rays);
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
