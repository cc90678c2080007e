//! Files written whole or not at all: first under another name beside it, `.room.png.1234.part` for `room.png`.
//!
//! A process locks its temporary file for as long as it lives, so that others can tell those of processes that were killed,
//! and remove them.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const PART: &str = ".part";

/// The name under which this process writes a file before it gets its own name.
pub fn temporary_beside(path: &Path) -> PathBuf {
    let mut hidden = start_of_name(path);
    hidden.push(std::process::id().to_string());
    hidden.push(PART);
    path.with_file_name(hidden)
}

/// Writes a file whole or not at all: under [a temporary name](temporary_beside) first. What was there stays until the new
/// one is safely on the disk.
///
/// # Errors
///
/// The system refuses; then nothing is changed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let temporary = temporary_beside(path);
    // The lock is kept until the file has its name, so that nobody takes it for abandoned.
    let written = create(path).and_then(|mut file| {
        file.write_all(bytes).and_then(|()| file.sync_all()).and_then(|()| fs::rename(&temporary, path))
    });
    if written.is_err() {
        // There may be none; the error that matters is the first one.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Makes the temporary file of this process, and removes those that processes left behind which were killed.
pub(crate) fn create(path: &Path) -> io::Result<File> {
    remove_abandoned(path);
    let file = File::create(temporary_beside(path))?;
    // Where there are no locks, nothing is taken for abandoned either.
    let _ = file.try_lock();
    Ok(file)
}

/// Writes so many zeros: the one way to take room on a disk that every system knows.
pub(crate) fn fill(file: &mut File, bytes: u64) -> io::Result<()> {
    let zeros = [0; 1 << 16];
    let mut left = bytes;
    while left > 0 {
        let length = left.min(zeros.len() as u64);
        file.write_all(&zeros[..length as usize])?;
        left -= length;
    }
    // Some systems look for the room only now.
    file.sync_all()
}

/// Removes temporary files of `path` that nobody has a lock on. What cannot be looked at stays.
fn remove_abandoned(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let start = start_of_name(path);
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if is_temporary(&entry.file_name(), &start) && is_abandoned(&entry.path()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_abandoned(temporary: &Path) -> bool {
    let is_file = fs::symlink_metadata(temporary).is_ok_and(|metadata| metadata.is_file());
    is_file && File::open(temporary).is_ok_and(|file| file.try_lock().is_ok())
}

/// True for the start, digits, and the ending.
fn is_temporary(name: &OsStr, start: &OsStr) -> bool {
    let rest = name.as_encoded_bytes().strip_prefix(start.as_encoded_bytes());
    let process = rest.and_then(|rest| rest.strip_suffix(PART.as_bytes()));
    process.is_some_and(|digits| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit))
}

/// What the temporary names of all processes begin with.
fn start_of_name(path: &Path) -> OsString {
    let mut start = OsString::from(".");
    start.push(path.file_name().unwrap_or_default());
    start.push(".");
    start
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_written_whole_or_stays_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        let taken = folder.path().join("taken");
        fs::create_dir(&taken).unwrap();
        assert!(write_whole(&taken, b"new").is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing temporary is left");
    }

    #[test]
    fn what_the_dead_left_is_removed_and_what_the_living_have_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let living = File::create(path(".a.png.1.part")).unwrap();
        living.try_lock().unwrap();
        for name in [".a.png.2.part", ".b.png.2.part", ".a.png.x.part", ".a.png..part", "a.png.2.part"] {
            fs::write(path(name), "").unwrap();
        }
        let ours = create(&path("a.png")).unwrap();
        assert!(temporary_beside(&path("a.png")).exists());
        let other = create(&path("b.png")).unwrap();
        let left = |name: &str| path(name).exists();
        assert!(left(".a.png.1.part") && left(".a.png.x.part") && left(".a.png..part") && left("a.png.2.part"));
        assert!(!left(".a.png.2.part") && !left(".b.png.2.part"));
        drop((living, ours, other));
    }
}
