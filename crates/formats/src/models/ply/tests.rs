use super::super::FilePlace;
use super::super::testing::{area, assert_survives, dodecahedron, error, mesh, mesh_of, model, volume};
use super::*;
use crate::NoAssets;
use crate::data::Numbers;
use durer_scene::MeshData;

/// A PLY file in the making: the same numbers in any encoding.
struct Writer {
    encoding: Encoding,
    bytes: Vec<u8>,
}

const ENCODINGS: [Encoding; 3] = [Encoding::Ascii, Encoding::LittleEndian, Encoding::BigEndian];

impl Writer {
    fn new(encoding: Encoding, declarations: &str) -> Writer {
        let format = match encoding {
            Encoding::Ascii => "ascii",
            Encoding::LittleEndian => "binary_little_endian",
            Encoding::BigEndian => "binary_big_endian",
        };
        let header = format!("ply\nformat {format} 1.0\ncomment a test\n{}\nend_header\n", declarations.trim());
        Writer { encoding, bytes: header.into_bytes() }
    }

    fn put(&mut self, kind: &str, value: f64) {
        let mut bytes = match kind {
            "char" => (value as i8).to_le_bytes().to_vec(),
            "uchar" => (value as u8).to_le_bytes().to_vec(),
            "short" => (value as i16).to_le_bytes().to_vec(),
            "ushort" => (value as u16).to_le_bytes().to_vec(),
            "int" => (value as i32).to_le_bytes().to_vec(),
            "uint" => (value as u32).to_le_bytes().to_vec(),
            "int64" => (value as i64).to_le_bytes().to_vec(),
            "uint64" => (value as u64).to_le_bytes().to_vec(),
            "float" => (value as f32).to_le_bytes().to_vec(),
            "double" => value.to_le_bytes().to_vec(),
            other => panic!("{other}"),
        };
        match self.encoding {
            Encoding::LittleEndian => {}
            Encoding::BigEndian => bytes.reverse(),
            Encoding::Ascii => bytes = format!("{value}\n").into_bytes(),
        }
        self.bytes.extend(bytes);
    }

    fn all(&mut self, kind: &str, values: &[f64]) {
        values.iter().for_each(|value| self.put(kind, *value));
    }

    fn list(&mut self, length: &str, kind: &str, values: &[f64]) {
        self.put(length, values.len() as f64);
        self.all(kind, values);
    }
}

/// The dodecahedron with coordinates and indices of some types.
fn written(encoding: Encoding, coordinate: &str, length: &str, index: &str) -> Vec<u8> {
    let body = dodecahedron();
    let mut file = Writer::new(
        encoding,
        &format!(
            "element vertex 20\nproperty {coordinate} x\nproperty {coordinate} y\nproperty {coordinate} z\n\
             element face 12\nproperty list {length} {index} vertex_indices"
        ),
    );
    body.corners.iter().for_each(|corner| file.all(coordinate, &corner.to_array().map(|x| f64::from(x as f32))));
    body.faces.iter().for_each(|face| file.list(length, index, &face.map(|at| at as f64)));
    file.bytes
}

#[test]
fn all_encodings_and_types_give_the_same_mesh() {
    let expected = mesh("a.ply", &written(Encoding::Ascii, "float", "uchar", "int"));
    let body = dodecahedron();
    assert_eq!((expected.positions.len(), expected.triangles.len()), (20, 36));
    assert!((area(&expected) - body.area).abs() < 1e-5 && (volume(&expected) - body.volume).abs() < 1e-5);
    assert_eq!(expected.origin, DVec3::ZERO);
    for encoding in ENCODINGS {
        for index in ["char", "uchar", "short", "ushort", "int", "uint", "int64", "uint64"] {
            let bytes = written(encoding, "double", index, index);
            assert_eq!(mesh("a.ply", &bytes), expected, "{encoding:?}, {index}");
        }
    }
}

#[test]
fn double_coordinates_far_away_keep_their_digits() {
    let places = [[4e6 + 0.123_456_7, 5e6, 0.1], [4e6 + 1.0 / 3.0, 5e6 + 0.3, 0.2], [4e6, 5e6 + 0.7, 0.3]];
    for encoding in ENCODINGS {
        let mut file = Writer::new(
            encoding,
            "element vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n\
             property list uchar int vertex_index",
        );
        places.iter().for_each(|place| file.all("double", place));
        file.list("uchar", "int", &[0.0, 1.0, 2.0]);
        let mesh = mesh("a.ply", &file.bytes);
        for (found, expected) in mesh.positions.iter().zip(places) {
            let found = mesh.origin + DVec3::from_array(found.map(f64::from));
            assert!((found - DVec3::from_array(expected)).length() < 1e-7, "{found}");
        }
    }
}

/// A square with all that vertices may have, among things that mean nothing to us, with the faces first.
fn rich(encoding: Encoding) -> Vec<u8> {
    let mut file = Writer::new(
        encoding,
        "obj_info made for a test
         element face 2\nproperty uchar flags\nproperty list uchar float texcoord\nproperty list int short vertex_index
         element nothing 7
         element vertex 4\nproperty list uchar double weights\nproperty uchar red\nproperty uchar green
         property uchar blue\nproperty uchar alpha\nproperty float z\nproperty float y\nproperty float x
         property float nx\nproperty float ny\nproperty float nz\nproperty float texture_u\nproperty float texture_v
         property int quality
         element edge 2\nproperty int vertex1\nproperty int vertex2",
    );
    for corners in [[0.0, 1.0, 2.0], [0.0, 2.0, 3.0]] {
        file.put("uchar", 9.0);
        file.list("uchar", "float", &[0.5; 6]);
        file.list("int", "short", &corners);
    }
    for (index, [x, y]) in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].into_iter().enumerate() {
        file.list("uchar", "double", &vec![0.25; index]);
        file.all("uchar", &[255.0, 51.0 * index as f64, 0.0, 128.0]);
        file.all("float", &[5.0, y, x, 0.0, 0.0, 2.0, x * 0.5, y * 0.25]);
        file.put("int", -1.0);
    }
    file.all("int", &[0.0, 1.0, 2.0, 3.0]);
    file.bytes
}

#[test]
fn vertices_bring_colors_normals_and_texture_coordinates() {
    let read = |encoding| model("a.ply", &rich(encoding), &NoAssets);
    let model = read(Encoding::LittleEndian);
    assert!(model.warnings.len() == 1 && model.warnings[0].contains("texcoord"), "{:?}", model.warnings);
    let mesh = mesh_of(&model);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.positions, [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [1.0, 1.0, 5.0], [0.0, 1.0, 5.0]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 2.0]; 4]);
    assert_eq!(mesh.uvs, [[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [0.0, 0.25]]);
    assert_eq!((mesh.colors[0], mesh.colors[1].g), (Rgb::new(1.0, 0.0, 0.0), linear_from_srgb(0.2)));
    for encoding in [Encoding::Ascii, Encoding::BigEndian] {
        assert_eq!(mesh_of(&read(encoding)), mesh);
    }
}

const TRIANGLE: &str = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\n";

fn ascii(declarations: &str, numbers: &str) -> Vec<u8> {
    format!("ply\nformat ascii 1.0\n{declarations}end_header\n{numbers}").into_bytes()
}

#[test]
fn float_colors_are_linear_and_wide_whole_ones_are_not() {
    let with = |kind: &str, color: &str| -> MeshData {
        let channels = format!("property {kind} r\nproperty {kind} g\nproperty {kind} b\n");
        let numbers = format!("0 0 0 {color}\n1 0 0 {color}\n0 1 0 {color}\n3 0 1 2\n");
        mesh("a.ply", &ascii(&format!("{TRIANGLE}{channels}{FACE}"), &numbers))
    };
    assert_eq!(with("float", "0.5 0.25 7").colors[0], Rgb::new(0.5, 0.25, 1.0));
    assert_eq!(with("ushort", "65535 0 13107").colors[0], Rgb::new(1.0, 0.0, linear_from_srgb(0.2)));
    assert_eq!(with("float", "nan -1 0").colors[0], Rgb::BLACK);
}

#[test]
fn names_of_texture_coordinates_vary() {
    for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]] {
        let uv = format!("property float {u}\nproperty double {v}\n");
        let file = ascii(&format!("{TRIANGLE}{uv}{FACE}"), "0 0 0 .5 1\n1 0 0 .5 1\n0 1 0 .5 1\n3 0 1 2\n");
        assert_eq!(mesh("a.ply", &file).uvs, [[0.5, 1.0]; 3]);
    }
}

#[test]
fn strips_turn_and_start_again() {
    let strips = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\n";
    let places = "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n";
    // The second one turns on a spot: a vertex twice.
    let file = ascii(strips, &format!("{places}13 0 1 2 3 -1 2 3 4 4 5 -1 -1 0\n"));
    let mesh = mesh("a.ply", &file);
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    let up = |triangle: &[u32; 3]| {
        let [a, b, c] = super::super::testing::corners(&mesh, *triangle);
        (b - a).cross(c - a).z > 0.0
    };
    assert!(mesh.triangles.iter().all(up));
    assert!(error("a.ply", &ascii(strips, &format!("{places}3 0 1 6\n"))).message.contains("a vertex 6"));
}

#[test]
fn crlf_and_words_in_any_lines_do_no_harm() {
    let text = ascii(&format!("{TRIANGLE}{FACE}"), "0 0 0 1 0\n0\n0 1 0\n\n\t 3 0 1 2");
    let text = String::from_utf8(text).unwrap();
    let expected = mesh("a.ply", text.as_bytes());
    assert_eq!(expected.triangles, [[0, 1, 2]]);
    assert_eq!(mesh("a.ply", text.replace('\n', "\r\n").as_bytes()), expected);
    let little = written(Encoding::LittleEndian, "float", "uchar", "int");
    let end = little.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8(little[..end].to_vec()).unwrap().replace('\n', "\r\n");
    let crlf = [header.as_bytes(), &little[end..]].concat();
    assert_eq!(mesh("a.ply", &crlf), mesh("a.ply", &little));
}

#[test]
fn concave_faces_are_cut_well() {
    let numbers = "0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n2 0 1\n";
    let declarations = format!("{TRIANGLE}element face 2\nproperty list uchar int vertex_indices\n");
    let model = model("a.ply", &ascii(&declarations.replace("vertex 3", "vertex 5"), numbers), &NoAssets);
    assert_eq!((mesh_of(&model).triangles.len(), area(&mesh_of(&model))), (3, 10.0));
    assert!(model.warnings[0].contains("fewer than three corners"));
}

#[test]
fn wrong_files_say_what_and_where() {
    let whole = format!("{TRIANGLE}{FACE}");
    let line = |n| Some(FilePlace::Line(n));
    let cases = [
        (
            ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            line(13),
            "has a vertex 3, but vertices are numbered from 0 to 2",
        ),
        (ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), line(13), "no whole number"),
        (ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n"), line(13), "no whole number"),
        (ascii(&whole, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), line(11), "vertex 1 at (1, NaN, 0) is no place"),
        (ascii(&whole, "0 0 0\n1 1e30 0\n0 1 0\n3 0 1 2\n"), line(11), "too far away"),
        (ascii(&whole, "0 0 0\n1 one 0\n0 1 0\n3 0 1 2\n"), line(11), "not `one`"),
        (ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), line(13), "a list of -3 numbers"),
        (ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n99999999 0 1 2\n"), line(13), "more than the file can hold"),
        (ascii(&whole, "0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), line(14), "ends within element `face` 0"),
        (ascii(TRIANGLE, "0 0 0\n1 0 0\n0 1 0\n"), None, "no faces"),
        (ascii(FACE, "3 0 1 2\n"), None, "no element `vertex`"),
        (ascii(&whole.replace("float y", "float h"), "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), line(3), "lack a property"),
    ];
    for (bytes, place, why) in cases {
        let error = error("a.ply", &bytes);
        assert!(error.message.contains(why) && error.place == place, "{error}, not {why}");
    }
    let mut binary = written(Encoding::LittleEndian, "float", "uchar", "int");
    let length = binary.len();
    binary[length - 1] = 1;
    let wrong = error("a.ply", &binary);
    assert!(wrong.message.contains("face 11 has a vertex"), "{wrong}");
    assert_eq!(wrong.place, Some(FilePlace::Byte(length as u64 - 21)));
}

#[test]
fn counts_that_lie_take_no_memory() {
    for count in ["4294967295", "18446744073709551615", "1000000000000"] {
        for encoding in ENCODINGS {
            for element in ["vertex", "face"] {
                let text = String::from_utf8_lossy(&written(encoding, "float", "uchar", "int")).into_owned();
                let bytes = written(encoding, "float", "uchar", "int");
                let name = format!("element {element} ");
                let at = text.find(&name).unwrap() + name.len();
                let lying = [&bytes[..at], count.as_bytes(), &bytes[at + 2..]].concat();
                assert!(error("a.ply", &lying).message.contains("too short to hold"));
            }
        }
    }
    let nothing = ascii("element nothing 18446744073709551615\nelement vertex 0\nproperty int x\n", "");
    assert!(error("a.ply", &nothing).message.contains("lack a property"));
}

#[test]
fn there_may_be_too_many_triangles() {
    let limits = Limits { max_primitives: 35, ..Limits::default() };
    let bytes = written(Encoding::LittleEndian, "float", "uchar", "int");
    let error = super::super::read("a.ply", &bytes, &NoAssets, &limits).unwrap_err();
    assert!(error.message.contains("more than 35 triangles"), "{error}");
}

#[test]
fn broken_files_never_panic() {
    let pieces: [&[u8]; 12] = [
        b"\n",
        b" ",
        b"-1 ",
        b"1e999 ",
        b"nan ",
        b"4294967295 ",
        b"element vertex 99\n",
        b"property list uchar int a\n",
        b"\xff\xff\xff\xff",
        b"format ascii 1.0\n",
        b"end_header\n",
        b"property double x\n",
    ];
    for encoding in ENCODINGS {
        assert_survives("a.ply", &rich(encoding), &pieces);
    }
    assert_survives("a.ply", &written(Encoding::Ascii, "float", "uchar", "int"), &pieces);
}

#[test]
fn tables_have_the_numbers_of_vertices() {
    for encoding in ENCODINGS {
        let table = table(&rich(encoding), &Limits::default()).unwrap();
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        #[rustfmt::skip]
        assert_eq!(names, [
            "red", "green", "blue", "alpha", "z", "y", "x", "nx", "ny", "nz", "texture_u", "texture_v", "quality",
        ]);
        assert!(matches!(&table.columns[1].numbers, Numbers::U8(green) if *green == [0, 51, 102, 153]));
        assert!(matches!(&table.columns[6].numbers, Numbers::F32(x) if *x == [0.0, 1.0, 1.0, 0.0]));
        assert!(matches!(&table.columns[12].numbers, Numbers::F64(quality) if *quality == [-1.0; 4]));
    }
    let points = ascii(TRIANGLE, "0 0 0\n1 0 0\n0 1 0\n");
    assert_eq!(table(&points, &Limits::default()).unwrap().columns.len(), 3);
    assert!(table(&points[..points.len() - 3], &Limits::default()).is_err());
}
