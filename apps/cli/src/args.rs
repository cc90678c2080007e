//! What can be typed.

use crate::commands::{check, compare, completions, develop, explain, heatmap, info, man, merge, render, resume};
use crate::exit::EXIT_CODES;
use clap::{Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  durer render room.yaml                     writes room.png
  durer render room.yaml -o room.exr --width 1920
  durer render model.glb
  durer check room.yaml
  durer explain room.yaml --pixel 120,43";

/// True pictures of geometry: a ray tracer with exact shapes.
#[derive(Debug, Parser)]
#[command(name = "durer", version, max_term_width = 100)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Render(render::Arguments),
    Resume(resume::Arguments),
    Merge(merge::Arguments),
    Check(check::Arguments),
    Info(info::Arguments),
    Explain(explain::Arguments),
    Heatmap(heatmap::Arguments),
    Compare(compare::Arguments),
    Develop(develop::Arguments),
    /// Print the JSON Schema of scene files
    #[command(after_help = "Example:\n  durer schema > scene.schema.json\n\n\
        Editors complete and check scenes whose first line is\n  # yaml-language-server: $schema=scene.schema.json")]
    Schema,
    Completions(completions::Arguments),
    Man(man::Arguments),
}
