//! All that is bad in `tests/bad/`, read by the program with little memory and little time: whatever it says, it says it.

#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// KiB of address space, for the program itself, its threads and all that it reads.
const MEMORY: u32 = 800_000;
/// Seconds of processor time, of a build without optimization.
const SECONDS: u32 = 10;

/// Runs the program in a shell that limits it.
fn confined(words: &[&str]) -> Output {
    let script = format!("ulimit -v {MEMORY} && ulimit -t {SECONDS} && exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_durer")]).args(words);
    command.output().unwrap()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| path.is_file()).collect()
}

#[test]
fn bad_files_take_little_and_say_what_is_wrong() {
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/bad");
    let all = [files(&bad), files(&bad.join("files"))].concat();
    assert!(all.len() > 150, "only {} files", all.len());
    for file in all {
        let name = file.to_str().unwrap();
        for words in [&["check", name][..], &["check", name, "--limits", "untrusted"]] {
            let output = confined(words);
            let told = String::from_utf8_lossy(&output.stderr);
            // 0: warnings only; 3: it is wrong. Anything else is a panic, a signal, or memory that was not to be had.
            assert!(matches!(output.status.code(), Some(0 | 3)), "{name}: {}\n{told}", output.status);
            assert!(!told.contains("panicked") && !told.contains("out of memory"), "{name}: {told}");
        }
    }
}

/// A test that cannot fail would be none: what takes memory is seen to fail.
#[test]
fn the_confinement_confines() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("large.yaml");
    std::fs::write(&scene, "picture: {width: 20000, height: 20000}\nrender: {antialias: none}\n").unwrap();
    let picture = folder.path().join("large.png");
    let output = confined(&["render", scene.to_str().unwrap(), "-o", picture.to_str().unwrap()]);
    assert!(!output.status.success(), "a film of 4.8 GB cannot fit");
    assert!(!picture.exists());
}
