//! `cargo xtask bench peers`: the seed's room in durer, POV-Ray and Tachyon, one thread, no anti-aliasing.

use super::options::Options;
use super::programs::{self, Case, TACHYON};
use super::report::{self, Row};
use super::tachyon;
use crate::shell;
use durer::imaging::{DecodeLimits, Texels};
use std::path::{Path, PathBuf};

/// Rounds that count, if nothing else is asked for.
const ROUNDS: usize = 7;

const SCENE: &str = "scenes/room.yaml";
const TEXTURES: &str = "scenes/textures";
const TEXTURE: &str = "scenes/textures/seed.png";
const POVRAY_SCENE: &str = "benches/peers/room.pov";
const SIZES: [(u32, u32); 2] = [(500, 500), (1920, 1080)];

/// Measures and writes the report.
pub(crate) fn run(options: &Options<'_>) -> Result<(), String> {
    let rounds = programs::number_of_rounds(options, ROUNDS)?;
    let povray = programs::povray_version()?;
    let durer = shell::build_durer()?;
    let folder = prepare()?;
    let cases: Vec<Case> = SIZES.iter().flat_map(|&size| cases(&durer, size)).collect();
    let runs = programs::rounds(&cases, rounds, &folder)?;
    let rows: Vec<Row> = cases.iter().zip(&runs).map(|(case, runs)| Row::of(case, runs)).collect();
    // What is left are a few pictures in the system's folder for such things.
    let _ = std::fs::remove_dir_all(&folder);
    report::keep("peers", &markdown(&rows, rounds, &programs::versions(povray, &cases, &runs))?)
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
    let picture = format!("{width} × {height}");
    let (scene, room) = (shown(&root.join(SCENE)), shown(&root.join(POVRAY_SCENE)));
    let textures = format!("+L{}", shown(&root.join(TEXTURES)));
    let model = format!("room-{width}.dat");
    let ours = format!("--antialias none --threads 1 --width {width} --height {height} --stats json -o durer.png",);
    let povs = format!("+W{width} +H{height} -A -D -V +WT1 +Opovray.png");
    let tachyons = "-numthreads 1 -trans_vmd -normalfixup flip -aasamples 0 -format PNG -o tachyon.png";
    [
        Case::new("durer", &picture, &[&shown(durer), "render", &scene], &ours, programs::durer_tracing),
        Case::new("POV-Ray", &picture, &["povray", &room, &textures], &povs, programs::povray_tracing),
        Case::new(TACHYON, &picture, &["tachyon", &model], tachyons, programs::tachyon_tracing),
    ]
}

fn markdown(rows: &[Row], rounds: usize, versions: &str) -> Result<String, String> {
    Ok(format!(
        "# The seed's room in durer, POV-Ray and Tachyon\n\n\
         {}\n\
         {versions}.\n\n\
         One thread, no anti-aliasing, one ray a pixel, depth 5, to a PNG. Medians of {rounds} rounds in which the programs \
         ran in turn,\nafter one more that is not counted. Processor time is user and system time of the whole process; tracing \
         is what each\nprogram reports for it. Ratios are to durer: above 1, durer is faster. POV-Ray waits on timers, so its wall \
         time says\nlittle. Tachyon has no refraction here, and triangles for the cones and the ellipsoid.\n\n{}",
        report::place()?,
        report::table("picture", rows),
    ))
}
