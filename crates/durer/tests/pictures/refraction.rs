//! Glass: Snell's law, total internal reflection, Fresnel's equations, Beer–Lambert's law.

use crate::support::{Front, Seen, assert_color, assert_gray, assert_vector, look, scene};
use durer::RayKind;
use std::f64::consts::PI;

fn ball(ior: f64) -> String {
    format!("lights: []\nobjects: [sphere: {{radius: 1, material: {{transparency: 1, ior: {ior}}}}}]")
}

/// A ray that enters a ball at the angle i goes on inside at the angle t, and leaves turned by 2 (i - t) in all.
#[track_caller]
fn assert_turned_by_ball(seen: &Seen, first: usize, offset: f64, relative_ior: f64) {
    let i = offset.asin();
    let t = (offset / relative_ior).asin();
    let (inside, behind) = (seen.after(first), seen.after(first + 1));
    assert_vector(inside.direction, [-(i - t).sin(), 0.0, -(i - t).cos()]);
    assert_vector(behind.direction, [-(2.0 * (i - t)).sin(), 0.0, -(2.0 * (i - t)).cos()]);
    assert_eq!([inside.kind, behind.kind], [RayKind::Transmitted; 2]);
}

#[test]
fn a_ray_leaves_a_glass_ball_where_snell_says() {
    for ior in [1.5, 1.33, 2.4, 0.9] {
        for offset in [0.0, 0.1, 0.5, -0.7, 0.85] {
            let seen = look(&ball(ior), [offset, 0.0, 5.0], [offset, 0.0, 0.0]);
            assert_turned_by_ball(&seen, 1, offset, ior);
            let around = offset.asin() + PI - 2.0 * (offset / ior).asin();
            let exit = seen.after(1).hit.expect("the far face").point;
            assert_vector(exit, [around.sin(), 0.0, around.cos()]);
            assert!(!seen.after(1).hit.unwrap().from_outside);
        }
    }
}

/// From (1, 0, 0) along +z in a ball of radius 2: the normal is 30° from the ray, sin t = 1.5 sin 30° = 0.75.
#[test]
fn an_eye_inside_glass_sees_out_by_snell() {
    let text = ball(1.5).replace("radius: 1", "radius: 2");
    let seen = look(&text, [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]);
    let angle = PI / 6.0 - 0.75_f64.asin();
    assert_vector(seen.after(1).direction, [angle.sin(), 0.0, angle.cos()]);
}

/// The eye looks straight down into the water, which does not bend its ray; the ball does, by 1.5 / 1.33.
#[test]
fn a_glass_ball_in_water_bends_by_the_relative_index() {
    let text = "
render: {max_depth: 10}
lights: []
objects:
  - plane: {normal: [0, 0, 1], material: {transparency: 1, ior: 1.33}}
  - sphere: {center: [0, 0, -3], radius: 1, material: {transparency: 1, ior: 1.5}}
";
    for offset in [0.2, 0.5, -0.8] {
        let above = look(text, [offset, 0.0, 5.0], [offset, 0.0, 0.0]);
        assert_vector(above.after(1).direction, [0.0, 0.0, -1.0]);
        assert_turned_by_ball(&above, 2, offset, 1.5 / 1.33);
        let under_water = look(text, [offset, 0.0, -1.0], [offset, 0.0, -3.0]);
        assert_turned_by_ball(&under_water, 1, offset, 1.5 / 1.33);
    }
}

#[test]
fn where_two_things_of_the_same_glass_overlap_nothing_is_bent() {
    let text = "
render: {max_depth: 10}
lights: []
objects:
  - sphere: {radius: 2, material: &glass {transparency: 1, ior: 1.5, fresnel: true}}
  - sphere: {center: [-0.5, 0, -2], radius: 1.5, material: *glass}
";
    let seen = look(text, [0.5, 0.0, 5.0], [0.5, 0.0, 0.0]);
    let transmitted = |ray: &durer::RayExplanation| {
        ray.children.iter().find(|child| child.kind == RayKind::Transmitted).expect("light goes on").clone()
    };
    let in_first = transmitted(&seen.ray);
    let in_both = transmitted(&in_first);
    let in_second = transmitted(&in_both);
    let outside = transmitted(&in_second);
    let shapes = [&seen.ray, &in_first, &in_both, &in_second].map(|ray| ray.hit.unwrap().shape);
    assert_eq!(shapes, [0, 1, 0, 1], "into the first, into the second, out of the first, out of the second");
    assert!((in_first.direction - seen.ray.direction).length() > 0.05);
    assert_eq!([in_both.direction, in_second.direction], [in_first.direction; 2]);
    assert!((outside.direction - in_second.direction).length() > 0.05);
    // Nor is anything reflected there.
    assert_eq!([in_first.children.len(), in_both.children.len()], [1, 1]);
    assert_eq!([seen.ray.children.len(), in_second.children.len()], [2, 2]);
}

const BLOCK: &str = "
background: [0.2, 0.4, 0.6]
lights: []
objects: [box: {min: [-10, -10, -10], max: [10, 0, 10], material: {color: 0, transparency: 0.8, ior: 1.5}}]
";

/// From within the block to its upper face, at so many degrees from its normal; the face is hit at the origin.
fn from_within(text: &str, degrees: f64) -> Seen {
    let (sin, cos) = degrees.to_radians().sin_cos();
    look(text, [-sin, -cos, 0.0], [0.0, 0.0, 0.0])
}

#[test]
fn beyond_the_critical_angle_all_that_is_behind_is_the_reflected_ray() {
    let critical = (1.0_f64 / 1.5).asin().to_degrees();
    for degrees in [critical + 1e-4, 45.0, 80.0] {
        let seen = from_within(BLOCK, degrees);
        let [only] = seen.ray.children.as_slice() else { panic!("one ray goes on") };
        assert_eq!(only.kind, RayKind::Reflected);
        let (sin, cos) = degrees.to_radians().sin_cos();
        assert_vector(only.direction, [sin, -cos, 0.0]);
        assert_gray(only.weight, 0.8);
    }
    for degrees in [0.0, 30.0, critical - 1e-4] {
        let seen = from_within(BLOCK, degrees);
        let [only] = seen.ray.children.as_slice() else { panic!("one ray goes on") };
        assert_eq!(only.kind, RayKind::Transmitted);
        assert!((only.direction.x - 1.5 * degrees.to_radians().sin()).abs() < 1e-9);
        assert_color(seen.color, [0.16, 0.32, 0.48]);
    }
}

/// Tabulated for glass of 1.5 in air: 0.04 straight on, 0.0892 at 60°, 0.2531 at 75°.
#[test]
fn fresnel_divides_between_reflection_and_refraction() {
    let text = BLOCK.replace("ior: 1.5", "ior: 1.5, fresnel: true");
    for (degrees, reflected) in [(0.0_f64, 0.04), (60.0, 0.089_187), (75.0, 0.253_06)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let outside = look(&text, [-sin, cos, 0.0], [0.0, 0.0, 0.0]);
        // The same boundary passed the other way reflects as much.
        let inside = from_within(&text, (sin / 1.5).asin().to_degrees());
        for (seen, up) in [(outside, cos), (inside, -(1.0 - sin * sin / 2.25).sqrt())] {
            let [back, through] = seen.ray.children.as_slice() else { panic!("two rays go on") };
            assert_eq!([through.kind, back.kind], [RayKind::Transmitted, RayKind::Reflected]);
            assert!((f64::from(back.weight.r) / 0.8 - reflected).abs() < 5e-5, "{degrees}°: {:?}", back.weight);
            assert_gray(through.weight + back.weight, 0.8);
            assert!((back.direction.y - up).abs() < 1e-9);
        }
    }
}

#[test]
fn an_index_of_one_is_as_good_as_none() {
    let text = "
render: {max_depth: 8}
lights: [point: {position: [3, 4, 5]}]
objects:
  - plane: {point: [0, -1, 0], material: {color: {checker: {}}}}
  - sphere: {radius: 0.8, material: {color: tomato, transparency: 0.7, specular: 0.5}}
  - box: {min: [-0.2, -0.9, -0.5], max: [0.9, 0.3, 0.9], material: {color: green, transparency: [0.9, 0.5, 0.2]}}
  - cone: {base: [0, -1, -3], top: [0, 1, -3], radius: 2, material: {color: navy, reflection: 0.2}}
";
    let bent =
        |ior: &str| Front::of(scene(&text.replace("transparency", &format!("{ior}transparency"))), 48, 2.5).image;
    let straight = bent("");
    assert!(bent("ior: 1, ") == straight, "to the last bit");
    assert!(bent("ior: 1, fresnel: true, ") == straight, "to the last bit");
    assert!(bent("ior: 1.01, ") != straight, "unlike another index");
}

/// What is left is color^(d / distance).
#[test]
fn glass_takes_color_away_by_the_length_of_the_way_through_it() {
    let text = |ior: &str| {
        format!(
            "background: 1
lights: []
objects:
  - sphere:
      radius: 2
      material: {{transparency: 1, {ior}attenuation: {{color: [0.5, 0.8, 1], distance: 3}}}}"
        )
    };
    let left = |length: f64| [0.5_f64.powf(length / 3.0), 0.8_f64.powf(length / 3.0), 1.0];
    for offset in [0.0_f64, 0.7, 1.9] {
        let ray = ([offset, 0.0, 5.0], [offset, 0.0, 0.0]);
        let chord = 2.0 * (4.0 - offset * offset).sqrt();
        assert_color(look(&text(""), ray.0, ray.1).color, left(chord));
        let bent = 4.0 * (1.0 - (offset / 2.0 / 1.5).powi(2)).sqrt();
        assert_color(look(&text("ior: 1.5, "), ray.0, ray.1).color, left(bent));
    }
    // From within, only the rest of the way; and through a slab at 60°, thickness / cos 60°.
    assert_color(look(&text(""), [0.0, 0.0, 1.5], [0.0, 0.0, 0.0]).color, left(3.5));
    let slab = text("").replace("sphere:", "box:").replace("radius: 2", "min: [-9, -9, -1]\n      max: [9, 9, 1]");
    let (sin, cos) = (PI / 3.0).sin_cos();
    assert_color(look(&slab, [-5.0 * sin, 0.0, 5.0 * cos], [0.0, 0.0, 0.0]).color, left(4.0));
}

/// The innermost medium alone takes light away.
#[test]
fn in_nested_glass_each_part_of_the_way_loses_by_its_own_medium() {
    let text = "
background: 1
lights: []
objects:
  - sphere: {radius: 2, material: {transparency: 1, attenuation: {color: [0.5, 1, 1], distance: 1}}}
  - sphere: {radius: 1, material: {transparency: 1, attenuation: {color: [1, 0.25, 1], distance: 1}}}
";
    assert_color(look(text, [0.0, 0.0, 5.0], [0.0, 0.0, 0.0]).color, [0.25, 0.0625, 1.0]);
    assert_color(look(text, [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]).color, [0.5, 0.25, 1.0]);
    assert_color(look(text, [0.0, 0.0, 1.5], [0.0, 0.0, -1.0]).color, [0.5_f64.powf(1.5), 0.0625, 1.0]);
}

/// The eye is in the middle of water, and that in glass: the ray bends by 1.33 / 1.5 where it leaves the water.
#[test]
fn an_eye_inside_nested_media_is_in_the_innermost() {
    let glass = "sphere: {radius: 2, material: {transparency: 1, ior: 1.5}}";
    let water = "sphere: {radius: 1, material: {transparency: 1, ior: 1.33}}";
    for objects in [[glass, water], [water, glass]] {
        let text = format!("lights: []\nobjects: [{}]", objects.join(", "));
        let seen = look(&text, [0.6, 0.0, 0.0], [0.6, 0.0, 1.0]);
        let angle = 0.6_f64.asin() - (0.6_f64 * 1.33 / 1.5).asin();
        assert_vector(seen.after(1).direction, [angle.sin(), 0.0, angle.cos()]);
    }
}

/// A slab that reflects R at each face and lets a through between them, seen straight on: light that has gone to and fro
/// within adds up to (1 - R)² a / (1 - R² a²) behind it, and R + R (1 - R)² a² / (1 - R² a²) before it.
#[test]
fn light_that_goes_to_and_fro_in_a_slab_adds_up_to_the_series() {
    let seen = |background: &str| {
        let text = format!(
            "render: {{max_depth: 24, min_weight: 0.000001}}
background: {background}
lights: []
objects:
  - box:
      min: [-9, -1, -9]
      max: [9, 1, 9]
      material: {{transparency: 1, ior: 4, fresnel: true, attenuation: {{color: [0.5, 0.9, 1], distance: 2}}}}"
        );
        look(&text, [0.1, 5.0, 0.2], [0.1, 0.0, 0.2]).color
    };
    let r = (3.0_f64 / 5.0).powi(2);
    let inner = |a: f64| (1.0 - r).powi(2) * a / (1.0 - r * r * a * a);
    assert_color(seen("{bottom: 1, top: 0}"), [0.5, 0.9, 1.0].map(inner));
    assert_color(seen("{bottom: 0, top: 1}"), [0.5, 0.9, 1.0].map(|a| r + r * a * inner(a)));
}

/// A pane has no inside to be left in: light goes straight through, nothing is taken away behind it.
#[test]
fn sheets_bend_nothing_and_leave_no_medium_behind() {
    for sheet in [
        "rectangle: {corner: [-3, -3, 0], edges: [[6, 0, 0], [0, 6, 0]]",
        "disc: {normal: [0, 0, 1], radius: 3",
        "triangle: {vertices: [[-9, -9, 0], [9, -9, 0], [0, 9, 0]]",
        "cylinder: {base: [0, -3, -2], top: [0, 3, -2], radius: 2, open: true",
    ] {
        let text = format!(
            "background: 1
lights: []
objects:
  - {sheet}, material: {{transparency: 1, ior: 1.5, attenuation: {{color: [0.1, 0.2, 0.3], distance: 1}}}}}}"
        );
        let seen = look(&text, [0.5, 0.2, 4.0], [0.0, 0.1, 0.0]);
        assert_color(seen.color, [1.0; 3]);
        assert!((seen.after(1).direction - seen.ray.direction).length() < 1e-12);
    }
}
