//! Vertices and triangles.

use super::build::{F32, File, I8, I16, U8, U16, U32};
use super::{fault, meshes, only_mesh, read};
use durer_math::Rgb;
use durer_scene::MeshData;
use serde_json::json;

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

/// The positions of all corners of all triangles.
fn corners(mesh: &MeshData) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize])).collect()
}

/// The z component of a triangle's cross product: positive if it faces +z.
fn facing([a, b, c]: [[f32; 3]; 3]) -> f32 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[test]
fn indices_of_every_width() {
    for (component, bytes) in
        [(U8, vec![2, 1, 3]), (U16, vec![2, 0, 1, 0, 3, 0]), (U32, vec![2, 0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0])]
    {
        let mut file = File::new();
        let positions = file.floats(&SQUARE);
        let indices = file.accessor("SCALAR", component, 3, &bytes);
        file.show(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
        let model = read(&file);
        assert_eq!(corners(only_mesh(&model)), [[SQUARE[2], SQUARE[1], SQUARE[3]]]);
        assert_eq!(only_mesh(&model).positions.len(), 3, "what no triangle uses is dropped");
    }
}

#[test]
fn strips_and_fans_face_one_way() {
    let around = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for (mode, positions) in [(5, SQUARE), (6, around)] {
        let mut file = File::new();
        let positions = file.floats(&positions);
        file.show(json!({ "attributes": { "POSITION": positions }, "mode": mode }));
        let model = read(&file);
        let triangles = corners(only_mesh(&model));
        assert_eq!(triangles.len(), 2);
        assert!(triangles.into_iter().all(|triangle| facing(triangle) == 1.0), "mode {mode}");
    }
}

#[test]
fn triangles_with_equal_corners_are_dropped() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    // Two strips, joined as is usual.
    let indices = file.indices(&[0, 1, 2, 2, 3, 3, 1, 2]);
    file.show(json!({ "attributes": { "POSITION": positions }, "indices": indices, "mode": 5 }));
    let model = read(&file);
    assert_eq!(only_mesh(&model).triangles.len(), 2);
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    for mode in 0..4 {
        file.show(json!({ "attributes": { "POSITION": positions }, "mode": mode }));
    }
    let model = read(&file);
    assert!(model.scene.objects.is_empty());
    assert_eq!(model.warnings, ["points and lines are left out (meshes[0].primitives[0] and 3 more)"]);
}

#[test]
fn interleaved_vertices_are_read_by_their_stride() {
    let mut file = File::new();
    let vertices: [[f32; 8]; 3] = [
        [0.0, 0.0, 5.0, 0.0, 0.0, 1.0, 0.0, 1.0],
        [1.0, 0.0, 5.0, 0.0, 1.0, 0.0, 1.0, 1.0],
        [0.0, 1.0, 5.0, 1.0, 0.0, 0.0, 0.0, 0.25],
    ];
    let bytes: Vec<u8> = vertices.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    let view = file.view(&bytes);
    file.json["bufferViews"][view]["byteStride"] = json!(32);
    let mut accessor = |kind, offset| {
        let accessor =
            json!({ "bufferView": view, "byteOffset": offset, "componentType": F32, "count": 3, "type": kind });
        file.push("accessors", accessor)
    };
    let (positions, normals, uvs) = (accessor("VEC3", 0), accessor("VEC3", 12), accessor("VEC2", 24));
    file.show(json!({ "attributes": { "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs } }));
    let model = read(&file);
    let mesh = only_mesh(&model);
    assert_eq!(mesh.positions, [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    assert_eq!(mesh.uvs, [[0.0, 0.0], [1.0, 0.0], [0.0, 0.75]], "v grows upwards");
}

#[test]
fn sparse_accessors_patch_what_is_there_or_zeros() {
    for with_base in [true, false] {
        let mut file = File::new();
        let base = [[9.0, 9.0, 9.0], [1.0, 0.0, 0.0], [9.0, 9.0, 9.0]];
        let positions = file.floats(&base);
        if !with_base {
            file.json["accessors"][positions].as_object_mut().unwrap().remove("bufferView");
        }
        let indices = file.view(&[0, 2]);
        let values: Vec<u8> = [0.0_f32, 2.0, 0.0, 3.0, 3.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let values = file.view(&values);
        file.json["accessors"][positions]["sparse"] = json!({
            "count": 2,
            "indices": { "bufferView": indices, "componentType": U8 },
            "values": { "bufferView": values },
        });
        file.show(json!({ "attributes": { "POSITION": positions } }));
        let model = read(&file);
        let middle = if with_base { [1.0, 0.0, 0.0] } else { [0.0; 3] };
        assert_eq!(only_mesh(&model).positions, [[0.0, 2.0, 0.0], middle, [3.0, 3.0, 0.0]]);
    }
}

#[test]
fn whole_numbers_stand_for_fractions() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE[..3]);
    let bytes = [255, 0, 51, 255, 0, 102, 0, 255, 255, 255, 255, 0];
    let colors = file.accessor("VEC4", U8, 3, &bytes);
    file.json["accessors"][colors]["normalized"] = json!(true);
    let uvs: Vec<u8> = [0_u16, 65535, 65535, 0, 13107, 26214].iter().flat_map(|x| x.to_le_bytes()).collect();
    let uvs = file.accessor("VEC2", U16, 3, &uvs);
    file.json["accessors"][uvs]["normalized"] = json!(true);
    file.show(json!({ "attributes": { "POSITION": positions, "COLOR_0": colors, "TEXCOORD_0": uvs } }));
    let model = read(&file);
    let mesh = only_mesh(&model);
    assert_eq!(mesh.colors, [Rgb::new(1.0, 0.0, 0.2), Rgb::new(0.0, 0.4, 0.0), Rgb::WHITE]);
    assert_eq!(mesh.uvs[..2], [[0.0, 0.0], [1.0, 1.0]]);
    assert!((mesh.uvs[2][0] - 0.2).abs() < 1e-7 && (mesh.uvs[2][1] - 0.6).abs() < 1e-7);
}

/// KHR_mesh_quantization.
#[test]
fn positions_may_be_whole_numbers() {
    let mut file = File::new();
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    let positions: Vec<u8> =
        [0_i16, 0, 0, 0, 100, 0, 0, 0, 0, -100, 0, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = file.view(&positions);
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    let positions =
        file.push("accessors", json!({ "bufferView": view, "componentType": I16, "count": 3, "type": "VEC3" }));
    let view = file.view(&[127, 0, 0, 0, 0, 129, 0, 0, 0, 0, 128, 0]);
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    let normals = json!({ "bufferView": view, "componentType": I8, "count": 3, "type": "VEC3", "normalized": true });
    let normals = file.push("accessors", normals);
    file.show(json!({ "attributes": { "POSITION": positions, "NORMAL": normals } }));
    let model = read(&file);
    assert_eq!(only_mesh(&model).positions, [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, -100.0, 0.0]]);
    assert_eq!(only_mesh(&model).normals, [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
}

#[test]
fn vertex_colors_are_multiplied_by_the_base_color_unless_a_texture_does_that() {
    for with_texture in [false, true] {
        let mut file = File::new();
        let positions = file.floats(&SQUARE[..3]);
        let colors = file.floats(&[[1.0, 0.5, 0.25], [1.0, 1.0, 1.0], [7.0, -1.0, f32::NAN]]);
        let mut pbr = json!({ "baseColorFactor": [0.5, 0.5, 1.0, 1.0] });
        if with_texture {
            let texture = file.texture(1, &[[255; 4]]);
            pbr["baseColorTexture"] = json!({ "index": texture });
        }
        let material = file.push("materials", json!({ "pbrMetallicRoughness": pbr }));
        file.show(json!({ "attributes": { "POSITION": positions, "COLOR_0": colors }, "material": material }));
        let tint = if with_texture { Rgb::WHITE } else { Rgb::new(0.5, 0.5, 1.0) };
        let expected = [Rgb::new(1.0, 0.5, 0.25), Rgb::WHITE, Rgb::new(1.0, 0.0, 1.0)];
        assert_eq!(only_mesh(&read(&file)).colors, expected.map(|color| color * tint));
    }
}

#[test]
fn the_alpha_of_vertex_colors_is_warned_of() {
    for (mode, warnings) in [("OPAQUE", 0), ("BLEND", 1)] {
        let mut file = File::new();
        file.show_triangle(json!({ "alphaMode": mode }));
        let colors = file.accessor("VEC4", U8, 3, &[128; 12]);
        file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        assert_eq!(read(&file).warnings.len(), warnings);
    }
}

#[test]
fn meshes_of_several_nodes_and_equal_primitives_share_their_data() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let primitive = |material| json!({ "attributes": { "POSITION": positions }, "mode": 5, "material": material });
    let (red, blue) = (file.push("materials", json!({})), file.push("materials", json!({})));
    let both = file.push("meshes", json!({ "name": "both", "primitives": [primitive(red), primitive(blue)] }));
    for at in 0..2 {
        file.node(json!({ "mesh": both, "translation": [at, 0, 0], "name": format!("node {at}") }));
    }
    let model = read(&file);
    assert_eq!(model.scene.objects.len(), 2);
    let all = meshes(&model.scene.objects);
    assert_eq!(all.len(), 4, "a group of two for each node");
    assert!(all.iter().all(|(_, _, data)| std::ptr::eq(*data, all[0].2)));
    assert_ne!(all[0].1.material, all[1].1.material);
    assert_eq!(model.scene.objects[1].name.as_deref(), Some("node 1"));
    assert!(all.iter().all(|(_, object, _)| object.name.as_deref() == Some("both")));
}

#[test]
fn what_is_wrong_is_named() {
    let with = |positions: &[[f32; 3]], change: &dyn Fn(&mut File)| {
        let mut file = File::new();
        let positions = file.floats(positions);
        let indices = file.indices(&[0, 1, 2]);
        file.show(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
        change(&mut file);
        fault(&file)
    };
    let nothing = |_: &mut File| {};
    let nan = [[0.0; 3], [0.0, f32::NAN, 0.0], [1.0; 3]];
    assert_eq!(with(&nan, &nothing), "accessors[0]: the position of vertex 1 is not finite");
    let infinite = [[0.0; 3], [0.0; 3], [f32::INFINITY, 0.0, 0.0]];
    assert_eq!(with(&infinite, &nothing), "accessors[0]: the position of vertex 2 is not finite");
    let far = [[0.0; 3], [0.0; 3], [2e12, 0.0, 0.0]];
    assert_eq!(with(&far, &nothing), "accessors[0]: the position of vertex 2 is too far away");
    assert_eq!(with(&SQUARE[..2], &nothing), "accessors[1]: index 2 is 2, but there are only 2 vertices");
    type Change<'a> = (&'a str, &'a dyn Fn(&mut File));
    let changes: [Change<'_>; 17] = [
        ("accessors[0]: its 5 elements reach beyond bufferViews[0], which has 48 bytes", &|file| {
            file.json["accessors"][0]["count"] = json!(5);
        }),
        ("accessors[0]: its 4 elements reach beyond bufferViews[0], which has 48 bytes", &|file| {
            file.json["accessors"][0]["byteOffset"] = json!(4);
        }),
        ("accessors[0]: its 9007199254740992 elements reach beyond", &|file| {
            file.json["accessors"][0]["count"] = json!(9_007_199_254_740_992_u64);
        }),
        ("accessors[0]: its 4 elements reach beyond", &|file| {
            file.json["accessors"][0]["byteOffset"] = json!(9_007_199_254_740_992_u64);
        }),
        ("bufferViews[0]: 48 bytes from 9007199254740992 on reach beyond buffers[0], which has 54", &|file| {
            file.json["bufferViews"][0]["byteOffset"] = json!(9_007_199_254_740_992_u64);
        }),
        ("bufferViews[0]: 9007199254740992 bytes from 0 on reach beyond", &|file| {
            file.json["bufferViews"][0]["byteLength"] = json!(9_007_199_254_740_992_u64);
        }),
        ("bufferViews[0].buffer: there is no buffers[7]", &|file| {
            file.json["bufferViews"][0]["buffer"] = json!(7);
        }),
        ("bufferViews[0]: a byteStride of 8 is too small for elements of 12 bytes", &|file| {
            file.json["bufferViews"][0]["byteStride"] = json!(8);
        }),
        ("accessors[0].bufferView: there is no bufferViews[2]", &|file| {
            file.json["accessors"][0]["bufferView"] = json!(2);
        }),
        ("accessors[0]: there is no component type 5124", &|file| {
            file.json["accessors"][0]["componentType"] = json!(5124);
        }),
        ("accessors[0]: its type or componentType is not one that POSITION may have", &|file| {
            file.json["accessors"][0]["type"] = json!("VEC2");
        }),
        ("accessors[0]: its type is none that can be read", &|file| {
            file.json["accessors"][0]["type"] = json!("MAT3");
        }),
        ("accessors[0].count: this must be a whole number, 0 or more", &|file| {
            file.json["accessors"][0]["count"] = json!(-1);
        }),
        ("accessors[0]: `count` is missing", &|file| {
            file.json["accessors"][0]["count"] = json!(null);
        }),
        ("meshes[0].primitives[0].attributes.POSITION: there is no accessors[9]", &|file| {
            file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9);
        }),
        ("accessors[1]: it has 3 elements, but there are 4 positions", &|file| {
            file.json["meshes"][0]["primitives"][0]["indices"] = json!(null);
            file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1);
            file.json["accessors"][1]["componentType"] = json!(I8);
            file.json["accessors"][1]["type"] = json!("VEC3");
            file.json["bufferViews"][1]["byteLength"] = json!(9);
            file.json["bufferViews"][1]["byteOffset"] = json!(0);
        }),
        ("meshes[0].primitives[0]: there is no mode 7", &|file| {
            file.json["meshes"][0]["primitives"][0]["mode"] = json!(7);
        }),
    ];
    for (message, change) in changes {
        let found = with(&SQUARE, change);
        assert!(found.starts_with(message), "{found}\n  instead of\n{message}");
    }
}

#[test]
fn sparse_accessors_that_lie_are_refused() {
    let with = |sparse: serde_json::Value| {
        let mut file = File::new();
        let positions = file.floats(&SQUARE);
        let bytes = [&[3, 1, 9, 0][..], &[0; 48]].concat();
        let view = file.view(&bytes);
        file.json["bufferViews"][view]["byteLength"] = json!(28);
        file.json["accessors"][positions]["sparse"] = sparse;
        file.show(json!({ "attributes": { "POSITION": positions } }));
        fault(&file)
    };
    let sparse = |count: u64, offset: u64, component: u32| {
        json!({
            "count": count,
            "indices": { "bufferView": 1, "byteOffset": offset, "componentType": component },
            "values": { "bufferView": 1, "byteOffset": 4 },
        })
    };
    assert_eq!(with(sparse(2, 0, U8)), "accessors[0].sparse.indices: the indices must ascend, but entry 1 is 1");
    assert_eq!(with(sparse(2, 1, U8)), "accessors[0].sparse.indices: entry 1 is 9, beyond the 4 elements");
    assert!(with(sparse(3, 0, U8)).starts_with("accessors[0].sparse.values: its 3 elements reach beyond"));
    assert!(with(sparse(2, 28, U16)).starts_with("accessors[0].sparse.indices: its 2 elements reach beyond"));
    assert!(with(sparse(2, 0, F32)).contains("not one that indices may have"));
    assert_eq!(with(json!({ "count": 1 })), "accessors[0].sparse: `indices` is missing");
}

#[test]
fn texture_coordinates_that_are_no_place_become_one() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE[..3]);
    let uvs = file.floats(&[[0.5, f32::NAN], [0.5, -1e6], [3.0, -2.0]]);
    file.show(json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs } }));
    assert_eq!(only_mesh(&read(&file)).uvs, [[0.0, 1.0], [0.0, 1.0], [3.0, 3.0]]);
}
