//! Transforms: a list of steps, each a mapping of one key.

use super::decode::{Decoder, Fields};
use super::record::{FieldAbout, Record, fields, record, record_value};
use super::suggest;
use super::tree::{Entry, Node, NodeKind, shorten};
use super::value::{Item, Value, number_text, numbers};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::DVec3;
use durer_scene::{Transform, TransformStep};
use serde_json::{Value as Json, json};
use std::rc::Rc;

/// The steps and what they do, for the schema and the reference.
pub(crate) const STEPS: [(&str, &str, &str); 4] = [
    ("translate", "Moves by a vector.", "translate: [0, 1, 0]"),
    ("scale", "Multiplies all coordinates by a number, or each by its own.", "scale: [1, 2, 1]"),
    ("rotate", "Turns about an axis, in degrees, by the right-hand rule.", "rotate: {y: 45}"),
    (
        "matrix",
        "Multiplies by a matrix, given by rows; a fourth row must be 0, 0, 0, 1.",
        "matrix: [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]",
    ),
];

impl Value for Transform {
    fn noun() -> String {
        "a list of steps".to_owned()
    }
    fn stand_in() -> Self {
        Transform::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        if is_one_step(node) {
            return Some(Transform { steps: vec![TransformStep::decode(node, cx)?] });
        }
        let NodeKind::Sequence(items) = &node.kind else {
            return cx.expected::<Self>(node);
        };
        let steps: Vec<Option<TransformStep>> = items.iter().map(|item| TransformStep::decode(item, cx)).collect();
        Some(Transform { steps: steps.into_iter().collect::<Option<_>>()? })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        Out::List(self.steps.iter().map(|step| step.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/transform" })
    }
    fn advice(node: &Node) -> Option<String> {
        match &node.kind {
            NodeKind::Mapping(_) => {
                Some("the order of steps counts: begin each with `- `, the first one first".to_owned())
            }
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => {
                Some("for example `[rotate: {y: 45}, translate: [0, 1, 0]]`".to_owned())
            }
        }
    }
}

/// A single step needs no list.
fn is_one_step(node: &Node) -> bool {
    matches!(&node.kind, NodeKind::Mapping(entries) if entries.len() == 1)
}

impl Value for TransformStep {
    fn noun() -> String {
        "a step such as `translate: [0, 1, 0]`".to_owned()
    }
    fn stand_in() -> Self {
        TransformStep::Translate(DVec3::ZERO)
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let (key, value) = match &node.kind {
            NodeKind::Mapping(entries) => match &entries[..] {
                [(key, value)] => (key, value),
                [_, second, ..] => {
                    let complaint = Complaint::error(second.0.span, "two steps in one item: which comes first?");
                    return cx.complain(complaint.help("begin each step with `- `"));
                }
                [] => return cx.expected::<Self>(node),
            },
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => return cx.expected::<Self>(node),
        };
        match key.text().unwrap_or_default() {
            "translate" => DVec3::decode(value, cx).map(TransformStep::Translate),
            "scale" => scale(value, cx).map(TransformStep::Scale),
            "rotate" => rotate(value, cx),
            "matrix" => matrix(value, cx).map(TransformStep::Matrix),
            other => {
                let words = STEPS.map(|(word, ..)| word);
                let known = if cx.is_tired() { &[][..] } else { &words };
                let help = suggest::did_you_mean(other, known, "steps");
                cx.complain(Complaint::error(key.span, format!("unknown step `{}`", shorten(other))).help(help))
            }
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let (key, value) = match self {
            TransformStep::Translate(by) => ("translate", by.encode(writer)),
            TransformStep::Scale(by) if by.x == by.y && by.y == by.z => ("scale", by.x.encode(writer)),
            TransformStep::Scale(by) => ("scale", by.encode(writer)),
            TransformStep::Rotate { axis, degrees } => ("rotate", encode_rotation(*axis, *degrees, writer)),
            TransformStep::Matrix(rows) => {
                let row = |row: &[f64; 4]| Out::List(row.iter().map(|x| x.encode(writer)).collect());
                ("matrix", Out::List(rows.iter().map(row).collect()))
            }
        };
        Out::Fields(vec![(key.to_owned(), value)])
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/step" })
    }
}

impl Item for TransformStep {
    const PLURAL: &'static str = "steps";
}

fn scale(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<DVec3> {
    if number_text(node).is_some() {
        return f64::decode(node, cx).map(DVec3::splat);
    }
    match node.kind {
        NodeKind::Sequence(_) => DVec3::decode(node, cx),
        NodeKind::Scalar { .. } | NodeKind::Mapping(_) => {
            cx.expected_noun(node, "a number or three numbers [x, y, z]", DVec3::advice(node))
        }
    }
}

const AXES: [(&str, DVec3); 3] = [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)];

/// Any axis: the long form of a rotation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AxisAngle {
    axis: DVec3,
    angle: f64,
}

record!(AxisAngle {
    axis: DVec3 => "The axis, through the origin; any length but zero.";
    angle: f64 => "The angle, in degrees.";
});
record_value!(AxisAngle, "rotate", AxisAngle { axis: DVec3::Y, angle: 0.0 });

fn rotate(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<TransformStep> {
    let NodeKind::Mapping(entries) = &node.kind else {
        let example = match &node.kind {
            NodeKind::Sequence(_) => "one axis at a time: `rotate: {x: 90}`, then `rotate: {y: 45}`",
            NodeKind::Scalar { .. } | NodeKind::Mapping(_) => "about which axis? `rotate: {y: 45}`",
        };
        return cx.expected_noun(node, "an axis and an angle", Some(example.to_owned()));
    };
    let named = entries.iter().find_map(|(key, value)| {
        let axis = AXES.iter().find(|(name, _)| key.text() == Some(name))?;
        Some((axis.1, value))
    });
    let is_long = |(key, _): &Entry| matches!(key.text(), Some("axis" | "angle"));
    match named {
        None if !entries.iter().any(is_long) => {
            let span = entries.first().map_or(node.span, |(key, _)| key.span);
            let complaint = Complaint::error(span, "`rotate` takes one of `x`, `y` and `z`, or `axis` and `angle`");
            cx.complain(complaint.help("for example `rotate: {y: 45}`, or `rotate: {axis: [1, 1, 0], angle: 45}`"))
        }
        Some((axis, value)) if entries.len() == 1 => {
            f64::decode(value, cx).map(|degrees| TransformStep::Rotate { axis, degrees })
        }
        Some(_) => {
            let complaint = Complaint::error(entries[1].0.span, "two axes in one rotation: which comes first?");
            cx.complain(complaint.help("write one after the other: `- rotate: {x: 90}`, then `- rotate: {y: 45}`"))
        }
        None => AxisAngle::decode(node, cx).map(|long| TransformStep::Rotate { axis: long.axis, degrees: long.angle }),
    }
}

fn encode_rotation(axis: DVec3, degrees: f64, writer: &Writer<'_>) -> Out {
    match AXES.iter().find(|(_, known)| *known == axis) {
        Some((name, _)) => Out::Fields(vec![((*name).to_owned(), degrees.encode(writer))]),
        None => AxisAngle { axis, angle: degrees }.encode(writer),
    }
}

fn matrix(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<[[f64; 4]; 3]> {
    let rows = match &node.kind {
        NodeKind::Sequence(rows) if (3..=4).contains(&rows.len()) => rows,
        NodeKind::Sequence(_) | NodeKind::Scalar { .. } | NodeKind::Mapping(_) => {
            return cx.expected_noun(node, "three rows of four numbers", None);
        }
    };
    let rows: Vec<Option<[f64; 4]>> = rows.iter().map(|row| numbers::<Row, 4>(row, cx)).collect();
    let rows: Vec<[f64; 4]> = rows.into_iter().collect::<Option<_>>()?;
    if rows.get(3).is_some_and(|last| *last != [0.0, 0.0, 0.0, 1.0]) {
        return cx.refuse(node, "the fourth row of a matrix must be 0, 0, 0, 1");
    }
    rows[..3].try_into().ok()
}

/// A row of a matrix, for its noun.
#[derive(Clone)]
struct Row;

impl Value for Row {
    fn noun() -> String {
        "a row of four numbers".to_owned()
    }
    fn stand_in() -> Self {
        Row
    }
    fn decode(_: &Rc<Node>, _: &mut Decoder<'_>) -> Option<Self> {
        Some(Row)
    }
    fn encode(&self, _: &Writer<'_>) -> Out {
        Out::Null
    }
    fn schema() -> Json {
        Json::Null
    }
}
