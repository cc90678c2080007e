//! What a picture says of where it comes from. Neither time nor place nor name, for the same scene with the same settings
//! gives the same bytes everywhere.

use crate::commands::info::{antialias_text, filter_text, tone_mapping_word, transfer_word};
use durer::Region;
use durer::math::Fingerprint;
use durer::scene::{Picture, Scene};

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
        entry("Antialias", antialias_text(settings.antialias)),
        entry("Filter", filter_text(settings.filter)),
        entry("Max depth", settings.max_depth.to_string()),
        entry("Min weight", settings.min_weight.to_string()),
    ];
    let tone_mapping = tone_mapping_word(tone_mapping);
    entries.extend((exposure != 0.0).then(|| entry("Exposure", exposure.to_string())));
    entries.extend((tone_mapping != "none").then(|| entry("Tone mapping", tone_mapping)));
    entries.extend(crop.map(|Region { x, y, width, height }| entry("Crop", format!("{x},{y},{width},{height}"))));
    entries
}

fn entry(keyword: &str, text: impl Into<String>) -> (String, String) {
    (keyword.to_owned(), text.into())
}
