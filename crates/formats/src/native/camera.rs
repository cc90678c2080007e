//! The camera. Its projection is one of three fields, so its reading is written out.

use super::decode::{Decoder, Fields};
use super::record::{DefaultAbout, FieldAbout, Record, fields, record, record_value};
use super::tree::Node;
use super::value::Value;
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::DVec3;
use durer_scene::{Camera, Projection};
use serde_json::Value as Json;
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

const FOV: &str = "The vertical angle of view, in degrees, between 0 and 180.";
const IMAGE_PLANE: &str = "Instead of `fov`: the angle of view by an image plane.";
const ORTHOGRAPHIC: &str = "Instead of `fov`: parallel projection.";

impl Record for Camera {
    fn read(from: &mut Fields<'_, '_, '_>) -> Self {
        let position = from.or("position", || DVec3::ZERO);
        let look_at = from.or("look_at", || position + DVec3::NEG_Z);
        let up = from.or("up", || DVec3::Y);
        Camera { position, look_at, up, projection: projection(from) }
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
