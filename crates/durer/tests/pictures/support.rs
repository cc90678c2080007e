//! Scenes from text, single rays, flat views, comparisons.

use durer::imaging::Image;
use durer::math::{DVec3, Rgb};
use durer::scene::{Antialias, Camera, Projection, Scene};
use durer::{CompiledScene, Film, HitExplanation, PixelExplanation, RayExplanation, RenderOptions};

pub(crate) type Point = [f64; 3];

/// The scene of a text that refers to no files.
#[track_caller]
pub(crate) fn scene(text: &str) -> Scene {
    match durer::load_str(text, "test.yaml", &durer::NoAssets, &durer::Limits::default()) {
        Ok(loaded) => loaded.scene.into_scene(),
        Err(diagnostics) => panic!("{text}\n{diagnostics:?}"),
    }
}

#[track_caller]
pub(crate) fn compile(scene: Scene) -> CompiledScene {
    durer::compile(&scene.check().expect("a scene that can be rendered"))
}

pub(crate) fn film(scene: &CompiledScene) -> Film {
    let film = durer::render(scene, &RenderOptions::default(), &()).expect("a whole picture");
    assert_eq!(film.bad_samples(), 0, "no sample may be infinite or NaN");
    film
}

/// The whole picture, in linear light.
#[track_caller]
pub(crate) fn picture(scene: Scene) -> Image {
    film(&compile(scene)).develop()
}

/// What one ray of the eye saw.
pub(crate) struct Seen {
    pub(crate) color: Rgb,
    pub(crate) ray: RayExplanation,
}

impl Seen {
    /// The hit of the eye's ray.
    #[track_caller]
    pub(crate) fn hit(&self) -> HitExplanation {
        self.ray.hit.expect("the ray hits something")
    }

    /// The ray after so many first children: 0 is the eye's.
    #[track_caller]
    pub(crate) fn after(&self, steps: usize) -> &RayExplanation {
        (0..steps).fold(&self.ray, |ray, step| {
            ray.children.first().unwrap_or_else(|| panic!("the path ends after {step} of {steps} steps"))
        })
    }
}

/// Looks at a scene of one's own camera along the ray from one point through another; all else is as the text says.
#[track_caller]
pub(crate) fn look(text: &str, from: Point, to: Point) -> Seen {
    look_in(scene(text), from, to)
}

/// Looks so at a scene that is there already.
#[track_caller]
pub(crate) fn look_in(mut scene: Scene, from: Point, to: Point) -> Seen {
    let (from, to) = (DVec3::from(from), DVec3::from(to));
    let vertical = (to - from).normalize().y.abs() > 0.9;
    let up = if vertical { DVec3::Z } else { DVec3::Y };
    scene.camera = Some(Camera { position: from, look_at: to, up, ..Camera::default() });
    (scene.picture.width, scene.picture.height) = (1, 1);
    scene.render.antialias = Antialias::None;
    let scene = compile(scene);
    let color = film(&scene).develop().pixel(0, 0);
    let explained = durer::explain(&scene, 0, 0).expect("the only pixel");
    assert_eq!(color, explained.color, "explain shows what render did");
    let [sample] = <[_; 1]>::try_from(explained.samples).expect("one ray of the eye");
    Seen { color, ray: sample.ray }
}

/// What gets through from the first light to where the ray from one point to another hits.
#[track_caller]
pub(crate) fn visibility(text: &str, from: Point, to: Point) -> Rgb {
    look(text, from, to).ray.lights[0].visibility
}

/// A square picture in parallel projection from the front (from +z), `height` wide and high, its middle at the origin.
pub(crate) struct Front {
    pub(crate) image: Image,
    height: f64,
}

impl Front {
    /// One ray through the middle of each of `size` × `size` pixels.
    #[track_caller]
    pub(crate) fn of(mut scene: Scene, size: u32, height: f64) -> Front {
        scene.camera = Some(Camera {
            position: DVec3::new(0.0, 0.0, 100.0),
            look_at: DVec3::ZERO,
            up: DVec3::Y,
            projection: Projection::Orthographic { height },
            lens: None,
        });
        (scene.picture.width, scene.picture.height) = (size, size);
        scene.render.antialias = Antialias::None;
        Front { image: picture(scene), height }
    }

    /// Every pixel's place, x to the right and y up, and its colour.
    pub(crate) fn points(&self) -> impl Iterator<Item = (f64, f64, Rgb)> + '_ {
        let size = self.image.width;
        let along = move |i: u32| ((f64::from(i) + 0.5) / f64::from(size) - 0.5) * self.height;
        (0..size).flat_map(move |y| (0..size).map(move |x| (along(x), -along(y), self.image.pixel(x, y))))
    }
}

/// Every pixel of a picture, explained.
pub(crate) fn explained(scene: &CompiledScene) -> impl Iterator<Item = PixelExplanation> + '_ {
    let (width, height) = scene.picture_size();
    (0..height).flat_map(move |y| (0..width).filter_map(move |x| durer::explain(scene, x, y)))
}

/// The greatest difference of a component.
pub(crate) fn difference(a: Rgb, b: Rgb) -> f32 {
    (a - b).map(f32::abs).max_component()
}

/// The greatest difference of two pictures.
#[track_caller]
pub(crate) fn greatest_difference(a: &Image, b: &Image) -> f32 {
    assert_eq!((a.width, a.height), (b.width, b.height));
    a.pixels.iter().zip(&b.pixels).map(|(a, b)| difference(*a, *b)).fold(0.0, f32::max)
}

/// Fails unless the colour is the expected one, up to the rounding of a few single-precision operations.
#[track_caller]
pub(crate) fn assert_color(found: Rgb, expected: [f64; 3]) {
    let wanted = Rgb::from(expected.map(|c| c as f32));
    assert!(difference(found, wanted) < 1e-6, "found {found:?}, expected {expected:?}");
}

/// Fails unless all components are the expected number, up to the same rounding.
#[track_caller]
pub(crate) fn assert_gray(found: Rgb, expected: f64) {
    assert_color(found, [expected; 3]);
}

/// Fails unless two points or directions are equal but for rounding.
#[track_caller]
pub(crate) fn assert_vector(found: DVec3, expected: Point) {
    assert!((found - DVec3::from(expected)).length() < 1e-9, "found {found}, expected {expected:?}");
}

/// Numbers that look random and are the same every time (SplitMix64).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// From 0 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// From -1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}
