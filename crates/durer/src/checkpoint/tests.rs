//! What is written is read; what is damaged is refused; and the picture is that of one go.

use super::*;
use crate::{CompiledScene, Progress, Region, RenderOptions, SceneHash, Sources};
use durer_formats::{Limits, NoAssets, load_str};
use durer_scene::CheckedScene;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Stops after so many calls.
struct After(AtomicUsize);

impl Progress for After {
    fn advanced(&self, _: &Film) {
        // Tiles that are being worked on come in still.
        let _ = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
    }

    fn stop(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

fn hash(scene: &CheckedScene) -> SceneHash {
    SceneHash::of(scene.scene(), &Sources::default())
}

fn scene(render: &str) -> CheckedScene {
    let text = format!(
        "picture: {{width: 75, height: 100}}\nrender: {{{render}}}\nobjects:\n\
         - plane: {{material: {{color: {{checker: {{colors: [black, white]}}}}}}}}\n\
         - sphere: {{center: [0, 1, 0], material: {{color: tomato, reflection: 0.5}}}}\n"
    );
    load_str(&text, "test", &NoAssets, &Limits::default()).unwrap().scene
}

const ONE_THREAD: RenderOptions = RenderOptions { threads: Some(1), region: None, samples: None, direct: false };

fn stopped_after(scene: &CompiledScene, region: Option<Region>, calls: usize) -> Film {
    let options = RenderOptions { region, ..ONE_THREAD };
    crate::render(scene, &options, &After(AtomicUsize::new(calls))).unwrap()
}

fn through_bytes(scene: &CheckedScene, film: &Film) -> Film {
    let origin = Origin { folder: "/somewhere".to_owned(), words: vec!["a.yaml".to_owned(), "ö".to_owned()] };
    let seconds = if film.is_complete() { 0.0 } else { 12.5 };
    let bytes = encode_checkpoint(&origin, &hash(scene), film, 12.5);
    let checkpoint = Checkpoint::decode(&bytes).unwrap();
    assert_eq!((&checkpoint.origin, &checkpoint.scene, &checkpoint.film), (&origin, &hash(scene), film));
    assert_eq!(checkpoint.seconds, seconds);
    checkpoint.film
}

/// All ways of anti-aliasing, with filters that reach to neighbors, stopped everywhere.
#[test]
fn going_on_from_a_file_gives_the_picture_of_one_go() {
    let ways = [
        "antialias: none",
        "antialias: {grid: 2}",
        "antialias: {recursive: {threshold: 0.1, max_depth: 2}}",
        "antialias: adaptive",
        "antialias: {adaptive: {threshold: 0.02, max_depth: 3}}, filter: mitchell",
        "antialias: pov1",
        "antialias: pov2, filter: gaussian",
        "antialias: {grid: 2}, filter: {blackman_harris: {radius: 3}}",
        "integrator: path, samples: 6",
        "integrator: {path: {max_depth: 5, clamp: 0.1, split: 2, reuse: 4}}, samples: 2",
        "integrator: path, samples: 20, filter: mitchell",
        "integrator: ambient_occlusion, samples: 3",
    ];
    let mut cut_short = 0;
    for way in ways {
        let scene = scene(way);
        let compiled = crate::compile(&scene);
        let region = Some(Region { x: 3, y: 1, width: 70, height: 99 });
        let whole = crate::render(&compiled, &RenderOptions { region, ..ONE_THREAD }, &()).unwrap();
        let bits =
            |film: &Film| film.pixels().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect::<Vec<_>>();
        for calls in [0, 1, 2, 3, 5, 11] {
            let part = stopped_after(&compiled, region, calls);
            cut_short += usize::from(!part.is_complete());
            let resumed = crate::render_on(&compiled, through_bytes(&scene, &part), &ONE_THREAD, &()).unwrap();
            assert!(resumed.is_complete());
            assert_eq!((bits(&resumed), resumed.depths()), (bits(&whole), whole.depths()), "{way}, {calls}");
            assert_eq!(resumed.sums(), whole.sums(), "{way}, {calls}");
        }
    }
    assert!(cut_short > ways.len() * 3, "{cut_short}");
}

/// What was known of its noise is known again.
#[test]
fn going_on_where_noise_is_gives_the_picture_of_one_go() {
    let scene = scene("integrator: path, samples: 200, noise: 0.12");
    let compiled = crate::compile(&scene);
    let region = Some(Region { x: 27, y: 29, width: 19, height: 38 });
    let whole = crate::render(&compiled, &RenderOptions { region, ..ONE_THREAD }, &()).unwrap();
    let (least, most) = whole.sums().unwrap().least_and_most();
    assert!(least == 64 && most > 64, "{least} {most}");
    for calls in [1, 17, 26, 27, 32] {
        let part = stopped_after(&compiled, region, calls);
        assert!(!part.is_complete());
        let resumed = crate::render_on(&compiled, through_bytes(&scene, &part), &ONE_THREAD, &()).unwrap();
        assert_eq!(resumed, whole, "{calls}");
    }
}

#[test]
fn every_flipped_bit_and_every_cut_is_found() {
    every_flipped_bit_of(&scene("antialias: none"));
    every_flipped_bit_of(&scene("integrator: path, samples: 2"));
}

fn every_flipped_bit_of(scene: &CheckedScene) {
    let film = stopped_after(&crate::compile(scene), Some(Region { x: 0, y: 0, width: 3, height: 2 }), 1);
    let origin = Origin { folder: "a".to_owned(), words: vec!["b".to_owned()] };
    let bytes = encode_checkpoint(&origin, &hash(scene), &film, 1.0);
    assert!(Checkpoint::decode(&bytes).is_ok());
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut flipped = bytes.clone();
            flipped[at] ^= 1 << bit;
            let error = Checkpoint::decode(&flipped).expect_err("a flipped bit");
            match at {
                0..8 => assert!(matches!(error, CheckpointError::AnotherKind), "{at}: {error}"),
                8..12 => assert!(matches!(error, CheckpointError::OtherFormat(_)), "{at}: {error}"),
                _ => assert!(matches!(error, CheckpointError::Damaged), "{at}: {error}"),
            }
        }
        assert!(matches!(Checkpoint::decode(&bytes[..at]), Err(CheckpointError::Damaged)), "cut at {at}");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(Checkpoint::decode(&longer), Err(CheckpointError::Damaged)));
}

/// A right checksum does not make it a checkpoint; and what it promises is not allocated.
#[test]
fn wrong_contents_under_a_right_checksum_are_refused() {
    wrong_contents_of(&scene("antialias: none"));
    wrong_contents_of(&scene("integrator: {path: {clamp: 0.1}}, samples: 2"));
    wrong_contents_of(&scene("integrator: {ambient_occlusion: {distance: 2}}, samples: 2"));
    wrong_contents_of(&scene("integrator: path, samples: 3, noise: 0.1"));
}

fn wrong_contents_of(scene: &CheckedScene) {
    let compiled = crate::compile(scene);
    let film = stopped_after(&compiled, Some(Region { x: 0, y: 0, width: 3, height: 2 }), 1);
    let origin = Origin { folder: "folder".to_owned(), words: vec!["word".to_owned()] };
    let bytes = encode_checkpoint(&origin, &hash(scene), &film, 1.0);
    let sealed = |content: &[u8]| {
        let checksum = twox_hash::XxHash3_128::oneshot(content);
        [content, &checksum.to_le_bytes()].concat()
    };
    let content = &bytes[..bytes.len() - 16];
    assert!(Checkpoint::decode(&sealed(content)).is_ok());
    for at in 12..content.len() {
        let mut spoilt = content.to_vec();
        spoilt[at] = 0xff;
        // Whatever comes of it: no panic, and no more memory than the bytes are worth.
        if let Ok(read) = Checkpoint::decode(&sealed(&spoilt)) {
            assert_eq!(encode_checkpoint(&read.origin, &read.scene, &read.film, read.seconds), sealed(&spoilt), "{at}");
            // Whatever was read can be gone on with, if it is of the picture at all.
            let _ = crate::render_on(&compiled, read.film, &ONE_THREAD, &());
        }
        assert!(Checkpoint::decode(&sealed(&content[..at])).is_err(), "cut at {at}");
    }
    assert!(Checkpoint::decode(&sealed(&[content, &[0]].concat())).is_err());
    let mut other = content.to_vec();
    other[16] ^= 1;
    assert!(matches!(Checkpoint::decode(&sealed(&other)), Err(CheckpointError::OtherVersion(_))));
    let at = content.windows(4).position(|four| four == b"word").unwrap() - 8;
    other = content.to_vec();
    other[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(Checkpoint::decode(&sealed(&other)), Err(CheckpointError::Damaged)));
}

#[test]
fn files_of_other_kinds_are_named_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    std::fs::write(&path, "objects: [sphere]\n").unwrap();
    assert!(matches!(read_checkpoint(&path), Err(CheckpointError::AnotherKind)));
    assert!(matches!(read_checkpoint(folder.path()), Err(CheckpointError::AnotherKind)));
    assert!(matches!(read_checkpoint(&folder.path().join("b")), Err(CheckpointError::Io(_))));
}

/// Whatever a few hundred bytes promise, no film is made of it: the numbers stand before any checksum is looked at.
#[test]
fn outlines_promise_no_more_than_there_is() {
    let scene = scene("integrator: path, samples: 2");
    let region = Region { x: 0, y: 0, width: 3, height: 2 };
    let film =
        crate::render(&crate::compile(&scene), &RenderOptions { region: Some(region), ..ONE_THREAD }, &()).unwrap();
    let bytes = encode_checkpoint(&Origin::default(), &hash(&scene), &film, 0.0);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.film");
    let outline_of = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        read_checkpoint_outline(&path)
    };
    assert_eq!(outline_of(&bytes).unwrap().film, film.outline());
    let numbers = |numbers: &[u32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let places = |wanted: &[u8]| (0..bytes.len()).filter(|&at| bytes[at..].starts_with(wanted)).collect::<Vec<usize>>();
    let (sizes, regions) = (places(&numbers(&[75, 100])), places(&numbers(&[0, 0, 3, 2])));
    assert_eq!((sizes.len(), regions.len()), (1, 2), "the picture; the film and its part");
    let crafted = |size: [u32; 2], region: [u32; 4]| {
        let mut bytes = bytes.clone();
        bytes[sizes[0]..][..8].copy_from_slice(&numbers(&size));
        regions.iter().for_each(|&at| bytes[at..][..16].copy_from_slice(&numbers(&region)));
        outline_of(&bytes)
    };
    assert!(crafted([75, 100], [1, 1, 2, 3]).is_ok(), "as many bytes as it needs");
    let most = u32::MAX;
    for (size, region) in [
        ([most, most], [0, 0, most, most]),
        ([65_535, 65_535], [0, 0, 65_535, 65_535]),
        ([75, 100], [0, 0, 75, 100]),
        ([75, 100], [74, 0, 3, 2]),
        ([75, 100], [0, 99, 3, 2]),
        ([75, 100], [most - 3, 0, 3, 2]),
        ([65_536, 100], [0, 0, 3, 2]),
    ] {
        assert!(matches!(crafted(size, region), Err(CheckpointError::Damaged)), "{size:?} {region:?}");
    }
}
