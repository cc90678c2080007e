//! Wrong scenes, each with the messages it must get, written at the lines where they must appear.
//!
//! After `#~` on a line stand `error:` or `warning:`, a part of the message and, after `|`, a part of the help or the
//! label. Every diagnostic must be expected, and every expectation met. Wrong files that scenes name are in `files/`.

use durer_formats::{Diagnostic, FolderAssets, Limits, load_str};
use std::path::{Path, PathBuf};

struct Expected {
    line: usize,
    severity: String,
    message: String,
    help: String,
}

fn expectations(text: &str) -> Vec<Expected> {
    let in_line = |(at, line): (usize, &str)| {
        let parts = line.split("#~").skip(1).map(|part| {
            let (severity, rest) = part.trim().split_once(':').expect("`error: …` after #~");
            let (message, help) = rest.split_once(" | ").unwrap_or((rest, ""));
            let [severity, message, help] = [severity, message, help].map(|text| text.trim().to_owned());
            Expected { line: at + 1, severity, message, help }
        });
        parts.collect::<Vec<_>>()
    };
    text.lines().enumerate().flat_map(in_line).collect()
}

fn meets(found: &Diagnostic, expected: &Expected) -> bool {
    let beside = format!("{} {}", found.help.as_deref().unwrap_or(""), found.label.as_deref().unwrap_or(""));
    found.line == expected.line
        && found.severity.word() == expected.severity
        && found.message.contains(&expected.message)
        && beside.contains(&expected.help)
}

fn check(path: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let assets = FolderAssets::new(path.parent().unwrap_or(Path::new("")));
    let found = match load_str(&text, &name, &assets, &Limits::default()) {
        Ok(loaded) => loaded.warnings,
        Err(diagnostics) => diagnostics,
    };
    let mut open = expectations(&text);
    let count = open.len();
    for diagnostic in &found.list {
        let Some(at) = open.iter().position(|expected| meets(diagnostic, expected)) else {
            return Err(format!("{name}: line {} was not expected:\n{found}\n", diagnostic.line));
        };
        open.remove(at);
    }
    match open.first() {
        None if count > 0 => Ok(()),
        None => Err(format!("{name} expects nothing")),
        Some(missing) => Err(format!("{name}: line {} lacks `{}`:\n{found}\n", missing.line, missing.message)),
    }
}

#[test]
fn wrong_scenes_get_their_messages() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/bad");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    assert!(files.len() >= 60, "only {} files", files.len());
    let failures: Vec<String> = files.iter().filter_map(|path| check(path).err()).collect();
    assert!(failures.is_empty(), "{} of {} files:\n\n{}", failures.len(), files.len(), failures.join("\n"));
}
