//! Scenes whose answer is known in closed form, under every integrator, every way to end sampling, and every way to make pixels
//! of samples.
//!
//! Not all integrators compute the same. `path` has all light: L/(1 - ρ) in a glowing ball. `whitted` has the light of lamps
//! once, and follows mirrors as far as `max_depth`: so L (1 + ρ), and L/(1 - r) between mirrors, which both have. The share of
//! the sky that `ambient_occlusion` shows has closed forms of its own (Malley's hemisphere: a share of the unit disc), and
//! `normals`, `depth` and `uv` show numbers of the first surface, by formula.

use crate::support::{load, pixel};
use durer::imaging::Image;
use durer::{Film, Progress, RenderOptions};
use std::sync::Mutex;

const FILTERS: [&str; 5] = ["box", "tent", "gaussian", "mitchell", "blackman_harris"];
const ANTIALIAS: [&str; 6] =
    ["none", "{grid: 2}", "{recursive: {max_depth: 1}}", "adaptive", "{pov1: {depth: 2}}", "{pov2: {depth: 2}}"];

/// The inside of a ball of radius 2 with this material, and nothing else.
fn in_a_ball(size: u32, render: &str, material: &str) -> String {
    format!(
        "picture: {{width: {size}, height: {size}}}\nrender: {{{render}}}\nbackground: black\nambient: black\nlights: []\n\
         camera: {{position: [0.3, 0, 0], look_at: [0, 0.2, -1]}}\n\
         objects: [sphere: {{radius: 2, material: {{{material}}}}}]\n"
    )
}

/// A clock that moves by a second at each look: with a goal for noise, of which there are two in a pass.
struct Ticking(Mutex<f64>);

impl Progress for Ticking {
    fn elapsed(&self) -> Option<f64> {
        let mut seconds = self.0.lock().unwrap();
        *seconds += 1.0;
        Some(*seconds)
    }
}

fn film(text: &str) -> Film {
    let compiled = durer::compile(&load(text));
    durer::render(&compiled, &RenderOptions::default(), &Ticking(Mutex::new(0.0))).unwrap()
}

/// The mean of the components of all pixels, and the greatest distance of one from it.
fn mean_and_spread(image: &Image) -> (f64, f64) {
    let components: Vec<f64> = image.pixels.iter().flat_map(|pixel| pixel.to_array()).map(f64::from).collect();
    let mean = components.iter().sum::<f64>() / components.len() as f64;
    (mean, components.iter().map(|component| (component - mean).abs()).fold(0.0, f64::max))
}

fn assert_mean(text: &str, expected: f64, tolerance: f64) {
    let (mean, _) = mean_and_spread(&film(text).develop());
    assert!((mean / expected - 1.0).abs() <= tolerance, "{mean} in place of {expected}\n{text}");
}

/// L/(1 - ρ), however samples end and whatever pixels are made of them.
#[test]
fn a_glowing_ball_by_every_stop_and_filter() {
    let material = "matte: {color: 0.5, emission: 1}";
    let stops = ["samples: 64", "noise: 0.03, samples: 128", "time: 5, samples: 100000", "time: 12, noise: 0.02"];
    for stop in stops {
        for filter in FILTERS {
            let render = format!("integrator: {{path: {{max_depth: 100}}}}, {stop}, filter: {filter}");
            assert_mean(&in_a_ball(8, &render, material), 2.0, 0.01);
        }
    }
}

/// The same if samples are split, with less noise for as many samples.
#[test]
fn a_glowing_ball_by_samples_that_are_split() {
    let material = "matte: {color: 0.8, emission: 1}";
    let of = |split: u32| {
        let render = format!("integrator: {{path: {{max_depth: 1000, split: {split}}}}}, samples: 64");
        let image = film(&in_a_ball(24, &render, material)).develop();
        let off = image.pixels.iter().map(|pixel| f64::from(pixel.g) - 5.0);
        let (sum, squares) = off.fold((0.0, 0.0), |(sum, squares), off| (sum + off, squares + off * off));
        assert!((sum / 576.0).abs() < 0.02, "{} more than 5", sum / 576.0);
        squares
    };
    // All noise is of what comes behind the first surface: that of two tries is half as much, if not less.
    let [whole, halves, parts] = [1, 2, 5].map(of);
    assert!(halves < 0.6 * whole && parts < 0.3 * whole, "{whole} {halves} {parts}");
}

/// No sample brighter than that, and none the brighter for being split.
#[test]
fn a_clamp_holds_as_much_of_samples_that_are_split() {
    let of = |split: u32| {
        let render = format!("integrator: {{path: {{max_depth: 1000, clamp: 0.1, split: {split}}}}}, samples: 64");
        mean_and_spread(&film(&in_a_ball(16, &render, "matte: {color: 0.8, emission: 1}")).develop()).0
    };
    let [whole, parts] = [1, 4].map(of);
    assert!(whole < 4.0 && (parts / whole - 1.0).abs() < 0.01, "{whole} {parts}");
}

/// A time ends within a pass, and noise where there is little: they are not the same as taking all samples.
#[test]
fn samples_end_where_they_should() {
    let taken = |stop: &str| {
        let render = format!("integrator: path, {stop}");
        film(&in_a_ball(8, &render, "matte: {color: 0.5, emission: 1}")).sums().unwrap().least_and_most()
    };
    assert_eq!(taken("samples: 70"), (70, 70));
    // The same everywhere: nothing is left to tell after two looks.
    assert_eq!(taken("noise: 0.5, samples: 4096"), (64, 64));
    let (least, most) = taken("time: 4, samples: 4096");
    assert!(least == most && least < 4096, "{least} {most}");
}

/// Emission, and what the ball gives back of it, once.
#[test]
fn whitted_has_light_once() {
    for albedo in [0.0, 0.5, 0.8] {
        let material = format!("matte: {{color: {albedo}, emission: 1}}");
        for filter in FILTERS {
            let render = format!("integrator: whitted, light_samples: 64, antialias: {{grid: 2}}, filter: {filter}");
            assert_mean(&in_a_ball(4, &render, &material), 1.0 + albedo, 0.01);
        }
    }
}

/// A geometric series between mirrors, which `whitted` ends at its depth and `path` by chance; by all ways of sampling.
#[test]
fn mirrors_see_each_other_under_both_integrators() {
    let material = "color: black, specular: 0, emission: 1, reflection: 0.5";
    let sum = |terms: i32| (1.0 - 0.5_f64.powi(terms)) / 0.5;
    for antialias in ANTIALIAS {
        for filter in ["box", "mitchell"] {
            for depth in [1, 4, 20] {
                let render = format!("max_depth: {depth}, min_weight: 0, antialias: {antialias}, filter: {filter}");
                let image = film(&in_a_ball(4, &render, material)).develop();
                let (mean, spread) = mean_and_spread(&image);
                assert!(
                    (mean / sum(depth) - 1.0).abs() < 1e-5 && spread < 1e-5,
                    "{mean}, {antialias} {filter} {depth}"
                );
            }
        }
    }
    assert_mean(&in_a_ball(8, "integrator: {path: {max_depth: 100}}, samples: 64", material), 2.0, 0.01);
}

/// A floor seen in one point, with something beside it.
fn occluded(distance: &str, beside: &str) -> (f64, f64) {
    let rest = format!(
        "camera: {{position: [-1, 2, -1], look_at: [0, 0, 0], orthographic: {{height: 0.0001}}}}\nbackground: black\nlights: []\n\
         objects:\n- plane: {{}}\n{beside}"
    );
    let (color, error) = pixel(&format!("{{ambient_occlusion: {{{distance}}}}}"), 1024, &rest);
    (f64::from(color.g), error)
}

/// The share of the sky: all over a floor; half of it at an endless wall and a quarter between two; (1 + cos φ)/2 where a
/// long wall rises to the angle φ; 15/16 on the inside of a ball of radius 2, of whose wall only what is nearer than 1 counts.
#[test]
fn ambient_occlusion_has_closed_forms() {
    let wall = "- plane: {point: [1, 0, 0], normal: [-1, 0, 0]}\n";
    let other = "- plane: {point: [0, 0, 1], normal: [0, 0, -1]}\n";
    let long = "- box: {min: [1, -1, -10000], max: [2, 1, 10000]}\n";
    let two = format!("{wall}{other}");
    for (beside, expected) in [("", 1.0), (wall, 0.5), (&*two, 0.25), (long, 0.5 * (1.0 + 0.5_f64.sqrt()))] {
        let (found, error) = occluded("", beside);
        assert!((found - expected).abs() <= 5.0 * error + 1e-4 && error < 0.005, "{found} ± {error}, not {expected}");
    }
    let (found, error) = occluded("distance: 0.5", wall);
    assert!(found == 1.0 && error == 0.0, "what is further away hides nothing: {found}");
    assert_mean(
        &in_a_ball(8, "integrator: {ambient_occlusion: {distance: 1}}, samples: 64", "color: white"),
        0.9375,
        0.01,
    );
    for filter in FILTERS {
        let render = format!("integrator: {{ambient_occlusion: {{distance: 1}}}}, noise: 0.02, filter: {filter}");
        assert_mean(&in_a_ball(8, &render, "color: white"), 0.9375, 0.01);
    }
}

/// A rectangle from corner to corner of the picture, 3 in front of the camera or slanting away from it: what is seen of it is a
/// formula of the place.
#[test]
fn first_surfaces_are_formulas() {
    let shown = |render: &str, slant: f64| {
        film(&format!(
            "picture: {{width: 8, height: 8}}\nrender: {{{render}}}\nlights: []\n\
             camera: {{position: [0, 0, 3], look_at: [0, 0, 0], orthographic: {{height: 2}}}}\n\
             objects: [rectangle: {{corner: [-1, -1, {}], edges: [[2, 0, {}], [0, 2, 0]]}}]\n",
            -slant,
            2.0 * slant,
        ))
        .develop()
    };
    let inner = || (1..7).flat_map(|y| (1..7).map(move |x| (x, y)));
    for antialias in ANTIALIAS {
        for filter in ["box", "tent"] {
            let with = |integrator: &str| format!("integrator: {integrator}, antialias: {antialias}, filter: {filter}");
            let normals = shown(&with("normals"), 0.0);
            for (x, y) in inner() {
                assert!(near(normals.pixel(x, y).to_array(), [0.5, 0.5, 1.0]), "{antialias} {filter}");
            }
            // What is not even is the mean of a pixel only where all samples stand for equal areas, or lie evenly about its middle.
            if filter != "box" && !["none", "{grid: 2}"].contains(&antialias) {
                continue;
            }
            // White to the right, where it is nearest, and a tenth to the left.
            let depth = shown(&with("depth"), 1.0);
            for (x, y) in inner() {
                let expected = [0.1 + 0.9 * (f64::from(x) + 0.5) / 8.0; 3];
                assert!(near(depth.pixel(x, y).to_array(), expected), "{antialias} {filter}: {:?}", depth.pixel(x, y));
            }
        }
    }
    let uv = shown("integrator: uv", 0.0);
    for (x, y) in inner() {
        let expected = [(f64::from(x) + 0.5) / 8.0, 1.0 - (f64::from(y) + 0.5) / 8.0, 0.0];
        assert!(near(uv.pixel(x, y).to_array(), expected), "{:?}", uv.pixel(x, y));
    }
    // From the nearest of a box, white, to the farthest, a tenth, evenly.
    let text = "picture: {width: 1, height: 1}\nrender: {integrator: depth, antialias: none}\nlights: []\n\
                camera: {position: [0, 0, 3], look_at: [0, 0, 0], orthographic: {height: 0.1}}\n\
                objects: [box: {min: [-1, -1, -2], max: [-0.5, 1, 2]}, box: {min: [-1, -1, -2], max: [1, 1, DEPTH]}]\n";
    for (depth, expected) in [("2", 1.0), ("0", 0.55), ("-1", 0.325)] {
        let image = film(&text.replace("DEPTH", depth)).develop();
        assert!(near(image.pixels[0].to_array(), [expected; 3]), "{:?}, not {expected}", image.pixels[0]);
    }
}

fn near(found: [f32; 3], expected: [f64; 3]) -> bool {
    found.iter().zip(expected).all(|(&found, expected)| (f64::from(found) - expected).abs() < 1e-3)
}
