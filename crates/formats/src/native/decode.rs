//! Reading values out of the tree: complaints are gathered, and reading goes on.

use super::suggest;
use super::tables::Taken;
use super::tree::{Entry, Node, NodeKind, Span, shorten};
use super::value::Value;
use crate::Limits;
use crate::assets::Assets;
use crate::data::Table;
use crate::diagnostics::Complaint;
use durer_scene::{ImageId, Import, MeshData, Scene};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// Complaints beyond these are not kept.
pub(crate) const MOST_COMPLAINTS: usize = 10_000;
/// Complaints beyond these get no suggestions.
const MOST_HELPED: usize = 200;

/// What reading a file has gathered so far.
pub(crate) struct Decoder<'a> {
    pub(crate) complaints: Vec<Complaint>,
    pub(crate) assets: &'a dyn Assets,
    pub(crate) limits: &'a Limits,
    /// The scene; its textures, materials and images grow as they are met.
    pub(crate) scene: Scene,
    /// Named textures and materials, by name.
    pub(crate) texture_names: BTreeMap<String, u32>,
    pub(crate) material_names: BTreeMap<String, u32>,
    /// The nodes that textures, materials and images were read from, by id.
    pub(crate) texture_nodes: Vec<Rc<Node>>,
    pub(crate) material_nodes: Vec<Rc<Node>>,
    pub(crate) image_nodes: Vec<Rc<Node>>,
    /// Images by the name of their file; `None` if it could not be read.
    pub(crate) images: BTreeMap<String, Option<ImageId>>,
    /// Tables by the name of their file; `None` if it could not be read.
    pub(crate) tables: BTreeMap<String, Option<Rc<Table>>>,
    /// What has been taken from them.
    pub(crate) taken: Taken,
    /// Models by the name of their file, with what they brought in the scene's lists already; `None` if it could not be
    /// read.
    pub(crate) models: BTreeMap<String, Option<Rc<Import>>>,
    /// Meshes by the name of their file, and the word for their normals.
    pub(crate) meshes: BTreeMap<(String, &'static str), Arc<MeshData>>,
    /// Objects that imports have brought so far, those of the same file counted each time.
    pub(crate) imported: usize,
    /// Pixels of all images so far.
    pub(crate) texture_bytes: u64,
    /// Whole numbers beyond all that can be held, which became the largest, as they are written; see [`Decoder::too_large`].
    pub(crate) beyond: Vec<(Span, String)>,
    /// Values that stand beside one that could not be read: what the check says of them may come from the stand-in, unless it
    /// is of one value alone.
    pub(crate) doubtful: Vec<Span>,
}

impl<'a> Decoder<'a> {
    pub(crate) fn new(assets: &'a dyn Assets, limits: &'a Limits) -> Decoder<'a> {
        Decoder {
            complaints: Vec::new(),
            assets,
            limits,
            beyond: Vec::new(),
            doubtful: Vec::new(),
            scene: Scene::default(),
            texture_names: BTreeMap::new(),
            material_names: BTreeMap::new(),
            texture_nodes: Vec::new(),
            material_nodes: Vec::new(),
            image_nodes: Vec::new(),
            images: BTreeMap::new(),
            tables: BTreeMap::new(),
            taken: Taken::new(),
            models: BTreeMap::new(),
            meshes: BTreeMap::new(),
            imported: 0,
            texture_bytes: 0,
        }
    }

    /// Complains that `node` is not a `T`.
    pub(crate) fn expected<T: Value>(&mut self, node: &Node) -> Option<T> {
        self.expected_noun(node, &T::noun(), T::advice(node))
    }

    /// Complains that `node` is not what `noun` says.
    pub(crate) fn expected_noun<T>(&mut self, node: &Node, noun: &str, advice: Option<String>) -> Option<T> {
        let message = format!("expected {noun}, found {}", node.found());
        self.complain(Complaint::error(node.span, message).maybe_help(advice))
    }

    /// Takes the largest number for one that is larger still. If it is too large for its place, the check says how large it may
    /// be, and [`Decoder::as_written`] has it say the number that is written; if not, it cannot be held.
    pub(crate) fn too_large(&mut self, node: &Node) -> u32 {
        if self.beyond.len() < MOST_COMPLAINTS {
            self.beyond.push((node.span, shorten(node.text().unwrap_or_default())));
        }
        u32::MAX
    }

    /// What the check says of this place, with the number that is written there.
    pub(crate) fn as_written(&mut self, message: String, span: Span) -> String {
        let stand_in = u32::MAX.to_string();
        if !message.contains(&stand_in) {
            return message;
        }
        let is_there = |(near, _): &(Span, String)| span.start <= near.start && near.end <= span.end;
        match self.beyond.iter().position(is_there) {
            Some(at) => message.replace(&stand_in, &self.beyond.swap_remove(at).1),
            None => message,
        }
    }

    /// Complains of those that the check has nothing against, unless they stand where something else is `laid_over`.
    pub(crate) fn refuse_those_beyond(&mut self, laid_over: &[Span], complaints: &mut Vec<Complaint>) {
        for (span, _) in std::mem::take(&mut self.beyond) {
            if laid_over.iter().any(|around| around.start <= span.start && span.end <= around.end) {
                continue;
            }
            let complaint = Complaint::error(span, "this number is too large");
            complaints.push(complaint.help(format!("whole numbers go up to {}", u32::MAX)));
        }
    }

    /// Complains about `node`.
    pub(crate) fn refuse<T>(&mut self, node: &Node, message: &str) -> Option<T> {
        self.complain(Complaint::error(node.span, message))
    }

    pub(crate) fn complain<T>(&mut self, complaint: Complaint) -> Option<T> {
        if self.complaints.len() < MOST_COMPLAINTS {
            self.complaints.push(complaint);
        }
        None
    }

    /// True when so much is wrong that help is no longer worth the search.
    pub(crate) fn is_tired(&self) -> bool {
        self.complaints.len() >= MOST_HELPED
    }
}

/// Reads the fields of one mapping, and notices those that nobody asked for.
pub(crate) struct Fields<'n, 'd, 'a> {
    pub(crate) cx: &'d mut Decoder<'a>,
    /// What messages call the thing, and where its name stands.
    title: &'static str,
    title_span: Span,
    example: &'static str,
    entries: &'n [Entry],
    asked: Vec<&'static str>,
    broken: bool,
}

impl<'n, 'd, 'a> Fields<'n, 'd, 'a> {
    /// The fields of the mapping `node`.
    pub(crate) fn of_record(node: &'n Rc<Node>, cx: &'d mut Decoder<'a>, title: &'static str) -> Option<Self> {
        let NodeKind::Mapping(entries) = &node.kind else {
            let noun = format!("the fields of `{title}`");
            let advice = node.text().and_then(super::hints::glued).map(|(_, help)| help);
            return cx.expected_noun(node, &noun, advice);
        };
        Some(Fields::new(cx, title, first_key(node), entries))
    }

    /// The fields in `kind: {fields}`, or none if `node` is just the word `kind`.
    pub(crate) fn of_kind(
        node: &'n Rc<Node>,
        cx: &'d mut Decoder<'a>,
        noun: &'static str,
        words: &[&'static str],
    ) -> Option<Self> {
        let (key, value) = match &node.kind {
            NodeKind::Scalar { .. } if !node.is_null() => (node, None),
            NodeKind::Mapping(entries) => match one_kind(node, entries, noun, words) {
                Ok((key, value)) => (key, Some(value)),
                Err(complaint) => return cx.complain(*complaint),
            },
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => {
                let help = suggest::did_you_mean("", words, &format!("kinds of {noun}"));
                return cx.expected_noun(node, &format!("{} {noun}", article(noun)), Some(help));
            }
        };
        let written = key.text().unwrap_or_default();
        let Some(word) = words.iter().find(|word| **word == written) else {
            let known = if cx.is_tired() { &[] } else { words };
            return cx.complain(unknown_kind(key, value, noun, known));
        };
        let entries = match value.map(|value| (&value.kind, value)) {
            None => &[][..],
            Some((_, value)) if value.is_null() => &[][..],
            Some((NodeKind::Mapping(entries), _)) => entries,
            Some((_, value)) => {
                let glued = value.text().and_then(super::hints::glued).map(|(_, help)| help);
                let named = || value.text().and_then(|text| super::hints::file_alone(word, text));
                let advice = glued.or_else(named).or_else(|| Some(format!("write `{word}: {{…}}`")));
                return cx.expected_noun(value, &format!("the fields of `{word}`"), advice);
            }
        };
        Some(Fields::new(cx, word, key.span, entries))
    }

    fn new(cx: &'d mut Decoder<'a>, title: &'static str, title_span: Span, entries: &'n [Entry]) -> Self {
        Fields { cx, title, title_span, example: "", entries, asked: Vec::new(), broken: false }
    }

    /// The word of the kind.
    pub(crate) fn word(&self) -> &'static str {
        self.title
    }

    /// An example for messages about missing fields.
    pub(crate) fn set_example(&mut self, example: &'static str) {
        self.example = example;
    }

    /// The entry of `key`, if it is given.
    pub(crate) fn entry(&mut self, key: &'static str) -> Option<&'n Entry> {
        self.asked.push(key);
        self.entries.iter().find(|(name, _)| name.text() == Some(key))
    }

    /// A field that must be given.
    pub(crate) fn required<T: Value>(&mut self, key: &'static str) -> T {
        if self.entry(key).is_none() {
            let message = format!("`{}` needs `{key}`", self.title);
            let help = match self.example {
                "" => format!("`{key}` is {}", T::noun()),
                example => format!("for example `{example}`"),
            };
            self.break_with(Complaint::error(self.title_span, message).help(help));
            return T::stand_in();
        }
        self.asked.pop();
        self.or(key, T::stand_in)
    }

    /// A field with a default.
    pub(crate) fn or<T: Value>(&mut self, key: &'static str, default: impl FnOnce() -> T) -> T {
        match self.entry(key) {
            None => default(),
            Some((_, value)) => T::decode(value, self.cx).unwrap_or_else(|| {
                self.broken = true;
                default()
            }),
        }
    }

    /// Complains, and remembers that the thing is broken.
    pub(crate) fn break_with(&mut self, complaint: Complaint) {
        self.doubt();
        let _: Option<()> = self.cx.complain(complaint);
    }

    /// Says something of a thing that can be used.
    pub(crate) fn warn(&mut self, complaint: Complaint) {
        let _: Option<()> = self.cx.complain(complaint);
    }

    /// Remembers that the thing is broken: somebody has complained.
    pub(crate) fn doubt(&mut self) {
        self.broken = true;
    }

    /// The thing lacks something that it cannot do without.
    pub(crate) fn lack(&mut self, what: &str) {
        let message = format!("`{}` needs {what}", self.title);
        let help = format!("for example `{}`", self.example);
        self.break_with(Complaint::error(self.title_span, message).help(help));
    }

    /// True if `key` is given.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.iter().any(|(name, _)| name.text() == Some(key))
    }

    /// Where the value of `key` stands, or else the word of the kind.
    pub(crate) fn span_of(&self, key: &str) -> Span {
        let entry = self.entries.iter().find(|(name, _)| name.text() == Some(key));
        entry.map_or(self.title_span, |(_, value)| value.span)
    }

    /// Refuses fields that nobody asked for. If a value could not be read, those beside it become doubtful.
    pub(crate) fn finish(self) {
        for (key, value) in self.entries {
            let name = key.text().unwrap_or_default();
            if !self.asked.contains(&name) {
                let known = if self.cx.is_tired() { &[][..] } else { &self.asked };
                let help = super::hints::unknown_field(self.title, name, value, known);
                let message = match self.title {
                    "scene" => format!("unknown field `{}` of the scene", shorten(name)),
                    title => format!("unknown field `{}` of `{title}`", shorten(name)),
                };
                let _: Option<()> = self.cx.complain(Complaint::error(key.span, message).help(help));
            }
        }
        if self.broken {
            let nests = |value: &Node| match &value.kind {
                // Columns of a file are numbers like those in a list.
                NodeKind::Mapping(_) => value.get("columns").is_none(),
                NodeKind::Sequence(items) => items.iter().any(|item| matches!(item.kind, NodeKind::Mapping(_))),
                NodeKind::Scalar { .. } => false,
            };
            let beside = self.entries.iter().filter(|(_, value)| !nests(value));
            let beside = beside.flat_map(|(key, value)| [key.span, value.span]);
            self.cx.doubtful.extend(beside.chain([self.title_span]));
        }
    }
}

/// The one entry of a mapping that says the kind.
fn one_kind<'n>(
    node: &Node,
    entries: &'n [Entry],
    noun: &str,
    words: &[&str],
) -> Result<(&'n Rc<Node>, &'n Rc<Node>), Box<Complaint>> {
    match entries {
        [] => {
            let help = suggest::did_you_mean("", words, &format!("kinds of {noun}"));
            Err(Box::new(Complaint::error(node.span, format!("this {noun} is empty")).help(help)))
        }
        [(key, value)] => Ok((key, value)),
        [first, others @ ..] => Err(Box::new(super::hints::several_kinds(first, others, noun, words))),
    }
}

fn unknown_kind(key: &Node, value: Option<&Rc<Node>>, noun: &str, words: &[&str]) -> Complaint {
    let written = key.text().unwrap_or_default();
    let message = format!("unknown {noun} `{}`", shorten(written));
    let help = super::hints::unknown_kind(written, value.map(Rc::as_ref), noun, words);
    Complaint::error(key.span, message).help(help)
}

/// Where a mapping is underlined: at its first key if it covers several lines.
fn first_key(node: &Node) -> Span {
    match &node.kind {
        NodeKind::Mapping(entries) => entries.first().map_or(node.span, |(key, _)| key.span),
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) => node.span,
    }
}

/// "a" or "an".
pub(crate) fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
