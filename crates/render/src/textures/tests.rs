//! Textures as a whole: compiled from scenes, placed, nested.

use super::*;
use durer_imaging::{Bitmap, Texels};
use durer_math::rotation;
use durer_scene::{
    Channels, Encoding, Filter, ImageAsset, ImageId, ImageTexture, Pattern as Described, Texture as DescribedTexture,
    TransformStep, Wrap,
};
use std::cell::Cell;
use std::sync::Arc;

/// A point that counts how often its uv is asked for.
struct Point {
    point: DVec3,
    uv: DVec2,
    asked: Cell<u32>,
}

impl Point {
    fn new(point: DVec3) -> Point {
        Point { point, uv: DVec2::new(0.25, 0.75), asked: Cell::new(0) }
    }
}

impl TexturePoint for Point {
    fn point(&self) -> DVec3 {
        self.point
    }

    fn uv(&self) -> DVec2 {
        self.asked.set(self.asked.get() + 1);
        self.uv
    }
}

const WHITE: Paint = Paint::Color(Rgb::WHITE);
const BLACK: Paint = Paint::Color(Rgb::BLACK);

fn texture(pattern: Described, steps: &[TransformStep]) -> DescribedTexture {
    DescribedTexture { name: None, transform: Transform { steps: steps.to_vec() }, pattern }
}

fn checker(colors: [Paint; 2], size: f64, space: Space) -> Described {
    Described::Checker { colors, size, space }
}

fn compile(textures: Vec<DescribedTexture>) -> Textures {
    Textures::compile(&Scene { textures, ..Scene::default() })
}

fn color(textures: &Textures, id: u32, point: DVec3) -> Rgb {
    textures.color(Paint::Texture(TextureId(id)), &Point::new(point))
}

/// Points all over a block of space.
fn points() -> impl Iterator<Item = DVec3> {
    (0..2_000).map(|i| {
        let i = f64::from(i);
        DVec3::new(i * 0.618_034 % 17.0 - 8.0, i * 0.754_878 % 19.0 - 9.0, i * 0.569_84 % 23.0 - 11.0)
    })
}

#[test]
fn textures_can_be_shared_between_threads() {
    fn is_sync<T: Send + Sync>() {}
    is_sync::<Textures>();
}

#[test]
fn a_color_is_itself() {
    let point = Point::new(DVec3::ONE);
    assert_eq!(compile(Vec::new()).color(Paint::Color(Rgb::new(0.1, 0.2, 7.0)), &point), Rgb::new(0.1, 0.2, 7.0));
}

#[test]
fn a_placed_texture_is_the_pattern_at_the_point_mapped_back() {
    let gradient = || Described::Gradient {
        colors: vec![BLACK, WHITE],
        axis: DVec3::new(1.0, 2.0, -1.0),
        length: 7.0,
        wrap: Wrap::Mirror,
        space: Space::Object,
    };
    let steps = [
        TransformStep::Scale(DVec3::new(2.0, 0.5, -1.0)),
        TransformStep::Rotate { axis: DVec3::Y * 4.0, degrees: 30.0 },
        TransformStep::Translate(DVec3::new(5.0, -3.0, 1.0)),
    ];
    let textures = compile(vec![texture(gradient(), &[]), texture(gradient(), &steps)]);
    for point in points() {
        let unmoved = point - DVec3::new(5.0, -3.0, 1.0);
        let unturned = rotation(DVec3::Y, -30.0_f64.to_radians()) * unmoved;
        let unscaled = unturned / DVec3::new(2.0, 0.5, -1.0);
        let difference = color(&textures, 1, point) - color(&textures, 0, unscaled);
        assert!(difference.max_component().abs() < 1e-5, "{point}");
    }
}

#[test]
fn only_textures_on_uv_ask_for_uv() {
    let textures = compile(vec![
        texture(checker([WHITE, BLACK], 0.5, Space::Object), &[]),
        texture(checker([WHITE, BLACK], 0.5, Space::Uv), &[]),
        texture(checker([WHITE, BLACK], 0.5, Space::Uv), &[TransformStep::Translate(DVec3::X * 0.5)]),
    ]);
    let point = Point::new(DVec3::new(0.1, 0.1, 0.1));
    assert_eq!(textures.color(Paint::Texture(TextureId(0)), &point), Rgb::WHITE, "cell (0, 0, 0)");
    assert_eq!(point.asked.get(), 0);
    assert_eq!(textures.color(Paint::Texture(TextureId(1)), &point), Rgb::BLACK, "cell (0, 1) of uv");
    assert_eq!(textures.color(Paint::Texture(TextureId(2)), &point), Rgb::WHITE, "cell (-1, 1) of uv");
    assert_eq!(point.asked.get(), 2);
}

#[test]
fn paints_nest() {
    let blend = Described::Gradient {
        colors: vec![Paint::Texture(TextureId(1)), Paint::Color(Rgb::new(0.0, 0.0, 1.0))],
        axis: DVec3::Y,
        length: 2.0,
        wrap: Wrap::Clamp,
        space: Space::Object,
    };
    let textures = compile(vec![
        texture(checker([Paint::Texture(TextureId(2)), BLACK], 8.0, Space::Object), &[]),
        texture(checker([WHITE, Paint::Color(Rgb::new(1.0, 0.0, 0.0))], 1.0, Space::Object), &[]),
        texture(blend, &[]),
    ]);
    assert_eq!(color(&textures, 0, DVec3::new(-0.5, 1.0, 0.5)), Rgb::BLACK);
    assert_eq!(color(&textures, 0, DVec3::new(0.5, 0.0, 0.5)), Rgb::WHITE);
    assert_eq!(color(&textures, 0, DVec3::new(1.5, 0.5, 0.5)), Rgb::new(0.75, 0.0, 0.25));
    assert_eq!(color(&textures, 0, DVec3::new(1.5, 2.5, 0.5)), Rgb::new(0.0, 0.0, 1.0), "beyond the end");
}

/// As deep as the check allows, each texture the second paint of the next and almost all of the blend.
#[test]
fn blends_nest_deeply() {
    let textures = (0..32_u32).map(|i| {
        let below = if i == 0 { WHITE } else { Paint::Texture(TextureId(i - 1)) };
        texture(Described::Noise { colors: [WHITE, below], size: 1.0 + f64::from(i), octaves: 4 }, &[])
    });
    let textures = compile(textures.collect());
    for point in points() {
        assert!((color(&textures, 31, point) - Rgb::WHITE).max_component().abs() < 1e-5);
    }
}

#[test]
fn an_image_on_uv_is_placed_by_its_transform() {
    let texels = Texels::F32(vec![[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]]);
    let bitmap = Arc::new(Bitmap { width: 2, height: 2, texels, alpha: None });
    let image = |mapping| {
        Described::Image(ImageTexture {
            image: ImageId(0),
            mapping,
            wrap: Wrap::Repeat,
            filter: Filter::Nearest,
            encoding: Encoding::Linear,
            channels: Channels::Color,
            tint: Rgb::WHITE,
        })
    };
    let half = TransformStep::Scale(DVec3::splat(0.5));
    let scene = Scene {
        images: vec![ImageAsset { file: "four.exr".into(), bitmap }],
        textures: vec![
            texture(image(Mapping::Uv), &[]),
            texture(image(Mapping::Uv), &[half]),
            texture(image(Mapping::Planar), &[half]),
        ],
        ..Scene::default()
    };
    let textures = Textures::compile(&scene);
    let point = DVec3::new(0.3, 0.1, 5.0);
    assert_eq!(color(&textures, 0, point), Rgb::gray(0.0), "uv (0.25, 0.75): upper left");
    assert_eq!(color(&textures, 1, point), Rgb::gray(1.0), "(0.5, 1.5): upper right of the second tile");
    assert_eq!(color(&textures, 2, point), Rgb::gray(3.0), "(0.6, 0.2): lower right");
}

#[test]
fn no_point_breaks_any_pattern() {
    let colors = vec![BLACK, WHITE, BLACK];
    let pair = [BLACK, WHITE];
    let patterns = [
        checker(pair, 1e-3, Space::Object),
        Described::Stripes { colors: colors.clone(), axis: DVec3::ONE, width: 1e-3, space: Space::Object },
        Described::Rings { colors: colors.clone(), width: 1e-3, space: Space::Object },
        Described::Gradient { colors, axis: DVec3::ONE, length: 1e-3, wrap: Wrap::Repeat, space: Space::Object },
        Described::Noise { colors: pair, size: 1e-3, octaves: 16 },
        Described::Marble { colors: pair, size: 1e-3, turbulence: 9.0, octaves: 16 },
        Described::Wood { colors: pair, size: 1e-3, turbulence: 9.0, octaves: 16 },
    ];
    let turn = [TransformStep::Rotate { axis: DVec3::ONE, degrees: 20.0 }];
    let count = patterns.len() as u32;
    let textures = compile(patterns.into_iter().map(|pattern| texture(pattern, &turn)).collect());
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e300, -1e300, 1e19, -1e-300, 0.0] {
        for point in [DVec3::splat(x), DVec3::new(x, 0.3, 0.3), DVec3::new(0.3, -x, x)] {
            for id in 0..count {
                let color = color(&textures, id, point);
                assert!((0.0..=1.0).contains(&color.r), "texture {id} at {point}: {color:?}");
            }
        }
    }
}
