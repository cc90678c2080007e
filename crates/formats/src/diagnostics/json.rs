//! Diagnostics for programs.

use super::{Diagnostic, Diagnostics, Severity};
use serde_json::{Value, json};

impl Diagnostics {
    /// An object with `diagnostics`, a list, and `omitted`, how many more there are. Each has `severity` (`error` or
    /// `warning`), `message`, `file`, `line`, `column` (both from 1, in characters), `start` and `end` (bytes),
    /// `setting`, `label`, `help` (text or null) and `related`.
    pub fn to_json(&self) -> Value {
        json!({ "diagnostics": self.list.iter().map(one).collect::<Vec<_>>(), "omitted": self.omitted })
    }
}

fn one(diagnostic: &Diagnostic) -> Value {
    let related = diagnostic.related.iter().map(|place| {
        json!({
            "label": place.label, "line": place.line, "column": place.column,
            "start": place.span.start, "end": place.span.end,
        })
    });
    json!({
        "severity": diagnostic.severity.word(),
        "message": diagnostic.message,
        "file": diagnostic.file,
        "line": diagnostic.line,
        "column": diagnostic.column,
        "start": diagnostic.span.start,
        "end": diagnostic.span.end,
        "setting": diagnostic.setting,
        "label": diagnostic.label,
        "help": diagnostic.help,
        "related": related.collect::<Vec<_>>(),
    })
}

impl Severity {
    /// `error` or `warning`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}
