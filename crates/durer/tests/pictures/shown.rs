//! Integrators that show something else than light, and the lens.

use crate::support::{compile, film, picture, scene};
use durer::math::Rgb;

fn near(a: Rgb, b: [f32; 3], tolerance: f32) {
    assert!((a - Rgb::from(b)).map(f32::abs).max_component() <= tolerance, "{a:?} is not {b:?}");
}

/// A picture of 9 × 9 pixels, seen from (0, 0, 5), of an integrator.
fn shown(integrator: &str, objects: &str) -> durer::imaging::Image {
    picture(scene(&format!(
        "{{picture: {{width: 9, height: 9}}, render: {{antialias: none, integrator: {integrator}}}, \
         camera: {{position: [0, 0, 5], look_at: [0, 0, 0], orthographic: {{height: 4}}}}, background: red, \
         objects: [{objects}]}}"
    )))
}

#[test]
fn normals_are_colors() {
    let image = shown("normals", "sphere: {radius: 1.8}");
    near(image.pixel(4, 4), [0.5, 0.5, 1.0], 1e-6);
    let x: f32 = 3.0 * 4.0 / 9.0 / 1.8;
    near(image.pixel(7, 4), [0.5 + x / 2.0, 0.5, 0.5 + (1.0 - x * x).sqrt() / 2.0], 1e-5);
    assert_eq!(image.pixel(0, 0), Rgb::BLACK, "the background has none");
    // From inside a surface shows its other side.
    near(shown("normals", "sphere: {center: [0, 0, 5], radius: 3}").pixel(4, 4), [0.5, 0.5, 1.0], 1e-6);
}

#[test]
fn depth_is_gray_from_white_to_dark() {
    let image =
        shown("depth", "sphere: {center: [-1, 0, 1], radius: 0.7}, box: {min: [0.5, -1, -3], max: [1.5, 1, -2]}");
    // The box around them goes from z = 1.7 to -3: depths from 3.3 to 8, of which the face of the box has 7.
    near(image.pixel(6, 4), [(1.0 - 0.9 * (7.0 - 3.3) / 4.7) as f32; 3], 1e-5);
    assert!(image.pixel(2, 4).g > 0.98 && image.pixel(0, 0) == Rgb::BLACK);
}

#[test]
fn texture_coordinates_are_red_and_green() {
    let image = shown("uv", "box: {min: [-1, -1, -1], max: [1, 1, 1]}");
    let step = 4.0 / 9.0 / 2.0;
    let [a, b] = [image.pixel(4, 4), image.pixel(5, 3)];
    near(a, [0.5, 0.5, 0.0], 1e-6);
    near(b, [0.5 + step, 0.5 + step, 0.0], 1e-6);
}

/// Around the back of a ball u begins anew: no pixel shows a mean of its two ends, whatever anti-aliasing is asked for.
#[test]
fn texture_coordinates_are_those_of_the_middles_of_pixels() {
    let shown = |antialias: &str, side: f64| {
        picture(scene(&format!(
            "{{picture: {{width: 9, height: 9}}, render: {{{antialias}, integrator: uv}}, \
             camera: {{position: [{side}, 0, 0.1], look_at: [0, 0, 0.1], orthographic: {{height: 4}}}}, objects: [sphere]}}"
        )))
    };
    // From one side the seam is seen, from the other not; each time it runs beside the middles.
    let plain = [-5.0, 5.0].map(|side| shown("antialias: none", side));
    assert!(plain.iter().any(|image| {
        let row = |x: u32| image.pixel(x, 4).r;
        (2..6).any(|x| (row(x) - row(x + 1)).abs() > 0.8)
    }));
    for antialias in ["antialias: {adaptive: {}}", "antialias: {grid: {n: 4}}, filter: mitchell"] {
        for (plain, side) in plain.iter().zip([-5.0, 5.0]) {
            assert!(shown(antialias, side) == *plain, "{antialias}");
        }
    }
}

/// What is less than half there is looked past.
#[test]
fn what_is_hardly_there_is_not_shown() {
    let front =
        |opacity: f32| format!("box: {{min: [-2, -2, 2], max: [2, 2, 3], material: {{opacity: {opacity}}}}}, sphere");
    assert_eq!(shown("normals", &front(0.4)).pixel(6, 4), shown("normals", "sphere").pixel(6, 4));
    near(shown("normals", &front(0.6)).pixel(6, 4), [0.5, 0.5, 1.0], 1e-6);
}

#[test]
fn ambient_occlusion_takes_samples() {
    let text = |integrator: &str| {
        format!(
            "{{picture: {{width: 5, height: 5}}, render: {{integrator: {integrator}, samples: 1024}}, \
             camera: {{position: [0, 9, 0.1], look_at: [0, 0, 0], up: [0, 0, -1], orthographic: {{height: 0.01}}}}, \
             objects: [plane, sphere: {{center: [0, 2, 0], radius: 1}}]}}"
        )
    };
    // It looks at the top of the ball, from where no ground is seen.
    near(picture(scene(&text("ambient_occlusion"))).pixel(2, 2), [1.0; 3], 0.01);
    let below = text("ambient_occlusion").replace("position: [0, 9, 0.1]", "position: [0, 0.9, 0.001]");
    // The ground below the ball: (r / h)² of its sky is hidden.
    near(picture(scene(&below)).pixel(2, 2), [0.75; 3], 0.02);
    let short = below.replace("integrator: ambient_occlusion", "integrator: {ambient_occlusion: {distance: 0.9}}");
    near(picture(scene(&short)).pixel(2, 2), [1.0; 3], 0.0);
}

/// A point of light out of focus is a disc as large as thin lenses say; in focus it is a point.
#[test]
fn lenses_blur_what_is_out_of_focus() {
    let lit = |lens: &str| {
        let film = film(&compile(scene(&format!(
            "{{picture: {{width: 41, height: 41}}, render: {{antialias: {{grid: 24}}}}, \
             camera: {{position: [0, 0, 8], look_at: [0, 0, 0], image_plane: {{distance: 8, half_height: 4.1}}{lens}}}, \
             background: black, ambient: black, lights: [], \
             objects: [sphere: {{radius: 0.05, material: {{color: black, emission: [100, 100, 100]}}}}]}}"
        ))));
        film.pixels().to_vec()
    };
    let pixels = |picture: &[Rgb]| picture.iter().filter(|pixel| pixel.g > 0.0).count();
    // A pixel is 0.2 wide where the ball is.
    let sharp = lit("");
    assert!(pixels(&sharp) <= 4, "{}", pixels(&sharp));
    assert!(pixels(&lit(", lens: {radius: 0.5}")) <= 4, "it looks at the ball, which is in focus");
    // In focus at 4, the lens of radius 0.5 has a disc of radius 0.5 (8 - 4) / 4 = 0.5 at 8, 2.5 pixels.
    let blurred = lit(", lens: {radius: 0.5, focus: 4}");
    let disc = std::f64::consts::PI * (0.5 + 0.05) * (0.5 + 0.05) / 0.04;
    let found = pixels(&blurred) as f64;
    assert!(found > disc * 0.75 && found < disc * 1.7, "{found} pixels of {disc}");
    let sum = |picture: &[Rgb]| picture.iter().map(|pixel| f64::from(pixel.g)).sum::<f64>();
    assert!((sum(&blurred) / sum(&sharp) - 1.0).abs() < 0.25, "no light is lost: {} of {}", sum(&blurred), sum(&sharp));
}
