//! Materials: named under `materials:`, or written where they are used.

use super::colors;
use super::decode::{Decoder, Fields};
use super::record::{FieldAbout, Record, fields, record, record_value};
use super::suggest;
use super::tree::{Node, NodeKind, shorten};
use super::value::{Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::Rgb;
use durer_scene::{Attenuation, Material, MaterialId, Paint};
use serde_json::{Value as Json, json};
use std::rc::Rc;

/// The fields of a material; its name is its key under `materials:`.
pub(crate) struct Surface {
    color: Paint,
    ambient: f32,
    diffuse: f32,
    specular: Rgb,
    shininess: f32,
    reflection: Rgb,
    transparency: Rgb,
    ior: Option<f64>,
    fresnel: bool,
    attenuation: Option<Attenuation>,
    emission: Rgb,
    opacity: Paint,
}

record!(Surface {
    color: Paint = Material::default().color => "Color of ambient and diffuse light given back; or a texture.";
    ambient: f32 = Material::default().ambient => "Part of the scene's ambient light that is given back.";
    diffuse: f32 = Material::default().diffuse => "Part of the light from lights that is given back in all directions.";
    specular: Rgb = Rgb::BLACK => "Strength of the highlight; a number or a color.";
    shininess: f32 = Material::default().shininess => "The higher, the smaller and sharper the highlight.";
    reflection: Rgb = Rgb::BLACK => "Part of the mirrored light that is added, 0 to 1; a number or a color.";
    transparency: Rgb = Rgb::BLACK => "Part of what lies behind that shows through, 0 to 1; a number or a color.";
    ior: Option<f64> = None => "Index of refraction of the inside (water 1.33, glass 1.5). Without it, and through shapes that have no inside, light goes straight.";
    fresnel: bool = false => "Divides the light between refraction and reflection by Fresnel's equations.";
    attenuation: Option<Attenuation> = None => "Color taken on inside of closed shapes, by distance.";
    emission: Rgb = Rgb::BLACK => "Light that the surface gives off by itself; a number or a color.";
    opacity: Paint = Material::default().opacity => "How much of the surface is there, from black for holes to white: a number, or a texture.";
});

record!(Attenuation {
    color: Rgb => "What is left of white light, each component above 0 and at most 1,";
    distance: f64 => "after this distance.";
});
record_value!(Attenuation, "attenuation", Attenuation { color: Rgb::WHITE, distance: 1.0 });

impl From<Surface> for Material {
    fn from(surface: Surface) -> Material {
        let Surface {
            color,
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            transparency,
            ior,
            fresnel,
            attenuation,
            emission,
            opacity,
        } = surface;
        let name = None;
        Material {
            name,
            color,
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            transparency,
            ior,
            fresnel,
            attenuation,
            emission,
            opacity,
        }
    }
}

impl From<&Material> for Surface {
    fn from(material: &Material) -> Surface {
        let Material {
            name: _,
            color,
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            transparency,
            ior,
            fresnel,
            attenuation,
            emission,
            opacity,
        } = *material;
        Surface {
            color,
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            transparency,
            ior,
            fresnel,
            attenuation,
            emission,
            opacity,
        }
    }
}

impl Value for Material {
    fn noun() -> String {
        "a material".to_owned()
    }
    fn stand_in() -> Self {
        Material::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let NodeKind::Mapping(_) = &node.kind else {
            return cx.expected::<Self>(node);
        };
        super::record::decode_record::<Surface>("material", node, cx).map(Material::from)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        super::record::encode_record(&Surface::from(self), writer)
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
    let is_paint = colors::parse(text).is_some() || cx.texture_names.contains_key(text) || number_text(node).is_some();
    if is_paint {
        return complaint.help(format!("to paint it in that color, write `material: {{color: {text}}}`"));
    }
    match names.is_empty() {
        true => complaint.help(format!("define it: `materials: {{{}: {{color: red}}}}`", shorten(text))),
        false => complaint.help(format!("the materials are {}", suggest::list(&names))),
    }
}
