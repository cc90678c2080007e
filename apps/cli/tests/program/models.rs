//! Meshes, models and copies: counted, explained, rendered.

use crate::workshop::Workshop;

/// Two triangles of two materials, three times; a clear sheet with holes before them.
const CITY: &str = "
picture: {width: 32, height: 32}
render: {antialias: none}
camera: {position: [0.25, 0.25, 4], look_at: [0.25, 0.25, 0], fov: 30}
materials: {wall: {color: tomato}, net: {color: black, opacity: {checker: {size: 10, colors: [0, 1]}}}}
objects:
  - instances:
      objects:
        - mesh:
            name: house
            material: wall
            vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
            triangles: [[0, 1, 2], [2, 1, 3]]
      positions: [[0, 0, 0], [3, 0, 0], [6, 0, 0]]
  - rectangle: {corner: [-9, -9, 1], edges: [[18, 0, 0], [0, 18, 0]], material: net}
";

/// Two molecules, and a bitten die.
const MOLECULES: &str = "
picture: {width: 32, height: 32}
render: {antialias: none}
camera: {position: [1, 0, 9], look_at: [1, 0, 0], fov: 20}
objects:
  - spheres: {name: atoms, centers: [[0, 0, 0], [1, 0, 0], [2, 0, 0]], radius: 0.4, colors: [red, white, red]}
  - capsules: {bases: [[0, 0, -2]], tops: [[2, 0, -2]], radius: 0.1}
  - difference: {objects: [box: {min: [0, 0.6, -1], max: [2, 1.4, 0]}, sphere: {center: [1, 1, 0], radius: 0.3}]}
";

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn info_counts_triangles_and_copies() {
    let workshop = Workshop::new();
    workshop.put("city.yaml", CITY);
    let text = workshop.fine("info city.yaml").stdout;
    for line in
        ["meshes     1, of 2 triangles", "instances  3 copies, with which there are 4 shapes", "bytes a triangle"]
    {
        assert!(text.contains(line), "no `{line}` in:\n{text}");
    }
    let json = workshop.fine("info city.yaml --json").json();
    assert_eq!((&json["meshes"]["triangles"], &json["placed"]), (&2.into(), &4.into()));
    assert!(json["bytes_each"]["triangle"].as_f64() > Some(0.0), "{json}");
    let text = workshop.fine("check city.yaml").stdout;
    assert!(text.starts_with("city.yaml: fine: 4 shapes, "), "{text}");
}

#[test]
fn explanations_name_copies_triangles_and_holes() {
    let workshop = Workshop::new();
    workshop.put("city.yaml", CITY);
    let text = workshop.fine("explain city.yaml --pixel 15,15").stdout;
    for part in [
        "goes through a hole of rectangle objects[1] after 3",
        "hits mesh \"house\", copy 0 after 4",
        "on its outside, triangle 0 (0.5",
        "material \"wall\"",
        "The two are equal to the last bit.",
    ] {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
    let json = workshop.fine("explain city.yaml --pixel 15,15 --json").json();
    let ray = &json["samples"][0]["ray"];
    assert_eq!(ray["hit"]["place"], "objects[0].copies[0].objects[0]");
    assert_eq!((&ray["hit"]["element"]["triangle"], &ray["hit"]["material"]), (&0.into(), &0.into()));
    assert_eq!(ray["holes"][0]["place"], "objects[1]");
}

#[test]
fn particles_and_solids_are_counted_and_named() {
    let workshop = Workshop::new();
    workshop.put("molecules.yaml", MOLECULES);
    let text = workshop.fine("info molecules.yaml").stdout;
    for line in ["particles  4: 3 spheres, 1 capsules", "solids     1: 1 difference", "bytes a particle"] {
        assert!(text.contains(line), "no `{line}` in:\n{text}");
    }
    let json = workshop.fine("info molecules.yaml --json").json();
    assert_eq!((&json["particles"]["kinds"]["spheres"], &json["placed"]), (&3.into(), &3.into()));
    let text = workshop.fine("explain molecules.yaml --pixel 15,15").stdout;
    assert!(text.contains("hits spheres \"atoms\" after 8.6") && text.contains("outside, particle 1\n"), "{text}");
    let seen = workshop.fine("explain molecules.yaml --pixel 15,6 --json").json();
    let hit = &seen["samples"][0]["ray"]["hit"];
    assert_eq!((&hit["kind"], &hit["element"]["operand"]), (&"difference".into(), &1.into()), "{hit}");
}

#[test]
fn a_model_is_a_scene() {
    let workshop = Workshop::new();
    workshop.put("triangle.obj", TRIANGLE);
    assert!(workshop.fine("check triangle.obj").stdout.starts_with("triangle.obj: fine: "));
    assert!(workshop.fine("info triangle.obj").stdout.contains("meshes     1, of 1 triangle"));
    workshop.fine("render triangle.obj --width 40 --antialias none");
    let picture = workshop.picture("triangle.png");
    assert!(picture.pixels.iter().any(|pixel| *pixel != picture.pixels[0]), "something is to be seen");
    workshop.fine("heatmap triangle.obj --width 40");
}
