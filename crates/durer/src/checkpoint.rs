//! Checkpoints: a film that is not finished, in a file, with all that it takes to go on with it.
//!
//! Their bytes are described in `docs/checkpoint.md`.

mod format;

use crate::SceneHash;
use durer_render::{Film, FilmOutline};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

pub use format::encode_checkpoint;

/// A film that is not finished, and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// How it was begun.
    pub origin: Origin,
    /// The scene that it is a picture of.
    pub scene: SceneHash,
    /// The seconds that it has taken so far; 0 if it is finished.
    pub seconds: f64,
    /// What is finished.
    pub film: Film,
}

/// What a checkpoint says of its film before the film itself, which may be large.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckpointOutline {
    /// How it was begun.
    pub origin: Origin,
    /// The scene that it is a picture of.
    pub scene: SceneHash,
    /// What must be known before other films are put to it.
    pub film: FilmOutline,
}

/// How a render was begun, in the words of the program that began it. The library keeps them and reads nothing into them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The folder that paths in the words are relative to.
    pub folder: String,
    /// What was asked for.
    pub words: Vec<String>,
}

/// Why there is no going on with a checkpoint.
#[derive(Debug)]
#[non_exhaustive]
pub enum CheckpointError {
    /// It is a file of another kind.
    AnotherKind,
    /// Its format is of this version, which we do not know.
    OtherFormat(u32),
    /// It was made by this other version of durer, whose pixels may differ.
    OtherVersion(String),
    /// Its bytes are not those that were written, or some are missing.
    Damaged,
    /// The system refused.
    Io(io::Error),
}

/// The most bytes of a file: more than the largest picture takes.
const MOST_BYTES: u64 = 8 << 30;

/// Reads a checkpoint.
///
/// # Errors
///
/// It cannot be read, or is none that this version of durer can go on with.
pub fn read_checkpoint(path: &Path) -> Result<Checkpoint, CheckpointError> {
    let (bytes, _) = read_first(path, MOST_BYTES)?;
    Checkpoint::decode(&bytes)
}

/// The first bytes of a file, in which the outline is to be found; if names are very long, in so many.
const FIRST_BYTES: [u64; 2] = [1 << 20, 1 << 28];

/// Reads the first bytes of a checkpoint. Whether the others are right only [`read_checkpoint`] finds out; but there are as many
/// as the film needs, so that what is made for the film takes no more than a small multiple of its file.
///
/// # Errors
///
/// They cannot be read, or are not those of a checkpoint that this version of durer can go on with.
pub fn read_checkpoint_outline(path: &Path) -> Result<CheckpointOutline, CheckpointError> {
    let first = |most: u64| {
        let (bytes, length) = read_first(path, most)?;
        CheckpointOutline::decode(&bytes, length.min(MOST_BYTES))
    };
    match first(FIRST_BYTES[0]) {
        Err(CheckpointError::Damaged) => first(FIRST_BYTES[1]),
        outline => outline,
    }
}

/// The first bytes of a file, and how many it has in all.
fn read_first(path: &Path, most: u64) -> Result<(Vec<u8>, u64), CheckpointError> {
    let metadata = std::fs::metadata(path).map_err(CheckpointError::Io)?;
    if !metadata.is_file() {
        return Err(CheckpointError::AnotherKind);
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)).map_err(CheckpointError::Io)?;
    Ok((bytes, metadata.len()))
}

impl std::fmt::Display for CheckpointError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ours = env!("CARGO_PKG_VERSION");
        match self {
            CheckpointError::AnotherKind => write!(f, "this is no checkpoint of durer"),
            CheckpointError::OtherFormat(version) => {
                write!(f, "its format has the version {version}; durer {ours} knows none but {}", format::VERSION)
            }
            CheckpointError::OtherVersion(theirs) => {
                write!(f, "it was made by durer {theirs}; this is durer {ours}, whose pixels may differ")
            }
            CheckpointError::Damaged => write!(f, "it is damaged: its bytes are not those that were written"),
            CheckpointError::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for CheckpointError {}

#[cfg(test)]
mod tests;
