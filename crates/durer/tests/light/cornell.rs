//! The Cornell box against a reference of Mitsuba 3.9 (`mi.cornell_box()`, 4096 samples a pixel at 512 × 512, box filter,
//! averaged to 64 × 64 pixels: 262,144 samples a pixel).

use crate::support::render;
use durer::imaging::{DecodeLimits, Image, Transfer};

const RENDERS: u32 = 16;

fn one(path: &str, seed: u32) -> Image {
    let box_scene = include_str!("../../../../scenes/cornell.yaml");
    let (head, rest) = box_scene.split_once("# picture and settings\n").expect("the place of the settings");
    let (_, rest) = rest.split_once("# end of settings\n").expect("their end");
    let settings = format!(
        "picture: {{width: 64, height: 64}}\n\
         render: {{integrator: {{path: {{max_depth: 8{path}}}}}, samples: 16, seed: {seed}}}\n"
    );
    render(&format!("{head}{settings}{rest}"))
}

fn reference() -> Image {
    let reference = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/light/cornell-64.pfm");
    let reference = durer::read_picture(&reference, &DecodeLimits::default()).expect("the reference is there");
    reference.to_image(Transfer::Linear)
}

/// Means over independent renders, by how far they are from the reference in standard errors: Student's t, of blocks of 4 × 4
/// pixels. The mean of its square is ν/(ν - 2), and no block may be farther off than chance makes one in thousands of such
/// pictures.
#[test]
fn every_block_agrees_with_the_reference() {
    blocks_agree("", 0.002);
}

/// With paths that the 16 pixels of such a block make use of, whose noise is that of one.
#[test]
fn every_block_agrees_with_the_reference_if_paths_are_reused() {
    blocks_agree(", reuse: 16", 0.001);
}

fn blocks_agree(path: &str, off_by: f64) {
    let (reference, renders) = (reference(), renders(path));
    let brightness = |image: &Image| image.pixels.iter().map(|pixel| f64::from(pixel.luminance())).sum::<f64>();
    let ours = renders.iter().map(brightness).sum::<f64>() / f64::from(RENDERS);
    let ratio = ours / brightness(&reference);
    assert!((ratio - 1.0).abs() < off_by, "the picture is {ratio} times as bright");

    let of_blocks = all_t(&renders, &reference, 4);
    let worst = of_blocks.iter().fold(0.0, |worst: f64, t| worst.max(t.abs()));
    assert!(worst < 8.5, "t = {worst}");
    let squares = of_blocks.iter().map(|t| t * t).sum::<f64>() / of_blocks.len() as f64;
    let freedom = f64::from(RENDERS - 1);
    let expected = freedom / (freedom - 2.0);
    assert!((squares / expected - 1.0).abs() < 0.2, "mean of t²: {squares}, not {expected}");
}

/// The same of single pixels. Light that a few paths bring, and the border of the box, make them less than normal, so that the
/// worst ones tell nothing; but no more are far off than chance has it, on either side, and half are on each.
#[test]
fn pixels_agree_with_the_reference() {
    pixels_agree("");
}

#[test]
fn pixels_agree_with_the_reference_if_paths_are_reused() {
    pixels_agree(", reuse: 16");
}

fn pixels_agree(path: &str) {
    let t = all_t(&renders(path), &reference(), 1);
    let share = |is_meant: &dyn Fn(f64) -> bool| t.iter().filter(|t| is_meant(**t)).count() as f64 / t.len() as f64;
    // The quantiles of Student's t for 15 degrees of freedom that 1 and 5 % are beyond.
    let (of_100, of_20) = (share(&|t| t.abs() > 2.947), share(&|t| t.abs() > 2.131));
    assert!((0.005..0.02).contains(&of_100), "{of_100} are beyond what 0.01 should be");
    assert!((0.04..0.07).contains(&of_20), "{of_20} are beyond what 0.05 should be");
    let brighter = share(&|t| t > 0.0);
    assert!((brighter - 0.5).abs() < 0.03, "{brighter} are brighter");
}

fn renders(path: &str) -> Vec<Image> {
    (1..=RENDERS).map(|seed| one(path, seed)).collect()
}

/// Student's t of each component of each block.
fn all_t(renders: &[Image], reference: &Image, block: usize) -> Vec<f64> {
    let side = reference.width as usize;
    let n = renders.len() as f64;
    let mut found = Vec::new();
    for (row, column, channel) in (0..side / block)
        .flat_map(|row| (0..side / block).flat_map(move |column| (0..3).map(move |channel| (row, column, channel))))
    {
        let of = |image: &Image| {
            let pixels = (0..block * block).map(|i| (row * block + i / block) * side + column * block + i % block);
            pixels.map(|index| f64::from(image.pixels[index].to_array()[channel])).sum::<f64>()
        };
        let (values, expected): (Vec<f64>, f64) = (renders.iter().map(of).collect(), of(reference));
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
        // Beside the box there is nothing.
        if expected == 0.0 {
            assert_eq!(mean, 0.0);
            continue;
        }
        found.push((mean - expected) / variance.sqrt().max(1e-4 * expected));
    }
    found
}
