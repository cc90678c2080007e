//! Lights.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, choice_value, example_of, fields, record};
use super::tree::Node;
use super::value::{Item, Value};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_math::{DVec3, Rgb};
use durer_scene::{Falloff, Light, LightKind, Strength};
use serde_json::{Value as Json, json};
use std::rc::Rc;

choice! { LightKind, "light";
    Point "point": "Shines from one point in all directions.",
    example "point: {position: [4, 6, 5], intensity: 0.8}",
    {
        position: DVec3 => "Where it is.";
        falloff: Falloff = Falloff::None => "How its light weakens with distance; `inverse_square` with `power` and `radiant_intensity`.";
        radius: f64 = 0.0 => "Of the ball that shines, for soft shadows.";
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
        falloff: Falloff = Falloff::None => "How its light weakens with distance; `inverse_square` with `power` and `radiant_intensity`.";
        radius: f64 = 0.0 => "Of the ball that shines, for soft shadows.";
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
    power: Option<f32>,
    radiant_intensity: Option<f32>,
    irradiance: Option<f32>,
    name: Option<String>,
}

record!(Shine {
    color: Rgb = Rgb::WHITE => "Color of the light.";
    intensity: f32 = 1.0 => "Multiplies the color: what a white matte surface shows that faces the light.";
    power: Option<f32> = None => "Instead of `intensity`, of points and spots: all of the light, in watts.";
    radiant_intensity: Option<f32> = None => "Instead of `intensity`, of points and spots: in watts per steradian.";
    irradiance: Option<f32> = None => "Instead of `intensity`, of directional lights: in watts per square unit of length.";
    name: Option<String> = None => "A name, for messages.";
});

impl Shine {
    fn strength(&self, from: &mut Fields<'_, '_, '_>) -> Strength {
        let given: Vec<&str> = UNITS.into_iter().filter(|unit| from.has(unit)).collect();
        if let [first, second, ..] = given[..] {
            let complaint =
                Complaint::error(from.span_of(second), format!("`{first}` and `{second}` contradict each other"));
            from.break_with(complaint.help("keep one of them").also(from.span_of(first), "the first"));
        }
        match (self.power, self.radiant_intensity, self.irradiance) {
            (Some(watts), _, _) => Strength::Power(watts),
            (None, Some(amount), _) => Strength::RadiantIntensity(amount),
            (None, None, Some(amount)) => Strength::Irradiance(amount),
            (None, None, None) => Strength::Classic(self.intensity),
        }
    }

    fn of(light: &Light) -> Shine {
        let Light { name, color, strength, kind: _ } = light;
        let (mut intensity, mut power, mut radiant_intensity, mut irradiance) = (1.0, None, None, None);
        match *strength {
            Strength::Classic(amount) => intensity = amount,
            Strength::Power(amount) => power = Some(amount),
            Strength::RadiantIntensity(amount) => radiant_intensity = Some(amount),
            Strength::Irradiance(amount) => irradiance = Some(amount),
        }
        Shine { color: *color, intensity, power, radiant_intensity, irradiance, name: name.clone() }
    }
}

const UNITS: [&str; 4] = ["intensity", "power", "radiant_intensity", "irradiance"];

/// Light in units of physics weakens as physics has it, unless the file says otherwise.
fn with_usual_falloff(kind: LightKind, strength: Strength, from: &Fields<'_, '_, '_>) -> LightKind {
    let mut kind = kind;
    if let LightKind::Point { falloff, .. } | LightKind::Spot { falloff, .. } = &mut kind
        && matches!(strength, Strength::Power(_) | Strength::RadiantIntensity(_))
        && !from.has("falloff")
    {
        *falloff = Falloff::InverseSquare;
    }
    kind
}

impl Value for Light {
    fn noun() -> String {
        "a light".to_owned()
    }
    fn stand_in() -> Self {
        let kind = LightKind::Point { position: DVec3::ZERO, falloff: Falloff::None, radius: 0.0 };
        Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(1.0), kind }
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let words = LightKind::WORDS.iter().map(|(word, _)| *word).collect::<Vec<_>>();
        let mut from = Fields::of_kind(node, cx, "light", &words)?;
        let word = from.word();
        from.set_example(example_of::<LightKind>(word));
        let kind = LightKind::read(word, &mut from);
        let shine = Shine::read(&mut from);
        let strength = shine.strength(&mut from);
        let kind = kind.map(|kind| with_usual_falloff(kind, strength, &from));
        from.finish();
        Some(Light { name: shine.name, color: shine.color, strength, kind: kind? })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let mut out = FieldsOut::new(writer);
        self.kind.write(&mut out);
        Shine::of(self).write(&mut out);
        out.into_kind(self.kind.word())
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/light" })
    }
}

impl Item for Light {
    const PLURAL: &'static str = "lights";
}
