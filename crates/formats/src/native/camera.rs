//! The camera. Its projection is one of three fields, so its reading is written out.

use super::decode::{Decoder, Fields};
use super::hints;
use super::record::{DefaultAbout, FieldAbout, Record, fields, record, record_value};
use super::tree::{Node, NodeKind};
use super::value::{Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::{DVec3, functions};
use durer_scene::{Camera, Focus, Lens, Projection};
use serde_json::{Value as Json, json};
use std::rc::Rc;

/// `image_plane: {…}`
#[derive(Clone, PartialEq)]
struct ImagePlane {
    distance: f64,
    half_height: f64,
}

record!(ImagePlane {
    distance: f64 => "Distance of the plane from the eye.";
    half_height: f64 => "Half the height of the picture on that plane.";
});
record_value!(ImagePlane, "image_plane", ImagePlane { distance: 1.0, half_height: 1.0 });

/// `orthographic: {…}`
#[derive(Clone, PartialEq)]
struct Orthographic {
    height: f64,
}

record!(Orthographic {
    height: f64 => "Height of the picture, in units of the scene.";
});
record_value!(Orthographic, "orthographic", Orthographic { height: 1.0 });

/// `lens: {…}`
#[derive(Clone, PartialEq)]
struct LensFields {
    radius: Option<f64>,
    f_number: Option<f64>,
    sensor: f64,
    focus: Focus,
    blades: u32,
    rotation: f64,
}

record!(LensFields {
    radius: Option<f64> = None => "Radius of the aperture, in units of the scene; with blades, that of the circle through its corners.";
    f_number: Option<f64> = None => "Instead of `radius`: focal length divided by the diameter of the aperture. The focal length follows from the angle of view and `sensor`.";
    sensor: f64 = SENSOR => "Height of the sensor behind the lens, in units of the scene; as it is, that of small-format film, if the unit is the meter.";
    focus: Focus = Focus::LookAt => "What is sharp, in a plane across the view: a distance from the eye, or a point; without it, what `look_at` says.";
    blades: u32 = 0 => "Number of the aperture's straight edges, from 3 to 64; 0 for a round one.";
    rotation: f64 = 0.0 => "Turns the aperture, in degrees, counterclockwise as the eye sees it; at 0 a corner points up.";
});
record_value!(
    LensFields,
    "lens",
    LensFields { radius: None, f_number: None, sensor: SENSOR, focus: Focus::LookAt, blades: 0, rotation: 0.0 }
);

/// Height of the picture on small-format film, in meters.
const SENSOR: f64 = 0.024;

impl Value for Focus {
    fn noun() -> String {
        "a distance, or a point [x, y, z]".to_owned()
    }
    fn stand_in() -> Self {
        Focus::LookAt
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Scalar { .. } if number_text(node).is_some() => f64::decode(node, cx).map(Focus::Distance),
            NodeKind::Sequence(_) => DVec3::decode(node, cx).map(Focus::Target),
            NodeKind::Scalar { .. } | NodeKind::Mapping(_) => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            // Words for the reference; in files the field is left out.
            Focus::LookAt => Out::Text("the point `look_at`".to_owned()),
            Focus::Distance(distance) => distance.encode(writer),
            Focus::Target(point) => point.encode(writer),
        }
    }
    fn schema() -> Json {
        json!({ "anyOf": [f64::schema(), DVec3::schema()] })
    }
    fn advice(node: &Node) -> Option<String> {
        hints::number(node)
    }
}

/// The fields of `lens`.
pub(crate) fn lens_about() -> Vec<FieldAbout> {
    LensFields::about()
}

/// The lens of a camera that projects like this.
fn lens(from: &mut Fields<'_, '_, '_>, projection: Projection) -> Option<Lens> {
    let there = from.span_of("lens");
    let fields: LensFields = from.or::<Option<LensFields>>("lens", || None)?;
    let LensFields { radius, f_number, sensor, focus, blades, rotation } = fields;
    let radius = match (radius, f_number, slope(projection)) {
        (Some(radius), None, _) => radius,
        (None, Some(f_number), Some(slope)) => {
            if !(0.01..=1e6).contains(&f_number) {
                from.break_with(Complaint::error(there, format!("f_number must be from 0.01 to 1e6, not {f_number}")));
            }
            if !(1e-9..=1e12).contains(&sensor) {
                from.break_with(Complaint::error(there, format!("sensor must be from 1e-9 to 1e12, not {sensor}")));
            }
            0.5 * sensor / slope / (2.0 * f_number)
        }
        (None, Some(_), None) => {
            let complaint =
                Complaint::error(there, "parallel projection has no focal length, so `f_number` says nothing");
            from.break_with(complaint.help("give the `radius` of the lens instead"));
            return None;
        }
        (Some(_), Some(_), _) => {
            let complaint = Complaint::error(there, "`radius` and `f_number` contradict each other");
            from.break_with(complaint.help("keep one of them"));
            return None;
        }
        (None, None, _) => {
            let complaint = Complaint::error(there, "`lens` needs `radius` or `f_number`");
            from.break_with(complaint.help("for example `lens: {radius: 0.05, focus: 4.2}`"));
            return None;
        }
    };
    Some(Lens { radius, focus, blades, rotation_degrees: rotation })
}

/// The tangent of half the angle of view, if there is one.
fn slope(projection: Projection) -> Option<f64> {
    match projection {
        Projection::FieldOfView { degrees } => Some(functions::tan((0.5 * degrees).to_radians())),
        Projection::ImagePlane { distance, half_height } => Some(half_height / distance),
        Projection::Orthographic { .. } => None,
    }
}

const FOV: &str = "The vertical angle of view, in degrees, between 0 and 180.";
const IMAGE_PLANE: &str = "Instead of `fov`: the angle of view by an image plane.";
const ORTHOGRAPHIC: &str = "Instead of `fov`: parallel projection.";
const LENS: &str = "A lens, which blurs what is nearer or further than its focus.";

impl Record for Camera {
    fn read(from: &mut Fields<'_, '_, '_>) -> Self {
        let position = from.or("position", || DVec3::ZERO);
        let look_at = from.or("look_at", || position + DVec3::NEG_Z);
        let up = from.or("up", || DVec3::Y);
        let projection = projection(from);
        Camera { position, look_at, up, projection, lens: lens(from, projection) }
    }

    fn write(&self, out: &mut FieldsOut<'_, '_>) {
        out.required("position", &self.position);
        out.required("look_at", &self.look_at);
        out.or("up", &self.up, &DVec3::Y);
        match self.projection {
            Projection::FieldOfView { degrees } => out.or("fov", &degrees, &50.0),
            Projection::ImagePlane { distance, half_height } => {
                out.required("image_plane", &ImagePlane { distance, half_height });
            }
            Projection::Orthographic { height } => out.required("orthographic", &Orthographic { height }),
        }
        if let Some(Lens { radius, focus, blades, rotation_degrees: rotation }) = self.lens {
            let radius = Some(radius);
            out.required("lens", &LensFields { radius, f_number: None, sensor: SENSOR, focus, blades, rotation });
        }
    }

    fn about() -> Vec<FieldAbout> {
        let ahead = DefaultAbout::Value(Out::Text("one unit along -z from `position`".to_owned()));
        vec![
            FieldAbout::or("position", "The eye.", &DVec3::ZERO),
            FieldAbout {
                default: ahead,
                ..FieldAbout::required::<DVec3>("look_at", "The point in the middle of the picture.")
            },
            FieldAbout::or("up", "The direction that shows upward in the picture.", &DVec3::Y),
            FieldAbout::or("fov", FOV, &50.0_f64),
            FieldAbout::or::<Option<ImagePlane>>("image_plane", IMAGE_PLANE, &None),
            FieldAbout::or::<Option<Orthographic>>("orthographic", ORTHOGRAPHIC, &None),
            FieldAbout::or::<Option<LensFields>>("lens", LENS, &None),
        ]
    }
}

fn projection(from: &mut Fields<'_, '_, '_>) -> Projection {
    let given = ["fov", "image_plane", "orthographic"].map(|key| (key, from.entry(key).map(|(key, _)| key.span)));
    let mut given = given.into_iter().filter_map(|(key, span)| Some((key, span?)));
    let first = given.next();
    if let (Some((one, there)), Some((other, here))) = (first, given.next()) {
        let complaint = Complaint::error(here, format!("`{one}` and `{other}` contradict each other"));
        from.break_with(complaint.help("keep one of them").also(there, "the first"));
    }
    match first {
        Some(("image_plane", _)) => {
            let ImagePlane { distance, half_height } = from.required("image_plane");
            Projection::ImagePlane { distance, half_height }
        }
        Some(("orthographic", _)) => {
            let Orthographic { height } = from.required("orthographic");
            Projection::Orthographic { height }
        }
        Some((_, span)) => {
            let degrees: f64 = from.required("fov");
            if degrees > 0.0 && degrees < 3.2 && degrees.fract() != 0.0 {
                let message = format!("a field of view of {degrees} degrees is very narrow");
                let help = "`fov` is given in degrees, not radians";
                let _: Option<()> = from.cx.complain(Complaint::warning(span, message).help(help));
            }
            Projection::FieldOfView { degrees }
        }
        None => Projection::FieldOfView { degrees: 50.0 },
    }
}

record_value!(Camera, "camera", Camera::default());
