//! Surfaces that give off light by themselves: it is added once for each surface seen, and lights others.

use crate::support::{assert_color, look};
use durer::Source;
use durer::math::Rgb;

fn pane(material: &str) -> String {
    format!(
        "background: [0.25, 0.5, 1]
lights: [point: {{position: [3, 0, 4], intensity: 0.5}}]
objects:
  - rectangle: {{corner: [-1, -1, 0], edges: [[2, 0, 0], [0, 2, 0]], material: {{color: 0.5, {material}}}}}
  - plane: {{point: [0, 0, -9], normal: [0, 0, 1], material: {{color: 0.25, ambient: 1, diffuse: 0}}}}"
    )
}

/// Exactly: numbers that have few bits add up without rounding.
#[test]
fn emission_is_added_from_both_sides() {
    for z in [5.0, -5.0] {
        let seen = |emission: &str| look(&pane(&format!("ambient: 0, {emission}")), [0.0, 0.0, z], [0.0, 0.0, 0.0]);
        let (dark, bright) = (seen("specular: 0"), seen("emission: [2, 0.5, 0.25]"));
        assert_eq!(bright.color - dark.color, Rgb::new(2.0, 0.5, 0.25));
        let sources: Vec<Source> = bright.ray.contributions.iter().map(|c| c.source).collect();
        assert_eq!(sources.first(), Some(&Source::Emission));
        assert_eq!(sources.iter().filter(|source| **source == Source::Emission).count(), 1);
    }
}

/// Transparency takes part of a surface's shade, but not of what it gives off.
#[test]
fn clear_surfaces_give_off_all_of_it() {
    let text = pane("ambient: 0, diffuse: 0, transparency: 0.5, emission: [0, 1, 0.5]");
    assert_color(look(&text, [0.2, 0.0, 5.0], [0.2, 0.0, 0.0]).color, [0.125, 1.125, 0.625]);
}

/// Both faces of a clear ball are seen, and what a mirror shows of a lamp is weighed by the mirror.
#[test]
fn every_surface_on_the_way_adds_its_own() {
    let text = "
background: 0
lights: []
objects:
  - sphere: {material: {ambient: 0, diffuse: 0, transparency: 0.5, emission: 1}}
  - plane: {point: [0, 0, -3], normal: [0, 0, 1], material: {ambient: 0, diffuse: 0, reflection: 0.5}}
";
    // The ball, twice; in the mirror behind it, twice again.
    let ball = 1.0 + 0.5;
    assert_color(look(text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, [ball + 0.25 * 0.5 * ball; 3]);
}

/// A disc of radius r at height h fills r²/(r² + h²) of what the floor below sees; the lamp is behind it.
#[test]
fn what_glows_lights_others_and_throws_shadows() {
    let text = |samples: u32| {
        format!(
            "
render: {{light_samples: {samples}}}
lights: [point: {{position: [0, 10, 0]}}]
objects:
  - plane: {{}}
  - disc: {{center: [0, 5, 0], material: {{emission: 100}}}}
"
        )
    };
    let seen = |samples: u32| look(&text(samples), [0.1, 0.3, 0.0], [0.1, 0.0, 0.0]).color;
    assert_color(seen(0), [0.8 * 0.2; 3]);
    let (found, expected) = (f64::from(seen(64).r), 0.8 * 0.2 + 0.8 * 0.8 * 100.0 / 26.0);
    assert!((found / expected - 1.0).abs() < 0.01, "{found}, not {expected}");
}
