//! What the program says of itself: help, versions, schemas, completions, manual pages.

use crate::workshop::Workshop;
use std::io::Read;
use std::process::Stdio;

const COMMANDS: [&str; 12] = [
    "render",
    "resume",
    "merge",
    "check",
    "info",
    "explain",
    "heatmap",
    "compare",
    "develop",
    "schema",
    "completions",
    "man",
];

#[test]
fn help_has_examples_and_exit_codes() {
    let workshop = Workshop::new();
    let help = workshop.fine("--help").stdout;
    assert!(help.contains("Exit codes:") && help.contains("130  interrupted"), "{help}");
    for command in COMMANDS {
        let help = workshop.fine(&format!("{command} --help")).stdout;
        assert!(help.contains("Example") && help.contains("\n  durer "), "{command}: {help}");
        assert!(help.lines().all(|line| line.chars().count() <= 100), "{command}: {help}");
        let examples = help.split_once("Example").unwrap().1;
        assert!(examples.lines().all(|line| line.chars().count() <= 90), "{command}: {help}");
    }
    assert_eq!(workshop.fine("--version").stdout, "durer 0.1.0\n");
    workshop.fails("", 2, "Usage");
    workshop.fails("paint room.yaml", 2, "paint");
}

#[test]
fn the_schema_is_json() {
    let schema = Workshop::new().fine("schema").json();
    assert!(schema["properties"]["objects"].is_object(), "{schema}");
}

#[test]
fn shells_complete_every_command() {
    let workshop = Workshop::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = workshop.fine(&format!("completions {shell}")).stdout;
        assert!(COMMANDS.iter().all(|command| script.contains(command)), "{shell}");
    }
    workshop.fails("completions tcsh", 2, "tcsh");
}

#[test]
fn every_command_has_a_manual_page() {
    let workshop = Workshop::new();
    assert!(workshop.fine("man").stdout.contains(".TH durer 1"));
    for command in COMMANDS {
        let page = workshop.fine(&format!("man {command}")).stdout;
        assert!(page.contains(&format!(".TH durer-{command} 1")), "{page}");
    }
    workshop.fails("man paint", 2, "paint");
}

#[test]
fn a_reader_who_hangs_up_is_no_error() {
    let workshop = Workshop::new();
    for words in ["schema", "explain room.yaml --pixel 12,8 --antialias grid:8", "completions bash", "--help"] {
        let mut child = workshop.command(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut first = [0];
        let mut stdout = child.stdout.take().unwrap();
        stdout.read_exact(&mut first).unwrap();
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{words}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{words}");
    }
}
