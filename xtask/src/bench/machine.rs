//! Where and when something was measured.

use crate::shell;
use std::process::Command;

/// The processor, by the name that it gives itself.
pub(crate) fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    match model {
        Some((_, name)) => name.trim().to_owned(),
        None => shell::output(Command::new("sysctl").args(["-n", "machdep.cpu.brand_string"]))
            .map_or_else(|_| std::env::consts::ARCH.to_owned(), |name| name.trim().to_owned()),
    }
}

/// Threads that can run at a time.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Today: 2026-11-22.
pub(crate) fn date() -> Result<String, String> {
    shell::output(Command::new("date").arg("+%Y-%m-%d")).map(|date| date.trim().to_owned())
}

/// The commit that is checked out, and whether files differ from it.
pub(crate) fn commit() -> String {
    let git = |words: &[&str]| shell::output(Command::new("git").args(words).current_dir(shell::root()));
    let changed = git(&["status", "--porcelain"]).is_ok_and(|list| !list.trim().is_empty());
    let hash = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_else(|_| "unknown".to_owned());
    format!("{}{}", hash.trim(), if changed { ", with changes" } else { "" })
}

/// A text as part of a file name.
pub(crate) fn slug(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slugs_are_fit_for_file_names() {
        assert_eq!(slug("AMD EPYC 7B13 (64-Core)"), "amd-epyc-7b13-64-core");
        assert!(!processor().is_empty() && cores() > 0);
    }
}
