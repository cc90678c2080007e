//! glTF files, from the outside: imported by a scene file, and loaded by themselves. What is in them, and all that can be
//! wrong with them, is tested beside the reader.

use durer_formats::{LoadOptions, Loaded, NoAssets, load_bytes, load_file, to_yaml};
use durer_math::{DVec3, Rgb};
use durer_scene::{Falloff, Import, LightKind, Object, ObjectKind, Paint, Pattern, Projection};
use serde_json::{Value, json};
use std::path::Path;

/// A red picture of one pixel.
const PICTURE: &[u8] = b"PF\n1 1\n-1.0\n\0\0\x80\x3f\0\0\0\0\0\0\0\0";

/// Three corners, and texture coordinates at them.
fn data() -> Vec<u8> {
    let numbers: [f32; 15] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// A triangle with a texture, far up; a lamp; and a camera that looks at it.
fn stage() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": std::f64::consts::PI }] } },
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": [
            { "name": "flag", "mesh": 0, "translation": [0, 100, 0] },
            { "name": "lamp", "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [1, 101, 3] },
            { "camera": 0, "translation": [0, 100, 5] },
        ],
        "cameras": [{ "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 1.5, "znear": 1, "zfar": 9 } }],
        "materials": [{
            "name": "cloth",
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicFactor": 0 },
            "occlusionTexture": { "index": 0 },
        }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": "cloth%20red.pfm" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 24 },
        ],
        "buffers": [{ "byteLength": 60, "uri": "data/stage.bin" }],
    })
}

/// A folder with a scene that imports the stage, and all that belongs to it.
fn folder(model: &Value) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    std::fs::create_dir_all(folder.path().join("models/data")).unwrap();
    write("scene.yaml", b"objects:\n  - import: {file: models/stage.gltf}\n");
    write("models/stage.gltf", model.to_string().as_bytes());
    write("models/data/stage.bin", &data());
    write("models/cloth red.pfm", PICTURE);
    folder
}

fn load(folder: &Path, file: &str) -> Result<Loaded, String> {
    load_file(folder.join(file), &LoadOptions::default()).map_err(|diagnostics| diagnostics.to_string())
}

fn import(loaded: &Loaded) -> &Import {
    match &loaded.scene.scene().objects[..] {
        [Object { kind: ObjectKind::Import(import), .. }] => import,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_scene_imports_all_that_a_file_has() {
    let folder = folder(&stage());
    let loaded = load(folder.path(), "scene.yaml").unwrap();
    let (scene, import) = (loaded.scene.scene(), import(&loaded));
    let [flag] = &import.objects[..] else { panic!("{:?}", import.objects) };
    assert_eq!(flag.name.as_deref(), Some("flag"));
    assert_eq!(flag.transform.to_affine().transform_point3(DVec3::X), DVec3::new(1.0, 100.0, 0.0));
    let ObjectKind::Mesh(mesh) = &flag.kind else { panic!("{flag:?}") };
    assert_eq!(mesh.data.uvs, [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]);

    let material = &scene.materials[flag.material.unwrap().0 as usize];
    let Paint::Texture(texture) = material.paints()[0] else { panic!("{material:?}") };
    let Pattern::Image(image) = &scene.textures[texture.0 as usize].pattern else { panic!() };
    assert_eq!(scene.images[image.image.0 as usize].file, "models/cloth red.pfm");

    let lamp = &import.lights[0];
    assert_eq!((lamp.name.as_deref(), lamp.classic_intensity(), lamp.color), (Some("lamp"), 1.0, Rgb::WHITE));
    let position = DVec3::new(1.0, 101.0, 3.0);
    assert_eq!(lamp.kind, LightKind::Point { position, falloff: Falloff::InverseSquare, radius: 0.0 });
    let camera = import.camera.as_ref().unwrap();
    assert_eq!((camera.position, camera.look_at), (DVec3::new(0.0, 100.0, 5.0), DVec3::new(0.0, 100.0, 4.0)));
    assert_eq!(camera.projection, Projection::Orthographic { height: 3.0 });

    let [warning] = &loaded.warnings.list[..] else { panic!("{}", loaded.warnings) };
    let message =
        "`models/stage.gltf`: occlusion textures are not used: where light does not come is computed (materials[0])";
    assert_eq!((warning.message.as_str(), warning.line), (message, 2));
    assert!(to_yaml(scene).contains("file: models/stage.gltf"));
}

#[test]
fn a_file_by_itself_is_a_scene() {
    let folder = folder(&stage());
    let loaded = load(folder.path(), "models/stage.gltf").unwrap();
    let scene = loaded.scene.scene();
    assert_eq!((scene.lights.len(), scene.images.len()), (1, 1));
    assert!(scene.camera.is_some());
}

#[test]
fn a_binary_file_needs_nothing_beside_it() {
    let mut model = stage();
    model["buffers"] = json!([{ "byteLength": 60 }]);
    model["materials"] = json!([{}]);
    let mut text = model.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let number = |length: usize| (length as u32).to_le_bytes();
    let chunk = |kind: &[u8], data: &[u8]| [&number(data.len())[..], kind, data].concat();
    let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", &data())].concat();
    let bytes = [&b"glTF"[..], &number(2), &number(12 + chunks.len()), &chunks].concat();
    let load = |bytes: &[u8]| load_bytes(bytes, "stage.glb", &NoAssets, &LoadOptions::default().limits);
    assert!(load(&bytes).is_ok());
    let message = load(&bytes[..100]).unwrap_err().to_string();
    assert!(message.contains("byte 8") && message.contains("the file has only 100"), "{message}");
}

#[test]
fn what_is_wrong_is_said_where_the_file_is_named() {
    let mut model = stage();
    model["accessors"][0]["count"] = json!(4);
    let folder = folder(&model);
    let message = load(folder.path(), "scene.yaml").unwrap_err();
    assert!(message.contains("cannot use the model `models/stage.gltf`"), "{message}");
    assert!(message.contains("accessors[0]: its 4 elements reach beyond bufferViews[0]"), "{message}");
}

#[test]
fn files_outside_stay_closed() {
    let mut model = stage();
    model["images"][0]["uri"] = json!("../../secret.pfm");
    let folder = folder(&model);
    let message = load(folder.path(), "scene.yaml").unwrap_err();
    assert!(message.contains("images[0]: cannot read `models/../../secret.pfm`"), "{message}");
    assert!(message.contains("outside the scene's folder"), "{message}");
}
