//! The targets: each takes any bytes, and panics if anything but an answer or an error comes of them.

use crate::{Dice, scenes};
use durer::imaging::{DecodeLimits, Image, decode};
use durer::math::{Fingerprint, Rgb};
use durer::{AssetError, Assets, CheckedScene, Checkpoint, Limits, PixelExplanation, RenderOptions, encode_checkpoint};

/// A target, as the fuzzer and the tests call it.
pub type Target = fn(&[u8]);

/// All targets by name, which is that of their file in `fuzz/fuzz_targets` and of their folder in `fuzz/regressions`.
pub const TARGETS: [(&str, Target); 9] = [
    ("scene", scene),
    ("obj", obj),
    ("ply", ply),
    ("stl", stl),
    ("gltf", gltf),
    ("image", image),
    ("table", table),
    ("checkpoint", checkpoint),
    ("render", render),
];

/// One file, whatever its name.
struct Same<'b>(&'b [u8]);

impl Assets for Same<'_> {
    fn read(&self, _: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        match self.0.len() as u64 > max_bytes {
            true => Err(AssetError::TooLarge(self.0.len() as u64)),
            false => Ok(self.0.to_vec()),
        }
    }
}

/// Less than by default, since each try should be over soon.
fn limits() -> Limits {
    Limits { max_texture_bytes: 4 << 20, max_primitives: 1 << 18, max_values: 100_000, ..Limits::default() }
}

/// What stands before the first zero byte, and what stands behind: text files have none.
fn halves(bytes: &[u8]) -> (&[u8], &[u8]) {
    match bytes.iter().position(|byte| *byte == 0) {
        Some(zero) => (&bytes[..zero], &bytes[zero + 1..]),
        None => (bytes, &[]),
    }
}

/// Loads a file; what can be loaded can be written, and loaded again.
fn load(name: &str, file: &[u8], beside: &[u8]) -> Option<CheckedScene> {
    match durer::load_bytes(file, name, &Same(beside), &limits()) {
        Ok(loaded) => Some(loaded.scene),
        Err(diagnostics) => {
            assert!(!diagnostics.list.is_empty(), "refused without a reason");
            assert!(diagnostics.render(true).len() < 1 << 20, "a message without end");
            None
        }
    }
}

/// A scene file, and after a zero byte what is in all files that it names.
pub fn scene(bytes: &[u8]) {
    let (file, beside) = halves(bytes);
    let Some(scene) = load("scene.yaml", file, beside) else { return };
    let text = durer::to_yaml(scene.scene());
    if let Err(diagnostics) = durer::load_str(&text, "written.yaml", &Same(beside), &Limits::default()) {
        panic!("what was written cannot be read:\n{diagnostics}\n{text}");
    }
}

/// An OBJ file, and after a zero byte its MTL file, which is its picture, too.
pub fn obj(bytes: &[u8]) {
    let (file, beside) = halves(bytes);
    load("model.obj", file, beside);
}

/// A PLY file.
pub fn ply(bytes: &[u8]) {
    load("model.ply", bytes, &[]);
}

/// An STL file.
pub fn stl(bytes: &[u8]) {
    load("model.stl", bytes, &[]);
}

/// A GLB file; or a glTF file and, after a zero byte, what is in all files that it names.
pub fn gltf(bytes: &[u8]) {
    let (file, beside) = if bytes.starts_with(b"glTF") { (bytes, &[][..]) } else { halves(bytes) };
    load("model.gltf", file, beside);
}

/// A picture in any format.
pub fn image(bytes: &[u8]) {
    let limits = DecodeLimits { max_pixels: 1 << 18, max_bytes: 1 << 22 };
    if let Ok(bitmap) = decode(bytes, &limits) {
        let pixels = u64::from(bitmap.width) * u64::from(bitmap.height);
        assert!((1..=limits.max_pixels).contains(&pixels), "{pixels} pixels");
        assert_eq!(bitmap.to_image(durer::imaging::Transfer::Srgb).pixels.len() as u64, pixels);
    }
}

/// A byte that chooses the kind, and a file of numbers of that kind.
pub fn table(bytes: &[u8]) {
    let Some((kind, file)) = bytes.split_first() else { return };
    let ending = ["npy", "csv", "xyz", "ply", "txt", "tsv", "dat"][usize::from(kind % 7)];
    for objects in ["spheres: {file: F}", "capsules: {file: F}", "spheres: {centers: {file: F}, radius: 1}"] {
        let text = format!("objects: [{}]", objects.replace('F', &format!("numbers.{ending}")));
        load("scene.yaml", text.as_bytes(), file);
    }
}

/// A checkpoint; and one with these bytes before a sum that is right, for else nothing but sums would be tried. What is read
/// is written as it was.
pub fn checkpoint(bytes: &[u8]) {
    let _ = Checkpoint::decode(bytes);
    let mut summed = bytes.to_vec();
    summed.extend(Fingerprint::of(bytes).0.to_le_bytes());
    if let Ok(checkpoint) = Checkpoint::decode(&summed) {
        assert!(
            encode_checkpoint(&checkpoint.origin, &checkpoint.scene, &checkpoint.film, checkpoint.seconds) == summed
        );
    }
}

/// A scene that bytes build: what passes the check renders.
pub fn render(bytes: &[u8]) {
    let scene = scenes::scene(&mut Dice::of_bytes(bytes), scenes::Temper::Extreme);
    if let Ok(scene) = scene.check()
        && let Err(wrong) = picture(&scene)
    {
        panic!("{wrong}: {scene:#?}");
    }
}

/// The mean of the samples of a pixel, each traced once more for the explanation, if it is not this color: but for the
/// rounding of sums, and for light that is too bright to be summed.
fn mean_unlike(explained: &PixelExplanation, shown: Rgb) -> Option<[f64; 3]> {
    let counted = || explained.samples.iter().filter_map(|sample| Some((sample.weight?.signum(), sample.color)));
    let negative = counted().filter(|(sign, _)| *sign < 0.0).count() as f64;
    let count = counted().count() as f64;
    // As films have it where a filter is below 0.
    let divisor = (count - 2.0 * negative).max(0.5 * count).max(1.0);
    let (mut sum, mut size) = ([0.0_f64; 3], 0.0_f64);
    for (sign, color) in counted() {
        for (sum, component) in sum.iter_mut().zip(color.to_array()) {
            *sum += f64::from(sign * component) / divisor;
            size = size.max(f64::from(component).abs());
        }
    }
    let is_near = |(mean, shown): (&f64, f32)| (mean - f64::from(shown)).abs() <= 1e-5 * size + 1e-15;
    let is_alike = size > 1e10 || sum.iter().zip(shown.to_array()).all(is_near);
    (!is_alike).then_some(sum)
}

/// Renders a scene.
///
/// # Errors
/// What is wrong with the picture: all colors must be finite and none negative, and `explain` must agree.
pub fn picture(scene: &CheckedScene) -> Result<Image, String> {
    let compiled = durer::compile(scene);
    let film = durer::render(&compiled, &RenderOptions::default(), &()).map_err(|error| error.to_string())?;
    if let Some(sample) = film.first_bad_sample() {
        return Err(format!("{} samples are not finite, the first at {}", film.bad_samples(), sample.at));
    }
    let image = film.develop();
    let is_color = |pixel: &Rgb| pixel.is_finite() && pixel.min_component() >= 0.0;
    if let Some(pixel) = image.pixels.iter().find(|pixel| !is_color(pixel)) {
        return Err(format!("{pixel:?} is no color"));
    }
    let (x, y) = (image.width / 2, image.height / 3);
    let explained = durer::explain(&compiled, x, y);
    let (color, shown) = (explained.as_ref().map(|explained| explained.color), image.pixel(x, y));
    let wrong = |found: &dyn std::fmt::Debug| {
        let integrator = scene.scene().render.integrator.word();
        Err(format!("{integrator}: pixel {x},{y} is {shown:?}, but is explained as {found:?}"))
    };
    if color != Some(shown) {
        return wrong(&color);
    }
    match explained.filter(|explained| explained.is_mean).and_then(|explained| mean_unlike(&explained, shown)) {
        Some(mean) => wrong(&mean),
        None => Ok(image),
    }
}
