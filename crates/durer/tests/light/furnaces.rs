//! Scenes that look the same everywhere.

use crate::support::{assert_pixel, pixel};

/// From inside of a ball that gives off light L and gives back the part ρ, L/(1 - ρ) is seen.
#[test]
fn inside_of_a_glowing_ball() {
    for albedo in [0.0, 0.3, 0.5, 0.8] {
        let scene = format!(
            "background: black\nlights: []\n\
             camera: {{position: [0.3, 0, 0], look_at: [0, 0.2, -1]}}\n\
             objects: [sphere: {{radius: 2, material: {{matte: {{color: {albedo}, emission: 1}}}}}}]\n"
        );
        assert_pixel("{path: {max_depth: 1000}}", 512, &scene, 1.0 / (1.0 - albedo));
    }
}

/// What loses no light cannot be seen in a sky that is even, where half of it is missing, too: what is squeezed into glass comes
/// out again through holes.
#[test]
fn half_of_a_ball_of_glass() {
    for glass in [
        "glass: {opacity: 0.5}",
        "glass: {opacity: 0.2, ior: 3}",
        "principled: {base_color: 1, transmission: 1, roughness: 0, opacity: 0.5}",
    ] {
        let scene = format!(
            "background: 1\nlights: []\n\
             camera: {{position: [0.4, 0.2, 5], look_at: [0.4, 0.2, 0]}}\n\
             objects: [sphere: {{material: {{{glass}}}}}]\n"
        );
        assert_pixel("{path: {max_depth: 1000}}", 4096, &scene, 1.0);
    }
}

/// What is behind a hole is met in air, whether it is aimed at from inside the glass or found by chance; and by samples that are
/// split, too.
#[test]
fn half_of_a_ball_of_rough_glass_under_a_bell() {
    let scene = "background: 1\nlights: []\n\
                 camera: {position: [0.4, 0.2, 5], look_at: [0.4, 0.2, 0]}\n\
                 objects:\n  - sphere: {material: {glass: {opacity: 0.5, roughness: 0.6}}}\n  \
                 - sphere: {radius: 2, material: {glass: {thin: true, ior: 3}}}\n";
    for split in [1, 3] {
        let (found, error) = pixel(&format!("{{path: {{max_depth: 1000, split: {split}}}}}"), 32_768, scene);
        assert!((found.g - 1.0).abs() < 0.004 + 3.0 * error as f32, "split {split}: {found:?} ± {error}");
    }
}

/// Rough balls that lose no light do not make any, either, however often it goes through or to and fro inside: summed up over
/// the whole ball, they are as bright as the sky.
#[test]
fn rough_balls_in_an_even_sky() {
    for material in [
        "metal: {color: 1, roughness: 0.6}",
        "glass: {roughness: 0.3}",
        "glass: {roughness: 0.5}",
        "glass: {thin: true, roughness: 0.3}",
    ] {
        let scene = format!(
            "background: 1\nlights: []\n\
             camera: {{position: [0, 0, 5], look_at: [0, 0, 0], orthographic: {{height: 1.6}}}}\n\
             objects: [sphere: {{material: {{{material}}}}}]\n"
        );
        let (found, error) = pixel("{path: {max_depth: 1000}}", 131_072, &scene);
        assert!(error < 6e-4, "too noisy to tell: {material}: {found:?} ± {error}");
        assert!((found.g - 1.0).abs() < 1.5e-3, "{material}: {found:?} ± {error}");
    }
}
