//! `cargo xtask bench kernel`: rays a second of durer's kernel, of Embree 4 and of the crates obvhs and bvh, one thread.
//!
//! Each has a program that prints what it measures, one JSON object a line: `benches/kernel` for durer and the crates,
//! `benches/embree` for Embree. All make the same scenes and rays, which is checked by hashes.

pub(crate) mod build;
mod lines;
mod report;

use super::options::Options;
use crate::shell;
use build::Programs;
use lines::Lines;
use std::path::Path;
use std::process::Command;

/// Rounds, if nothing else is asked for.
const ROUNDS: usize = 5;

const SCENES: [&str; 4] = ["terrain", "cave", "soup", "spheres"];

/// How often a program sends each kind of rays in one round, beside once to warm up.
const REPEATS: &str = "1";

/// With this a program builds its tree and sends no ray.
const BUILD_ONLY: &str = "0";

/// Measures and writes the report.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let rounds = options.count("--rounds", ROUNDS)?;
    let scenes = options.names("--scenes", &SCENES)?;
    let programs = build::programs()?;
    let mut lines = Lines::default();
    for round in 1..=rounds {
        for scene in &scenes {
            println!("round {round} of {rounds}: {scene}");
            for mut command in commands(&programs, scene) {
                lines.read(&shell::output(&mut command)?)?;
            }
        }
    }
    super::report::keep("kernel", &report::markdown(&lines, rounds, &scenes, &programs)?)
}

/// What is run in turn for one scene.
fn commands(programs: &Programs, scene: &str) -> Vec<Command> {
    let purposes = [("preview", BUILD_ONLY), ("picture", REPEATS), ("many-rays", REPEATS)];
    let durer = purposes.map(|(purpose, repeats)| command(&programs.durer, &[scene, repeats, purpose]));
    let embree = programs.embree.iter().flat_map(|path| embree(path, scene));
    let crates = [
        ["obvhs-fast", scene, BUILD_ONLY],
        ["obvhs-medium", scene, REPEATS],
        ["obvhs-very-slow", scene, BUILD_ONLY],
        ["bvh", scene, REPEATS],
    ];
    durer.into_iter().chain(embree).chain(crates.map(|words| command(&programs.crates, &words))).collect()
}

fn embree(path: &Path, scene: &str) -> Vec<Command> {
    let of = |scene: &str| {
        let qualities = [("low", BUILD_ONLY), ("medium", REPEATS), ("high", REPEATS), ("robust", REPEATS)];
        qualities.map(|(quality, repeats)| command(path, &[scene, repeats, quality]))
    };
    let user = (scene == "spheres").then_some("user-spheres");
    [Some(scene), user].into_iter().flatten().flat_map(of).collect()
}

fn command(program: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(words);
    command
}
