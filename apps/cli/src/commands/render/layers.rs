//! Which layers a film file gets.

use crate::exit::Failure;
use clap::Args;
use durer::FilmLayer;
use durer::imaging::{EncodeOptions, FileFormat};
use durer::scene::Integrator;

/// Options of film files.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "The file")]
pub(super) struct LayerOptions {
    /// Layers of an EXR file: `all`, or names from beauty, albedo, normal, depth, position, uv, object_id, material_id and,
    /// of pictures by samples, direct, indirect, variance and samples, with commas between [default: beauty]
    #[arg(long, value_name = "NAMES", value_parser = layers)]
    layers: Option<Chosen>,

    /// Leave out the background where the eye sees it: the alpha of a PNG or EXR says how much of each pixel is there
    #[arg(long)]
    pub(super) alpha: bool,
}

/// Layers in the order of files, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Chosen {
    /// Those that there are.
    All,
    Named(Vec<FilmLayer>),
}

fn layers(text: &str) -> Result<Chosen, String> {
    if text == "all" {
        return Ok(Chosen::All);
    }
    let named = |name: &str| FilmLayer::named(name.trim()).ok_or_else(|| name.trim().to_owned());
    let chosen = text.split(',').map(named).collect::<Result<Vec<_>, _>>();
    let chosen = chosen.map_err(|name| {
        let names: Vec<&str> = FilmLayer::ALL.into_iter().map(FilmLayer::name).collect();
        format!("there is no layer `{name}`; there are {}, or `all`", names.join(", "))
    })?;
    Ok(Chosen::Named(FilmLayer::ALL.into_iter().filter(|layer| chosen.contains(layer)).collect()))
}

impl LayerOptions {
    /// The layers beside or in place of the beauty; `None` if that is all there is to be.
    pub(super) fn of_file(
        &self,
        format: FileFormat,
        integrator: &Integrator,
    ) -> Result<Option<Vec<FilmLayer>>, Failure> {
        if self.alpha && !matches!(format, FileFormat::Png | FileFormat::Exr) {
            return Err(Failure::usage(format!("--alpha: {} has no alpha; PNG and EXR have", format.name())));
        }
        let Some(chosen) = &self.layers else { return Ok(None) };
        if format != FileFormat::Exr {
            return Err(Failure::usage(format!("--layers: only EXR has layers, {} has none", format.name())));
        }
        let (there, missing): (Vec<FilmLayer>, Vec<FilmLayer>) = match chosen {
            Chosen::All => (FilmLayer::ALL.into_iter().filter(|layer| layer.is_of(integrator)).collect(), Vec::new()),
            Chosen::Named(layers) => layers.iter().partition(|layer| layer.is_of(integrator)),
        };
        match missing.first() {
            Some(layer) => {
                let (layer, integrator) = (layer.name(), integrator.word());
                Err(Failure::usage(format!("--layers: pictures by `{integrator}` have no layer `{layer}`")))
            }
            None => Ok((there[..] != [FilmLayer::Beauty]).then_some(there)),
        }
    }
}

/// The most bytes that the file may take.
pub(super) fn most_bytes(
    options: &EncodeOptions,
    (layers, with_alpha): (Option<&[FilmLayer]>, bool),
    (width, height): (u32, u32),
) -> u64 {
    let metadata = EncodeOptions { metadata: options.metadata.clone(), ..EncodeOptions::default() }.most_bytes(0, 0);
    match layers {
        Some(layers) => FilmLayer::most_bytes(layers, options.exr_samples, width, height) + metadata,
        None if with_alpha => options.most_bytes_with_alpha(width, height),
        None => options.most_bytes(width, height),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_read_in_any_order() {
        assert_eq!(layers("all"), Ok(Chosen::All));
        assert_eq!(layers("depth, beauty,depth"), Ok(Chosen::Named(vec![FilmLayer::Beauty, FilmLayer::Depth])));
        for wrong in ["", "deep", "all,depth", "depth,"] {
            assert!(layers(wrong).is_err(), "{wrong}");
        }
        let Err(message) = layers("depht") else { panic!() };
        assert!(message.starts_with("there is no layer `depht`; there are beauty, albedo, normal,"), "{message}");
    }

    #[test]
    fn all_layers_are_those_that_the_integrator_has() {
        let count = |integrator: Integrator| {
            let options = LayerOptions { layers: Some(Chosen::All), alpha: false };
            options.of_file(FileFormat::Exr, &integrator).map(|layers| layers.map(|layers| layers.len())).ok()
        };
        assert_eq!(count(Integrator::Whitted), Some(Some(8)));
        assert_eq!(count(Integrator::AmbientOcclusion { distance: None }), Some(Some(10)));
        assert_eq!(count(Integrator::PATH), Some(Some(12)));
    }
}
