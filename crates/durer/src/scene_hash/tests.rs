//! What changes the hash, and what does not.

use super::*;
use durer_formats::{LoadOptions, NoAssets, load_file, load_str};
use durer_imaging::{EncodeOptions, Image, encode};
use durer_math::Rgb;
use std::fs;

fn hash(text: &str) -> SceneHash {
    scene_hash(&load_str(text, "test", &NoAssets, &durer_formats::Limits::default()).unwrap().scene)
}

#[test]
fn layout_does_not_matter_but_every_setting_does() {
    let scene = "picture: {width: 30, height: 20}\nobjects: [sphere: {radius: 1.5, material: {color: tomato}}]\n";
    let same =
        "# A ball.\nobjects:\n  - sphere: {material: {color: tomato}, radius: 1.5}\npicture: {height: 20, width: 30}\n";
    assert_eq!(hash(scene), hash(same));
    for (from, to) in [("30", "31"), ("1.5", "1.5000000000000002"), ("tomato", "gold"), ("sphere: {", "torus: {")] {
        let changed = scene.replace(from, to);
        assert_ne!(hash(scene).total(), hash(&changed).total(), "{changed}");
        assert_eq!(hash(scene).differences(&hash(&changed)), [""]);
    }
}

#[test]
fn lists_in_the_scene_file_belong_to_it() {
    let balls = |last: &str| format!("objects: [spheres: {{centers: [[0, 0, 0], [1, 2, {last}]], radius: [1, 2]}}]");
    assert_eq!(hash(&balls("3")), hash(&balls("3.0")));
    assert_eq!(hash(&balls("3")).differences(&hash(&balls("4"))), [""]);
    let copies = |radii: &str| format!("objects: [spheres: {{centers: [[0, 0, 0], [1, 2, 3]], radius: {radii}}}]");
    assert_ne!(hash(&copies("1")), hash(&copies("2")));
}

#[test]
fn a_changed_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    put("c.csv", "x,y,z\n1,2,3\n");
    let put_image = |gray: f32| {
        let image = Image::from_fn(2, 2, |_, _| Rgb::new(gray, gray, gray));
        fs::write(folder.path().join("d.png"), encode(&image, &EncodeOptions::default()).unwrap()).unwrap();
    };
    put_image(0.5);
    put(
        "scene.yaml",
        "objects:\n  - import: {file: a.obj}\n  - mesh: {file: a.obj}\n  - spheres: {centers: c.csv, radius: 1}\n  \
         - sphere: {material: {color: {image: {file: d.png}}}}\n",
    );
    let hash = || {
        let loaded = load_file(folder.path().join("scene.yaml"), &LoadOptions::default());
        scene_hash(&loaded.unwrap_or_else(|diagnostics| panic!("{diagnostics}")).scene)
    };
    let before = hash();
    put("c.csv", "x,y,z\n1,2,4\n");
    let moved = hash();
    assert_eq!(before.differences(&moved), ["c.csv"]);
    put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n");
    assert_eq!(before.differences(&hash()), ["a.obj", "c.csv"]);
    assert_eq!(moved.differences(&hash()), ["a.obj"]);
    assert_eq!(hash().differences(&hash()), [""; 0]);
    put_image(0.6);
    assert_eq!(before.differences(&hash()), ["a.obj", "c.csv", "d.png"]);
}
