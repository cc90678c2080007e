//! `durer render`: from a scene file to a picture file.

mod report;

use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::load::SceneArgs;
use crate::overrides::Overrides;
use crate::progress::{Bar, Show};
use crate::provenance;
use crate::target::{self, FileOptions};
use clap::{Args, ValueEnum};
use durer::imaging::EncodeOptions;
use durer::math::Fingerprint;
use durer::{CheckedScene, Film, PictureFile, Region, RenderError, RenderOptions, SimdLevel};
use report::{Report, Seconds};
use std::path::PathBuf;
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  durer render room.yaml                                  writes room.png
  durer render room.yaml -o room.exr --bit-depth float
  durer render bunny.ply                                  a model
  durer render room.yaml --width 1920 --antialias grid:4
  durer render room.yaml --crop 100,80,64,64 -o detail.png
  durer render room.yaml --antialias recursive:0.1,3 --stats json > room.json

The format follows the extension: png, jpg, exr, hdr or pfm. The picture is the same
whatever the number of threads. Ctrl-C stops after the tiles being worked on and saves
what is finished beside the picture, as room.partial.png for room.png, which stays as it
was; the second Ctrl-C quits at once.";

/// Render a scene to a picture file
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// The picture file [default: the scene's name with .png, in this folder]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Render only this part: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop, allow_hyphen_values = true)]
    crop: Option<Region>,

    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Instruction set for building and searching, such as sse2, avx2 or neon; it changes no pixel [default: the best
    /// that the machine has]
    #[arg(long, value_name = "LEVEL", value_parser = simd)]
    simd: Option<SimdLevel>,

    /// Print statistics to standard output, in place of the line at the end
    #[arg(long, value_name = "FORMAT")]
    stats: Option<StatsFormat>,

    /// Show neither progress nor the line at the end, only warnings and errors
    #[arg(short, long)]
    quiet: bool,

    #[command(flatten)]
    overrides: Overrides,

    #[command(flatten)]
    file: FileOptions,
}

/// How statistics are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StatsFormat {
    /// As a JSON object
    Json,
}

/// Renders the scene.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::after(arguments.scene.time_limit());
    let path = arguments.output_path();
    let format = target::format_of(&path)?;
    let mut options = arguments.file.encode_options(format)?;
    let (loaded, load) = timed(|| arguments.load());
    let (scene, fingerprint) = loaded?;
    options.metadata = provenance::of_render(fingerprint, scene.scene(), arguments.crop);
    options.transfer = scene.scene().picture.transfer;
    arguments.check_crop(&scene)?;
    arguments.scene.admit(&scene)?;
    interrupt.watch();
    let file = PictureFile::create(&path)?;
    interrupt.removes(file.temporary());
    let (film, build, render) = arguments.trace(&scene, &interrupt)?;
    let report = Report::new(arguments.scene.path.clone(), path, format, &film);
    let seconds = Seconds { load, build, render, write: 0.0 };
    finish(arguments, film, file, &options, report.with_seconds(seconds).stopped_by(interrupt.reason()))
}

/// Writes what there is, and says so.
fn finish(
    arguments: &Arguments,
    film: Film,
    file: PictureFile,
    options: &EncodeOptions,
    mut report: Report,
) -> Result<Exit, Failure> {
    if film.finished_pixels() == 0 {
        report.tell_nothing();
        return Err(Failure::Told(Exit::Interrupted));
    }
    let file = match report.is_complete() {
        true => file,
        false => file.with_name(&report.name_of_part()),
    };
    let (bytes, write) = timed(|| file.write(&film.develop(), options));
    report.written(bytes?, write);
    report.tell_bad_samples();
    match arguments.stats {
        Some(StatsFormat::Json) => report.print_json()?,
        None if !arguments.quiet => report.tell(),
        None => {}
    }
    if report.is_complete() {
        return Ok(Exit::Fine);
    }
    report.tell_interrupted();
    Err(Failure::Told(Exit::Interrupted))
}

impl Arguments {
    fn output_path(&self) -> PathBuf {
        match &self.output {
            Some(path) => path.clone(),
            None => PathBuf::from(self.scene.name()).with_extension("png"),
        }
    }

    /// The scene with the settings of the command line, and the fingerprint of what was loaded.
    fn load(&self) -> Result<(CheckedScene, Fingerprint), Failure> {
        let (scene, sources) = self.scene.load_with_sources(self.show())?;
        let fingerprint = durer::scene_fingerprint(scene.scene(), &sources);
        Ok((self.overrides.apply(scene)?, fingerprint))
    }

    /// Finds out whether the part lies within the picture, before there is any file.
    fn check_crop(&self, scene: &CheckedScene) -> Result<(), Failure> {
        let picture = scene.scene().picture;
        match self.crop {
            Some(region) if !within(region, picture.width, picture.height) => {
                Err(RenderError::RegionOutside { region, picture: (picture.width, picture.height) }.into())
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The film, and the seconds for building and for tracing.
    fn trace(&self, scene: &CheckedScene, interrupt: &Interrupt) -> Result<(Film, f64, f64), Failure> {
        durer::with_threads(self.threads.map(usize::from), || {
            let (compiled, build) = timed(|| self.scene.compile_for(scene, self.simd.unwrap_or_default(), self.show()));
            let compiled = compiled?;
            let bar = Bar::new(interrupt.stop_flag(), self.show());
            let options = RenderOptions { threads: None, region: self.crop };
            let (film, render) = timed(|| durer::render(&compiled, &options, &bar));
            bar.finish();
            Ok((film?, build, render))
        })?
    }

    fn show(&self) -> Show {
        Show::unless(self.quiet)
    }
}

/// The value of `work`, and the seconds that it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let value = work();
    (value, start.elapsed().as_secs_f64())
}

fn within(region: Region, width: u32, height: u32) -> bool {
    let ends = |start: u32, length: u32| u64::from(start) + u64::from(length);
    ends(region.x, region.width) <= u64::from(width) && ends(region.y, region.height) <= u64::from(height)
}

fn simd(name: &str) -> Result<SimdLevel, String> {
    let names = || SimdLevel::available().iter().map(|level| level.name()).collect::<Vec<_>>().join(", ");
    SimdLevel::named(name).ok_or_else(|| format!("this machine has {}", names()))
}

fn crop(text: &str) -> Result<Region, String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[_, _, 0, _] | &[_, _, _, 0]) => Err("width and height of the region must be at least 1".to_owned()),
        Ok(&[x, y, width, height]) => Ok(Region { x, y, width, height }),
        Ok(_) | Err(_) => Err("expected four whole numbers, X,Y,W,H, for example 100,80,64,64".to_owned()),
    }
}
