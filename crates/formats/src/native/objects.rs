//! Objects. A new shape is one more entry here, and one more variant of [`Shape`].

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, fields, record};
use super::tree::Node;
use super::value::{Item, Value};
use super::write::{FieldsOut, Out, Writer};
use super::{instances, meshes, models, particles};
use durer_math::{DVec2, DVec3};
use durer_scene::{Import, MaterialId, Object, ObjectKind, Operation, Shape, Solid, Transform};
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

/// The fields of a solid.
pub(crate) struct Operands {
    objects: Vec<Object>,
}

record!(Operands {
    objects: Vec<Object> => "Closed shapes, closed meshes, solids, and groups of these. A plane is closed: all behind it is inside.";
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

/// A kind: its word, what it is, an example, its fields.
type OtherKind = (&'static str, &'static str, &'static str, fn() -> Vec<FieldAbout>);

/// The kinds of object that are not read field by field into what they are.
const OTHERS: [OtherKind; 7] = [
    (
        "group",
        "Objects that move together.",
        "group: {objects: [sphere: {radius: 1}, sphere: {center: [2, 0, 0]}], material: {color: gold}}",
        Members::about,
    ),
    (
        "mesh",
        "A triangle mesh: a model file with one mesh in it, or written out.",
        "mesh: {vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}",
        meshes::Written::about,
    ),
    (
        "import",
        "All that a model file holds: objects and materials, lights, and a camera, which is used if the scene has none.",
        "import: {file: room.glb}",
        models::Written::about,
    ),
    (
        "instances",
        "Copies of the same objects, by the million.",
        "instances: {objects: [sphere: {radius: 0.2}], positions: [[0, 0, 0], [1, 0, 0]], scale: [1, 2]}",
        instances::Written::about,
    ),
    (
        "union",
        "One solid: what is in any of its objects.",
        "union: {objects: [sphere: {radius: 1}, box: {min: [0, 0, 0]}]}",
        Operands::about,
    ),
    (
        "intersection",
        "One solid: what is in all of its objects.",
        "intersection: {objects: [sphere: {radius: 1.2}, box], material: {color: gold}}",
        Operands::about,
    ),
    (
        "difference",
        "One solid: what is in the first of its objects, but in none of the others. Cut surfaces have the material of the object that cuts, if it has one.",
        "difference: {objects: [box, sphere: {radius: 1.2}], material: {color: gold}}",
        Operands::about,
    ),
];

/// The kinds of object.
pub(crate) fn kinds() -> Vec<KindAbout> {
    let others = OTHERS.map(|(word, about, example, fields)| KindAbout { word, about, example, fields: fields() });
    Shape::kinds().into_iter().chain(particles::Written::kinds()).chain(others).collect()
}

/// The words for the kinds, and an example of each.
fn words() -> impl Iterator<Item = (&'static str, &'static str)> {
    let others = OTHERS.iter().map(|(word, _, example, _)| (*word, *example));
    Shape::WORDS.iter().chain(particles::Written::WORDS).copied().chain(others)
}

/// Reads the fields of the kind `word`.
fn read(word: &str, from: &mut Fields<'_, '_, '_>) -> ObjectKind {
    let mut solid = |operation| {
        let operands = Operands::read(from).objects;
        ObjectKind::Solid(Solid { operation, operands })
    };
    match word {
        "union" => solid(Operation::Union),
        "intersection" => solid(Operation::Intersection),
        "difference" => solid(Operation::Difference),
        "group" => ObjectKind::Group(Members::read(from).objects),
        "mesh" => ObjectKind::Mesh(meshes::Written::read(from).resolve(from)),
        "import" => ObjectKind::Import(models::Written::read(from).resolve(from)),
        "instances" => ObjectKind::Instances(instances::Written::read(from).resolve(from)),
        word => match (Shape::read(word, from), particles::Written::read(word, from)) {
            (Some(shape), _) => ObjectKind::Shape(shape),
            (None, Some(particles)) => ObjectKind::Particles(particles.resolve(from)),
            // No word but those of `words` comes here.
            (None, None) => ObjectKind::Group(Vec::new()),
        },
    }
}

impl Value for Object {
    fn noun() -> String {
        "an object".to_owned()
    }
    fn stand_in() -> Self {
        Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let known: Vec<&'static str> = words().map(|(word, _)| word).collect();
        let mut from = Fields::of_kind(node, cx, "object", &known)?;
        let word = from.word();
        from.set_example(words().find(|(known, _)| *known == word).map_or("", |(_, example)| example));
        let kind = read(word, &mut from);
        let Placing { name, material, transform } = Placing::read(&mut from);
        from.finish();
        Some(Object { name, material, transform, kind })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let Object { name, material, transform, kind } = self;
        let mut out = FieldsOut::new(writer);
        let placing = Placing { name: name.clone(), material: *material, transform: transform.clone() };
        // What has a list of objects has it last, since it may be long.
        match kind {
            ObjectKind::Shape(shape) => shape.write(&mut out),
            ObjectKind::Mesh(mesh) => meshes::Written::from(mesh).write(&mut out),
            ObjectKind::Particles(many) => particles::Written::from(many).write(&mut out),
            ObjectKind::Import(Import { file, .. }) => models::Written { file: file.clone() }.write(&mut out),
            ObjectKind::Group(_) | ObjectKind::Instances(_) | ObjectKind::Solid(_) => {}
        }
        placing.write(&mut out);
        match kind {
            // Straight, since a record would hold a copy of all objects.
            ObjectKind::Group(objects) => out.required("objects", objects),
            ObjectKind::Solid(solid) => out.required("objects", &solid.operands),
            ObjectKind::Instances(copies) => instances::Written::from(copies).write(&mut out),
            ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) | ObjectKind::Import(_) => {}
        }
        out.into_kind(kind.word())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/object" })
    }
}

impl Item for Object {
    const PLURAL: &'static str = "objects";
}
