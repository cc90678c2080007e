//! What fuzzing begins with, and what it once found, does no harm any more.

use durer_trials::TARGETS;
use std::path::{Path, PathBuf};

/// The files in a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// Tries all files of a folder that has a folder for each target, and gives their number.
fn tried(name: &str) -> usize {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz").join(name);
    let mut count = 0;
    for folder in files(&folder) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        let Some((_, target)) = TARGETS.iter().find(|(known, _)| *known == name) else {
            panic!("`{name}` is no target");
        };
        for file in files(&folder) {
            let bytes = std::fs::read(&file).unwrap();
            // The panic itself does not say which file it was.
            assert!(std::panic::catch_unwind(|| target(&bytes)).is_ok(), "{}", file.display());
            count += 1;
        }
    }
    count
}

#[test]
fn seeds_do_no_harm() {
    assert!(tried("seeds") >= TARGETS.len());
}

#[test]
fn findings_stay_mended() {
    assert!(tried("regressions") > 0);
}

#[test]
fn each_target_has_a_file_of_its_own_and_seeds() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let stems = |folder: &str| -> Vec<String> {
        files(&fuzz.join(folder)).iter().map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect()
    };
    let mut names: Vec<&str> = TARGETS.iter().map(|(name, _)| *name).collect();
    names.sort_unstable();
    assert_eq!(stems("fuzz_targets"), names);
    assert_eq!(stems("seeds"), names);
}
