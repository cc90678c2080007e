//! The fields of materials: those of the classic kind, those of each physical kind, and those that all have.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, choice_value, fields, record, record_value};
use super::tree::{Node, NodeKind};
use super::value::Value;
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::Rgb;
use durer_scene::{
    Attenuation, Bump, Classic, Conductor, Emission, Glass, Material, MaterialKind, Matte, Metal, MetalName, Mirror,
    NormalMap, Paint, Plastic, Principled, Relief, Sides,
};
use serde_json::{Value as Json, json};
use std::rc::Rc;

record!(Classic {
    color: Paint = Classic::default().color => "Color of ambient and diffuse light given back; or a texture.";
    ambient: f32 = Classic::default().ambient => "Part of the scene's ambient light that is given back.";
    diffuse: f32 = Classic::default().diffuse => "Part of the light from lights that is given back in all directions.";
    specular: Rgb = Rgb::BLACK => "Strength of the highlight; a number or a color.";
    shininess: f32 = Classic::default().shininess => "The higher, the smaller and sharper the highlight.";
    reflection: Rgb = Rgb::BLACK => "Part of the mirrored light that is added, 0 to 1; a number or a color.";
    transparency: Rgb = Rgb::BLACK => "Part of what lies behind that shows through, 0 to 1; a number or a color.";
    ior: Option<f64> = None => "Index of refraction of the inside (water 1.33, glass 1.5). Without it, and through shapes that have no inside, light goes straight.";
    fresnel: bool = false => "Divides the light between refraction and reflection by Fresnel's equations.";
    attenuation: Option<Attenuation> = None => "Color taken on inside of closed shapes, by distance.";
});

record!(Attenuation {
    color: Rgb => "What is left of white light, each component above 0 and at most 1,";
    distance: f64 => "after this distance.";
});
record_value!(Attenuation, "attenuation", Attenuation { color: Rgb::WHITE, distance: 1.0 });

/// The kinds that a word names. Classic materials have none.
pub(crate) enum Physical {
    Matte(Matte),
    Metal(Metal),
    Glass(Glass),
    Plastic(Plastic),
    Mirror(Mirror),
    Principled(Box<Principled>),
}

choice! { Physical, "material";
    Matte "matte": "Gives light back in all directions, like paper or plaster.",
    example "matte: {color: tomato}", (Matte)
    Metal "metal": "Gold, silver, and other conductors.",
    example "metal: {of: gold, roughness: 0.2}", (Metal)
    Glass "glass": "What light goes through, bent and reflected as physics has it; clear or frosted.",
    example "glass: {ior: 1.5}", (Glass)
    Plastic "plastic": "A clear coat over a colored base.",
    example "plastic: {color: navy, roughness: 0.05}", (Plastic)
    Mirror "mirror": "A perfect mirror.", example "mirror: {color: 0.9}", (Mirror)
    Principled "principled": "The material of glTF, with its extensions; models of that format have it.",
    example "principled: {base_color: tomato, roughness: 0.4, clearcoat: 1}", (Box<Principled>)
}

impl Physical {
    pub(crate) fn of(kind: &MaterialKind) -> Option<Physical> {
        match kind {
            MaterialKind::Classic(_) => None,
            MaterialKind::Matte(one) => Some(Physical::Matte(*one)),
            MaterialKind::Metal(one) => Some(Physical::Metal(*one)),
            MaterialKind::Glass(one) => Some(Physical::Glass(*one)),
            MaterialKind::Plastic(one) => Some(Physical::Plastic(*one)),
            MaterialKind::Mirror(one) => Some(Physical::Mirror(*one)),
            MaterialKind::Principled(one) => Some(Physical::Principled(one.clone())),
        }
    }
}

impl From<Physical> for MaterialKind {
    fn from(kind: Physical) -> MaterialKind {
        match kind {
            Physical::Matte(one) => MaterialKind::Matte(one),
            Physical::Metal(one) => MaterialKind::Metal(one),
            Physical::Glass(one) => MaterialKind::Glass(one),
            Physical::Plastic(one) => MaterialKind::Plastic(one),
            Physical::Mirror(one) => MaterialKind::Mirror(one),
            Physical::Principled(one) => MaterialKind::Principled(one),
        }
    }
}

record!(Matte {
    color: Paint = Matte::default().color => "Part of the light that is given back.";
    roughness: Paint = Matte::default().roughness => "0 is Lambert's law; up to 1, more and more like the moon (Oren and Nayar). A number or a texture.";
});

/// The metal is one of three fields or pairs of fields.
struct MetalFields {
    of: Option<MetalName>,
    eta: Option<Rgb>,
    k: Option<Rgb>,
    color: Option<Paint>,
    roughness: Paint,
    anisotropy: Paint,
    rotation: Paint,
}

record!(MetalFields {
    of: Option<MetalName> = None => "Which metal; aluminum unless one of the next three is given.";
    eta: Option<Rgb> = None => "Instead of `of`, with `k`: the real part of the index of refraction, for red, green and blue.";
    k: Option<Rgb> = None => "Its imaginary part.";
    color: Option<Paint> = None => "Instead of `of`: what is reflected straight back.";
    roughness: Paint = Metal::default().roughness => "From 0 for a mirror to 1; a number or a texture.";
    anisotropy: Paint = Metal::default().anisotropy => "From 0 for round highlights to 1 for such as are long along u, or -1 along v; a number or a texture.";
    rotation: Paint = Metal::default().rotation => "Turns these highlights, in whole turns; a number or a texture.";
});

impl Record for Metal {
    fn read(from: &mut Fields<'_, '_, '_>) -> Self {
        let MetalFields { of, eta, k, color, roughness, anisotropy, rotation } = MetalFields::read(from);
        let given = ["of", "eta", "k", "color"].into_iter().filter(|key| from.has(key)).collect::<Vec<_>>();
        let conductor = match (of, eta, k, color) {
            (Some(name), None, None, None) => Conductor::Named(name),
            (None, Some(eta), Some(k), None) => Conductor::Index { eta, k },
            (None, None, None, Some(color)) => Conductor::Reflectance(color),
            (None, None, None, None) => {
                // Where one of them is given but wrong, that has been told.
                if given.is_empty() {
                    let complaint =
                        Complaint::warning(from.span_of("of"), "`metal` does not say which: it is aluminum");
                    from.warn(complaint.help("say so with `of: aluminum`, or choose another, such as `of: gold`"));
                }
                Metal::default().conductor
            }
            (None, Some(_), None, None) | (None, None, Some(_), None) => {
                let there = from.span_of(given.first().copied().unwrap_or_default());
                let complaint = Complaint::error(there, "`eta` and `k` go together");
                from.break_with(complaint.help("for example `metal: {eta: [0.14, 0.37, 1.44], k: [3.98, 2.39, 1.6]}`"));
                Metal::default().conductor
            }
            _ => {
                let (first, second) = (given[0], given[given.len() - 1]);
                let message = format!("`{first}` and `{second}` contradict each other");
                let complaint = Complaint::error(from.span_of(second), message).help("keep one of them");
                from.break_with(complaint.also(from.span_of(first), "the first"));
                Metal::default().conductor
            }
        };
        Metal { conductor, roughness, anisotropy, rotation }
    }

    fn write(&self, out: &mut FieldsOut<'_, '_>) {
        let Metal { conductor, roughness, anisotropy, rotation } = *self;
        let (mut of, mut index, mut color) = (None, None, None);
        match conductor {
            Conductor::Named(name) => of = Some(name),
            Conductor::Index { eta, k } => index = Some((eta, k)),
            Conductor::Reflectance(paint) => color = Some(paint),
        }
        let (eta, k) = (index.map(|(eta, _)| eta), index.map(|(_, k)| k));
        MetalFields { of, eta, k, color, roughness, anisotropy, rotation }.write(out);
    }

    fn about() -> Vec<FieldAbout> {
        MetalFields::about()
    }
}

choice! { MetalName, "metal";
    Aluminum "aluminum": "", example "of: aluminum", {}
    Brass "brass": "", example "of: brass", {}
    Chromium "chromium": "", example "of: chromium", {}
    Copper "copper": "", example "of: copper", {}
    Gold "gold": "", example "of: gold", {}
    Iron "iron": "", example "of: iron", {}
    Nickel "nickel": "", example "of: nickel", {}
    Platinum "platinum": "", example "of: platinum", {}
    Silver "silver": "", example "of: silver", {}
    Titanium "titanium": "", example "of: titanium", {}
}
choice_value!(MetalName, MetalName::Aluminum);

record!(Glass {
    ior: f64 = Glass::default().ior => "Index of refraction of the inside: water 1.33, glass 1.5, diamond 2.42.";
    roughness: Paint = Glass::default().roughness => "From 0 for clear glass to 1 for frosted; a number or a texture.";
    color: Paint = Glass::default().color => "Multiplies light that goes through the surface, each time.";
    attenuation: Option<Attenuation> = None => "Color taken on inside of closed shapes, by distance.";
    priority: i32 = 0 => "Where glasses overlap, the one of highest priority is there.";
    thin: bool = false => "A thin sheet, such as a window: light goes straight through.";
});

record!(Plastic {
    color: Paint = Plastic::default().color => "Part of the light that the base gives back.";
    ior: f64 = Plastic::default().ior => "Index of refraction of the coat, from 1 to 10.";
    roughness: Paint = Plastic::default().roughness => "From 0 for polished to 1 for dull; a number or a texture.";
});

record!(Mirror {
    color: Paint = Mirror::default().color => "Part of the light that is given back.";
});

record!(Principled {
    base_color: Paint = Principled::default().base_color => "Of metals what they reflect, of all else the diffuse color.";
    metallic: Paint = Principled::default().metallic => "From 0 to 1 for metals; a number or a texture, as in all fields that are no colors.";
    roughness: Paint = Principled::default().roughness => "From 0 for polished to 1 for dull.";
    ior: f64 = Principled::default().ior => "Index of refraction, from 1 to 10.";
    specular: Paint = Principled::default().specular => "Strength of the reflection of what is no metal.";
    specular_color: Paint = Principled::default().specular_color => "Its color.";
    transmission: Paint = Principled::default().transmission => "Part of the light that goes through instead of being given back diffusely.";
    thin: bool = false => "True for sheets, which light goes straight through.";
    attenuation: Option<Attenuation> = None => "Color taken on inside of closed shapes, by distance.";
    clearcoat: Paint = Principled::default().clearcoat => "Strength of a clear coat above all the rest.";
    clearcoat_roughness: Paint = Principled::default().clearcoat_roughness => "Its roughness.";
    sheen_color: Paint = Principled::default().sheen_color => "Color of a sheen as of velvet.";
    sheen_roughness: Paint = Principled::default().sheen_roughness => "Its roughness.";
    anisotropy: Paint = Principled::default().anisotropy => "From 0 for round highlights to 1 for such as are long along u.";
    anisotropy_rotation: Paint = Principled::default().anisotropy_rotation => "Turns these highlights, in whole turns.";
});

impl<R: Record> Record for Box<R> {
    fn read(from: &mut Fields<'_, '_, '_>) -> Self {
        Box::new(R::read(from))
    }
    fn write(&self, out: &mut FieldsOut<'_, '_>) {
        R::write(self, out);
    }
    fn about() -> Vec<FieldAbout> {
        R::about()
    }
}

/// The fields that materials of all kinds have.
pub(crate) struct Common {
    emission: Emission,
    opacity: Paint,
    normal_map: Option<NormalMap>,
    bump: Option<Bump>,
}

record!(Common {
    emission: Emission = Emission::NONE => "Light that the surface gives off by itself: a color, a texture, or `{color: 1, strength: 5, sides: front}`.";
    opacity: Paint = Paint::Color(Rgb::WHITE) => "How much of the surface is there, from black for holes to white: a number, or a texture.";
    normal_map: Option<NormalMap> = None => "A texture of normals, as glTF has it, or `{texture: …, strength: 0.5}`.";
    bump: Option<Bump> = None => "A texture of heights, by which the surface is shaded.";
});

impl Common {
    /// Puts them on a material.
    pub(crate) fn read_onto(kind: MaterialKind, from: &mut Fields<'_, '_, '_>) -> Material {
        let Common { emission, opacity, normal_map, bump } = Common::read(from);
        if normal_map.is_some() && bump.is_some() {
            let message = "`normal_map` and `bump` contradict each other";
            let complaint = Complaint::error(from.span_of("bump"), message).help("keep one of them");
            from.break_with(complaint.also(from.span_of("normal_map"), "the first"));
        }
        let relief = normal_map.map(Relief::NormalMap).or(bump.map(Relief::Bump));
        Material { name: None, kind, emission, opacity, relief }
    }

    pub(crate) fn of(material: &Material) -> Common {
        let Material { name: _, kind: _, emission, opacity, relief } = *material;
        let (normal_map, bump) = match relief {
            Some(Relief::NormalMap(map)) => (Some(map), None),
            Some(Relief::Bump(bump)) => (None, Some(bump)),
            None => (None, None),
        };
        Common { emission, opacity, normal_map, bump }
    }
}

record!(Emission {
    color: Paint = Paint::Color(Rgb::WHITE) => "Its color; or a texture.";
    strength: f32 = 1.0 => "Multiplies the color.";
    sides: Sides = Sides::Both => "Which sides of the surface give it off.";
});

choice! { Sides, "side";
    Both "both": "Both sides.", example "sides: both", {}
    Front "front": "That of the surface's own normal; of closed shapes the outside.", example "sides: front", {}
}
choice_value!(Sides, Sides::Both);

/// A color or texture, or the fields.
impl Value for Emission {
    fn noun() -> String {
        "a color, a texture, or the fields of `emission`".to_owned()
    }
    fn stand_in() -> Self {
        Emission::NONE
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match has_any(node, &["color", "strength", "sides"]) {
            true => super::record::decode_record("emission", node, cx),
            false => Paint::decode(node, cx).map(|color| Emission { color, ..Emission::NONE }),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match *self == (Emission { color: self.color, ..Emission::NONE }) {
            true => self.color.encode(writer),
            false => super::record::encode_record(self, writer),
        }
    }
    fn schema() -> Json {
        json!({ "anyOf": [Paint::schema(), super::schema::record(&Emission::about())] })
    }
}

record!(NormalMap {
    texture: Paint => "The texture; an image with `encoding: linear`.";
    strength: f32 = 1.0 => "Multiplies how far normals lean; 0 leaves the surface smooth.";
});

/// A texture, or the fields.
impl Value for NormalMap {
    fn noun() -> String {
        "a texture, or the fields of `normal_map`".to_owned()
    }
    fn stand_in() -> Self {
        NormalMap { texture: Paint::Color(Rgb::new(0.5, 0.5, 1.0)), strength: 1.0 }
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match has_any(node, &["texture", "strength"]) {
            true => super::record::decode_record("normal_map", node, cx),
            false => Paint::decode(node, cx).map(|texture| NormalMap { texture, strength: 1.0 }),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self.strength == 1.0 {
            true => self.texture.encode(writer),
            false => super::record::encode_record(self, writer),
        }
    }
    fn schema() -> Json {
        json!({ "anyOf": [Paint::schema(), super::schema::record(&NormalMap::about())] })
    }
}

record!(Bump {
    height: Paint => "The height, from black to white: a texture.";
    size: f64 => "How far white is above black, in units of the object's own space.";
});
record_value!(Bump, "bump", Bump { height: Paint::Color(Rgb::BLACK), size: 1.0 });

fn has_any(node: &Node, keys: &[&str]) -> bool {
    matches!(node.kind, NodeKind::Mapping(_)) && keys.iter().any(|key| node.get(key).is_some())
}

/// The word of a physical kind, if the mapping is of one: the key of fields, or of nothing at all.
pub(crate) fn names_kind(node: &Node) -> bool {
    let NodeKind::Mapping(entries) = &node.kind else { return false };
    let has_fields = |value: &Node| value.is_null() || matches!(value.kind, NodeKind::Mapping(_));
    entries
        .iter()
        .any(|(key, value)| has_fields(value) && Physical::WORDS.iter().any(|(word, _)| key.text() == Some(word)))
}
