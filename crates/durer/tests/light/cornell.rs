//! The Cornell box against a reference of Mitsuba 3.9 (`mi.cornell_box()`, 4096 samples a pixel at 512 × 512, box filter,
//! averaged to 64 × 64 pixels: 262,144 samples a pixel).

use crate::support::render;
use durer::imaging::{DecodeLimits, Image, Transfer};

const RENDERS: u32 = 16;

fn one(seed: u32) -> Image {
    let box_scene = include_str!("../../../../scenes/cornell.yaml");
    let (head, rest) = box_scene.split_once("# picture and settings\n").expect("the place of the settings");
    let (_, rest) = rest.split_once("# end of settings\n").expect("their end");
    let settings = format!(
        "picture: {{width: 64, height: 64}}\n\
         render: {{integrator: {{path: {{max_depth: 8}}}}, samples: 16, seed: {seed}}}\n"
    );
    render(&format!("{head}{settings}{rest}"))
}

/// Each pixel's mean over independent renders, by how far it is from the reference in standard errors: Student's t. Its
/// square has the mean ν/(ν - 2), and no pixel may be farther off than chance makes one in a hundred such pictures.
#[test]
fn every_pixel_agrees_with_the_reference() {
    let reference = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/light/cornell-64.pfm");
    let reference = durer::read_picture(&reference, &DecodeLimits::default()).expect("the reference is there");
    let reference = reference.to_image(Transfer::Linear);
    let renders: Vec<Image> = (1..=RENDERS).map(one).collect();
    let n = f64::from(RENDERS);
    let (mut squares, mut worst, mut count) = (0.0, 0.0_f64, 0.0);
    let (mut ours, mut theirs) = (0.0, 0.0);
    for (index, expected) in reference.pixels.iter().enumerate() {
        for channel in 0..3 {
            let values: Vec<f64> =
                renders.iter().map(|image| f64::from(image.pixels[index].to_array()[channel])).collect();
            let mean = values.iter().sum::<f64>() / n;
            let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
            let expected = f64::from(expected.to_array()[channel]);
            (ours, theirs) = (ours + mean, theirs + expected);
            // Beside the box there is nothing.
            if expected == 0.0 {
                assert_eq!(mean, 0.0);
                continue;
            }
            let t = (mean - expected) / variance.sqrt().max(1e-4 * expected);
            squares += t * t;
            worst = worst.max(t.abs());
            count += 1.0;
        }
    }
    let freedom = n - 1.0;
    let expected = freedom / (freedom - 2.0);
    assert!((ours / theirs - 1.0).abs() < 0.002, "the picture is {} times as bright", ours / theirs);
    assert!((squares / count / expected - 1.0).abs() < 0.15, "mean of t²: {}, not {expected}", squares / count);
    // For 15 degrees of freedom and one in 12,288 × 100.
    assert!(worst < 8.5, "t = {worst}");
}
