//! How many rays a pixel takes, and what becomes of them.

use crate::support::{compile, film, scene};
use durer::imaging::Image;

fn rendered(antialias: &str, size: (u32, u32), rest: &str) -> (u64, Image) {
    let text = format!(
        "camera: {{position: [0, 0, 5], look_at: [0, 0, 0], orthographic: {{height: 4}}}}
picture: {{width: {}, height: {}}}
render: {{antialias: {antialias}}}
lights: []
{rest}",
        size.0, size.1
    );
    let film = film(&compile(scene(&text)));
    (film.rays().eye, film.develop())
}

/// Nowhere are two rays the same.
const NOISE: &str = "
objects:
  - plane: {normal: [0, 0, 1], material: {ambient: 1, color: {noise: {colors: [0, [1, 0.5, 0.2]], size: 0.01, octaves: 6}}}}
";
const FLAT: &str = "background: 0.3";

#[test]
fn no_anti_aliasing_takes_one_ray_and_a_grid_its_square() {
    assert_eq!(rendered("none", (7, 5), NOISE).0, 35);
    for n in [1, 2, 3, 8] {
        assert_eq!(rendered(&format!("{{grid: {n}}}"), (7, 5), NOISE).0, 35 * n * n);
    }
}

/// 4 + 16 + 64 + … = 4 (4^(D + 1) - 1) / 3.
#[test]
fn where_all_rays_differ_recursion_takes_as_many_as_the_series_says() {
    for depth in 0..=4 {
        let antialias = format!("{{recursive: {{threshold: 0, max_depth: {depth}}}}}");
        assert_eq!(rendered(&antialias, (7, 5), NOISE).0, 35 * 4 * (4_u64.pow(depth + 1) - 1) / 3);
    }
}

#[test]
fn where_nothing_differs_recursion_takes_four() {
    let (rays, image) = rendered("{recursive: {threshold: 0, max_depth: 5}}", (7, 5), FLAT);
    assert_eq!(rays, 35 * 4);
    assert!(image.pixels.iter().all(|p| *p == durer::math::Rgb::gray(0.3)));
}

/// 40 pixels for 4: pixel 20 reaches from 0 to 0.1. The edge is where a fraction of it is covered.
#[test]
fn a_pixel_that_is_covered_in_part_is_the_blend() {
    let pixel = |antialias: &str, edge: f64| {
        let rest = format!(
            "background: 0
objects: [rectangle: {{corner: [-9, -9, 0], edges: [[{}, 0, 0], [0, 18, 0]], material: {{color: 1, ambient: 1}}}}]",
            9.0 + edge
        );
        let (_, image) = rendered(antialias, (40, 40), &rest);
        assert_eq!((image.pixel(19, 7).r, image.pixel(21, 7).r), (1.0, 0.0));
        image.pixel(20, 7).r
    };
    assert_eq!(pixel("none", 0.049), 0.0);
    assert_eq!(pixel("none", 0.051), 1.0);
    assert_eq!(pixel("{grid: 4}", 0.05), 0.5);
    assert_eq!(pixel("{grid: 4}", 0.025), 0.25);
    let fine = "{recursive: {threshold: 0.1, max_depth: 5}}";
    assert_eq!(pixel(fine, 0.05), 0.5);
    // Halves that are covered, as far as the rays in them tell: 1/4 + 1/16 + 1/64; and 1/2 + 1/4, for the next rays
    // after 0.7 of the pixel are at 0.6875, inside, and 0.8125, outside.
    assert_eq!(pixel(fine, 0.033), 0.328_125);
    assert_eq!(pixel(fine, 0.07), 0.75);
}

/// Only one of the four rays of pixel (20, 20) differs from the others: whichever it is, it is noticed.
#[test]
fn recursion_notices_each_of_its_four_rays() {
    for (x, y) in [(0.0, -0.05), (0.05, -0.05), (0.0, -0.1), (0.05, -0.1)] {
        let rest = format!(
            "background: 0
objects: [rectangle: {{corner: [{x}, {y}, 0], edges: [[0.05, 0, 0], [0, 0.05, 0]], material: {{color: 1, ambient: 1}}}}]"
        );
        let (rays, image) = rendered("{recursive: {threshold: 0.1, max_depth: 1}}", (40, 40), &rest);
        assert_eq!((rays, image.pixel(20, 20).r), (1600 * 4 + 16, 0.25), "({x}, {y})");
    }
}

/// A disc of radius 1.5, of pixels of 0.1: the sum of all pixels is its area.
#[test]
fn the_light_of_a_disc_is_its_area() {
    let disc = "background: 0\nobjects: [disc: {normal: [0, 0, 1], radius: 1.5, material: {color: 1, ambient: 1}}]";
    let area = std::f64::consts::PI * 2.25;
    for (antialias, tolerance) in [("none", 0.05), ("{grid: 8}", 0.005), ("{recursive: {threshold: 0.1}}", 0.01)] {
        let (_, image) = rendered(antialias, (40, 40), disc);
        let sum: f64 = image.pixels.iter().map(|p| f64::from(p.r)).sum::<f64>() * 0.01;
        assert!((sum - area).abs() < tolerance * area, "{antialias}: {sum}, not {area}");
    }
}

/// The four rays of a pixel differ by less than a threshold of 0.3, added over red, green and blue.
#[test]
fn the_threshold_is_the_sum_over_the_components() {
    let halves = |step: f64| {
        format!(
            "background: 0.5
objects: [rectangle: {{corner: [-9, -9, 0], edges: [[9.05, 0, 0], [0, 18, 0]], material: {{color: {}, ambient: 1}}}}]",
            0.5 + step
        )
    };
    let rays = |step: f64| rendered("{recursive: {threshold: 0.3, max_depth: 1}}", (40, 40), &halves(step)).0;
    assert_eq!(rays(0.099), 1600 * 4);
    assert_eq!(rays(0.101), 1600 * 4 + 40 * 16);
}

/// Things far thinner than a pixel, white on black: all of their light is there, whatever they are and wherever they lie.
#[test]
fn the_light_of_thin_things_is_all_there() {
    let bright = "material: {color: 1, ambient: 1}";
    let things = [
        (
            "close to a wall",
            format!("cylinder: {{base: [-0.7, 0.013, -1], top: [0.7, 0.05, -1], radius: 0.0008, {bright}}}"),
        ),
        (
            "away from the eye",
            format!("cylinder: {{base: [0.2, -0.3, 4.99], top: [-0.4, 0.7, -30], radius: 0.002, {bright}}}"),
        ),
        ("a triangle", format!("triangle: {{vertices: [[-1.5, 0.1, 0], [1.4, 0.4, 0], [1.4, 0.404, 0]], {bright}}}")),
        ("a ring", format!("disc: {{normal: [0, 0.1, 1], inner_radius: 0.797, radius: 0.8, {bright}}}")),
        ("a torus", format!("torus: {{axis: [0, 0.2, 1], radius: 0.8, tube_radius: 0.002, {bright}}}")),
        (
            "a mesh",
            format!(
                "mesh: {{vertices: [[-1.5, 0.1, 0], [1.4, 0.4, 0], [1.4, 0.404, 0], [-1.5, 0.104, 0]], triangles: [[0, 1, 2], [0, 2, 3]], {bright}}}"
            ),
        ),
        (
            "a solid",
            format!(
                "union: {{objects: [cylinder: {{base: [-1, -0.3, 0], top: [1, 0.5, 0], radius: 0.002}}, cylinder: {{base: [-1, 0.5, 0], top: [1, -0.3, 0], radius: 0.002}}], {bright}}}"
            ),
        ),
        (
            "particles",
            format!("spheres: {{centers: [[0.1, 0.2, 0], [0.9, -0.6, 0], [-0.77, 0.31, 0]], radius: 0.003, {bright}}}"),
        ),
    ];
    for (name, thing) in things {
        let light = |antialias: &str| -> f64 {
            let text = format!(
                "camera: {{position: [0, 0, 5], look_at: [0, 0, 0], fov: 30}}
picture: {{width: 60, height: 60}}
render: {{antialias: {antialias}}}
background: 0
lights: []
objects:
  - {thing}
  - plane: {{point: [0, 0, -1.05], normal: [0, 0, 1], material: {{color: 0}}}}"
            );
            film(&compile(scene(&text))).develop().pixels.iter().map(|p| f64::from(p.r)).sum()
        };
        let (found, all) = (light("adaptive"), light("{grid: 32}"));
        assert!((found - all).abs() < 0.1 * all, "{name}: {found}, not {all}");
    }
}
