//! Solids as seen: whose material is where, what is inside, and that they move and copy like all else.

use crate::objects::{ball, copies, cube, group, instances, mesh, moved, part, with, with_material};
use crate::support::{Front, assert_color, assert_gray, assert_vector, look_in, scene};
use durer::math::{DVec3, Rgb};
use durer::scene::{MaterialId, MeshData, Object, ObjectKind, Operation, Scene, Shape, Solid, TransformStep};
use durer::{CompiledScene, Element};

fn solid(operation: Operation, operands: Vec<Object>) -> Object {
    Object::new(ObjectKind::Solid(Solid { operation, operands }))
}

fn sphere(z: f64, radius: f64) -> Object {
    Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::new(0.0, 0.0, z), radius }))
}

fn exact_box(min: [f64; 3], max: [f64; 3]) -> Object {
    Object::new(ObjectKind::Shape(Shape::Box { min: min.into(), max: max.into() }))
}

const COLORS: &str = "
lights: []
background: 0
materials:
  red: {color: [1, 0, 0], ambient: 1}
  green: {color: [0, 1, 0], ambient: 1}
  blue: {color: [0, 0, 1], ambient: 1}
  striped: {color: {stripes: {width: 0.2, axis: [1, 1, 0], colors: [white, navy]}}, ambient: 1}
";

fn from_front(scene: &Scene, x: f64, y: f64) -> crate::support::Seen {
    look_in(scene.clone(), [x, y, 9.0], [x, y, 0.0])
}

/// A ball takes a bite of radius 1 out of a box whose front is at z = 1: at r from the axis the bite is √(1 - r²) deep.
#[test]
fn surfaces_keep_the_material_of_the_operand_that_they_come_from() {
    let seen = |block: Option<u32>, bite: Option<u32>, own: Option<u32>, around: u32| {
        let material = |object, id: Option<u32>| Object { material: id.map(MaterialId), ..object };
        let operands = vec![material(exact_box([-2.0; 3], [2.0, 2.0, 1.0]), block), material(sphere(1.0, 1.0), bite)];
        let bitten = material(solid(Operation::Difference, operands), own);
        let scene = with(scene(COLORS), [with_material(group(vec![bitten]), around)]);
        let (front, inside) = (from_front(&scene, 1.5, 0.3), from_front(&scene, 0.3, 0.4));
        assert_vector(front.hit().point, [1.5, 0.3, 1.0]);
        assert_vector(inside.hit().point, [0.3, 0.4, 1.0 - 0.75_f64.sqrt()]);
        assert_vector(inside.hit().normal, [-0.3, -0.4, 0.75_f64.sqrt()]);
        assert_eq!(front.hit().element, Element::Operand { index: 0 });
        assert_eq!(inside.hit().element, Element::Operand { index: 1 });
        [front.hit().material, inside.hit().material].map(|id| id.map(|id| id.0))
    };
    assert_eq!(seen(Some(0), Some(1), Some(2), 2), [Some(0), Some(1)]);
    assert_eq!(seen(Some(0), None, Some(2), 1), [Some(0), Some(2)]);
    assert_eq!(seen(None, Some(1), None, 2), [Some(2), Some(1)]);
    assert_eq!(seen(None, None, None, 2), [Some(2), Some(2)]);
}

/// A union of opaque things looks like the things.
#[test]
fn a_union_looks_like_its_operands() {
    let things = || {
        let turn = TransformStep::Rotate { axis: DVec3::new(1.0, 2.0, 3.0), degrees: 30.0 };
        let turned = moved(with_material(exact_box([-0.7; 3], [0.7, 0.5, 0.7]), 3), vec![turn]);
        vec![with_material(sphere(0.3, 0.8), 3), group(vec![turned, with_material(sphere(0.9, 0.4), 0)])]
    };
    let image = |objects: Vec<Object>| Front::of(with(scene(COLORS), objects), 64, 2.5).image;
    let (apart, together) = (image(things()), image(vec![solid(Operation::Union, things())]));
    let differing = apart.pixels.iter().zip(&together.pixels).filter(|(a, b)| a != b).count();
    assert!(differing <= 2, "{differing} pixels, where two things meet");
}

/// Two balls of radius 2, whose middles are 2 apart: a lens 2 thick.
#[test]
fn what_is_inside_is_the_solids_own_or_that_of_its_first_operand() {
    let text = "background: 1
lights: []
materials:
  dark: {transparency: 1, attenuation: {color: 0.5, distance: 1}}
  darker: {transparency: 1, attenuation: {color: 0.25, distance: 1}}
  clear: {transparency: 1}";
    let lens = |first: u32, second: u32, own: Option<u32>| {
        let operands = vec![with_material(sphere(-1.0, 2.0), first), with_material(sphere(1.0, 2.0), second)];
        let lens = Object { material: own.map(MaterialId), ..solid(Operation::Intersection, operands) };
        with(scene(text), [lens])
    };
    let through = |scene: Scene| look_in(scene, [0.0, 0.0, 9.0], [0.0, 0.0, 0.0]).color;
    assert_gray(through(lens(0, 1, None)), 0.25);
    assert_gray(through(lens(1, 0, None)), 0.0625);
    assert_gray(through(lens(0, 0, Some(1))), 0.0625);
    assert_gray(through(lens(2, 2, Some(0))), 0.25);
    assert_gray(through(lens(0, 1, Some(2))), 1.0);
    // The eye within it; then light that comes through it.
    assert_gray(look_in(lens(0, 1, None), [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]).color, 0.5_f64.powf(1.5));
    let lit = |from: f64| {
        let mut scene =
            with(lens(0, 1, None), scene("objects: [plane: {point: [0, 0, -5], normal: [0, 0, 1]}]").objects);
        scene.lights = crate::support::scene(&format!("lights: [point: {{position: [0, 0, {from}]}}]")).lights;
        look_in(scene, [0.5, 0.0, -4.0], [0.0, 0.0, -5.0]).ray.lights[0].visibility
    };
    assert_gray(lit(5.0), 0.25);
    assert_gray(lit(0.5), 0.5_f64.powf(1.5));
}

#[test]
fn textures_of_operands_are_in_their_own_space() {
    let turned = || {
        let steps = vec![
            TransformStep::Scale(DVec3::new(1.0, 0.6, 0.8)),
            TransformStep::Rotate { axis: DVec3::new(1.0, 2.0, 3.0), degrees: 50.0 },
            TransformStep::Translate(DVec3::new(0.2, 0.1, 0.0)),
        ];
        moved(with_material(exact_box([-1.0; 3], [1.0; 3]), 3), steps)
    };
    let far = || sphere(-50.0, 1.0);
    let whole = |object| moved(object, vec![TransformStep::Rotate { axis: DVec3::Y, degrees: 20.0 }]);
    let image = |object| Front::of(with(scene(COLORS), [object]), 64, 2.5).image;
    let alone = image(whole(group(vec![turned()])));
    let cut = image(whole(solid(Operation::Difference, vec![group(vec![turned()]), far()])));
    let differing = alone.pixels.iter().zip(&cut.pixels).filter(|(a, b)| a != b).count();
    assert!(differing <= 2, "{differing} pixels, at edges of stripes");
}

#[test]
fn solids_are_copied_like_all_else() {
    let thing = || {
        let bite = with_material(sphere(0.5, 0.5), 1);
        let cut = solid(Operation::Difference, vec![with_material(exact_box([-0.5; 3], [0.5; 3]), 3), bite]);
        solid(Operation::Union, vec![cut, with_material(sphere(-0.5, 0.3), 0)])
    };
    let places = [DVec3::ZERO, DVec3::new(0.9, 0.7, -1.0), DVec3::new(-1.0, -0.4, 0.5)];
    let written = places.map(|place| moved(group(vec![thing()]), vec![TransformStep::Translate(place)]));
    let [copied, written] = [vec![instances(copies(vec![thing()], places.to_vec()))], written.to_vec()]
        .map(|objects| Front::of(with(scene(COLORS), objects), 64, 4.0).image);
    assert!(copied == written, "to the last bit");
}

/// One corner of a mesh of parts, colours and normals is cut away by a box.
#[test]
fn meshes_bring_all_they_have_into_a_solid() {
    let parts = vec![part(0, 10, Some(0)), part(10, 2, Some(1))];
    let die = MeshData { parts, ..cube([-1.0; 3], [1.0; 3]) };
    let corner = with_material(exact_box([0.0; 3], [2.0; 3]), 2);
    let cut = |mesh: MeshData| {
        with(scene(COLORS), [solid(Operation::Difference, vec![crate::objects::mesh(mesh), corner.clone()])])
    };
    let parted = cut(die.clone());
    // The last two triangles are the face at z = 1; the box's own face is at z = 0.
    assert_color(from_front(&parted, -0.5, 0.3).color, [0.0, 1.0, 0.0]);
    assert_color(look_in(parted.clone(), [-9.0, 0.2, 0.3], [0.0, 0.2, 0.3]).color, [1.0, 0.0, 0.0]);
    let inside = from_front(&parted, 0.5, 0.3);
    assert_color(inside.color, [0.0, 0.0, 1.0]);
    assert!(inside.hit().point.z.abs() < 1e-9);

    let colors = die.positions.iter().map(|p| Rgb::from(p.map(|c| 0.5 + 0.5 * c))).collect();
    let colored = cut(MeshData { colors, parts: Vec::new(), ..die });
    assert_color(from_front(&colored, -0.5, 0.25).color.map(|c| c / 0.2), [0.25, 0.625, 1.0]);

    let smooth = cut(ball(64));
    let hit = from_front(&smooth, -0.5, 0.25).hit();
    assert!((hit.shading_normal - hit.point.normalize()).length() < 1e-3);
    assert!((hit.normal - hit.point.normalize()).length() > 1e-3);
}

#[test]
fn memory_is_known() {
    let hole = |i: u32| sphere(f64::from(i), 0.1);
    let holes =
        solid(Operation::Difference, [exact_box([-1.0; 3], [1.0; 3])].into_iter().chain((0..9).map(hole)).collect());
    let compiled = |objects: Vec<Object>| -> CompiledScene { crate::support::compile(with(scene(COLORS), objects)) };
    let one = compiled(vec![holes.clone()]).geometry_memory();
    assert!(one.solids > 10 * 200, "{one:?}");
    let places = (0..100).map(|i| DVec3::X * f64::from(i)).collect();
    let many = compiled(vec![instances(copies(vec![holes, mesh(ball(10))], places))]).geometry_memory();
    assert_eq!((many.solids, many.triangles), (one.solids, 400), "copies share");
    assert!(many.shapes < 200 * 600, "{many:?}");
    assert_eq!(many.total(), many.shapes + many.meshes + many.solids);
}
