//! Model files in place of scene files: what `durer render model.ply` shows, and what it says of wrong ones.

use durer_formats::{Diagnostics, Limits, LoadOptions, Loaded, NoAssets, Severity, load_bytes, load_file};
use durer_scene::{LightKind, MeshData, Object, ObjectKind, Paint, Scene};
use std::path::Path;

const PICTURE: &[u8] = b"PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0";
const TRIANGLE: &str = "mtllib parts/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n";
const LIBRARY: &str = "newmtl wood\nKd 0.5 0.5 0.5\nmap_Kd textures\\wood.pfm\n";

fn write(folder: &Path, files: &[(&str, &[u8])]) {
    for (name, bytes) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
}

fn load(path: &Path) -> Result<Loaded, Diagnostics> {
    load_file(path, &LoadOptions::default())
}

fn from_bytes(name: &str, bytes: &[u8]) -> Result<Loaded, Diagnostics> {
    load_bytes(bytes, name, &NoAssets, &Limits::default())
}

/// The mesh in the group that is the model.
fn mesh(scene: &Scene) -> &MeshData {
    let Object { kind: ObjectKind::Group(members), .. } = &scene.objects[0] else { panic!("a group") };
    let ObjectKind::Mesh(mesh) = &members[0].kind else { panic!("a mesh") };
    &mesh.data
}

#[test]
fn a_model_in_which_nothing_is_gets_one_warning() {
    let empty = br#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{}]}"#;
    let warnings = from_bytes("a.gltf", empty).unwrap().warnings;
    let messages: Vec<&str> = warnings.list.iter().map(|one| one.message.as_str()).collect();
    assert_eq!(messages, ["in a.gltf: there is nothing to see in this model"]);
}

#[test]
fn a_model_becomes_a_scene_with_all_that_lies_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let files: [(&str, &[u8]); 3] =
        [("a.OBJ", TRIANGLE.as_bytes()), ("parts/a.mtl", LIBRARY.as_bytes()), ("textures/wood.pfm", PICTURE)];
    write(folder.path(), &files);
    let loaded = load(&folder.path().join("a.OBJ")).unwrap();
    assert!(loaded.warnings.is_empty(), "{}", loaded.warnings);
    let scene = loaded.scene.scene();
    let part = &mesh(scene).parts[0];
    let material = &scene.materials[part.material.unwrap().0 as usize];
    assert!(matches!(material.as_classic().unwrap().color, Paint::Texture(_)));
    assert_eq!((scene.images.len(), scene.images[0].file.as_str()), (1, "textures/wood.pfm"));
    assert!(scene.camera.is_some() && scene.objects.len() == 2);
    assert!(scene.lights.iter().all(|light| matches!(light.kind, LightKind::Directional { .. })));
}

#[test]
fn what_is_missing_beside_it_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[("a.obj", TRIANGLE.as_bytes())]);
    let loaded = load(&folder.path().join("a.obj")).unwrap();
    let messages: Vec<&str> = loaded.warnings.list.iter().map(|one| one.message.as_str()).collect();
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].starts_with("in a.obj: cannot read the materials `parts/a.mtl`: there is no such file"));
    assert!(messages[0].ends_with("its materials became the default one"));
    assert!(loaded.warnings.list.iter().all(|one| one.severity == Severity::Warning && one.file.ends_with("a.obj")));
}

#[test]
fn a_byte_order_mark_before_a_text_does_not_matter() {
    let folder = tempfile::tempdir().unwrap();
    let corners = "0 0 0\n1 0 0\n0 1 0\n";
    let ply = format!(
        "\u{feff}ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n{corners}3 0 1 2\n"
    );
    let vertices = corners.lines().map(|corner| format!("vertex {corner}\n")).collect::<String>();
    let stl = format!("\u{feff}solid a\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid a\n");
    write(folder.path(), &[("a.ply", ply.as_bytes()), ("a.stl", stl.as_bytes())]);
    for name in ["a.ply", "a.stl"] {
        let loaded = load(&folder.path().join(name)).unwrap();
        assert!(loaded.warnings.list.is_empty(), "{}", loaded.warnings);
    }
}

#[test]
fn files_outside_are_not_read() {
    let outer = tempfile::tempdir().unwrap();
    write(outer.path(), &[("in/a.obj", TRIANGLE.replace("parts/", "../").as_bytes()), ("a.mtl", LIBRARY.as_bytes())]);
    let loaded = load(&outer.path().join("in/a.obj")).unwrap();
    assert!(loaded.warnings.list[0].message.contains("outside the scene's folder"), "{}", loaded.warnings);
    assert_eq!(loaded.scene.scene().materials.len(), 2, "those of the stage");
}

#[test]
fn wrong_lines_are_shown() {
    let wrong = from_bytes("dir/a.obj", b"v 0 0 0\nv 1 0 0\n  f 1 2 7 # wrong\nv 0 0 1\n").unwrap_err();
    let one = &wrong.list[0];
    assert_eq!((one.line, one.file.as_str()), (3, "dir/a.obj"));
    assert!(one.message.contains("in a.obj, vertex 7 does not exist"), "{wrong}");
    assert!(wrong.to_string().contains("f 1 2 7 # wrong"), "{wrong}");
    let header = from_bytes("a.ply", b"ply\r\nformat ascii 1.0\r\nelement vertex many\r\n").unwrap_err();
    assert!(header.list[0].line == 3 && header.to_string().contains("element vertex many"), "{header}");
}

#[test]
fn wrong_bytes_are_told() {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                      property float z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
        .to_vec();
    let header = bytes.len();
    bytes.extend([0_u8; 36]);
    bytes.extend([3, 0, 1, 3]);
    let message = from_bytes("bunny.ply", &bytes).unwrap_err().to_string();
    let expected = format!("in bunny.ply, at byte {}: face 0 has a vertex 3", header + 36);
    assert!(message.contains(&expected), "{message}");
}

#[test]
fn files_that_cannot_be_read_are_said_so() {
    let folder = tempfile::tempdir().unwrap();
    assert!(load(&folder.path().join("a.stl")).unwrap_err().to_string().contains("cannot read this file"));
    std::fs::create_dir(folder.path().join("b.stl")).unwrap();
    assert!(load(&folder.path().join("b.stl")).unwrap_err().to_string().contains("not a file"));
    write(folder.path(), &[("c.stl", &[0; 1000]), ("d.stl", b"")]);
    let limits = Limits { max_file_bytes: 999, ..Limits::default() };
    let options = LoadOptions { limits, ..LoadOptions::default() };
    let large = load_file(folder.path().join("c.stl"), &options).unwrap_err().to_string();
    assert!(large.contains("1000 bytes of files, but only 999 bytes") && large.contains("--limits file="), "{large}");
    assert!(load(&folder.path().join("d.stl")).unwrap_err().to_string().contains("this file is empty"));
}

#[test]
fn models_of_any_size_make_scenes_that_can_be_rendered() {
    for scale in ["e-30", "e-9", "", "e7", "e11"] {
        for shift in ["0", "1e11", "-987654321.25"] {
            let text = format!("v {shift} 0{scale} 0\nv 1{scale} {shift} 0\nv 0 1{scale} {shift}\nf 1 2 3\n");
            if let Err(problems) = from_bytes("a.obj", text.as_bytes()) {
                panic!("{problems}\n{text}");
            }
        }
    }
    // A triangle that is nothing but a point.
    assert!(from_bytes("a.obj", b"v 3 3 3\nf 1 1 1\n").is_ok());
}
