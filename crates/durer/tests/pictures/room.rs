//! The seed's room: against a second ray tracer, against known means, and through a file and back.

use crate::seed_tracer::{Room, Texture};
use crate::support::{compile, difference, film, picture};
use durer::imaging::{DecodeLimits, Image, Texels};
use durer::math::Rgb;
use durer::{FolderAssets, Limits, LoadOptions, Scene};
use std::path::PathBuf;

fn scenes() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "..", "scenes"].iter().collect()
}

/// The scene that the project began with.
pub(crate) fn room() -> Scene {
    let loaded = durer::load_file(scenes().join("room.yaml"), &LoadOptions::default()).expect("the room");
    loaded.scene.into_scene()
}

fn sized(size: u32, fog: bool) -> Scene {
    let mut room = room();
    (room.picture.width, room.picture.height) = (size, size);
    room.fog = room.fog.filter(|_| fog);
    room
}

fn texture() -> Texture {
    let bitmap = durer::read_picture(&scenes().join("textures/seed.png"), &DecodeLimits::default()).unwrap();
    let Texels::U8(texels) = bitmap.texels else { panic!("a PNG of 8 bits") };
    assert_eq!((bitmap.width, bitmap.height), (256, 256));
    let linear = |v: u8| {
        let c = f64::from(v) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Texture { size: 256, pixels: texels.iter().map(|texel| texel.map(linear)).collect() }
}

/// True if the pixel or one beside it differs visibly from it: there is an edge.
fn at_an_edge(image: &Image, x: u32, y: u32) -> bool {
    let near = |v: u32, limit: u32| v.saturating_sub(1)..(v + 2).min(limit);
    let here = image.pixel(x, y);
    near(y, image.height).any(|j| near(x, image.width).any(|i| difference(image.pixel(i, j), here) > 0.02))
}

#[test]
fn the_room_is_what_a_second_ray_tracer_sees() {
    let size = 125;
    for fog in [true, false] {
        let second = Room { texture: texture(), fog };
        let image = picture(sized(size, fog));
        let mut different = 0;
        for y in 0..size {
            for x in 0..size {
                let expected = Rgb::from(second.pixel(x, y, size).map(|c| c as f32));
                let found = image.pixel(x, y);
                if difference(found, expected) > 1e-4 {
                    different += 1;
                    assert!(at_an_edge(&image, x, y), "({x}, {y}): {found:?}, expected {expected:?}");
                }
            }
        }
        assert!(different * 1000 <= size * size, "{different} pixels differ");
    }
}

#[test]
fn the_rooms_mean_light_is_that_of_two_independent_renderings() {
    for (fog, expected) in [(true, [0.315, 0.317, 0.334]), (false, [0.247, 0.249, 0.264])] {
        let film = film(&compile(sized(500, fog)));
        assert_eq!(film.rays().eye, 250_000);
        let image = film.develop();
        for (channel, expected) in expected.into_iter().enumerate() {
            let sum: f64 = image.pixels.iter().map(|p| f64::from(p.to_array()[channel])).sum();
            let mean = sum / 250_000.0;
            assert!((mean - expected).abs() < 0.001, "fog {fog}, channel {channel}: {mean}, not {expected}");
        }
    }
}

#[test]
fn the_room_written_and_read_again_is_the_same_scene_and_the_same_picture() {
    let original = sized(60, true);
    let text = durer::to_yaml(&original);
    let assets = FolderAssets::new(scenes());
    let loaded = durer::load_str(&text, "again.yaml", &assets, &Limits::default()).expect("our own text");
    let again = loaded.scene.into_scene();
    assert_eq!(again, original);
    assert!(picture(again) == picture(original));
    assert_eq!(durer::to_yaml(&sized(60, true)), text);
}
