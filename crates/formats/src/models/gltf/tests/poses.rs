//! Nodes, morph targets and skins.

use super::build::{File, U8};
use super::{assert_near, fault, first_corners, only_mesh, read};
use durer_math::DVec3;
use serde_json::{Value, json};

/// A triangle whose first corner is (1, 0, 0).
const TRIANGLE: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A file with this triangle as meshes[0], without nodes.
fn triangle() -> File {
    let mut file = File::new();
    let positions = file.floats(&TRIANGLE);
    file.push("meshes", json!({ "primitives": [{ "attributes": { "POSITION": positions } }] }));
    file
}

#[test]
fn transforms_nest() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let mut file = triangle();
    // A quarter turn about y takes +x to -z.
    file.node(json!({ "translation": [10, 0, 0], "rotation": [0, half, 0, half], "children": [1, 2] }));
    file.push("nodes", json!({ "scale": [2, 1, 1], "translation": [0, 5, 0], "mesh": 0 }));
    file.push("nodes", json!({ "children": [3] }));
    // Column by column: x to y, y to -x, moved by (0, 0, 7).
    let matrix = json!([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1]);
    file.push("nodes", json!({ "matrix": matrix, "mesh": 0 }));
    let corners = first_corners(&read(&file));
    assert_eq!(corners.len(), 2);
    // (1, 0, 0) → (2, 5, 0) → (0, 5, -2) → (10, 5, -2).
    assert_near(corners[0], DVec3::new(10.0, 5.0, -2.0));
    // (1, 0, 0) → (0, 1, 7) → (7, 1, 0) → (17, 1, 0).
    assert_near(corners[1], DVec3::new(17.0, 1.0, 0.0));
}

#[test]
fn the_scene_is_the_default_one_or_the_first_or_all_roots() {
    let shown = |change: &dyn Fn(&mut Value)| {
        let mut file = triangle();
        for at in 0..3 {
            file.push("nodes", json!({ "mesh": 0, "translation": [at, 0, 0] }));
        }
        file.push("nodes", json!({ "children": [2] }));
        file.json["scenes"] = json!([{ "nodes": [0] }, { "nodes": [1, 3] }]);
        change(&mut file.json);
        first_corners(&read(&file)).iter().map(|corner| corner.x).collect::<Vec<_>>()
    };
    assert_eq!(shown(&|json| json["scene"] = json!(1)), [2.0, 3.0]);
    assert_eq!(shown(&|json| json["scene"] = json!(null)), [1.0]);
    assert_eq!(shown(&|json| json["scenes"] = json!([{ "nodes": [1, 1] }])), [2.0], "no node twice");
    let without = |json: &mut Value| {
        json.as_object_mut().unwrap().remove("scene");
        json.as_object_mut().unwrap().remove("scenes");
    };
    assert_eq!(shown(&without), [1.0, 2.0, 3.0]);
}

#[test]
fn flattened_nodes_are_left_out() {
    let mut file = triangle();
    file.node(json!({ "mesh": 0, "scale": [0, 0, 0], "children": [1] }));
    file.push("nodes", json!({ "mesh": 0 }));
    file.node(json!({ "mesh": 0 }));
    let model = read(&file);
    assert_eq!(first_corners(&model), [DVec3::X]);
    assert_eq!(model.warnings, ["nodes that are scaled to nothing, or flat, are left out (nodes[0] and 1 more)"]);
}

#[test]
fn graphs_that_are_no_trees_are_refused() {
    let with = |nodes: Value| {
        let mut file = triangle();
        file.json["nodes"] = nodes;
        file.json["scenes"][0]["nodes"] = json!([0]);
        fault(&file)
    };
    let cycle = json!([{}, { "children": [2] }, { "children": [1] }]);
    assert_eq!(with(cycle), "nodes[1]: this node is its own ancestor, or below one that is");
    assert_eq!(with(json!([{ "children": [0] }])), "nodes[0]: this node is its own ancestor, or below one that is");
    let shared = json!([{ "children": [2] }, { "children": [2] }, {}]);
    assert_eq!(with(shared), "nodes[1].children[0]: nodes[2] is already a child of nodes[0]");
    assert_eq!(with(json!([{ "children": [5] }])), "nodes[0].children[0]: there is no nodes[5]");
    assert_eq!(with(json!([])), "scenes[0].nodes[0]: there is no nodes[0]");
    assert_eq!(with(json!([{ "mesh": 3 }])), "nodes[0].mesh: there is no meshes[3]");
    let rotation = json!([{ "rotation": [0, 0, 0, 0] }]);
    assert_eq!(with(rotation), "nodes[0].rotation: a rotation must be a quaternion of length 1");
    assert_eq!(with(json!([{ "scale": [1, "2", 3] }])), "nodes[0].scale[1]: this must be a number");
    let far = json!([{ "scale": [1e300, 1, 1], "children": [1] }, { "scale": [1e300, 1, 1], "mesh": 0 }]);
    assert_eq!(with(far), "nodes[1]: its transform, with those above it, stretches or moves too much");
}

#[test]
fn morph_targets_have_the_weights_of_the_mesh_or_the_node() {
    let mut file = triangle();
    let up = file.floats(&[[0.0, 1.0, 0.0]; 3]);
    let out = file.floats(&[[0.0, 0.0, 4.0]; 3]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": up }, { "POSITION": out }]);
    file.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    file.node(json!({ "mesh": 0 }));
    file.node(json!({ "mesh": 0, "weights": [0, -1] }));
    let corners = first_corners(&read(&file));
    assert_eq!(corners, [DVec3::new(1.0, 0.5, 1.0), DVec3::new(1.0, 0.0, -4.0)]);
    file.json["accessors"][up]["count"] = json!(2);
    assert_eq!(fault(&file), format!("accessors[{up}]: it has 2 elements, but there are 3 positions"));
}

#[test]
fn morph_targets_turn_normals() {
    let mut file = triangle();
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 3]);
    let turn = file.floats(&[[1.0, 0.0, -1.0]; 3]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "NORMAL": turn }]);
    file.json["meshes"][0]["weights"] = json!([1]);
    file.node(json!({ "mesh": 0 }));
    let model = read(&file);
    assert_eq!(only_mesh(&model).normals, [[1.0, 0.0, 0.0]; 3]);
    assert_eq!(only_mesh(&model).positions, TRIANGLE);
}

/// The triangle on two joints: its first corner on the first, its second on the second, its third halfway on both.
fn skinned() -> File {
    let mut file = triangle();
    let joints = file.accessor("VEC4", U8, 3, &[0, 9, 9, 9, 1, 9, 9, 9, 0, 1, 9, 9]);
    let weights = file.floats(&[[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]]);
    let attributes = &mut file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    let move_back = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0];
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let bound = file.floats(&[identity, move_back]);
    file.push("skins", json!({ "joints": [1, 2], "inverseBindMatrices": bound }));
    // What the mesh's own node says counts for nothing.
    file.node(json!({ "mesh": 0, "skin": 0, "translation": [100, 100, 100] }));
    file.node(json!({ "translation": [0, 0, 1], "children": [2] }));
    // Half a turn about x: y to -y, z to -z.
    file.push("nodes", json!({ "rotation": [1, 0, 0, 0], "translation": [0, 1, 0] }));
    file
}

#[test]
fn skins_bend_to_where_their_joints_are() {
    let model = read(&skinned());
    let mesh = only_mesh(&model);
    assert!(model.scene.objects[0].transform.steps.is_empty());
    let position = |vertex: usize| DVec3::from(mesh.positions[vertex].map(f64::from));
    // On the first joint, moved by z: (1, 0, 1).
    assert_near(position(0), DVec3::new(1.0, 0.0, 1.0));
    // (0, 1, 0), bound back to (0, 0, 0), turned to (0, 0, 0), moved to (0, 1, 0) and to (0, 1, 1).
    assert_near(position(1), DVec3::new(0.0, 1.0, 1.0));
    // (0, 0, 1): by the first (0, 0, 2); by the second (0, -1, 1), (0, 1, -1), (0, 2, -1), (0, 2, 0); the mean of them.
    assert_near(position(2), DVec3::new(0.0, 1.0, 1.0));
}

#[test]
fn skins_without_joints_to_hang_on_are_warned_of() {
    let mut file = triangle();
    file.push("skins", json!({ "joints": [0] }));
    file.node(json!({ "mesh": 0, "skin": 0 }));
    let model = read(&file);
    assert_eq!(only_mesh(&model).positions, TRIANGLE);
    assert!(model.warnings[0].contains("does not hang on its joints"), "{:?}", model.warnings);
}

#[test]
fn mirrored_skins_keep_their_outside() {
    let mut file = skinned();
    let normals = file.floats(&[[0.0, 1.0, 1.0]; 3]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    file.json["nodes"][1]["scale"] = json!([-2, 1, 1]);
    let model = read(&file);
    let mesh = only_mesh(&model);
    assert_eq!(mesh.triangles, [[0, 2, 1]]);
    let normal = DVec3::from(mesh.normals[0].map(f64::from)).normalize();
    assert_near(normal, DVec3::new(0.0, 1.0, 1.0).normalize());
}

#[test]
fn skins_that_lie_are_refused() {
    let with = |change: &dyn Fn(&mut Value)| {
        let mut file = skinned();
        change(&mut file.json);
        fault(&file)
    };
    let few = |json: &mut Value| json["skins"][0]["joints"] = json!([1]);
    assert_eq!(with(&few), "accessors[1]: vertex 1 hangs on joint 1, but skins[0] has only 1");
    let many = |json: &mut Value| json["skins"][0]["joints"] = json!([1, 2, 0]);
    assert_eq!(with(&many), "accessors[3]: it has 2 matrices for 3 joints");
    let missing = |json: &mut Value| json["skins"][0]["joints"] = json!([1, 7]);
    assert_eq!(with(&missing), "skins[0].joints[1]: there is no nodes[7]");
    let no_skin = |json: &mut Value| json["nodes"][0]["skin"] = json!(1);
    assert_eq!(with(&no_skin), "nodes[0].skin: there is no skins[1]");
}
