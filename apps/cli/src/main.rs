//! The program `durer`: what was typed becomes calls of the façade, and what it answers becomes text, files and an exit
//! code. One module for each subcommand.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "programs may print")]

mod args;
mod commands;
mod exit;
mod interrupt;
mod labels;
mod load;
mod numbers;
mod output;
mod overrides;
mod pace;
mod progress;
mod provenance;
mod target;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = args::Cli::try_parse().map_err(exit::Failure::from).and_then(|cli| commands::run(&cli.command));
    match outcome {
        Ok(exit) => exit.into(),
        Err(failure) => failure.tell(),
    }
}
