//! `cargo xtask bench growth`: what building and tracing cost as the scene grows, from a thousand things to ten million.
//! Goes into docs/performance.md, as a table and a plot.

mod page;
mod plot;

use super::kernel::build;
use super::options::Options;
use super::report::{median, place};
use crate::shell;
use plot::{Curve, Panel};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Rounds, if nothing else is asked for.
const ROUNDS: usize = 3;

const COUNTS: [usize; 5] = [1_000, 10_000, 100_000, 1_000_000, 10_000_000];

/// How often a program builds and sends each kind of rays in one round.
const REPEATS: &str = "3";

const KINDS: [&str; 3] = ["triangles", "spheres", "instances"];

/// So many things of a kind.
#[derive(Clone, Debug, PartialEq)]
struct Point {
    kind: &'static str,
    count: f64,
    build_seconds: f64,
    bytes: f64,
    /// Millions of rays a second.
    primary: f64,
    packets: f64,
    bounce: f64,
}

/// Measures and writes table and plot.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let rounds = options.count("--rounds", ROUNDS)?;
    let counts = options.counts("--counts", &COUNTS)?;
    let program = build::durer()?;
    let cases: Vec<(&'static str, usize)> =
        counts.iter().flat_map(|&count| KINDS.into_iter().map(move |kind| (kind, count))).collect();
    let mut measured: Vec<Vec<Point>> = vec![Vec::new(); cases.len()];
    for round in 1..=rounds {
        for (&(kind, count), points) in cases.iter().zip(&mut measured) {
            println!("round {round} of {rounds}: {count} {kind}");
            points.push(measure(&program, kind, count)?);
        }
    }
    let points: Vec<Point> = measured.iter().filter_map(|points| medians(points)).collect();
    page::put(&section(&points, rounds, &place()?))?;
    shell::write(&shell::root().join(page::PLOT), plot::draw(&panels(&points)))?;
    println!("written to {} and {}", page::PAGE, page::PLOT);
    Ok(())
}

fn measure(program: &Path, kind: &'static str, count: usize) -> Result<Point, String> {
    let printed = shell::output(Command::new(program).args(["grow", kind, &count.to_string(), REPEATS]))?;
    point(kind, &printed).ok_or_else(|| format!("`{printed}` is not understood"))
}

/// What the program printed.
fn point(kind: &'static str, printed: &str) -> Option<Point> {
    let line: Value = serde_json::from_str(printed).ok()?;
    let number = |name: &str| line[name].as_f64();
    Some(Point {
        kind,
        count: number("count")?,
        build_seconds: number("build_seconds")?,
        bytes: number("bytes")?,
        primary: number("primary")?,
        packets: number("packets")?,
        bounce: number("bounce")?,
    })
}

/// The median of each measure.
fn medians(points: &[Point]) -> Option<Point> {
    let of = |value: fn(&Point) -> f64| median(points.iter().map(value).collect());
    Some(Point {
        build_seconds: of(|point| point.build_seconds)?,
        primary: of(|point| point.primary)?,
        packets: of(|point| point.packets)?,
        bounce: of(|point| point.bounce)?,
        ..points.first()?.clone()
    })
}

/// What the page says of it.
fn section(points: &[Point], rounds: usize, place: &str) -> String {
    let mut text = format!(
        "{place} One thread, processor time, medians of {rounds} rounds.\n\n\
         ![Time to build and time of a ray, against the number of things]({})\n\n\
         | things | of a kind | build, s | build, ns each | bytes each | primary, M/s | in packets, M/s | bounce, M/s |\n\
         |---:|---|---:|---:|---:|---:|---:|---:|\n",
        page::PLOT_BESIDE,
    );
    for point in points {
        text += &format!(
            "| {} | {} | {:.4} | {:.0} | {:.1} | {:.2} | {:.2} | {:.2} |\n",
            grouped(point.count as u64),
            point.kind,
            point.build_seconds,
            point.build_seconds / point.count * 1e9,
            point.bytes / point.count,
            point.primary,
            point.packets,
            point.bounce,
        );
    }
    text
}

/// A number with a blank between groups of three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let blank_before = |at: usize| at > 0 && (digits.len() - at).is_multiple_of(3);
    digits.char_indices().map(|(at, digit)| format!("{}{digit}", if blank_before(at) { " " } else { "" })).collect()
}

fn panels(points: &[Point]) -> [Panel; 2] {
    let curves = |value: fn(&Point) -> f64| {
        let of = |kind: &'static str| Curve {
            name: kind,
            points: points.iter().filter(|point| point.kind == kind).map(|point| (point.count, value(point))).collect(),
        };
        KINDS.map(of)
    };
    [
        Panel { title: "building, seconds", curves: curves(|point| point.build_seconds) },
        Panel { title: "a bounced ray, microseconds", curves: curves(|point| 1.0 / point.bounce) },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str = r#"{"kind": "spheres", "count": 1000, "build_seconds": 0.5, "bytes": 64000, "primary": 4.0, "packets": 8.0, "bounce": 2.0, "bounced": 9}"#;

    #[test]
    fn lines_become_rows() {
        let point = point("spheres", LINE).unwrap();
        let slower = Point { build_seconds: 0.7, ..point.clone() };
        let point = medians(&[point.clone(), slower, point]).unwrap();
        let text = section(&[point], 3, "Here.");
        assert!(text.contains("| 1 000 | spheres | 0.5000 | 500000 | 64.0 | 4.00 | 8.00 | 2.00 |"), "{text}");
    }

    #[test]
    fn long_numbers_are_grouped() {
        assert_eq!([7, 1000, 1_234_567].map(grouped), ["7", "1 000", "1 234 567"]);
    }
}
