//! Diagnostics for people, in the manner of rustc.

use super::{Diagnostic, Diagnostics, Related, Severity};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// Lines longer than this, in bytes, are cut around the place.
const LONG_LINE: usize = 160;
/// How much is kept on each side of the place in a cut line.
const KEPT: usize = 60;

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl Diagnostics {
    /// All of them as text, each with the lines of the file that it is about; in colour with ANSI escapes.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let mut text: String = self.list.iter().map(|one| render_one(one, &self.source, &renderer) + "\n\n").collect();
        if self.omitted > 0 {
            text += &format!("and {} more\n\n", self.omitted);
        }
        text.truncate(text.trim_end().len());
        text
    }
}

fn render_one(diagnostic: &Diagnostic, source: &str, renderer: &Renderer) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    if diagnostic.setting.is_some() {
        let help = diagnostic.help.as_ref().map(|help| Level::HELP.message(help));
        let report: [Group<'_>; 1] = [Group::with_title(level.primary_title(&diagnostic.message)).elements(help)];
        return renderer.render(&report);
    }
    let primary = (diagnostic.span.clone(), diagnostic.label.as_deref());
    let mut lines = snippet(diagnostic, source, primary, AnnotationKind::Primary);
    let related = diagnostic.related.iter();
    // What is in the same line is marked there.
    let line = short_line_of(source, &diagnostic.span);
    let is_beside = |place: &&Related| line.is_some() && short_line_of(source, &place.span) == line;
    for place in related.clone().filter(is_beside) {
        if let Some(line) = short_line_of(source, &place.span) {
            let span = within(source, &place.span);
            let span = span.start - line.start..span.end.clamp(span.start, line.end) - line.start;
            lines = lines.annotation(AnnotationKind::Context.span(span).label(place.label.as_str()));
        }
    }
    let mut group = level.primary_title(&diagnostic.message).element(lines);
    for place in related.filter(|place| !is_beside(place)) {
        let secondary = (place.span.clone(), Some(place.label.as_str()));
        group = group.element(snippet(diagnostic, source, secondary, AnnotationKind::Context));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    let report: [Group<'_>; 1] = [group];
    renderer.render(&report)
}

/// The lines around one place, the line itself cut if it is long.
fn snippet<'a>(
    diagnostic: &'a Diagnostic,
    source: &'a str,
    (span, label): (Range<usize>, Option<&'a str>),
    kind: AnnotationKind,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let span = within(source, &span);
    let bom = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let span = span.start.max(bom)..span.end.max(bom);
    let start = source[..span.start].rfind('\n').map_or(bom, |newline| newline + 1);
    let end = source[start..].find('\n').map_or(source.len(), |newline| start + newline);
    let line_number = source[..start].bytes().filter(|&b| b == b'\n').count() + 1;
    let (cut, span) = cut_line(&source[start..end], span.start - start..span.end.min(end).max(span.start) - start);
    Snippet::source(cut).line_start(line_number).path(diagnostic.file.as_str()).annotation(kind.span(span).label(label))
}

/// The line in which a span begins, if it is shown as a whole.
fn short_line_of(source: &str, span: &Range<usize>) -> Option<Range<usize>> {
    let at = within(source, span).start;
    let bom = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let start = source[..at].rfind('\n').map_or(bom, |newline| newline + 1);
    let line = source.get(start..)?.lines().next().unwrap_or_default();
    (line.len() <= LONG_LINE && at >= start && at <= start + line.len()).then(|| start..start + line.len())
}

/// The line, or the part of it around the place with `…` for what is missing, and blanks before it so that columns stay
/// what they are; and the place in that part.
fn cut_line(line: &str, span: Range<usize>) -> (String, Range<usize>) {
    let line = line.trim_end_matches('\r');
    let span = span.start.min(line.len())..span.end.min(line.len());
    if line.len() <= LONG_LINE {
        return (line.to_owned(), span);
    }
    let from = boundary(line, span.start.saturating_sub(KEPT));
    let to = boundary(line, (span.end.min(span.start + LONG_LINE) + KEPT).min(line.len()));
    let missing = line[..from].chars().count();
    let before = if missing > 0 { " ".repeat(missing - 1) + "…" } else { String::new() };
    let after = if to < line.len() { "…" } else { "" };
    let shift = |at: usize| at.min(to) - from + before.len();
    let part = format!("{before}{}{after}", &line[from..to]);
    (part, shift(span.start)..shift(span.end))
}

/// The span, on character boundaries inside the text.
fn within(text: &str, span: &Range<usize>) -> Range<usize> {
    let start = boundary(text, span.start.min(text.len()));
    start..boundary(text, span.end.min(text.len())).max(start)
}

fn boundary(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_places_in_one_line_are_marked_in_it() {
        let of = |source: &str, other: usize| {
            let list = vec![Diagnostic {
                severity: Severity::Error,
                message: "twice".to_owned(),
                file: "a.yaml".to_owned(),
                line: 1,
                column: 4,
                span: 3..4,
                setting: None,
                label: None,
                help: None,
                related: vec![Related { label: "the first".to_owned(), line: 1, column: 1, span: other..other + 1 }],
            }];
            Diagnostics { list, source: source.into(), omitted: 0 }.render(false)
        };
        let one = of("{a: 1, b: 2}\n", 9);
        assert_eq!(one.lines().filter(|line| line.contains("{a: 1, b: 2}")).count(), 1, "{one}");
        assert!(one.contains("^     - the first"), "{one}");
        let two = of("{a: 1,\n b: 2}\n", 11);
        assert!(two.contains("b: 2}") && two.contains("- the first"), "{two}");
        let long = of(&("{a: 1, ".to_owned() + &" ".repeat(300) + "b: 2}"), 310);
        assert!(long.contains("the first"), "{long}");
    }

    #[test]
    fn places_in_long_lines_keep_their_columns() {
        for (line, start) in
            [("é".repeat(150) + "x" + &"b".repeat(400), 300), ("a".repeat(900) + "x", 900), ("x".to_owned(), 0)]
        {
            let (cut, span) = cut_line(&line, start..start + 1);
            assert_eq!(&cut[span.clone()], "x");
            assert_eq!(cut[..span.start].chars().count(), line[..start].chars().count());
        }
    }
}
