//! `cargo xtask bench path`: path tracing to equal error, in durer, Mitsuba 3 and Cycles.
//!
//! Each program draws each scene twice, with different random numbers. Half the squared difference of the two is the
//! variance, which needs no picture to compare with; the mean of the two says whether a program draws something else.

mod scenes;

use super::options::Options;
use super::{machine, measure, report};
use crate::shell;
use durer::imaging::{DecodeLimits, EncodeOptions, FileFormat, Image, Transfer, encode};
use durer::math::Rgb;
use scenes::{Rows, Scene};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Width and height of the pictures.
const SIZE: usize = 512;
/// Samples a pixel.
const SAMPLES: usize = 64;
/// Rounds of which the median counts.
const ROUNDS: usize = 3;

/// A program, and how it is started.
struct Program {
    name: String,
    argv: Box<Start>,
    ending: &'static str,
    /// The key of the seconds of rendering in what it prints.
    seconds: fn(&Value) -> Option<f64>,
}

/// The command for a scene, with samples, seed and a file for the picture.
type Start = dyn Fn(&Scene, usize, u32, &str) -> Vec<String>;

/// What a program made of a scene.
struct Outcome {
    program: String,
    /// Median.
    seconds: f64,
    /// The mean of the two pictures of each round is taken over all rounds.
    mean: Image,
    pairs: Vec<[Image; 2]>,
}

/// Measures and writes the report.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let rounds = options.count("--rounds", ROUNDS)?;
    let samples = options.count("--samples", SAMPLES)?;
    let size = options.count("--size", SIZE)? as u32;
    let names = options.names("--scenes", &["cornell", "thousand"])?;
    let threads = machine::cores();
    let folder = std::env::temp_dir().join(format!("durer-bench-path-{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let programs = programs(threads)?;
    let mut text =
        format!("# Path tracing to equal error\n\n{}\n\n{}", report::place()?, about(rounds, samples, size, threads));
    for scene in [scenes::cornell(size), scenes::thousand(size)].iter().filter(|scene| names.contains(&scene.name)) {
        prepare(scene, &folder)?;
        let outcomes: Vec<Outcome> =
            programs.iter().map(|program| draw(program, scene, samples, rounds, &folder)).collect::<Result<_, _>>()?;
        text += &table(scene, samples, &outcomes);
    }
    // What is left are pictures in the system's folder for such things.
    let _ = std::fs::remove_dir_all(&folder);
    report::keep("path", &text)
}

/// durer, and those of the others that are there.
fn programs(threads: usize) -> Result<Vec<Program>, String> {
    let durer = shell::build_durer()?.display().to_string();
    let scripts = shell::root().join("benches/path");
    let mut programs = vec![Program {
        name: "durer".to_owned(),
        argv: Box::new(move |scene, samples, seed, out| {
            let words =
                format!("--samples {samples} --seed {seed} --threads {threads} --stats json --no-checkpoint -o {out}");
            let scene = format!("{}.yaml", scene.name);
            [durer.clone(), "render".into(), scene].into_iter().chain(words.split(' ').map(str::to_owned)).collect()
        }),
        ending: "exr",
        seconds: |stats| stats["seconds"]["render"].as_f64(),
    }];
    let seconds = |printed: &Value| printed["render"].as_f64();
    match python("DURER_BENCH_MITSUBA", "mitsuba") {
        Some(python) => {
            for variant in ["scalar_rgb", "llvm_ad_rgb"] {
                let (python, script) = (python.clone(), scripts.join("mitsuba_render.py").display().to_string());
                programs.push(Program {
                    name: format!("Mitsuba 3, {variant}"),
                    argv: Box::new(move |scene, samples, seed, out| {
                        let words = format!("{variant} {}.json {samples} {seed} {threads} {out}", scene.name);
                        [python.clone(), script.clone()]
                            .into_iter()
                            .chain(words.split(' ').map(str::to_owned))
                            .collect()
                    }),
                    ending: "pfm",
                    seconds,
                });
            }
        }
        None => {
            println!("Mitsuba is left out: pip install mitsuba, or name a Python that has it in DURER_BENCH_MITSUBA");
        }
    }
    match python("DURER_BENCH_CYCLES", "bpy") {
        Some(python) => {
            let script = scripts.join("cycles_render.py").display().to_string();
            programs.push(Program {
                name: "Cycles".to_owned(),
                argv: Box::new(move |scene, samples, seed, out| {
                    let words = format!("{}.json {samples} {seed} {threads} {out}", scene.name);
                    [python.clone(), script.clone()].into_iter().chain(words.split(' ').map(str::to_owned)).collect()
                }),
                ending: "exr",
                seconds,
            });
        }
        None => println!("Cycles is left out: pip install bpy, or name a Python that has it in DURER_BENCH_CYCLES"),
    }
    Ok(programs)
}

/// A Python that has this module.
fn python(variable: &str, module: &str) -> Option<String> {
    let python = std::env::var(variable).unwrap_or_else(|_| "python3".to_owned());
    let has = Command::new(&python).args(["-c", &format!("import {module}")]).output();
    has.is_ok_and(|output| output.status.success()).then_some(python)
}

/// Writes the scene for each program.
fn prepare(scene: &Scene, folder: &Path) -> Result<(), String> {
    shell::write(&folder.join(format!("{}.yaml", scene.name)), scene.yaml())?;
    shell::write(&folder.join(format!("{}.json", scene.name)), scene.json().to_string())?;
    for (file, rows) in [(scenes::SKY, Rows::Even), (scenes::SKY_TO_THE_POLES, Rows::ToThePoles)] {
        let sky = encode(&scenes::sky(rows), &EncodeOptions::new(FileFormat::Exr));
        shell::write(&folder.join(file), sky.map_err(|error| error.to_string())?)?;
    }
    Ok(())
}

fn draw(program: &Program, scene: &Scene, samples: usize, rounds: usize, folder: &Path) -> Result<Outcome, String> {
    let (mut seconds, mut pairs) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        println!("{}: {}, round {} of {rounds}", scene.name, program.name, round + 1);
        let mut one = |seed: u32| {
            let out = format!("{}-{}-{seed}.{}", scene.name, machine::slug(&program.name), program.ending);
            let run = measure::run(&(program.argv)(scene, samples, seed, &out), folder)?;
            let printed = run.printed.lines().rev().find_map(|line| serde_json::from_str::<Value>(line).ok());
            let printed = printed.or_else(|| serde_json::from_str(&run.printed).ok());
            seconds
                .push(printed.as_ref().and_then(program.seconds).ok_or_else(|| format!("no time in {}", run.printed))?);
            read(&folder.join(out))
        };
        pairs.push([one(2 * round as u32 + 1)?, one(2 * round as u32 + 2)?]);
    }
    let mean = mean_of(&pairs.iter().flatten().collect::<Vec<_>>());
    let seconds = report::median(seconds).unwrap_or(f64::NAN);
    Ok(Outcome { program: program.name.clone(), seconds, mean, pairs })
}

fn read(path: &Path) -> Result<Image, String> {
    let bitmap = durer::read_picture(path, &DecodeLimits::default()).map_err(|error| error.to_string())?;
    Ok(bitmap.to_image(Transfer::Linear))
}

/// Mean over pixels and components of half the squared difference, divided by the squared value and 0.01.
fn relative_variance(pairs: &[[Image; 2]], reference: &Image) -> f64 {
    let mut sum = 0.0;
    for [first, second] in pairs {
        for ((a, b), r) in first.pixels.iter().zip(&second.pixels).zip(&reference.pixels) {
            for ((a, b), r) in a.to_array().into_iter().zip(b.to_array()).zip(r.to_array()) {
                let (difference, r) = (f64::from(a - b), f64::from(r));
                sum += 0.5 * difference * difference / (r * r + 0.01);
            }
        }
    }
    sum / (3 * pairs.len() * reference.pixels.len()) as f64
}

/// What all programs but one draw, or that one if it is alone. With its own pictures as the reference, a program's bright dots would
/// be measured by themselves: none could count more than 2.
fn drawn_by_others(outcomes: &[Outcome], index: usize) -> Image {
    let others = outcomes.iter().enumerate().filter(|(other, _)| *other != index || outcomes.len() == 1);
    mean_of(&others.map(|(_, outcome)| &outcome.mean).collect::<Vec<_>>())
}

fn mean_of(images: &[&Image]) -> Image {
    let mut mean = images[0].clone();
    for (index, pixel) in mean.pixels.iter_mut().enumerate() {
        let sum = images.iter().fold(Rgb::BLACK, |sum, image| sum + image.pixels[index]);
        *pixel = sum * (1.0 / images.len() as f32);
    }
    mean
}

/// How much brighter than the reference, on the whole.
fn brightness(image: &Image, reference: &Image) -> f64 {
    let total = |image: &Image| image.pixels.iter().map(|pixel| f64::from(pixel.luminance())).sum::<f64>();
    total(image) / total(reference) - 1.0
}

fn table(scene: &Scene, samples: usize, outcomes: &[Outcome]) -> String {
    let [durer, ..] = outcomes else { return String::new() };
    let mut text = format!(
        "## {}\n\n| program | seconds for {samples} samples a pixel | relMSE | seconds to durer's relMSE | ÷ durer's | brighter than durer |\n|---|---:|---:|---:|---:|---:|\n",
        scene.name
    );
    let error_of = |index: usize| relative_variance(&outcomes[index].pairs, &drawn_by_others(outcomes, index));
    let ours = error_of(0);
    for (index, outcome) in outcomes.iter().enumerate() {
        let error = error_of(index);
        let equal = outcome.seconds * error / ours;
        text += &format!(
            "| {} | {:.2} | {error:.5} | {equal:.2} | {:.2} | {:+.2} % |\n",
            outcome.program,
            outcome.seconds,
            equal / durer.seconds,
            100.0 * brightness(&outcome.mean, &durer.mean)
        );
    }
    text + "\n"
}

fn about(rounds: usize, samples: usize, size: u32, threads: usize) -> String {
    format!(
        "{size} × {size} pixels, {samples} samples a pixel, {threads} threads, box filter; no denoising, no clamping, no adaptive\n\
         sampling. Seconds are those that each program takes to render, without loading; for Mitsuba's compiled variant those of a\n\
         second picture, when the code is there already. Median of {rounds} rounds of two pictures. relMSE is half the squared\n\
         difference of two pictures with different random numbers, over the square of the value plus 0.01: the variance, which an\n\
         unbiased program's error is. The value is the mean of what the other programs draw. Seconds to equal relMSE assume that four times the samples halve the error. In the box\n\
         durer's paths are reused by blocks of 4 × 4 pixels (`reuse: 16`), in which the rest of its noise is alike, and looks four\n\
         times for what cannot be (`split: 4`); the others have no words for that.\n\n\
         `cornell` is the Cornell box with the numbers of Mitsuba's. `thousand` are balls and tubes of gold, steel, glass and\n\
         clay under an environment map; Cycles draws them as meshes of 96 sides. Mitsuba's rough metals lose what light meets\n\
         several microfacets (in a white furnace balls of gold and steel as rough as these give back 1.4 and 5.8 % less red than\n\
         durer's, which white ones tell to give back all); Cycles' and durer's do not. With metals as smooth as mirrors, or of\n\
         clay or glass alone, means agree within their errors. Mitsuba's rows of pixels reach from pole to pole, so it gets the\n\
         same sky on other rows.\n\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn variance_is_that_of_one_picture() {
        let image = |values: [f32; 2]| Image { width: 2, height: 1, pixels: values.map(Rgb::gray).to_vec() };
        // Both differ by 0.2 around 1: half of 0.04, over 1.01.
        let found = relative_variance(&[[image([0.9, 1.1]), image([1.1, 0.9])]], &image([1.0, 1.0]));
        assert!((found - 0.02 / 1.01).abs() < 1e-6, "{found}");
        assert!((brightness(&image([1.1, 1.1]), &image([1.0, 1.0])) - 0.1).abs() < 1e-6);
    }

    #[test]
    fn scenes_are_read() {
        for scene in [scenes::cornell(64), scenes::thousand(64)] {
            let _ = (scene.json(), scene.yaml());
        }
    }
}
