//! `durer info` of a film or a checkpoint: what it is of, and how much of that is there.

use crate::commands::merge::words_of;
use crate::exit::{Exit, Failure};
use crate::{numbers, output};
use durer::{Checkpoint, CheckpointError, read_checkpoint, read_checkpoint_outline};
use serde_json::{Value, json};
use std::path::Path;

/// True if the file begins as films and checkpoints do, of whatever version.
pub(crate) fn is_one(path: &Path) -> bool {
    let is_empty = std::fs::metadata(path).is_ok_and(|metadata| metadata.len() == 0);
    match read_checkpoint_outline(path) {
        Ok(_) | Err(CheckpointError::OtherFormat(_) | CheckpointError::OtherVersion(_)) => true,
        // Nothing at all is the beginning of anything.
        Err(CheckpointError::Damaged) => !is_empty,
        // A file of another kind, or none that can be read.
        Err(_) => false,
    }
}

/// Tells what is in it.
pub(super) fn run(path: &Path, as_json: bool) -> Result<Exit, Failure> {
    let checkpoint =
        read_checkpoint(path).map_err(|error| Failure::file(format!("cannot read {}: {error}", path.display())))?;
    match as_json {
        true => output::print_json(&json(&checkpoint))?,
        false => output::print(&format!("{}\n{}", path.display(), text(&checkpoint)))?,
    }
    Ok(Exit::Fine)
}

/// How far the film has come.
fn state(checkpoint: &Checkpoint) -> String {
    let film = &checkpoint.film;
    match film.sums() {
        _ if film.is_complete() => "film, finished".to_owned(),
        Some(_) => "film, not finished".to_owned(),
        None => {
            let (finished, all) = (film.finished_pixels(), film.region().pixels());
            format!("film, {} of {} pixels finished", numbers::thousands(finished), numbers::thousands(all))
        }
    }
}

fn text(checkpoint: &Checkpoint) -> String {
    let Checkpoint { origin, scene, seconds, film } = checkpoint;
    let (width, height) = scene.size();
    let mut lines = vec![
        ("kind", state(checkpoint)),
        ("pixels", words_of(film)),
        ("picture", format!("{width} × {height} pixels")),
        ("integrator", super::own_settings(scene.integrator())),
    ];
    let parts = film.sums().map_or(&[][..], |sums| &sums.parts[..]);
    lines.extend(parts.iter().map(|part| ("of", part.to_string())));
    if film.sums().is_some_and(|sums| !sums.direct.is_empty()) {
        lines.push(("direct", "light that met one surface at most is known apart".to_owned()));
    }
    if *seconds > 0.0 {
        lines.push(("seconds", format!("{seconds:.1} so far")));
    }
    lines.push(("scene", scene.fingerprint().to_string()));
    lines.push(("begun in", origin.folder.clone()));
    lines.push(("begun as", format!("durer render {}", origin.words.join(" "))));
    // A film may say anything, but not lead the terminal astray.
    let shown = |text: &str| text.replace(|c: char| c.is_control(), " ");
    lines.iter().map(|(title, text)| format!("  {title:<10} {}\n", shown(text))).collect()
}

fn json(checkpoint: &Checkpoint) -> Value {
    let Checkpoint { origin, scene, seconds, film } = checkpoint;
    let region = |durer::Region { x, y, width, height }| json!({ "x": x, "y": y, "width": width, "height": height });
    let parts = film.sums().map_or(&[][..], |sums| &sums.parts[..]);
    let parts: Vec<Value> = parts
        .iter()
        .map(|part| json!({ "region": region(part.region), "samples": [part.samples.start, part.samples.end] }))
        .collect();
    let taken = film.sums().map(|sums| sums.least_and_most());
    json!({
        "format": "film",
        "complete": film.is_complete(),
        "region": region(film.region()),
        "picture": { "width": scene.size().0, "height": scene.size().1 },
        "integrator": scene.integrator().word(),
        "path": super::path_json(scene.integrator()),
        "samples": taken.map(|(least, most)| json!({ "least": least, "most": most })),
        "parts": parts,
        "direct": film.sums().is_some_and(|sums| !sums.direct.is_empty()),
        "finished_pixels": film.finished_pixels(),
        "seconds": seconds,
        "scene": scene.fingerprint().to_string(),
        "folder": origin.folder,
        "words": origin.words,
    })
}
