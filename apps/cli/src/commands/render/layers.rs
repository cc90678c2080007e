//! Which layers a film file gets.

use crate::exit::Failure;
use clap::Args;
use durer::FilmLayer;
use durer::imaging::{EncodeOptions, FileFormat};

/// Options of film files.
#[derive(Args, Debug)]
#[command(next_help_heading = "The file")]
pub(super) struct LayerOptions {
    /// Layers of an EXR file: `all`, or names from beauty, albedo, normal, depth, position, uv, object_id and material_id,
    /// with commas between [default: beauty]
    #[arg(long, value_name = "NAMES", value_parser = layers)]
    layers: Option<Chosen>,
}

/// Layers in the order of files, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Chosen(Vec<FilmLayer>);

fn layers(text: &str) -> Result<Chosen, String> {
    if text == "all" {
        return Ok(Chosen(FilmLayer::ALL.to_vec()));
    }
    let named = |name: &str| FilmLayer::named(name.trim()).ok_or_else(|| name.trim().to_owned());
    let chosen = text.split(',').map(named).collect::<Result<Vec<_>, _>>();
    let chosen = chosen.map_err(|name| {
        let names: Vec<&str> = FilmLayer::ALL.into_iter().map(FilmLayer::name).collect();
        format!("there is no layer `{name}`; there are {}, or `all`", names.join(", "))
    })?;
    Ok(Chosen(FilmLayer::ALL.into_iter().filter(|layer| chosen.contains(layer)).collect()))
}

impl LayerOptions {
    /// The layers beside or in place of the beauty; `None` if that is all there is to be.
    pub(super) fn of_file(&self, format: FileFormat) -> Result<Option<Vec<FilmLayer>>, Failure> {
        match (&self.layers, format) {
            (None, _) => Ok(None),
            (Some(Chosen(layers)), FileFormat::Exr) => Ok((layers[..] != [FilmLayer::Beauty]).then(|| layers.clone())),
            (Some(_), FileFormat::Png | FileFormat::Jpeg | FileFormat::Hdr | FileFormat::Pfm) => {
                Err(Failure::usage(format!("--layers: only EXR has layers, {} has none", format.name())))
            }
        }
    }
}

/// The most bytes that the file may take.
pub(super) fn most_bytes(options: &EncodeOptions, layers: Option<&[FilmLayer]>, (width, height): (u32, u32)) -> u64 {
    let metadata = EncodeOptions { metadata: options.metadata.clone(), ..EncodeOptions::default() }.most_bytes(0, 0);
    match layers {
        Some(layers) => FilmLayer::most_bytes(layers, options.exr_samples, width, height) + metadata,
        None => options.most_bytes(width, height),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_read_in_any_order() {
        let chosen = |text: &str| layers(text).map(|Chosen(layers)| layers);
        assert_eq!(chosen("all").map(|layers| layers.len()), Ok(FilmLayer::ALL.len()));
        assert_eq!(chosen("depth, beauty,depth"), Ok(vec![FilmLayer::Beauty, FilmLayer::Depth]));
        for wrong in ["", "deep", "all,depth", "depth,"] {
            assert!(chosen(wrong).is_err(), "{wrong}");
        }
        let Err(message) = chosen("depht") else { panic!() };
        assert!(message.starts_with("there is no layer `depht`; there are beauty, albedo, normal,"), "{message}");
    }
}
