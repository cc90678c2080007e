//! What glows by a texture: small windows in dark walls, and dim ones.

use super::*;
use durer_scene::{Encoding, Filter, ImageTexture, Mapping, Pattern, Space, Texture, TextureId, Transform, Wrap};

/// Adds a black square from (-1, 1, -1) to (1, 1, 1), which faces down and glows with radiance 1 in the squares of so many by so
/// many that the list names, columns from the left and rows from below.
fn add_windows(scene: &mut Scene, squares: u32, lit: &[[u32; 2]]) {
    let pixel = |at: u32| {
        let place = [at % squares, squares - 1 - at / squares];
        [f32::from(u8::from(lit.contains(&place))); 3]
    };
    let texels = Texels::F32((0..squares * squares).map(pixel).collect());
    let bitmap = Arc::new(Bitmap { width: squares, height: squares, texels, alpha: None });
    scene.images.push(ImageAsset { file: "windows.exr".to_owned(), bitmap });
    let image = ImageTexture {
        image: ImageId(scene.images.len() as u32 - 1),
        mapping: Mapping::Uv,
        wrap: Wrap::Clamp,
        filter: Filter::Nearest,
        encoding: Encoding::Linear,
        channels: Default::default(),
        tint: Rgb::WHITE,
    };
    add_square(scene, Pattern::Image(image));
}

/// Adds the same square, glowing by a pattern.
fn add_square(scene: &mut Scene, pattern: Pattern) {
    scene.textures.push(Texture { name: None, pattern, transform: Transform::default() });
    let corner = DVec3::new(-1.0, 1.0, -1.0);
    let square = Shape::Rectangle { corner, edges: [DVec3::X * 2.0, DVec3::Z * 2.0] };
    add(scene, ObjectKind::Shape(square), Sides::Front);
    if let Some(material) = scene.materials.last_mut() {
        material.emission.color = Paint::Texture(TextureId(scene.textures.len() as u32 - 1));
    }
}

/// The probability with which the last element is chosen for the origin on the floor.
fn chance_of_last(scene: Scene) -> f64 {
    let scene = compile(&scene.check().unwrap());
    let receiver = Receiver { point: DVec3::ZERO, normal: DVec3::Y, passes: false };
    let last = scene.emitters.shapes.len() as u32 - 1;
    scene.emitters.tree.probability(&receiver, last)
}

/// What of a white floor at the origin is lit by a small square in the plane y = 1: A cos⁴/π.
fn small(x: f64, z: f64, side: f64) -> f64 {
    let squared = 1.0 + x * x + z * z;
    side * side / (squared * squared) / PI
}

/// However small the lit window, the wall is aimed at; and a lamp beside it does not keep all of the choices.
#[test]
fn small_windows_are_aimed_at() {
    for squares in [7, 64, 500] {
        let mut scene = floor();
        add(&mut scene, ObjectKind::Shape(Shape::Sphere { center: DVec3::Y * 3.0, radius: 0.05 }), Sides::Both);
        add_windows(&mut scene, squares, &[[squares / 3, squares / 2]]);
        let per_window = f64::from(squares * squares);
        let chance = chance_of_last(scene);
        // By area and luminance: 4 per window at distance 1, against π 0.05² at distance 3.
        let [wall, lamp] = [4.0 / per_window, PI * 0.0025 / 9.0];
        let fair = wall / (wall + lamp);
        // The least is an eighth, and the tree takes what is as near as it is large for farther away.
        assert!(chance > fair / 20.0 && chance < 3.0 * fair, "{squares}: {chance}, not about {fair}");
    }
}

/// What is black all over is not aimed at.
#[test]
fn dark_walls_are_not_aimed_at() {
    let mut scene = floor();
    add(&mut scene, ObjectKind::Shape(Shape::Sphere { center: DVec3::Y * 3.0, radius: 0.05 }), Sides::Both);
    add_windows(&mut scene, 16, &[]);
    assert_eq!(chance_of_last(scene), 0.0);
}

/// A lit window beside a lamp gives what both give.
#[test]
fn a_window_gives_its_light() {
    let mut scene = floor();
    add(&mut scene, ObjectKind::Shape(Shape::Sphere { center: DVec3::Y * 10.0, radius: 0.5 }), Sides::Both);
    add_windows(&mut scene, 15, &[[3, 9]]);
    let (found, error) = seen(scene, 16_384);
    let side = 2.0 / 15.0;
    let (x, z) = (3.5 * side - 1.0, 9.5 * side - 1.0);
    // The lamp is seen through the wall's middle, which hides it.
    let expected = small(x, z, side);
    assert!((found - expected).abs() < 4.0 * error, "{found} ± {error}, not {expected}");
    assert!(error < 0.2 * expected, "{found} ± {error}");
}

/// A dim pattern is as bright as the same amount of plain light.
#[test]
fn dim_patterns_add_up() {
    let gray = 1e-4;
    let colors = [0.0, 2.0 * gray].map(|gray| Paint::Color(Rgb::gray(gray)));
    let mut scene = floor();
    add_square(&mut scene, Pattern::Checker { colors, size: 1.0 / 64.0, space: Space::Uv });
    let (found, error) = seen(scene, 8192);
    // The form factor of four squares of side 1 at distance 1, whose corners meet right above.
    let side = 2.0_f64.sqrt();
    let expected = f64::from(gray) * 4.0 * 2.0 / side * durer_math::functions::atan2(1.0, side) / (2.0 * PI);
    assert!((found - expected).abs() < 4.0 * error, "{found} ± {error}, not {expected}");
    assert!(error < 0.02 * expected, "{found} ± {error}");
}
