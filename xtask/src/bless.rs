//! `cargo xtask bless`: documents that are made from the program, so that they cannot say anything else than it does.

use crate::shell;
use std::path::Path;
use std::process::Command;

/// A document: its path from the root, and what it must be.
type Document = (&'static str, String);

/// Writes the documents that are not as they should be.
pub(crate) fn run() -> Result<(), String> {
    for (path, text) in documents()? {
        if is_fresh(path, &text) {
            println!("{path}: as it was");
        } else {
            shell::write(&shell::root().join(path), &text)?;
            println!("{path}: renewed");
        }
    }
    Ok(())
}

/// Fails if a document is not as it should be.
pub(crate) fn check() -> Result<(), String> {
    let stale: Vec<&str> =
        documents()?.iter().filter(|(path, text)| !is_fresh(path, text)).map(|(path, _)| *path).collect();
    match stale.as_slice() {
        [] => Ok(()),
        stale => Err(format!("stale: {}; run `cargo xtask bless`", stale.join(", "))),
    }
}

fn is_fresh(path: &str, text: &str) -> bool {
    std::fs::read_to_string(shell::root().join(path)).is_ok_and(|committed| committed == text)
}

fn documents() -> Result<Vec<Document>, String> {
    Ok(vec![
        ("docs/scene.schema.json", format!("{:#}\n", durer::json_schema())),
        ("docs/reference.md", durer::reference_markdown()),
        ("docs/cli.md", command_line()?),
    ])
}

/// The help pages of the program and its subcommands.
fn command_line() -> Result<String, String> {
    let durer = shell::build_durer()?;
    let help = help_of(&durer, &[])?;
    let mut text = String::from(
        "<!-- Made by `cargo xtask bless` from apps/cli: edit the help there. -->\n\n# The command line\n",
    );
    text += &section("durer", &help);
    for name in subcommands(&help) {
        text += &section(&format!("durer {name}"), &help_of(&durer, &[name])?);
    }
    Ok(text)
}

fn help_of(durer: &Path, words: &[&str]) -> Result<String, String> {
    // Without COLUMNS the width of lines would be that of the terminal.
    shell::output(Command::new(durer).args(words).arg("--help").env("COLUMNS", "100").env("NO_COLOR", "1"))
}

fn section(title: &str, help: &str) -> String {
    format!("\n## {title}\n\n```text\n{}\n```\n", help.trim_end())
}

/// The names under `Commands:`, but for clap's own `help`.
fn subcommands(help: &str) -> impl Iterator<Item = &str> {
    let list = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let entries = list.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    entries.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subcommands_are_found_in_the_help() {
        let help = "What it is\n\nCommands:\n  render  Renders\n            more of it\n  check   Checks\n  help    Helps\n\nOptions:\n  -h\n";
        assert_eq!(subcommands(help).collect::<Vec<_>>(), ["render", "check"]);
    }
}
