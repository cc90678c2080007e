//! YAML events to our tree, within budgets: nothing here grows faster than the file, or recurses.

use super::tree::{Entry, Node, NodeKind, Span, shorten};
use crate::Limits;
use crate::diagnostics::Complaint;
use saphyr_parser::{Event, Marker, Parser, ScalarStyle, StrInput};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The one document in `text`; `None` if it is empty or a complaint says why there is none.
pub(crate) fn parse(text: &str, limits: &Limits, complaints: &mut Vec<Complaint>) -> Option<Rc<Node>> {
    if let Some(at) = text.find('\0') {
        complaints
            .push(Complaint::error(Span::new(at, at + 1), "this file holds a zero byte").help("is this a text file?"));
        return None;
    }
    let bom = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut builder = Builder {
        text,
        limits,
        complaints,
        cursor: Cursor { index: 0, byte: bom },
        bom,
        stack: Vec::new(),
        anchors: BTreeMap::new(),
        total: 0,
        root: None,
    };
    let mut parser = Parser::new(StrInput::new(&text[bom..]));
    match builder.run(&mut parser) {
        Ok(()) => builder.root,
        Err(complaint) => {
            complaints.push(*complaint);
            None
        }
    }
}

/// A fatal complaint.
type Stop = Box<Complaint>;

struct Builder<'a> {
    text: &'a str,
    limits: &'a Limits,
    complaints: &'a mut Vec<Complaint>,
    cursor: Cursor,
    bom: usize,
    stack: Vec<Frame>,
    anchors: BTreeMap<usize, Sized>,
    total: usize,
    root: Option<Rc<Node>>,
}

/// A node with the number of values in it and the levels below it, aliases unfolded.
#[derive(Clone)]
struct Sized {
    node: Rc<Node>,
    values: usize,
    levels: usize,
}

/// A list or mapping whose end has not come.
struct Frame {
    anchor: usize,
    span: Span,
    /// True between brackets, whose end is a character of its own.
    flow: bool,
    mapping: bool,
    /// Items, or keys and values in turn.
    children: Vec<Rc<Node>>,
    values: usize,
    levels: usize,
}

/// Follows the parser's character positions to byte positions.
struct Cursor {
    index: usize,
    byte: usize,
}

impl Cursor {
    fn seek(&mut self, text: &str, bom: usize, index: usize) -> usize {
        if index < self.index {
            let back = self.index - index;
            let mut before = text[bom..self.byte].char_indices().rev();
            (self.index, self.byte) = (index, before.nth(back - 1).map_or(bom, |(at, _)| bom + at));
            return self.byte;
        }
        let ahead = index - self.index;
        let rest = &text[self.byte..];
        let bytes = match rest.as_bytes().get(..ahead) {
            Some(stretch) if stretch.is_ascii() => ahead,
            _ => rest.char_indices().nth(ahead).map_or(rest.len(), |(at, _)| at),
        };
        (self.index, self.byte) = (index, self.byte + bytes);
        self.byte
    }
}

impl Builder<'_> {
    fn run(&mut self, parser: &mut Parser<'_, StrInput<'_>>) -> Result<(), Stop> {
        let mut documents = 0;
        while let Some(next) = parser.next_event() {
            let (event, place) = next.map_err(|error| {
                let at = self.byte(error.marker());
                super::syntax::explain(self.text, at, error.info())
            })?;
            let span = Span::new(self.byte(&place.start), self.byte(&place.end));
            match event {
                Event::DocumentStart(_) => {
                    documents += 1;
                    if documents > 1 {
                        return stop(
                            span,
                            "a second document begins here",
                            "a scene file holds one document: remove `---`",
                        );
                    }
                }
                Event::Alias(id) => self.alias(id, span)?,
                Event::Scalar(text, style, anchor, tag) => {
                    self.refuse_tag(tag.is_some(), span);
                    let plain = style == ScalarStyle::Plain;
                    let node = Node { span, kind: NodeKind::Scalar { text: text.into_owned(), plain } };
                    self.add(anchor, Sized { node: Rc::new(node), values: 1, levels: 0 })?;
                }
                Event::SequenceStart(anchor, tag) => self.open(anchor, tag.is_some(), span, false)?,
                Event::MappingStart(anchor, tag) => self.open(anchor, tag.is_some(), span, true)?,
                Event::SequenceEnd | Event::MappingEnd => self.close(span)?,
                Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentEnd => {}
            }
        }
        Ok(())
    }

    fn byte(&mut self, marker: &Marker) -> usize {
        self.cursor.seek(self.text, self.bom, marker.index())
    }

    fn refuse_tag(&mut self, tagged: bool, span: Span) {
        if tagged {
            let complaint = Complaint::error(span, "tags have no meaning in scene files");
            self.complaints.push(complaint.help("remove the word that begins with `!`, or put quotes around it"));
        }
    }

    fn open(&mut self, anchor: usize, tagged: bool, span: Span, mapping: bool) -> Result<(), Stop> {
        self.refuse_tag(tagged, span);
        if self.stack.len() >= self.deepest() {
            return self.too_deep(span);
        }
        let flow = self.text[span.start..].starts_with(['[', '{']);
        self.stack.push(Frame { anchor, span, flow, mapping, children: Vec::new(), values: 1, levels: 0 });
        Ok(())
    }

    /// Reading recurses, so that no setting may allow more than the default.
    fn deepest(&self) -> usize {
        self.limits.max_nesting.min(200) as usize
    }

    fn too_deep(&self, span: Span) -> Result<(), Stop> {
        let message = format!("nested more than {} levels deep", self.deepest());
        let help = match self.limits.max_nesting >= 200 {
            true => "no scene needs this: is a bracket missing?",
            false => "is a bracket missing? If you trust this scene, raise the limit, up to `--limits nesting=200`",
        };
        stop(span, &message, help)
    }

    fn alias(&mut self, id: usize, span: Span) -> Result<(), Stop> {
        let Some(target) = self.anchors.get(&id).cloned() else {
            return stop(span, "this alias stands inside the very thing that it stands for", "it would never end");
        };
        if self.stack.len() + target.levels > self.deepest() {
            return self.too_deep(span);
        }
        if (self.total + target.values) as u64 > self.limits.max_values {
            return self.too_many(span);
        }
        self.add(0, target)
    }

    fn too_many(&self, span: Span) -> Result<(), Stop> {
        let message = format!("this file unfolds to more than {} values", self.limits.max_values);
        let help =
            "aliases count as often as they are used; if you trust this scene, raise the limit: `--limits values=…`";
        stop(span, &message, help)
    }

    fn close(&mut self, end: Span) -> Result<(), Stop> {
        let Some(frame) = self.stack.pop() else { return Ok(()) };
        let last = frame.children.last().map_or(frame.span.end, |child| child.span.end);
        let span = Span::new(frame.span.start, if frame.flow { end.end } else { last });
        let kind = match frame.mapping {
            true => NodeKind::Mapping(self.entries(frame.children)),
            false => NodeKind::Sequence(frame.children),
        };
        // The values inside have been counted when they were added.
        self.total -= frame.values - 1;
        let node = Sized { node: Rc::new(Node { span, kind }), values: frame.values, levels: frame.levels + 1 };
        self.add(frame.anchor, node)
    }

    fn add(&mut self, anchor: usize, new: Sized) -> Result<(), Stop> {
        self.total += new.values;
        if self.total as u64 > self.limits.max_values {
            return self.too_many(new.node.span);
        }
        if anchor != 0 {
            self.anchors.insert(anchor, new.clone());
        }
        match self.stack.last_mut() {
            None => self.root = Some(new.node),
            Some(frame) => {
                frame.values += new.values;
                frame.levels = frame.levels.max(new.levels);
                frame.children.push(new.node);
            }
        }
        Ok(())
    }

    /// Pairs keys with values, refuses keys that occur twice and resolves `<<`.
    fn entries(&mut self, children: Vec<Rc<Node>>) -> Vec<Entry> {
        let mut places: BTreeMap<String, Span> = BTreeMap::new();
        let mut entries: Vec<Entry> = Vec::with_capacity(children.len() / 2);
        let mut merged = Vec::new();
        let mut children = children.into_iter();
        while let (Some(key), Some(value)) = (children.next(), children.next()) {
            let Some(name) = key.text() else {
                self.complaints.push(Complaint::error(key.span, "a key must be a word"));
                continue;
            };
            if name == "<<" {
                merged.push(value);
            } else if let Some(first) = places.get(name) {
                let message = format!("`{}` is given twice", shorten(name));
                self.complaints.push(Complaint::error(key.span, message).also(*first, "given here first"));
            } else {
                places.insert(name.to_owned(), key.span);
                entries.push((key, value));
            }
        }
        for source in merged {
            self.merge(&source, &mut places, &mut entries);
        }
        entries
    }

    fn merge(&mut self, source: &Node, places: &mut BTreeMap<String, Span>, entries: &mut Vec<Entry>) {
        let sources = match &source.kind {
            NodeKind::Sequence(items) => items.iter().map(Rc::as_ref).collect(),
            NodeKind::Mapping(_) | NodeKind::Scalar { .. } => vec![source],
        };
        for source in sources {
            let NodeKind::Mapping(more) = &source.kind else {
                let complaint = Complaint::error(source.span, "`<<` takes the alias of a mapping, or a list of them");
                self.complaints.push(complaint);
                continue;
            };
            for (key, value) in more {
                let name = key.text().unwrap_or_default();
                if !places.contains_key(name) {
                    places.insert(name.to_owned(), key.span);
                    entries.push((Rc::clone(key), Rc::clone(value)));
                }
            }
        }
    }
}

fn stop(span: Span, message: &str, help: &str) -> Result<(), Stop> {
    Err(Box::new(Complaint::error(span, message).help(help)))
}
