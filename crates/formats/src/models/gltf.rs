//! glTF 2.0, as text (`.gltf`) or binary (`.glb`): meshes, materials, lights and the first camera of its scene.
//!
//! serde_json reads the JSON and nothing else is taken for granted: the readers below look up what they need in it, so
//! that a mistake is told with its place in the file (`accessors[3]`), and files that bend the rules where it does no
//! harm can be read. Whatever a file says is either checked against the data that are there or paid for from a budget
//! that follows from its size (`account`).
//!
//! # What becomes of a file
//!
//! * **Nodes** are laid flat: each one that shows a mesh is an object, with all transforms above it in one matrix. A
//!   mesh of several primitives is a group of them.
//! * **Texture coordinates** turn from v downwards to v upwards: 1 - v.
//! * **Vertex colors** are multiplied by the material's base color, unless it has a texture, which then does that.
//! * **Animations** do not play. Morph targets have the weights, and joints the places, that the file sets.
//! * **Lights** of I candela or lux have the intensity I/π: a matte surface of color c gives back c/π of the light that
//!   falls on it to each side, but in classic rendering c. Point lights and spots weaken with the square of the distance.
//!
//! # Materials
//!
//! glTF describes surfaces as the scene's `principled` materials do, which have its names, its meanings and its defaults:
//! base color, metal and roughness, normal textures, emission, and KHR_materials_anisotropy, clearcoat, emissive_strength,
//! ior, sheen, specular, transmission and volume, each number with its texture, of which the channel is read that the
//! format says. What becomes of them without path tracing is said where Whitted's algorithm reads principled materials.
//!
//! * Without a thickness, what light goes through is a sheet (`thin`).
//! * `opacity` is the alpha of factor and texture with `BLEND`; with `MASK`, where that reaches the cutoff.
//! * KHR_materials_pbrSpecularGlossiness has roughness 1 - glossiness, and says what is mirrored straight back, which as
//!   `specular_color` is a multiple of 0.04; its texture is not used.
//! * KHR_materials_unlit becomes a classic material of `ambient` 1 without anything else: the color itself, under the usual
//!   white ambient light. Path tracing lets such materials glow as bright.
//! * Occlusion and thickness textures, and normals of coats, are not used; nor the directions in anisotropy textures.
//! * All textures of a material are laid on by the texture coordinates of the first.

mod accessor;
mod account;
mod container;
mod deform;
mod extensions;
mod files;
mod images;
mod json;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod primitives;
mod source;
#[cfg(test)]
mod tests;
mod value;

use super::{Model, ModelError};
use crate::native::tree::shorten;
use crate::{Assets, Limits};
use durer_scene::Scene;
use meshes::Meshes;
use nodes::Graph;
use source::Source;
use value::{Place, Value};

/// Reads the glTF file in `bytes`, which the scene calls `file`; what it refers to is looked for beside it.
///
/// # Errors
///
/// The first thing that is wrong with it.
pub(crate) fn read(file: &str, bytes: &[u8], assets: &dyn Assets, limits: &Limits) -> Result<Model, ModelError> {
    let container = container::open(bytes)?;
    let json =
        json::parse(container.json, container.json_starts, usize::try_from(limits.max_values).unwrap_or(usize::MAX))?;
    let root = Value::root(&json)?;
    check_version(&root)?;
    let source = Source::new(root, &container, file, assets, limits)?;
    extensions::check(&source)?;
    if !source.root.list("animations")?.is_empty() {
        source.notes.add("animations are not played: the model is in its rest pose", Place::default());
    }
    let scene = read_scene(&source)?;
    Ok(Model { scene, warnings: source.notes.into_sentences() })
}

fn check_version(root: &Value<'_>) -> Result<(), ModelError> {
    let asset = root.object("asset")?;
    let version = asset.map(|asset| asset.text("version")).transpose()?.flatten();
    let Some((asset, version)) = asset.zip(version) else {
        let fault = root.fault("this is JSON, but not glTF: it has no version");
        return Err(fault.help("every glTF file says so in `asset.version`"));
    };
    let version = asset.text("minVersion")?.unwrap_or(version);
    if version == "2" || version.starts_with("2.") {
        return Ok(());
    }
    let fault = asset.fault(format!("this is glTF {}; only 2.0 can be read", shorten(version)));
    Err(fault.help("convert it to glTF 2.0 first, for example with Blender"))
}

fn read_scene(source: &Source<'_>) -> Result<Scene, ModelError> {
    let graph = Graph::of(source)?;
    let mut meshes = Meshes::new(source, &graph);
    let mut scene = Scene { lights: Vec::new(), ..Scene::default() };
    for &index in &graph.scene {
        let index = index as usize;
        let node = source.item("nodes", index, Place::default())?;
        scene.objects.extend(meshes.of_node(index, &node)?);
        scene.lights.extend(lights::light(source, &graph, index, &node)?);
        match (&scene.camera, lights::camera(source, &graph, index, &node)?) {
            (None, camera) => scene.camera = camera,
            (Some(_), Some(_)) => source.notes.add("only the first camera is used", node.place),
            (Some(_), None) => {}
        }
    }
    scene.materials = meshes.materials.list;
    scene.images = meshes.materials.images.images;
    scene.textures = meshes.materials.images.textures;
    Ok(scene)
}
