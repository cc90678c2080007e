//! `durer heatmap`: what each pixel costs, as a picture.

use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::load::SceneArgs;
use crate::numbers::{short, thousands};
use crate::overrides::Overrides;
use crate::progress::{Bar, Show};
use crate::{output, target};
use clap::{Args, ValueEnum};
use durer::imaging::{ErrorMap, Image, false_color};
use durer::{CheckedScene, CompiledScene, PictureFile, RenderOptions};
use serde_json::{Value, json};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  durer heatmap room.yaml                                 writes room.heat.png
  durer heatmap city.yaml -o nodes.png --what nodes
  durer heatmap city.yaml --scale 200 --width 1920 --json > city.json
  durer heatmap room.yaml --what divisions                where anti-aliasing looks closer

One ray of the eye goes through the middle of each pixel; counted are the nodes of trees
whose boxes it was tested against, and the shapes, triangles and particles that it was
tested against, until it was known what it meets first. For `divisions` the picture is
rendered, and counted is how often each pixel was divided to look closer. Black is
nothing, pale yellow the scale or more.";

/// Show what it takes to find what the eye sees, as a picture in false colors
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// The picture file [default: the scene's name with .heat.png, in this folder]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// What is counted
    #[arg(long, value_name = "WHAT", default_value = "both")]
    what: What,

    /// The number that is pale yellow [default: what 99.5 % of the pixels do not exceed]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), allow_negative_numbers = true)]
    scale: Option<u32>,

    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Print the numbers as JSON, in place of the line at the end
    #[arg(long)]
    json: bool,

    /// Show neither progress nor the line at the end, only warnings and errors
    #[arg(short, long)]
    quiet: bool,

    #[command(flatten)]
    overrides: Overrides,
}

/// What is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// Nodes of trees
    Nodes,
    /// Shapes, triangles and particles
    Primitives,
    /// The sum of the two
    Both,
    /// How often anti-aliasing divided each pixel
    Divisions,
}

/// Draws the map.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::after(arguments.scene.time_limit());
    let path = arguments.output_path();
    let format = target::format_of(&path)?;
    let scene = arguments.overrides.load(&arguments.scene, arguments.show())?.scene;
    let (width, height) = (scene.scene().picture.width, scene.scene().picture.height);
    let Counted { counts, summaries } = arguments.count(&scene, &interrupt)?;
    let scale = arguments.scale.unwrap_or_else(|| almost_all(&counts));
    PictureFile::create(&path)?.write(&picture((width, height), &counts, scale), &target::usual(format))?;
    if arguments.json {
        let mut facts = json!({ "output": path.to_string_lossy(), "width": width, "height": height, "scale": scale });
        for summary in &summaries {
            facts[summary.what] = summary.json();
        }
        output::print_json(&facts)?;
    } else if !arguments.quiet {
        let told: Vec<String> = summaries.iter().map(Summary::text).collect();
        let (path, told) = (path.display(), told.join("; "));
        output::note(&format!(
            "{path}: {width} × {height} pixels; {told}; the scale ends at {}",
            thousands(scale.into())
        ));
    }
    Ok(Exit::Fine)
}

/// What was counted in each pixel, and what there is to say of it.
struct Counted {
    counts: Vec<u32>,
    summaries: Vec<Summary>,
}

impl Arguments {
    fn output_path(&self) -> PathBuf {
        self.output.clone().unwrap_or_else(|| PathBuf::from(self.scene.name()).with_extension("heat.png"))
    }

    fn count(&self, scene: &CheckedScene, interrupt: &Interrupt) -> Result<Counted, Failure> {
        durer::with_threads(self.threads.map(usize::from), || {
            let compiled = self.scene.compile(scene, self.show())?;
            let bar = Bar::new(interrupt.stop_flag(), 0, self.show());
            let counted = self.what.count(&compiled, &bar)?;
            bar.finish();
            interrupt.stopped()?;
            Ok(counted)
        })?
    }

    fn show(&self) -> Show {
        Show::unless(self.quiet)
    }
}

impl What {
    fn count(self, scene: &CompiledScene, bar: &Bar<'_>) -> Result<Counted, Failure> {
        let options = RenderOptions::default();
        if self == What::Divisions {
            let film = durer::render(scene, &options, bar)?;
            let counts: Vec<u32> = film.depths().iter().map(|&depth| depth.into()).collect();
            let summaries = vec![Summary::of("divisions", &counts)];
            return Ok(Counted { counts, summaries });
        }
        let map = durer::heatmap(scene, &options, bar)?;
        let summaries = vec![Summary::of("nodes", &map.nodes), Summary::of("primitives", &map.primitives)];
        let counts = match self {
            What::Nodes => map.nodes,
            What::Primitives => map.primitives,
            What::Both | What::Divisions => {
                map.nodes.iter().zip(&map.primitives).map(|(a, b)| a.saturating_add(*b)).collect()
            }
        };
        Ok(Counted { counts, summaries })
    }
}

/// The least number, but at least 1, that no more than one of 200 exceeds.
fn almost_all(counts: &[u32]) -> u32 {
    let mut counts = counts.to_vec();
    let at = counts.len().saturating_sub(1 + counts.len() / 200);
    match counts.is_empty() {
        true => 1,
        false => (*counts.select_nth_unstable(at).1).max(1),
    }
}

fn picture((width, height): (u32, u32), counts: &[u32], scale: u32) -> Image {
    let share = |&count: &u32| (f64::from(count) / f64::from(scale)).min(1.0) as f32;
    false_color(&ErrorMap { width, height, values: counts.iter().map(share).collect() })
}

/// The counts of one thing, in short.
struct Summary {
    what: &'static str,
    mean: f64,
    max: u32,
}

impl Summary {
    fn of(what: &'static str, counts: &[u32]) -> Summary {
        let sum: u64 = counts.iter().map(|&count| u64::from(count)).sum();
        let max = counts.iter().copied().max().unwrap_or(0);
        Summary { what, mean: sum as f64 / counts.len().max(1) as f64, max }
    }

    fn text(&self) -> String {
        let mean = short((self.mean * 100.0).round() / 100.0);
        format!("{}: {mean} in the mean, at most {}", self.what, thousands(self.max.into()))
    }

    fn json(&self) -> Value {
        json!({ "mean": self.mean, "max": self.max })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_leaves_out_one_pixel_of_two_hundred() {
        let counts: Vec<u32> = (1..=1000).collect();
        assert_eq!(almost_all(&counts), 995);
        assert_eq!(almost_all(&[7]), 7);
        assert_eq!(almost_all(&[0, 0]), 1, "a scale must have a length");
        assert_eq!(almost_all(&[]), 1);
    }
}
