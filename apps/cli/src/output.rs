//! Standard output and error. Whoever reads them may hang up at any time: that is no error and never a panic.

use crate::exit::Failure;
use std::io::{self, ErrorKind, IsTerminal, Write};

/// Prints to standard output, the text as it is.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::file(format!("cannot write to standard output: {error}")))
        }
        Ok(()) | Err(_) => Ok(()),
    }
}

/// Prints JSON to standard output, indented.
pub(crate) fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    print(&format!("{value:#}\n"))
}

/// Prints a line to standard error.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Says what went wrong.
pub(crate) fn error(message: &str) {
    note(&format!("{}: {message}", colored("error", "\x1b[1;31m")));
}

/// Says what looks wrong.
pub(crate) fn warning(message: &str) {
    note(&format!("{}: {message}", colored("warning", "\x1b[1;33m")));
}

fn colored(word: &str, start: &str) -> String {
    if stderr_has_color() { format!("{start}{word}\x1b[0m") } else { word.to_owned() }
}

/// True if standard error shows colours, by the conventions of `NO_COLOR`, `CLICOLOR_FORCE` and `CLICOLOR`.
pub(crate) fn stderr_has_color() -> bool {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    if variable("NO_COLOR").is_some() {
        return false;
    }
    if variable("CLICOLOR_FORCE").is_some_and(|value| value != "0") {
        return true;
    }
    let wanted = variable("CLICOLOR").is_none_or(|value| value != "0") && variable("TERM").is_none_or(|t| t != "dumb");
    wanted && io::stderr().is_terminal()
}
