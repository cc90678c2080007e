//! Objects. A new shape is one more entry here, and one more variant of [`Shape`].

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, example_of, fields, record};
use super::tree::Node;
use super::value::{Item, Value};
use super::write::{FieldsOut, Out, Writer};
use durer_math::{DVec2, DVec3};
use durer_scene::{MaterialId, Object, ObjectKind, Shape, Transform};
use serde_json::{Value as Json, json};
use std::rc::Rc;

choice! { Shape, "object";
    Plane "plane": "An infinite plane.",
    example "plane: {point: [0, -1, 0], normal: [0, 1, 0]}",
    {
        point: DVec3 = DVec3::ZERO => "A point on it.";
        normal: DVec3 = DVec3::Y => "The direction it faces; any length but zero.";
    }
    Sphere "sphere": "A ball.",
    example "sphere: {center: [0, 1, 0], radius: 1}",
    {
        center: DVec3 = DVec3::ZERO => "Its middle.";
        radius: f64 = 1.0 => "Its radius, above 0.";
    }
    Box "box": "A box along the axes.",
    example "box: {min: [-1, 0, -1], max: [1, 2, 1]}",
    {
        min: DVec3 = DVec3::NEG_ONE => "One corner.";
        max: DVec3 = DVec3::ONE => "The opposite corner; every coordinate greater than that of `min`.";
    }
    Cylinder "cylinder": "A cylinder between the middles of its two ends.",
    example "cylinder: {base: [0, 0, 0], top: [0, 2, 0], radius: 0.5}",
    {
        base: DVec3 = DVec3::ZERO => "Middle of one end.";
        top: DVec3 = DVec3::Y => "Middle of the other end.";
        radius: f64 = 1.0 => "Its radius, above 0.";
        open: bool = false => "True takes the two caps away.";
    }
    Cone "cone": "A cone, or with `top_radius` a frustum.",
    example "cone: {base: [0, 0, 0], top: [0, 2, 0], radius: 1}",
    {
        base: DVec3 = DVec3::ZERO => "Middle of the base.";
        top: DVec3 = DVec3::Y => "The apex, or the middle of the top.";
        base_radius as "radius": f64 = 1.0 => "Radius of the base.";
        top_radius: f64 = 0.0 => "Radius of the top.";
        open: bool = false => "True takes the caps away.";
    }
    Disc "disc": "A flat disc, or with `inner_radius` a ring.",
    example "disc: {center: [0, 1, 0], radius: 1, inner_radius: 0.5}",
    {
        center: DVec3 = DVec3::ZERO => "Its middle.";
        normal: DVec3 = DVec3::Y => "The direction it faces; any length but zero.";
        radius: f64 = 1.0 => "Its radius, above 0.";
        inner_radius: f64 = 0.0 => "Radius of the hole, less than `radius`.";
    }
    Rectangle "rectangle": "A flat rectangle, or parallelogram. It faces the cross product of its edges.",
    example "rectangle: {corner: [-1, 0, 1], edges: [[2, 0, 0], [0, 0, -2]]}",
    {
        corner: DVec3 => "One corner.";
        edges: [DVec3; 2] => "The two edges that start at the corner.";
    }
    Triangle "triangle": "A flat triangle. It faces the side from which its vertices run counter-clockwise.",
    example "triangle: {vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}",
    {
        vertices: [DVec3; 3] => "Its vertices.";
        uvs: Option<[DVec2; 3]> = None => "Texture coordinates at the vertices; without them (0, 0), (1, 0), (0, 1).";
    }
    Torus "torus": "A ring with a round cross-section.",
    example "torus: {radius: 1, tube_radius: 0.25}",
    {
        center: DVec3 = DVec3::ZERO => "Its middle.";
        axis: DVec3 = DVec3::Y => "The direction of its axis; any length but zero.";
        radius: f64 = 1.0 => "From the middle to the middle of the tube.";
        tube_radius: f64 = 0.25 => "Radius of the tube, less than `radius`.";
    }
}

/// The fields of a group.
pub(crate) struct Members {
    objects: Vec<Object>,
}

record!(Members {
    objects: Vec<Object> => "What moves together, and shares the material unless it has its own.";
});

/// The fields that all objects have.
pub(crate) struct Placing {
    name: Option<String>,
    material: Option<MaterialId>,
    transform: Transform,
}

record!(Placing {
    name: Option<String> = None => "A name, for messages.";
    material: Option<MaterialId> = None
        => "The name of a material, or a material; without it, that of the group around it.";
    transform: Transform = Transform::default() => "Steps that move it, the first one first.";
});

const GROUP_EXAMPLE: &str =
    "group: {objects: [sphere: {radius: 1}, sphere: {center: [2, 0, 0]}], material: {color: gold}}";

/// The kinds of object: all shapes, and groups.
pub(crate) fn kinds() -> Vec<KindAbout> {
    let about = "Objects that move together.";
    let mut kinds = Shape::kinds();
    kinds.push(KindAbout { word: "group", about, example: GROUP_EXAMPLE, fields: Members::about() });
    kinds
}

impl Value for Object {
    fn noun() -> String {
        "an object".to_owned()
    }
    fn stand_in() -> Self {
        Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let words: Vec<&'static str> = Shape::WORDS.iter().map(|(word, _)| *word).chain(["group"]).collect();
        let mut from = Fields::of_kind(node, cx, "object", &words)?;
        let word = from.word();
        from.set_example(if word == "group" { GROUP_EXAMPLE } else { example_of::<Shape>(word) });
        let kind = match Shape::read(word, &mut from) {
            Some(shape) => ObjectKind::Shape(shape),
            None => ObjectKind::Group(Members::read(&mut from).objects),
        };
        let Placing { name, material, transform } = Placing::read(&mut from);
        from.finish();
        Some(Object { name, material, transform, kind })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let Object { name, material, transform, kind } = self;
        let mut out = FieldsOut::new(writer);
        let placing = Placing { name: name.clone(), material: *material, transform: transform.clone() };
        match kind {
            ObjectKind::Shape(shape) => {
                shape.write(&mut out);
                placing.write(&mut out);
                out.into_kind(shape.word())
            }
            ObjectKind::Group(objects) => {
                placing.write(&mut out);
                out.required("objects", objects);
                out.into_kind("group")
            }
            ObjectKind::Mesh(_)
            | ObjectKind::Particles(_)
            | ObjectKind::Instances(_)
            | ObjectKind::Import(_)
            | ObjectKind::Solid(_) => todo!(),
        }
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/object" })
    }
}

impl Item for Object {
    const PLURAL: &'static str = "objects";
}
