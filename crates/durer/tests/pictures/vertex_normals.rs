//! Shading normals: light falls as on the smooth surface that a mesh stands for, but never through its triangles.

use crate::objects::{ball, mesh, moved, square, with, with_material};
use crate::support::{Point, Seen, assert_vector, look_in, scene};
use durer::math::DVec3;
use durer::scene::{MeshData, TransformStep};
use durer::{RayExplanation, RayKind};

/// Looks at a fine ball, squeezed to the ellipsoid (x/2)² + y² + (z/½)² = 1.
fn ellipsoid(material: &str, from: Point, to: Point) -> Seen {
    let text = format!("lights: [point: {{position: [5, 6, 7]}}]\nmaterials: {{m: {{{material}}}}}");
    let squeeze = TransformStep::Scale(DVec3::new(2.0, 1.0, 0.5));
    look_in(with(scene(&text), [moved(with_material(mesh(ball(200)), 0), vec![squeeze])]), from, to)
}

/// The gradient of the ellipsoid's equation.
fn normal(p: DVec3) -> DVec3 {
    DVec3::new(p.x / 4.0, p.y, 4.0 * p.z).normalize()
}

#[test]
fn a_fine_ball_is_shaded_as_a_smooth_one() {
    for (x, y) in [(0.0, 0.0), (0.7, 0.3), (-1.5, 0.2), (0.4, -0.8)] {
        let seen = ellipsoid("reflection: 0.5", [x, y, 5.0], [x, y, 0.0]);
        let hit = seen.hit();
        let (smooth, flat) = (normal(hit.point), hit.normal);
        // Triangles of 1/200 of half a turn are off by up to half that angle, interpolated normals by its square.
        assert!((hit.shading_normal - smooth).length() < 1e-4, "{} {smooth}", hit.shading_normal);
        assert!((flat - smooth).length() > 1e-4, "and the triangles themselves are flat");
        let mirrored = DVec3::NEG_Z - smooth * (2.0 * DVec3::NEG_Z.dot(smooth));
        assert!((seen.after(1).direction - mirrored).length() < 2e-4);
        let to_light = (DVec3::new(5.0, 6.0, 7.0) - hit.point).normalize();
        assert!((seen.ray.lights[0].cosine - smooth.dot(to_light)).abs() < 1e-4);
    }
}

#[test]
fn normals_bend_light_too() {
    let (x, y) = (0.4, 0.3);
    let seen = ellipsoid("transparency: 1, ior: 1.5", [x, y, 5.0], [x, y, 0.0]);
    let n = normal(seen.hit().point);
    let (cos, eta) = (n.z, 1.0 / 1.5);
    let onward = DVec3::NEG_Z * eta + n * (eta * cos - (1.0 - eta * eta * (1.0 - cos * cos)).sqrt());
    assert!((seen.after(1).direction - onward).length() < 2e-4);
    // From inside, the same normals look inwards.
    let inside = seen.after(1);
    let hit = inside.hit.expect("the far side");
    assert!((hit.shading_normal + normal(hit.point)).length() < 1e-4 && !hit.from_outside);
}

/// A square with one normal all over, of length 3.
fn tilted(material: &str, normal: DVec3, lights: &str) -> durer::Scene {
    let normals = vec![(normal * 3.0).to_array().map(|x| x as f32); 4];
    let text = format!("lights: [{lights}]\nmaterials: {{m: {{{material}}}}}");
    with(scene(&text), [with_material(mesh(MeshData { normals, ..square() }), 0)])
}

/// 60° from the square's own normal, towards x; single precision.
fn towards_x() -> DVec3 {
    DVec3::new(0.75_f64.sqrt(), 0.0, 0.5)
}

fn assert_near(found: DVec3, expected: Point) {
    assert!((found - DVec3::from(expected)).length() < 1e-6, "found {found}, expected {expected:?}");
}

#[test]
fn light_from_below_does_not_come_through() {
    let cosine = |position: &str| {
        let scene = tilted("color: 1", towards_x(), &format!("point: {{position: {position}}}"));
        look_in(scene, [0.1, 0.2, 3.0], [0.1, 0.2, 0.0]).ray.lights[0].cosine
    };
    assert!((cosine("[0.1, 0.2, 5]") - 0.5).abs() < 1e-6, "of the normal given");
    assert!((cosine("[5.1, 0.2, 0.01]") - 0.75_f64.sqrt()).abs() < 2e-3);
    assert!(cosine("[5.1, 0.2, -0.01]") <= 0.0, "the normal would see it");
    assert!(cosine("[-5, 0.2, 1]") < 0.0, "the square would see it");
}

fn child(seen: &Seen, kind: RayKind) -> &RayExplanation {
    seen.ray.children.iter().find(|ray| ray.kind == kind).expect("such a ray")
}

/// The mirror image is at 120° from the square's normal; folded over, at 60°.
#[test]
fn what_would_be_mirrored_into_the_surface_is_folded_back() {
    let seen = look_in(tilted("reflection: 1", towards_x(), ""), [0.1, 0.2, 3.0], [0.1, 0.2, 0.0]);
    assert_near(child(&seen, RayKind::Reflected).direction, [0.75_f64.sqrt(), 0.0, 0.5]);
    // 30°, where nothing has to be folded.
    let mild = DVec3::new(0.5, 0.0, 0.75_f64.sqrt());
    let seen = look_in(tilted("reflection: 1", mild, ""), [0.1, 0.2, 3.0], [0.1, 0.2, 0.0]);
    assert_near(child(&seen, RayKind::Reflected).direction, [0.75_f64.sqrt(), 0.0, 0.5]);
}

/// Seen from the left at 10° above the square, the normal is 50° beyond the edge of sight: it counts as if it were there.
#[test]
fn normals_that_look_away_are_turned_to_the_edge_of_sight() {
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let scene = tilted("reflection: 1", towards_x(), "");
    let seen = look_in(scene, [-2.0 * cos, 0.0, 2.0 * sin], [0.0, 0.0, 0.0]);
    assert_near(seen.hit().shading_normal, [sin, 0.0, cos]);
    // Grazing, so the mirror image goes straight on, and is folded up.
    assert_near(child(&seen, RayKind::Reflected).direction, [cos, 0.0, sin]);
}

/// Behind a pane of glass with such normals a ray goes on behind it, whatever the normals say.
#[test]
fn what_would_be_refracted_back_is_folded_on() {
    let box_of_glass = |from: Point| {
        let mut data = crate::objects::cube([-1.0; 3], [1.0; 3]);
        data.normals = vec![[0.99, 0.0, 0.141]; 8];
        let text = "render: {max_depth: 2}\nlights: []\nmaterials: {m: {transparency: 1, ior: 0.6}}";
        look_in(with(scene(text), [with_material(mesh(data), 0)]), from, [0.0, 0.0, 1.0])
    };
    for x in [-3.0, -1.0, 0.0, 1.0, 3.0] {
        for ray in &box_of_glass([x, 0.0, 3.0]).ray.children {
            let side = if ray.kind == RayKind::Reflected { 1.0 } else { -1.0 };
            assert!(ray.direction.z * side > 0.0, "{x}: {:?} goes {}", ray.kind, ray.direction);
            assert!((ray.direction.length() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn both_sides_of_a_mesh_have_normals() {
    let scene = tilted("color: 1", towards_x(), "point: {position: [0.1, 0.2, -4]}");
    let seen = look_in(scene, [0.1, 0.2, -3.0], [0.1, 0.2, 0.0]);
    assert_near(seen.hit().shading_normal, [-0.75_f64.sqrt(), 0.0, -0.5]);
    assert!((seen.ray.lights[0].cosine - 0.5).abs() < 1e-6);
}

/// Opposite normals cancel out halfway: there the square's own counts.
#[test]
fn where_normals_cancel_out_the_triangle_is_flat() {
    let normals = vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let scene = with(scene("lights: []"), [mesh(MeshData { normals, ..square() })]);
    let seen = look_in(scene, [0.0, 0.5, 3.0], [0.0, 0.5, 0.0]);
    assert_vector(seen.hit().shading_normal, [0.0, 0.0, 1.0]);
}
