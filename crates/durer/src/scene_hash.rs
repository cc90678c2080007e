//! What a film is a picture of, in parts, so that it can be told what has changed since.

use durer_formats::{Sources, to_yaml};
use durer_math::Fingerprint;
use durer_scene::Scene;
use std::collections::BTreeMap;

/// The fingerprint of a scene, with everything that may change a pixel, in parts: of the scene's text as
/// [`to_yaml`](crate::to_yaml) writes it, under an empty name, and of each file that it names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneHash {
    /// Name and fingerprint of each part, sorted by name.
    pub(crate) parts: Vec<(String, u128)>,
}

impl SceneHash {
    /// That of a scene with the settings that it is rendered with, and of the files that it was loaded from.
    pub fn of(scene: &Scene, sources: &Sources) -> SceneHash {
        let own = (String::new(), Fingerprint::of(to_yaml(scene).as_bytes()).0);
        let files = sources.files().map(|(name, fingerprint)| (name.to_owned(), fingerprint.0));
        SceneHash { parts: std::iter::once(own).chain(files).collect() }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Limits, MemoryAssets, load_str};

    fn hash(text: &str, texel: u8) -> SceneHash {
        let mut assets = MemoryAssets::new();
        assets.insert("a.pfm", [&b"PF\n1 1\n-1\n"[..], &[0, 0, texel, 0x3e, 0, 0, 0, 0, 0, 0, 0, 0]].concat());
        let loaded = load_str(text, "scene.yaml", &assets, &Limits::default()).unwrap();
        SceneHash::of(loaded.scene.scene(), &loaded.sources)
    }

    #[test]
    fn it_tells_what_has_changed() {
        let ball = "objects: [sphere: {radius: 2, material: {color: {image: {file: a.pfm}}}}]";
        assert_eq!(hash(ball, 1), hash(&format!("# A ball.\n{ball}"), 1));
        assert_eq!(hash(ball, 1).differences(&hash(ball, 2)), ["a.pfm"]);
        assert_eq!(hash(ball, 1).differences(&hash(&ball.replace("radius: 2", "radius: 3"), 1)), [""]);
        assert_eq!(hash(ball, 1).differences(&hash("objects: [sphere: {}]", 1)), ["", "a.pfm"]);
    }
}
