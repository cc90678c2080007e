//! Lights and cameras, which look along the -z axis of their nodes.

use super::super::ModelError;
use super::nodes::Graph;
use super::source::Source;
use super::value::Value;
use durer_math::{DAffine3, DVec3, Rgb};
use durer_scene::{Camera, Falloff, Light, LightKind, Projection, Strength};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The brightest light that scenes allow.
const BRIGHTEST: f64 = 1e6;
/// Spots need a cone that is not empty.
const LEAST_HALF_ANGLE: f64 = 1e-4;

/// The light of KHR_lights_punctual that a node carries.
pub(super) fn light<'a>(
    source: &Source<'a>,
    graph: &Graph,
    index: usize,
    node: &Value<'a>,
) -> Result<Option<Light>, ModelError> {
    let Some(reference) = node.extension("KHR_lights_punctual")? else { return Ok(None) };
    let lights = source.root.extension("KHR_lights_punctual")?;
    let lights = lights.ok_or_else(|| reference.fault("the file has no lights"))?.list("lights")?;
    let which = reference.required_whole("light")?;
    let light = lights.object(which)?.ok_or_else(|| reference.fault(format!("there is no light {which}")))?;
    let Some(frame) = Frame::of(&graph.world_from_node(index, node.place)?) else {
        source.notes.add("lights and cameras are left out whose nodes are scaled to nothing", node.place);
        return Ok(None);
    };
    if light.has("range") {
        source.notes.add("the range of lights is not used: they reach as far as light does", light.place);
    }
    let kind = match light.text("type")? {
        Some("directional") => LightKind::Directional { direction: frame.ahead },
        Some("point") => LightKind::Point { position: frame.position, falloff: Falloff::InverseSquare, radius: 0.0 },
        Some("spot") => spot(&light, &frame)?,
        _ => return Err(light.fault("`type` must be directional, point or spot")),
    };
    let color = light.numbers::<3>("color")?.unwrap_or([1.0; 3]);
    let intensity = light.number("intensity")?.unwrap_or(1.0);
    let name = node.name().or_else(|| light.name());
    source.budget.spend(1, size_of::<Light>() + name.as_ref().map_or(0, String::len), node.place)?;
    Ok(Some(Light {
        name,
        color: Rgb::from(color.map(|component| component.clamp(0.0, BRIGHTEST) as f32)),
        // A white matte surface gives back 1/π of the light that falls on it to each side; that of a classic renderer
        // gives back all.
        strength: Strength::Classic((intensity / PI).clamp(0.0, BRIGHTEST) as f32),
        kind,
    }))
}

fn spot(light: &Value<'_>, frame: &Frame) -> Result<LightKind, ModelError> {
    let (mut inner, mut outer) = (0.0, FRAC_PI_4);
    if let Some(cone) = light.object("spot")? {
        inner = cone.number("innerConeAngle")?.unwrap_or(inner);
        outer = cone.number("outerConeAngle")?.unwrap_or(outer);
    }
    let outer = outer.clamp(LEAST_HALF_ANGLE, FRAC_PI_2);
    Ok(LightKind::Spot {
        position: frame.position,
        target: frame.position + frame.ahead,
        half_angle_degrees: outer.to_degrees(),
        inner_half_angle_degrees: inner.clamp(0.0, outer).to_degrees(),
        falloff: Falloff::InverseSquare,
        radius: 0.0,
    })
}

/// The camera that a node carries.
pub(super) fn camera<'a>(
    source: &Source<'a>,
    graph: &Graph,
    index: usize,
    node: &Value<'a>,
) -> Result<Option<Camera>, ModelError> {
    let Some((_, camera)) = source.referred(node, "camera", "cameras")? else { return Ok(None) };
    let Some(frame) = Frame::of(&graph.world_from_node(index, node.place)?) else {
        source.notes.add("lights and cameras are left out whose nodes are scaled to nothing", node.place);
        return Ok(None);
    };
    let projection = match (camera.object("perspective")?, camera.object("orthographic")?) {
        (Some(perspective), _) => {
            let angle = perspective.number("yfov")?.ok_or_else(|| perspective.fault("`yfov` is missing"))?;
            if !(1e-6..PI - 1e-6).contains(&angle) {
                return Err(perspective.fault(format!("yfov must be between 0 and π, not {angle}")));
            }
            Projection::FieldOfView { degrees: angle.to_degrees() }
        }
        (None, Some(orthographic)) => {
            let half = orthographic.number("ymag")?.ok_or_else(|| orthographic.fault("`ymag` is missing"))?.abs();
            if !(1e-9..=1e9).contains(&half) {
                return Err(orthographic.fault(format!("ymag must be a usable length, not {half}")));
            }
            Projection::Orthographic { height: 2.0 * half }
        }
        (None, None) => return Err(camera.fault("this camera is neither perspective nor orthographic")),
    };
    let Frame { position, ahead, up } = frame;
    Ok(Some(Camera { position, look_at: position + ahead, up, projection, lens: None }))
}

/// Where a node looks from and to.
struct Frame {
    position: DVec3,
    /// Unit length.
    ahead: DVec3,
    /// Unit length, at right angles to `ahead`.
    up: DVec3,
}

impl Frame {
    /// `None` for a node whose axes are no directions.
    fn of(world_from_node: &DAffine3) -> Option<Frame> {
        let ahead = (-world_from_node.matrix3.z_axis).try_normalize()?;
        let up = world_from_node.matrix3.y_axis.try_normalize()?;
        let up = (up - ahead * up.dot(ahead)).try_normalize()?;
        Some(Frame { position: world_from_node.translation, ahead, up })
    }
}
