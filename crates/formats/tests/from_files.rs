//! Meshes, imports, particles and instances from files: what comes out, that each file is read once, and that what is
//! written of them reads back the same.

use durer_formats::{AssetError, Assets, Limits, load_str, to_yaml};
use durer_math::{DVec3, Rgb};
use durer_scene::*;
use std::cell::RefCell;
use std::sync::Arc;

/// Files in memory, and how they were asked for.
struct Files {
    files: Vec<(&'static str, Vec<u8>)>,
    asked: RefCell<Vec<String>>,
}

impl Assets for Files {
    fn read(&self, name: &str, _: u64) -> Result<Vec<u8>, AssetError> {
        self.asked.borrow_mut().push(name.to_owned());
        let file = self.files.iter().find(|(known, _)| *known == name);
        file.map(|(_, bytes)| bytes.clone()).ok_or(AssetError::NotFound)
    }
}

const TRIANGLE: &str = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

/// A triangle, red and turned by its node, a lamp, and a camera.
fn room() -> Vec<u8> {
    let text = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5}]}},
        "nodes": [{"mesh": 0, "translation": [1, 2, 3]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 4, 0]},
            {"camera": 0, "translation": [0, 0, 9]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "buffers": [{"byteLength": 36, "uri": "TRIANGLE"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}]}"#;
    text.replace("TRIANGLE", TRIANGLE).into_bytes()
}

fn files() -> Files {
    let one = |name, text: &str| (name, text.as_bytes().to_vec());
    let files = vec![
        one(
            "flag.obj",
            "mtllib flag.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n",
        ),
        one("flag.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n"),
        one("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("room.gltf", room()),
        one("run.csv", "step,x,y,z,r\n# started\n1,0,0,0,0.5\n2,1,2,3,0.25\n"),
        one(
            "cloud.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
            property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n1 2 3 255 0 0\n",
        ),
        one("bonds.txt", "0 0 0 0 0 1 0.1\n0 0 0 0 1 0 0.2\n"),
        one("salt.xyz", "2\n\nNa 0 0 0\nCl 2.8 0 0\n"),
    ];
    Files { files, asked: RefCell::default() }
}

#[track_caller]
fn read(text: &str) -> Scene {
    load(text, &files())
}

#[track_caller]
fn load(text: &str, files: &Files) -> Scene {
    match load_str(text, "scene.yaml", files, &Limits::default()) {
        Ok(loaded) => loaded.scene.into_scene(),
        Err(diagnostics) => panic!("{diagnostics}\n{text}"),
    }
}

/// The scene, after making sure that writing and reading it changes nothing, numbers of materials included.
#[track_caller]
fn kept(text: &str) -> Scene {
    let scene = read(text);
    let written = to_yaml(&scene);
    assert_eq!(read(&written), scene, "{written}");
    scene
}

fn particles(scene: &Scene, at: usize) -> &Particles {
    match &scene.objects[at].kind {
        ObjectKind::Particles(particles) => particles,
        other => panic!("{}", other.word()),
    }
}

fn mesh(object: &Object) -> &Mesh {
    match &object.kind {
        ObjectKind::Mesh(mesh) => mesh,
        other => panic!("{}", other.word()),
    }
}

#[test]
fn each_file_is_read_once() {
    let files = files();
    let text = "objects:
      - mesh: {file: flag.obj}
      - mesh: {file: flag.obj, normals: smooth}
      - import: {file: flag.obj}
      - import: {file: room.gltf}
      - group: {objects: [import: {file: room.gltf}]}
      - spheres: {file: run.csv}
      - spheres: {centers: run.csv, radius: {file: run.csv, columns: [1]}}
      - instances: {objects: [sphere], positions: run.csv}
      - cylinders: {file: bonds.txt}";
    load(text, &files);
    let mut asked = files.asked.take();
    asked.sort();
    assert_eq!(asked, ["bonds.txt", "flag.mtl", "flag.obj", "room.gltf", "run.csv"]);
}

#[test]
fn objects_share_the_mesh_of_a_file() {
    let scene = kept(
        "objects:
          - mesh: {file: bare.obj}
          - mesh: {file: bare.obj, normals: smooth}
          - group: {objects: [mesh: {file: bare.obj, normals: smooth}, mesh: {file: bare.obj, normals: flat}]}",
    );
    let ObjectKind::Group(members) = &scene.objects[2].kind else { panic!() };
    let [file, smooth, again, flat] =
        [&scene.objects[0], &scene.objects[1], &members[0], &members[1]].map(|object| &mesh(object).data);
    assert!(Arc::ptr_eq(smooth, again) && Arc::ptr_eq(file, flat) && !Arc::ptr_eq(file, smooth));
    assert_eq!((file.normals.len(), &smooth.normals[..]), (0, &[[0.0, 0.0, 1.0]; 3][..]));
}

#[test]
fn materials_of_models_come_without_names_and_are_not_written() {
    let text = "materials: {gold: {color: gold}}
objects:
  - sphere: {material: {color: white}}
  - mesh: {file: flag.obj}
  - sphere: {material: {color: black}}
  - mesh: {file: flag.obj, material: gold}
  - import: {file: flag.obj}";
    let scene = kept(text);
    let colors: Vec<Paint> = scene.materials.iter().map(|material| material.as_classic().unwrap().color).collect();
    let expected = [colors[0], Paint::Color(Rgb::WHITE), red(), blue(), Paint::Color(Rgb::BLACK)];
    assert_eq!(colors, expected);
    let parts: Vec<_> = mesh(&scene.objects[1]).data.parts.iter().map(|part| part.material).collect();
    assert_eq!(parts, [Some(MaterialId(2)), Some(MaterialId(3))]);
    assert_eq!(scene.objects[3].material, Some(MaterialId(0)));
    let written = to_yaml(&scene);
    assert_eq!(written.matches("color").count(), 3, "only those of the scene are written\n{written}");
}

fn red() -> Paint {
    Paint::Color(Rgb::new(1.0, 0.0, 0.0))
}

fn blue() -> Paint {
    Paint::Color(Rgb::new(0.0, 0.0, 1.0))
}

#[test]
fn an_import_brings_objects_lights_and_a_camera() {
    let scene = kept("objects: [import: {file: room.gltf, name: room, transform: [scale: 2]}]");
    let ObjectKind::Import(import) = &scene.objects[0].kind else { panic!() };
    assert_eq!((import.objects.is_empty(), import.lights.len(), import.camera.is_some()), (false, 1, true));
    assert!(scene.camera.is_none(), "it is for the renderer to choose");
    assert_eq!(scene.lights, [], "lights of a model take the place of the default lights");
    assert_eq!(scene.materials.len(), 1);
    assert!(!to_yaml(&scene).contains("lights"));
}

#[test]
fn lights_in_instances_are_said_not_to_shine() {
    let text =
        "objects:\n  - instances: {positions: [[0, 0, 0]], objects: [group: {objects: [import: {file: room.gltf}]}]}";
    let loaded = load_str(text, "test.yaml", &files(), &Limits::default()).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(loaded.scene.scene().lights, Light::default_lights(), "without them all would be dark");
    let warnings = loaded.warnings.to_string();
    assert!(warnings.contains("brings a light, which will not shine"), "{warnings}");
}

#[test]
fn lights_of_the_scene_stand_beside_those_of_models() {
    let import = "objects: [group: {objects: [import: {file: room.gltf}]}]";
    assert_eq!(kept(import).lights, []);
    assert_eq!(kept(&format!("{import}\nlights: []")).lights, []);
    assert_eq!(kept(&format!("{import}\nlights: [point: {{position: [0, 1, 0]}}]")).lights.len(), 1);
    assert_eq!(kept("objects: [import: {file: bare.obj}]").lights, Light::default_lights());
    let default = Scene { lights: Light::default_lights(), ..read(import) };
    assert_eq!(read(&to_yaml(&default)), default, "the default lights beside others must be written");
}

#[test]
fn columns_are_found_by_their_names() {
    let scene = kept(
        "objects:
          - spheres: {file: run.csv}
          - spheres: {centers: {file: run.csv, columns: [y, Z, 1]}, radius: run.csv}
          - spheres: {file: run.csv, radius: 3}
          - spheres: {file: run.csv, radius: {file: run.csv, columns: [step]}}",
    );
    let ParticleKind::Spheres { centers, radii } = &particles(&scene, 0).kind else { panic!() };
    assert_eq!(*centers.values, [DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)]);
    assert_eq!((radii.get(0), radii.get(1)), (0.5, 0.25));
    let ParticleKind::Spheres { centers, radii } = &particles(&scene, 1).kind else { panic!() };
    assert_eq!((centers.values[1], radii.get(1)), (DVec3::new(2.0, 3.0, 2.0), 0.25));
    let ParticleKind::Spheres { radii, .. } = &particles(&scene, 2).kind else { panic!() };
    assert_eq!(*radii, Sizes::Same(3.0));
    let ParticleKind::Spheres { radii, .. } = &particles(&scene, 3).kind else { panic!() };
    assert_eq!(radii.get(1), 2.0);
}

#[test]
fn columns_without_names_are_found_by_their_places() {
    let scene = kept("objects: [cylinders: {file: bonds.txt}, capsules: {file: bonds.txt, radius: 1}]");
    let ParticleKind::Cylinders { bases, tops, radii, open } = &particles(&scene, 0).kind else { panic!() };
    assert_eq!((bases.values[1], tops.values[1], radii.get(1), *open), (DVec3::ZERO, DVec3::Y, 0.2, false));
    let ParticleKind::Capsules { tops, radii, .. } = &particles(&scene, 1).kind else { panic!() };
    assert_eq!((tops.values[0], radii), (DVec3::Z, &Sizes::Same(1.0)));
}

#[test]
fn atoms_look_like_their_elements_unless_told_otherwise() {
    let scene = kept(
        "objects:
          - spheres: {file: salt.xyz}
          - spheres: {file: salt.xyz, radius: 0.5, colors: none}
          - spheres: {file: salt.xyz, colors: [red, white]}",
    );
    let salt = particles(&scene, 0);
    let ParticleKind::Spheres { centers, radii } = &salt.kind else { panic!() };
    assert_eq!((centers.values[1], radii.get(0), radii.get(1)), (DVec3::X * 2.8, 1.66, 1.02));
    let colors = salt.colors.as_ref().unwrap();
    let green = durer_imaging::linear_from_srgb(0xf0 as f32 / 255.0);
    assert_eq!(colors.values[1].g, green, "chlorine is #1ff01f");
    assert_eq!(particles(&scene, 1).colors, None);
    assert_eq!(particles(&scene, 2).colors.as_ref().unwrap().values[1], Rgb::WHITE);
}

#[test]
fn points_of_a_ply_file_have_colors() {
    let scene = kept("objects: [spheres: {file: cloud.ply, radius: 0.1}]");
    let cloud = particles(&scene, 0);
    assert_eq!(*cloud.colors.as_ref().unwrap().values, [Rgb::new(1.0, 0.0, 0.0)]);
}

#[test]
fn instances_take_their_places_from_files() {
    let text = "materials: {a: {}, b: {}}
objects:
  - instances:
      objects: [mesh: {file: flag.obj}, sphere: {material: a}]
      positions: run.csv
      rotations: [[0, 90, 0], [0, 0, 0]]
      scale: {file: run.csv, columns: [r]}
      materials: [b, a, {color: red}]";
    let scene = kept(text);
    let ObjectKind::Instances(copies) = &scene.objects[0].kind else { panic!() };
    assert_eq!((copies.positions.values.len(), copies.scales.get(1)), (2, 0.25));
    assert_eq!(copies.materials, [MaterialId(1), MaterialId(0), MaterialId(4)]);
}

#[test]
fn meshes_far_from_zero_keep_their_shape() {
    let text = |x: f64| {
        format!(
            "objects: [mesh: {{vertices: [[{x}, 0, 0], [{}, 0, 0], [{x}, 0.1, 0]], triangles: [[0, 1, 2]]}}]",
            x + 0.1
        )
    };
    let near = kept(&text(0.5));
    assert_eq!(mesh(&near.objects[0]).data.origin, DVec3::ZERO);
    assert_eq!(mesh(&near.objects[0]).data.positions[1], [0.6, 0.0, 0.0]);
    let far = kept(&text(1e7));
    let MeshData { origin, positions, .. } = &*mesh(&far.objects[0]).data;
    for (vertex, expected) in positions.iter().zip([1e7, 1e7 + 0.1, 1e7]) {
        assert!((origin.x + f64::from(vertex[0]) - expected).abs() < 1e-8, "{origin} {vertex:?}");
    }
}

#[test]
fn warnings_of_files_stand_where_they_are_named() {
    let files = Files {
        files: vec![
            ("many.xyz", b"1\n\nQq 0 0 0\n1\n\nO 0 0 0\n".to_vec()),
            ("thin.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl nowhere\nf 3 2 1\n".to_vec()),
        ],
        asked: RefCell::default(),
    };
    let text = "objects:\n  - spheres: {file: many.xyz}\n  - mesh: {file: thin.obj}\n";
    let warnings = load_str(text, "scene.yaml", &files, &Limits::default()).unwrap().warnings.list;
    let lines: Vec<(usize, usize)> = warnings.iter().map(|warning| (warning.line, warning.column)).collect();
    assert_eq!(lines, [(2, 21), (2, 21), (3, 18)], "{warnings:?}");
    assert!(warnings.iter().all(|warning| warning.message.starts_with('`')), "{warnings:?}");
}

/// A PNG of one pixel of half coverage, #102030.
const CLEAR: &[u8] =
    b"\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x01\x00\x00\x00\x01\x08\
    \x06\x00\x00\x00\x1f\x15\xc4\x89\x00\x00\x00\x0d\x49\x44\x41\x54\x78\xda\x63\x10\x50\x30\x68\x00\x00\
    \x01\x85\x00\xe1\x3d\x9a\x31\x26\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82";

#[test]
fn alpha_that_nobody_uses_is_warned_of() {
    let files = Files { files: vec![("clear.png", CLEAR.to_vec())], asked: RefCell::default() };
    let warnings = |textures: &str| {
        let text = format!("textures: {{{textures}}}\nobjects: [sphere]");
        load_str(&text, "scene.yaml", &files, &Limits::default()).unwrap().warnings.list
    };
    let color = "a: {image: {file: clear.png}}";
    let alpha = "b: {image: {file: clear.png, channels: alpha}}";
    let found = warnings(color);
    assert_eq!(found.len(), 1);
    assert!(found[0].message.contains("transparent parts") && found[0].help.as_ref().unwrap().contains("opacity"));
    assert_eq!(warnings(&format!("{color}, {alpha}")), []);
    assert_eq!(warnings(alpha), []);
    let scene = load(&format!("textures: {{{alpha}}}\nobjects: [sphere]"), &files);
    assert_eq!(scene.images[0].bitmap.alpha, Some(durer_imaging::Alpha::U8(vec![128])));
}

#[test]
fn what_is_taken_from_a_table_is_shared() {
    let scene = read(
        "objects: [spheres: {file: run.csv}, spheres: {centers: run.csv}, spheres: {colors: none, file: run.csv}]",
    );
    let centers = |at| match &particles(&scene, at).kind {
        ParticleKind::Spheres { centers, .. } => &centers.values,
        _ => panic!(),
    };
    assert!(Arc::ptr_eq(centers(0), centers(1)) && Arc::ptr_eq(centers(0), centers(2)));
}

#[test]
fn imports_do_not_unfold_without_end() {
    let nodes: Vec<String> = (0..40).map(|x| format!("{{\"mesh\": 0, \"translation\": [{x}, 0, 0]}}")).collect();
    let numbers: Vec<String> = (0..40).map(|node| node.to_string()).collect();
    let forest = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 36, "uri": "{TRIANGLE}"}}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}}]}}"#,
        numbers.join(","),
        nodes.join(",")
    );
    let files = Files { files: vec![("forest.gltf", forest.into_bytes())], asked: RefCell::default() };
    let limits = Limits { max_values: 600, ..Limits::default() };
    let load = |times: usize| {
        let text = format!("objects: [{}]", "import: {file: forest.gltf}, ".repeat(times));
        load_str(&text, "scene.yaml", &files, &limits)
    };
    if let Err(diagnostics) = load(2) {
        panic!("{diagnostics}");
    }
    let refused = load(20).unwrap_err();
    assert_eq!(refused.list.len(), 1, "{refused}");
    assert!(refused.list[0].message.contains("more than 600 objects"), "{refused}");
}
