//! Eight rays of the eye are looked at together where that pays: each pixel is what it is alone, which `explain` says.

use crate::support::{compile, explained, scene};
use durer::{RayExplanation, RenderOptions, SimdLevel};

/// Flat and curved things, plain ones and others, under lamps of all kinds.
const STAGE: &str = "
picture: {width: 61, height: 40}
render: {antialias: none, max_depth: 3}
camera: {position: [0, 2, 9], look_at: [0, 0.5, 0]}
lights:
  - point: {position: [3, 5, 3], intensity: 0.4}
  - point: {position: [-4, 3, 2], falloff: inverse_square, intensity: 9}
  - spot: {position: [0, 6, 1], target: [0.5, 0, 0], half_angle: 20, inner_half_angle: 8, intensity: 0.6}
  - spot: {position: [2, 4, 6], target: [-1, 0, 0], half_angle: 9, intensity: 0.5}
objects:
  - plane: {point: [0, -1, 0], material: {color: {checker: {colors: [0.9, 0.2]}}}}
  - plane: {point: [0, 0, -4], normal: [0.1, 0, 1], material: {color: [0.2, 0.4, 0.8]}}
  - rectangle: {corner: [-3, -0.5, -1], edges: [[2, 0, 0], [0, 1, -1]], material: {color: 0.7}}
  - rectangle: {corner: [1.5, 0, -2], edges: [[2, 0, 0], [0, 1.5, -0.5]], material: {color: 0.1, reflection: 0.8}}
  - disc: {center: [0, 1.8, -1], normal: [0.2, 1, 0.1], radius: 0.8, inner_radius: 0.3, material: {color: tomato}}
  - sphere: {center: [-1, 0, 0], radius: 0.9, material: {color: gold}}
  - sphere: {center: [1, -0.3, 1], radius: 0.6, material: {color: 0.5, transparency: 0.6, ior: 1.5, specular: 0.5}}
  - cone: {base: [2.5, -1, 0], top: [2.5, 0.5, 0], radius: 0.6, material: {color: 0.6, specular: 0.4}}
";

const FOGS: [&str; 3] = [
    "",
    "fog: {exponential: {color: [0.7, 0.7, 0.8], distance: 20}}\n",
    "fog: {linear: {color: [0.7, 0.7, 0.8], start: 7, end: 12}}\n",
];

#[test]
fn each_pixel_is_as_it_is_alone_with_every_instruction_set() {
    for text in FOGS.map(|fog| format!("{fog}{STAGE}")) {
        let alone = compile(scene(&text));
        let pixels: Vec<_> = explained(&alone).collect();
        let shadow_rays = |film: &durer::Film| film.rays().shadow;
        let mut counted = None;
        for simd in SimdLevel::available() {
            let scene = durer::compile_for(&scene(&text).check().expect("a scene"), simd);
            let film = durer::render(&scene, &RenderOptions::default(), &()).expect("a picture");
            assert_eq!(film.rays().eye, 61 * 40);
            assert_eq!(*counted.get_or_insert(shadow_rays(&film)), shadow_rays(&film));
            let image = film.develop();
            for pixel in &pixels {
                assert_eq!(pixel.color, image.pixel(pixel.x, pixel.y), "{simd} ({}, {})", pixel.x, pixel.y);
            }
        }
    }
}

#[test]
fn as_many_rays_go_to_lamps_as_from_pixels_alone() {
    let stage = compile(scene(STAGE));
    let film = durer::render(&stage, &RenderOptions::default(), &()).expect("a picture");
    let alone = explained(&stage).flat_map(|pixel| pixel.samples).map(|sample| shadow_rays_of(&sample.ray));
    assert_eq!(film.rays().shadow, alone.sum::<u64>());
}

/// Rays to lamps from where a ray ended, and from where its children did.
fn shadow_rays_of(ray: &RayExplanation) -> u64 {
    let here = ray.lights.iter().filter(|light| light.distance.is_some() && light.cosine > 0.0).count() as u64;
    here + ray.children.iter().map(shadow_rays_of).sum::<u64>()
}
