//! Files that end too early: every file that fuzzing begins with, cut after each of its bytes.

use durer_trials::TARGETS;
use std::path::Path;

#[test]
fn files_cut_anywhere_do_no_harm() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let mut tried = 0;
    // Scenes at random take any bytes: a cut is just another scene.
    for (name, target) in TARGETS.iter().filter(|(name, _)| *name != "render") {
        for file in std::fs::read_dir(seeds.join(name)).unwrap().map(|file| file.unwrap().path()) {
            let bytes = std::fs::read(&file).unwrap();
            for end in 0..bytes.len() {
                let fine = std::panic::catch_unwind(|| target(&bytes[..end])).is_ok();
                assert!(fine, "{} cut after {end} bytes", file.display());
            }
            tried += bytes.len();
        }
    }
    assert!(tried > 5000, "only {tried} cuts");
}
