//! Lights, cameras, extensions, and the files around.

use super::build::File;
use super::{assert_near, fault, read, try_read};
use crate::{AssetError, Assets, Limits};
use durer_math::{DVec3, Rgb};
use durer_scene::{Falloff, LightKind, Projection};
use serde_json::{Value, json};

/// A file with this light at (1, 2, 3), turned a quarter about x so that it shines straight down.
fn lit(light: Value) -> File {
    let mut file = File::new();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    let lights = Value::Array(vec![light]);
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    file.node(json!({
        "name": "lamp",
        "translation": [1, 2, 3],
        "rotation": [-half, 0, 0, half],
        "extensions": { "KHR_lights_punctual": { "light": 0 } },
    }));
    file
}

#[test]
fn lights() {
    let model = read(&lit(json!({ "type": "point", "intensity": 10, "color": [1, 0.5, 0] })));
    let light = &model.scene.lights[0];
    assert_eq!((light.name.as_deref(), light.color), (Some("lamp"), Rgb::new(1.0, 0.5, 0.0)));
    assert!((f64::from(light.classic_intensity()) - 10.0 / std::f64::consts::PI).abs() < 1e-6);
    let position = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(light.kind, LightKind::Point { position, falloff: Falloff::InverseSquare, radius: 0.0 });

    let model = read(&lit(json!({ "type": "directional" })));
    let LightKind::Directional { direction } = model.scene.lights[0].kind else { panic!() };
    assert_near(direction, DVec3::NEG_Y);

    let cone = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    let model = read(&lit(json!({ "type": "spot", "spot": cone, "range": 7 })));
    let LightKind::Spot { position: at, target, half_angle_degrees, inner_half_angle_degrees, falloff, .. } =
        model.scene.lights[0].kind
    else {
        panic!()
    };
    assert_eq!((at, falloff), (position, Falloff::InverseSquare));
    assert_near(target, DVec3::new(1.0, 1.0, 3.0));
    assert!((half_angle_degrees - 28.647_889_756_541_16).abs() < 1e-9);
    assert!((inner_half_angle_degrees - 14.323_944_878_270_58).abs() < 1e-9);
    assert!(model.warnings[0].contains("range of lights"), "{:?}", model.warnings);
}

#[test]
fn lights_that_lie_are_refused() {
    assert!(fault(&lit(json!({ "type": "area" }))).contains("directional, point or spot"));
    let mut file = lit(json!({ "type": "point" }));
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = json!(1);
    assert_eq!(fault(&file), "nodes[0].extensions.KHR_lights_punctual: there is no light 1");
}

#[test]
fn the_first_camera_of_the_scene() {
    let mut file = File::new();
    file.push("cameras", json!({ "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 2 } }));
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }));
    // Half a turn about y: it looks along +z.
    file.node(json!({ "children": [1], "translation": [0, 0, 5], "rotation": [0, 1, 0, 0], "scale": [2, 2, 2] }));
    file.push("nodes", json!({ "camera": 1, "translation": [1, 1, 0] }));
    file.node(json!({ "camera": 0 }));
    let model = read(&file);
    let camera = model.scene.camera.unwrap();
    assert_near(camera.position, DVec3::new(-2.0, 2.0, 5.0));
    assert_near(camera.look_at - camera.position, DVec3::Z);
    assert_near(camera.up, DVec3::Y);
    assert_eq!(camera.projection, Projection::FieldOfView { degrees: 1.0_f64.to_degrees() });
    assert_eq!(model.warnings, ["only the first camera is used (nodes[2])"]);

    file.json["nodes"][1]["camera"] = json!(0);
    assert_eq!(read(&file).scene.camera.unwrap().projection, Projection::Orthographic { height: 4.0 });
    file.json["nodes"][1]["camera"] = json!(1);
    file.json["cameras"][1]["perspective"]["yfov"] = json!(0);
    assert!(fault(&file).starts_with("cameras[1].perspective: yfov must be between 0 and π"));
}

#[test]
fn extensions_that_are_needed_but_unknown_are_refused() {
    let mut file = File::new();
    file.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression", "KHR_materials_ior"]);
    file.json["extensionsRequired"] = json!(["KHR_materials_ior", "KHR_draco_mesh_compression"]);
    let fault = try_read(&file.text()).unwrap_err();
    assert_eq!(fault.message, "extensionsRequired[1]: the file needs KHR_draco_mesh_compression, which cannot be read");
    assert!(fault.help.unwrap().contains("without compression first, for example with `gltf-transform`"));
    for name in ["EXT_meshopt_compression", "KHR_texture_basisu", "EXT_something"] {
        file.json["extensionsRequired"] = json!([name]);
        assert!(try_read(&file.text()).unwrap_err().message.contains(name));
    }
}

#[test]
fn extensions_that_are_not_needed_are_warned_of() {
    let mut file = File::new();
    let names: Vec<String> = (0..100).map(|at| format!("EXT_{}", at % 50)).collect();
    file.json["extensionsUsed"] = json!(names);
    let warnings = read(&file).warnings;
    assert_eq!(warnings.len(), 9);
    assert_eq!(warnings[0], "the extension EXT_0 is not read (extensionsUsed)");
    assert!(warnings[8].starts_with("the file uses more extensions"));
    file.json["extensionsUsed"] = json!(["KHR_materials_variants", "KHR_lights_punctual"]);
    assert!(read(&file).warnings.is_empty());
}

#[test]
fn versions() {
    let with = |asset: Value| {
        let mut file = File::new();
        file.json["asset"] = asset;
        try_read(&file.text()).map(|_| ()).map_err(|fault| fault.message)
    };
    assert_eq!(with(json!({ "version": "2.0" })), Ok(()));
    assert_eq!(with(json!({ "version": "2.1", "minVersion": "2.0" })), Ok(()));
    assert_eq!(with(json!({ "version": "1.0" })), Err("asset: this is glTF 1.0; only 2.0 can be read".to_owned()));
    assert_eq!(with(json!({ "version": "20" })), Err("asset: this is glTF 20; only 2.0 can be read".to_owned()));
    assert_eq!(with(json!({})), Err("this is JSON, but not glTF: it has no version".to_owned()));
    assert_eq!(with(json!(null)), Err("this is JSON, but not glTF: it has no version".to_owned()));
    assert_eq!(with(json!(7)), Err("asset: this must be a JSON object".to_owned()));
}

/// Files in memory, by their names.
struct Folder(Vec<(&'static str, Vec<u8>)>);

impl Assets for Folder {
    fn read(&self, relative: &str, max_bytes: u64) -> Result<Vec<u8>, AssetError> {
        let (_, bytes) = self.0.iter().find(|(name, _)| *name == relative).ok_or(AssetError::NotFound)?;
        if bytes.len() as u64 > max_bytes { Err(AssetError::TooLarge(bytes.len() as u64)) } else { Ok(bytes.clone()) }
    }
}

#[test]
fn buffers_and_images_lie_beside_the_file() {
    let mut file = File::new();
    let image = file.push("images", json!({ "uri": "my%20texture.png" }));
    let texture = file.push("textures", json!({ "source": image }));
    file.show_triangle(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    file.json["buffers"] = json!([{ "byteLength": file.data.len(), "uri": "data/a.bin" }]);
    let picture = super::build::png(1, &[[9, 9, 9, 255]]);
    let folder = Folder(vec![("models/data/a.bin", file.data.clone()), ("models/my texture.png", picture)]);
    let limits = Limits::default();
    let model = super::super::read("models/a.gltf", &file.text(), &folder, &limits).unwrap();
    assert_eq!(model.scene.images[0].file, "models/my texture.png");
    assert_eq!(model.scene.objects.len(), 1);

    let message = |folder, limits: &Limits| {
        super::super::read("models/a.gltf", &file.text(), &folder, limits).unwrap_err().message
    };
    let cut = Folder(vec![("models/data/a.bin", file.data[1..].to_vec())]);
    let (length, rest) = (file.data.len(), file.data.len() - 1);
    assert_eq!(
        message(Folder(Vec::new()), &limits),
        "images[0]: cannot read `models/my texture.png`: there is no such file"
    );
    file.json["materials"] = json!([{}]);
    let message = |folder, limits: &Limits| {
        super::super::read("models/a.gltf", &file.text(), &folder, limits).unwrap_err().message
    };
    assert_eq!(message(cut, &limits), format!("buffers[0]: it should have {length} bytes, but has only {rest}"));
    let small = Limits { max_file_bytes: 10, ..limits };
    let whole = Folder(vec![("models/data/a.bin", file.data.clone())]);
    assert!(message(whole, &small).contains("too many"));
}

#[test]
fn one_file_cannot_be_read_without_end() {
    // Each buffer is within the limit, but not all of them together.
    let mut file = File::new();
    for at in 0..10 {
        file.push("buffers", json!({ "byteLength": 36, "uri": "a.bin" }));
        let view = file.push("bufferViews", json!({ "buffer": at, "byteLength": 36 }));
        let accessor = json!({ "bufferView": view, "componentType": 5126, "count": 3, "type": "VEC3" });
        let positions = file.push("accessors", accessor);
        file.show(json!({ "attributes": { "POSITION": positions } }));
    }
    let folder = Folder(vec![("a.bin", [[0; 4], [0, 0, 128, 63], [0, 0, 0, 64]].concat().repeat(3))]);
    let read = |max_total_bytes| {
        let limits = Limits { max_total_bytes, ..Limits::default() };
        super::super::read("a.gltf", &file.text(), &folder, &limits).map(|_| ()).map_err(|fault| fault.message)
    };
    assert_eq!(read(360), Ok(()));
    assert!(read(359).unwrap_err().starts_with("buffers[9]: cannot read `a.bin`"));
}
