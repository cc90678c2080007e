//! `cargo xtask bench large`: up to a million balls and tubes in durer, POV-Ray and Tachyon, from file to picture, one
//! thread, one light with shadows.
//!
//! durer reads its shapes from CSV files, as the others read theirs from text, and once more from NumPy's files.

mod durer;
mod povray;
mod tachyon;
mod things;

use super::options::Options;
use super::programs::{self, Case, TACHYON};
use super::report::{self, Row};
use crate::shell;
use ::durer::imaging::{DecodeLimits, Difference, Image, Transfer, compare};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Rounds that count, if nothing else is asked for.
const ROUNDS: usize = 5;

const COUNTS: [usize; 3] = [10_000, 100_000, 1_000_000];

/// Width and height of the pictures.
const SIZE: u32 = 1024;

/// Measures and writes the report.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let rounds = programs::number_of_rounds(options, ROUNDS)?;
    let counts = options.counts("--counts", &COUNTS)?;
    let povray = programs::povray_version()?;
    let durer = shell::build_durer()?;
    let folder = std::env::temp_dir().join(format!("durer-bench-large-{}", std::process::id()));
    counts
        .iter()
        .try_for_each(|&count| prepare(count, &folder).map_err(|error| format!("{}: {error}", folder.display())))?;
    let cases: Vec<Case> = counts.iter().flat_map(|&count| cases(&durer, count)).collect();
    let runs = programs::rounds(&cases, rounds, &folder)?;
    let rows: Vec<Row> = cases.iter().zip(&runs).map(|(case, runs)| Row::of(case, runs)).collect();
    let differences: Vec<String> = counts.iter().map(|&count| differences(count, &folder)).collect::<Result<_, _>>()?;
    // What is left are scenes and pictures in the system's folder for such things.
    let _ = std::fs::remove_dir_all(&folder);
    report::keep("large", &markdown(&rows, &differences, rounds, &programs::versions(povray, &cases, &runs))?)
}

/// Writes the scene for each program.
fn prepare(count: usize, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let file = |ending: &str| File::create(folder.join(format!("{count}{ending}"))).map(BufWriter::new);
    povray::write(count, &mut file(".pov")?)?;
    tachyon::write(count, SIZE, &mut file(".dat")?)?;
    for format in durer::FORMATS {
        let name = |of: &str| format!("{count}-{of}.{format}");
        file(&format!("-{format}.yaml"))?.write_all(durer::scene(SIZE, &name("balls"), &name("rods")).as_bytes())?;
        durer::balls(count, format, &mut file(&format!("-balls.{format}"))?)?;
        durer::rods(count, format, &mut file(&format!("-rods.{format}"))?)?;
    }
    Ok(())
}

fn cases(durer: &Path, count: usize) -> Vec<Case> {
    let durer = durer.display().to_string();
    let subject = count.to_string();
    let of_durer = |(program, format): (&'static str, &str)| {
        let scene = format!("{count}-{format}.yaml");
        let words = format!("--antialias none --threads 1 --stats json -o {}", picture(count, format));
        Case::new(program, &subject, &[&durer, "render", &scene], &words, programs::durer_tracing)
    };
    let povs = format!("+W{SIZE} +H{SIZE} -A -D -V +WT1 +O{}", picture(count, "povray"));
    let tachyons = format!("-numthreads 1 -aasamples 0 -format PNG -o {}", picture(count, "tachyon"));
    let mut cases: Vec<Case> = [("durer", "csv"), ("durer, npy", "npy")].map(of_durer).into();
    cases.push(Case::new("POV-Ray", &subject, &["povray", &format!("{count}.pov")], &povs, programs::povray_tracing));
    cases.push(Case::new(
        TACHYON,
        &subject,
        &["tachyon", &format!("{count}.dat")],
        &tachyons,
        programs::tachyon_tracing,
    ));
    cases
}

fn picture(count: usize, of: &str) -> String {
    format!("{count}-{of}.png")
}

/// How durer's pictures differ from each other and from the others', as a line of a table.
fn differences(count: usize, folder: &Path) -> Result<String, String> {
    let read = |of: &str, transfer: Transfer| {
        let bitmap = ::durer::read_picture(&folder.join(picture(count, of)), &DecodeLimits::default());
        let bitmap = bitmap.map_err(|error| error.to_string())?;
        Ok::<_, String>(bitmap.to_image(transfer))
    };
    let (csv, npy) = (read("csv", Transfer::Srgb)?, read("npy", Transfer::Srgb)?);
    // Tachyon writes linear numbers.
    let (povray, tachyon) = (read("povray", Transfer::Srgb)?, read("tachyon", Transfer::Linear)?);
    let difference = |other: &Image| compare(&csv, other).map_err(|error| error.to_string());
    let (povray, tachyon, npy) = (difference(&povray)?, difference(&tachyon)?, difference(&npy)?);
    let differing = |difference: &Difference| difference.differing_share * 100.0;
    Ok(format!(
        "| {count} | {:.6} | {:.3} % | {:.6} | {:.6} | {:.3} % |\n",
        povray.mean,
        differing(&povray),
        tachyon.mean,
        npy.mean,
        differing(&npy),
    ))
}

fn markdown(rows: &[Row], differences: &[String], rounds: usize, versions: &str) -> Result<String, String> {
    Ok(format!(
        "# Shapes by the million in durer, POV-Ray and Tachyon\n\n{}\n{versions}.\n\n{}{}\n\
         ## How much durer's pictures differ\n\n{}{}",
        report::place()?,
        about(rounds),
        report::table("shapes", rows),
        ABOUT_DIFFERENCES,
        differences.concat(),
    ))
}

fn about(rounds: usize) -> String {
    format!(
        "As many balls and open cylinders at random in a cube, above a plane; one lamp with shadows, one ray a pixel,\n\
         {SIZE} × {SIZE} pixels, one thread, from file to PNG. durer reads CSV, in the second row of each NumPy's files. Medians of\n\
         {rounds} rounds in which the programs ran in turn, after one more that is not counted. Processor time is user and system\n\
         time of the whole process; tracing is what each program reports for it. Ratios are to durer with CSV: above 1, durer\n\
         is faster. POV-Ray waits on timers, so its wall time says little for small scenes.\n\n"
    )
}

const ABOUT_DIFFERENCES: &str = "\
Mean absolute difference of a component from 0 to 1, as `durer compare` gives it, and how many pixels differ at all;
with Tachyon all do, since it writes linear numbers of 8 bits, which are coarser.

| shapes | POV-Ray | pixels | Tachyon | durer from .npy | pixels |
|---|---:|---:|---:|---:|---:|
";
