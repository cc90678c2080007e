//! Materials: named under `materials:`, or written where they are used.

use super::colors;
use super::decode::{Decoder, Fields};
use super::record::{Choice, Record, example_of};
use super::suggest;
use super::surfaces::{Common, Physical, names_kind};
use super::tree::{Entry, Node, NodeKind, shorten};
use super::value::{Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_scene::{Classic, Material, MaterialId, MaterialKind};
use serde_json::{Value as Json, json};
use std::rc::Rc;

impl Value for Material {
    fn noun() -> String {
        "a material".to_owned()
    }
    fn stand_in() -> Self {
        Material::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let NodeKind::Mapping(entries) = &node.kind else {
            return cx.expected::<Self>(node);
        };
        if names_kind(node) || misspells_kind(entries) {
            return physical(node, cx);
        }
        let mut from = Fields::of_record(node, cx, "material")?;
        let kind = MaterialKind::Classic(Classic::read(&mut from));
        let material = Common::read_onto(kind, &mut from);
        from.finish();
        Some(material)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let mut out = FieldsOut::new(writer);
        match (&self.kind, Physical::of(&self.kind)) {
            (MaterialKind::Classic(classic), _) => classic.write(&mut out),
            (_, Some(kind)) => kind.write(&mut out),
            (_, None) => {}
        }
        Common::of(self).write(&mut out);
        match self.kind.word() {
            None => out.into_fields(),
            // Never a bare word, which would be a name where a material is used.
            Some(word) => Out::Fields(vec![(word.to_owned(), out.into_fields())]),
        }
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/material" })
    }
    fn advice(node: &Node) -> Option<String> {
        match &node.kind {
            NodeKind::Scalar { .. } if node.is_null() => {
                Some("write `{}` for a material that is all defaults".to_owned())
            }
            NodeKind::Scalar { text, .. } => Some(format!("write `{{color: {}}}`", shorten(text))),
            NodeKind::Sequence(_) | NodeKind::Mapping(_) => Some("for example `{color: red}`".to_owned()),
        }
    }
}

/// A material of the kind that the one key of the mapping says.
fn physical(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Material> {
    let words: Vec<&'static str> = Physical::WORDS.iter().map(|(word, _)| *word).collect();
    let mut from = Fields::of_kind(node, cx, "material", &words)?;
    let word = from.word();
    from.set_example(example_of::<Physical>(word));
    let kind = Physical::read(word, &mut from);
    let material = kind.map(|kind| Common::read_onto(kind.into(), &mut from));
    from.finish();
    material
}

/// True for one key with fields that is nearly the word of a kind, and no field of classic materials.
fn misspells_kind(entries: &[Entry]) -> bool {
    let [(key, value)] = entries else { return false };
    let (Some(name), NodeKind::Mapping(_)) = (key.text(), &value.kind) else { return false };
    let is_field = Classic::about().iter().chain(&Common::about()).any(|field| field.key == name);
    !is_field && suggest::nearest(name, Physical::WORDS.iter().map(|(word, _)| *word)).is_some()
}

/// Where a material is used: its name, or the material itself.
impl Value for MaterialId {
    fn noun() -> String {
        "a material".to_owned()
    }
    fn stand_in() -> Self {
        MaterialId(0)
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Mapping(_) => {
                let material = Material::decode(node, cx)?;
                cx.scene.materials.push(material);
                cx.material_nodes.push(Rc::clone(node));
                Some(MaterialId(cx.scene.materials.len() as u32 - 1))
            }
            NodeKind::Scalar { text, .. } if !node.is_null() => match cx.material_names.get(text) {
                Some(id) => Some(MaterialId(*id)),
                None => {
                    let complaint = unknown_material(node, text, cx);
                    cx.complain(complaint)
                }
            },
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => {
                cx.expected_noun(node, &Material::noun(), Material::advice(node))
            }
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        writer.material(*self)
    }
    fn schema() -> Json {
        json!({ "anyOf": [{ "type": "string", "description": "The name of a material." }, { "$ref": "#/$defs/material" }] })
    }
}

fn unknown_material(node: &Node, text: &str, cx: &Decoder<'_>) -> Complaint {
    let complaint = Complaint::error(node.span, format!("unknown material `{}`", shorten(text)));
    let complaint = complaint.label("not defined under `materials`");
    if cx.is_tired() {
        return complaint;
    }
    let names: Vec<&str> = cx.material_names.keys().map(String::as_str).collect();
    if let Some(near) = suggest::nearest(text, names.iter().copied()) {
        return complaint.help(format!("did you mean `{near}`?"));
    }
    if Physical::WORDS.iter().any(|(word, _)| *word == text) {
        return complaint.help(format!("for one of that kind, write `material: {{{text}: {{}}}}`"));
    }
    let is_paint = colors::parse(text).is_some() || cx.texture_names.contains_key(text) || number_text(node).is_some();
    if is_paint {
        return complaint.help(format!("to paint it in that color, write `material: {{color: {text}}}`"));
    }
    match names.is_empty() {
        true => complaint.help(format!("define it: `materials: {{{}: {{color: red}}}}`", shorten(text))),
        false => complaint.help(format!("the materials are {}", suggest::list(&names))),
    }
}
