//! Scenes from text to numbers.

use durer::imaging::Image;
use durer::math::Rgb;
use durer::{CheckedScene, Diagnostic, Limits, NoAssets, RenderOptions};

/// A scene that is written as text.
pub(crate) fn load(text: &str) -> CheckedScene {
    let loaded = match durer::load_str(text, "scene.yaml", &NoAssets, &Limits::default()) {
        Ok(loaded) => loaded,
        Err(diagnostics) => panic!("{diagnostics}\n{text}"),
    };
    // That it is the same light where `reuse` does nothing is tested, too.
    let is_meant = |warning: &Diagnostic| warning.message.starts_with("`reuse` does nothing");
    assert!(loaded.warnings.list.iter().all(is_meant), "{:?}", loaded.warnings);
    loaded.scene
}

/// Renders a scene that is written as text.
pub(crate) fn render(text: &str) -> Image {
    durer::render(&durer::compile(&load(text)), &RenderOptions::default(), &()).expect("it renders").develop()
}

/// The one pixel of a scene, with these settings under `render`, and the standard error of its luminance: from independent
/// renders with other random numbers.
pub(crate) fn pixel(integrator: &str, samples: u32, rest: &str) -> (Rgb, f64) {
    const RENDERS: u32 = 8;
    let one = |seed: u32| {
        let settings = format!(
            "picture: {{width: 1, height: 1}}\n\
             render: {{integrator: {integrator}, samples: {samples}, seed: {seed}}}\n{rest}"
        );
        render(&settings).pixels[0]
    };
    let found: Vec<Rgb> = (1..=RENDERS).map(one).collect();
    let mean = found.iter().fold(Rgb::BLACK, |sum, &one| sum + one) * (1.0 / RENDERS as f32);
    let squares = found.iter().map(|one| f64::from(one.luminance() - mean.luminance()).powi(2)).sum::<f64>();
    (mean, (squares / f64::from(RENDERS * (RENDERS - 1))).sqrt())
}

/// Asserts that a gray pixel has this value, within five standard errors and rounding; and that the error is small enough
/// for that to say something.
pub(crate) fn assert_pixel(integrator: &str, samples: u32, rest: &str, expected: f64) {
    let (found, error) = pixel(integrator, samples, rest);
    assert!(error < 0.02 * expected.max(0.01), "too noisy to tell: {found:?} ± {error}\n{rest}");
    for component in found.to_array() {
        let off = (f64::from(component) - expected).abs();
        assert!(off <= 5.0 * error + 2e-4 * expected, "{found:?} ± {error}, not {expected}\n{rest}");
    }
}

/// Mean and the square of its standard error of what is measured of independent renders.
pub(crate) fn estimate(of: impl Fn(u32) -> Image, measured: impl Fn(&Image) -> Vec<f64>) -> Vec<(f64, f64)> {
    const RENDERS: u32 = 8;
    let n = f64::from(RENDERS);
    let found: Vec<Vec<f64>> = (1..=RENDERS).map(|seed| measured(&of(seed))).collect();
    let estimate_of = |part: usize| {
        let mean = found.iter().map(|one| one[part]).sum::<f64>() / n;
        let squares = found.iter().map(|one| (one[part] - mean).powi(2)).sum::<f64>();
        (mean, squares / (n * (n - 1.0)))
    };
    (0..found[0].len()).map(estimate_of).collect()
}

/// All components of all pixels.
pub(crate) fn components(image: &Image) -> Vec<f64> {
    image.pixels.iter().flat_map(|pixel| pixel.to_array()).map(f64::from).collect()
}

/// The mean of each component of each half of a picture.
pub(crate) fn halves(image: &Image) -> Vec<f64> {
    let mut sums = vec![0.0; 6];
    for (index, pixel) in image.pixels.iter().enumerate() {
        let right = usize::from(index as u32 % image.width > image.width / 2);
        for (channel, component) in pixel.to_array().into_iter().enumerate() {
            sums[3 * right + channel] += f64::from(component);
        }
    }
    sums.into_iter().map(|sum| sum / (image.pixels.len() / 2) as f64).collect()
}

/// The same light in both halves within its error, which is to be small enough for that to say something.
pub(crate) fn assert_same(name: &str, plain: &[(f64, f64)], other: &[(f64, f64)]) {
    for (part, (&(mean, square), &(found, squared))) in plain.iter().zip(other).enumerate() {
        let error = (square + squared).sqrt();
        assert!(mean > 0.0 && error < 0.02 * mean, "{name}: too noisy to tell, {mean} and {found} ± {error}");
        let off = (found - mean) / error;
        assert!(off.abs() < 4.5, "{name}, part {part}: {found} in place of {mean}, {off} times the error");
    }
}

/// The same light in each pixel: wrong weights may take from one what they give to another of the same block. Differences, as
/// parts of their errors, follow Student's distribution with 14 degrees of freedom; their squares have a mean of 14/12.
pub(crate) fn assert_same_pixels(name: &str, plain: &[(f64, f64)], other: &[(f64, f64)]) {
    let both = plain.iter().zip(other).filter(|((_, square), (_, squared))| square + squared > 0.0);
    let squares: Vec<f64> = both.map(|((a, aa), (b, bb))| (a - b).powi(2) / (aa + bb)).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!(mean < 1.6, "{name}: the mean square of the differences is {mean} times that of their errors");
}
