//! The project's own chores: `cargo xtask bless`, `gallery`, `reproduce`, `fuzz`, `bench`. They use durer; they are not part
//! of it.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "programs may print")]

mod bench;
mod bless;
mod fuzz;
mod gallery;
mod reproduce;
mod shell;

use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask CHORE

  bless [--check]           rewrite docs/scene.schema.json, docs/reference.md and docs/cli.md from the program
  gallery [NAME ...]        render the pictures of docs/gallery (or only these) and write its page
  reproduce [OPTION ...]    render all scenes in every way that must not matter, and compare with scenes/checksums.toml
    --bless                 write scenes/checksums.toml anew
    --threads N             only with so many threads
    --simd LEVEL            only with this instruction set
    --target wasm|aarch64   in WebAssembly under Node, or for AArch64 under QEMU
    --where-possible        where a tool is missing, say so and go on
    --list                  print the fingerprints and compare nothing";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(words: &[&str]) -> Result<(), String> {
    match words {
        ["bless"] => bless::run(),
        ["bless", "--check"] => bless::check(),
        ["gallery", names @ ..] => gallery::run(names),
        ["reproduce", options @ ..] => reproduce::run(options),
        ["fuzz", rest @ ..] => fuzz::run(rest),
        [] | ["help" | "--help" | "-h"] => {
            println!("{}", usage());
            Ok(())
        }
        ["bench", rest @ ..] => bench::run(rest).unwrap_or_else(|| unknown(words)),
        _ => unknown(words),
    }
}

fn unknown(words: &[&str]) -> Result<(), String> {
    Err(format!("unknown chore `{}`\n\n{}", words.join(" "), usage()))
}

fn usage() -> String {
    [USAGE, fuzz::USAGE, bench::USAGE].join("\n")
}
