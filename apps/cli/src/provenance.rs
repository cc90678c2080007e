//! What a picture says of where it comes from. Neither time nor place nor name, for the same scene with the same settings
//! gives the same bytes everywhere.

use crate::commands::info::{antialias_text, filter_text, tone_mapping_word, transfer_word};
use durer::math::Fingerprint;
use durer::scene::{Integrator, PathSettings, Picture, RenderSettings, Scene};
use durer::{Region, Sums};

/// The program that wrote it, for every picture.
pub(crate) fn software() -> (String, String) {
    entry("Software", concat!("durer ", env!("CARGO_PKG_VERSION")))
}

/// The scene that it shows, as it was loaded, and the settings that it was rendered with, wherever those come from.
pub(crate) fn of_render(loaded: Fingerprint, rendered: &Scene, crop: Option<Region>) -> Vec<(String, String)> {
    let Picture { width, height, transfer, exposure, tone_mapping } = rendered.picture;
    let settings = rendered.render;
    let mut entries = vec![
        software(),
        entry("Scene", loaded.to_string()),
        entry("Size", format!("{width}x{height}")),
        entry("Transfer", transfer_word(transfer)),
    ];
    match settings.integrator {
        Integrator::Whitted => entries.extend([
            entry("Antialias", antialias_text(settings.antialias)),
            entry("Filter", filter_text(settings.filter)),
            entry("Max depth", settings.max_depth.to_string()),
            entry("Min weight", settings.min_weight.to_string()),
        ]),
        // Of the middles of pixels, whatever these say.
        Integrator::Uv => entries.push(entry("Integrator", settings.integrator.word())),
        Integrator::Normals | Integrator::Depth => entries.extend([
            entry("Integrator", settings.integrator.word()),
            entry("Antialias", antialias_text(settings.antialias)),
            entry("Filter", filter_text(settings.filter)),
        ]),
        Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) => {
            entries.extend([
                entry("Integrator", settings.integrator.word()),
                entry("Filter", filter_text(settings.filter)),
                entry("Max depth", max_depth.to_string()),
            ]);
            entries.extend(clamp.map(|clamp| entry("Clamp", clamp.to_string())));
            entries.extend((split > 1).then(|| entry("Split", split.to_string())));
            entries.extend((reuse > 1).then(|| entry("Reuse", reuse.to_string())));
            entries.extend(of_sampling(&settings));
        }
        Integrator::AmbientOcclusion { distance } => {
            entries.extend([
                entry("Integrator", settings.integrator.word()),
                entry("Filter", filter_text(settings.filter)),
            ]);
            entries.extend(distance.map(|distance| entry("Distance", distance.to_string())));
            entries.extend(of_sampling(&settings));
        }
    }
    let tone_mapping = tone_mapping_word(tone_mapping);
    entries.extend((exposure != 0.0).then(|| entry("Exposure", exposure.to_string())));
    entries.extend((tone_mapping != "none").then(|| entry("Tone mapping", tone_mapping)));
    let crop = crop.filter(|region| (region.width, region.height) != (width, height));
    entries.extend(crop.map(|Region { x, y, width, height }| entry("Crop", format!("{x},{y},{width},{height}"))));
    entries
}

/// How samples are chosen; a limit of time is told by how many there were.
fn of_sampling(settings: &RenderSettings) -> impl Iterator<Item = (String, String)> {
    let noise = settings.noise.map(|noise| entry("Noise", noise.to_string()));
    [entry("Seed", settings.seed.to_string())].into_iter().chain(noise)
}

/// The samples that a picture is made of: as many as `--samples` takes, if it has the first ones.
pub(crate) fn of_samples(sums: &Sums) -> (String, String) {
    let (least, most) = sums.least_and_most();
    match &sums.parts[..] {
        [part] if least == most && part.samples.start == 0 => entry("Samples", least.to_string()),
        [part] if least == most => entry("Samples", format!("{}..{}", part.samples.start, part.samples.end)),
        _ => entry("Samples", format!("{least} to {most}")),
    }
}

fn entry(keyword: &str, text: impl Into<String>) -> (String, String) {
    (keyword.to_owned(), text.into())
}
