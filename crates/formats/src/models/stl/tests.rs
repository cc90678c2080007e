use super::super::testing::{area, assert_survives, dodecahedron, error, mesh, mesh_of, model, volume};
use super::*;
use crate::NoAssets;

/// The triangles of the dodecahedron, cut from a corner.
fn triangles() -> Vec<[DVec3; 3]> {
    let body = dodecahedron();
    let fan =
        |face: &[usize; 5]| [[face[0], face[1], face[2]], [face[0], face[2], face[3]], [face[0], face[3], face[4]]];
    body.faces.iter().flat_map(fan).map(|triangle| triangle.map(|at| body.corners[at])).collect()
}

fn binary(header: &[u8], triangles: &[[DVec3; 3]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        // A normal of no use.
        bytes.extend([0xff; 12]);
        triangle.iter().flat_map(|p| p.to_array()).for_each(|x| bytes.extend((x as f32).to_le_bytes()));
        bytes.extend([7, 7]);
    }
    bytes
}

fn text(name: &str, triangles: &[[DVec3; 3]]) -> String {
    let mut text = format!("solid {name}\n");
    for triangle in triangles {
        text += "  facet normal nan 0 -nan(ind)\n    outer loop\n";
        for p in triangle {
            let [x, y, z] = p.to_array().map(|x| x as f32);
            text += &format!("      vertex {x:e} {y} {z}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + &format!("endsolid {name}\n")
}

#[test]
fn a_dodecahedron_is_welded() {
    let body = dodecahedron();
    let mesh = mesh("a.stl", &binary(b"made for a test", &triangles()));
    assert_eq!((mesh.positions.len(), mesh.triangles.len(), mesh.parts.len()), (20, 36, 0));
    assert!((area(&mesh) - body.area).abs() < 1e-5 && (volume(&mesh) - body.volume).abs() < 1e-5);
}

#[test]
fn text_and_bytes_give_the_same_mesh() {
    let expected = mesh("a.stl", &binary(b"", &triangles()));
    let text = text("", &triangles());
    for written in [text.clone(), text.to_uppercase().replace("NAN(IND)", "nan"), text.replace('\n', "\r\n\t")] {
        assert_eq!(mesh("a.stl", written.as_bytes()), expected);
    }
    assert_eq!(mesh("a.stl", text.replace('\n', "   ").as_bytes()), expected, "all in one line");
    assert_eq!(mesh("a.dat", text.as_bytes()), expected, "known by its content");
    assert_eq!(mesh("a.dat", &binary(b"", &triangles())), expected);
}

#[test]
fn a_binary_file_may_begin_like_text() {
    let expected = mesh("a.stl", &binary(b"", &triangles()));
    assert_eq!(mesh("a.stl", &binary(b"solid made by a program", &triangles())), expected);
    let mut longer = binary(b"solid\0", &triangles());
    longer.extend([0; 9]);
    let model = model("a.stl", &longer, &NoAssets);
    assert!(mesh_of(&model) == expected && model.warnings[0].contains("9 bytes"));
}

#[test]
fn several_solids_are_parts() {
    let all = triangles();
    let file = text("first one", &all[..30]) + &text("", &all[30..33]) + "\n\n" + &text("second", &all[33..]);
    let mesh = mesh("a.stl", file.as_bytes());
    let part = |name: &str, first, count| MeshPart { name: Some(name.to_owned()), first, count, material: None };
    assert_eq!(mesh.parts, [part("first one", 0, 30), part("second", 33, 3)]);
    assert_eq!(mesh.positions.len(), 20);
}

#[test]
fn zeros_of_both_signs_are_one_place() {
    let p = |x, y| DVec3::new(x, y, 0.0);
    let file = binary(b"", &[[p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)], [p(-0.0, 1.0), p(1.0, -0.0), p(1.0, 1.0)]]);
    assert_eq!(mesh("a.stl", &file).triangles, [[0, 1, 2], [2, 1, 3]]);
}

#[test]
fn texts_far_away_keep_their_digits() {
    let file = "solid\nfacet normal 0 0 1\nouter loop\nvertex 5000000.125 0 0\nvertex 5000000.3 0 0\n\
                vertex 5000000.2 1 0\nendloop\nendfacet\nendsolid\n";
    let mesh = mesh("a.stl", file.as_bytes());
    assert!((area(&mesh) - 0.0875).abs() < 1e-7, "{}", area(&mesh));
}

#[test]
fn facets_may_have_more_corners() {
    let file = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 4 4 0\nvertex 2 1 0\n\
                vertex 0 4 0\nendloop\nendfacet\nendsolid\n";
    let mesh = mesh("a.stl", file.as_bytes());
    assert_eq!((mesh.triangles.len(), area(&mesh)), (3, 10.0));
}

#[test]
fn wrong_files_say_what_and_where() {
    let line = |n| Some(FilePlace::Line(n));
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let cases = [
        (format!("solid\n{}", facet.replace("vertex 1", "vertex nan")), line(2), "(NaN, 0, 0) is no place"),
        (format!("solid\n{}", facet.replace("vertex 1 0", "vertex 1 x")), line(5), "expected `a number`, not `x`"),
        (format!("solid\n{}", facet.replace("vertex 1 0 0\n", "")), line(2), "has 2 corners"),
        (format!("solid\n{}", facet.replace("endloop", "endlop")), line(7), "expected `endloop`, not `endlop`"),
        (format!("solid\n{}bar\n", facet), line(9), "expected `facet`, not `bar`"),
        ("solid\nfacet normal 0 0 1\nouter".to_owned(), line(3), "the file ends where `loop` should stand"),
        ("solid\nendsolid".to_owned(), None, "no triangles"),
    ];
    for (text, place, why) in cases {
        let error = error("a.stl", text.as_bytes());
        assert!(error.message.contains(why) && error.place == place, "{error}, not {why}");
    }
    let mut bytes = binary(b"", &triangles());
    let cut = error("a.stl", &bytes[..bytes.len() - 1]);
    assert!(cut.message.contains("after 35 of 36 triangles"), "{cut}");
    bytes[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let infinite = error("a.stl", &bytes);
    assert!(infinite.message.contains("in triangle 1 the corner (inf") && infinite.place == Some(FilePlace::Byte(134)));
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(error("a.stl", &bytes).message.contains("of 4294967295 triangles"));
    assert!(error("a.stl", b"short").message.contains("no STL file"));
}

#[test]
fn a_missing_end_is_only_a_warning() {
    let file = text("", &triangles()).replace("endsolid", "");
    assert!(model("a.stl", file.as_bytes(), &NoAssets).warnings[0].contains("no end"));
}

#[test]
fn broken_files_never_panic() {
    let pieces: [&[u8]; 9] = [
        b"facet ",
        b"endloop ",
        b"vertex 1 2 3 ",
        b"solid ",
        b"endsolid ",
        b"\n",
        b"\0",
        b"\x7f\xff\xff\xff",
        b"1e39 ",
    ];
    assert_survives("a.stl", text("a name", &triangles()[..6]).as_bytes(), &pieces);
    assert_survives("a.stl", &binary(b"solid", &triangles()[..6]), &pieces);
}
