//! What `explain` tells of a path adds up to the pixel.

use durer::{Limits, NoAssets, RenderOptions};

#[test]
fn paths_add_up_to_the_pixel_to_the_last_bit() {
    adds_up("path");
    adds_up("{path: {split: 3}}");
    for reused in ["reuse: 4", "reuse: 16", "reuse: 64", "reuse: 16, split: 2", "reuse: 16, clamp: 0.1"] {
        adds_up(&format!("{{path: {{{reused}}}}}"));
    }
}

fn adds_up(integrator: &str) {
    let text = "
        picture: {width: 9, height: 6}
        render: {integrator: INTEGRATOR, samples: 5, filter: mitchell}
        background: [0.2, 0.3, 0.4]
        objects:
          - plane: {material: {matte: {color: 0.5}}}
          - sphere: {center: [0, 1, 0], material: {glass: {ior: 1.5}}}
          - sphere: {center: [2, 3, 1], radius: 0.5, material: {matte: {color: black, emission: 9}}}";
    let text = &text.replace("INTEGRATOR", integrator);
    let loaded = durer::load_str(text, "scene.yaml", &NoAssets, &Limits::default()).unwrap();
    let scene = durer::compile(&loaded.scene);
    let film = durer::render(&scene, &RenderOptions::default(), &()).unwrap();
    for y in 0..6 {
        for x in 0..9 {
            let explained = durer::explain(&scene, x, y).unwrap();
            let bits = |color: durer::math::Rgb| color.to_array().map(f32::to_bits);
            assert_eq!(explained.samples.len(), 5);
            assert_eq!(bits(explained.color), bits(film.pixels()[(y * 9 + x) as usize]), "{x},{y}");
            assert_eq!(bits(explained.sum()), bits(explained.color), "{x},{y}");
        }
    }
}
