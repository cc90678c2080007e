//! What a scene was made from: its own words and the files that it names, told apart from others by one short number.

use crate::{AssetError, Assets, to_yaml};
use durer_math::Fingerprint;
use durer_scene::Scene;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The files that a scene named when it was loaded, by name as the scene says it, and what was in them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources(BTreeMap<String, Fingerprint>);

impl Sources {
    /// The files in the order of their names.
    pub fn files(&self) -> impl Iterator<Item = (&str, Fingerprint)> {
        self.0.iter().map(|(name, fingerprint)| (name.as_str(), *fingerprint))
    }
}

/// Tells a scene from others: its text as [`to_yaml`] writes it and, in the order of their names, the files it is made from,
/// of each a zero byte, its name, a zero byte and the fingerprint of its bytes in hexadecimal digits.
///
/// So it does not matter where the scene lies, how it is laid out, what it leaves to defaults, or what system this is;
/// but a change of any number, or of any file that is named, does. Another version of durer may write another text.
pub fn scene_fingerprint(scene: &Scene, sources: &Sources) -> Fingerprint {
    fingerprint(to_yaml(scene), sources)
}

/// The same of the text of a scene.
pub(crate) fn fingerprint(mut text: String, sources: &Sources) -> Fingerprint {
    for (name, fingerprint) in sources.files() {
        text += &format!("\0{name}\0{fingerprint}");
    }
    Fingerprint::of(text.as_bytes())
}

/// Assets that remember what was read of them.
pub(crate) struct Remembering<'a> {
    assets: &'a dyn Assets,
    sources: RefCell<Sources>,
}

impl<'a> Remembering<'a> {
    pub(crate) fn new(assets: &'a dyn Assets) -> Remembering<'a> {
        Remembering { assets, sources: RefCell::default() }
    }

    pub(crate) fn remember(&self, name: &str, bytes: &[u8]) {
        self.sources.borrow_mut().0.insert(name.to_owned(), Fingerprint::of(bytes));
    }

    pub(crate) fn into_sources(self) -> Sources {
        self.sources.into_inner()
    }
}

impl Assets for Remembering<'_> {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let bytes = self.assets.read(relative, max_bytes)?;
        self.remember(relative, &bytes);
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Limits, MemoryAssets, load_bytes, load_str};

    const SCENE: &str = "objects: [sphere: {radius: 2, material: {color: {image: {file: a/b.pfm}}}}]";

    fn assets(texel: u8) -> MemoryAssets {
        let mut assets = MemoryAssets::new();
        assets.insert("a/b.pfm", [&b"PF\n1 1\n-1\n"[..], &[0, 0, texel, 0x3e, 0, 0, 0, 0, 0, 0, 0, 0]].concat());
        assets
    }

    fn fingerprint(text: &str, texel: u8) -> Fingerprint {
        let loaded = load_str(text, "scene.yaml", &assets(texel), &Limits::default()).unwrap();
        scene_fingerprint(loaded.scene.scene(), &loaded.sources)
    }

    #[test]
    fn words_and_files_count_and_layout_does_not() {
        let first = fingerprint(SCENE, 1);
        let block = "# A ball.\nobjects:\n- sphere:\n    radius: 2.0\n    center: [0, 0, 0]\n    material:\n      color: {image: {file: 'a/b.pfm'}}\n";
        assert_eq!(fingerprint(block, 1), first);
        assert_ne!(fingerprint(SCENE, 2), first);
        assert_ne!(fingerprint(&SCENE.replace("2,", "3,"), 1), first);
    }

    /// What it is made of, put together by hand.
    #[test]
    fn it_is_as_its_definition_says() {
        let loaded = load_str(SCENE, "scene.yaml", &assets(1), &Limits::default()).unwrap();
        let image = Fingerprint::of(assets(1).get("a/b.pfm").unwrap());
        assert_eq!(loaded.sources.files().collect::<Vec<_>>(), [("a/b.pfm", image)]);
        let whole = format!("{}\0a/b.pfm\0{image}", to_yaml(loaded.scene.scene()));
        assert_eq!(scene_fingerprint(loaded.scene.scene(), &loaded.sources), Fingerprint::of(whole.as_bytes()));
    }

    /// A model in place of a scene is its own source, wherever it lies.
    #[test]
    fn a_model_counts_without_its_folder() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let fingerprint = |name: &str, text: &str| {
            let loaded = load_bytes(text.as_bytes(), name, &MemoryAssets::new(), &Limits::default()).unwrap();
            scene_fingerprint(loaded.scene.scene(), &loaded.sources)
        };
        assert_eq!(fingerprint("a.obj", text), fingerprint("some/where/a.obj", text));
        assert_ne!(fingerprint("a.obj", text), fingerprint("a.obj", &text.replace("0 1 0", "0 1.5 0")));
    }
}
