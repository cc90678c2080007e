//! Values to text: an output tree, and how it is laid out.

use super::value::Value;
use durer_scene::{MaterialId, Scene, TextureId};
use serde_json::{Value as Json, json};
use std::fmt::Write as _;

/// Lines are filled up to here.
const WIDTH: usize = 110;

/// What is to be written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Out {
    /// Nothing.
    Null,
    /// Text that is YAML already: a number, true, a known word.
    Plain(String),
    /// Any text; put in quotes if it could be taken for something else.
    Text(String),
    /// A list.
    List(Vec<Out>),
    /// Keys and values.
    Fields(Vec<(String, Out)>),
}

/// What writing needs to know of the scene: how its materials and textures are referred to.
pub(crate) struct Writer<'s> {
    pub(crate) scene: Option<&'s Scene>,
    /// Names by id; `None` for what is written where it is used.
    pub(crate) texture_names: Vec<Option<String>>,
    pub(crate) material_names: Vec<Option<String>>,
}

impl Writer<'_> {
    /// A writer of values that refer to nothing.
    pub(crate) fn nowhere() -> Writer<'static> {
        Writer { scene: None, texture_names: Vec::new(), material_names: Vec::new() }
    }

    /// A texture: its name or itself.
    pub(crate) fn texture(&self, id: TextureId) -> Out {
        match self.texture_names.get(id.0 as usize) {
            Some(Some(name)) => Out::Text(name.clone()),
            Some(None) => self.scene.map_or(Out::Null, |scene| scene.textures[id.0 as usize].encode(self)),
            None => Out::Text(format!("missing texture {}", id.0)),
        }
    }

    /// A material: its name or itself.
    pub(crate) fn material(&self, id: MaterialId) -> Out {
        match self.material_names.get(id.0 as usize) {
            Some(Some(name)) => Out::Text(name.clone()),
            Some(None) => self.scene.map_or(Out::Null, |scene| scene.materials[id.0 as usize].encode(self)),
            None => Out::Text(format!("missing material {}", id.0)),
        }
    }
}

/// The fields of one thing as they are written.
pub(crate) struct FieldsOut<'w, 's> {
    writer: &'w Writer<'s>,
    fields: Vec<(String, Out)>,
}

impl<'w, 's> FieldsOut<'w, 's> {
    pub(crate) fn new(writer: &'w Writer<'s>) -> Self {
        FieldsOut { writer, fields: Vec::new() }
    }

    /// A field that must be given.
    pub(crate) fn required<T: Value>(&mut self, key: &str, value: &T) {
        self.fields.push((key.to_owned(), value.encode(self.writer)));
    }

    /// A field with a default.
    pub(crate) fn or<T: Value + PartialEq>(&mut self, key: &str, value: &T, default: &T) {
        if value != default {
            self.required(key, value);
        }
    }

    /// The fields alone.
    pub(crate) fn into_fields(self) -> Out {
        Out::Fields(self.fields)
    }

    /// `word: {fields}`, or the word alone.
    pub(crate) fn into_kind(self, word: &str) -> Out {
        match self.fields.is_empty() {
            true => Out::Plain(word.to_owned()),
            false => Out::Fields(vec![(word.to_owned(), Out::Fields(self.fields))]),
        }
    }
}

impl Out {
    /// On one line, with brackets.
    pub(crate) fn to_flow(&self) -> String {
        match self {
            Out::Null => "null".to_owned(),
            Out::Plain(text) => text.clone(),
            Out::Text(text) => quoted(text),
            Out::List(items) => format!("[{}]", items.iter().map(Out::to_flow).collect::<Vec<_>>().join(", ")),
            Out::Fields(fields) => {
                let fields: Vec<_> =
                    fields.iter().map(|(key, value)| format!("{}: {}", quoted(key), value.to_flow())).collect();
                format!("{{{}}}", fields.join(", "))
            }
        }
    }

    /// As JSON, for defaults in the schema.
    pub(crate) fn to_json(&self) -> Json {
        match self {
            Out::Null => Json::Null,
            Out::Plain(text) => serde_json::from_str(text).unwrap_or_else(|_| json!(text)),
            Out::Text(text) => json!(text),
            Out::List(items) => items.iter().map(Out::to_json).collect(),
            Out::Fields(fields) => {
                Json::Object(fields.iter().map(|(key, value)| (key.clone(), value.to_json())).collect())
            }
        }
    }

    /// A whole file: blocks as far as lines would be too long, brackets below that.
    pub(crate) fn to_document(&self) -> String {
        let mut text = String::new();
        if let Out::Fields(fields) = self {
            for (at, (key, value)) in fields.iter().enumerate() {
                let blocks =
                    matches!(key.as_str(), "lights" | "textures" | "materials" | "objects") && !value.is_empty();
                if at > 0 && blocks {
                    text.push('\n');
                }
                value.entry(key, 0, blocks, &mut text);
            }
        }
        text
    }

    fn is_empty(&self) -> bool {
        match self {
            Out::List(items) => items.is_empty(),
            Out::Fields(fields) => fields.is_empty(),
            Out::Null | Out::Plain(_) | Out::Text(_) => true,
        }
    }

    /// `key: value`, the value on the same line if it fits and need not be a block.
    fn entry(&self, key: &str, indent: usize, block: bool, text: &mut String) {
        let key = quoted(key);
        let flow = self.to_flow();
        if self.is_empty() || !block && indent + key.len() + 2 + flow.len() <= WIDTH || self.is_numbers() {
            let _ = writeln!(text, "{key}: {flow}");
            return;
        }
        let _ = writeln!(text, "{key}:");
        let _ = write!(text, "{:indent$}", "", indent = indent + 2);
        self.block(indent + 2, text);
    }

    /// True for a list of nothing but numbers, which is never broken up.
    fn is_numbers(&self) -> bool {
        matches!(self, Out::List(items) if items.iter().all(|item| matches!(item, Out::Plain(_))))
    }

    /// A list or mapping whose first line's indentation stands already.
    fn block(&self, indent: usize, text: &mut String) {
        let next = |at: usize, text: &mut String| {
            if at > 0 {
                let _ = write!(text, "{:indent$}", "");
            }
        };
        match self {
            Out::Fields(fields) if !fields.is_empty() => {
                for (at, (key, value)) in fields.iter().enumerate() {
                    next(at, text);
                    value.entry(key, indent, false, text);
                }
            }
            Out::List(items) if !items.is_empty() => {
                for (at, item) in items.iter().enumerate() {
                    next(at, text);
                    text.push_str("- ");
                    item.item(indent + 2, text);
                }
            }
            Out::Fields(_) | Out::List(_) | Out::Null | Out::Plain(_) | Out::Text(_) => {
                let _ = writeln!(text, "{}", self.to_flow());
            }
        }
    }

    /// An item after its dash: `kind: {…}` without the outer braces.
    fn item(&self, indent: usize, text: &mut String) {
        let flow = self.to_flow();
        match self {
            Out::Fields(fields) if fields.len() == 1 || indent + flow.len() > WIDTH => self.block(indent, text),
            Out::List(_) if indent + flow.len() > WIDTH && !self.is_numbers() => self.block(indent, text),
            Out::Fields(_) | Out::List(_) | Out::Null | Out::Plain(_) | Out::Text(_) => {
                let _ = writeln!(text, "{flow}");
            }
        }
    }
}

/// The text as it is if nothing else could be understood by it, else in double quotes.
fn quoted(text: &str) -> String {
    let word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ' | '/' | '.');
    let plain = text.chars().all(word)
        && text.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && !text.ends_with(' ')
        && !matches!(
            text.to_ascii_lowercase().as_str(),
            "true" | "false" | "null" | "yes" | "no" | "on" | "off" | "y" | "n" | "none"
        );
    if plain { text.to_owned() } else { in_double_quotes(text) }
}

fn in_double_quotes(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            '\r' => quoted.push_str("\\r"),
            c if (c as u32) < 0x20 || (0x7f..0xa0).contains(&(c as u32)) => {
                let _ = write!(quoted, "\\x{:02x}", c as u32);
            }
            '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}' => {
                let _ = write!(quoted, "\\u{:04x}", c as u32);
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
