//! What may stand in a field: how each type is read, written, described, and called in messages.

use super::decode::Decoder;
use super::hints;
use super::tree::{Node, NodeKind};
use super::write::{Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::{DVec2, DVec3};
use serde_json::{Value as Json, json};
use std::rc::Rc;

/// A type that fields can have.
pub(crate) trait Value: Sized + Clone {
    /// What it is called, with its article: "a number".
    fn noun() -> String;
    /// Something harmless to go on with after a mistake.
    fn stand_in() -> Self;
    /// Reads it; `None` after complaining.
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self>;
    /// Writes it.
    fn encode(&self, writer: &Writer<'_>) -> Out;
    /// The JSON Schema that it meets.
    fn schema() -> Json;
    /// What to say to someone who wrote `node` instead.
    fn advice(_node: &Node) -> Option<String> {
        None
    }
}

/// The text of a number, if the scalar is one in YAML's core schema (decimal).
pub(crate) fn number_text(node: &Node) -> Option<&str> {
    match &node.kind {
        NodeKind::Scalar { text, plain: true } => {
            let digits = text.bytes().any(|b| b.is_ascii_digit());
            let only = text.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E'));
            (digits && only && text.parse::<f64>().is_ok()).then_some(text.as_str())
        }
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) | NodeKind::Mapping(_) => None,
    }
}

/// The shortest text that reads back as the same number.
pub(crate) fn number_out(debug: String) -> Out {
    Out::Plain(match debug.as_str() {
        "NaN" => ".nan".to_owned(),
        "inf" => ".inf".to_owned(),
        "-inf" => "-.inf".to_owned(),
        _ => debug.strip_suffix(".0").map(str::to_owned).unwrap_or(debug),
    })
}

macro_rules! number {
    ($type:ty) => {
        impl Value for $type {
            fn noun() -> String {
                "a number".to_owned()
            }
            fn stand_in() -> Self {
                1.0
            }
            fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
                let Some(number) = number_text(node).and_then(|text| text.parse::<$type>().ok()) else {
                    return cx.expected::<Self>(node);
                };
                if !number.is_finite() {
                    let complaint = Complaint::error(node.span, "this number is too large");
                    return cx.complain(complaint.help(format!("numbers go up to {:.1e}", <$type>::MAX)));
                }
                Some(number)
            }
            fn encode(&self, _: &Writer<'_>) -> Out {
                number_out(format!("{self:?}"))
            }
            fn schema() -> Json {
                json!({ "type": "number" })
            }
            fn advice(node: &Node) -> Option<String> {
                hints::number(node)
            }
        }
    };
}

number!(f32);
number!(f64);

impl Value for u32 {
    fn noun() -> String {
        "a whole number".to_owned()
    }
    fn stand_in() -> Self {
        1
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let Some(number) = number_text(node).and_then(|text| text.parse::<f64>().ok()) else {
            return cx.expected::<Self>(node);
        };
        if number.is_finite() && number.fract() != 0.0 {
            return cx.expected::<Self>(node);
        }
        if number < 0.0 {
            return cx.refuse(node, "this must not be negative: expected a whole number from 0 up");
        }
        Some(if number > f64::from(u32::MAX) { cx.too_large(node) } else { number as u32 })
    }
    fn encode(&self, _: &Writer<'_>) -> Out {
        Out::Plain(self.to_string())
    }
    fn schema() -> Json {
        json!({ "type": "integer", "minimum": 0 })
    }
    fn advice(node: &Node) -> Option<String> {
        hints::number(node)
    }
}

impl Value for i32 {
    fn noun() -> String {
        "a whole number".to_owned()
    }
    fn stand_in() -> Self {
        0
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match number_text(node).and_then(|text| text.parse::<f64>().ok()) {
            Some(number) if number.fract() == 0.0 && number.abs() <= f64::from(i32::MAX) => Some(number as i32),
            Some(number) if number.is_finite() && number.fract() == 0.0 => {
                cx.refuse(node, "this number is too large: whole numbers go up to 2147483647")
            }
            Some(_) | None => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, _: &Writer<'_>) -> Out {
        Out::Plain(self.to_string())
    }
    fn schema() -> Json {
        json!({ "type": "integer" })
    }
    fn advice(node: &Node) -> Option<String> {
        hints::number(node)
    }
}

impl Value for bool {
    fn noun() -> String {
        "true or false".to_owned()
    }
    fn stand_in() -> Self {
        false
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match (node.text(), &node.kind) {
            (Some("true" | "True" | "TRUE"), NodeKind::Scalar { plain: true, .. }) => Some(true),
            (Some("false" | "False" | "FALSE"), NodeKind::Scalar { plain: true, .. }) => Some(false),
            _ => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, _: &Writer<'_>) -> Out {
        Out::Plain(self.to_string())
    }
    fn schema() -> Json {
        json!({ "type": "boolean" })
    }
    fn advice(node: &Node) -> Option<String> {
        match node.text()?.to_ascii_lowercase().as_str() {
            "yes" | "on" | "1" => Some("write `true`".to_owned()),
            "no" | "off" | "0" => Some("write `false`".to_owned()),
            "true" | "false" if node.is_quoted() => Some("remove the quotes".to_owned()),
            _ => None,
        }
    }
}

/// A name: any text.
impl Value for String {
    fn noun() -> String {
        "text".to_owned()
    }
    fn stand_in() -> Self {
        String::new()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match node.text() {
            Some(text) if !node.is_null() => Some(text.to_owned()),
            _ => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, _: &Writer<'_>) -> Out {
        Out::Text(self.clone())
    }
    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

/// A field that may be absent.
impl<T: Value> Value for Option<T> {
    fn noun() -> String {
        T::noun()
    }
    fn stand_in() -> Self {
        None
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        T::decode(node, cx).map(Some)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        self.as_ref().map_or(Out::Null, |value| value.encode(writer))
    }
    fn schema() -> Json {
        T::schema()
    }
}

impl Value for DVec3 {
    fn noun() -> String {
        "three numbers [x, y, z]".to_owned()
    }
    fn stand_in() -> Self {
        DVec3::ONE
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        numbers::<Self, 3>(node, cx).map(DVec3::from_array)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        Out::List(self.to_array().iter().map(|x| x.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/vector" })
    }
    fn advice(node: &Node) -> Option<String> {
        numbers_advice(node, "[x, y, z]")
    }
}

impl Value for DVec2 {
    fn noun() -> String {
        "two numbers [u, v]".to_owned()
    }
    fn stand_in() -> Self {
        DVec2::ONE
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        numbers::<Self, 2>(node, cx).map(DVec2::from_array)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        Out::List(self.to_array().iter().map(|x| x.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 })
    }
    fn advice(node: &Node) -> Option<String> {
        numbers_advice(node, "[u, v]")
    }
}

fn numbers_advice(node: &Node, form: &str) -> Option<String> {
    match &node.kind {
        NodeKind::Scalar { text, .. } if text.contains(',') || text.contains(' ') => {
            let joined = text.split([',', ' ']).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
            joined.split(", ").all(|part| part.parse::<f64>().is_ok()).then(|| format!("write `[{joined}]`"))
        }
        NodeKind::Mapping(_) => Some(format!("write `{form}`, in brackets and without names")),
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) => None,
    }
}

/// N numbers in brackets; `T` gives the noun.
pub(crate) fn numbers<T: Value, const N: usize>(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<[f64; N]> {
    let items = items_of::<T>(node, cx, N, N)?;
    let mut found = [0.0; N];
    let mut complete = true;
    for (slot, item) in found.iter_mut().zip(items) {
        match f64::decode(item, cx) {
            Some(number) => *slot = number,
            None => complete = false,
        }
    }
    complete.then_some(found)
}

/// The items of a list that must have `least` to `most` of them; `T` gives the noun.
fn items_of<'n, T: Value>(
    node: &'n Rc<Node>,
    cx: &mut Decoder<'_>,
    least: usize,
    most: usize,
) -> Option<&'n [Rc<Node>]> {
    let NodeKind::Sequence(items) = &node.kind else {
        return cx.expected_noun(node, &T::noun(), T::advice(node));
    };
    if (least..=most).contains(&items.len()) {
        return Some(items);
    }
    cx.refuse(node, &format!("expected {}, found {}", T::noun(), items.len()))
}

/// Exactly N of something.
impl<T: Item, const N: usize> Value for [T; N] {
    fn noun() -> String {
        format!("a list of {N} {}", T::PLURAL)
    }
    fn stand_in() -> Self {
        std::array::from_fn(|_| T::stand_in())
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let items = items_of::<Self>(node, cx, N, N)?;
        let values: Vec<T> =
            items.iter().map(|item| T::decode(item, cx)).collect::<Vec<_>>().into_iter().collect::<Option<_>>()?;
        values.try_into().ok()
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        Out::List(self.iter().map(|item| item.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "type": "array", "items": T::schema(), "minItems": N, "maxItems": N })
    }
}

/// Any number of something. A broken item is replaced by a stand-in, so that the others keep their places.
impl<T: Item> Value for Vec<T> {
    fn noun() -> String {
        format!("a list of {}", T::PLURAL)
    }
    fn stand_in() -> Self {
        Vec::new()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let items = items_of::<Self>(node, cx, 0, usize::MAX)?;
        let one = |item: &Rc<Node>| {
            T::decode(item, cx).unwrap_or_else(|| {
                // The check shall say nothing of the stand-in.
                cx.doubtful.push(item.span);
                T::stand_in()
            })
        };
        Some(items.iter().map(one).collect())
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        Out::List(self.iter().map(|item| item.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "type": "array", "items": T::schema() })
    }
    fn advice(node: &Node) -> Option<String> {
        match &node.kind {
            NodeKind::Mapping(_) => Some("begin each item with `- `".to_owned()),
            NodeKind::Scalar { .. } if node.is_null() => Some("write `[]` for none".to_owned()),
            NodeKind::Scalar { .. } => Some("begin each item with `- `, or write `[…]` around them".to_owned()),
            NodeKind::Sequence(_) => None,
        }
    }
}

/// Something that lists are made of.
pub(crate) trait Item: Value {
    /// What several of it are called.
    const PLURAL: &'static str;
}

impl Item for DVec3 {
    const PLURAL: &'static str = "points [x, y, z]";
}

impl Item for DVec2 {
    const PLURAL: &'static str = "pairs [u, v]";
}

impl Item for f32 {
    const PLURAL: &'static str = "numbers";
}

impl Item for f64 {
    const PLURAL: &'static str = "numbers";
}

impl Item for u32 {
    const PLURAL: &'static str = "whole numbers";
}

impl Item for String {
    const PLURAL: &'static str = "words";
}

/// Lists in lists.
impl<T: Item, const N: usize> Item for [T; N] {
    const PLURAL: &'static str = match N {
        2 => "pairs",
        3 => "triples",
        _ => "lists",
    };
}
