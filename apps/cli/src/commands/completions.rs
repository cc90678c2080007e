//! `durer completions`: scripts that let a shell complete what is typed.

use crate::args::Cli;
use crate::exit::{Exit, Failure};
use crate::output;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

const EXAMPLES: &str = "\
Examples:
  durer completions bash > ~/.local/share/bash-completion/completions/durer
  durer completions zsh > ~/.zfunc/_durer
  durer completions fish > ~/.config/fish/completions/durer.fish";

/// Print a script that completes commands in a shell
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The shell
    shell: Shell,
}

/// Prints the script.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "durer", &mut script);
    output::print(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Fine)
}
