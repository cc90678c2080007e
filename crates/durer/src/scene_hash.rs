//! What a film is a picture of, in parts, so that it can be told what has changed since.

use durer_formats::{Sources, to_yaml};
use durer_math::Fingerprint;
use durer_scene::{Integrator, Picture, RenderSettings, Scene};
use std::collections::BTreeMap;
use std::fmt::Debug;

/// The fingerprint of a scene, with everything that may change a pixel, in parts: of the scene's text as
/// [`to_yaml`](crate::to_yaml) writes it without `picture` and `render`, under an empty name; of each of these settings; and of
/// each file that it names.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneHash {
    /// Name and fingerprint of each part, sorted by name. Those of settings begin with a byte that no name of a file has.
    pub(crate) parts: Vec<(String, u128)>,
    /// What is computed: not only its hash, so that it can be told what is not the same.
    pub(crate) integrator: Integrator,
    /// Width and height of the whole picture.
    pub(crate) size: (u32, u32),
}

/// Something that a scene is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneItem<'a> {
    /// What is in it.
    Scene,
    /// A setting of `picture` or `render`, by its name.
    Setting(&'a str),
    /// A file that it names.
    File(&'a str),
}

impl SceneItem<'_> {
    /// False for what only says how many samples are taken, and when it is enough: a sample with a number is the same
    /// whatever that is.
    pub fn changes_samples(self) -> bool {
        !matches!(self, SceneItem::Setting("samples" | "noise" | "time"))
    }
}

/// What names of settings begin with.
const SETTING: char = '\0';

impl SceneHash {
    /// That of a scene with the settings that it is rendered with, and of the files that it was loaded from.
    pub fn of(scene: &Scene, sources: &Sources) -> SceneHash {
        let rest = Scene { picture: Picture::default(), render: RenderSettings::default(), ..scene.clone() };
        let own = (String::new(), Fingerprint::of(to_yaml(&rest).as_bytes()).0);
        let settings = settings(&scene.picture, &scene.render)
            .map(|(name, value)| (format!("{SETTING}{name}"), Fingerprint::of(value.as_bytes()).0));
        let files = sources.files().map(|(name, fingerprint)| (name.to_owned(), fingerprint.0));
        let mut parts: Vec<(String, u128)> = std::iter::once(own).chain(settings).chain(files).collect();
        parts.sort();
        let Picture { width, height, .. } = scene.picture;
        SceneHash { parts, integrator: scene.render.integrator, size: (width, height) }
    }

    /// What is computed of the scene.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Width and height of the whole picture.
    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    /// All parts as one.
    pub fn fingerprint(&self) -> Fingerprint {
        let bytes = |(name, hash): &(String, u128)| [name.as_bytes(), &[0xff], &hash.to_le_bytes()].concat();
        Fingerprint::of(&self.parts.iter().flat_map(bytes).collect::<Vec<u8>>())
    }

    /// What is not the same in `other`.
    pub fn differences<'a>(&'a self, other: &'a SceneHash) -> Vec<SceneItem<'a>> {
        let missing_in = |a: &'a SceneHash, b: &SceneHash| {
            let of_b: BTreeMap<&str, u128> = b.parts.iter().map(|(name, hash)| (name.as_str(), *hash)).collect();
            let names = a.parts.iter().filter(|(name, hash)| of_b.get(name.as_str()) != Some(hash));
            names.map(|(name, _)| item_of(name)).collect::<Vec<SceneItem<'a>>>()
        };
        let mut items = missing_in(self, other);
        items.extend(missing_in(other, self));
        items.sort_unstable();
        items.dedup();
        items
    }
}

fn item_of(name: &str) -> SceneItem<'_> {
    match name.strip_prefix(SETTING) {
        Some(setting) => SceneItem::Setting(setting),
        None if name.is_empty() => SceneItem::Scene,
        None => SceneItem::File(name),
    }
}

/// Each setting by its name, written so that no two values are written alike.
fn settings(picture: &Picture, render: &RenderSettings) -> impl Iterator<Item = (&'static str, String)> {
    let Picture { width, height, transfer, exposure, tone_mapping } = picture;
    let RenderSettings {
        integrator,
        samples,
        noise,
        time,
        seed,
        light_samples,
        max_depth,
        min_weight,
        antialias,
        filter,
        trees,
    } = render;
    [
        ("width", width as &dyn Debug),
        ("height", height),
        ("transfer", transfer),
        ("exposure", exposure),
        ("tone_mapping", tone_mapping),
        ("integrator", integrator),
        ("samples", samples),
        ("noise", noise),
        ("time", time),
        ("seed", seed),
        ("light_samples", light_samples),
        ("max_depth", max_depth),
        ("min_weight", min_weight),
        ("antialias", antialias),
        ("filter", filter),
        ("trees", trees),
    ]
    .map(|(name, value)| (name, format!("{value:?}")))
    .into_iter()
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
        assert_eq!(hash(ball, 1).differences(&hash(ball, 2)), [SceneItem::File("a.pfm")]);
        assert_eq!(hash(ball, 1).differences(&hash(&ball.replace("radius: 2", "radius: 3"), 1)), [SceneItem::Scene]);
        assert_eq!(
            hash(ball, 1).differences(&hash("objects: [sphere: {}]", 1)),
            [SceneItem::Scene, SceneItem::File("a.pfm")]
        );
    }

    #[test]
    fn it_tells_which_settings_have_changed() {
        let of = |text: &str| hash(&format!("{text}\nobjects: [sphere]"), 1);
        let plain = of("picture: {width: 64, height: 48}");
        let other = of("picture: {width: 64, height: 32, exposure: 1}\nrender: {integrator: path, seed: 3}");
        let settings = ["exposure", "height", "integrator", "seed"].map(SceneItem::Setting);
        assert_eq!(plain.differences(&other), settings);
        assert_eq!((other.integrator(), other.size()), (Integrator::PATH, (64, 32)));
        assert_ne!(plain.fingerprint(), other.fingerprint());
        let more = of("picture: {width: 64, height: 48}\nrender: {samples: 99, noise: 0.1, time: 9, seed: 3}");
        let counts = plain.differences(&more);
        assert_eq!(counts, ["noise", "samples", "seed", "time"].map(SceneItem::Setting));
        assert_eq!(counts.iter().filter(|item| item.changes_samples()).count(), 1);
        let reused = of("picture: {width: 64, height: 48}\nrender: {integrator: {path: {reuse: 16}}}");
        let path = of("picture: {width: 64, height: 48}\nrender: {integrator: path}");
        assert_eq!(path.differences(&reused), [SceneItem::Setting("integrator")]);
        // One whose name looks like a setting's would have to begin with a byte that no name can have.
        assert_eq!(item_of("seed"), SceneItem::File("seed"));
    }
}
