//! Scenes that look the same everywhere.

use crate::support::assert_pixel;

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
