//! No pinholes: every ray through a convex thing hits it, also along the rims where caps and sides meet.
//!
//! A solid is where a quadratic is not positive, between two parallel planes; whether a line meets it is found from the
//! quadratic's least value between the planes, with no case for rims.

use crate::support::{compile, scene};
use durer::CompiledScene;
use durer::math::{DVec3, Rgb};

/// A frustum around the segment from `base` to `top`; a cylinder has equal radii.
struct Frustum {
    base: DVec3,
    top: DVec3,
    radii: [f64; 2],
}

impl Frustum {
    fn yaml(&self) -> String {
        let Frustum { base, top, radii: [r, s] } = self;
        let ends = format!("base: [{}, {}, {}], top: [{}, {}, {}]", base.x, base.y, base.z, top.x, top.y, top.z);
        if r == s {
            format!("cylinder: {{{ends}, radius: {r}}}")
        } else {
            format!("cone: {{{ends}, radius: {r}, top_radius: {s}}}")
        }
    }

    /// How far the line passes: negative inside, positive outside, in parts of the radius.
    fn passes(&self, origin: DVec3, direction: DVec3) -> f64 {
        let axis = self.top - self.base;
        let height = |v: DVec3| v.dot(axis) / axis.length_squared();
        let radius = self.radii[0].max(self.radii[1]);
        let slope = (self.radii[1] - self.radii[0]) / radius;
        let from = origin - self.base;
        // Along the line: height h(t) = h0 + h1 t, distance from the axis |p0 + p1 t|, radius r(t) = r0 + r1 t.
        let (h0, h1) = (height(from), height(direction));
        let (p0, p1) = ((from - axis * h0) / radius, (direction - axis * h1) / radius);
        let (r0, r1) = (self.radii[0] / radius + slope * h0, slope * h1);
        let (a, b, c) = (p1.dot(p1) - r1 * r1, 2.0 * (p0.dot(p1) - r0 * r1), p0.dot(p0) - r0 * r0);
        let ends = [-h0 / h1, (1.0 - h0) / h1];
        let (first, last) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let lowest = -b / (2.0 * a);
        let candidates = [first, last, if a > 0.0 { lowest.clamp(first, last) } else { first }];
        candidates.iter().map(|t| (a * t + b) * t + c).fold(f64::INFINITY, f64::min)
    }
}

const SIZE: u32 = 160;

/// The thing glows in white before black, seen by a parallel view of this height.
fn view(object: &str, middle: DVec3, towards: DVec3, height: f64) -> CompiledScene {
    let eye = middle - towards * (4.0 * height);
    compile(scene(&format!(
        "camera:
  position: [{}, {}, {}]
  look_at: [{}, {}, {}]
  up: [0.1, 0.2, 1]
  orthographic: {{height: {height}}}
picture: {{width: {SIZE}, height: {SIZE}}}
render: {{antialias: none}}
background: 0
lights: []
materials: {{glow: {{color: 1, ambient: 1}}}}
objects: [group: {{material: glow, objects: [{object}]}}]",
        eye.x, eye.y, eye.z, middle.x, middle.y, middle.z
    )))
}

/// The line of a pixel's ray.
fn line(scene: &CompiledScene, x: u32, y: u32) -> (DVec3, DVec3) {
    let ray = &durer::explain(scene, x, y).expect("a pixel").samples[0].ray;
    (ray.origin, ray.direction)
}

#[test]
fn cylinders_and_cones_have_no_holes_along_their_rims() {
    let views = [DVec3::new(0.3, -1.0, -0.4), DVec3::new(1.0, 0.4, -0.2), DVec3::new(-0.1, 0.9, 1.0)];
    for (far, margin) in [(0.0, 1e-11), (1e6, 1e-6)] {
        for scale in [1e-3, 1.0, 1e3] {
            if far > 0.0 && scale < 1.0 {
                continue; // Positions are not known well enough there.
            }
            for radii in [[1.0, 1.0], [1.0, 0.0], [0.4, 1.1]] {
                let base = DVec3::new(far, 0.5 * far, -far) + DVec3::new(0.1, -0.6, 0.2) * scale;
                let frustum =
                    Frustum { base, top: base + DVec3::new(0.2, 1.3, -0.3) * scale, radii: radii.map(|r| r * scale) };
                for towards in views {
                    let middle = (frustum.base + frustum.top) * 0.5;
                    let scene = view(&frustum.yaml(), middle, towards.normalize(), 3.2 * scale);
                    check(&scene, margin, |origin, direction| frustum.passes(origin, direction));
                }
            }
        }
    }
}

/// Compares every pixel with whether its line meets the solid.
fn check(scene: &CompiledScene, margin: f64, passes: impl Fn(DVec3, DVec3) -> f64) {
    let image = crate::support::film(scene).develop();
    let mut hits = 0;
    for y in 0..SIZE {
        for x in 0..SIZE {
            let (origin, direction) = line(scene, x, y);
            let passes = passes(origin, direction);
            if passes.abs() > margin {
                let hit = image.pixel(x, y) == Rgb::WHITE;
                assert_eq!(hit, passes < 0.0, "({x}, {y}), which passes by {passes}");
                hits += u32::from(hit);
            }
        }
    }
    assert!((SIZE * SIZE / 20..SIZE * SIZE * 3 / 4).contains(&hits), "{hits} pixels: inside and outside are seen");
}

/// A ray aimed at an edge or a corner goes through the box beyond it: it must hit.
#[test]
fn rays_at_the_edges_and_corners_in_front_of_a_box_hit_it() {
    for scale in [1e-3, 1.0, 1e6] {
        for (x, y, z) in [(1.0, 1.0, 1.0), (1.0, 1.0, 0.3), (0.2, 1.0, 1.0), (1.0, -0.7, 1.0)] {
            let text = format!(
                "lights: []\nobjects: [box: {{min: [-{scale}, -{scale}, -{scale}], max: [{scale}, {scale}, {scale}]}}]"
            );
            let from = [x, y, z].map(|c: f64| scale * (c * 1.5 + if c.abs() == 1.0 { 2.1 * c } else { 0.1 }));
            let seen = crate::support::look(&text, from, [x, y, z].map(|c| c * scale));
            assert!(seen.ray.hit.is_some(), "({x}, {y}, {z}) × {scale}");
        }
    }
}

/// Aimed exactly at the rim, from where the ray goes on into the body.
#[test]
fn rays_at_the_near_rim_of_a_cap_hit() {
    for thing in ["cylinder: {base: [0, -1, 0], top: [0, 1, 0]}", "cone: {base: [0, 1, 0], top: [0, -1, 0]}"] {
        for turn in 0..36 {
            let (sin, cos) = f64::from(turn * 10).to_radians().sin_cos();
            let text = format!("lights: []\nobjects: [{thing}]");
            let seen = crate::support::look(&text, [4.0 * cos, 2.5, 4.0 * sin], [cos, 1.0, sin]);
            assert!(seen.ray.hit.is_some(), "{thing} at {}°", turn * 10);
        }
    }
}

/// Two triangles that share a side, three that share a corner: no light comes through between.
#[test]
fn triangles_that_share_sides_leave_no_gap() {
    let fan = 7;
    let corner = |i: i32| {
        let a = f64::from(i) / f64::from(fan) * std::f64::consts::TAU;
        format!("[{}, {}, {}]", 1.5 * a.cos(), 1.5 * a.sin(), 0.3 * (3.0 * a).sin())
    };
    let triangles: Vec<String> = (0..fan)
        .map(|i| format!("triangle: {{vertices: [[0.1, 0.05, 0.4], {}, {}]}}", corner(i), corner((i + 1) % fan)))
        .collect();
    let scene = view(&triangles.join(", "), DVec3::ZERO, DVec3::new(0.1, 0.2, -1.0).normalize(), 1.8);
    let image = crate::support::film(&scene).develop();
    assert!(image.pixels.iter().all(|p| *p == Rgb::WHITE));
    // And rays aimed along the shared sides.
    for i in 0..fan {
        let text = format!("lights: []\nobjects: [{}]", triangles.join(", "));
        let a = f64::from(i) / f64::from(fan) * std::f64::consts::TAU;
        let side = [1.5 * a.cos(), 1.5 * a.sin(), 0.3 * (3.0 * a).sin()];
        for part in [0.0, 0.1, 0.5, 0.77] {
            let at = [0.1 + part * (side[0] - 0.1), 0.05 + part * (side[1] - 0.05), 0.4 + part * (side[2] - 0.4)];
            let seen = crate::support::look(&text, [0.4, 0.3, 5.0], at);
            assert!(seen.ray.hit.is_some(), "side {i}, {part} of the way");
        }
    }
}
