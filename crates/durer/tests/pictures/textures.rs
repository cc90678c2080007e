//! Patterns and images at computed places.

use crate::support::{Front, assert_color, assert_gray, look, scene};
use durer::imaging::{EncodeOptions, FileFormat, Image, Transfer};
use durer::math::Rgb;
use durer::{LoadOptions, PictureFile};
use std::f64::consts::PI;

/// Each texel of this image of 8 × 5 is different: red tells the column, green the row from below, of 10.
fn texel(column: u32, row_from_below: u32) -> [f64; 3] {
    [f64::from(column * 25) / 255.0, f64::from(row_from_below * 25) / 255.0, 0.2]
}

const COLUMNS: u32 = 8;
const ROWS: u32 = 5;

/// The scene of a text that may show `image.png`, which is the image above.
fn with_image(text: &str) -> durer::Scene {
    let folder = tempfile::tempdir().expect("a folder for the image");
    let image = Image::from_fn(COLUMNS, ROWS, |x, y| texel(x, ROWS - 1 - y).map(|c| c as f32).into());
    let options = EncodeOptions { transfer: Transfer::Linear, ..EncodeOptions::new(FileFormat::Png) };
    PictureFile::create(&folder.path().join("image.png")).and_then(|file| file.write(&image, &options)).unwrap();
    let path = folder.path().join("scene.yaml");
    std::fs::write(&path, text).unwrap();
    durer::load_file(&path, &LoadOptions::default()).expect("a scene with its image").scene.into_scene()
}

/// The texel at (s, t) from 0 to 1, unless that is too near to the edge of a texel to say.
fn texel_at(s: f64, t: f64) -> Option<[f64; 3]> {
    let (x, y) = (s * f64::from(COLUMNS), t * f64::from(ROWS));
    let clear = |v: f64| (v - v.round()).abs() > 1e-9;
    (clear(x) && clear(y)).then(|| texel(x.floor() as u32 % COLUMNS, y.floor() as u32 % ROWS))
}

/// The point of the cylinder at (x, y) is (x, y, √(1 - x²)): s = (atan2(z, x) + π) / 2π, t = (y + h) / 2h.
#[test]
fn an_image_goes_around_a_cylinder_like_a_label() {
    let scene = with_image(
        "lights: []
objects:
  - cylinder:
      base: [0, -1.2, 0]
      top: [0, 1.2, 0]
      radius: 1
      open: true
      material:
        ambient: 1
        color:
          image: {file: image.png, mapping: {cylindrical: {half_height: 1.2}}, filter: nearest, encoding: linear}",
    );
    let mut seen = std::collections::BTreeSet::new();
    for (x, y, color) in Front::of(scene, 90, 2.6).points().filter(|(x, y, _)| x.abs() < 1.0 && y.abs() < 1.2) {
        let s = ((1.0 - x * x).sqrt().atan2(x) + PI) / (2.0 * PI);
        if let Some(expected) = texel_at(s, (y + 1.2) / 2.4) {
            assert_color(color, expected);
            seen.insert(expected.map(f64::to_bits));
        }
    }
    assert_eq!(seen.len(), 20, "the front half: four columns, five rows");
}

#[test]
fn an_image_lies_on_a_rectangle_from_corner_to_corner_with_its_lower_left_at_the_first() {
    let scene = with_image(
        "lights: []
objects:
  - rectangle:
      corner: [-1, -1, 0]
      edges: [[2, 0, 0], [0, 2, 0]]
      material: {ambient: 1, color: {image: {file: image.png, filter: nearest, encoding: linear}}}",
    );
    for (x, y, color) in Front::of(scene, 50, 2.0).points() {
        if let Some(expected) = texel_at((x + 1.0) / 2.0, (y + 1.0) / 2.0) {
            assert_color(color, expected);
        }
    }
}

/// The point of the ball at (x, y): s = (atan2(z, x) + π) / 2π, t = asin(y) / π + 1/2. It is turned by 90° about x, so
/// that the eye sees its north pole.
#[test]
fn an_image_goes_around_a_ball_like_a_map() {
    let scene = with_image(
        "lights: []
objects:
  - sphere:
      transform: [rotate: {x: 90}]
      material: {ambient: 1, color: {image: {file: image.png, mapping: spherical, filter: nearest, encoding: linear}}}",
    );
    for (x, y, color) in Front::of(scene, 60, 2.0).points().filter(|(x, y, _)| x * x + y * y < 0.99) {
        // The rotation takes (x, y, z) to (x, -z, y): what the eye sees at (x, y, z) was at (x, z, -y).
        let north = (1.0 - x * x - y * y).sqrt();
        if let Some(expected) = texel_at(((-y).atan2(x) + PI) / (2.0 * PI), north.asin() / PI + 0.5) {
            assert_color(color, expected);
        }
    }
}

#[test]
fn an_image_for_screens_is_read_as_light() {
    let scene = with_image(
        "lights: []
objects:
  - plane: {normal: [0, 0, 1], material: {ambient: 1, color: {image: {file: image.png, mapping: planar, filter: nearest}}}}",
    );
    let linear = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    for (x, y, color) in Front::of(scene, 30, 1.99).points() {
        if let Some(expected) = texel_at(x.rem_euclid(1.0), y.rem_euclid(1.0)) {
            assert_color(color, expected.map(linear));
        }
    }
}

const CHECKERED: &str = "{ambient: 1, color: {checker: {colors: [0.9, 0.1], size: 0.5}}}";

fn checker(x: f64, y: f64, z: f64) -> f64 {
    let cells = [x, y, z].map(|v| (v / 0.5).floor() as i64);
    if cells.iter().sum::<i64>().rem_euclid(2) == 0 { 0.9 } else { 0.1 }
}

/// Looked at from above on a floor whose y = 0 is itself between two cubes: above counts.
#[test]
fn a_checkered_floor_has_its_first_color_where_the_sum_of_the_cells_is_even() {
    let text = format!("lights: []\nobjects: [plane: {{material: {CHECKERED}}}]");
    for x in [-1.3, -0.51, -0.2, 0.01, 0.3, 0.49, 0.7, 12.3] {
        for z in [-7.6, -0.4, 0.1, 0.6, 1.1, 2.7] {
            let seen = look(&text, [x + 0.3, 2.0, z - 0.1], [x, 0.0, z]);
            assert_gray(seen.color, checker(x, 0.0, z));
        }
    }
}

/// p = T·R·S·q, steps in the order scale, rotate by 30° about z, translate: the pattern is that at q.
#[test]
fn a_pattern_moves_with_its_object() {
    let text = format!(
        "lights: []
background: 0.5
objects:
  - box:
      min: [-1, -1, -1]
      max: [1, 1, 0.7]
      material: {CHECKERED}
      transform: [scale: [2, 1, 1], rotate: {{z: 30}}, translate: [0.2, -0.1, 0]]"
    );
    let (sin, cos) = (PI / 6.0).sin_cos();
    for (x, y, color) in Front::of(scene(&text), 80, 5.0).points() {
        let (u, v) = (x - 0.2, y + 0.1);
        let (a, b) = ((u * cos + v * sin) / 2.0, v * cos - u * sin);
        if a.abs() < 1.0 && b.abs() < 1.0 {
            assert_gray(color, checker(a, b, 0.7));
        } else {
            assert_gray(color, 0.5);
        }
    }
}

#[test]
fn a_pattern_moves_with_the_groups_around_its_object() {
    let text = format!(
        "lights: []
objects:
  - group:
      transform: [rotate: {{z: 90}}]
      objects:
        - group:
            transform: [scale: 2, translate: [0.3, 0, 0]]
            material: {CHECKERED}
            objects: [plane: {{point: [0, 0, 0.2], normal: [0, 0, 1], transform: [translate: [0, 0.1, 0]]}}]"
    );
    for (x, y, color) in Front::of(scene(&text), 60, 5.0).points() {
        // Back by 90° about z, by 0.3, by 2, by 0.1.
        let (u, v) = (y, -x);
        let (u, v) = ((u - 0.3) / 2.0, v / 2.0 - 0.1);
        assert_gray(color, checker(u, v, 0.2));
    }
}

#[test]
fn a_texture_has_a_transform_of_its_own() {
    let text = "
lights: []
textures:
  wide: {checker: {colors: [0.9, 0.1], size: 0.5, transform: [scale: [3, 1, 1], translate: [0.2, 0, 0.1]]}}
objects: [plane: {normal: [0, 0, 1], material: {ambient: 1, color: wide}}]
";
    for (x, y, color) in Front::of(scene(text), 60, 5.0).points() {
        assert_gray(color, checker((x - 0.2) / 3.0, y, -0.1));
    }
}

#[test]
fn a_pattern_may_be_made_of_patterns() {
    let text = "
lights: []
textures:
  fine: {checker: {colors: [0.9, 0.1], size: 0.5}}
  stripes: {stripes: {colors: [fine, 0.3, [1, 0, 0]], axis: [0, 2, 0], width: 0.7}}
objects: [plane: {point: [0, 0, 0.1], normal: [0, 0, 1], material: {ambient: 1, color: stripes}}]
";
    for (x, y, color) in Front::of(scene(text), 60, 6.01).points() {
        match ((y / 0.7).floor() as i64).rem_euclid(3) {
            0 => assert_gray(color, checker(x, y, 0.1)),
            1 => assert_gray(color, 0.3),
            _ => assert_eq!(color, Rgb::new(1.0, 0.0, 0.0)),
        }
    }
}
