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
