//! `durer render`: from a scene file to a picture file.

mod differences;
mod job;
mod layers;
mod manner;
mod report;
mod saver;
mod saving;

use crate::exit::{Exit, Failure};
use crate::load::SceneArgs;
use crate::overrides::Overrides;
use crate::target::FileOptions;
use clap::Args;
use durer::scene::RenderSettings;
use durer::{Film, Origin, Region, SampleRange, SimdLevel};
use layers::LayerOptions;
use saving::Saving;
use std::path::{Path, PathBuf};

pub(crate) use differences::differences_of_samples;
pub(crate) use job::{Job, Purpose};
pub(crate) use manner::Manner;
pub(crate) use saver::remove_checkpoint;

const EXAMPLES: &str = "\
Examples:
  durer render room.yaml                                  writes room.png
  durer render room.yaml -o room.exr --bit-depth float
  durer render room.yaml -o film.exr --layers all         see `durer develop --help`
  durer render bunny.ply                                  a model
  durer render room.yaml --width 1920 --antialias grid:4
  durer render room.yaml --crop 100,80,64,64 -o detail.png
  durer render room.yaml --antialias recursive:0.1,3 --stats json > room.json

The format follows the extension: png, jpg, exr, hdr or pfm; film keeps exact sums of
samples, for `durer merge`. The picture is the same
whatever the number of threads. Ctrl-C stops after the tiles being worked on and saves
what is finished beside the picture, as room.partial.png for room.png, which stays as it
was; the second Ctrl-C quits at once. A render that takes over a minute keeps what is
finished in a checkpoint, room.png.durer-checkpoint; after a crash or Ctrl-C,
`durer resume room.png.durer-checkpoint` goes on, to the same picture.";

/// Render a scene to a picture file
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// The picture file, or a film file to be merged with others [default: the scene's name with .png, in this folder]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Render only this part: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop, allow_hyphen_values = true)]
    crop: Option<Region>,

    /// Take only these samples of each pixel, the last excluded, up to 1000000: part of what several runs make together
    #[arg(long, value_name = "FROM..TO", value_parser = sample_range, allow_hyphen_values = true)]
    sample_range: Option<SampleRange>,

    #[command(flatten)]
    manner: Manner,

    /// Instruction set for building and searching, such as sse2, avx2 or neon; it changes no pixel [default: the best
    /// that the machine has]
    #[arg(long, value_name = "LEVEL", value_parser = simd)]
    simd: Option<SimdLevel>,

    #[command(flatten)]
    saving: Saving,

    #[command(flatten)]
    overrides: Overrides,

    #[command(flatten)]
    file: FileOptions,

    #[command(flatten)]
    layers: LayerOptions,
}

/// Renders the scene.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    Job { arguments, manner: &arguments.manner, origin: origin(), purpose: Purpose::Render }.run(None)
}

/// How this program was called, for its checkpoints: the words behind the subcommand.
fn origin() -> Option<Origin> {
    let words = std::env::args_os().skip(2).map(|word| word.into_string().ok()).collect::<Option<_>>()?;
    let folder = std::env::current_dir().ok()?.into_os_string().into_string().ok()?;
    Some(Origin { folder, words })
}

impl Arguments {
    /// The file that it writes.
    pub(crate) fn output_path(&self) -> PathBuf {
        match &self.output {
            Some(path) => path.clone(),
            None => PathBuf::from(self.scene.name()).with_extension("png"),
        }
    }

    /// Makes it one that writes what a film says, which is of this part and has all of its samples, to another file.
    pub(crate) fn developed(&mut self, film: &Film, folder: &Path, output: PathBuf) {
        if std::env::current_dir().is_ok_and(|here| here != folder) {
            self.scene.move_to(folder);
        }
        // What layers were asked for is for files that have any.
        if !matches!(crate::target::format_of(&output), Ok(durer::imaging::FileFormat::Exr)) {
            self.layers = LayerOptions::default();
        }
        self.output = Some(output);
        self.crop = Some(film.region());
        self.saving.checkpoint = None;
        self.saving.no_checkpoint = true;
    }

    /// Where its checkpoints go.
    pub(crate) fn checkpoint_path(&self) -> PathBuf {
        self.saving.path(&self.output_path())
    }

    /// True if it writes a film file.
    pub(crate) fn writes_film(&self) -> bool {
        crate::target::is_film(&self.output_path())
    }

    /// Makes it a render in another folder, whose checkpoints go where they have been so far.
    pub(crate) fn resumed_in(&mut self, folder: &Path, checkpoint: &Path) {
        if std::env::current_dir().is_ok_and(|here| here != folder) {
            self.output = Some(folder.join(self.output_path()));
            self.scene.move_to(folder);
        }
        self.saving.no_checkpoint = false;
        self.saving.checkpoint = Some(checkpoint.to_owned());
    }
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

fn sample_range(text: &str) -> Result<SampleRange, String> {
    const MOST: u32 = RenderSettings::SAMPLES_LIMIT;
    let number = |text: &str| text.parse::<u64>().ok();
    let numbers = text.split_once("..").and_then(|(start, end)| Some((number(start)?, number(end)?)));
    match numbers.map(|(start, end)| (start < end, u32::try_from(start), u32::try_from(end))) {
        Some((true, Ok(start), Ok(end @ ..=MOST))) => Ok(SampleRange { start, end }),
        Some((true, _, _)) => Err(format!("a pixel has at most {MOST} samples")),
        Some((false, _, _)) => Err("the second number must be greater than the first".to_owned()),
        None => Err("expected two whole numbers, FROM..TO, for example 0..64".to_owned()),
    }
}
