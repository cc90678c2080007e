//! `durer explain`: how one pixel got its colour, ray by ray.

mod json;
mod ledger;
mod text;
mod words;

use crate::exit::{Exit, Failure};
use crate::load::SceneArgs;
use crate::overrides::Overrides;
use crate::{labels, output};
use clap::Args;
use durer::imaging::{Bitmap, DecodeLimits, EncodeOptions, FileFormat, Image, Texels, decode, encode};
use durer::math::Rgb;
use durer::{PixelExplanation, Scene};
use labels::ShapeLabel;

const EXAMPLES: &str = "\
Examples:
  durer explain room.yaml --pixel 120,43
  durer explain room.yaml --pixel 120,43 --antialias none
  durer explain room.yaml --pixel 120,43 --json > pixel.json

Pixels are counted from the upper left corner, from 0. The three numbers at the right
of a line are what it adds to the red, green and blue of the sample, all weights
included; added up from top to bottom they give the pixel as rendered, to the last bit.";

/// Show all rays of one pixel, what they hit, and what each adds to it
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgs,

    /// The pixel: column from the left and row from the top, from 0
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pixel: (u32, u32),

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
    shapes: Vec<ShapeLabel>,
    pixel: PixelExplanation,
}

/// Explains the pixel.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let checked = arguments.overrides.apply(arguments.scene.load()?)?;
    let compiled = durer::compile(&checked);
    let (x, y) = arguments.pixel;
    let scene = checked.scene();
    let pixel = durer::explain(&compiled, x, y).ok_or_else(|| {
        let (width, height) = (scene.picture.width, scene.picture.height);
        Failure::usage(format!("--pixel: {x},{y} is outside of the picture of {width} × {height} pixels"))
    })?;
    let explained = Explained { file: arguments.scene.name(), scene, shapes: labels::shapes(scene), pixel };
    match arguments.json {
        true => output::print_json(&explained.json())?,
        false => output::print(&explained.text())?,
    }
    Ok(Exit::Fine)
}

impl Explained<'_> {
    /// The colours of all kept samples, each times its weight, added up in order.
    fn sum(&self) -> Rgb {
        let kept = self.pixel.samples.iter().filter_map(|sample| sample.weight.map(|weight| sample.color * weight));
        kept.fold(Rgb::BLACK, |sum, color| sum + color)
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

    /// What a shape is called.
    fn shape(&self, index: usize) -> String {
        self.shapes.get(index).map_or_else(|| format!("shape {index}"), ShapeLabel::to_string)
    }
}

fn pixel(text: &str) -> Result<(u32, u32), String> {
    let place = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    place.ok_or_else(|| "expected two whole numbers, X,Y, for example 120,43".to_owned())
}
