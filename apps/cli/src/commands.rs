//! The subcommands, one module each.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod develop;
pub(crate) mod explain;
pub(crate) mod heatmap;
pub(crate) mod info;
pub(crate) mod man;
pub(crate) mod merge;
pub(crate) mod render;
pub(crate) mod resume;
mod schema;

use crate::args::Command;
use crate::exit::{Exit, Failure};

/// Runs what was asked for.
pub(crate) fn run(command: &Command) -> Result<Exit, Failure> {
    match command {
        Command::Render(arguments) => render::run(arguments),
        Command::Resume(arguments) => resume::run(arguments),
        Command::Merge(arguments) => merge::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Info(arguments) => info::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Heatmap(arguments) => heatmap::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Develop(arguments) => develop::run(arguments),
        Command::Schema => schema::run(),
        Command::Completions(arguments) => completions::run(arguments),
        Command::Man(arguments) => man::run(arguments),
    }
}
