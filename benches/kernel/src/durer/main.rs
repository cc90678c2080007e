//! Measures durer's kernel, with one thread: a scene that other programs measure too, or how it grows.

mod growth;
mod kernel;

use durer_bench_kernel::scene::Scene;
use std::process::ExitCode;

const USAGE: &str = "\
usage: kernel-durer SCENE REPEATS PURPOSE    SCENE: terrain, cave, soup, spheres; PURPOSE: preview, picture, many-rays
       kernel-durer grow KIND COUNT REPEATS  KIND: triangles, spheres, instances";

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
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    one_thread.build_global().map_err(|error| error.to_string())?;
    let number = |word: &str| word.parse::<usize>().map_err(|_| format!("`{word}` is not a number"));
    match words {
        ["grow", kind, count, repeats] => growth::measure(kind, number(count)?, number(repeats)?),
        [scene, repeats, purpose] => kernel::measure(&Scene::named(scene)?, number(repeats)?, purpose),
        _ => Err(USAGE.to_owned()),
    }
}
