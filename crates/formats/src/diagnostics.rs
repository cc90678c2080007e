//! What is wrong with a file, and where: shown to people like rustc's messages, given to programs as JSON.

mod json;
mod show;

use crate::native::tree::Span;
use durer_scene::Problem;
use std::collections::BTreeSet;
use std::ops::Range;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The scene cannot be used.
    Error,
    /// The scene can be used; but look at this.
    Warning,
}

/// One thing that is wrong, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, in one phrase.
    pub message: String,
    /// The name of the file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column of its first character, from 1, counted in characters.
    pub column: usize,
    /// The bytes of the file that it is about.
    pub span: Range<usize>,
    /// What an [`Overlay`](crate::Overlay) calls the setting that it is about, which is not in the file: line, column and span
    /// mean nothing then. The message begins with it.
    pub setting: Option<String>,
    /// What to say right beside the place.
    pub label: Option<String>,
    /// What to do about it.
    pub help: Option<String>,
    /// Other places that matter.
    pub related: Vec<Related>,
}

/// Another place that matters to a [`Diagnostic`], in the same file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Related {
    /// Why it matters.
    pub label: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, counted in characters.
    pub column: usize,
    /// The bytes of the file.
    pub span: Range<usize>,
}

/// All that is wrong with a file, in the order of the file, with what is needed to show it.
///
/// `Display` shows it in plain text; see also [`render`](Diagnostics::render) and [`to_json`](Diagnostics::to_json).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The first of them, at most [`Limits::max_diagnostics`](crate::Limits::max_diagnostics).
    pub list: Vec<Diagnostic>,
    /// How many more there are.
    pub omitted: usize,
    source: String,
}

/// A diagnostic in the making: places are spans yet.
#[derive(Clone, Debug)]
pub(crate) struct Complaint {
    severity: Severity,
    span: Span,
    message: String,
    setting: Option<String>,
    label: Option<String>,
    help: Option<String>,
    related: Vec<(Span, String)>,
}

impl Complaint {
    pub(crate) fn error(span: Span, message: impl Into<String>) -> Complaint {
        let (setting, label, help, related) = (None, None, None, Vec::new());
        Complaint { severity: Severity::Error, span, message: message.into(), setting, label, help, related }
    }

    /// An error in a setting that is not in the file, but in what is laid over it, which calls it so.
    pub(crate) fn of_overlay(name: String, problem: Problem) -> Complaint {
        let complaint = Complaint::error(Span::default(), format!("{name}: {}", problem.message));
        Complaint { setting: Some(name), ..complaint.maybe_help(problem.help) }
    }

    pub(crate) fn into_warning(self) -> Complaint {
        Complaint { severity: Severity::Warning, ..self }
    }

    pub(crate) fn warning(span: Span, message: impl Into<String>) -> Complaint {
        Complaint::error(span, message).into_warning()
    }

    pub(crate) fn label(self, label: impl Into<String>) -> Complaint {
        Complaint { label: Some(label.into()), ..self }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Complaint {
        Complaint { help: Some(help.into()), ..self }
    }

    pub(crate) fn maybe_help(self, help: Option<String>) -> Complaint {
        Complaint { help: help.or(self.help), ..self }
    }

    pub(crate) fn also(mut self, span: Span, label: impl Into<String>) -> Complaint {
        self.related.push((span, label.into()));
        self
    }

    /// Adds help that comes from a look at the line that it is about, if there is no help yet.
    pub(crate) fn help_from_line(self, source: &str, advise: impl Fn(&str) -> Option<String>) -> Complaint {
        if self.setting.is_some() {
            return self;
        }
        let mut start = self.span.start.min(source.len());
        while !source.is_char_boundary(start) {
            start -= 1;
        }
        let before = source[..start].rfind('\n').map_or(0, |at| at + 1);
        let line = source[before..].lines().next().unwrap_or_default();
        let help = self.help.clone().or_else(|| advise(line));
        Complaint { help, ..self }
    }

    /// Where its place begins.
    pub(crate) fn start(&self) -> usize {
        self.span.start
    }

    pub(crate) fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    fn into_diagnostic(self, file: &str, source: &str) -> Diagnostic {
        let (line, column) = line_and_column(source, self.span.start);
        let related = self.related.into_iter().map(|(span, label)| {
            let (line, column) = line_and_column(source, span.start);
            Related { label, line, column, span: span.start..span.end }
        });
        Diagnostic {
            severity: self.severity,
            message: self.message,
            file: file.to_owned(),
            line,
            column,
            span: self.span.start..self.span.end,
            setting: self.setting,
            label: self.label,
            help: self.help,
            related: related.collect(),
        }
    }
}

impl Diagnostics {
    /// Sorts by place and keeps the first `most`.
    pub(crate) fn new(mut complaints: Vec<Complaint>, file: &str, source: &str, most: usize) -> Diagnostics {
        complaints.sort_by_key(|complaint| complaint.span.start);
        // What an alias stands for is read, and may be wrong, at each use.
        let mut seen = BTreeSet::new();
        complaints.retain(|one| seen.insert((one.span.start, one.span.end, one.message.clone())));
        let omitted = complaints.len().saturating_sub(most);
        complaints.truncate(most);
        let list = complaints.into_iter().map(|complaint| complaint.into_diagnostic(file, source)).collect();
        Diagnostics { list, omitted, source: source.to_owned() }
    }

    /// True if there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

impl std::error::Error for Diagnostics {}

/// Line and column, from 1, of a byte of `text`.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..byte.min(text.len())];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.bytes().filter(|&b| b == b'\n').count() + 1;
    let bom = usize::from(line == 1 && text.starts_with('\u{feff}'));
    (line, (before[line_start..].chars().count() + 1).saturating_sub(bom).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_in_characters() {
        assert_eq!(line_and_column("a\näöx", "a\näö".len()), (2, 3));
        assert_eq!(line_and_column("", 0), (1, 1));
        assert_eq!(line_and_column("\u{feff}ab", 4), (1, 2));
    }

    #[test]
    fn long_lines_are_cut_around_the_place() {
        let source = format!("{}BAD{}", "ä ".repeat(50_000), " ö".repeat(50_000));
        let start = source.find("BAD").unwrap();
        let complaint = Complaint::error(Span::new(start, start + 3), "wrong").label("this");
        let shown = Diagnostics::new(vec![complaint], "long.yaml", &source, 5).to_string();
        assert!(shown.len() < 1000 && shown.contains("BAD") && shown.contains("^^^ this"), "{shown}");
    }

    #[test]
    fn a_byte_order_mark_takes_no_column() {
        let complaint = Complaint::error(Span::new(3, 5), "wrong");
        let shown = Diagnostics::new(vec![complaint], "x", "\u{feff}ab", 1).to_string();
        assert!(shown.contains("x:1:1") && !shown.contains('\u{feff}'), "{shown}");
    }

    #[test]
    fn what_is_left_out_is_counted() {
        let complaints = (0..5).map(|i| Complaint::error(Span::new(5 - i, 6 - i), format!("no {i}"))).collect();
        let all = Diagnostics::new(complaints, "x", "abcdef", 2);
        assert_eq!((all.list.len(), all.omitted, all.list[0].message.as_str()), (2, 3, "no 4"));
        assert!(all.to_string().contains("and 3 more"));
    }
}
