//! `durer explain`: how one pixel got its colour, ray by ray.

mod json;
mod ledger;
mod text;
mod words;

use crate::exit::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::labels;
use crate::labels::Shapes;
use crate::load::SceneArgs;
use crate::output;
use crate::overrides::Overrides;
use crate::progress::Show;
use clap::Args;
use durer::imaging::{Bitmap, DecodeLimits, EncodeOptions, FileFormat, Image, Texels, decode, encode};
use durer::math::Rgb;
use durer::scene::{Material, MaterialId};
use durer::{PixelExplanation, Scene};

const EXAMPLES: &str = "\
Examples:
  durer explain room.yaml --pixel 120,43
  durer explain room.yaml --pixel 120,43 --antialias none
  durer explain room.yaml --pixel 120,43 --json > pixel.json
  durer explain box.yaml --pixel 120,43 --sample 2

Pixels are counted from the upper left corner, from 0. The three numbers at the right
of a line are what it adds to the red, green and blue of the sample, all weights
included; added up from top to bottom they give the pixel as rendered, to the last bit.

Where paths serve several pixels (`reuse`), light that arrives at a junction is no part
of the sample: what follows has weights relative to the junction, and no numbers at the
right. Rays to junctions take it from there, those of other pixels too, and say who found
them: `--pixel` and `--sample` with these numbers show how.";

/// Show all rays of one pixel, what they hit, and what each adds to it
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// The pixel: column from the left and row from the top, from 0
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pixel: (u32, u32),

    /// Show but this sample, from 1: of pictures that are made of many
    #[arg(long, value_name = "N")]
    sample: Option<usize>,

    /// Print everything as JSON
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    overrides: Overrides,
}

/// An explanation, with what is needed to tell it.
struct Explained<'s> {
    file: String,
    scene: &'s Scene,
    shapes: Shapes<'s>,
    pixel: PixelExplanation,
    /// The one sample that is asked for.
    only: Option<usize>,
}

/// Explains the pixel.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    Interrupt::after(arguments.scene.time_limit());
    let checked = arguments.overrides.load(&arguments.scene, Show::Progress)?.scene;
    let compiled = arguments.scene.compile(&checked, Show::Progress)?;
    let (x, y) = arguments.pixel;
    let scene = checked.scene();
    let pixel = durer::explain(&compiled, x, y).ok_or_else(|| {
        let (width, height) = (scene.picture.width, scene.picture.height);
        Failure::usage(format!("--pixel: {x},{y} is outside of the picture of {width} × {height} pixels"))
    })?;
    if let Some(sample) = arguments.sample.filter(|sample| !(1..=pixel.samples.len()).contains(sample)) {
        return Err(Failure::usage(format!("--sample: there is no sample {sample}, but 1 to {}", pixel.samples.len())));
    }
    let explained =
        Explained { file: arguments.scene.name(), scene, shapes: Shapes::of(scene), pixel, only: arguments.sample };
    match arguments.json {
        true => output::print_json(&explained.json())?,
        false => output::print(&explained.text())?,
    }
    Ok(Exit::Fine)
}

impl Explained<'_> {
    /// What all that is listed adds up to.
    fn sum(&self) -> Rgb {
        self.pixel.sum()
    }

    /// True if the sum is the rendered colour, bit for bit.
    fn sum_is_exact(&self) -> bool {
        self.sum().to_array().map(f32::to_bits) == self.pixel.color.to_array().map(f32::to_bits)
    }

    /// The pixel in a PNG of 8 bits, made by the encoder itself.
    fn stored(&self) -> Option<[u8; 3]> {
        let image = Image::from_pixels(1, 1, vec![self.pixel.color])?;
        let transfer = self.scene.picture.transfer;
        let png = encode(&image, &EncodeOptions { transfer, ..EncodeOptions::new(FileFormat::Png) }).ok()?;
        match decode(&png, &DecodeLimits::default()) {
            Ok(Bitmap { texels: Texels::U8(texels), .. }) => texels.first().copied(),
            Ok(_) | Err(_) => None,
        }
    }

    /// What a material is called; `None` stands for the default one.
    fn material(&self, id: Option<MaterialId>) -> String {
        match id.map(|id| (id.0, self.scene.materials.get(id.0 as usize))) {
            None => "the default material".to_owned(),
            Some((_, Some(Material { name: Some(name), .. }))) => format!("material \"{}\"", labels::cut(name)),
            Some((id, _)) => format!("material {id}"),
        }
    }

    /// What a shape is called.
    fn shape(&self, index: usize) -> String {
        self.shapes.label(index).map_or_else(|| format!("shape {index}"), |label| label.to_string())
    }
}

fn pixel(text: &str) -> Result<(u32, u32), String> {
    let place = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    place.ok_or_else(|| "expected two whole numbers, X,Y, for example 120,43".to_owned())
}
