use super::super::testing::{Files, area, assert_survives, dodecahedron, error, mesh, mesh_of, model, volume};
use super::*;
use crate::NoAssets;
use durer_math::functions::{cos, sin};
use durer_scene::{MeshData, Paint};

fn written() -> String {
    let body = dodecahedron();
    let places: String = body.corners.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
    let face = |face: &[usize; 5]| format!("f {}\n", face.map(|at| (at + 1).to_string()).join(" "));
    places + &body.faces.iter().map(face).collect::<String>()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(text: &str) -> MeshData {
    mesh("a.obj", text.as_bytes())
}

#[test]
fn a_dodecahedron_is_read() {
    let body = dodecahedron();
    let mesh = read(&written());
    assert_eq!((mesh.positions.len(), mesh.triangles.len(), mesh.parts.len()), (20, 36, 0));
    assert!((area(&mesh) - body.area).abs() < 1e-6 && (volume(&mesh) - body.volume).abs() < 1e-6);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.colors.is_empty());
}

#[test]
fn lines_may_look_in_many_ways() {
    let expected = read(&written());
    let text = written();
    let odd = [
        text.replace('\n', "\r\n"),
        format!("\u{feff}# a comment \\\n{text}"),
        text.replace(' ', " \t ").replace('\n', "  # so\n\n"),
        text.replace(' ', " \\\n "),
        text.replace(' ', " \\\r\n"),
        text.trim_end().to_owned(),
    ];
    for odd in odd {
        assert_eq!(read(&odd), expected, "{odd}");
    }
}

#[test]
fn corners_name_places_texture_coordinates_and_normals() {
    let lists = format!("{SQUARE}vt 0 0\nvt 1 0\nvt .5\nvn 0 0 1\nvn 0 0 3\n");
    let plain = read(&format!("{lists}f 1 2 3\n"));
    assert!(plain.uvs.is_empty() && plain.normals.is_empty());
    let uvs = read(&format!("{lists}f 1/1 2/2 3/3\n"));
    assert_eq!((uvs.uvs, uvs.normals.len()), (vec![[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]], 0));
    let normals = read(&format!("{lists}f 1//1 2//2 3//1\n"));
    assert_eq!((normals.normals, normals.uvs.len()), (vec![[0.0, 0.0, 1.0], [0.0, 0.0, 3.0], [0.0, 0.0, 1.0]], 0));
    let both = read(&format!("{lists}f 1/1/1 2/2/1 3/3/1\n"));
    assert_eq!((both.uvs.len(), both.normals.len()), (3, 3));
}

#[test]
fn corners_that_differ_in_anything_are_vertices_of_their_own() {
    let mesh = read(&format!("{SQUARE}vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\nf 4/1 3/2 1/1\nf 3/2 1/1 3/1\n"));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 4], [4, 3, 0], [3, 0, 2]]);
    assert_eq!((mesh.positions.len(), mesh.positions[2], mesh.positions[3]), (5, [1.0, 1.0, 0.0], [1.0, 1.0, 0.0]));
}

#[test]
fn negative_numbers_count_backwards() {
    let expected = read(&format!("{SQUARE}vt 0 0\nvt 1 0\nvn 0 0 1\nf 2/1/1 3/2/1 4/1/1\n"));
    assert_eq!(read(&format!("{SQUARE}vt 0 0\nvt 1 0\nvn 0 0 1\nf -3/-2/-1 -2/-1/-1 -1/-2/-1\nv 9 9 9\n")), expected);
}

#[test]
fn concave_faces_are_cut_well() {
    // A gear, tilted; the shoelace formula knows its area.
    let flat: Vec<[f64; 2]> = (0..48)
        .map(|i| {
            let (angle, radius) = (f64::from(i) * std::f64::consts::TAU / 48.0, if i / 2 % 2 == 0 { 1.0 } else { 2.0 });
            [radius * cos(angle), radius * sin(angle)]
        })
        .collect();
    let shoelace: f64 = (0..48).map(|i| flat[i][0] * flat[(i + 1) % 48][1] - flat[(i + 1) % 48][0] * flat[i][1]).sum();
    let places: String = flat.iter().map(|[x, y]| format!("v {} {} {}\n", 0.6 * x, y, 0.8 * x)).collect();
    let corners: String = (1..=48).map(|i| format!(" {i}")).collect();
    let mesh = read(&format!("{places}f{corners}\n"));
    assert_eq!(mesh.triangles.len(), 46);
    assert!((area(&mesh) - 0.5 * shoelace).abs() < 1e-6);
    let one_way = |triangle: &[u32; 3]| {
        let [a, b, c] = super::super::testing::corners(&mesh, *triangle);
        (b - a).cross(c - a).dot(DVec3::new(-0.8, 0.0, 0.6)) > -1e-9
    };
    assert!(mesh.triangles.iter().all(one_way));
}

#[test]
fn colors_of_vertices_are_those_of_screens() {
    let colored = |colors: [&str; 3]| {
        let [a, b, c] = colors;
        read(&format!("v 0 0 0 {a}\nv 1 0 0 {b}\nv 0 1 0 {c}\nf 1 2 3\n")).colors
    };
    let half = linear_from_srgb(0.5);
    assert_eq!(colored(["1 0 0.5"; 3]), [Rgb::new(1.0, 0.0, half); 3]);
    let bytes = colored(["255 0 51 128"; 3])[1];
    assert!((bytes - Rgb::new(1.0, 0.0, linear_from_srgb(0.2))).map(f32::abs).max_component() < 1e-6);
    assert_eq!(colored(["", "0 0 0", ""]), [Rgb::WHITE, Rgb::BLACK, Rgb::WHITE]);
    assert_eq!(colored(["1", "1", "0.5"]), [], "a weight is no color");
}

#[test]
fn meshes_far_away_keep_their_digits() {
    let text = "v 4000000.1 5000000.1 0.25\nv 4000000.4 5000000.1 0.25\nv 4000000.1 5000000.5 0.25\nf 1 2 3\n";
    let mesh = read(text);
    assert!(mesh.origin.x > 3.9e6 && (area(&mesh) - 0.06).abs() < 1e-7, "{}", area(&mesh));
}

#[test]
fn objects_groups_and_materials_are_parts() {
    let library = b"newmtl red\nKd 1 0 0\nnewmtl unused\nKd 0 0 1\nnewmtl green\nKd 0 1 0\n";
    let text = format!(
        "mtllib a.mtl\n{SQUARE}f 1 2 3\no body\nusemtl green\nf 1 2 3\nf 1 3 4\ng lid\nusemtl red\nusemtl red\nf 1 2 4\n\
         usemtl none\nf 2 3 4\nusemtl green\n"
    );
    let model = model("dir/a.obj", text.as_bytes(), &Files(&[("dir/a.mtl", library)]));
    assert_eq!(model.warnings, ["there is no material `none`; it became the default one"]);
    let part = |name: &str, first, count, material: Option<u32>| MeshPart {
        name: Some(name.to_owned()),
        first,
        count,
        material: material.map(MaterialId),
    };
    assert_eq!(
        mesh_of(&model).parts,
        [part("body", 1, 2, Some(0)), part("lid", 3, 1, Some(1)), part("lid", 4, 1, None)]
    );
    let colors: Vec<Paint> =
        model.scene.materials.iter().map(|material| material.as_classic().unwrap().color).collect();
    assert_eq!(colors, [Paint::Color(Rgb::new(0.0, 1.0, 0.0)), Paint::Color(Rgb::new(1.0, 0.0, 0.0))]);
}

#[test]
fn libraries_may_come_late_be_many_and_have_blanks_in_their_names() {
    let files: [(&str, &[u8]); 3] =
        [("my things.mtl", b"newmtl a\n"), ("one.mtl", b"newmtl b\n"), ("two.mtl", b"newmtl c\n")];
    for libraries in
        ["mtllib my things.mtl\nmtllib one.mtl two.mtl", "mtllib C:\\work\\my things.mtl\nmtllib one.mtl two.mtl"]
    {
        let text = format!("{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\n{libraries}\n");
        let model = model("a.obj", text.as_bytes(), &Files(&files));
        assert_eq!((model.warnings.len(), model.scene.materials.len()), (0, 3), "{:?}", model.warnings);
    }
}

#[test]
fn what_is_missing_or_unknown_gives_one_warning_each() {
    let text = format!(
        "mtllib a.mtl\n{SQUARE}usemtl x\nf 1 2 3\nl 1 2\np 1\nl 3 4\ncurv 0 1 1 2\nend\nfoo\nfoo\nf 1 2\ns off\n"
    );
    let others = ["points and lines", "free-form", "`foo`", "fewer"];
    // Without the library that its materials are missing follows.
    for (files, first, last) in [
        (&[][..], Some("cannot read the materials `a.mtl`"), None),
        (&[("a.mtl", &b"newmtl y\n"[..])], None, Some("`x`")),
    ] {
        let model = model("a.obj", text.as_bytes(), &Files(files));
        let expected: Vec<&str> = first.into_iter().chain(others).chain(last).collect();
        assert_eq!(model.warnings.len(), expected.len(), "{:?}", model.warnings);
        for (warning, expected) in model.warnings.iter().zip(expected) {
            assert!(warning.contains(expected), "{warning}");
        }
        assert_eq!(mesh_of(&model).parts, []);
    }
}

#[test]
fn faces_without_normals_stay_flat_among_faces_with() {
    let roof = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nvn 1 1 0\n";
    let mesh = read(&format!("{roof}f 1//1 2//1 3//1\nf 1 2 3\nf 2 1 4\n"));
    assert_eq!(mesh.normals.len(), 9);
    let normals = |at: usize| mesh.triangles[at].map(|vertex| mesh.normals[vertex as usize]);
    assert_eq!(normals(0), [[1.0, 1.0, 0.0]; 3]);
    assert_eq!(normals(1), [[0.0, 1.0, 0.0]; 3]);
    assert_eq!(normals(2), [[1.0, 0.0, 0.0]; 3]);
}

#[test]
fn wrong_files_say_what_and_where() {
    let cases = [
        (format!("{SQUARE}f 1 2 5\n"), 5, "vertex 5 does not exist: 4 come before"),
        (format!("{SQUARE}f 1 2 \\\n 0\n"), 5, "vertex 0 does not exist"),
        (format!("{SQUARE}f -5 2 3\n"), 5, "vertex -5 does not exist"),
        (format!("{SQUARE}f 1/1 2/1 3/1\n"), 5, "texture coordinate 1 does not exist: 0"),
        (format!("{SQUARE}f 1//1 2//1 3//1\n"), 5, "normal 1 does not exist"),
        (format!("{SQUARE}f 1 2 99999999999999999999999\n"), 5, "does not exist"),
        (format!("{SQUARE}f 1 2 c\n"), 5, "expected a corner such as `1`, `1/2`, `1//3` or `1/2/3`, not `c`"),
        (format!("{SQUARE}f 1 2 3/4/5/6\n"), 5, "not `3/4/5/6`"),
        (format!("{SQUARE}f 1 2 3.5\n"), 5, "not `3.5`"),
        ("v 1 2\n".to_owned(), 1, "expected a number, but the line ends"),
        ("# x\nv 1 2 z\n".to_owned(), 2, "expected a number, not `z`"),
        ("v 0 0 0\nv 1 nan 2\n".to_owned(), 2, "vertex 2 at (1, NaN, 2) is no place"),
        ("v 0 0 0\r\nv 1 inf 2\r\n".to_owned(), 2, "vertex 2 at (1, inf, 2) is no place"),
        ("vt\n".to_owned(), 1, "expected a number"),
    ];
    for (text, line, why) in cases {
        let error = error("a.obj", text.as_bytes());
        assert!(error.message.contains(why), "{error}, not {why}");
        assert_eq!(error.place, Some(FilePlace::Line(line)), "{error}");
    }
    assert!(error("a.obj", SQUARE.as_bytes()).message.contains("no faces"));
    assert!(error("a.obj", b"").message.contains("empty"));
}

#[test]
fn names_and_faces_made_to_fill_memory_do_not() {
    let long = "x".repeat(1 << 20);
    let faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n".repeat(20_000);
    let model = model("a.obj", format!("{SQUARE}o {long}\n{faces}").as_bytes(), &NoAssets);
    let mesh = mesh_of(&model);
    assert_eq!((mesh.parts.len(), mesh.positions.len(), model.warnings.len()), (40_000, 3, 2));
    assert!(mesh.parts.iter().all(|part| part.name.as_ref().unwrap().len() == LONGEST_NAME));
}

#[test]
fn broken_files_never_panic() {
    let pieces: [&[u8]; 16] = [
        b"f ",
        b"v ",
        b"/",
        b"//",
        b"-",
        b"\\\n",
        b"\n",
        b"usemtl a\n",
        b"mtllib a\n",
        b"o \xff\n",
        b"1e400 ",
        b"nan ",
        b"# ",
        b"9999999999999999999",
        b"\0",
        b"f 1 1 1 2 2 2 3 3 3\n",
    ];
    let text = "mtllib a b.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 1\nv 0 1 0\nvt 0 0\nvt 1 1 0\nvn 0 0 1\nvn 1 0 0\n\
                g a b\nusemtl m\ns 1\nf 1/1/1 2/2/1 3/1/2 4/2/2\nf -1//-1 -2//-2 -3//-1\nf 1 2 3 4 \\\n 3 2\nl 1 2\n";
    assert_survives("a.obj", text.as_bytes(), &pieces);
    assert_survives("a.obj", written().as_bytes(), &pieces);
}
