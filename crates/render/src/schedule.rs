//! Tiles and bands on all cores. Threads live here and change no result: a pixel depends on nothing but scene and place.

use crate::antialias::adaptive::{Adaptive, small::SmallThings};
use crate::antialias::alone::Alone;
use crate::antialias::pov::{Pov1, Pov2};
use crate::antialias::{Antialias, Rows, Splat, grid::Grid, recursive::Recursive};
use crate::compile::CompiledScene;
use crate::eye::SceneEye;
use crate::film::{Account, Film, Region, SampleRange, Tile};
use crate::first_hits::FirstHits;
use crate::integrators;
use crate::integrators::ambient_occlusion::AmbientOcclusion;
use crate::integrators::cutout::{Cutout, Shown};
use crate::integrators::path::PathTracer;
use crate::integrators::sharp::Sharp;
use crate::memory::rows_at_a_time;
use crate::passes::{Goal, render_samples, same_samples_again};
use crate::pixel::render_pixel;
use crate::reconstruct::{Reconstruction, color_of, normalize};
use durer_math::Rgb;
use durer_scene::{Integrator, PixelFilter};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// What is to be rendered, and how to go about it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderOptions {
    /// Number of threads; `None` takes those of [`with_threads`] if it is called in there, else one for each core. It changes
    /// no pixel.
    pub threads: Option<usize>,
    /// Part of the picture to render; `None` renders all of it.
    pub region: Option<Region>,
    /// For integrators that take samples: exactly these of each pixel, whatever the scene says of noise and time. `None`
    /// takes what the scene says.
    pub samples: Option<SampleRange>,
    /// For integrators that take samples: know light that met one surface at most apart. It changes no pixel.
    pub direct: bool,
}

/// Hears of progress, and may stop the rendering. Called from several threads.
pub trait Progress: Sync {
    /// So much of so much is done: pixels finished, or samples taken. As long as it cannot be known how many samples there
    /// will be, the second number is an estimate.
    fn finished(&self, _done: u64, _of: u64) {}

    /// The film with what is finished so far. Other threads that have finished something wait until this returns.
    fn advanced(&self, _film: &Film) {}

    /// True stops the rendering after what is being worked on.
    fn stop(&self) -> bool {
        false
    }

    /// Seconds since some moment before the rendering began, for scenes with a limit of time; without a clock there is no
    /// such limit.
    fn elapsed(&self) -> Option<f64> {
        None
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
    /// The range of samples is empty, or the integrator with this name takes no samples that could be chosen from.
    NoSamples(&'static str),
    /// The film was made by another integrator.
    OtherFilm,
    /// The system refused to start the threads.
    Threads(String),
}

impl std::fmt::Display for RenderError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RenderError::RegionOutside { region: Region { x, y, width, height }, picture: (w, h) } => {
                write!(f, "the region {x},{y},{width},{height} does not lie within the picture of {w}×{h} pixels")
            }
            RenderError::NoSamples(integrator) => {
                write!(f, "the range of samples is empty, or `{integrator}` takes none that could be chosen from")
            }
            RenderError::OtherFilm => write!(f, "the film was made by another integrator"),
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
    let region = region_of(scene, options)?;
    let film = match (samples_of(scene, options)?, options.samples) {
        (Some(samples), _) => Film::of_samples(region, samples, options.direct),
        (None, None) => Film::new(region),
        (None, Some(_)) => return Err(RenderError::NoSamples(scene.settings.integrator.word())),
    };
    render_on(scene, film, options, progress)
}

/// Goes on with a film of the same scene until all of it is finished, or `progress` stops it. What is on it already is not
/// touched, and in the end its pixels are those that one call of [`render`] makes. (It may count some more rays: what
/// neighboring pixels share is traced again where the film was left.)
///
/// # Errors
///
/// The film's region does not lie in the picture, it was made by another integrator, or the system refused to start the
/// threads. The region in `options` does not matter; the samples should be those that the film was begun with.
pub fn render_on(
    scene: &CompiledScene,
    film: Film,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<Film, RenderError> {
    let region = Some(film.region());
    region_of(scene, &RenderOptions { region, ..*options })?;
    let samples = samples_of(scene, options)?;
    if samples.is_some() != film.sums().is_some() {
        return Err(RenderError::OtherFilm);
    }
    let mut film = film;
    with_pool(options, || match samples {
        None => with_antialias(scene, RenderAll { scene, film: &mut film, progress }),
        Some(samples) => {
            let settings = &scene.settings;
            let (noise, time) = if options.samples.is_some() { (None, None) } else { (settings.noise, settings.time) };
            take_samples(scene, Goal { samples, noise, time }, &mut film, progress);
        }
    })?;
    Ok(film)
}

/// The samples that are to be taken, of integrators that take any.
fn samples_of(scene: &CompiledScene, options: &RenderOptions) -> Result<Option<SampleRange>, RenderError> {
    let integrator = &scene.settings.integrator;
    if !integrator.takes_samples() {
        return Ok(None);
    }
    let samples = options.samples.unwrap_or(SampleRange { start: 0, end: scene.settings.samples_a_pixel() });
    if samples.count() == 0 { Err(RenderError::NoSamples(integrator.word())) } else { Ok(Some(samples)) }
}

/// Takes samples with the integrator that the scene wants.
fn take_samples(scene: &CompiledScene, goal: Goal, film: &mut Film, progress: &dyn Progress) {
    match scene.settings.integrator {
        Integrator::Path(settings) => take_samples_with(scene, &PathTracer(settings), goal, film, progress),
        Integrator::AmbientOcclusion { distance } => {
            let distance = distance.unwrap_or(f64::INFINITY);
            take_samples_with(scene, &AmbientOcclusion { distance }, goal, film, progress);
        }
        // They look where anti-aliasing says.
        Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => {}
    }
}

fn take_samples_with<I: integrators::Integrator>(
    scene: &CompiledScene,
    integrator: &I,
    goal: Goal,
    film: &mut Film,
    progress: &dyn Progress,
) {
    match scene.shown {
        Shown::Everything => render_samples((scene, integrator), goal, film, progress),
        shown @ (Shown::Things | Shown::Coverage) => {
            render_samples((scene, &Cutout { integrator, shown }), goal, film, progress);
        }
    }
}

/// How much of each pixel of a film the things of the scene cover, from 0 to 1, row by row: seen by the samples that the film is
/// of, or else by the same anti-aliasing. Takes as long as the rays of the eye alone. Of the options the threads count.
///
/// `None` if it cannot be told any more which samples the film is of.
///
/// # Errors
///
/// The film's region does not lie in the picture, or the system refused to start the threads.
pub fn coverage(
    mut scene: CompiledScene,
    film: &Film,
    options: &RenderOptions,
    progress: &dyn Progress,
) -> Result<Option<Vec<f32>>, RenderError> {
    scene.shown = Shown::Coverage;
    let scene = &scene;
    let (region, integrator) = (film.region(), Sharp::of(scene));
    region_of(scene, &RenderOptions { region: Some(region), ..*options })?;
    let seen = match film.sums() {
        Some(_) => same_samples_again((scene, &integrator), film, options, progress)?,
        None => {
            let mut seen = Film::new(region);
            with_pool(options, || with_antialias(scene, RenderAll { scene, film: &mut seen, progress }))?;
            Some(seen.pixels().to_vec())
        }
    };
    Ok(seen.map(|pixels| pixels.iter().map(|pixel| pixel.g.clamp(0.0, 1.0)).collect()))
}

/// Runs `work` in the pool that the options ask for.
pub(crate) fn with_pool<T: Send>(options: &RenderOptions, work: impl FnOnce() -> T + Send) -> Result<T, RenderError> {
    match options.threads {
        None if rayon::current_thread_index().is_some() => Ok(work()),
        threads => with_threads(threads, work),
    }
}

/// What can be done with any kind of anti-aliasing.
pub(crate) trait WithAntialias {
    type Output;
    /// With one of which each pixel stands alone, and no filter that reaches beyond it.
    fn alone<A: Antialias>(self, antialias: &A) -> Self::Output;
    /// With one of which pixels share samples.
    fn shared<R: Rows>(self, rows: R, filter: PixelFilter) -> Self::Output;
}

/// Chooses the anti-aliasing once, outside of the loops.
pub(crate) fn with_antialias<W: WithAntialias>(scene: &CompiledScene, work: W) -> W::Output {
    fn choose<W: WithAntialias, A: Antialias>(work: W, filter: PixelFilter, antialias: A) -> W::Output {
        match filter {
            PixelFilter::Box => work.alone(&antialias),
            PixelFilter::Tent { .. }
            | PixelFilter::Gaussian { .. }
            | PixelFilter::Mitchell { .. }
            | PixelFilter::BlackmanHarris { .. } => work.shared(Alone::new(antialias), filter),
        }
    }
    if let Integrator::Uv = scene.settings.integrator {
        // The mean of coordinates is nowhere near them where they begin anew, as around a ball.
        return work.alone(&Grid::new(1));
    }
    let (filter, picture) = (scene.settings.filter, scene.picture_size());
    match scene.settings.antialias {
        durer_scene::Antialias::None => choose(work, filter, Grid::new(1)),
        durer_scene::Antialias::Grid { n } => choose(work, filter, Grid::new(n)),
        durer_scene::Antialias::Recursive { threshold, max_depth } => {
            choose(work, filter, Recursive { threshold, max_depth })
        }
        durer_scene::Antialias::Adaptive { threshold, max_depth } => {
            let small = SmallThings::of(scene);
            work.shared(Adaptive::new(threshold, max_depth, picture, &small), filter)
        }
        durer_scene::Antialias::Pov1 { threshold, depth } => work.shared(Pov1::new(threshold, depth, picture), filter),
        durer_scene::Antialias::Pov2 { threshold, depth } => work.shared(Pov2::new(threshold, depth), filter),
    }
}

/// Renders what is unfinished of a film.
struct RenderAll<'a> {
    scene: &'a CompiledScene,
    film: &'a mut Film,
    progress: &'a dyn Progress,
}

impl WithAntialias for RenderAll<'_> {
    type Output = ();

    fn alone<A: Antialias>(self, antialias: &A) {
        let RenderAll { scene, film, progress } = self;
        let tiles = film.unfinished_tiles();
        let render = |tile| render_tile(scene, tile, antialias);
        in_tiles(tiles, progress, film, render, |film, tile| {
            film.put(&tile);
            progress.finished(film.finished_pixels(), film.region().pixels());
            progress.advanced(film);
        });
    }

    fn shared<R: Rows>(self, rows: R, filter: PixelFilter) {
        let RenderAll { scene, film, progress } = self;
        let mut reconstruction = Reconstruction::new(rows, filter, film.region(), scene.picture_size());
        let stop = || progress.stop();
        let eye = SceneEye::until(scene, &stop);
        let at_a_time = rows_at_a_time(&scene.settings, film.region().width);
        for band in film.unfinished_bands() {
            let mut tile = Tile::new(band);
            for rows in (0..band.height).step_by(at_a_time as usize) {
                let height = at_a_time.min(band.height - rows);
                let part = Region { y: band.y + rows, height, ..band };
                if stop() || !reconstruction.sample(&eye, part, &mut tile.account, &stop) {
                    return;
                }
                add_pixels(&reconstruction, part, &mut tile);
            }
            film.put(&tile);
            progress.finished(film.finished_pixels(), film.region().pixels());
            progress.advanced(film);
        }
    }
}

/// Adds pixels, of samples that are there.
fn add_pixels<R: Rows>(reconstruction: &Reconstruction<R>, region: Region, tile: &mut Tile) {
    let places: Vec<(u32, u32)> = region.pixel_places().collect();
    let chunks = places.par_chunks(CHUNK).map(|places| {
        let mut splats = Vec::new();
        let pixel = |&(x, y): &(u32, u32)| {
            reconstruction.splats(x, y, &mut splats);
            (color_of(&splats), reconstruction.depth(x, y))
        };
        places.iter().map(pixel).collect::<Vec<_>>()
    });
    for (color, depth) in chunks.collect::<Vec<_>>().into_iter().flatten() {
        tile.pixels.push(color);
        tile.depths.push(depth);
    }
}

/// Items are dealt out to threads in pieces of so many.
const CHUNK: usize = 256;

/// Makes something of each item, on all threads, in the order of the items.
pub(crate) fn in_parallel<I: Sync, T: Send>(
    items: &[I],
    account: &mut Account,
    make: impl Fn(&I, &mut Account) -> T + Sync,
) -> Vec<T> {
    in_parallel_chunks(items, account, |items, made, account| {
        made.extend(items.iter().map(|item| make(item, account)));
    })
}

/// As [`in_parallel`], for some items at a time.
pub(crate) fn in_parallel_chunks<I: Sync, T: Send>(
    items: &[I],
    account: &mut Account,
    make: impl Fn(&[I], &mut Vec<T>, &mut Account) + Sync,
) -> Vec<T> {
    let chunks = items.par_chunks(CHUNK).map(|items| {
        let (mut made, mut account) = (Vec::with_capacity(items.len()), Account::default());
        make(items, &mut made, &mut account);
        (made, account)
    });
    let mut all = Vec::with_capacity(items.len());
    for (made, part) in chunks.collect::<Vec<_>>() {
        all.extend(made);
        account.add(&part);
    }
    all
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

/// Works on each item, on all threads of the pool.
pub(crate) fn each_in_parallel<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    items.par_iter_mut().for_each(work);
}

/// Makes something of each tile, on all threads of the pool, and puts it all into `gathered`, one after the other, until
/// `progress` stops it.
pub(crate) fn in_tiles<G: Send, T: Send>(
    tiles: Vec<Region>,
    progress: &dyn Progress,
    gathered: &mut G,
    make: impl Fn(Region) -> T + Sync,
    put: impl Fn(&mut G, T) + Sync,
) {
    let gathered = Mutex::new(gathered);
    tiles.into_par_iter().for_each(|tile| {
        if !progress.stop() {
            let made = make(tile);
            put(&mut gathered.lock().unwrap_or_else(PoisonError::into_inner), made);
        }
    });
}

fn render_tile<A: Antialias>(scene: &CompiledScene, region: Region, antialias: &A) -> Tile {
    let mut tile = Tile::new(region);
    let integrator = Sharp::of(scene);
    let mut first_hits = FirstHits::default();
    for part in FirstHits::parts(scene, region) {
        first_hits.find(scene, antialias, part);
        for y in part.y..part.y + part.height {
            let (row, row_of_part) = ((y - region.y) * region.width, (y - part.y) * part.width);
            // By `extend`, which asks only once whether there is room.
            tile.pixels.extend((0..part.width).map(|column| {
                let known = first_hits.of_pixel((row_of_part + column) as usize);
                let (x, account) = (part.x + column, &mut tile.account);
                let pixel = render_pixel(scene, (&integrator, antialias), (x, y), known, account);
                if pixel.depth > 0 {
                    tile.depths.resize(region.pixels() as usize, 0);
                    tile.depths[(row + column) as usize] = pixel.depth;
                }
                if pixel.has_bad_samples { without_bad_samples(scene, antialias, (x, y)) } else { pixel.color }
            }));
        }
    }
    tile
}

/// A pixel of its good samples.
fn without_bad_samples<A: Antialias>(scene: &CompiledScene, antialias: &A, (x, y): (u32, u32)) -> Rgb {
    let mut splats = pixel_alone(scene, antialias, x, y);
    normalize(&mut splats);
    color_of(&splats)
}

/// The samples of a pixel that stands alone.
pub(crate) fn pixel_alone<A: Antialias>(scene: &CompiledScene, antialias: &A, x: u32, y: u32) -> Vec<Splat> {
    crate::antialias::alone::list(&SceneEye::new(scene), antialias, (x, y), &mut Account::default()).0
}
