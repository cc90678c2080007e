//! Scenes from text to numbers.

use durer::imaging::Image;
use durer::math::Rgb;
use durer::{CheckedScene, Limits, NoAssets, RenderOptions};

/// A scene that is written as text.
pub(crate) fn load(text: &str) -> CheckedScene {
    let loaded = match durer::load_str(text, "scene.yaml", &NoAssets, &Limits::default()) {
        Ok(loaded) => loaded,
        Err(diagnostics) => panic!("{diagnostics}\n{text}"),
    };
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
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
