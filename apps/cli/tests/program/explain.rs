//! `durer explain`.

use crate::workshop::{ROOM, Workshop};
use serde_json::Value;

/// The bits of three numbers in JSON.
fn bits(color: &Value) -> Vec<u32> {
    color.as_array().unwrap().iter().map(|v| (v.as_f64().unwrap() as f32).to_bits()).collect()
}

/// Adds contributions to a sum: a ray's own, then those of its children.
fn add(sum: &mut [f32; 3], ray: &Value) {
    for contribution in ray["contributions"].as_array().unwrap() {
        for (sum, amount) in sum.iter_mut().zip(contribution["amount"].as_array().unwrap()) {
            *sum += amount.as_f64().unwrap() as f32;
        }
    }
    for child in ray["children"].as_array().unwrap() {
        add(sum, child);
    }
}

/// The pixel, added up again from nothing but what the JSON says.
fn added_up(explained: &Value) -> Vec<u32> {
    let mut pixel = [0f32; 3];
    for sample in explained["samples"].as_array().unwrap() {
        let Some(weight) = sample["weight"].as_f64() else { continue };
        let mut color = [0f32; 3];
        add(&mut color, &sample["ray"]);
        for (sum, component) in pixel.iter_mut().zip(color) {
            *sum += component * weight as f32;
        }
    }
    pixel.map(f32::to_bits).to_vec()
}

#[test]
fn the_sum_is_the_pixel_bit_for_bit() {
    let workshop = Workshop::new();
    for mode in ["none", "grid:2", "grid:3", "recursive:0.05,2", "recursive", "recursive:0,0"] {
        let options = format!("room.yaml --width 30 --antialias {mode}");
        workshop.fine(&format!("render {options} -o a.pfm"));
        workshop.fine(&format!("render {options} -o a.png"));
        let rendered = workshop.picture("a.pfm");
        let stored = durer::read_picture(&workshop.path("a.png"), &Default::default()).unwrap();
        let durer::imaging::Texels::U8(texels) = stored.texels else { panic!("8 bits") };
        for (x, y) in [(0, 0), (15, 9), (15, 12), (4, 10), (22, 7), (29, 19), (13, 6)] {
            let explained = workshop.fine(&format!("explain {options} --pixel {x},{y} --json")).json();
            let expected: Vec<u32> = rendered.pixel(x, y).to_array().map(f32::to_bits).to_vec();
            assert_eq!(bits(&explained["color"]), expected, "{mode} {x},{y}");
            assert_eq!(bits(&explained["sum"]), expected, "{mode} {x},{y}");
            assert_eq!(added_up(&explained), expected, "{mode} {x},{y}");
            assert_eq!(explained["stored"], serde_json::json!(texels[(y * 30 + x) as usize]), "{mode} {x},{y}");
        }
    }
}

#[test]
fn people_read_a_tree() {
    let workshop = Workshop::new();
    // Without the limit of weight, so that depth is what ends the tree.
    workshop.put("room.yaml", &ROOM.replace("{antialias: none}", "{antialias: none, min_weight: 0}"));
    let text = workshop.fine("explain room.yaml --pixel 12,8").stdout;
    let expected = [
        "room.yaml: pixel 12,8 of 24 × 16, 1 sample",
        "ray of the eye, depth 1",
        "hits sphere \"ball\" after ",
        "├─ reflected ray, depth 2, weight ",
        "└─ transmitted ray, depth 2, weight ",
        "light \"lamp\": ",
        "lights[1]: ",
        "not traced, deeper than max_depth",
        "The two are equal to the last bit.",
        "In a PNG of 8 bits (sRGB): ",
    ];
    for part in expected {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
    let widest = text.lines().map(|line| line.chars().count()).max();
    assert!(widest <= Some(110), "{widest:?} columns:\n{text}");
}

#[test]
fn the_text_ends_with_the_very_numbers_of_the_pixel() {
    let workshop = Workshop::new();
    workshop.fine("render room.yaml -o a.pfm --antialias grid:2");
    let text = workshop.fine("explain room.yaml --pixel 12,8 --antialias grid:2").stdout;
    let line = text.lines().find(|line| line.starts_with("the pixel as rendered")).unwrap();
    let numbers: Vec<u32> =
        line.split_whitespace().rev().take(3).map(|n| n.parse::<f32>().unwrap().to_bits()).collect();
    let pixel = workshop.picture("a.pfm").pixel(12, 8);
    assert_eq!(numbers, [pixel.b, pixel.g, pixel.r].map(f32::to_bits));
}

#[test]
fn nameless_shapes_are_called_by_their_place() {
    let workshop = Workshop::new();
    let scene = "render: {antialias: none}\nobjects: [group: {objects: [group: {objects: [sphere: {}]}]}]";
    workshop.put("nested.yaml", scene);
    let text = workshop.fine("explain nested.yaml --pixel 320,240").stdout;
    assert!(text.contains("hits sphere objects[0].objects[0].objects[0] after"), "{text}");
    assert!(text.contains("light \"key\""), "the default lights have names: {text}");
}

#[test]
fn thrown_away_samples_are_one_line_each() {
    let workshop = Workshop::new();
    let ran = workshop.fine("explain room.yaml --pixel 8,7 --antialias recursive:0,1");
    assert_eq!(ran.stdout.matches("not counted; its color was").count(), 4, "{}", ran.stdout);
    assert!(ran.stdout.contains("20 samples, 4 of them not counted"), "{}", ran.stdout);
    assert!(ran.stdout.contains("which counts 0.0625"), "{}", ran.stdout);
}

#[test]
fn pixels_outside_are_a_wrong_command() {
    let workshop = Workshop::new();
    workshop.fails("explain room.yaml --pixel 24,0", 2, "24,0 is outside of the picture of 24 × 16 pixels");
    workshop.fails("explain room.yaml --pixel 24", 2, "--pixel");
    workshop.fails("explain room.yaml --pixel -1,0", 2, "expected two whole numbers");
    workshop.fails("explain room.yaml", 2, "--pixel");
    workshop.fails("explain bad.yaml --pixel 0,0", 3, "radius");
}

/// A room whose lamp shines up, with a ball of glass; 12 × 8 pixels.
const BOX: &str = r"
camera: {position: [0, 0, 1.8], look_at: [0, -0.3, 0], fov: 60}
picture: {width: 12, height: 8}
render: {integrator: {path: {max_depth: 5, reuse: 16}}, samples: 3}
background: black
lights: [point: {position: [1, 0, 1], intensity: 0.2, name: candle}]
objects:
  - box: {name: room, min: [-2, -1, -2], max: [2, 2, 2], material: {matte: {color: [0.8, 0.6, 0.5]}}}
  - rectangle:
      corner: [-1, 1.2, -1]
      edges: [[0, 0, 2], [2, 0, 0]]
      material: {matte: {color: 0.5, emission: {color: [8, 7, 5], sides: front}}}
";

/// All rays of a tree in JSON.
fn rays(ray: &Value) -> Vec<&Value> {
    let below = ray["children"].as_array().unwrap().iter().flat_map(rays);
    std::iter::once(ray).chain(below).collect()
}

#[test]
fn people_read_of_junctions() {
    let workshop = Workshop::new();
    workshop.put("box.yaml", BOX);
    let texts: Vec<String> =
        (0..12).map(|x| workshop.fine(&format!("explain box.yaml --pixel {x},5")).stdout).collect();
    let text = texts.concat();
    for part in [
        "├─ ray to a junction, depth 2, weight 0.8 0.6 0.5\n",
        "hits box \"room\" after ",
        "found by this sample; it sends ",
        "found by sample 2 of pixel ",
        "densities by area: from here ",
        ", from all 16 pixels that see it ",
        "light that leaves it, of which this way counts 0.",
        "a junction: what arrives is not added up here; all of the block that see it take light from it",
        "light \"candle\": nothing in the way, ",
        "  light that was aimed at, of which this way counts 1 (",
        "    arrives from (",
        "light of the rays from here\n",
        ", depth 3, weight 1 relative to the junction\n",
        "  brings the junction ",
        " relative to the junction: not traced, deeper than max_depth",
    ] {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
    assert!(!text.contains("way 1 of"), "{text}");
    let widest = text.lines().map(|line| line.chars().count()).max();
    assert!(widest <= Some(150), "{widest:?} columns:\n{text}");
    // What is relative to a junction has no numbers at the right, where there is room for them after 68 columns.
    let is_of_junction = |line: &&str| line.contains("brings the junction") || line.contains("arrives from");
    assert!(text.lines().filter(is_of_junction).all(|line| !line.contains("     0.")), "{text}");
    let split = BOX.replace("reuse: 16", "reuse: 16, split: 2");
    workshop.put("split.yaml", &split);
    let texts: Vec<String> =
        (0..4).map(|x| workshop.fine(&format!("explain split.yaml --pixel {x},5")).stdout).collect();
    let text = texts.concat();
    for part in [
        "way 1 of 2: goes on towards ",
        "reflected ray, way 1 of 2, depth 2, weight 0.4 0.3 0.25\n",
        "reflected ray, way 2 of 2, depth 2, weight 0.4 0.3 0.25\n",
        "ends here: the first way of each sample finds such light, for all of the block",
    ] {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
}

#[test]
fn programs_read_of_junctions() {
    let workshop = Workshop::new();
    workshop.put("box.yaml", BOX);
    let explain = |x: u64, y: u64| workshop.fine(&format!("explain box.yaml --pixel {x},{y} --json")).json();
    let explained = explain(5, 4);
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("no number: {value}"));
    let mut shared = 0;
    for (index, sample) in explained["samples"].as_array().unwrap().iter().enumerate() {
        let mut sum = [0f32; 3];
        add(&mut sum, &sample["ray"]);
        assert_eq!(sum.map(f32::to_bits).to_vec(), bits(&sample["color"]), "contributions add up to the sample");
        for ray in rays(&sample["ray"]) {
            let is_relative = ray["relative_to"] == "junction";
            assert!(is_relative || ray["relative_to"] == "sample");
            let empty = if is_relative { "contributions" } else { "brought" };
            assert_eq!(ray[empty], serde_json::json!([]));
            assert_eq!(ray["kind"] == "connected", ray["reuse"].is_object());
            let reuse = &ray["reuse"];
            if reuse.is_null() {
                continue;
            }
            assert!(ray["hit"]["place"].is_string() && reuse["found_by"]["sample"] == index + 1);
            let sharing = &reuse["sharing"];
            let weight = number(&sharing["mis_weight"]);
            assert!((weight * number(&sharing["pdf_sum"]) / number(&sharing["pdf"]) - 1.0).abs() < 1e-12);
            for channel in 0..3 {
                let amount = number(&ray["contributions"][0]["amount"][channel]);
                let expected = number(&ray["weight"][channel]) * number(&reuse["radiance"][channel]) * weight;
                assert!((amount - expected).abs() < 1e-6 * expected, "{ray}");
            }
            shared += 1;
            if shared > 4 {
                continue;
            }
            // Who found it tells of the same point.
            let pixel = &reuse["found_by"]["pixel"];
            let finder = explain(pixel[0].as_u64().unwrap(), pixel[1].as_u64().unwrap());
            let found = rays(&finder["samples"][index]["ray"]);
            let junction = found.iter().find(|ray| ray["junction"].is_object()).expect("it is there");
            assert_eq!(junction["hit"]["point"], ray["hit"]["point"]);
            let arriving = junction["junction"]["arriving"].as_array().unwrap();
            assert!(arriving.iter().any(|one| one["radiance_over_pdf"] != serde_json::json!([0.0, 0.0, 0.0])));
        }
    }
    assert!(shared > 10, "{shared}");
}
