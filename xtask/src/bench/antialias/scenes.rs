//! The pictures: each a scene, so that what is measured is what users get.

use crate::shell;
use durer::imaging::{EncodeOptions, FileFormat, Image, Transfer, encode};
use durer::math::Rgb;
use durer::math::functions::{cos, sin};
use durer::{Limits, LoadOptions, MemoryAssets, Scene};

/// A picture.
pub(super) struct Subject {
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    pub(super) scene: Scene,
}

/// Width and height of all but the room.
const SIZE: u32 = 96;

/// The picture with this name.
pub(super) fn subject(name: &str) -> Result<Subject, String> {
    let (name, about, scene) = match name {
        "edges" => ("edges", "Fourteen half-planes at odd angles, one over the other.", flat(&edges(), vec![])?),
        "star" => ("star", "A Siemens star of 36 rays: ever thinner wedges.", flat(&star(), vec![])?),
        "discs" => ("discs", "576 discs with radii from 0.1 to 0.6 pixels.", flat(&discs(), vec![])?),
        "zone plate" => {
            let plate = "  - rectangle: {corner: [-48, -48, 0], edges: [[96, 0, 0], [0, 96, 0]], material: {color: plate, ambient: 1}}\n";
            let about = "A smooth zone plate, finer and finer up to two pixels a wave: an image of 1536 × 1536 texels.";
            ("zone plate", about, flat(plate, zone_plate()?)?)
        }
        "room" => ("room", "The seed's room, 150 × 150 pixels.", room()?),
        _ => return Err(format!("there is no picture `{name}`")),
    };
    Ok(Subject { name, about, scene })
}

/// A scene of flat things of their own colors, seen from the front, one unit to a pixel.
fn flat(objects: &str, image: Vec<u8>) -> Result<Scene, String> {
    let textures = match image.is_empty() {
        true => "",
        false => "textures: {plate: {image: {file: plate.png, encoding: linear}}}\n",
    };
    let text = format!(
        "picture: {{width: {SIZE}, height: {SIZE}}}\ncamera: {{position: [0, 0, 100], look_at: [0, 0, 0], orthographic: \
         {{height: {SIZE}}}}}\nbackground: 0\nambient: 1\nlights: []\n{textures}objects:\n{objects}"
    );
    let mut assets = MemoryAssets::new();
    assets.insert("plate.png", image);
    let loaded = durer::load_str(&text, "bench", &assets, &Limits::default()).map_err(|wrong| wrong.to_string())?;
    Ok(loaded.scene.into_scene())
}

fn edges() -> String {
    // Angles and offsets that have nothing to do with the pixels.
    let lines = (0..14).map(|i| {
        let i = f64::from(i);
        (0.3 + 2.399 * i, 3.0 + (11.7 * i).rem_euclid(34.0))
    });
    let half_plane = |(index, (angle, offset)): (usize, (f64, f64))| {
        let (x, y) = (cos(angle), sin(angle));
        // A large square on one side of the line.
        let corner = [x * offset - y * -300.0, y * offset + x * -300.0];
        let gray = [0.9, 0.25, 0.6, 0.1, 0.75][index % 5];
        format!(
            "  - rectangle: {{corner: [{}, {}, {index}], edges: [[{}, {}, 0], [{}, {}, 0]], material: {{color: {gray}, ambient: 1}}}}\n",
            corner[0],
            corner[1],
            x * 600.0,
            y * 600.0,
            -y * 600.0,
            x * 600.0
        )
    };
    lines.enumerate().map(half_plane).collect()
}

fn star() -> String {
    const RAYS: u32 = 36;
    let (cx, cy) = (0.31, -0.17);
    let wedge = |ray: u32| {
        let step = std::f64::consts::TAU / f64::from(RAYS);
        let tip = |angle: f64| format!("[{}, {}, 0]", cx + 200.0 * cos(angle), cy + 200.0 * sin(angle));
        let (from, to) = (f64::from(ray) * step, (f64::from(ray) + 0.5) * step);
        format!(
            "  - triangle: {{vertices: [[{cx}, {cy}, 0], {}, {}], material: {{color: 1, ambient: 1}}}}\n",
            tip(from),
            tip(to)
        )
    };
    (0..RAYS).map(wedge).collect()
}

/// One disc in each square of four by four pixels.
fn discs() -> String {
    let mut state = 1_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut text = String::new();
    for row in 0..SIZE / 4 {
        for column in 0..SIZE / 4 {
            let along = |square: u32, at: f64| f64::from(4 * square) + 0.7 + 2.6 * at - f64::from(SIZE / 2);
            let (x, y, radius) = (along(column, number()), along(row, number()), 0.1 + 0.5 * number());
            text += &format!(
                "  - disc: {{center: [{x}, {y}, 0], normal: [0, 0, 1], radius: {radius}, material: {{color: 1, ambient: 1}}}}\n"
            );
        }
    }
    text
}

/// 1/2 + 1/2 cos(π r² / 96), r in pixels, which at the middle of an edge makes a wave of two pixels.
fn zone_plate() -> Result<Vec<u8>, String> {
    const TEXELS: u32 = 16 * SIZE;
    let pixel = |index: u32| {
        let along = |i: u32| (f64::from(i) + 0.5) / 16.0 - f64::from(SIZE / 2);
        let (x, y) = (along(index % TEXELS), along(index / TEXELS));
        Rgb::gray((0.5 + 0.5 * cos(std::f64::consts::PI * (x * x + y * y) / f64::from(SIZE))) as f32)
    };
    let pixels = (0..TEXELS * TEXELS).map(pixel).collect();
    let image = Image::from_pixels(TEXELS, TEXELS, pixels).ok_or("the image has another size")?;
    let options = EncodeOptions { transfer: Transfer::Linear, ..EncodeOptions::new(FileFormat::Png) };
    encode(&image, &options).map_err(|error| error.to_string())
}

fn room() -> Result<Scene, String> {
    let path = shell::root().join("scenes/room.yaml");
    let loaded = durer::load_file(path, &LoadOptions::default()).map_err(|wrong| wrong.to_string())?;
    let mut scene = loaded.scene.into_scene();
    (scene.picture.width, scene.picture.height) = (150, 150);
    Ok(scene)
}
