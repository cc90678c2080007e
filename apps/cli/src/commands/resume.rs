//! `durer resume`: goes on with a render that was cut short.

use super::render::{self, Job, Manner, Purpose};
use crate::args::{Cli, Command};
use crate::exit::{Exit, Failure};
use crate::target;
use clap::{Args, Parser};
use durer::{CheckpointOutline, Origin, read_checkpoint, read_checkpoint_outline};
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
    let folder = Path::new(&origin.folder);
    if target::same_place(&folder.join(render.output_path()), path) {
        return Err(cannot("it lies where what it becomes is written; give it another name first".to_owned()));
    }
    let beside = folder.join(render.checkpoint_path());
    let begun =
        CheckpointOutline { origin: origin.clone(), scene: checkpoint.scene.clone(), film: checkpoint.film.outline() };
    render.resumed_in(folder, path);
    let purpose = Purpose::Render;
    let job = Job { arguments: &render, manner: &arguments.manner, origin: Some(origin), purpose };
    let exit = job.run(Some(checkpoint))?;
    if !target::same_place(&beside, path) {
        remove_outlived(&beside, &begun);
    }
    Ok(exit)
}

/// Removes the checkpoint that the same render wrote besides: what was gone on with may be the film of an interrupted render,
/// or a copy.
fn remove_outlived(path: &Path, begun: &CheckpointOutline) {
    let is_of_the_same = |other: &CheckpointOutline| {
        other.origin == begun.origin
            && other.scene == begun.scene
            && (other.film.region, &other.film.parts) == (begun.film.region, &begun.film.parts)
    };
    if read_checkpoint_outline(path).is_ok_and(|other| is_of_the_same(&other)) {
        super::render::remove_checkpoint(path);
    }
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
