//! Lights.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, choice_value, example_of, fields, record};
use super::tree::Node;
use super::value::{Item, Value};
use super::write::{FieldsOut, Out, Writer};
use durer_math::{DVec3, Rgb};
use durer_scene::{Falloff, Light, LightKind};
use serde_json::{Value as Json, json};
use std::rc::Rc;

choice! { LightKind, "light";
    Point "point": "Shines from one point in all directions.",
    example "point: {position: [4, 6, 5], intensity: 0.8}",
    {
        position: DVec3 => "Where it is.";
        falloff: Falloff = Falloff::None => "How its light weakens with distance.";
    }
    Spot "spot": "Shines from one point into a cone.",
    example "spot: {position: [0, 5, 0], target: [0, 0, -2], half_angle: 20, inner_half_angle: 15}",
    {
        position: DVec3 => "Where it is.";
        target: DVec3 => "The point that it is aimed at.";
        half_angle_degrees as "half_angle": f64 = 30.0
            => "Angle between the axis of the cone and its edge, in degrees, above 0 and at most 180.";
        inner_half_angle_degrees as "inner_half_angle": f64 = half_angle_degrees
            => "Angle, in degrees, up to which the light is full; from there it fades to the edge." same as "half_angle";
        falloff: Falloff = Falloff::None => "How its light weakens with distance.";
    }
    Directional "directional": "Shines from infinitely far away, in parallel rays, like the sun.",
    example "directional: {direction: [-1, -2, -1], color: lightyellow}",
    {
        direction: DVec3 => "The direction that the light travels in; any length but zero.";
    }
}

choice! { Falloff, "falloff";
    None "none": "Not at all, as in classic ray tracing.", example "falloff: none", {}
    InverseSquare "inverse_square": "With the square of the distance, as light does: `intensity` is what arrives at distance 1.",
    example "falloff: inverse_square", {}
}
choice_value!(Falloff, Falloff::None);

/// The fields that all lights have.
pub(crate) struct Shine {
    color: Rgb,
    intensity: f32,
    name: Option<String>,
}

record!(Shine {
    color: Rgb = Rgb::WHITE => "Color of the light.";
    intensity: f32 = 1.0 => "Multiplies the color.";
    name: Option<String> = None => "A name, for messages.";
});

impl Value for Light {
    fn noun() -> String {
        "a light".to_owned()
    }
    fn stand_in() -> Self {
        let kind = LightKind::Point { position: DVec3::ZERO, falloff: Falloff::None };
        Light { name: None, color: Rgb::WHITE, intensity: 1.0, kind }
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let words = LightKind::WORDS.iter().map(|(word, _)| *word).collect::<Vec<_>>();
        let mut from = Fields::of_kind(node, cx, "light", &words)?;
        let word = from.word();
        from.set_example(example_of::<LightKind>(word));
        let kind = LightKind::read(word, &mut from);
        let Shine { color, intensity, name } = Shine::read(&mut from);
        from.finish();
        Some(Light { name, color, intensity, kind: kind? })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let mut out = FieldsOut::new(writer);
        self.kind.write(&mut out);
        let Light { color, intensity, ref name, .. } = *self;
        Shine { color, intensity, name: name.clone() }.write(&mut out);
        out.into_kind(self.kind.word())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/light" })
    }
}

impl Item for Light {
    const PLURAL: &'static str = "lights";
}
