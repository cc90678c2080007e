//! Where a known point of the world is in the picture.

use crate::support::{compile, film, picture, scene};
use durer::math::{DVec3, Rgb};

/// The pixels in which a small glowing ball is seen.
fn pixels_of_ball(camera: &str, size: (u32, u32), center: DVec3, radius: f64) -> Vec<(u32, u32)> {
    let text = format!(
        "camera: {{{camera}}}
picture: {{width: {}, height: {}}}
render: {{antialias: none}}
background: 0
lights: []
objects:
  - sphere: {{center: [{}, {}, {}], radius: {radius}, material: {{color: 1, ambient: 1}}}}",
        size.0, size.1, center.x, center.y, center.z
    );
    let image = picture(scene(&text));
    let all = (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y)));
    all.filter(|&(x, y)| image.pixel(x, y) == Rgb::WHITE).collect()
}

/// tan 45° = 1: the picture reaches from -1 to 1 at distance 1, so at distance 4 a pixel is 0.08 wide.
#[test]
fn a_point_in_perspective_is_where_its_coordinates_divided_by_its_depth_say() {
    let center = |x: f64, y: f64| DVec3::new(4.0 * (x + 0.5 - 50.0) / 50.0, 4.0 * (50.0 - y - 0.5) / 50.0, -4.0);
    for (x, y) in [(0, 0), (99, 0), (50, 50), (75, 37), (3, 98)] {
        let at = center(f64::from(x), f64::from(y));
        assert_eq!(pixels_of_ball("fov: 90", (100, 100), at, 0.02), [(x, y)]);
    }
}

#[test]
fn pixels_are_square_in_wide_and_in_tall_pictures() {
    for (width, height) in [(160, 90), (90, 160)] {
        // Half the height is 0.8 at distance 1.
        let (x, y) = (7, 80);
        let pixel = 0.8 / (f64::from(height) / 2.0);
        let right = (f64::from(x) + 0.5 - f64::from(width) / 2.0) * pixel;
        let up = (f64::from(height) / 2.0 - f64::from(y) - 0.5) * pixel;
        let at = DVec3::new(right, up, -1.0) * 10.0;
        let camera = "image_plane: {distance: 12.5, half_height: 10}";
        assert_eq!(pixels_of_ball(camera, (width, height), at, 0.02), [(x, y)]);
        let degrees = 2.0 * 0.8_f64.atan().to_degrees();
        assert_eq!(pixels_of_ball(&format!("fov: {degrees}"), (width, height), at, 0.02), [(x, y)]);
    }
}

#[test]
fn in_parallel_projection_depth_does_not_matter() {
    for z in [-1.0, -10.0, -1000.0] {
        // 60 pixels for a height of 3: a pixel is 0.05 wide.
        let at = DVec3::new((70.5 - 40.0) * 0.05, (30.0 - 12.5) * 0.05, z);
        assert_eq!(pixels_of_ball("orthographic: {height: 3}", (80, 60), at, 0.02), [(70, 12)]);
    }
}

/// The eye at (1, 2, 3) looks along (2, 2, 1) / 3. With +z up, right is (1, -1, 0) / √2, and up is right × forward.
#[test]
fn the_camera_may_stand_and_look_anywhere() {
    let (eye, forward) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 2.0, 1.0) / 3.0);
    let right = DVec3::new(1.0, -1.0, 0.0) / 2.0_f64.sqrt();
    let up = DVec3::new(-1.0, -1.0, 4.0) / 18.0_f64.sqrt();
    let camera = "position: [1, 2, 3], look_at: [5, 6, 5], up: [0, 0, 7], fov: 60";
    let half = 30.0_f64.to_radians().tan();
    for (x, y) in [(10, 20), (40, 5), (25, 25)] {
        let (a, b) = ((f64::from(x) + 0.5) / 25.0 - 1.0, 1.0 - (f64::from(y) + 0.5) / 25.0);
        let at = eye + (forward + right * (a * half) + up * (b * half)) * 9.0;
        assert_eq!(pixels_of_ball(camera, (50, 50), at, 0.05), [(x, y)]);
    }
}

/// A pixel of a parallel view is a ray of its own, which starts on the plane through the position.
#[test]
fn what_is_behind_the_plane_of_a_parallel_view_is_not_seen() {
    let seen = |z: f64| !pixels_of_ball("orthographic: {height: 3}", (9, 9), DVec3::new(0.0, 0.0, z), 0.2).is_empty();
    assert!(seen(-0.3) && !seen(0.3));
}

#[test]
fn without_a_camera_all_bounded_things_are_in_the_picture() {
    for (width, height) in [(60, 60), (90, 40), (40, 90)] {
        let text = format!(
            "picture: {{width: {width}, height: {height}}}
render: {{antialias: none}}
background: 0
lights: []
objects:
  - box: {{min: [1, 2, 3], max: [3, 8, 4], material: {{color: 1, ambient: 1}}}}
  - sphere: {{center: [-5, 0, 0], radius: 1, material: {{color: 1, ambient: 1}}}}"
        );
        let image = film(&compile(scene(&text))).develop();
        let seen: Vec<(u32, u32)> = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .filter(|&(x, y)| image.pixel(x, y) == Rgb::WHITE)
            .collect();
        assert!(seen.len() > 100);
        assert!(seen.iter().all(|&(x, y)| x > 0 && y > 0 && x + 1 < width && y + 1 < height), "none at the edge");
        let spread = |values: Vec<u32>| values.iter().max().unwrap() - values.iter().min().unwrap();
        let (across, down) = (spread(seen.iter().map(|p| p.0).collect()), spread(seen.iter().map(|p| p.1).collect()));
        let shorter = width.min(height);
        assert!(across.max(down) * 5 > shorter * 2, "and they fill it: {across} × {down} of {width} × {height}");
    }
}
