//! `cargo xtask bench`: timings that are worth keeping, with all that is needed to judge them.

mod antialias;
mod growth;
mod kernel;
mod large;
mod machine;
mod measure;
mod options;
mod path;
mod peers;
mod programs;
mod report;
mod tachyon;

use options::Options;

/// What there is, for the usage.
pub(crate) const USAGE: &str = "\
  bench peers [--rounds N]  the seed's room in durer, POV-Ray and Tachyon
  bench large [--rounds N] [--counts N,N]
                            up to a million shapes in durer, POV-Ray and Tachyon, from file to picture
  bench antialias [--scenes NAME,NAME]
                            rays a pixel and errors of every way of anti-aliasing
  bench kernel [--rounds N] [--scenes NAME,NAME]
                            rays a second of durer, Embree 4 and the crates obvhs and bvh
  bench path [--rounds N] [--samples N] [--size N] [--scenes NAME,NAME]
                            path tracing to equal error in durer, Mitsuba 3 and Cycles
  bench growth [--rounds N] [--counts N,N]
                            how durer's kernel grows with the scene, to docs/performance.md
                            (the others write to benches/runs/)";

/// Runs the benchmark that `words` name; `None` if there is none such.
pub(crate) fn run(words: &[&str]) -> Option<Result<(), String>> {
    let (name, words) = words.split_first()?;
    let options = |known: &[&str]| Options::parse(words, known);
    match *name {
        "peers" => Some(options(&["--rounds"]).and_then(|options| peers::run(&options))),
        "large" => Some(options(&["--rounds", "--counts"]).and_then(|options| large::run(&options))),
        "kernel" => Some(options(&["--rounds", "--scenes"]).and_then(|options| kernel::run(&options))),
        "antialias" => Some(options(&["--scenes"]).and_then(|options| antialias::run(&options))),
        "path" => {
            let known = ["--rounds", "--samples", "--size", "--scenes"];
            Some(options(&known).and_then(|options| path::run(&options)))
        }
        "growth" => Some(options(&["--rounds", "--counts"]).and_then(|options| growth::run(&options))),
        _ => None,
    }
}
