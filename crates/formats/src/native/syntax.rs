//! The YAML parser's messages in plain words.

use super::tree::Span;
use crate::diagnostics::Complaint;

/// What a parser's message begins with or contains, how we say it, and what to do.
const PLAIN_WORDS: &[(&str, &str, &str)] = &[
    ("tab", "a tab is used as indentation", "indent with spaces"),
    ("recursion limit", "brackets are nested too deep", "no scene needs this: is a bracket missing?"),
    ("unknown anchor", "this alias stands for nothing", "define it first, with `&name` before a value"),
    ("duplicated anchor", "this anchor is defined twice", "give it another name"),
    ("misplaced bracket", "this bracket has no partner", "remove it, or open it first"),
    ("expected ',' or ']'", "this list is not closed properly", "separate its items with `,` and end it with `]`"),
    ("expected ',' or '}'", "this mapping is not closed properly", "separate its fields with `,` and end it with `}`"),
    ("in quoted scalar", "this quotation is never closed", "end it with the quotation mark that opened it"),
    ("unexpected end of stream", "this quotation is never closed", "end it with the quotation mark that opened it"),
    ("simple key expect", "a `:` is missing after this key", "write `key: value`"),
    ("simple key expected", "a `:` is missing after this key", "write `key: value`"),
    (
        "mapping values are not allowed",
        "a `:` cannot stand here",
        "is the line above unfinished, the indentation wrong, or are there two keys on one line?",
    ),
    (
        "did not find expected key",
        "this line does not fit the lines above it",
        "fields of one thing begin in the same column",
    ),
    (
        "did not find expected '-'",
        "this line does not fit the list above it",
        "items of one list begin with `-` in the same column",
    ),
    ("block sequence entries are not allowed", "a list item cannot stand here", "begin the list on a line of its own"),
    ("must be followed by a valid YAML whitespace", "a space is missing", "put a space after `:` and `-`"),
    (
        "invalid indentation",
        "this line is not indented far enough",
        "indent it further than the line that it belongs to",
    ),
    (
        "unknown escape",
        "this escape is not known",
        "in double quotes write `\\\\` for a backslash, or use single quotes",
    ),
    ("unexpected character", "this character cannot stand here", "put text that begins with it in quotes"),
    ("expected <document start>", "this does not belong to what stands above", "is the indentation right?"),
    ("version number", "this directive is not understood", "remove the line that begins with `%`"),
    ("directive", "this directive is not understood", "remove the line that begins with `%`"),
    ("tag", "tags have no meaning in scene files", "remove the word that begins with `!`, or put quotes around it"),
];

/// The complaint for the parser's message `info` about the place `at`.
pub(super) fn explain(text: &str, at: usize, info: &str) -> Box<Complaint> {
    let at = on_text(text, at);
    if let Some(tab) = indenting_tab(text, at) {
        let complaint = Complaint::error(Span::new(tab, tab + 1), "a tab is used as indentation");
        return Box::new(complaint.help("indent with spaces"));
    }
    let end = text[at..].chars().next().map_or(at, |c| at + c.len_utf8());
    let span = Span::new(at, end);
    let line = text[text[..at].rfind('\n').map_or(0, |newline| newline + 1)..].lines().next().unwrap_or_default();
    let glued = super::hints::glued(line.trim_start_matches([' ', '-'])).map(|(_, help)| help);
    let known = PLAIN_WORDS.iter().find(|(pattern, ..)| info.contains(pattern));
    Box::new(match known {
        Some((_, message, help)) => Complaint::error(span, *message).help(*help).maybe_help(glued),
        None => Complaint::error(span, format!("this is not YAML: {info}")),
    })
}

/// `at`, or the last character before it that can be shown.
fn on_text(text: &str, at: usize) -> usize {
    if at < text.len() {
        return at;
    }
    text.trim_end().char_indices().next_back().map_or(0, |(last, _)| last)
}

/// A tab before the first word of the line of `at`.
fn indenting_tab(text: &str, at: usize) -> Option<usize> {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next().unwrap_or_default();
    let indentation = line.len() - line.trim_start().len();
    line[..indentation].find('\t').map(|tab| start + tab)
}
