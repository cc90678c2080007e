//! `cargo xtask bench peers`: the seed's room in durer, POV-Ray and Tachyon, one thread, no anti-aliasing.
//!
//! The programs run in turn, round after round, so that whatever else the machine does meets all alike. The first
//! round is not counted.

use super::measure::{self, Run};
use super::report::{self, Row};
use super::tachyon;
use crate::shell;
use durer::imaging::{DecodeLimits, Texels};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Rounds that count, if nothing else is asked for.
pub(crate) const ROUNDS: usize = 7;

const SCENE: &str = "scenes/room.yaml";
const TEXTURES: &str = "scenes/textures";
const TEXTURE: &str = "scenes/textures/seed.png";
const POVRAY_SCENE: &str = "benches/peers/room.pov";
const SIZES: [(u32, u32); 2] = [(500, 500), (1920, 1080)];

/// One program on one size of picture.
pub(crate) struct Case {
    pub(crate) program: &'static str,
    pub(crate) size: (u32, u32),
    argv: Vec<String>,
    /// Finds the seconds of tracing alone in what the program printed.
    tracing: fn(&str) -> Option<f64>,
}

/// Measures and writes the report.
pub(crate) fn run(rounds: usize) -> Result<(), String> {
    let mut versions = versions()?;
    let durer = shell::build_durer()?;
    let folder = prepare()?;
    let cases: Vec<Case> = SIZES.iter().flat_map(|&size| cases(&durer, size)).collect();
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); cases.len()];
    for round in 0..=rounds {
        println!("round {round} of {rounds}{}", if round == 0 { ", to warm up" } else { "" });
        for (case, runs) in cases.iter().zip(&mut runs) {
            let run = measure::run(&case.argv, &folder)?;
            if case.program == "Tachyon" {
                versions[2] = line_with(&run.printed, "Version");
            }
            if round > 0 {
                runs.push(run);
            }
        }
    }
    let rows: Vec<Row> = cases.iter().zip(&runs).map(|(case, runs)| Row::of(case, runs)).collect();
    // What is left are a few pictures in the system's folder for such things.
    let _ = std::fs::remove_dir_all(&folder);
    report::write(&rows, rounds, &versions)
}

impl Case {
    /// Seconds of tracing alone, as the program says.
    pub(crate) fn tracing(&self, printed: &str) -> Option<f64> {
        (self.tracing)(printed)
    }
}

/// The programs' own names for their versions; an error tells what to install.
fn versions() -> Result<[String; 3], String> {
    // Tachyon tells its version only when it has something to render.
    let [povray, tachyon] = ["povray", "tachyon"].map(|program| {
        let output = Command::new(program).arg("--version").output();
        let output = output
            .map_err(|_| format!("`{program}` cannot be run. On Debian and Ubuntu: apt-get install povray tachyon"))?;
        let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).join("\n");
        Ok::<_, String>(line_with(&text, "POV-Ray 3"))
    });
    tachyon?;
    Ok([format!("durer {}", env!("CARGO_PKG_VERSION")), povray?, "Tachyon".to_owned()])
}

/// The first line of a text that contains this, with single blanks.
fn line_with(text: &str, part: &str) -> String {
    let line = text.lines().find(|line| line.contains(part)).unwrap_or_default();
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A folder for what the programs write, with Tachyon's input.
fn prepare() -> Result<PathBuf, String> {
    let folder = std::env::temp_dir().join(format!("durer-bench-peers-{}", std::process::id()));
    let texture = shell::root().join(TEXTURE);
    let bitmap = durer::read_picture(&texture, &DecodeLimits::default()).map_err(|error| error.to_string())?;
    let Texels::U8(texels) = &bitmap.texels else {
        return Err(format!("{TEXTURE} has not 8 bits a component"));
    };
    let mut ppm = format!("P6\n{} {}\n255\n", bitmap.width, bitmap.height).into_bytes();
    ppm.extend(texels.iter().flatten());
    shell::write(&folder.join("texture.ppm"), ppm)?;
    for size in SIZES {
        shell::write(&folder.join(format!("room-{}.dat", size.0)), tachyon::model(size, "texture.ppm"))?;
    }
    Ok(folder)
}

fn cases(durer: &Path, size: (u32, u32)) -> [Case; 3] {
    let root = shell::root();
    let shown = |path: &Path| path.display().to_string();
    let (width, height) = size;
    let (scene, room) = (shown(&root.join(SCENE)), shown(&root.join(POVRAY_SCENE)));
    let textures = format!("+L{}", shown(&root.join(TEXTURES)));
    let model = format!("room-{width}.dat");
    let ours = format!("--antialias none --threads 1 --width {width} --height {height} --stats json -o durer.png",);
    let povs = format!("+W{width} +H{height} -A -D -V +WT1 +Opovray.png");
    let tachyons = "-numthreads 1 -trans_vmd -normalfixup flip -aasamples 0 -format PNG -o tachyon.png";
    let case = |program, paths: &[&str], words: &str, tracing| {
        let argv = paths.iter().copied().chain(words.split(' ')).map(str::to_owned).collect();
        Case { program, size, argv, tracing }
    };
    [
        case("durer", &[&shown(durer), "render", &scene], &ours, durer_tracing),
        case("POV-Ray", &["povray", &room, &textures], &povs, povray_tracing),
        case("Tachyon", &["tachyon", &model], tachyons, tachyon_tracing),
    ]
}

fn durer_tracing(printed: &str) -> Option<f64> {
    let stats: serde_json::Value = serde_json::from_str(printed).ok()?;
    stats["seconds"]["render"].as_f64()
}

/// `Trace Time:       0 hours  0 minutes  0 seconds (0.362 seconds)`
fn povray_tracing(printed: &str) -> Option<f64> {
    let after = printed.split_once("Trace Time:")?.1;
    after.split_once('(')?.1.split_once(" seconds)")?.0.trim().parse().ok()
}

/// `  Ray Tracing Time:     0.1801 seconds`
fn tachyon_tracing(printed: &str) -> Option<f64> {
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
}
