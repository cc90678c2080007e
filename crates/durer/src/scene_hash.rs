//! A number for all that a picture is made from: equal for equal scenes, and as good as never for others.
//!
//! Hashed are the scene as [`to_yaml`](crate::to_yaml) writes it, so that comments and layout do not matter, and the
//! numbers of all files that it names, as they were loaded. XXH3 with 128 bits: it finds every change by accident; it is
//! no protection against somebody who wants two scenes to look the same.

mod content;

use durer_formats::to_yaml;
use durer_scene::{CheckedScene, Scene};
use std::collections::BTreeMap;
use twox_hash::XxHash3_128;

/// The hash of a scene, in parts: the scene itself under an empty name, and each file that it names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneHash {
    /// Name and hash of each part, sorted by name.
    pub(crate) parts: Vec<(String, u128)>,
}

impl SceneHash {
    /// All of it in one number.
    pub fn total(&self) -> u128 {
        let mut all = Vec::new();
        for (name, hash) in &self.parts {
            all.extend_from_slice(&(name.len() as u64).to_le_bytes());
            all.extend_from_slice(name.as_bytes());
            all.extend_from_slice(&hash.to_le_bytes());
        }
        XxHash3_128::oneshot(&all)
    }

    /// What is not the same in `other`: names of files, or an empty name for the scene itself.
    pub fn differences<'a>(&'a self, other: &'a SceneHash) -> Vec<&'a str> {
        let missing_in = |a: &'a SceneHash, b: &SceneHash| {
            let of_b: BTreeMap<&str, u128> = b.parts.iter().map(|(name, hash)| (name.as_str(), *hash)).collect();
            let names = a.parts.iter().filter(|(name, hash)| of_b.get(name.as_str()) != Some(hash));
            names.map(|(name, _)| name.as_str()).collect::<Vec<&str>>()
        };
        let mut names = missing_in(self, other);
        names.extend(missing_in(other, self));
        names.sort_unstable();
        names.dedup();
        names
    }
}

/// Hashes a scene, with everything that may change a pixel.
pub fn scene_hash(scene: &CheckedScene) -> SceneHash {
    let mut content = content::Content::default();
    let mut bare = scene.scene().clone();
    content.take_from(&mut bare);
    content.text("", &canonical(bare));
    SceneHash { parts: content.finish() }
}

/// The text of a scene. What has no name gets one, so that all of it is written, in the order of the ids.
fn canonical(mut scene: Scene) -> String {
    // No name in a file can begin like this one by accident, for it is not printable.
    for (id, material) in scene.materials.iter_mut().enumerate() {
        material.name.get_or_insert_with(|| format!("\u{1}{id}"));
    }
    for (id, texture) in scene.textures.iter_mut().enumerate() {
        texture.name.get_or_insert_with(|| format!("\u{1}{id}"));
    }
    to_yaml(&scene)
}

#[cfg(test)]
mod tests;
