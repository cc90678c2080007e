//! `cargo xtask fuzz`: tries made-up input, target by target.
//!
//! Builds the targets as cargo-fuzz does without a sanitizer, so that stable Rust is enough and cargo-fuzz need not be
//! there; `cargo fuzz run -s none TARGET` finds the same folders.

mod mutants;

use crate::shell;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) const USAGE: &str = "  \
  fuzz [--seconds N | --tries N] [TARGET ...]
                            try made-up input: each target, or only these, for 30 seconds or N, led by what it reaches
                            in the code; or N tries that are the same each time";

/// The instrumentation of cargo-fuzz: the fuzzer learns which branches were taken and what was compared with what.
/// Overflow and failed assertions count as findings.
const FLAGS: [&str; 10] = [
    "-Cno-vectorize-slp",
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    "-Ccodegen-units=1",
    "-Cdebug-assertions",
    "-Coverflow-checks",
    "--cfg=fuzzing",
];

/// A try that takes longer, in seconds, is a finding; so is one that takes more memory, in MiB.
const MOST_SECONDS: u32 = 10;
const MOST_MEMORY: u32 = 2048;

/// So many lines of what the fuzzer says of a finding are shown.
const MOST_LINES: usize = 60;

/// What is to be done.
struct Plan<'a> {
    length: Length,
    targets: Vec<&'a str>,
}

/// How long a target is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Length {
    /// With luck of its own each time, and what earlier runs have gathered.
    Seconds(u32),
    /// The same tries each time, so that only a change of the code or of the seeds can bring a finding. The fuzzer's own
    /// never are: they are led by what the code does, and that depends on addresses and on the order of hash tables.
    Tries(u32),
}

/// Fuzzes.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let plan = Plan::of(words)?;
    let folder = shell::root().join("fuzz");
    let built = build(&folder)?;
    for target in plan.targets {
        fuzz(&folder, &built, target, plan.length)?;
    }
    Ok(())
}

impl<'a> Plan<'a> {
    fn of(words: &[&'a str]) -> Result<Plan<'a>, String> {
        let number = |word: &str| word.parse().map_err(|_| format!("`{word}` is no number"));
        let (length, names) = match words {
            ["--seconds", seconds, names @ ..] => (Length::Seconds(number(seconds)?), names),
            ["--tries", tries, names @ ..] => (Length::Tries(number(tries)?), names),
            names => (Length::Seconds(30), names),
        };
        let known = durer_trials::TARGETS.map(|(name, _)| name);
        if let Some(unknown) = names.iter().find(|name| !known.contains(name)) {
            return Err(format!("there is no target `{unknown}`, only {}", known.join(", ")));
        }
        Ok(Plan { length, targets: if names.is_empty() { known.to_vec() } else { names.to_vec() } })
    }
}

/// Builds all targets; gives the folder that they are in.
fn build(folder: &Path) -> Result<PathBuf, String> {
    let target_folder = folder.join("target");
    let mut build = shell::cargo(&["build", "--quiet", "--release", "--bins", "--manifest-path"]);
    build.arg(folder.join("Cargo.toml")).arg("--target-dir").arg(&target_folder);
    // With a target named, the flags are not for build scripts.
    let host = host()?;
    build.args(["--target", &host]).env("CARGO_ENCODED_RUSTFLAGS", FLAGS.join("\u{1f}"));
    shell::run(&mut build)?;
    Ok(target_folder.join(host).join("release"))
}

/// The triple of this machine.
fn host() -> Result<String, String> {
    let about = shell::output(Command::new("rustc").arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not say what machine this is".to_owned())
}

fn fuzz(folder: &Path, built: &Path, target: &str, length: Length) -> Result<(), String> {
    let findings = folder.join("artifacts").join(target);
    create(&findings)?;
    let mut command = Command::new(built.join(target));
    match length {
        Length::Seconds(seconds) => {
            let corpus = folder.join("corpus").join(target);
            create(&corpus)?;
            command.arg(corpus).arg(format!("-max_total_time={seconds}"));
        }
        Length::Tries(tries) => {
            let made = built.join("tries").join(target);
            make_mutants(&seeds(folder, target), &made, tries)?;
            command.arg(made).arg("-runs=0");
        }
    }
    command.args(seeds(folder, target));
    command.arg(format!("-artifact_prefix={}/", findings.display()));
    command.arg(format!("-timeout={MOST_SECONDS}"));
    command.args([format!("-rss_limit_mb={MOST_MEMORY}"), format!("-max_len={}", mutants::MOST_BYTES)]);
    let output = command.output().map_err(|error| format!("{target}: {error}"))?;
    // Thousands of lines, of which one tells, unless something was found.
    let told = String::from_utf8_lossy(&output.stderr);
    if output.status.success() {
        let done = told.lines().find(|line| line.contains("DONE")).unwrap_or_default();
        println!("{target}: {}", done.split_whitespace().collect::<Vec<_>>().join(" "));
        return Ok(());
    }
    let lines: Vec<&str> = told.lines().collect();
    let end = lines[lines.len().saturating_sub(MOST_LINES)..].join("\n");
    let folder = findings.display();
    Err(format!(
        "{target}: {}\n{end}\nmend it, and move the file from {folder} to fuzz/regressions/{target}",
        output.status
    ))
}

/// Fills the folder with so many mutants of what is in these.
fn make_mutants(seeds: &[PathBuf], folder: &Path, count: u32) -> Result<(), String> {
    let wrong = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    let mut files = Vec::new();
    for seeds in seeds {
        for file in std::fs::read_dir(seeds).map_err(|error| wrong(seeds, error))? {
            files.push(file.map_err(|error| wrong(seeds, error))?.path());
        }
    }
    files.retain(|path| path.is_file());
    files.sort_unstable();
    let read = |path: &PathBuf| std::fs::read(path).map_err(|error| wrong(path, error));
    let seeds = files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    if seeds.is_empty() {
        return Err("there are no seeds to make tries of".to_owned());
    }
    let _ = std::fs::remove_dir_all(folder);
    create(folder)?;
    for number in 0..count {
        let path = folder.join(format!("{number:07}"));
        std::fs::write(&path, mutants::mutant(&seeds, number)).map_err(|error| wrong(&path, error))?;
    }
    Ok(())
}

fn create(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// The folders that the fuzzer begins with beside what it has gathered.
fn seeds(folder: &Path, target: &str) -> Vec<PathBuf> {
    let mut seeds = vec![folder.join("seeds").join(target), folder.join("regressions").join(target)];
    if target == "scene" {
        seeds.extend(["scenes", "tests/bad"].map(|folder| shell::root().join(folder)));
    }
    seeds.retain(|folder| folder.is_dir());
    seeds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_are_read() {
        let plan = Plan::of(&["--seconds", "7", "obj", "stl"]).unwrap();
        assert_eq!((plan.length, plan.targets), (Length::Seconds(7), vec!["obj", "stl"]));
        assert_eq!(Plan::of(&["--tries", "9"]).unwrap().length, Length::Tries(9));
        assert_eq!(Plan::of(&[]).unwrap().targets.len(), durer_trials::TARGETS.len());
        assert!(Plan::of(&["obje"]).is_err() && Plan::of(&["--seconds", "x"]).is_err());
    }
}
