//! Lights that shine from a point or from a direction.

use durer_math::{DVec3, Rgb};

/// A light: what shines from where.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, for messages and `explain`.
    pub name: Option<String>,
    /// Colour of the light.
    pub color: Rgb,
    /// Multiplies the colour.
    pub intensity: f32,
    /// What kind of light it is, and where.
    pub kind: LightKind,
}

/// The kinds of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Shines from one point in all directions.
    Point {
        /// Where it is, in world space.
        position: DVec3,
        /// How its light weakens with distance.
        falloff: Falloff,
    },
    /// Shines from one point into a cone.
    Spot {
        /// Where it is, in world space.
        position: DVec3,
        /// The point that it is aimed at, in world space.
        target: DVec3,
        /// Angle between the cone's axis and its edge, in degrees, above 0 and at most 180. No light beyond it.
        half_angle_degrees: f64,
        /// Angle, in degrees, up to which the light is full; between it and the edge it fades smoothly. Equal to
        /// `half_angle_degrees` for a hard edge.
        inner_half_angle_degrees: f64,
        /// How its light weakens with distance.
        falloff: Falloff,
    },
    /// Shines from infinitely far away, in parallel rays.
    Directional {
        /// The direction that the light travels in (any length but zero).
        direction: DVec3,
    },
}

/// How light weakens with distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all: classic ray tracing.
    #[default]
    None,
    /// With the square of the distance, as light does: intensity is what arrives at distance 1.
    InverseSquare,
}

impl Light {
    /// What a scene that says nothing of lights is lit by: one light from above the viewer's left shoulder, as painters
    /// like it, and a weaker one from the right to open the shadows.
    pub fn default_lights() -> Vec<Light> {
        let directional = |name: &str, intensity, direction| Light {
            name: Some(name.to_owned()),
            color: Rgb::WHITE,
            intensity,
            kind: LightKind::Directional { direction },
        };
        vec![
            directional("key", 0.75, DVec3::new(1.0, -2.0, -1.5)),
            directional("fill", 0.2, DVec3::new(-2.0, -1.0, -1.0)),
        ]
    }
}
