//! A scene file as a tree of values, each knowing where it stands.
//!
//! Our own tree, not serde's data model: serde stops at the first error and loses places.

use std::rc::Rc;

/// A stretch of the file's text, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    /// First byte.
    pub(crate) start: usize,
    /// After the last byte.
    pub(crate) end: usize,
}

impl Span {
    /// From `start` to before `end`.
    pub(crate) fn new(start: usize, end: usize) -> Span {
        Span { start, end: end.max(start) }
    }
}

/// One value. Aliases share the node of their anchor, and so its place.
#[derive(Debug)]
pub(crate) struct Node {
    /// Where it stands.
    pub(crate) span: Span,
    /// What it is.
    pub(crate) kind: NodeKind,
}

/// The kinds of value.
#[derive(Debug)]
pub(crate) enum NodeKind {
    /// A number or text; `plain` means without quotes.
    Scalar {
        /// The text, without quotes.
        text: String,
        /// True if it was written without quotes.
        plain: bool,
    },
    /// A list.
    Sequence(Vec<Rc<Node>>),
    /// Keys and values in the order of the file; no key twice, and merge keys already resolved.
    Mapping(Vec<Entry>),
}

/// A key and its value.
pub(crate) type Entry = (Rc<Node>, Rc<Node>);

impl Node {
    /// The text, if it is a scalar.
    pub(crate) fn text(&self) -> Option<&str> {
        match &self.kind {
            NodeKind::Scalar { text, .. } => Some(text),
            NodeKind::Sequence(_) | NodeKind::Mapping(_) => None,
        }
    }

    /// The word of a kind: the text of a scalar, or the first key of a mapping.
    pub(crate) fn first_word(&self) -> Option<&str> {
        match &self.kind {
            NodeKind::Mapping(entries) => entries.first().and_then(|(key, _)| key.text()),
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => self.text(),
        }
    }

    /// True for nothing at all, `~` and `null`.
    pub(crate) fn is_null(&self) -> bool {
        match &self.kind {
            NodeKind::Scalar { text, plain } => *plain && matches!(text.as_str(), "" | "~" | "null" | "Null" | "NULL"),
            NodeKind::Sequence(_) | NodeKind::Mapping(_) => false,
        }
    }

    /// True for text in quotes.
    pub(crate) fn is_quoted(&self) -> bool {
        matches!(self.kind, NodeKind::Scalar { plain: false, .. })
    }

    /// True for `.inf`, `.nan` and other spellings of what is no number that we can use.
    pub(crate) fn is_not_finite(&self) -> bool {
        const WORDS: [&str; 5] = [".inf", ".nan", "inf", "nan", "infinity"];
        let word = |text: &str| WORDS.iter().any(|word| text.eq_ignore_ascii_case(word));
        self.text().is_some_and(|text| word(text.trim_start_matches(['-', '+'])))
    }

    /// The key and value of this name, if it is a mapping that has them.
    pub(crate) fn get(&self, name: &str) -> Option<&Entry> {
        match &self.kind {
            NodeKind::Mapping(entries) => entries.iter().find(|(key, _)| key.text() == Some(name)),
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => None,
        }
    }

    /// What messages call what was found: "the text `big`", "a list".
    pub(crate) fn found(&self) -> String {
        if self.is_null() {
            return "nothing".to_owned();
        }
        match &self.kind {
            NodeKind::Scalar { text, .. } if self.is_not_finite() => format!("`{}`", shorten(text)),
            NodeKind::Scalar { text, plain } if *plain && text.parse::<f64>().is_ok() => {
                format!("the number {}", shorten(text))
            }
            NodeKind::Scalar { text, plain } if *plain && matches!(text.as_str(), "true" | "false") => text.clone(),
            NodeKind::Scalar { text, .. } => format!("the text `{}`", shorten(text)),
            NodeKind::Sequence(_) => "a list".to_owned(),
            NodeKind::Mapping(_) => "a mapping".to_owned(),
        }
    }
}

/// Text for use inside a message: one line of at most 40 characters.
pub(crate) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(40).is_some() {
        short.push('…');
    }
    short
}
