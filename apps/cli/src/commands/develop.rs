//! `durer develop`: from a film file, or any picture with more light than a screen shows, to a picture for screens. Nothing is
//! rendered.

use crate::commands::info::transfer_word;
use crate::exit::{Exit, Failure};
use crate::target::FileOptions;
use crate::{output, target};
use clap::Args;
use clap::builder::PossibleValuesParser;
use durer::imaging::{
    BEAUTY, DecodeLimits, EncodeOptions, FileFacts, FileFormat, LayerFacts, LayerView, Meaning, ToneMapping, Transfer,
};
use durer::{PictureFile, picture_facts, picture_layers, read_layers};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  durer develop film.exr                                   writes film.png
  durer develop film.exr -o brighter.png --exposure 1.5 --tone-mapping agx
  durer develop film.exr --list                            the layers in it
  durer develop film.exr --layer normal                    writes film.normal.png

Exposure, tone mapping and curve are those that the scene asked for, unless others are
given; `durer render room.yaml -o film.exr --layers all` keeps them and more in the file.
Light can be had from EXR, HDR, PFM, PNG and JPEG. Layers of other numbers are shown so:
normals from 0 to 1, places between their bounds, depth from near (white) to far (dark),
numbers that name things and counts in false colors.";

/// Make a picture for screens of a film file, without rendering again
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The film: EXR, with layers or without, or another picture
    film: PathBuf,

    /// The picture file [default: the film's name with .png, in this folder]
    #[arg(short, long, value_name = "FILE", conflicts_with = "list")]
    output: Option<PathBuf>,

    /// The layer that is shown
    #[arg(long, value_name = "NAME", default_value = BEAUTY, conflicts_with = "list")]
    layer: String,

    /// Say which layers there are
    #[arg(long)]
    list: bool,

    /// Print them as JSON
    #[arg(long, requires = "list")]
    json: bool,

    /// Print no line at the end
    #[arg(short, long)]
    quiet: bool,

    #[command(flatten)]
    development: Development,

    #[command(flatten)]
    file: FileOptions,
}

/// How light becomes what a screen shows.
#[derive(Args, Debug)]
#[command(next_help_heading = "Instead of what the film says")]
struct Development {
    /// Stops by which the picture becomes brighter, a factor of two each, from -100 to 100
    #[arg(long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    exposure: Option<f32>,

    /// How light that is brighter than white is shown
    #[arg(long, value_name = "HOW", value_parser = tone_mappings())]
    tone_mapping: Option<String>,

    /// How light becomes the numbers of a PNG or JPEG
    #[arg(long, value_name = "CURVE", value_parser = ["srgb", "linear"])]
    transfer: Option<String>,
}

pub(crate) fn exposure(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(stops) if (-100.0..=100.0).contains(&stops) => Ok(stops),
        Ok(_) | Err(_) => Err("expected a number from -100 to 100".to_owned()),
    }
}

pub(crate) fn tone_mappings() -> PossibleValuesParser {
    PossibleValuesParser::new(ToneMapping::ALL.map(ToneMapping::word))
}

/// Develops the film, or says what is in it.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    target::is_picture(&arguments.film)?;
    match arguments.list {
        true => list(&arguments.film, arguments.json),
        false => develop(arguments),
    }
}

fn list(film: &Path, as_json: bool) -> Result<Exit, Failure> {
    let layers = picture_layers(film)?;
    match as_json {
        true => output::print_json(&layers.iter().map(json_of).collect())?,
        false => output::print(&text_of(&layers))?,
    }
    Ok(Exit::Fine)
}

fn json_of(layer: &LayerFacts) -> Value {
    let channel = |(name, kind): &(String, &str)| json!({ "name": name, "samples": kind });
    let channels: Vec<Value> = layer.channels.iter().map(channel).collect();
    json!({ "name": layer.name, "width": layer.width, "height": layer.height, "channels": channels })
}

fn text_of(layers: &[LayerFacts]) -> String {
    // A file may say anything, but not lead the terminal astray.
    let shown = |text: &str| text.replace(|c: char| c.is_control(), " ");
    let width = layers.iter().map(|layer| layer.name.chars().count()).max().unwrap_or(0);
    let line = |layer: &LayerFacts| {
        let channels: Vec<String> = layer.channels.iter().map(|(name, kind)| format!("{name} {kind}")).collect();
        let size = format!("{} × {}", layer.width, layer.height);
        format!("{:<width$}  {size}  {}\n", shown(&layer.name), shown(&channels.join(", ")))
    };
    layers.iter().map(line).collect()
}

/// A film may be larger than what scenes may read.
const LIMITS: DecodeLimits = DecodeLimits { max_pixels: 1 << 32, max_bytes: 16 << 30 };

fn develop(arguments: &Arguments) -> Result<Exit, Failure> {
    let Arguments { film, layer, development, .. } = arguments;
    let path = arguments.output_path();
    if target::same_place(&path, film) {
        let name = path.display();
        return Err(Failure::usage(format!(
            "-o: {name} is what is developed, and is not written over; name another file"
        )));
    }
    let format = target::format_of(&path)?;
    let mut options = arguments.file.encode_options(format)?;
    development.fits(format)?;
    let facts = picture_facts(film)?;
    let layers = read_layers(film, Some(layer), &LIMITS)?;
    let view = layers.view(layer).ok_or_else(|| no_layer(film, layer))?;
    drop(layers);
    development.apply(&facts, &view, layer, &mut options)?;
    let metadata = facts.metadata.into_iter().filter(|(keyword, _)| keyword == "Scene" || keyword == "Size");
    options.metadata.extend(metadata);
    let LayerView { image, alpha, .. } = view;
    let has_alpha = matches!(format, FileFormat::Png | FileFormat::Exr);
    let alpha = alpha.filter(|alpha| has_alpha && alpha.iter().any(|&alpha| alpha < 1.0));
    let file = PictureFile::create(&path)?;
    let bytes = match alpha {
        Some(alpha) => file.write_with_alpha(&image, &alpha, &options)?,
        None => file.write(&image, &options)?,
    };
    if !arguments.quiet {
        let (path, bytes) = (path.display(), crate::numbers::bytes(bytes as u64));
        output::note(&format!("{path}: {} × {} pixels, {bytes}", image.width, image.height));
    }
    Ok(Exit::Fine)
}

/// Says which layers there are instead.
fn no_layer(film: &Path, layer: &str) -> Failure {
    let names: Vec<String> = picture_layers(film)
        .unwrap_or_default()
        .into_iter()
        .map(|layer| layer.name.replace(|c: char| c.is_control(), " "))
        .collect();
    let there = match names.contains(&layer.to_owned()) {
        true => "has a layer of this name, but no channels in it that can be shown".to_owned(),
        false => format!("has no layer `{layer}`; it has {}", names.join(", ")),
    };
    Failure::usage(format!("--layer: {} {there}", film.display()))
}

impl Arguments {
    fn output_path(&self) -> PathBuf {
        self.output.clone().unwrap_or_else(|| {
            let name = PathBuf::from(self.film.file_name().unwrap_or_default());
            let suffix = if self.layer == BEAUTY { "png".to_owned() } else { format!("{}.png", self.layer) };
            name.with_extension(suffix.replace(['/', '\\'], "_"))
        })
    }
}

impl Development {
    /// What was given must mean something for the file that is to be written.
    fn fits(&self, format: FileFormat) -> Result<(), Failure> {
        let options = [
            ("--exposure", self.exposure.is_some()),
            ("--tone-mapping", self.tone_mapping.is_some()),
            ("--transfer", self.transfer.is_some()),
        ];
        match options.iter().find(|(_, is_given)| *is_given && format.is_linear()) {
            Some((option, _)) => {
                let name = format.name();
                Err(Failure::usage(format!("{option} is for PNG and JPEG; {name} holds the light as it is")))
            }
            None => Ok(()),
        }
    }

    /// The film's own settings, and over them those that were given.
    fn apply(
        &self,
        film: &FileFacts,
        view: &LayerView,
        layer: &str,
        options: &mut EncodeOptions,
    ) -> Result<(), Failure> {
        let given = |is_given: bool, option: &str| match is_given {
            true => Err(Failure::usage(format!("{option} is for light; the layer `{layer}` is no light"))),
            false => Ok(()),
        };
        let said = |keyword: &str| film.metadata.iter().find(|(known, _)| known == keyword).map(|(_, text)| text);
        let transfer = |word: &str| if word == "linear" { Transfer::Linear } else { Transfer::Srgb };
        match view.meaning {
            Meaning::Light => {
                let of_film = |keyword| said(keyword).filter(|_| film.format == FileFormat::Exr);
                options.exposure = match (self.exposure, of_film("Exposure").and_then(|text| exposure(text).ok())) {
                    (Some(stops), _) | (None, Some(stops)) => stops,
                    (None, None) => 0.0,
                };
                let word = self.tone_mapping.as_ref().or_else(|| of_film("Tone mapping"));
                let known =
                    ToneMapping::ALL.into_iter().find(|mapping| word.is_some_and(|word| word == mapping.word()));
                options.tone_mapping = known.unwrap_or_default();
                let word = self.transfer.as_ref().or_else(|| of_film("Transfer"));
                options.transfer = word.map_or(Transfer::Srgb, |word| transfer(word));
                options.metadata.extend([("Transfer".to_owned(), transfer_word(options.transfer).to_owned())]);
            }
            Meaning::Numbers => {
                given(self.exposure.is_some(), "--exposure")?;
                given(self.tone_mapping.is_some(), "--tone-mapping")?;
                options.transfer = self.transfer.as_deref().map_or(Transfer::Linear, transfer);
            }
            Meaning::FalseColor => {
                given(self.exposure.is_some(), "--exposure")?;
                given(self.tone_mapping.is_some(), "--tone-mapping")?;
                given(self.transfer.is_some(), "--transfer")?;
                options.transfer = Transfer::Srgb;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_film_says_cannot_move_the_cursor() {
        let channels = vec![("R\x1b[2J".to_owned(), "half")];
        let layer = LayerFacts { name: "beau\nty".to_owned(), width: 3, height: 2, channels };
        assert_eq!(text_of(&[layer]), "beau ty  3 × 2  R [2J half\n");
    }

    #[test]
    fn exposure_is_a_number_of_stops() {
        assert_eq!((exposure("1.5"), exposure("-3")), (Ok(1.5), Ok(-3.0)));
        for wrong in ["", "x", "101", "nan", "inf", "-100.1"] {
            assert!(exposure(wrong).is_err(), "{wrong}");
        }
    }
}
