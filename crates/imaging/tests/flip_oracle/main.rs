//! Our FLIP against the reference implementation of its authors, whose results for these pictures are in `reference`.

mod reference;

use durer_imaging::{Bitmap, Image, Texels, Transfer, compare};

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;

type Texel = [u8; 3];

fn image(texels: &[Texel]) -> Image {
    let texels = Texels::U8(texels.to_vec());
    Bitmap { width: WIDTH, height: HEIGHT, texels, alpha: None }.to_image(Transfer::Srgb)
}

fn picture(texel: impl Fn(u32, u32) -> Texel) -> Vec<Texel> {
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect()
}

fn check(what: &str, a: &[Texel], b: &[Texel]) {
    let ours = compare(&image(a), &image(b)).unwrap();
    let (_, mean, picks) = reference::RESULTS.iter().find(|(name, ..)| *name == what).unwrap();
    assert!((ours.flip_mean - mean).abs() < 1e-4, "{what}: mean {} instead of {mean}", ours.flip_mean);
    for (i, theirs) in (0..).zip(picks) {
        let (x, y) = (8 + i % 6 * 16, 8 + i / 6 * 16);
        let ours = ours.flip.values[(y * WIDTH + x) as usize];
        assert!((ours - theirs).abs() < 1e-3, "{what}: {ours} instead of {theirs} in pixel {x},{y}");
    }
}

/// Numbers without a pattern, the same every time.
fn noise(x: u32, y: u32, salt: u32) -> u8 {
    let mut state = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ salt.wrapping_mul(0xc2b2_ae35);
    for _ in 0..3 {
        state ^= state >> 15;
        state = state.wrapping_mul(0x2c1b_3c6d);
    }
    (state >> 24) as u8
}

fn gradient(x: u32, y: u32) -> Texel {
    [(x * 255 / WIDTH) as u8, (y * 255 / HEIGHT) as u8, ((x + y) % 256) as u8]
}

#[test]
fn black_against_white() {
    check("black, white", &picture(|_, _| [0; 3]), &picture(|_, _| [255; 3]));
}

#[test]
fn flat_colors() {
    for [a, b] in [[[0, 255, 0], [0, 0, 255]], [[255, 0, 0], [0, 255, 255]], [[128, 120, 130], [128, 128, 128]]] {
        check(&format!("flat {a:?}"), &picture(|_, _| a), &picture(|_, _| b));
    }
}

#[test]
fn noise_on_a_gradient() {
    let noisy = |x, y| [0, 1, 2].map(|c| gradient(x, y)[c as usize].saturating_add(noise(x, y, c) / 8));
    check("noise", &picture(gradient), &picture(noisy));
}

#[test]
fn noise_against_noise() {
    check(
        "noise, noise",
        &picture(|x, y| [0, 1, 2].map(|c| noise(x, y, c))),
        &picture(|x, y| [3, 4, 5].map(|c| noise(x, y, c))),
    );
}

#[test]
fn fireflies_and_a_shifted_edge() {
    let edge = |at: u32| move |x: u32, y: u32| if 2 * x + y < at { [40, 60, 200] } else { [230, 220, 90] };
    check("edge", &picture(edge(120)), &picture(edge(124)));
    let firefly = |x, y| if (x * 31 + y * 17) % 211 == 0 { [255; 3] } else { gradient(x, y) };
    check("fireflies", &picture(gradient), &picture(firefly));
}

#[test]
fn dark_pictures() {
    let dark = |x: u32, y: u32| gradient(x, y).map(|v| v / 16);
    check("dark", &picture(dark), &picture(|x, y| dark(x, y).map(|v| v + noise(x, y, 9) / 64)));
}
