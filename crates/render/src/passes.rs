//! Integrators that take samples: passes over the picture, each with some more samples of every pixel, so that all of it can
//! be looked at from the beginning; and when it is enough.
//!
//! Which samples are taken depends on nothing but the sums of those that are there. Only a limit of time depends on the
//! machine: it ends after some pass, and the film then says how many samples that was.

mod again;
mod around;
mod direct;
mod noise;

pub(crate) use again::same_samples_again;

use crate::compile::CompiledScene;
use crate::film::{Film, PixelSums, Region, SampleRange, SampledTile, TILE};
use crate::filter_sampling::FilterSampling;
use crate::holes::Known;
use crate::integrators::{Integrator, Together};
use crate::observer::{Observer, RayCounts};
use crate::sampler::{Purpose, Sampler};
use crate::schedule::{Progress, in_tiles};
use around::Around;
use arrayvec::ArrayVec;
use direct::Direct;
use durer_geometry::{LANES, Packet, Ray};
use durer_math::{DVec2, Rgb};
use noise::{Cells, Noise};

pub(crate) use noise::{CELL, PASSES};

/// When it is enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Goal {
    /// The samples of a pixel, at most.
    pub(crate) samples: SampleRange,
    /// The noise that is let pass: `None` takes all samples of all pixels.
    pub(crate) noise: Option<f32>,
    /// Seconds.
    pub(crate) time: Option<f64>,
}

/// Takes samples until it is enough, or `progress` stops it. The film is one of samples.
pub(crate) fn render_samples<I: Integrator>(
    (scene, integrator): (&CompiledScene, &I),
    goal: Goal,
    film: &mut Film,
    progress: &dyn Progress,
) {
    let filter = FilterSampling::new(scene.settings.filter);
    let direct = film.sums().is_some_and(|sums| !sums.direct.is_empty());
    let sampling = Sampling { scene, integrator, filter, first: goal.samples.start, direct };
    let noise = goal.noise.map(|target| Noise::new(scene, target));
    let mut around = match noise {
        Some(_) => Around::new(film, scene.picture_size()),
        None => Around::nothing(),
    };
    let mut clock = Clock { limit: goal.time, begun: None };
    while !film.is_complete() {
        if let Some(noise) = noise {
            noise.look_at(film);
            // All that lies beside a film is taken once more when the film is gone on with: not if the time is over.
            if !clock.is_over(progress.elapsed(), film) {
                around.follow(film, (noise, goal.samples.count()), &sampling, progress);
            }
            if progress.stop() {
                return;
            }
        }
        let in_time = clock.most_samples(progress.elapsed(), film);
        let pass = match noise {
            Some(noise) => {
                next_where_noise_is(film, goal, in_time, |film| Cells::new(noise, film, &around, scene.picture_size()))
            }
            None => next_of_all(film, goal, in_time),
        };
        let Some(pass) = pass else {
            match noise {
                Some(_) => film.finish(),
                None => film.finish_samples(),
            }
            progress.finished(film.done(), film.done());
            progress.advanced(film);
            return;
        };
        let tiles = film.region().cells(TILE).filter(|&tile| pass.wants(tile)).collect();
        let render = |tile| sampling.tile(tile, &pass);
        in_tiles(tiles, progress, film, render, |film, tile| {
            film.add(&tile);
            progress.finished(film.done(), pass.expected.max(film.done()));
            progress.advanced(film);
        });
        if progress.stop() {
            return;
        }
    }
}

/// How many samples of each pixel there are to be when a pass is over.
struct Pass {
    region: Region,
    /// How many there are, row by row ...
    from: Vec<u32>,
    /// ... and are to be.
    to: Vec<u32>,
    /// Samples that the whole picture will have in the end, as far as can be told.
    expected: u64,
}

impl Pass {
    /// True if some pixel of a tile wants samples.
    fn wants(&self, tile: Region) -> bool {
        tile.pixel_places().any(|(x, y)| {
            let pixel = self.region.index_of(x, y);
            self.from[pixel] < self.to[pixel]
        })
    }
}

/// The pass after those that the film has seen, of all pixels, if no more samples are to be taken than there is time for;
/// `None` if it is enough.
fn next_of_all(film: &Film, goal: Goal, in_time: u64) -> Option<Pass> {
    let (region, from) = (film.region(), film.sums()?.taken.clone());
    let most = goal.samples.count();
    let least = from.iter().copied().min()?;
    // A pass that was cut short is finished first, so that all pixels have as many samples.
    let was_cut_short = from.iter().any(|&taken| taken != least);
    let more = u32::try_from(in_time / region.pixels().max(1)).unwrap_or(u32::MAX);
    let most_in_time = least.saturating_add(more);
    let next = after(least).min(most);
    let next = if was_cut_short { next } else { next.min(most_in_time) };
    let expected = region.pixels() * u64::from(most.min(most_in_time).max(next));
    let wants_any = from.iter().any(|&taken| taken < next);
    wants_any.then(|| Pass { region, to: vec![next; from.len()], from, expected })
}

/// The same, of the pixels that have noise still.
fn next_where_noise_is<'a>(
    film: &'a Film,
    goal: Goal,
    in_time: u64,
    cells: impl FnOnce(&'a Film) -> Option<Cells<'a>>,
) -> Option<Pass> {
    let (to, expected) = cells(film)?.goals(goal.samples.count(), in_time)?;
    Some(Pass { region: film.region(), from: film.sums()?.taken.clone(), to, expected })
}

/// How many samples a pixel has after the pass that begins with so many: twice as many at first, then 32 more, and in long
/// renders a fourth more, for looking at the whole takes time, too.
fn after(samples: u32) -> u32 {
    let more = match samples {
        0 => 1,
        1..32 => samples,
        _ => (samples / 4 / 32 * 32).max(32),
    };
    samples.saturating_add(more)
}

/// How fast it goes.
struct Clock {
    limit: Option<f64>,
    /// The time when the first pass of this run began, and the samples that the film had then.
    begun: Option<(f64, u64)>,
}

impl Clock {
    /// True if no more samples are to be begun. One sample of each pixel is the least that a picture has.
    fn is_over(&self, now: Option<f64>, film: &Film) -> bool {
        let is_late = self.limit.zip(now).is_some_and(|(limit, now)| now >= limit);
        is_late && film.sums().is_none_or(|sums| sums.least_and_most().0 > 0)
    }

    /// How many samples there is time for after those that the film has.
    fn most_samples(&mut self, now: Option<f64>, film: &Film) -> u64 {
        let (Some(limit), Some(now)) = (self.limit, now) else { return u64::MAX };
        let (then, before) = *self.begun.get_or_insert((now, film.done()));
        if self.is_over(Some(now), film) {
            return 0;
        }
        match film.done().saturating_sub(before) {
            // Late, but without a picture.
            _ if now >= limit => film.region().pixels(),
            // Nothing is known of the speed: one sample of each pixel.
            0 => film.region().pixels(),
            gained => {
                let more = (limit - now) / (now - then).max(1e-9) * gained as f64;
                more.min(u64::MAX as f64) as u64
            }
        }
    }
}

/// The most pixels that are looked at together.
const MOST_TOGETHER: usize = 64;

/// How samples are taken.
struct Sampling<'a, I> {
    scene: &'a CompiledScene,
    integrator: &'a I,
    filter: FilterSampling,
    /// The number of a pixel's first sample.
    first: u32,
    /// Direct light is known apart.
    direct: bool,
}

/// The edge of the blocks of pixels that an integrator looks at together.
pub(crate) fn edge_of_blocks<I: Integrator>(integrator: &I) -> u32 {
    integrator.together().isqrt()
}

/// The block with this edge of which a pixel is one. It is one of the picture, whatever part of that is rendered, so that pixels
/// do not depend on it.
pub(crate) fn block_of((x, y): (u32, u32), edge: u32, (width, height): (u32, u32)) -> Region {
    let (x, y) = (x / edge * edge, y / edge * edge);
    Region { x, y, width: edge.min(width - x), height: edge.min(height - y) }
}

/// A sample before it is traced.
pub(crate) struct Begun {
    pub(crate) sampler: Sampler,
    pub(crate) at: DVec2,
    pub(crate) is_negative: bool,
    pub(crate) ray: Ray,
}

impl<I: Integrator> Sampling<'_, I> {
    fn tile(&self, region: Region, pass: &Pass) -> SampledTile {
        let pixels = vec![PixelSums::default(); region.pixels() as usize];
        let mut tile = SampledTile { region, pixels, account: Default::default() };
        match self.integrator.together() {
            0 | 1 => self.one_by_one(&mut tile, pass),
            _ => self.in_blocks(&mut tile, pass, edge_of_blocks(self.integrator)),
        }
        tile
    }

    /// Some samples of one pixel at a time: their first rays go nearly the same way.
    fn one_by_one(&self, tile: &mut SampledTile, pass: &Pass) {
        for pixel in tile.region.pixel_places() {
            let at = pass.region.index_of(pixel.0, pixel.1);
            let mut numbers = pass.from[at]..pass.to[at];
            while !numbers.is_empty() {
                let some: ArrayVec<_, LANES> = numbers.by_ref().take(LANES).map(|number| (pixel, number)).collect();
                self.take::<LANES>(&some, |_| true, tile);
            }
        }
    }

    /// The samples of the same number of a block of pixels at a time, of this edge. Those of pixels that want no more, or are
    /// outside of what is rendered, are taken for the others.
    fn in_blocks(&self, tile: &mut SampledTile, pass: &Pass, edge: u32) {
        let wants = |(x, y): (u32, u32), number: u32| {
            let at = pass.region.index_of(x, y);
            (pass.from[at]..pass.to[at]).contains(&number)
        };
        let region = tile.region;
        for part in region.cells(edge) {
            let block = block_of((part.x, part.y), edge, self.scene.picture_size());
            let ats = || part.pixel_places().map(|(x, y)| pass.region.index_of(x, y));
            let first = ats().map(|at| pass.from[at]).min().unwrap_or(0);
            let end = ats().map(|at| pass.to[at]).max().unwrap_or(0);
            for number in first..end {
                if part.pixel_places().any(|pixel| wants(pixel, number)) {
                    let samples: ArrayVec<_, MOST_TOGETHER> =
                        block.pixel_places().map(|pixel| (pixel, number)).collect();
                    self.take::<MOST_TOGETHER>(&samples, |pixel| region.contains(pixel) && wants(pixel, number), tile);
                }
            }
        }
    }

    /// Takes samples together, of these pixels and with these numbers, and adds those that are wanted.
    fn take<const N: usize>(
        &self,
        samples: &[((u32, u32), u32)],
        is_wanted: impl Fn((u32, u32)) -> bool,
        tile: &mut SampledTile,
    ) {
        if self.direct {
            self.take_with::<_, N>(samples, is_wanted, tile, Direct::default, |direct| (direct.rays, direct.light));
        } else {
            self.take_with::<_, N>(samples, is_wanted, tile, RayCounts::default, |rays| (*rays, Rgb::BLACK));
        }
    }

    fn take_with<O: Observer, const N: usize>(
        &self,
        samples: &[((u32, u32), u32)],
        is_wanted: impl Fn((u32, u32)) -> bool,
        tile: &mut SampledTile,
        observer: impl Fn() -> O,
        seen: impl Fn(&O) -> (RayCounts, Rgb),
    ) {
        let begun: ArrayVec<Begun, N> = samples.iter().map(|&(pixel, number)| self.begin(pixel, number)).collect();
        let mut together: ArrayVec<Together<'_, O>, N> = ArrayVec::new();
        for begun in begun.chunks(LANES) {
            let hits = match (&self.scene.eye_vantage, begun) {
                (Some(_), _) | (None, [_]) => None,
                (None, _) => {
                    let rays: ArrayVec<Ray, LANES> = begun.iter().map(|begun| begun.ray).collect();
                    Some(self.scene.world.closest_hits(&Packet::new(&rays), f64::INFINITY, u32::MAX))
                }
            };
            together.extend(begun.iter().enumerate().map(|(lane, &Begun { ray, sampler, .. })| {
                let known = match (hits, &self.scene.eye_vantage) {
                    (Some(hits), _) => Known::Hit(hits[lane]),
                    (None, Some(vantage)) => Known::Vantage(vantage),
                    (None, None) => Known::Nothing,
                };
                Together { ray, known, sampler, observer: observer(), light: Rgb::BLACK }
            }));
        }
        self.integrator.radiances(self.scene, &mut together.iter_mut().collect::<ArrayVec<_, N>>());
        for ((taken, begun), &(pixel, _)) in together.iter().zip(&begun).zip(samples) {
            let (rays, direct) = seen(&taken.observer);
            tile.account.rays.add(&rays);
            if is_wanted(pixel) {
                let at = tile.region.index_of(pixel.0, pixel.1);
                if tile.pixels[at].add(taken.light, direct, begun.is_negative).is_err() {
                    tile.account.bad_sample(begun.at);
                }
            }
        }
    }

    fn begin(&self, pixel: (u32, u32), number: u32) -> Begun {
        Begun::new(self.scene, &self.filter, pixel, self.first + number)
    }
}

impl Begun {
    /// The sample of a pixel with this number.
    pub(crate) fn new(scene: &CompiledScene, filter: &FilterSampling, pixel: (u32, u32), number: u32) -> Begun {
        let sampler = Sampler::new(scene.settings.seed, pixel, number);
        let (at, is_negative) = filter.place(pixel, sampler.two(0, Purpose::Pixel));
        let ray = match scene.camera.has_lens() {
            true => scene.camera.ray_through_lens(at, sampler.two(0, Purpose::Lens)),
            false => scene.camera.ray(at),
        };
        Begun { sampler, at, is_negative, ray }
    }
}

#[cfg(test)]
mod tests;
