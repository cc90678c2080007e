//! `durer resume`: goes on with a render that was cut short.

use super::render::{self, Job, Manner, Purpose};
use crate::args::{Cli, Command};
use crate::exit::{Exit, Failure};
use clap::{Args, Parser};
use durer::{Origin, read_checkpoint};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  durer resume room.png.durer-checkpoint
  durer resume night.checkpoint --threads 2 --progress json

The checkpoint knows the scene, its settings and the picture file; the picture is, byte
for byte, that of a render that was never cut short. If the scene or one of its files has
changed since, that is an error. The checkpoint is removed when the picture is written.";

/// Go on with a render from its checkpoint
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The checkpoint
    #[arg(value_name = "FILE")]
    checkpoint: PathBuf,

    #[command(flatten)]
    manner: Manner,
}

/// Goes on.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let path = &arguments.checkpoint;
    let cannot = |why: String| Failure::file(format!("cannot go on with {}: {why}", path.display()));
    let checkpoint = read_checkpoint(path).map_err(|error| cannot(error.to_string()))?;
    let origin = checkpoint.origin.clone();
    let mut render = begun_with(&origin).map_err(cannot)?;
    if checkpoint.film.is_complete() && render.writes_film() {
        return Err(cannot("it is a finished film, of which `durer merge` makes a picture".to_owned()));
    }
    render.resumed_in(Path::new(&origin.folder), path);
    let purpose = Purpose::Render;
    Job { arguments: &render, manner: &arguments.manner, origin: Some(origin), purpose }.run(Some(checkpoint))
}

/// What a render was begun with.
pub(super) fn begun_with(origin: &Origin) -> Result<render::Arguments, String> {
    let words = ["durer", "render"].into_iter().chain(origin.words.iter().map(String::as_str));
    match Cli::try_parse_from(words) {
        Ok(Cli { command: Command::Render(render) }) => Ok(render),
        Ok(_) => Err("it does not say how it was begun".to_owned()),
        // Among them an instruction set that this machine lacks.
        Err(error) => Err(format!("what it was begun with does not work here: {}", error.render())),
    }
}
