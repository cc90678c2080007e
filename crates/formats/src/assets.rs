//! The outside world, as far as scene files may reach it: the images, models and tables that they name.
//!
//! Files are read whole. To map them into memory instead would take `unsafe`, and a file that another program cuts short
//! while it is mapped would crash us.

pub(crate) mod memory;

use crate::{Exceeded, Limit, Limits};
use std::cell::Cell;
use std::fmt;
use std::fs::Metadata;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Where the files come from that a scene names. The page in a browser has another one than the command line.
pub trait Assets {
    /// The bytes of the file that a scene calls `relative`, at most `max_bytes` of them.
    ///
    /// # Errors
    ///
    /// If there is no such file, it may not be read, or it is larger.
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError>;
}

/// Why a file cannot be had.
#[derive(Debug)]
#[non_exhaustive]
pub enum AssetError {
    /// There is no such file.
    NotFound,
    /// It lies outside the folders that may be read; the path it leads to.
    Outside(PathBuf),
    /// It is larger than allowed: so many bytes, or more.
    TooLarge(u64),
    /// With it, the scene asks for more than it may.
    Exceeded(Exceeded),
    /// It is not a file, but a folder, a device or the like.
    NotAFile,
    /// No files can be read here.
    Unavailable,
    /// The system refuses.
    Io(io::Error),
}

impl AssetError {
    /// What to do about it.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            AssetError::NotFound => Some("names are relative to the folder of the scene file".to_owned()),
            AssetError::Outside(path) => {
                let folder = path.parent().unwrap_or(path).display();
                Some(format!("if you trust this scene, allow the folder: `--allow-path {folder}`"))
            }
            AssetError::Exceeded(exceeded) => Some(exceeded.help()),
            AssetError::NotAFile => Some("name a file, not a folder or a device".to_owned()),
            AssetError::TooLarge(_) | AssetError::Unavailable | AssetError::Io(_) => None,
        }
    }
}

impl AssetError {
    /// Says which limit it is that a file is too large for.
    pub(crate) fn with_limit(self, limit: Limit, limits: &Limits) -> AssetError {
        match self {
            AssetError::TooLarge(bytes) => {
                AssetError::Exceeded(Exceeded { limit, asked: Some(bytes), allowed: limits.get(limit) })
            }
            other => other,
        }
    }
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssetError::NotFound => write!(f, "there is no such file"),
            AssetError::Outside(_) => write!(f, "it lies outside the scene's folder"),
            AssetError::TooLarge(bytes) => write!(f, "its {bytes} bytes are too many"),
            AssetError::Exceeded(exceeded) => write!(f, "{exceeded}"),
            AssetError::NotAFile => write!(f, "this is not a file"),
            AssetError::Unavailable => write!(f, "no files can be read here"),
            AssetError::Io(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for AssetError {}

/// No files at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoAssets;

impl Assets for NoAssets {
    fn read(&self, _: &str, _: u64) -> Result<Vec<u8>, AssetError> {
        Err(AssetError::Unavailable)
    }
}

/// The files of others, as far as the limits go: for each file, for all together, and for memory, since files are read
/// whole.
pub(crate) struct Metered<'a> {
    inner: &'a dyn Assets,
    limits: &'a Limits,
    /// Bytes read so far.
    taken: Cell<u64>,
}

impl<'a> Metered<'a> {
    /// Nothing has been read.
    pub(crate) fn new(inner: &'a dyn Assets, limits: &'a Limits) -> Metered<'a> {
        Metered { inner, limits, taken: Cell::new(0) }
    }
}

impl Assets for Metered<'_> {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let taken = self.taken.get();
        let left = |limit: Limit| (self.limits.get(limit).saturating_sub(taken), limit, taken);
        let file = (self.limits.max_file_bytes, Limit::File, 0);
        let [a, b, c] = [file, left(Limit::Files), left(Limit::Memory)];
        let (least, limit, taken) =
            [b, c].into_iter().fold(a, |least, other| if other.0 < least.0 { other } else { least });
        match self.inner.read(relative, max_bytes.min(least)) {
            Ok(bytes) => {
                self.taken.set(self.taken.get().saturating_add(bytes.len() as u64));
                Ok(bytes)
            }
            Err(AssetError::TooLarge(bytes)) => {
                let asked = Some(taken.saturating_add(bytes));
                Err(AssetError::Exceeded(Exceeded { limit, asked, allowed: self.limits.get(limit) }))
            }
            Err(error) => Err(error),
        }
    }
}

/// The files in and below the scene's folder, and in folders that were allowed by name. What matters is where a file
/// really lies: `..` and links that lead out are refused.
///
/// A file is looked at before it is opened, since opening a pipe or a device may wait forever; once it is open, that it is
/// still the one that was looked at and still lies where it lay. Who can change the folder twice in the moment between
/// could get past that; where others can write into the scene's folder, copy it first. Hard links are files of the folder.
#[derive(Clone, Debug)]
pub struct FolderAssets {
    folder: PathBuf,
    allowed: Vec<PathBuf>,
}

impl FolderAssets {
    /// The files in and below `folder`.
    pub fn new(folder: impl Into<PathBuf>) -> FolderAssets {
        FolderAssets { folder: folder.into(), allowed: Vec::new() }
    }

    /// Also those in and below `folder`.
    #[must_use]
    pub fn allow(mut self, folder: impl Into<PathBuf>) -> FolderAssets {
        self.allowed.push(folder.into());
        self
    }

    fn may_read(&self, file: &Path) -> bool {
        let folders = std::iter::once(&self.folder).chain(&self.allowed);
        folders.filter_map(|folder| or_here(folder).canonicalize().ok()).any(|folder| file.starts_with(folder))
    }
}

impl Assets for FolderAssets {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let path = or_here(&self.folder).join(relative);
        let file = match path.canonicalize() {
            Ok(file) => file,
            // Whether a file outside exists is nobody's business.
            Err(_) if leads_out(relative) => return Err(AssetError::Outside(path)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(AssetError::NotFound),
            Err(error) => return Err(AssetError::Io(error)),
        };
        if !self.may_read(&file) {
            return Err(AssetError::Outside(file));
        }
        let bytes = read_whole(&file, max_bytes)?;
        // Someone may have put a link in the place of the file, or of a folder on the way to it, just before it was opened.
        match file.canonicalize() {
            Ok(still) if still == file => Ok(bytes),
            Ok(other) => Err(AssetError::Outside(other)),
            Err(error) => Err(AssetError::Io(error)),
        }
    }
}

/// The bytes of the file at `path`, which may lie anywhere.
pub(crate) fn read_whole(path: &Path, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
    // Opening a pipe would wait forever: look first.
    let about = std::fs::metadata(path).map_err(AssetError::Io)?;
    if !about.is_file() {
        return Err(AssetError::NotAFile);
    }
    if about.len() > max_bytes {
        return Err(AssetError::TooLarge(about.len()));
    }
    let mut bytes = Vec::new();
    // All at once, since growing would copy large files again and again; and where there is too little memory for that,
    // a message is better than an abort.
    let room = usize::try_from(about.len()).unwrap_or(usize::MAX).saturating_add(1);
    bytes.try_reserve_exact(room).map_err(|_| AssetError::Io(io::ErrorKind::OutOfMemory.into()))?;
    let file = std::fs::File::open(path).map_err(AssetError::Io)?;
    // Another may have taken its place.
    if !file.metadata().is_ok_and(|opened| is_same(&about, &opened)) {
        return Err(AssetError::NotAFile);
    }
    // The file may grow while it is read. One byte more than allowed is enough to see that it is too many.
    file.take(max_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(AssetError::Io)?;
    if bytes.len() as u64 > max_bytes {
        return Err(AssetError::TooLarge(bytes.len() as u64));
    }
    Ok(bytes)
}

/// True if both are about the same file, as far as the system tells.
#[cfg(unix)]
fn is_same(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(not(unix))]
fn is_same(one: &Metadata, other: &Metadata) -> bool {
    one.file_type() == other.file_type()
}

/// The folder of a file without one is the current one.
fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

fn leads_out(relative: &str) -> bool {
    let path = Path::new(relative);
    path.is_absolute() || path.components().any(|part| matches!(part, std::path::Component::ParentDir))
}
