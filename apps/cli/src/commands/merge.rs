//! `durer merge`: films of parts of a picture become one, or the picture.

use super::render::{Job, Manner};
use super::resume::begun_with;
use crate::exit::{Exit, Failure};
use crate::{output, target};
use clap::Args;
use durer::{Checkpoint, Film, MergeError, Part, encode_checkpoint, read_checkpoint, write_whole};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  durer render room.yaml --sample-range 0..64 -o a.film       on one machine
  durer render room.yaml --sample-range 64..128 -o b.film     on another
  durer merge a.film b.film -o room.png

  durer render room.yaml --crop 0,0,320,480 -o left.film
  durer render room.yaml --crop 320,0,320,480 -o right.film
  durer merge left.film right.film -o whole.film

The films must be of one scene with the same settings, and no two may have the same
samples of a pixel. What comes of it is, byte for byte, what one render with all their
samples makes; what is missing is told. For a picture the scene must be where it was:
it says how films are developed.";

/// Put films of parts of a picture together
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The films
    #[arg(value_name = "FILM", required = true)]
    films: Vec<PathBuf>,

    /// The picture, or a film
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    manner: Manner,
}

/// Merges.
pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let paths = &arguments.films;
    if !target::is_film(&arguments.output) {
        target::format_of(&arguments.output)?;
    }
    if let Some(film) = paths.iter().find(|film| target::same_place(film, &arguments.output)) {
        let name = film.display();
        return Err(Failure::usage(format!(
            "-o: {name} is one of the films, and is not written over; name another file"
        )));
    }
    let mut films = Vec::with_capacity(paths.len());
    let mut first = None;
    for path in paths {
        let Checkpoint { origin, scene, film } = read_checkpoint(path)
            .map_err(|error| Failure::file(format!("cannot merge {}: {error}", path.display())))?;
        match &first {
            None => first = Some((origin, scene)),
            Some((_, other)) if *other == scene => {}
            Some(_) => {
                let (path, other) = (path.display(), paths[0].display());
                let why = "is of another scene, or of other settings";
                return Err(Failure::file(format!("cannot merge {path}: it {why} than {other}")));
            }
        }
        films.push(film);
    }
    let Some((origin, scene)) = first else { return Err(Failure::usage("there is no film to merge")) };
    let film = Film::merge(&films).map_err(|error| Failure::file(describe(error, paths)))?;
    drop(films);
    if !arguments.manner.is_quiet() {
        tell_gaps(&film);
    }
    if target::is_film(&arguments.output) {
        let bytes = encode_checkpoint(&origin, &scene, &film);
        let cannot = |error| Failure::file(format!("cannot write {}: {error}", arguments.output.display()));
        write_whole(&arguments.output, &bytes).map_err(cannot)?;
        return Ok(Exit::Fine);
    }
    let cannot = |why: String| Failure::file(format!("cannot make a picture of {}: {why}", paths[0].display()));
    let mut render = begun_with(&origin).map_err(cannot)?;
    render.developed(&film, Path::new(&origin.folder), arguments.output.clone());
    let job = Job { arguments: &render, manner: &arguments.manner, origin: Some(origin.clone()) };
    job.run(Some(Checkpoint { origin, scene, film }))
}

fn describe(error: MergeError, paths: &[PathBuf]) -> String {
    let path = |index: usize| paths.get(index).map_or(String::new(), |path| path.display().to_string());
    match error {
        MergeError::NoSamples(index) | MergeError::Unfinished(index) | MergeError::OtherKind(index) => {
            let help = if error == MergeError::Unfinished(index) { "; `durer resume` goes on with it" } else { "" };
            format!("cannot merge {}: {error}{help}", path(index))
        }
        MergeError::Overlap { first, second, both: _ } => {
            format!("cannot merge {} and {}: {error}", path(first), path(second))
        }
        // Whatever else may come.
        _ => format!("cannot merge the films: {error}"),
    }
}

/// How many missing pieces are told one by one.
const MOST_TOLD: usize = 4;

fn tell_gaps(film: &Film) {
    let gaps = film.gaps();
    for gap in gaps.iter().take(MOST_TOLD) {
        output::note(&format!("note: {gap} are missing"));
    }
    if gaps.len() > MOST_TOLD {
        let pieces: &[Part] = &gaps[MOST_TOLD..];
        output::note(&format!("note: ... and {} more pieces", pieces.len()));
    }
}
