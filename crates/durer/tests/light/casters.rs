//! Light of the sky that is aimed at through balls and cylinders: the same light as without, and less noise.
//!
//! What is stretched by a billionth is as good as round, but nothing is aimed at through it: there light comes by chance alone.

use crate::support::{assert_same, assert_same_pixels, components, estimate, halves};
use durer::imaging::{EncodeOptions, FileFormat, Image, encode};
use durer::math::Rgb;
use durer::{Limits, MemoryAssets, RenderOptions};

/// A sky with a small sun, of one pixel of 72 × 36 and its neighbors, high before the eye's right shoulder.
fn sky() -> Vec<u8> {
    let (width, height) = (72, 36);
    let at = |index: u32| match (index % width, index / width) {
        (50, 8) => Rgb::new(900.0, 700.0, 400.0),
        (_, row) if row < 18 => Rgb::new(0.3, 0.5, 0.8),
        _ => Rgb::gray(0.1),
    };
    let image = Image { width, height, pixels: (0..width * height).map(at).collect() };
    encode(&image, &EncodeOptions::new(FileFormat::Exr)).expect("a picture")
}

const SIZE: u32 = 12;

/// Things on a floor, seen from above.
fn scene((path, rotation): (&str, u32), samples: u32, seed: u32, things: &str) -> String {
    format!(
        "picture: {{width: {SIZE}, height: {SIZE}}}\n\
         render: {{integrator: {{path: {{max_depth: 6{path}}}}}, samples: {samples}, seed: {seed}}}\n\
         background: {{image: sky.exr, rotation: {rotation}}}\nlights: []\n\
         camera: {{position: [0, 2.5, 3], look_at: [0, 0.1, 0], fov: 50}}\n\
         objects:\n\
         - plane: {{point: [0, 0, 0], normal: [0, 1, 0], material: {{matte: {{color: 0.6}}}}}}\n{things}"
    )
}

fn render(text: &str, sky: &[u8]) -> Image {
    let mut assets = MemoryAssets::new();
    assets.insert("sky.exr", sky.to_vec());
    let loaded = durer::load_str(text, "scene.yaml", &assets, &Limits::default());
    let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    durer::render(&durer::compile(&loaded.scene), &RenderOptions::default(), &()).expect("it renders").develop()
}

/// Estimates of the means of halves of a picture, and of all components of all its pixels.
fn light(how: (&str, u32), samples: u32, things: &str) -> [Vec<(f64, f64)>; 2] {
    let sky = sky();
    let images: Vec<Image> = (1..=8).map(|seed| render(&scene(how, samples, seed, things), &sky)).collect();
    let image = |seed: u32| images[seed as usize - 1].clone();
    [estimate(image, halves), estimate(image, components)]
}

/// Round things, and the same stretched by so little that only their being casters is different.
fn both(things: &str) -> [String; 2] {
    ["", ", transform: [scale: [1, 1.000000001, 1.0000000005]]"].map(|stretch| things.replace("STRETCH", stretch))
}

/// The same light with casters as without, on the whole and in each pixel; and of the noise of as many samples no more than this
/// part is left.
fn same_light(name: &str, things: &str, most_noise: f64) {
    same_light_under((0, 6), name, things, most_noise);
}

/// Under the sky turned by so many degrees, and with so many times the samples for what is compared with: where that has rare
/// bright dots, errors of few samples say too little of it.
fn same_light_under((rotation, more): (u32, u32), name: &str, things: &str, most_noise: f64) {
    const SAMPLES: u32 = 256;
    let [casters, others] = both(things);
    let [plain, plain_pixels] = light(("", rotation), more * SAMPLES, &others);
    let noise = |pixels: &[(f64, f64)]| pixels.iter().map(|(mean, square)| square / (mean * mean)).sum::<f64>();
    for path in ["", ", split: 2", ", reuse: 16", ", reuse: 4, split: 3"] {
        let [found, pixels] = light((path, rotation), SAMPLES, &casters);
        let name = format!("{name}{path}");
        assert_same(&name, &plain, &found);
        assert_same_pixels(&name, &plain_pixels, &pixels);
        let left = noise(&pixels) / (f64::from(more) * noise(&plain_pixels));
        assert!(left < most_noise, "{name}: of the noise without, {left} is left");
    }
}

const GLASS: &str = "glass: {ior: 1.5, color: [0.9, 0.95, 1]}";

#[test]
fn a_ball_of_glass() {
    same_light("ball", &format!("- sphere: {{center: [0, 0.9, 0], radius: 0.4, material: {{{GLASS}}}STRETCH}}\n"), 0.3);
}

/// Near to the floor, where light is gathered behind it, and some floor is under it.
#[test]
fn a_ball_of_glass_that_lies() {
    same_light(
        "ball",
        &format!("- sphere: {{center: [0, 0.42, 0], radius: 0.4, material: {{{GLASS}}}STRETCH}}\n"),
        0.7,
    );
}

#[test]
fn cylinders_of_glass() {
    let standing =
        format!("- cylinder: {{base: [0, 0.02, 0], top: [0, 1.1, 0], radius: 0.3, material: {{{GLASS}}}STRETCH}}\n");
    same_light("standing", &standing, 0.3);
    let leaning = format!(
        "- cylinder: {{base: [-0.5, 0.3, 0], top: [0.6, 0.8, 0.2], radius: 0.25, material: {{{GLASS}}}STRETCH}}\n"
    );
    same_light("leaning", &leaning, 0.3);
}

#[test]
fn mirrors() {
    let mirrors = "- sphere: {center: [-0.6, 0.5, 0], radius: 0.4, material: {metal: {of: gold}}STRETCH}\n\
                   - cylinder: {base: [0.5, 0, -0.6], top: [0.6, 1.2, -0.6], radius: 0.3, material: {mirror: {}}STRETCH}\n";
    same_light("mirrors", mirrors, 0.5);
}

/// Other things before and behind a ball, and in it.
#[test]
fn what_is_in_the_way() {
    let things = format!(
        "- sphere: {{center: [0, 0.5, 0], radius: 0.4, material: {{{GLASS}}}STRETCH}}\n\
         - sphere: {{center: [0.1, 0.5, 0], radius: 0.15, material: {{matte: {{color: 0.5}}}}}}\n\
         - cylinder: {{base: [-0.7, 0.02, 0.3], top: [-0.7, 0.9, 0.3], radius: 0.25, material: {{{GLASS}}}STRETCH}}\n\
         - box: {{min: [0.2, 0.8, -0.5], max: [0.6, 0.85, 0], material: {{matte: {{color: 0.7}}}}}}\n\
         - rectangle: {{corner: [-1, 1, -1], edges: [[0.8, 0, 0], [0, 0, 0.8]], \
         material: {{glass: {{ior: 1.5, thin: true, color: [0.5, 0.7, 0.9]}}}}}}\n"
    );
    same_light("crowd", &things, 0.8);
}

/// Light that comes from behind a wall, which sees it by way of a ball alone: under one of the two skies.
#[test]
fn from_behind() {
    let wall = "- rectangle: {corner: [-2, 0, -0.5], edges: [[4, 0, 0], [0, 3, 0]], material: {matte: {color: 0.8}}}\n";
    for (name, material) in [("mirror", "mirror: {}"), ("glass", GLASS)] {
        let ball = format!("- sphere: {{center: [0.3, 1, 0.6], radius: 0.4, material: {{{material}}}STRETCH}}\n");
        for rotation in [0, 180] {
            same_light_under((rotation, 6), name, &format!("{wall}{ball}"), 2.0);
        }
    }
}

/// Where both ways to find light count alike, who splits must say so to both.
#[test]
fn glossy_floors() {
    let things = format!(
        "- rectangle: {{corner: [-3, 0.01, -3], edges: [[0, 0, 6], [6, 0, 0]], \
         material: {{metal: {{of: silver, roughness: 0.35}}}}}}\n\
         - sphere: {{center: [-0.5, 0.6, 0], radius: 0.5, material: {{{GLASS}}}STRETCH}}\n\
         - cylinder: {{base: [0.7, 0.1, 0], top: [0.7, 1, 0.3], radius: 0.3, material: {{{GLASS}}}STRETCH}}\n"
    );
    same_light_under((0, 24), "glossy", &things, 1.0);
}

/// Matte things with casters in a tank of glass: nothing is aimed at from in there, so sample by sample it is as without.
#[test]
fn in_a_tank() {
    let things = format!(
        "- box: {{min: [-1.5, 0.05, -1.5], max: [1.5, 2, 1.5], material: {{glass: {{ior: 1.3}}}}}}\n\
         - box: {{min: [-1, 0.1, -1], max: [1, 0.2, 1], material: {{matte: {{color: 0.7}}}}}}\n\
         - sphere: {{center: [0, 0.8, 0], radius: 0.4, material: {{{GLASS}}}STRETCH}}\n"
    );
    let [casters, others] = both(&things).map(|things| render(&scene(("", 0), 64, 1, &things), &sky()));
    let is_same = |(a, b): (&Rgb, &Rgb)| (a.luminance() - b.luminance()).abs() <= 1e-4 * b.luminance();
    let same = casters.pixels.iter().zip(&others.pixels).filter(|&pair| is_same(pair)).count();
    assert!(same > casters.pixels.len() * 9 / 10, "{same} of {}", casters.pixels.len());
}
