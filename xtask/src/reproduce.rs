//! `cargo xtask reproduce`: every scene that we ship, rendered small in every way that must not matter, is the same to the
//! last bit: with any number of threads, any instruction set, in any build, on any machine, in WebAssembly.
//!
//! The fingerprints in `scenes/checksums.toml` are those of the films, so that neither rounding to 8 bits nor compression
//! hides or makes a difference.

mod aarch64;
mod checksums;
mod native;
mod options;
mod tools;
mod wasm;

use checksums::Checksums;
use durer::math::Fingerprint;
use options::{Options, Target};
use std::path::{Path, PathBuf};
use tools::Unable;

/// The longer side of each picture, in pixels: small, but with several tiles.
const LONGER_SIDE: u32 = 80;

/// The fingerprints of all scenes, by name: the path below `scenes`.
type Fingerprints = Vec<(String, Fingerprint)>;

/// Does what the options say.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let options = Options::parse(words)?;
    let scenes = scene_names()?;
    if options.list {
        films(&scenes, &options)?.iter().for_each(|(name, film)| println!("{name} {film}"));
        return Ok(());
    }
    if options.bless {
        return bless(films(&scenes, &options)?);
    }
    let checksums = Checksums::read()?;
    checksums.names_all(&scenes)?;
    match options.target {
        Target::Native => native::compare(&checksums, &scenes, &options),
        Target::Wasm => compare_elsewhere(&checksums, &options, || wasm::fingerprints(&scenes)),
        Target::Aarch64 => compare_elsewhere(&checksums, &options, aarch64::fingerprints),
    }
}

/// The fingerprints of all films, each made in one way.
fn films(scenes: &[String], options: &Options) -> Result<Fingerprints, String> {
    let (threads, simd) = options.one_way();
    scenes.iter().map(|name| Ok((name.clone(), native::film(name, threads, simd)?.fingerprint()))).collect()
}

fn bless(films: Fingerprints) -> Result<(), String> {
    let old = Checksums::read().unwrap_or_default();
    let changed = films.iter().filter(|(name, film)| old.0.get(name) != Some(film)).count();
    println!("{}: {changed} of {} scenes renewed", checksums::PATH, films.len());
    Checksums(films.into_iter().collect()).write()
}

/// Compares what another target makes of the scenes, if it can be tried here.
fn compare_elsewhere(
    checksums: &Checksums,
    options: &Options,
    render: impl FnOnce() -> Result<Vec<(&'static str, Fingerprints)>, Unable>,
) -> Result<(), String> {
    match render() {
        Ok(ways) => ways.iter().try_for_each(|(way, films)| checksums.compare(way, films)),
        Err(Unable::Missing(what)) if options.where_possible => {
            println!("left out, {what}");
            Ok(())
        }
        Err(Unable::Missing(what) | Unable::Failed(what)) => Err(what),
    }
}

/// The folder of the scenes.
fn scenes_folder() -> PathBuf {
    crate::shell::root().join("scenes")
}

/// All scene files in the folder and those below it, sorted, with `/` between folders.
fn scene_names() -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    add_scenes(&scenes_folder(), "", &mut names)?;
    names.sort();
    Ok(names)
}

fn add_scenes(folder: &Path, prefix: &str, names: &mut Vec<String>) -> Result<(), String> {
    let cannot = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(cannot)? {
        let path = entry.map_err(cannot)?.path();
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() {
            add_scenes(&path, &format!("{name}/"), names)?;
        } else if name.ends_with(".yaml") {
            names.push(name);
        }
    }
    Ok(())
}

/// Reads the lines that [`Options::list`] and `reproduce.mjs` print.
fn parse_list(text: &str) -> Result<Fingerprints, String> {
    let wrong = |line: &str| format!("expected a scene and its fingerprint, found `{line}`");
    let parse = |line: &str| {
        let (name, digits) = line.rsplit_once(' ')?;
        Some((name.to_owned(), checksums::parse_fingerprint(digits)?))
    };
    text.lines().map(|line| parse(line).ok_or_else(|| wrong(line))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_scenes_are_found() {
        let names = scene_names().unwrap();
        assert!(names.contains(&"room.yaml".to_owned()) && names.contains(&"gallery/glass.yaml".to_owned()));
        assert!(names.is_sorted());
    }

    #[test]
    fn every_shipped_scene_has_a_fingerprint_and_nothing_else_has() {
        Checksums::read().unwrap().names_all(&scene_names().unwrap()).unwrap();
    }

    #[test]
    fn lists_are_read() {
        let digits = "000000000000000000000000000000ff";
        assert_eq!(parse_list(&format!("a b.yaml {digits}\n")), Ok(vec![("a b.yaml".to_owned(), Fingerprint(255))]));
        assert!(parse_list("panic!").is_err() && parse_list("a.yaml ff").is_err());
    }
}
