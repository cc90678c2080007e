//! Colours, and what may stand for a colour: the name of a texture, or a texture itself.

use super::colors;
use super::decode::Decoder;
use super::suggest;
use super::tree::{Node, NodeKind, shorten};
use super::value::{Item, Value, number_text};
use super::write::{Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::Rgb;
use durer_scene::{Paint, Texture, TextureId};
use serde_json::{Value as Json, json};
use std::rc::Rc;

impl Value for Rgb {
    fn noun() -> String {
        "a color".to_owned()
    }
    fn stand_in() -> Self {
        Rgb::gray(0.5)
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Sequence(items) if items.len() != 3 => {
                let message = format!("expected a color of three numbers [r, g, b], found {}", items.len());
                cx.complain(Complaint::error(node.span, message).help(match items.len() {
                    1 => "for a gray, write the number without brackets",
                    4 => "leave out the fourth: how much of a surface is there is its material's `opacity`",
                    _ => "write red, green and blue, for example `[0.8, 0.4, 0.1]`",
                }))
            }
            NodeKind::Sequence(_) => components(node, cx),
            NodeKind::Scalar { .. } if number_text(node).is_some() => f32::decode(node, cx).map(Rgb::gray),
            NodeKind::Scalar { .. } if node.is_not_finite() => f32::decode(node, cx).map(Rgb::gray),
            NodeKind::Scalar { text, .. } if !node.is_null() => match colors::parse(text) {
                Some(color) => Some(color),
                None if cx.is_tired() => cx.refuse(node, &format!("unknown color `{}`", shorten(text))),
                None => cx.complain(unknown_color(node, text, &[])),
            },
            NodeKind::Scalar { .. } | NodeKind::Mapping(_) => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        if self.r == self.g && self.g == self.b {
            return self.r.encode(writer);
        }
        Out::List(self.to_array().iter().map(|component| component.encode(writer)).collect())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/color" })
    }
    fn advice(node: &Node) -> Option<String> {
        matches!(node.kind, NodeKind::Mapping(_)).then(|| "write `[r, g, b]`, a name, or \"#rrggbb\"".to_owned())
    }
}

/// Read as 32-bit numbers directly: through 64 bits some would be rounded twice.
fn components(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Rgb> {
    let NodeKind::Sequence(items) = &node.kind else { return None };
    let found: Vec<Option<f32>> = items.iter().map(|item| f32::decode(item, cx)).collect();
    match found[..] {
        [Some(r), Some(g), Some(b)] => Some(Rgb::new(r, g, b)),
        _ => None,
    }
}

/// The complaint about text that is no colour, nor one of these textures.
fn unknown_color(node: &Node, text: &str, textures: &[&str]) -> Complaint {
    let complaint = Complaint::error(node.span, format!("unknown color `{}`", shorten(text)));
    let parts: Vec<&str> = text.trim_start_matches("rgb").trim_matches(['(', ')', ' ']).split([',', ' ']).collect();
    let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    let as_numbers: Option<Vec<f32>> = parts.iter().map(|part| part.parse().ok()).collect();
    match as_numbers {
        Some(numbers) if numbers.len() == 3 && numbers.iter().any(|n| *n > 1.0) => {
            let hex: String = numbers.iter().map(|n| format!("{:02x}", n.clamp(0.0, 255.0) as u8)).collect();
            return complaint.help(format!("write `\"#{hex}\"`, or three numbers from 0 to 1 in brackets"));
        }
        Some(numbers) if numbers.len() == 3 => return complaint.help(format!("write `[{}]`", parts.join(", "))),
        _ => {}
    }
    if let Some(help) = hexadecimal(text).or_else(|| image_file(text)) {
        return complaint.help(help);
    }
    let squeezed = text.replace([' ', '_', '-'], "");
    let known = textures.iter().copied().chain(colors::NAMES.iter().map(|(name, _)| *name));
    complaint.help(match suggest::nearest(&squeezed, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "a color is a CSS name, \"#rrggbb\", a gray from 0 to 1, or `[r, g, b]`".to_owned(),
    })
}

/// Help for a color by hexadecimal digits that is not quite as it should be.
fn hexadecimal(text: &str) -> Option<String> {
    let is_marked = text.starts_with('#');
    let digits = ["#", "0x", "0X"].iter().find_map(|mark| text.strip_prefix(mark)).unwrap_or(text);
    let are_digits = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    match digits.len() {
        3 | 6 if are_digits && !is_marked => Some(format!("write `\"#{digits}\"`")),
        4 | 8 if are_digits && is_marked => {
            let opaque = &digits[..digits.len() / 4 * 3];
            Some(format!("write `\"#{opaque}\"`; how much of a surface is there is its material's `opacity`"))
        }
        _ => is_marked.then(|| "write `\"#rgb\"` or `\"#rrggbb\"` with the digits 0-9 and a-f".to_owned()),
    }
}

/// Help for the name of an image where a color should be.
pub(super) fn image_file(text: &str) -> Option<String> {
    let (_, ending) = text.rsplit_once('.')?;
    let ending = ending.to_ascii_lowercase();
    let is_image = matches!(ending.as_str(), "png" | "jpg" | "jpeg" | "exr" | "hdr" | "pfm");
    is_image.then(|| format!("for an image write `{{image: {{file: {}}}}}`", shorten(text)))
}

impl Value for Paint {
    fn noun() -> String {
        "a color or texture".to_owned()
    }
    fn stand_in() -> Self {
        Paint::Color(Rgb::gray(0.5))
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Mapping(_) => {
                let texture = Texture::decode(node, cx)?;
                cx.scene.textures.push(texture);
                cx.texture_nodes.push(Rc::clone(node));
                Some(Paint::Texture(TextureId(cx.scene.textures.len() as u32 - 1)))
            }
            NodeKind::Scalar { text, .. } if number_text(node).is_none() && !node.is_null() => named(node, text, cx),
            NodeKind::Scalar { .. } if node.is_null() => cx.expected::<Self>(node),
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => Rgb::decode(node, cx).map(Paint::Color),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            Paint::Color(color) => color.encode(writer),
            Paint::Texture(id) => writer.texture(*id),
        }
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/paint" })
    }
}

impl Item for Rgb {
    const PLURAL: &'static str = "colors";
}

impl Item for Paint {
    const PLURAL: &'static str = "colors or textures";
}

/// A texture of the file, or else a colour.
fn named(node: &Rc<Node>, text: &str, cx: &mut Decoder<'_>) -> Option<Paint> {
    if let Some(id) = cx.texture_names.get(text) {
        return Some(Paint::Texture(TextureId(*id)));
    }
    if let Some(color) = colors::parse(text) {
        return Some(Paint::Color(color));
    }
    if node.is_not_finite() {
        return f32::decode(node, cx).map(|gray| Paint::Color(Rgb::gray(gray)));
    }
    if cx.is_tired() {
        return cx.refuse(node, &format!("unknown color `{}`", shorten(text)));
    }
    if cx.material_names.contains_key(text) {
        let complaint = Complaint::error(node.span, format!("`{}` is a material, not a color", shorten(text)));
        return cx
            .complain(complaint.help("here stands a color, or a texture, which is made of colors and other textures"));
    }
    let textures: Vec<&str> = cx.texture_names.keys().map(String::as_str).collect();
    let complaint = unknown_color(node, text, &textures);
    cx.complain(match textures.is_empty() {
        true => complaint,
        false => complaint.label(format!("the textures are {}", suggest::list(&textures))),
    })
}
