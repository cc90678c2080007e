//! `durer man`: manual pages.

use crate::args::Cli;
use crate::exit::{Exit, Failure};
use crate::output;
use clap::{Args, CommandFactory};

const EXAMPLES: &str = "\
Examples:
  durer man | man -l -
  durer man render > durer-render.1";

/// Print the manual page of durer, or of one of its commands
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The command, for example `render`
    command: Option<String>,
}

/// Prints the page.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut durer = Cli::command();
    durer.build();
    let page = match &arguments.command {
        None => durer,
        Some(name) => match durer.find_subcommand(name) {
            // Subcommands are called `durer-render` by `build`, as their pages are.
            Some(command) => command.clone(),
            None => return Err(Failure::usage(format!("there is no command `{name}`"))),
        },
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(|error| Failure::file(error.to_string()))?;
    output::print(&String::from_utf8_lossy(&text))?;
    Ok(Exit::Fine)
}
