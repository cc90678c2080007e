//! Files in memory, for where there are no others: a page in a browser, or a test.

use super::{AssetError, Assets};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Files in memory, by names relative to the scene's folder, with `/` between folders.
#[derive(Clone, Debug, Default)]
pub struct MemoryAssets {
    files: BTreeMap<String, Vec<u8>>,
}

impl MemoryAssets {
    /// No files yet.
    pub fn new() -> MemoryAssets {
        MemoryAssets::default()
    }

    /// Adds a file, or puts it in the place of one of the same name. One whose name leads out of the scene's folder will
    /// not be found.
    pub fn insert(&mut self, name: &str, bytes: Vec<u8>) {
        if let Some(plain) = plain(name) {
            self.files.insert(plain, bytes);
        }
    }

    /// The bytes of a file.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.get(&plain(name)?).map(Vec::as_slice)
    }
}

impl Assets for MemoryAssets {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let plain = plain(relative).ok_or_else(|| AssetError::Outside(PathBuf::from(relative)))?;
        match self.files.get(&plain) {
            Some(bytes) if bytes.len() as u64 > max_bytes => Err(AssetError::TooLarge(max_bytes)),
            Some(bytes) => Ok(bytes.clone()),
            None => Err(AssetError::NotFound),
        }
    }
}

/// The name without `.` and `..`; `None` if it leads out of the scene's folder.
fn plain(name: &str) -> Option<String> {
    let mut steps: Vec<&str> = Vec::new();
    if name.starts_with('/') {
        return None;
    }
    for step in name.split('/') {
        match step {
            "" | "." => {}
            ".." => {
                steps.pop()?;
            }
            step => steps.push(step),
        }
    }
    Some(steps.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_any_way_that_stays_inside() {
        let mut assets = MemoryAssets::new();
        assets.insert("data/knot.ply", b"ply".to_vec());
        for name in ["data/knot.ply", "./data/knot.ply", "data//knot.ply", "textures/../data/knot.ply"] {
            assert_eq!(assets.read(name, 3).ok().as_deref(), Some(&b"ply"[..]), "{name}");
        }
        assert!(matches!(assets.read("knot.ply", 3), Err(AssetError::NotFound)));
        assert!(matches!(assets.read("data/knot.ply", 2), Err(AssetError::TooLarge(2))));
        for name in ["../data/knot.ply", "/data/knot.ply", "data/../../knot.ply"] {
            assert!(matches!(assets.read(name, 3), Err(AssetError::Outside(_))), "{name}");
        }
    }
}
