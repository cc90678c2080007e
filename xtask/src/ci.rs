//! `cargo xtask ci`: all that must hold before a commit, the quick things first.

use crate::{bless, shell};

const STEPS: [&[&str]; 3] = [
    &["fmt", "--all", "--check"],
    &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
    &["test", "--workspace"],
];

/// Runs all steps; the first that fails ends it.
pub(crate) fn run() -> Result<(), String> {
    for words in STEPS {
        println!("── cargo {}", words.join(" "));
        shell::run(&mut shell::cargo(words))?;
    }
    println!("── cargo xtask bless --check");
    bless::check()
}
