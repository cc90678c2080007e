//! The outside world, as far as scene files may reach it: the images, models and tables that they name.
//!
//! Files are read whole. To map them into memory instead would take `unsafe`, and a file that another program cuts short
//! while it is mapped would crash us.

pub(crate) mod memory;

use std::fmt;
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
    /// It is larger than this many bytes.
    TooLarge(u64),
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
            AssetError::TooLarge(_) | AssetError::NotAFile | AssetError::Unavailable | AssetError::Io(_) => None,
        }
    }
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssetError::NotFound => write!(f, "there is no such file"),
            AssetError::Outside(_) => write!(f, "it lies outside the scene's folder"),
            AssetError::TooLarge(limit) => write!(f, "the file is larger than {limit} bytes"),
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

/// The files in and below the scene's folder, and in folders that were allowed by name. What matters is where a file
/// really lies: `..` and links that lead out are refused.
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
        read_whole(&file, max_bytes)
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
        return Err(AssetError::TooLarge(max_bytes));
    }
    let mut bytes = Vec::new();
    // All at once, since growing would copy large files again and again; and where there is too little memory for that,
    // a message is better than an abort.
    let room = usize::try_from(about.len()).unwrap_or(usize::MAX).saturating_add(1);
    bytes.try_reserve_exact(room).map_err(|_| AssetError::Io(io::ErrorKind::OutOfMemory.into()))?;
    let file = std::fs::File::open(path).map_err(AssetError::Io)?;
    // The file may grow while it is read. One byte more than allowed is enough to see that it is too many.
    file.take(max_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(AssetError::Io)?;
    if bytes.len() as u64 > max_bytes {
        return Err(AssetError::TooLarge(max_bytes));
    }
    Ok(bytes)
}

/// The folder of a file without one is the current one.
fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

fn leads_out(relative: &str) -> bool {
    let path = Path::new(relative);
    path.is_absolute() || path.components().any(|part| matches!(part, std::path::Component::ParentDir))
}
