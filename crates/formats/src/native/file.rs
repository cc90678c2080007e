//! A whole scene file: its top-level fields, and names for textures and materials.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, Record, fields, record};
use super::tree::{Entry, Node, NodeKind, shorten};
use super::value::Value;
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::Rgb;
use durer_scene::{
    Background, Camera, Fog, Light, Material, MaterialId, Object, ObjectKind, Pattern, Picture, RenderSettings, Scene,
    Texture, TextureId,
};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The top-level fields. Textures and materials stand before the objects that use them, whatever their order in the
/// file: their names have been entered before anything is read.
pub(crate) struct SceneFile {
    camera: Option<Camera>,
    picture: Picture,
    render: RenderSettings,
    background: Background,
    ambient: Rgb,
    fog: Option<Fog>,
    lights: Option<Vec<Light>>,
    textures: Textures,
    materials: Materials,
    objects: Vec<Object>,
}

record!(SceneFile {
    camera: Option<Camera> = None => "Where the eye is; without it, all bounded objects are framed.";
    picture: Picture = Picture::default() => "Size and encoding of the picture.";
    render: RenderSettings = RenderSettings::default() => "How the picture is computed.";
    background: Background = Background::default() => "What rays that leave the scene see: a color, `{bottom: color, top: color}`, or a picture, `{image: file}`.";
    ambient: Rgb = Rgb::WHITE => "Ambient light, from everywhere: multiplies the `ambient` of each material.";
    fog: Option<Fog> = None => "Fog.";
    lights: Option<Vec<Light>> = None
        => "The lights. Without this field, those of imported models; if there are none either, two default lights. With `[]` none.";
    textures: Textures = Textures::default() => "Textures, by name.";
    materials: Materials = Materials::default() => "Materials, by name.";
    objects: Vec<Object> = Vec::new() => "What is to be seen.";
});

/// Reads a scene into `cx.scene`.
pub(crate) fn read(root: &Rc<Node>, cx: &mut Decoder<'_>) {
    let Some(entries) = entries_of(root) else {
        let help = "a scene file begins with fields such as `camera:` and `objects:`";
        let _: Option<()> = cx.expected_noun(root, "the fields of a scene", Some(help.to_owned()));
        return;
    };
    enter_names(root, cx);
    // Sections with nothing in them are as good as absent, but for `lights`, where absent and none differ.
    let given = |(key, value): &&(Rc<Node>, Rc<Node>)| {
        !value.is_null() || !matches!(key.text(), Some("objects" | "materials" | "textures"))
    };
    let kept = NodeKind::Mapping(entries.iter().filter(given).cloned().collect());
    let root = Rc::new(Node { span: root.span, kind: kept });
    let Some(mut from) = Fields::of_record(&root, cx, "scene") else { return };
    let file = SceneFile::read(&mut from);
    from.finish();
    let SceneFile { camera, picture, render, background, ambient, fog, lights, objects, .. } = file;
    let lights = lights.unwrap_or_else(|| lights_beside(&objects));
    cx.scene =
        Scene { camera, picture, render, background, ambient, fog, lights, objects, ..std::mem::take(&mut cx.scene) };
}

/// The lights of a scene that says nothing of them.
fn lights_beside(objects: &[Object]) -> Vec<Light> {
    if objects.iter().any(brings_lights) { Vec::new() } else { Light::default_lights() }
}

fn brings_lights(object: &Object) -> bool {
    match &object.kind {
        ObjectKind::Import(import) => !import.lights.is_empty(),
        ObjectKind::Group(members) => members.iter().any(brings_lights),
        // Lights in instances do not shine, and solids have no imports.
        ObjectKind::Instances(_) | ObjectKind::Solid(_) => false,
        ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => false,
    }
}

fn entries_of(node: &Node) -> Option<&[(Rc<Node>, Rc<Node>)]> {
    match &node.kind {
        NodeKind::Mapping(entries) => Some(entries),
        NodeKind::Scalar { .. } | NodeKind::Sequence(_) => None,
    }
}

/// Gives the named textures and materials their ids, in the order of the file.
fn enter_names(root: &Node, cx: &mut Decoder<'_>) {
    let section = |name| root.get(name).and_then(|(_, section)| entries_of(section)).unwrap_or(&[]);
    for (key, node) in section("textures") {
        let name = key.text().unwrap_or_default().to_owned();
        cx.texture_names.insert(name.clone(), cx.scene.textures.len() as u32);
        cx.scene.textures.push(Texture { name: Some(name), ..Texture::stand_in() });
        cx.texture_nodes.push(Rc::clone(node));
    }
    for (key, node) in section("materials") {
        let name = key.text().unwrap_or_default().to_owned();
        cx.material_names.insert(name.clone(), cx.scene.materials.len() as u32);
        cx.scene.materials.push(Material { name: Some(name), ..Material::default() });
        cx.material_nodes.push(Rc::clone(node));
    }
}

/// From name to name no more steps are followed.
const MOST_NAMES: usize = 1000;

/// What entries of a section may be called by.
struct Names<'d> {
    noun: &'static str,
    example: &'static str,
    /// Words that say more than a name: kinds.
    kinds: &'static [(&'static str, &'static str)],
    ids: &'d BTreeMap<String, u32>,
    nodes: &'d [Rc<Node>],
}

impl Names<'_> {
    fn of_textures<'d>(cx: &'d Decoder<'_>) -> Names<'d> {
        let (ids, nodes) = (&cx.texture_names, &cx.texture_nodes);
        Names { noun: "texture", example: "checker: {}", kinds: Pattern::WORDS, ids, nodes }
    }

    fn of_materials<'d>(cx: &'d Decoder<'_>) -> Names<'d> {
        let (ids, nodes) = (&cx.material_names, &cx.material_nodes);
        Names { noun: "material", example: "color: red", kinds: &[], ids, nodes }
    }

    /// What is called so, if this is nothing but a name.
    fn named(&self, node: &Node) -> Option<&Rc<Node>> {
        let name = node.text().filter(|name| self.kinds.iter().all(|(word, _)| word != name))?;
        self.nodes.get(*self.ids.get(name)? as usize)
    }

    /// The complaint about an entry that says nothing but the name of another.
    fn refuse_name(&self, (key, value): &Entry, with_help: bool) -> Option<Complaint> {
        let mut ahead = self.named(value)?;
        let (noun, example) = (self.noun, self.example);
        let [name, written] = [key, value].map(|node| shorten(node.text().unwrap_or_default()));
        let complaint = Complaint::error(value.span, format!("expected a {noun}, found the name of one, `{written}`"));
        // In a circle one who goes from name to name meets who goes half as fast.
        let mut behind = ahead;
        for step in 0..if with_help { MOST_NAMES } else { 0 } {
            let Some(next) = self.named(ahead) else {
                return Some(complaint.help(format!("use `{written}` wherever `{name}` is used")));
            };
            ahead = next;
            if Rc::ptr_eq(ahead, behind) {
                let circle = "these names lead in a circle: say what one of them is, as in";
                return Some(complaint.help(format!("{circle} `{name}: {{{example}}}`")));
            }
            behind = self.named(behind).filter(|_| step % 2 == 1).unwrap_or(behind);
        }
        Some(complaint)
    }
}

/// The named textures; they live in the scene, so this only says whether there are any.
#[derive(Clone, Default, PartialEq)]
struct Textures(Vec<TextureId>);

impl Value for Textures {
    fn noun() -> String {
        "textures by name".to_owned()
    }
    fn stand_in() -> Self {
        Textures::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let Some(entries) = entries_of(node) else { return cx.expected::<Self>(node) };
        for (at, entry) in entries.iter().enumerate() {
            let (_, value) = entry;
            if let Some(complaint) = Names::of_textures(cx).refuse_name(entry, !cx.is_tired()) {
                let _: Option<()> = cx.complain(complaint);
                continue;
            }
            if let Some(texture) = Texture::decode(value, cx) {
                let name = cx.scene.textures[at].name.take();
                cx.scene.textures[at] = Texture { name, ..texture };
            }
        }
        Some(Textures::default())
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let one = |id: &TextureId| {
            let scene = writer.scene?;
            let name = writer.texture_names.get(id.0 as usize)?.clone()?;
            Some((name, scene.textures.get(id.0 as usize)?.encode(writer)))
        };
        Out::Fields(self.0.iter().filter_map(one).collect())
    }
    fn schema() -> Json {
        json!({ "type": ["object", "null"], "additionalProperties": Texture::schema() })
    }
    fn advice(_: &Node) -> Option<String> {
        Some("for example `textures: {tiles: {checker: {size: 0.5}}}`".to_owned())
    }
}

/// The named materials; they live in the scene.
#[derive(Clone, Default, PartialEq)]
struct Materials(Vec<MaterialId>);

impl Value for Materials {
    fn noun() -> String {
        "materials by name".to_owned()
    }
    fn stand_in() -> Self {
        Materials::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let Some(entries) = entries_of(node) else { return cx.expected::<Self>(node) };
        for (at, entry) in entries.iter().enumerate() {
            let (_, value) = entry;
            if let Some(complaint) = Names::of_materials(cx).refuse_name(entry, !cx.is_tired()) {
                let _: Option<()> = cx.complain(complaint);
                continue;
            }
            if let Some(material) = Material::decode(value, cx) {
                let name = cx.scene.materials[at].name.take();
                cx.scene.materials[at] = Material { name, ..material };
            }
        }
        Some(Materials::default())
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let one = |id: &MaterialId| {
            let scene = writer.scene?;
            let name = writer.material_names.get(id.0 as usize)?.clone()?;
            Some((name, scene.materials.get(id.0 as usize)?.encode(writer)))
        };
        Out::Fields(self.0.iter().filter_map(one).collect())
    }
    fn schema() -> Json {
        json!({ "type": ["object", "null"], "additionalProperties": Material::schema() })
    }
    fn advice(_: &Node) -> Option<String> {
        Some("for example `materials: {glass: {transparency: 0.9, ior: 1.5}}`".to_owned())
    }
}

/// Writes a scene, with these settings.
pub(crate) fn write(scene: &Scene, (picture, render): (Picture, RenderSettings)) -> String {
    let (texture_names, material_names) = super::names::choose(scene);
    let writer = Writer { scene: Some(scene), texture_names, material_names };
    let named = |names: &[Option<String>]| {
        let ids = (0..names.len() as u32).filter(|id| names[*id as usize].is_some());
        ids.collect::<Vec<u32>>()
    };
    let file = SceneFile {
        camera: scene.camera.clone(),
        picture,
        render,
        background: scene.background,
        ambient: scene.ambient,
        fog: scene.fog,
        lights: (scene.lights != lights_beside(&scene.objects)).then(|| scene.lights.clone()),
        textures: Textures(named(&writer.texture_names).into_iter().map(TextureId).collect()),
        materials: Materials(named(&writer.material_names).into_iter().map(MaterialId).collect()),
        objects: scene.objects.clone(),
    };
    let mut out = FieldsOut::new(&writer);
    file.write(&mut out);
    match out.into_fields() {
        Out::Fields(fields) if fields.is_empty() => "{}\n".to_owned(),
        fields => fields.to_document(),
    }
}
