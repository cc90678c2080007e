//! Files made to harm, and thousands of files with small mistakes: an answer, soon, and never a panic.

use super::build::{File, U8};
use super::{read, try_read};
use crate::models::FilePlace;
use serde_json::{Value, json};

#[track_caller]
fn refused_because(text: &[u8], why: &str) {
    let fault = try_read(text).expect_err("must be refused");
    assert!(fault.message.contains(why), "{}", fault.message);
    assert!(fault.message.len() < 500);
}

#[test]
fn depth_does_no_harm() {
    refused_because(&[b'['; 1_000_000], "recursion limit");
    refused_because(&b"{\"a\":".repeat(1_000_000), "recursion limit");
    let mut nodes: Vec<Value> = (1..100_000).map(|at| json!({ "children": [at] })).collect();
    nodes.push(json!({ "translation": [1, 2, 3] }));
    let mut file = File::new();
    file.json["nodes"] = json!(nodes);
    file.json["scenes"][0]["nodes"] = json!([0]);
    assert!(read(&file).scene.objects.is_empty());
    nodes[99_999] = json!({ "children": [0] });
    file.json["nodes"] = json!(nodes);
    refused_because(&file.text(), "its own ancestor");
}

#[test]
fn what_is_not_there_is_not_made() {
    // A mesh that is all zeros, of a hundred million vertices and more.
    let zeros = |count: u64| {
        let mut file = File::new();
        let positions = json!({ "componentType": 5126, "count": count, "type": "VEC3" });
        let positions = file.push("accessors", positions);
        file.show(json!({ "attributes": { "POSITION": positions } }));
        file
    };
    refused_because(&zeros(100_000_000).text(), "unfolds to much more");
    refused_because(&zeros(100_000_001).text(), "without data are too many");
    // Few corners of so many vertices are no harm.
    let mut file = zeros(100_000_000);
    let indices = file.accessor("SCALAR", U8, 3, &[0, 1, 2]);
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert_eq!(read(&file).scene.objects.len(), 1);
}

#[test]
fn the_same_data_cannot_be_unfolded_without_end() {
    // A thousand meshes of a hundred thousand triangles each, all different, from one buffer.
    let mut file = File::new();
    let positions = file.accessor("VEC3", 5126, 200, &[0; 2400]);
    let indices: Vec<u8> = (0..300_000_u32).map(|at| (at % 199) as u8).collect();
    let indices = file.view(&indices);
    for offset in 0..1000 {
        let accessor = json!({ "bufferView": indices, "byteOffset": offset, "componentType": U8,
            "count": 299_000, "type": "SCALAR" });
        let indices = file.push("accessors", accessor);
        file.show(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
    }
    refused_because(&file.binary(), "unfolds to much more");

    // A mesh of a thousand primitives, shown by ten thousand nodes.
    let mut file = File::new();
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let primitives = vec![json!({ "attributes": { "POSITION": positions } }); 1000];
    file.push("meshes", json!({ "primitives": primitives }));
    for _ in 0..10_000 {
        file.node(json!({ "mesh": 0 }));
    }
    refused_because(&file.text(), "unfolds to much more");

    // A mesh of many primitives under as many skins.
    let mut file = File::new();
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let primitives = vec![json!({ "attributes": { "POSITION": positions }, "mode": 1 }); 10_000];
    file.push("meshes", json!({ "primitives": primitives }));
    for skin in 0..10_000 {
        file.push("skins", json!({ "joints": [] }));
        file.node(json!({ "mesh": 0, "skin": skin }));
    }
    refused_because(&file.text(), "unfolds to much more");

    // A long name for everything.
    let mut file = File::new();
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let primitives = vec![json!({ "attributes": { "POSITION": positions } }); 100];
    file.push("meshes", json!({ "primitives": primitives, "name": "name".repeat(1_000_000) }));
    for _ in 0..1000 {
        file.node(json!({ "mesh": 0 }));
    }
    let scene = try_read(&file.text()).map(|model| model.scene);
    assert!(scene.is_ok_and(|scene| scene.objects[0].name.as_ref().is_some_and(|name| name.len() == 200)));

    // Morph targets by the hundred thousand, all of one accessor.
    let mut file = File::new();
    let positions = file.accessor("VEC3", 5126, 100_000, &vec![0; 1_200_000]);
    let targets = vec![json!({ "POSITION": positions }); 100_000];
    file.show(json!({ "attributes": { "POSITION": positions }, "targets": targets }));
    file.json["meshes"][0]["weights"] = json!(vec![1; 100_000]);
    refused_because(&file.text(), "unfolds to much more");
}

#[test]
fn triangles_are_limited() {
    let mut file = File::new();
    let positions = file.accessor("VEC3", 5126, 5, &[0; 60]);
    file.show(json!({ "attributes": { "POSITION": positions }, "mode": 5 }));
    let read = |max_primitives| {
        let limits = crate::Limits { max_primitives, ..Default::default() };
        super::super::read("a.gltf", &file.text(), &crate::NoAssets, &limits).map(|_| ())
    };
    assert!(read(3).is_ok() && read(2).unwrap_err().message.contains("more triangles than are allowed"));
}

#[test]
fn pictures_are_limited() {
    let mut file = File::new();
    let texture = file.texture(4, &[[255; 4]; 16]);
    let textures = json!({ "baseColorTexture": { "index": texture } });
    file.show_triangle(json!({ "pbrMetallicRoughness": textures }));
    let read = |max_texture_bytes| {
        let limits = crate::Limits { max_texture_bytes, ..Default::default() };
        super::super::read("a.gltf", &file.text(), &crate::NoAssets, &limits).map(|_| ())
    };
    assert!(read(64).is_ok() && read(63).unwrap_err().message.starts_with("images[0]: 4 × 4 pixels"));
}

#[test]
fn text_that_is_not_json_is_placed() {
    let place = |text: &[u8]| try_read(text).unwrap_err().place;
    assert_eq!(place(b"{\n\"asset\": nothing}"), Some(FilePlace::Line(2)));
    assert_eq!(place(b""), Some(FilePlace::Line(1)));
    assert_eq!(place(b"o cube\nv 1 2 3\n"), Some(FilePlace::Line(1)));
    assert_eq!(place(b"{\"a\": \"\xff\"}"), Some(FilePlace::Line(1)));
    let mut binary = File::new().binary();
    binary[20] = b'!';
    assert_eq!(place(&binary), Some(FilePlace::Byte(20)));
}

/// A file with something of everything.
fn everything() -> File {
    let mut file = File::new();
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]]);
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 4]);
    let uvs = file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    let colors = file.accessor("VEC4", U8, 4, &[200; 16]);
    let indices = file.indices(&[0, 1, 2, 3]);
    let joints = file.accessor("VEC4", U8, 4, &[0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1]);
    let weights = file.floats(&[[0.5, 0.5, 0.0, 0.0]; 4]);
    let (patch, values) = (file.view(&[1, 3]), file.view(&[0; 24]));
    let moved = json!({ "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
        "count": 2,
        "indices": { "bufferView": patch, "componentType": U8 },
        "values": { "bufferView": values },
    }});
    let moved = file.push("accessors", moved);
    let texture = file.texture(2, &[[255, 0, 0, 255], [0, 255, 0, 100], [9, 9, 9, 9], [255; 4]]);
    let texture_use = json!({ "index": texture, "texCoord": 0, "extensions": {
        "KHR_texture_transform": { "offset": [0.5, 0.25], "rotation": 0.5, "scale": [2, 2] },
    }});
    file.push("samplers", json!({ "magFilter": 9729, "wrapS": 33648, "wrapT": 33648 }));
    file.json["textures"][texture]["sampler"] = json!(0);
    file.push("materials", json!({
        "name": "glass",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.75, 1, 0.5],
            "baseColorTexture": texture_use,
            "metallicFactor": 0.25,
            "roughnessFactor": 0.5,
            "metallicRoughnessTexture": { "index": texture },
        },
        "emissiveFactor": [0.5, 0.5, 0.5],
        "emissiveTexture": { "index": texture },
        "normalTexture": { "index": texture },
        "alphaMode": "MASK",
        "alphaCutoff": 0.25,
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 0.5 },
            "KHR_materials_ior": { "ior": 1.25 },
            "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0] },
            "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [1, 0.5, 1] },
            "KHR_materials_emissive_strength": { "emissiveStrength": 4 },
        },
    }));
    file.push(
        "materials",
        json!({ "alphaMode": "BLEND", "extensions": {
            "KHR_materials_pbrSpecularGlossiness": { "diffuseFactor": [1, 1, 1, 0.5], "glossinessFactor": 0.5 },
        }}),
    );
    file.push("materials", json!({ "extensions": { "KHR_materials_unlit": {} } }));
    let attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs, "COLOR_0": colors,
        "JOINTS_0": joints, "WEIGHTS_0": weights });
    let mut primitives = Vec::new();
    for (mode, material) in [(4, 1), (5, 0), (6, 2)] {
        primitives.push(json!({ "attributes": attributes, "indices": indices, "mode": mode, "material": material,
            "targets": [{ "POSITION": moved }, { "NORMAL": normals }] }));
    }
    let mesh = file.push("meshes", json!({ "name": "mesh", "weights": [0.5, 0.25], "primitives": primitives }));
    file.push("skins", json!({ "joints": [2, 3] }));
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.75, "znear": 0.5 } }));
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual", "EXT_other"]);
    let lights = json!([{ "type": "spot", "spot": { "innerConeAngle": 0.25 }, "intensity": 5, "color": [1, 1, 0.5] }]);
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    file.node(json!({ "mesh": mesh, "skin": 0, "name": "skinned" }));
    file.node(json!({ "mesh": mesh, "translation": [1, 2, 3], "scale": [2, 1, 1], "children": [2, 3] }));
    let light = json!({ "KHR_lights_punctual": { "light": 0 } });
    file.push("nodes", json!({ "rotation": [0, 1, 0, 0], "camera": 0, "extensions": light }));
    let matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1];
    file.push("nodes", json!({ "matrix": matrix, "mesh": mesh, "weights": [1, 0] }));
    file.push("animations", json!({}));
    file
}

#[test]
fn everything_at_once() {
    let model = read(&everything());
    assert_eq!(super::meshes(&model.scene.objects).len(), 9);
    assert_eq!((model.scene.materials.len(), model.scene.lights.len()), (3, 1));
    assert!(model.scene.camera.is_some());
}

#[test]
fn every_cut_is_refused() {
    let file = everything();
    for bytes in [file.text(), file.binary()] {
        for end in 0..bytes.len() {
            assert!(try_read(&bytes[..end]).is_err(), "cut after {end} bytes");
        }
    }
}

/// Numbers that look random, the same in every run (xorshift).
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }
}

/// Changes bytes here and there, most of them in the JSON.
fn scatter(bytes: &mut [u8], chance: &mut Chance) {
    for _ in 0..1 + chance.below(6) {
        let at = chance.below(bytes.len());
        bytes[at] = match chance.below(3) {
            0 => chance.below(256) as u8,
            1 => b"0123456789-.eE\"[]{},:"[chance.below(21)],
            _ => bytes[at] ^ (1 << chance.below(8)),
        };
    }
}

#[test]
fn scattered_mistakes_do_no_harm() {
    let file = everything();
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15);
    for bytes in [file.text(), file.binary()] {
        let mut read = 0;
        for _ in 0..3000 {
            let mut bytes = bytes.clone();
            scatter(&mut bytes, &mut chance);
            if let Ok(model) = try_read(&bytes) {
                read += 1;
                assert_eq!(model.scene.check().err(), None);
            }
        }
        assert!(read > 0, "some mistakes are not noticed");
    }
}

/// All numbers in a value.
fn numbers<'a>(value: &'a mut Value, all: &mut Vec<&'a mut Value>) {
    match value {
        Value::Number(_) => all.push(value),
        Value::Array(list) => list.iter_mut().for_each(|value| numbers(value, all)),
        Value::Object(fields) => fields.values_mut().for_each(|value| numbers(value, all)),
        _ => {}
    }
}

#[test]
fn wrong_values_do_no_harm() {
    let values = [
        json!(0),
        json!(1),
        json!(2),
        json!(3),
        json!(5),
        json!(100),
        json!(-1),
        json!(0.5),
        json!(1e300),
        json!(1e-300),
        json!(4_294_967_296_u64),
        json!(9_007_199_254_740_992_u64),
        json!(99_999_999),
        json!(null),
        json!("text"),
        json!([]),
        json!({}),
        json!(true),
        json!(5121),
        json!(5126),
    ];
    let file = everything();
    let mut chance = Chance(0x2545_f491_4f6c_dd1d);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..6000 {
        let mut file = file.clone();
        let mut all = Vec::new();
        numbers(&mut file.json, &mut all);
        for _ in 0..1 + chance.below(3) {
            let at = chance.below(all.len());
            *all[at] = values[chance.below(values.len())].clone();
        }
        match try_read(&file.binary()) {
            Ok(model) => {
                good += 1;
                assert_eq!(model.scene.check().err(), None);
            }
            Err(fault) => {
                bad += 1;
                assert!(fault.message.contains(['[', ':']), "{}: where?", fault.message);
            }
        }
    }
    assert!(good > 500 && bad > 500, "{good} {bad}");
}
