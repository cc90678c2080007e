//! Picture files: written whole or not at all.

use crate::whole::{self, temporary_beside};
use durer_imaging::{
    BEAUTY, Bitmap, DecodeError, DecodeLimits, EncodeError, EncodeOptions, FileFacts, FileFormat, Image, LayerFacts,
    Layers, Transfer, about, decode, decode_layers, encode, encode_layers, encode_with_alpha, layer_facts,
};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

/// A place for a picture, found to be writable before any work is done for it.
///
/// The picture is written beside it under a temporary name and then renamed, so that a failed run leaves either the
/// old file or none, never half a one. Dropping it without [`PictureFile::write`] leaves nothing behind.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    temporary: PathBuf,
    file: Option<File>,
}

/// Why a picture could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteError {
    /// The picture does not fit the format.
    Encode(EncodeError),
    /// The folder that it is to lie in does not exist.
    NoFolder {
        /// The picture.
        path: PathBuf,
        /// The folder.
        folder: PathBuf,
    },
    /// The disk is full, or files may not be so large.
    NoRoom {
        /// The picture.
        path: PathBuf,
        /// The bytes that it may take.
        bytes: u64,
        /// The system's words.
        error: io::Error,
    },
    /// The system refused.
    Io {
        /// The file it refused.
        path: PathBuf,
        /// Its words.
        error: io::Error,
    },
}

/// Why a picture could not be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReadError {
    /// It is not a picture that we know.
    Decode(PathBuf, DecodeError),
    /// The system refused.
    Io(PathBuf, io::Error),
}

impl PictureFile {
    /// Makes sure that a file can be written at `path`, by opening a temporary one beside it.
    pub fn create(path: &Path) -> Result<PictureFile, WriteError> {
        let io = |error| WriteError::Io { path: path.to_owned(), error };
        path.file_name().ok_or_else(|| io(io::ErrorKind::InvalidFilename.into()))?;
        if path.is_dir() {
            return Err(io(io::ErrorKind::IsADirectory.into()));
        }
        let temporary = temporary_beside(path);
        let file = whole::create(path).map_err(|error| match missing_folder(path) {
            Some(folder) => WriteError::NoFolder { path: path.to_owned(), folder: folder.to_owned() },
            None => io(error),
        })?;
        Ok(PictureFile { path: path.to_owned(), temporary, file: Some(file) })
    }

    /// Fills the temporary file with so many bytes, so that the picture has room in the end, whatever else is written to
    /// the disk until then.
    ///
    /// # Errors
    ///
    /// There is not so much room.
    pub fn reserve(&mut self, bytes: u64) -> Result<(), WriteError> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let filled = whole::fill(file, bytes).and_then(|()| file.rewind());
        filled.map_err(|error| WriteError::NoRoom { path: self.path.clone(), bytes, error })
    }

    /// The file that is there until the picture is written.
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// Gives the picture another name, in the same folder.
    #[must_use]
    pub fn with_name(mut self, name: &OsStr) -> PictureFile {
        self.path.set_file_name(name);
        self
    }

    /// Writes the picture and gives it its name; gives the number of bytes.
    pub fn write(self, image: &Image, options: &EncodeOptions) -> Result<usize, WriteError> {
        let bytes = encode(image, options).map_err(WriteError::Encode)?;
        self.write_bytes(&bytes)
    }

    /// As [`PictureFile::write`], of a picture of which only a part is there; see [`encode_with_alpha`].
    pub fn write_with_alpha(self, image: &Image, alpha: &[f32], options: &EncodeOptions) -> Result<usize, WriteError> {
        let bytes = encode_with_alpha(image, alpha, options).map_err(WriteError::Encode)?;
        self.write_bytes(&bytes)
    }

    /// Writes layers, as EXR whatever the file is called, and gives the file its name; gives the number of bytes.
    pub fn write_layers(self, layers: Layers, options: &EncodeOptions) -> Result<usize, WriteError> {
        let bytes = encode_layers(layers, options).map_err(WriteError::Encode)?;
        self.write_bytes(&bytes)
    }

    /// Writes these bytes and gives the file its name; gives their number.
    pub fn write_bytes(mut self, bytes: &[u8]) -> Result<usize, WriteError> {
        // What was reserved is written over first and cut off then, so that no one else can take the room; and the file
        // stays open, and so locked, until it has its name.
        let written = match &mut self.file {
            Some(file) => file.write_all(bytes).and_then(|()| file.set_len(bytes.len() as u64)),
            None => Ok(()),
        };
        let synced = written.and_then(|()| self.file.as_ref().map_or(Ok(()), File::sync_all));
        synced
            .and_then(|()| fs::rename(&self.temporary, &self.path))
            .map_err(|error| WriteError::Io { path: self.path.clone(), error })?;
        Ok(bytes.len())
    }
}

impl Drop for PictureFile {
    fn drop(&mut self) {
        self.file = None;
        // After a successful rename there is nothing to remove.
        let _ = fs::remove_file(&self.temporary);
    }
}

fn missing_folder(path: &Path) -> Option<&Path> {
    path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists())
}

/// Reads a picture file of any format that we know.
pub fn read_picture(path: &Path, limits: &DecodeLimits) -> Result<Bitmap, ReadError> {
    let bytes = fs::read(path).map_err(|error| ReadError::Io(path.to_owned(), error))?;
    decode(&bytes, limits).map_err(|error| ReadError::Decode(path.to_owned(), error))
}

/// Reads the layers of a picture file, or `only` that of this name; without such a layer the picture comes without layers. In
/// files other than EXR the beauty is the only one.
pub fn read_layers(path: &Path, only: Option<&str>, limits: &DecodeLimits) -> Result<Layers, ReadError> {
    let bytes = fs::read(path).map_err(|error| ReadError::Io(path.to_owned(), error))?;
    let wrong = |error| ReadError::Decode(path.to_owned(), error);
    if about(&bytes).map_err(wrong)?.format == FileFormat::Exr {
        return decode_layers(&bytes, only, limits).map_err(wrong);
    }
    let mut layers = Layers::of_bitmap(&decode(&bytes, limits).map_err(wrong)?, Transfer::Srgb);
    layers.layers.retain(|layer| only.is_none_or(|only| only == layer.name));
    Ok(layers)
}

/// The layers that a picture file has.
pub fn picture_layers(path: &Path) -> Result<Vec<LayerFacts>, ReadError> {
    let bytes = fs::read(path).map_err(|error| ReadError::Io(path.to_owned(), error))?;
    let wrong = |error| ReadError::Decode(path.to_owned(), error);
    let FileFacts { format, width, height, .. } = about(&bytes).map_err(wrong)?;
    match format {
        FileFormat::Exr => layer_facts(&bytes).map_err(wrong),
        FileFormat::Png | FileFormat::Jpeg | FileFormat::Hdr | FileFormat::Pfm => {
            Ok(vec![LayerFacts { name: BEAUTY.to_owned(), width, height, channels: Vec::new() }])
        }
    }
}

/// What the header of a picture file says.
pub fn picture_facts(path: &Path) -> Result<FileFacts, ReadError> {
    let bytes = fs::read(path).map_err(|error| ReadError::Io(path.to_owned(), error))?;
    about(&bytes).map_err(|error| ReadError::Decode(path.to_owned(), error))
}

impl std::fmt::Display for WriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            WriteError::Encode(error) => error.fmt(f),
            WriteError::NoFolder { path, folder } => {
                let (path, folder) = (path.display(), folder.display());
                write!(f, "cannot write {path}: there is no folder `{folder}`; create it first")
            }
            WriteError::NoRoom { path, bytes, error } => {
                let path = path.display();
                write!(f, "cannot write {path}, which may take {bytes} bytes: {error}")
            }
            WriteError::Io { path, error } => write!(f, "cannot write {}: {error}", path.display()),
        }
    }
}

impl std::error::Error for WriteError {}

impl std::fmt::Display for ReadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ReadError::Decode(path, error) => write!(f, "cannot read {}: {error}", path.display()),
            ReadError::Io(path, error) => write!(f, "cannot read {}: {error}", path.display()),
        }
    }
}

impl std::error::Error for ReadError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_abandoned_picture_leaves_nothing_and_a_written_one_only_itself() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let names = || fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect::<Vec<_>>();
        drop(PictureFile::create(&path).unwrap());
        assert!(names().is_empty());
        let written = PictureFile::create(&path).unwrap().write(&Image::new(2, 2), &EncodeOptions::default()).unwrap();
        assert_eq!(names(), ["a.png"]);
        assert_eq!(fs::metadata(&path).unwrap().len(), written as u64);
    }

    #[test]
    fn a_picture_with_another_name_leaves_the_old_one_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "old").unwrap();
        let file = PictureFile::create(&path).unwrap().with_name(OsStr::new("b.png"));
        assert!(file.temporary().exists());
        file.write(&Image::new(2, 2), &EncodeOptions::default()).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert!(folder.path().join("b.png").exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn reserved_room_is_given_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let mut file = PictureFile::create(&path).unwrap();
        file.reserve(100_000).unwrap();
        assert_eq!(fs::metadata(file.temporary()).unwrap().len(), 100_000);
        let written = file.write(&Image::new(2, 2), &EncodeOptions::default()).unwrap();
        assert_eq!(fs::metadata(&path).unwrap().len(), written as u64);
        assert!(read_picture(&path, &DecodeLimits::default()).is_ok());
    }

    #[test]
    fn a_missing_folder_is_found_before_the_work() {
        let folder = tempfile::tempdir().unwrap();
        let missing = PictureFile::create(&folder.path().join("no/such/a.png"));
        assert!(
            matches!(missing, Err(WriteError::NoFolder { folder: missing, .. }) if missing == folder.path().join("no/such"))
        );
        assert!(PictureFile::create(folder.path()).is_err());
    }
}
