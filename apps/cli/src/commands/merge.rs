//! `durer merge`: films of parts of a picture become one, or the picture.

use super::render::{Job, Manner, Purpose, differences_of_samples};
use super::resume::begun_with;
use crate::exit::{Exit, Failure};
use crate::{numbers, output, target};
use clap::Args;
use durer::{
    Checkpoint, CheckpointError, CheckpointOutline, Film, FilmOutline, MergeError, Merging, Region, SceneHash,
    encode_checkpoint, read_checkpoint, read_checkpoint_outline, write_whole,
};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  durer render room.yaml --sample-range 0..64 -o a.film       on one machine
  durer render room.yaml --sample-range 64..128 -o b.film     on another
  durer merge a.film b.film -o room.png

  durer render room.yaml --crop 0,0,320,480 -o left.film
  durer render room.yaml --crop 320,0,320,480 -o right.film
  durer merge left.film right.film -o whole.film

The films must be of one scene with the same settings (but for `samples`, `noise` and
`time`), and no two may have the same samples of a pixel. What comes of it is, byte for
byte, what one render with all their samples makes; what is missing is told, and black in
a picture. For a picture the scene must be where it was: it says how films are developed.
Films that are not finished, and checkpoints, count for what they have; `durer resume`
finishes them.";

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
    let given = &arguments.films;
    let to_film = target::format_or_film(&arguments.output)?.is_none();
    if let Some(film) = given.iter().find(|film| target::same_place(film, &arguments.output)) {
        let name = film.display();
        return Err(Failure::usage(format!(
            "-o: {name} is one of the films, and is not written over; name another file"
        )));
    }
    let mut films = given.iter().map(|path| Ok((path.clone(), outline(path)?))).collect::<Result<Vec<_>, Failure>>()?;
    // The first one lends its settings to the picture: which that is must not depend on the order in which they are named.
    films.sort_by(|(_, a), (_, b)| (&a.origin.words, &a.origin.folder).cmp(&(&b.origin.words, &b.origin.folder)));
    let (paths, mut outlines): (Vec<PathBuf>, Vec<CheckpointOutline>) = films.into_iter().unzip();
    let paths = &paths;
    let Some(CheckpointOutline { origin, scene, .. }) = outlines.first().cloned() else {
        return Err(Failure::usage("there is no film to merge"));
    };
    for (path, other) in paths.iter().zip(&outlines) {
        let differing = differences_of_samples(&scene, &other.scene);
        if !differing.is_empty() {
            let (path, first) = (path.display(), paths[0].display());
            return Err(Failure::file(format!("cannot merge {path}: it differs from {first} in {differing}")));
        }
    }
    let is_quiet = arguments.manner.is_quiet();
    let film = match &outlines[..] {
        // A picture can be made of what there is so far.
        [one] if !to_film && (one.film.parts.is_empty() || !one.film.is_complete) => {
            let Checkpoint { film, .. } = read(&paths[0])?;
            if !is_quiet {
                tell_unfinished(&paths[0], &film);
            }
            film.as_it_is()
        }
        _ => {
            for (path, outline) in paths.iter().zip(&mut outlines) {
                if outline.film.is_complete || outline.film.parts.is_empty() {
                    continue;
                }
                let Checkpoint { film, .. } = read(path)?;
                if !is_quiet {
                    tell_unfinished(path, &film);
                }
                outline.film = of_what_it_has(path, film)?.outline();
            }
            merged(paths, outlines)?
        }
    };
    if !is_quiet {
        tell_gaps(&film, scene.size());
    }
    if to_film {
        let bytes = encode_checkpoint(&origin, &scene, &film, 0.0);
        let cannot = |error| Failure::file(format!("cannot write {}: {error}", arguments.output.display()));
        write_whole(&arguments.output, &bytes).map_err(cannot)?;
        if !is_quiet {
            let size = numbers::bytes(bytes.len() as u64);
            output::note(&format!("{}: {}, {size}", arguments.output.display(), words_of(&film)));
        }
        return Ok(Exit::Fine);
    }
    let cannot = |why: String| Failure::file(format!("cannot make a picture of {}: {why}", paths[0].display()));
    let mut render = begun_with(&origin).map_err(cannot)?;
    render.developed(&film, Path::new(&origin.folder), arguments.output.clone());
    let purpose = Purpose::Merge(&paths[0]);
    let job = Job { arguments: &render, manner: &arguments.manner, origin: Some(origin.clone()), purpose };
    job.run(Some(Checkpoint { origin, scene, seconds: 0.0, film }))
}

fn outline(path: &Path) -> Result<CheckpointOutline, Failure> {
    read_checkpoint_outline(path).map_err(|error| cannot_merge(path, &error))
}

fn read(path: &Path) -> Result<Checkpoint, Failure> {
    read_checkpoint(path).map_err(|error| cannot_merge(path, &error))
}

fn cannot_merge(path: &Path, error: &CheckpointError) -> Failure {
    let path = path.display();
    Failure::file(match error {
        CheckpointError::AnotherKind => format!(
            "cannot merge {path}: it is no film; films are what `durer render SCENE -o NAME.film` writes, and checkpoints of renders"
        ),
        error => format!("cannot merge {path}: {error}"),
    })
}

/// The film of the samples that one which may not be finished has.
fn of_what_it_has(path: &Path, film: Film) -> Result<Film, Failure> {
    film.of_what_it_has().ok_or_else(|| {
        let path = path.display();
        Failure::file(format!(
            "cannot merge {path}: it is not finished, and what it has is nothing, or in too many pieces; `durer resume {path}` finishes it"
        ))
    })
}

/// One film of all; no more than one of them is held beside it.
fn merged(paths: &[PathBuf], outlines: Vec<CheckpointOutline>) -> Result<Film, Failure> {
    let wrong = |error| Failure::file(describe(error, paths));
    let (scenes, films): (Vec<SceneHash>, Vec<FilmOutline>) =
        outlines.into_iter().map(|outline| (outline.scene, outline.film)).unzip();
    let mut merging = Merging::new(films).map_err(wrong)?;
    for (index, (path, before)) in paths.iter().zip(scenes).enumerate() {
        let Checkpoint { scene, film, .. } = read(path)?;
        if scene != before {
            return Err(wrong(MergeError::Another(index)));
        }
        merging.add(index, &of_what_it_has(path, film)?).map_err(wrong)?;
    }
    Ok(merging.finish())
}

/// What a film has: pixels, and samples of them.
pub(super) fn words_of(film: &Film) -> String {
    let Region { x, y, width, height } = film.region();
    let samples = film.sums().map_or(String::new(), |sums| {
        let (least, most) = sums.least_and_most();
        format!(", {}", numbers::samples_a_pixel(least, most))
    });
    format!("{width} × {height} pixels from {x},{y}{samples}")
}

/// Says how much there is of a film that is not finished.
fn tell_unfinished(path: &Path, film: &Film) {
    let path = path.display();
    let (finished, all) = (film.finished_pixels(), film.region().pixels());
    match film.sums() {
        Some(sums) if !film.is_complete() => {
            let wanted = sums.parts.iter().map(|part| part.samples.count()).max().unwrap_or(0);
            let words = words_of(film);
            output::note(&format!("note: {path} is not finished: {words}, of {wanted}; `durer resume {path}` goes on"));
        }
        None if finished < all => {
            let (finished, all) = (numbers::thousands(finished), numbers::thousands(all));
            output::note(&format!(
                "note: {path} is not finished: {finished} of {all} pixels, the others are black; `durer resume {path}` goes on"
            ));
        }
        Some(_) | None => {}
    }
}

fn describe(error: MergeError, paths: &[PathBuf]) -> String {
    let path = |index: usize| paths.get(index).map_or(String::new(), |path| path.display().to_string());
    match error {
        MergeError::NoSamples(index)
        | MergeError::Unfinished(index)
        | MergeError::OtherKind(index)
        | MergeError::Another(index) => {
            let path = path(index);
            let help = match error {
                MergeError::Unfinished(_) => format!("; `durer resume {path}` finishes it"),
                _ => String::new(),
            };
            format!("cannot merge {path}: {error}{help}")
        }
        MergeError::Overlap { first, second, both: _ } => {
            format!("cannot merge {} and {}: {error}", path(first), path(second))
        }
        // Whatever else may come.
        _ => format!("cannot merge the films: {error}"),
    }
}

/// How many missing pieces are told one by one.
const MOST_TOLD: usize = 20;

/// Says what is missing, of the samples that others have and of the pixels of the picture.
fn tell_gaps(film: &Film, (width, height): (u32, u32)) {
    let (gaps, is_cut) = film.gaps();
    for gap in gaps.iter().take(MOST_TOLD) {
        output::note(&format!("note: {gap} are missing"));
    }
    if let Some(more @ [_, ..]) = gaps.get(MOST_TOLD..) {
        let least = if is_cut { "at least " } else { "" };
        let samples: u64 = more.iter().map(|gap| gap.region.pixels() * u64::from(gap.samples.count())).sum();
        let (pieces, samples) = (more.len(), numbers::thousands(samples));
        output::note(&format!("note: ... and {least}{pieces} more pieces, with {samples} samples in all"));
    }
    let Region { x, y, width: across, height: down } = film.region();
    if (across, down) != (width, height) {
        output::note(&format!("note: these are the pixels {x},{y},{across},{down} of a picture of {width} × {height}"));
    }
}
