//! Lists of numbers, points and colors: written in the scene file, or taken from a file beside it.
//!
//! What stands in the scene file (a [`List`]) becomes [`Data`] in a second step, since which columns of a file are usual
//! depends on the field.

use super::decode::{Decoder, Fields};
use super::hints;
use super::record::{FieldAbout, Record, fields, record};
use super::tables;
use super::tree::{Node, NodeKind, Span};
use super::value::{Item, Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::data;
use durer_math::{DVec3, Rgb};
use durer_scene::{Data, DataFile, Sizes};
use serde_json::{Value as Json, json};
use std::rc::Rc;
use std::sync::Arc;

/// A list as a scene file says it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum List<T> {
    /// The values themselves.
    Here(Arc<[T]>),
    /// A file that has them, and where the scene file says so.
    InFile(DataFile, Span),
}

/// One size for all, or one for each, as a scene file says it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SizeList {
    /// The same for all.
    Same(f64),
    /// One for each.
    Each(List<f64>),
}

/// Colors of particles, as a scene file says it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ColorList {
    /// None, even if a file has some.
    None,
    /// One for each.
    Each(List<Rgb>),
}

/// What lists are made of.
pub(crate) trait Entry: Item + PartialEq {
    /// The name of the list's definition in the schema.
    const DEFINITION: &'static str;
}

impl Entry for DVec3 {
    const DEFINITION: &'static str = "points";
}

impl Entry for f64 {
    const DEFINITION: &'static str = "numbers";
}

impl Entry for Rgb {
    const DEFINITION: &'static str = "colors";
}

record!(DataFile {
    file: String => "The file, relative to the scene file: .npy, .csv, .tsv, .txt, .dat, .ply or .xyz.";
    columns: Vec<String> = Vec::new() => "The names of the columns, or their numbers from 1; without them, the usual ones.";
});

impl<T> From<&Data<T>> for List<T> {
    fn from(data: &Data<T>) -> List<T> {
        match &data.file {
            Some(file) => List::InFile(file.clone(), Span::default()),
            None => List::Here(Arc::clone(&data.values)),
        }
    }
}

impl From<&Sizes> for SizeList {
    fn from(sizes: &Sizes) -> SizeList {
        match sizes {
            Sizes::Same(size) => SizeList::Same(*size),
            Sizes::Each(data) => SizeList::Each(data.into()),
        }
    }
}

/// True for the name of a data file.
fn is_file_name(node: &Node) -> bool {
    node.text().is_some_and(|text| data::ending(text).is_some())
}

fn file_out(source: &DataFile, writer: &Writer<'_>) -> Out {
    match source.columns.is_empty() {
        true => source.file.encode(writer),
        false => super::record::encode_record(source, writer),
    }
}

/// The schema of a file with data.
pub(crate) fn file_schema() -> Json {
    json!({ "anyOf": [
        { "type": "string", "description": "A data file.", "pattern": format!("\\.({})$", data::ENDINGS.join("|")) },
        super::schema::record(&DataFile::about()),
    ]})
}

/// The schema of a list of entries, each of which meets `entry`.
pub(crate) fn list_schema(entry: &Json) -> Json {
    json!({ "anyOf": [{ "type": "array", "items": entry }, { "$ref": "#/$defs/data" }] })
}

impl<T: Entry> Value for List<T> {
    fn noun() -> String {
        format!("a list of {}, or a data file", T::PLURAL)
    }
    fn stand_in() -> Self {
        List::Here(Arc::from([]))
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Scalar { text, .. } if is_file_name(node) => {
                Some(List::InFile(DataFile { file: text.clone(), columns: Vec::new() }, node.span))
            }
            NodeKind::Scalar { .. } => cx.expected::<Self>(node),
            NodeKind::Sequence(_) => Vec::<T>::decode(node, cx).map(|values| List::Here(values.into())),
            NodeKind::Mapping(_) => {
                let source = super::record::decode_record("data file", node, cx)?;
                // Without it, there has been a complaint.
                let (_, file) = node.get("file")?;
                Some(List::InFile(source, file.span))
            }
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            List::Here(values) => Out::List(values.iter().map(|value| value.encode(writer)).collect()),
            List::InFile(source, _) => file_out(source, writer),
        }
    }
    fn schema() -> Json {
        json!({ "$ref": format!("#/$defs/{}", T::DEFINITION) })
    }
    fn advice(node: &Node) -> Option<String> {
        file_advice(node)
    }
}

/// What to say to a name that could be that of a file.
fn file_advice(node: &Node) -> Option<String> {
    let name = node.text().filter(|text| text.contains('.') && number_text(node).is_none())?;
    let known = data::ENDINGS.map(|ending| format!(".{ending}")).join(", ");
    (!name.ends_with('.') && !node.is_not_finite()).then(|| format!("data files end in {known}"))
}

impl Value for SizeList {
    fn noun() -> String {
        "a number, a list of numbers, or a data file".to_owned()
    }
    fn stand_in() -> Self {
        SizeList::Same(1.0)
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        if number_text(node).is_some() {
            return f64::decode(node, cx).map(SizeList::Same);
        }
        match node.kind {
            NodeKind::Scalar { .. } if !is_file_name(node) => cx.expected::<Self>(node),
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) | NodeKind::Mapping(_) => {
                List::decode(node, cx).map(SizeList::Each)
            }
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            SizeList::Same(size) => size.encode(writer),
            SizeList::Each(list) => list.encode(writer),
        }
    }
    fn schema() -> Json {
        json!({ "anyOf": [{ "type": "number" }, { "$ref": "#/$defs/numbers" }] })
    }
    fn advice(node: &Node) -> Option<String> {
        hints::number(node).or_else(|| file_advice(node))
    }
}

impl Value for ColorList {
    fn noun() -> String {
        "a list of colors, a data file, or `none`".to_owned()
    }
    fn stand_in() -> Self {
        ColorList::None
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match node.text() {
            Some("none") => Some(ColorList::None),
            Some(_) if !is_file_name(node) => cx.expected::<Self>(node),
            Some(_) | None => List::decode(node, cx).map(ColorList::Each),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            ColorList::None => Out::Plain("none".to_owned()),
            ColorList::Each(list) => list.encode(writer),
        }
    }
    fn schema() -> Json {
        json!({ "anyOf": [{ "const": "none" }, { "$ref": "#/$defs/colors" }] })
    }
    fn advice(node: &Node) -> Option<String> {
        let text = node.text().filter(|text| super::colors::parse(text).is_some() || number_text(node).is_some());
        let one =
            text.map(|color| format!("one color for all is that of the material: `material: {{color: {color}}}`"));
        one.or_else(|| file_advice(node))
    }
}

impl<T: tables::FromTable> List<T> {
    /// The values; those of a file from the columns that are named, or usual for `role`.
    pub(crate) fn resolve(self, role: tables::Role, from: &mut Fields<'_, '_, '_>) -> Data<T> {
        match self {
            List::Here(values) => Data { file: None, values },
            List::InFile(source, span) => {
                let values = tables::values(&source, role, span, from.cx).unwrap_or_else(|| {
                    from.doubt();
                    Arc::from([])
                });
                Data { file: Some(source), values }
            }
        }
    }
}

impl SizeList {
    /// The sizes.
    pub(crate) fn resolve(self, role: tables::Role, from: &mut Fields<'_, '_, '_>) -> Sizes {
        match self {
            SizeList::Same(size) => Sizes::Same(size),
            SizeList::Each(list) => Sizes::Each(list.resolve(role, from)),
        }
    }
}
