//! The programs that are measured as a whole: what they are called, run one after the other, and what they tell.

use super::measure::{self, Run};
use super::options::Options;
use std::path::Path;
use std::process::Command;

/// One program on one picture.
pub(crate) struct Case {
    /// The program, as tables call it.
    pub(crate) program: &'static str,
    /// The picture, as tables call it.
    pub(crate) subject: String,
    /// What is run.
    pub(crate) argv: Vec<String>,
    /// Finds the seconds of tracing alone in what the program printed.
    pub(crate) tracing: fn(&str) -> Option<f64>,
}

impl Case {
    /// Runs `paths` and then `words`, which are separated by blanks.
    pub(crate) fn new(
        program: &'static str,
        subject: &str,
        paths: &[&str],
        words: &str,
        tracing: fn(&str) -> Option<f64>,
    ) -> Case {
        let argv = paths.iter().copied().chain(words.split(' ')).map(str::to_owned).collect();
        Case { program, subject: subject.to_owned(), argv, tracing }
    }
}

/// Runs the cases in turn, round after round, so that whatever else the machine does meets all alike. The first round
/// is not counted.
pub(crate) fn rounds(cases: &[Case], rounds: usize, folder: &Path) -> Result<Vec<Vec<Run>>, String> {
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); cases.len()];
    for round in 0..=rounds {
        println!("round {round} of {rounds}{}", if round == 0 { ", to warm up" } else { "" });
        for (case, runs) in cases.iter().zip(&mut runs) {
            let run = measure::run(&case.argv, folder)?;
            if round > 0 {
                runs.push(run);
            }
        }
    }
    Ok(runs)
}

/// How many rounds count.
pub(crate) fn number_of_rounds(options: &Options<'_>, default: usize) -> Result<usize, String> {
    options.count("--rounds", default)
}

/// An error that tells what to install, if POV-Ray or Tachyon cannot be run; else how POV-Ray calls its version.
pub(crate) fn povray_version() -> Result<String, String> {
    // Tachyon tells its version only when it has something to render.
    let [povray, tachyon] = ["povray", "tachyon"].map(|program| {
        let output = Command::new(program).arg("--version").output();
        let output = output
            .map_err(|_| format!("`{program}` cannot be run. On Debian and Ubuntu: apt-get install povray tachyon"))?;
        let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).join("\n");
        Ok::<_, String>(line_with(&text, "POV-Ray 3"))
    });
    tachyon?;
    povray
}

/// The versions of durer, POV-Ray and Tachyon, the last from what its runs printed.
pub(crate) fn versions(povray: String, cases: &[Case], runs: &[Vec<Run>]) -> String {
    let of_tachyon = cases.iter().zip(runs).find(|(case, _)| case.program == TACHYON);
    let run = of_tachyon.and_then(|(_, runs)| runs.first());
    let tachyon = run.map_or_else(|| TACHYON.to_owned(), |run| line_with(&run.printed, "Version"));
    [format!("durer {}", env!("CARGO_PKG_VERSION")), povray, tachyon].join("; ")
}

/// What tables call Tachyon.
pub(crate) const TACHYON: &str = "Tachyon";

/// The first line of a text that contains this, with single blanks.
fn line_with(text: &str, part: &str) -> String {
    let line = text.lines().find(|line| line.contains(part)).unwrap_or_default();
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// From the statistics as JSON.
pub(crate) fn durer_tracing(printed: &str) -> Option<f64> {
    let stats: serde_json::Value = serde_json::from_str(printed).ok()?;
    stats["seconds"]["render"].as_f64()
}

/// `Trace Time:       0 hours  0 minutes  0 seconds (0.362 seconds)`
pub(crate) fn povray_tracing(printed: &str) -> Option<f64> {
    let after = printed.split_once("Trace Time:")?.1;
    after.split_once('(')?.1.split_once(" seconds)")?.0.trim().parse().ok()
}

/// `  Ray Tracing Time:     0.1801 seconds`
pub(crate) fn tachyon_tracing(printed: &str) -> Option<f64> {
    printed.split_once("Ray Tracing Time:")?.1.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracing_times_are_found() {
        assert_eq!(durer_tracing(r#"{"seconds": {"render": 0.25}}"#), Some(0.25));
        let pov = "  Parse Time:       0 hours  0 minutes  0 seconds (0.020 seconds)\n\
                   Trace Time:       0 hours  0 minutes  2 seconds (2.570 seconds)\n  using 1 thread(s)";
        assert_eq!(povray_tracing(pov), Some(2.57));
        assert_eq!(tachyon_tracing("  Ray Tracing Time:     0.1801 seconds\n"), Some(0.1801));
        assert_eq!(tachyon_tracing("nothing"), None);
    }

    #[test]
    fn versions_are_single_lines() {
        assert_eq!(line_with("a\n  POV-Ray   3.7 \nb", "POV-Ray 3"), "");
        assert_eq!(line_with("a\n  POV-Ray 3.7   x\nb", "POV-Ray 3"), "POV-Ray 3.7 x");
    }
}
