//! Measures other crates on the scenes that durer is measured on, with one thread.

mod shapes;
mod with_bvh;
mod with_obvhs;

use durer_bench_kernel::scene::Scene;
use std::process::ExitCode;

const USAGE: &str = "\
usage: kernel-crates CRATE SCENE REPEATS   CRATE: bvh, obvhs-fast, obvhs-medium, obvhs-very-slow
                                           SCENE: terrain, cave, soup, spheres
With 0 repeats the tree is built and no ray is sent.";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(words: &[&str]) -> Result<(), String> {
    let [name, scene, repeats] = words else { return Err(USAGE.to_owned()) };
    let scene = Scene::named(scene)?;
    let repeats = repeats.parse().map_err(|_| format!("`{repeats}` is not a number"))?;
    match name.split_once('-').unwrap_or((name, "")) {
        ("bvh", "") => with_bvh::measure(&scene, repeats),
        ("obvhs", preset) => with_obvhs::measure(&scene, preset, repeats)?,
        _ => return Err(USAGE.to_owned()),
    }
    Ok(())
}
