//! `cargo xtask bench antialias`: rays a pixel and error of every way of anti-aliasing, on pictures that are hard in
//! different ways.

mod scenes;

use super::options::Options;
use super::report::{keep, place};
use durer::scene::{Antialias, PixelFilter};
use durer::{RenderOptions, Scene, imaging::Image};
use scenes::Subject;
use std::fmt::Write as _;

/// The truth is the mean of so many by so many samples in each pixel.
const TRUTH: u32 = 64;

const NAMES: [&str; 5] = ["edges", "star", "discs", "zone plate", "room"];

/// What is compared, with what it is called in the table.
fn modes() -> Vec<(String, Antialias)> {
    let mut modes = vec![("none".to_owned(), Antialias::None)];
    modes.extend([2, 3, 4, 8].map(|n| (format!("grid: {n}"), Antialias::Grid { n })));
    let recursive = |max_depth| Antialias::Recursive { threshold: 0.3, max_depth };
    modes.extend([1, 3, 5].map(|depth| (format!("recursive, depth {depth}"), recursive(depth))));
    modes.extend([3, 5].map(|depth| (format!("pov1, depth {depth}"), Antialias::Pov1 { threshold: 0.3, depth })));
    modes.extend([3, 5].map(|depth| (format!("pov2, depth {depth}"), Antialias::Pov2 { threshold: 0.3, depth })));
    let adaptive = |threshold| Antialias::Adaptive { threshold, max_depth: 4 };
    modes.extend(
        [0.1_f32, 0.03, 0.01].map(|threshold| (format!("adaptive, threshold {threshold}"), adaptive(threshold))),
    );
    modes
}

/// What a mode took and gave.
#[derive(Clone, Debug)]
struct Outcome {
    mode: String,
    rays: f64,
    error: f64,
    greatest: f64,
}

/// Measures and writes the report.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let names = options.names("--scenes", &NAMES)?;
    let mut text = format!(
        "# Anti-aliasing: rays and errors\n\n{}\n\nErrors are root mean squares over all pixels and components, in linear \
         light, against {TRUTH} × {TRUTH} samples in\neach pixel; the last column is the largest of a pixel. No clock is \
         involved: the figures are the same on every machine.\n",
        place()?
    );
    let mut verdicts = String::new();
    for name in names {
        let subject = scenes::subject(name)?;
        println!("{name}: the truth");
        let truth = render(&subject, Antialias::Grid { n: TRUTH })?.0;
        let mut results = Vec::new();
        for (mode, antialias) in modes() {
            println!("{name}: {mode}");
            let (image, rays) = render(&subject, antialias)?;
            let (error, greatest) = errors(&image, &truth);
            results.push(Outcome { mode, rays, error, greatest });
        }
        text += &table(&subject, &results);
        verdicts += &verdict(name, &results)?;
    }
    write!(text, "\n## What adaptive is to be, with the usual threshold of 0.03 or else with another\n\n{verdicts}")
        .map_err(|error| error.to_string())?;
    keep("antialias", &text)
}

/// The picture, and rays of the eye in a pixel.
fn render(subject: &Subject, antialias: Antialias) -> Result<(Image, f64), String> {
    let mut scene: Scene = subject.scene.clone();
    (scene.render.antialias, scene.render.filter) = (antialias, PixelFilter::Box);
    let scene = scene.check().map_err(|problems| format!("{problems:?}"))?;
    let film = durer::render(&durer::compile(&scene), &RenderOptions::default(), &()).map_err(|e| e.to_string())?;
    let rays = film.rays().eye as f64 / film.region().pixels() as f64;
    Ok((film.develop(), rays))
}

/// The root of the mean square, and the greatest, of differences of components.
fn errors(image: &Image, truth: &Image) -> (f64, f64) {
    let (mut squares, mut greatest) = (0.0, 0.0_f64);
    for (a, b) in image.pixels.iter().zip(&truth.pixels) {
        for difference in (*a - *b).to_array().map(f64::from) {
            squares += difference * difference;
            greatest = greatest.max(difference.abs());
        }
    }
    ((squares / (3 * truth.pixels.len()) as f64).sqrt(), greatest)
}

fn table(subject: &Subject, results: &[Outcome]) -> String {
    let mut text = format!(
        "\n## {}\n\n{}\n\n| mode | rays a pixel | error | largest |\n|---|---:|---:|---:|\n",
        subject.name, subject.about
    );
    for Outcome { mode, rays, error, greatest } in results {
        text += &format!("| {mode} | {rays:.2} | {error:.5} | {greatest:.3} |\n");
    }
    text
}

/// At no more rays than recursion of depth 5, at most a third of its error; and against POV-Ray's method 2 of depth 5, with no
/// more rays, no worse on edges and a fifth of the error on discs.
fn verdict(name: &str, results: &[Outcome]) -> Result<String, String> {
    let find = |mode: &str| {
        results.iter().find(|result| result.mode == mode).ok_or_else(|| format!("there is no mode `{mode}`"))
    };
    let mut wanted = vec![("recursive, depth 5", 1.0 / 3.0)];
    match name {
        "edges" => wanted.push(("pov2, depth 5", 1.0)),
        "discs" => wanted.push(("pov2, depth 5", 0.2)),
        _ => {}
    }
    let mut text = String::new();
    for (mode, part) in wanted {
        let other = find(mode)?;
        let holds = |ours: &&Outcome| ours.rays <= other.rays && ours.error <= part * other.error;
        let usual = find("adaptive, threshold 0.03")?;
        let ours = results.iter().filter(|ours| ours.mode.starts_with("adaptive"));
        let ours = std::iter::once(usual).chain(ours).find(holds).unwrap_or(usual);
        let holds = holds(&ours);
        text += &format!(
            "- {name}, {} against {mode}: {:.2} of its rays, {:.3} of its error (at most 1 and {part:.3}): {}\n",
            ours.mode,
            ours.rays / other.rays,
            ours.error / other.error,
            if holds { "reached" } else { "**not reached**" },
        );
    }
    Ok(text)
}
