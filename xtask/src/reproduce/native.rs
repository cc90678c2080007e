//! In this program: one thread and two, and every instruction set of this machine.

use super::checksums::Checksums;
use super::options::Options;
use super::{LONGER_SIDE, scenes_folder};
use durer::imaging::Image;
use durer::{CheckedScene, LoadOptions, RenderOptions, SimdLevel};

/// A number of threads and an instruction set.
type Way = (usize, SimdLevel);

/// Compares all scenes in all ways that are asked for.
pub(super) fn compare(checksums: &Checksums, scenes: &[String], options: &Options) -> Result<(), String> {
    let ways = ways(options);
    let mut films: Vec<Vec<_>> = ways.iter().map(|_| Vec::new()).collect();
    let mut differences = String::new();
    for name in scenes {
        let scene = load(name)?;
        let mut first: Option<Image> = None;
        for (&way, films) in ways.iter().zip(&mut films) {
            let film = render(&scene, way)?;
            films.push((name.clone(), film.fingerprint()));
            match &first {
                Some(first) => differences += &difference(name, (ways[0], first), (way, &film)),
                None => first = Some(film),
            }
        }
    }
    let mut message = differences;
    for (&way, films) in ways.iter().zip(&films) {
        if let Err(wrong) = checksums.compare(&shown(way), films) {
            message += &format!("{wrong}\n");
        }
    }
    if options.simd.is_none() {
        not_tried().iter().for_each(|left_out| println!("not tried: {left_out}"));
    }
    if message.is_empty() { Ok(()) } else { Err(message) }
}

/// The film of a scene.
pub(super) fn film(name: &str, threads: usize, simd: SimdLevel) -> Result<Image, String> {
    render(&load(name)?, (threads, simd))
}

fn load(name: &str) -> Result<CheckedScene, String> {
    let loaded = durer::load_file(scenes_folder().join(name), &LoadOptions::default());
    let mut scene = loaded.map_err(|diagnostics| diagnostics.render(false))?.scene.into_scene();
    scene.picture = scene.picture.with_longer_side(LONGER_SIDE);
    scene.check().map_err(|problems| format!("{name}: {problems:?}"))
}

fn render(scene: &CheckedScene, (threads, simd): Way) -> Result<Image, String> {
    let render = || durer::render(&durer::compile_for(scene, simd), &RenderOptions::default(), &());
    let film = durer::with_threads(Some(threads), render).flatten();
    Ok(film.map_err(|error| error.to_string())?.develop())
}

/// All ways, or those that the options leave: few threads and many with the best instruction set, then the others.
fn ways(options: &Options) -> Vec<Way> {
    let best = SimdLevel::best();
    let levels = options.simd.map_or_else(SimdLevel::available, |level| vec![level]);
    let mut ways = Vec::new();
    for level in levels.into_iter().rev() {
        let both = level.name() == best.name() || options.simd.is_some();
        let threads = options.threads.map_or(if both { vec![1, 2] } else { vec![2] }, |threads| vec![threads]);
        ways.extend(threads.into_iter().map(|threads| (threads, level)));
    }
    ways
}

fn shown((threads, simd): Way) -> String {
    let build = if cfg!(debug_assertions) { "debug" } else { "release" };
    format!("{} {build}, {simd}, {threads} {}", std::env::consts::ARCH, if threads == 1 { "thread" } else { "threads" })
}

/// Where two films of a scene first differ, in a line; nothing if they are the same.
fn difference(name: &str, (way, film): (Way, &Image), (other_way, other): (Way, &Image)) -> String {
    let bits = |image: &Image, at: usize| image.pixels[at].to_array().map(f32::to_bits);
    let Some(at) = (0..film.pixels.len()).find(|&at| bits(film, at) != bits(other, at)) else { return String::new() };
    let (x, y) = (at as u32 % film.width, at as u32 / film.width);
    let (a, b) = (film.pixels[at].to_array(), other.pixels[at].to_array());
    format!("{name}: pixel {x},{y} is {a:?} ({}) and {b:?} ({})\n", shown(way), shown(other_way))
}

/// The instruction sets of this kind of machine that cannot be tried.
fn not_tried() -> Vec<String> {
    let of_all: &[&str] = match std::env::consts::ARCH {
        "x86_64" | "x86" => &["sse2", "sse4.2", "avx2", "avx512"],
        "aarch64" => &["neon"],
        _ => &[],
    };
    let is_missing = |name: &&&str| SimdLevel::named(name).is_none();
    let mut missing: Vec<String> =
        of_all.iter().filter(is_missing).map(|name| format!("{name}, which this machine lacks")).collect();
    if SimdLevel::named("portable").is_none() {
        missing.push("portable, for which the project must be built with `--features portable`".to_owned());
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer::math::Rgb;

    #[test]
    fn the_first_pixel_that_differs_in_any_bit_is_named() {
        let film = Image::new(3, 2);
        let way = (1, SimdLevel::best());
        assert_eq!(difference("a", (way, &film), (way, &film.clone())), "");
        let mut other = film.clone();
        other.set(1, 1, Rgb::new(0.0, -0.0, 0.0));
        other.set(2, 1, Rgb::WHITE);
        let told = difference("a", (way, &film), (way, &other));
        assert!(told.starts_with("a: pixel 1,1 is [0.0, 0.0, 0.0]") && told.contains("[0.0, -0.0, 0.0]"), "{told}");
    }

    #[test]
    fn all_levels_are_tried_and_the_best_with_one_thread_and_two() {
        let ways = ways(&Options::default());
        assert_eq!(ways.len(), SimdLevel::available().len() + 1);
        let best = SimdLevel::best().name();
        assert!(ways[..2].iter().map(|(threads, level)| (*threads, level.name())).eq([(1, best), (2, best)]));
    }
}
