//! One render, from the scene to the picture: a new one, or one that goes on with a checkpoint.

use super::differences::{differences, differences_of_samples};
use super::layers::most_bytes;
use super::manner::StatsFormat;
use super::report::{Report, Seconds};
use super::saver::{Saver, When};
use super::{Arguments, Manner};
use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::numbers::short;
use crate::progress::{Bar, Phase, Reached, Show};
use crate::{output, provenance, target};
use durer::imaging::{EncodeOptions, Layers};
use durer::{
    CheckedScene, Checkpoint, Film, FilmLayer, Loaded, Origin, PictureFile, Progress, Region, RenderError,
    RenderOptions, SeenFirst, Sources, WriteError, film_layers, read_checkpoint, seen_first, temporary_beside,
};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// What is to be done.
pub(crate) struct Job<'a> {
    /// What was asked for when the render was begun.
    pub(crate) arguments: &'a Arguments,
    /// How it is carried out now.
    pub(crate) manner: &'a Manner,
    /// What the checkpoints are to say of how it was begun; `None` if that cannot be said in UTF-8.
    pub(crate) origin: Option<Origin>,
    /// Why it is carried out, for messages.
    pub(crate) purpose: Purpose<'a>,
}

/// What a render is for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose<'a> {
    /// To render, or to go on with what was begun.
    Render,
    /// To make a picture of what is known, after this film was named first.
    Merge(&'a Path),
}

/// What there is besides the film when all rays are traced.
struct Outcome<'a> {
    file: PictureFile,
    what: What<'a>,
    saver: Option<&'a Saver<'a>>,
    show: Show,
}

/// What tracing gives.
struct Traced {
    film: Film,
    /// What is seen first, if that is wanted.
    seen: Option<SeenFirst>,
    /// How much of each pixel is there, if that is wanted.
    alpha: Option<Vec<f32>>,
    /// For building and for tracing.
    seconds: [f64; 2],
}

/// What is written.
enum What<'a> {
    /// A picture, alone or with layers; and how much of each pixel is there, if not all.
    Picture(EncodeOptions, Option<Layers>, Option<Vec<f32>>),
    /// The film itself, as checkpoints are.
    Film(&'a Saver<'a>),
}

impl Job<'_> {
    /// Renders, from the beginning or from a checkpoint on.
    pub(crate) fn run(&self, resumed: Option<Checkpoint>) -> Result<Exit, Failure> {
        let (arguments, show) = (self.arguments, self.manner.show());
        let interrupt = Interrupt::after(arguments.scene.time_limit());
        let path = arguments.output_path();
        if arguments.saving.checkpoint.as_ref().is_some_and(|checkpoint| target::same_place(checkpoint, &path)) {
            return Err(Failure::usage("--checkpoint: the checkpoint cannot be the same file as the picture"));
        }
        let format = target::format_or_film(&path)?;
        let mut options = match format {
            Some(format) => arguments.file.encode_options(format)?,
            None if arguments.layers.alpha => return Err(Failure::usage("--alpha: films have none; pictures have")),
            None => arguments.file.of_no_picture().map(|()| EncodeOptions::default())?,
        };
        let (loaded, load) = timed(|| arguments.overrides.load(&arguments.scene, show));
        let loaded = loaded?;
        options.metadata = provenance::of_render(loaded.fingerprint(), loaded.scene.scene(), arguments.crop);
        let Loaded { scene, sources, .. } = loaded;
        let (integrator, exr) = (&scene.scene().render.integrator, durer::imaging::FileFormat::Exr);
        let layers = match format {
            Some(format) => arguments.layers.of_file(format, integrator)?,
            // What a film knows beside the colors goes into the pictures that are made of it.
            None => arguments.layers.of_file(exr, integrator)?.map(|mut layers| {
                layers.retain(|layer| layer.is_of_paths());
                layers
            }),
        };
        if !scene.scene().render.integrator.takes_samples() && (format.is_none() || arguments.sample_range.is_some()) {
            let integrator = scene.scene().render.integrator.word();
            return Err(Failure::usage(format!(
                "`{integrator}` takes no samples, of which there could be parts or a film; `path` does"
            )));
        }
        if arguments.sample_range.is_some() && scene.scene().render.noise.is_some() {
            output::warning("--sample-range takes all of its samples: `noise` is not followed");
        }
        let picture = scene.scene().picture;
        (options.transfer, options.exposure, options.tone_mapping) =
            (picture.transfer, picture.exposure, picture.tone_mapping);
        let region = self.region(&scene)?;
        arguments.scene.admit(&scene)?;
        let saver = self.saver(&scene, &sources)?;
        let is_new = resumed.is_none();
        let before = resumed.as_ref().map_or(0.0, |checkpoint| checkpoint.seconds);
        let film = match (resumed, &saver) {
            (Some(checkpoint), Some(saver)) => Some(fitting(checkpoint, saver, region, self.purpose)?),
            (None, Some(saver)) => self.look_for_checkpoint(saver, region).map(|()| None)?,
            (_, None) => None,
        };
        interrupt.watch();
        let wanted = layers.as_deref().unwrap_or_default();
        let direct = wanted.iter().any(|layer| layer.is_of_paths());
        let most_bytes_of_checkpoint = checkpoint_bytes_a_pixel(&scene, direct) * region.pixels();
        let mut file = PictureFile::create(&path)?;
        interrupt.removes(file.temporary());
        file.reserve(match format {
            Some(_) => most_bytes(&options, (layers.as_deref(), arguments.layers.alpha), (region.width, region.height)),
            None => most_bytes_of_checkpoint,
        })?;
        if let Some(saver) = &saver {
            interrupt.removes(&temporary_beside(saver.path()));
            if is_new && saving_from_the_start(arguments) {
                // Only a try: what it takes is free again at once.
                PictureFile::create(saver.path())?.reserve(most_bytes_of_checkpoint)?;
            }
        }
        let rays_before = film.as_ref().map_or(0, |film| film.rays().total());
        let Traced { mut film, seen, alpha, seconds: [build, render] } =
            self.trace(&scene, (film.map(|film| (film, before)), region, wanted), &interrupt, saver.as_ref(), show)?;
        let report =
            Report::new(arguments.scene.path.clone(), path, format, &film, picture.exposure).after(rays_before);
        let report = report.with_seconds(Seconds { load, build, render, write: 0.0 }).stopped_by(interrupt.reason());
        let layers = layers.filter(|_| format.is_some());
        let layers =
            layers.map(|layers| film_layers((&film, alpha.as_deref()), seen.as_ref(), &layers, options.exr_samples));
        let what = match (format, &saver) {
            (Some(_), _) => What::Picture(options, layers, alpha),
            (None, Some(saver)) => What::Film(saver),
            (None, None) => return Err(Failure::usage("films need names of files that are UTF-8")),
        };
        self.finish(&mut film, Outcome { file, what, saver: saver.as_ref(), show }, report)
    }

    /// The part that is rendered, if it lies within the picture.
    fn region(&self, scene: &CheckedScene) -> Result<Region, Failure> {
        let (width, height) = (scene.scene().picture.width, scene.scene().picture.height);
        let ends = |start: u32, length: u32| u64::from(start) + u64::from(length);
        match self.arguments.crop {
            None => Ok(Region { x: 0, y: 0, width, height }),
            Some(r) if ends(r.x, r.width) <= u64::from(width) && ends(r.y, r.height) <= u64::from(height) => Ok(r),
            Some(region) => Err(RenderError::RegionOutside { region, picture: (width, height) }.into()),
        }
    }

    /// Who writes checkpoints. `None` if there can be none.
    fn saver<'s>(&self, scene: &'s CheckedScene, sources: &'s Sources) -> Result<Option<Saver<'s>>, Failure> {
        let saving = &self.arguments.saving;
        match (&self.origin, &saving.checkpoint) {
            (Some(origin), _) => {
                let path = self.arguments.checkpoint_path();
                Ok(Some(Saver::new(path, origin.clone(), (scene, sources), saving.times())))
            }
            (None, Some(_)) => Err(Failure::usage("--checkpoint: checkpoints need names of files that are UTF-8")),
            (None, None) => Ok(None),
        }
    }

    /// Looks at what lies where the checkpoint of a new render is to be.
    fn look_for_checkpoint(&self, saver: &Saver<'_>, region: Region) -> Result<(), Failure> {
        let path = saver.path();
        let (when, _) = self.arguments.saving.times();
        if when == When::Never || !path.exists() {
            return Ok(());
        }
        match read_checkpoint(path) {
            Ok(old) if old.film.region() == region && old.scene == *saver.hash() => {
                saver.found(&old.film);
                if !self.manner.quiet {
                    let share = 100.0 * share_done(&old.film);
                    let (path, share) = (path.display(), short(share.floor()));
                    output::note(&format!(
                        "note: {path} has {share} % of this picture; this begins anew, `durer resume {path}` goes on"
                    ));
                }
                Ok(())
            }
            // What somebody else keeps under a name that was given is not written over.
            Ok(_) if when == When::Always => {
                let why = "it is a checkpoint of another render; remove it, or give another name";
                Err(Failure::file(format!("{} is not written over: {why}", path.display())))
            }
            Err(error) if when == When::Always => {
                Err(Failure::file(format!("{} is not written over: {error}", path.display())))
            }
            Ok(_) | Err(_) => Ok(()),
        }
    }

    /// The film, what is seen first if layers want it, and the seconds for building and for tracing.
    fn trace(
        &self,
        scene: &CheckedScene,
        (begun, region, layers): (Option<(Film, f64)>, Region, &[FilmLayer]),
        interrupt: &Interrupt,
        saver: Option<&Saver<'_>>,
        show: Show,
    ) -> Result<Traced, Failure> {
        durer::with_threads(self.manner.threads.map(usize::from), || {
            let simd = self.arguments.simd.unwrap_or_default();
            let (compiled, build) = timed(|| self.arguments.scene.compile_for(scene, simd, show));
            let mut compiled = compiled?;
            if self.arguments.layers.alpha {
                compiled.leave_out_background();
            }
            let (film, before) = begun.map_or((None, 0.0), |(film, before)| (Some(film), before));
            let already = film.as_ref().map_or(0, Film::done);
            let bar = Bar::new(interrupt.stop_flag(), already, show);
            let watch = Watch { bar, saver, before, total: AtomicU64::new(region.pixels()) };
            if let Some(saver) = saver {
                saver.begins(before);
            }
            let options = RenderOptions {
                threads: None,
                region: Some(region),
                samples: self.arguments.sample_range,
                direct: layers.iter().any(|layer| layer.is_of_paths()),
            };
            let (film, render) = timed(|| match film {
                Some(film) => durer::render_on(&compiled, film, &options, &watch),
                None => durer::render(&compiled, &options, &watch),
            });
            watch.bar.finish();
            if let Some(saver) = saver {
                saver.settle();
            }
            let film = film?;
            let wants_seen = layers.iter().any(|layer| layer.is_seen_first());
            let options = RenderOptions { region: Some(film.region()), ..RenderOptions::default() };
            let find_seen = || seen_first(&compiled, &options, &Stop(interrupt.stop_flag()));
            let seen = wants_seen.then(find_seen).transpose()?;
            let alpha = match self.arguments.layers.alpha {
                // Quick, and without it what there is of a picture could not be seen: so nothing stops it.
                true => durer::coverage(compiled, &film, &options, &())?,
                false => None,
            };
            if self.arguments.layers.alpha && alpha.is_none() {
                return Err(Failure::usage("--alpha: it cannot be told which samples the film is of"));
            }
            Ok(Traced { film, seen, alpha, seconds: [build, render] })
        })?
    }

    /// Writes what there is, and says so.
    fn finish(&self, film: &mut Film, outcome: Outcome<'_>, mut report: Report) -> Result<Exit, Failure> {
        let Outcome { file, what, saver, show } = outcome;
        let (finished, total) = (film.done(), (film.done() as f64 / share_done(film).max(1e-9)).round() as u64);
        let reached = |remaining| Some(Reached { finished, total, remaining });
        let (complete, interrupted) = (reached(Some(0.0)), reached(None));
        if film.done() == 0 {
            show.tell("interrupted", interrupted);
            report.tell_nothing();
            return Err(Failure::Told(Exit::Interrupted));
        }
        let file = match report.is_complete() {
            true => file,
            false => file.with_name(&report.name_of_part()),
        };
        let (bytes, write) = timed(|| {
            let _phase = Phase::begin("writing", &self.arguments.output_path().to_string_lossy(), show);
            write(file, film, what)
        });
        let kept = match (saver, bytes.is_ok() && report.is_complete()) {
            (Some(saver), false) => self.keep(saver, film, bytes.is_err()),
            (_, true) | (None, false) => None,
        };
        let bytes = bytes.map_err(|error| match &kept {
            Some(path) => Failure::file(format!("{error}\n       {}", how_to_go_on(path))),
            None => Failure::from(error),
        })?;
        report.written(bytes, write);
        report.tell_bad_samples();
        match self.manner.stats {
            Some(StatsFormat::Json) => report.print_json()?,
            None if !self.manner.quiet => report.tell(),
            None => {}
        }
        if report.is_complete() {
            if let Some(saver) = saver {
                saver.remove();
            }
            show.tell("done", complete);
            return Ok(Exit::Fine);
        }
        show.tell("interrupted", interrupted);
        if let Some(path) = kept {
            output::note(&how_to_go_on(&path));
        }
        report.tell_interrupted();
        Err(Failure::Told(Exit::Interrupted))
    }

    /// Writes a last checkpoint, if this render has any or cannot keep its film in another way; gives its path.
    fn keep(&self, saver: &Saver<'_>, film: &Film, picture_failed: bool) -> Option<PathBuf> {
        let never = self.arguments.saving.times().0 == When::Never;
        if never || !(saver.is_active() || picture_failed) {
            return None;
        }
        match saver.save(film) {
            Ok(()) => Some(saver.path().to_owned()),
            Err(error) => {
                output::warning(&format!("cannot write the checkpoint {}: {error}", saver.path().display()));
                // An older one may be there still, with less on it.
                read_checkpoint(saver.path()).is_ok().then(|| saver.path().to_owned())
            }
        }
    }
}

/// Writes the film, or what is made of it; gives the number of bytes.
fn write(file: PictureFile, film: &mut Film, what: What<'_>) -> Result<usize, WriteError> {
    match what {
        What::Picture(mut options, layers, alpha) => {
            options.metadata.extend(film.sums().map(provenance::of_samples));
            match (layers, alpha) {
                (Some(layers), _) => file.write_layers(layers, &options),
                (None, Some(alpha)) => film.with_picture(|image| file.write_with_alpha(image, &alpha, &options)),
                (None, None) => film.with_picture(|image| file.write(image, &options)),
            }
        }
        What::Film(saver) => file.write_bytes(&saver.bytes(film)),
    }
}

/// Stops when the flag is set.
struct Stop<'a>(&'a AtomicBool);

impl Progress for Stop<'_> {
    fn stop(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Shows progress, and has checkpoints written.
struct Watch<'a> {
    bar: Bar<'a>,
    saver: Option<&'a Saver<'a>>,
    /// Seconds that earlier runs took.
    before: f64,
    /// How much there is to do, as last heard.
    total: AtomicU64,
}

impl Progress for Watch<'_> {
    fn finished(&self, done: u64, of: u64) {
        self.total.store(of, Ordering::Relaxed);
        self.bar.finished(done, of);
    }

    fn advanced(&self, film: &Film) {
        if let Some(saver) = self.saver {
            let (elapsed, remaining) = self.bar.times(self.total.load(Ordering::Relaxed));
            saver.advanced(film, remaining.map(|remaining| elapsed + remaining));
        }
    }

    fn stop(&self) -> bool {
        self.bar.stop()
    }

    fn elapsed(&self) -> Option<f64> {
        self.bar.elapsed().map(|seconds| self.before + seconds)
    }
}

/// How much of a film is done, from 0 to 1; of one that takes samples where there is noise, at least.
fn share_done(film: &Film) -> f64 {
    match film.sums() {
        _ if film.is_complete() => 1.0,
        Some(sums) => {
            let wanted: u64 =
                sums.parts.iter().map(|part| part.region.pixels() * u64::from(part.samples.count())).sum();
            sums.samples() as f64 / wanted as f64
        }
        None => film.finished_pixels() as f64 / film.region().pixels() as f64,
    }
}

/// The film of a checkpoint, if it is one of this scene.
fn fitting(checkpoint: Checkpoint, saver: &Saver<'_>, region: Region, purpose: Purpose<'_>) -> Result<Film, Failure> {
    let cannot = match purpose {
        Purpose::Render => format!("cannot go on with {}", saver.path().display()),
        Purpose::Merge(film) => format!("cannot make a picture of {}", film.display()),
    };
    let changed = match purpose {
        Purpose::Render => differences(&checkpoint.scene, saver.hash()),
        Purpose::Merge(_) => differences_of_samples(&checkpoint.scene, saver.hash()),
    };
    if !changed.is_empty() {
        return Err(Failure::Message(Exit::Scene, format!("{cannot}: since it was made, {changed} changed")));
    }
    if checkpoint.film.region() != region {
        return Err(Failure::file(format!("{cannot}: it is not of the part that it says")));
    }
    if !saver.is_off() {
        saver.found(&checkpoint.film);
    }
    Ok(checkpoint.film)
}

/// Of a pixel in a checkpoint, the most; light that met one surface at most may be known apart.
fn checkpoint_bytes_a_pixel(scene: &CheckedScene, direct: bool) -> u64 {
    match (scene.scene().render.integrator.takes_samples(), direct) {
        (false, _) => 14,
        (true, false) => 77,
        (true, true) => 125,
    }
}

fn saving_from_the_start(arguments: &Arguments) -> bool {
    arguments.saving.times().0 == When::Always
}

fn how_to_go_on(path: &Path) -> String {
    format!("what is finished is kept; go on with: durer resume {}", path.display())
}

/// The value of `work`, and the seconds that it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let value = work();
    (value, start.elapsed().as_secs_f64())
}
