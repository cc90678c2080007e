//! Lights that shine from a point or from a direction.

use durer_math::{DVec3, Rgb, functions::cos};
use std::f64::consts::PI;

/// A light: what shines from where.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, for messages and `explain`.
    pub name: Option<String>,
    /// Color of the light.
    pub color: Rgb,
    /// Multiplies the color.
    pub strength: Strength,
    /// What kind of light it is, and where.
    pub kind: LightKind,
}

/// How much light there is, in one of several units. Each holds for red, green and blue alone, before the color multiplies
/// them.
///
/// A white Lambertian surface that faces a lamp of the classic strength I shows the radiance I (with
/// [`Falloff::InverseSquare`], at distance 1): the irradiance is π·I. The physical units give what physics says: a surface of
/// albedo ρ under the irradiance E shows the radiance ρ/π·E.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strength {
    /// What a white matte surface shows that faces the light.
    Classic(f32),
    /// Of points and spots, in the direction where they shine fully: in watts per steradian. Only with
    /// [`Falloff::InverseSquare`].
    RadiantIntensity(f32),
    /// Of points and spots, all of their light: in watts. Only with [`Falloff::InverseSquare`].
    Power(f32),
    /// Of directional lights, on a surface across the light: in watts per square unit of length.
    Irradiance(f32),
}

impl Strength {
    /// The number alone.
    pub fn amount(self) -> f32 {
        match self {
            Strength::Classic(amount)
            | Strength::RadiantIntensity(amount)
            | Strength::Power(amount)
            | Strength::Irradiance(amount) => amount,
        }
    }

    /// The same unit with another number.
    #[must_use]
    pub fn with_amount(self, amount: f32) -> Strength {
        match self {
            Strength::Classic(_) => Strength::Classic(amount),
            Strength::RadiantIntensity(_) => Strength::RadiantIntensity(amount),
            Strength::Power(_) => Strength::Power(amount),
            Strength::Irradiance(_) => Strength::Irradiance(amount),
        }
    }
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
        /// Of the ball that shines, which makes shadows soft; 0 for a point. Its size does not change how much light there
        /// is, as seen from outside.
        radius: f64,
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
        /// Of the ball that shines into the cone, which makes shadows soft; 0 for a point.
        radius: f64,
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
    /// The strength as [`Strength::Classic`] has it, whatever its unit. A spot's power is spread over its cone, where the
    /// light of the soft edge, smooth in the cosine, is in the mean half of the full one.
    pub fn classic_intensity(&self) -> f32 {
        let steradians = match self.kind {
            LightKind::Point { .. } => 4.0 * PI,
            LightKind::Spot { half_angle_degrees, inner_half_angle_degrees, .. } => {
                let cosine = |degrees: f64| cos(degrees.to_radians());
                PI * (2.0 - cosine(half_angle_degrees) - cosine(inner_half_angle_degrees))
            }
            // Has no power, and the check refuses it.
            LightKind::Directional { .. } => PI,
        };
        match self.strength {
            Strength::Classic(intensity) => intensity,
            Strength::RadiantIntensity(amount) | Strength::Irradiance(amount) => (f64::from(amount) / PI) as f32,
            Strength::Power(watts) => (f64::from(watts) / (steradians * PI)) as f32,
        }
    }

    /// What a scene that says nothing of lights is lit by: one light from above the viewer's left shoulder, as painters
    /// like it, and a weaker one from the right to open the shadows.
    pub fn default_lights() -> Vec<Light> {
        let directional = |name: &str, intensity, direction| Light {
            name: Some(name.to_owned()),
            color: Rgb::WHITE,
            strength: Strength::Classic(intensity),
            kind: LightKind::Directional { direction },
        };
        vec![
            directional("key", 0.75, DVec3::new(1.0, -2.0, -1.5)),
            directional("fill", 0.2, DVec3::new(-2.0, -1.0, -1.0)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn intensity(strength: Strength, kind: LightKind) -> f64 {
        Light { name: None, color: Rgb::WHITE, strength, kind }.classic_intensity().into()
    }

    fn spot(half_angle_degrees: f64, inner_half_angle_degrees: f64) -> LightKind {
        let (position, target, falloff) = (DVec3::ZERO, DVec3::X, Falloff::InverseSquare);
        LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius: 0.0 }
    }

    #[test]
    fn physical_units_give_what_physics_says() {
        let point = LightKind::Point { position: DVec3::ZERO, falloff: Falloff::InverseSquare, radius: 0.0 };
        let sun = LightKind::Directional { direction: DVec3::NEG_Y };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6 * b, "{a} is not {b}");
        // A white surface at distance 1 from I = P/4π has the irradiance I, and shows E/π.
        near(intensity(Strength::Power(40.0), point), 40.0 / (4.0 * PI) / PI);
        near(intensity(Strength::RadiantIntensity(5.0), point), 5.0 / PI);
        near(intensity(Strength::Irradiance(3.0), sun), 3.0 / PI);
        near(intensity(Strength::Classic(0.5), sun), 0.5);
        // A hard spot of 60 degrees covers 2π (1 - cos 60°) = π; a spot in all directions is a point.
        near(intensity(Strength::Power(7.0), spot(60.0, 60.0)), 7.0 / PI / PI);
        near(intensity(Strength::Power(7.0), spot(180.0, 180.0)), intensity(Strength::Power(7.0), point));
    }

    /// The power of a soft spot, summed ring by ring.
    #[test]
    fn a_soft_spot_gives_off_its_power() {
        let (outer, inner) = (50.0_f64, 20.0_f64);
        let full = intensity(Strength::Power(9.0), spot(outer, inner)) * PI;
        let (low, high) = (cos(outer.to_radians()), cos(inner.to_radians()));
        let rings = 100_000;
        let ring = |at: u32| {
            let cosine = 1.0 - (1.0 - low) * (f64::from(at) + 0.5) / f64::from(rings);
            let s = ((cosine - low) / (high - low)).clamp(0.0, 1.0);
            full * s * s * (3.0 - 2.0 * s) * 2.0 * PI * (1.0 - low) / f64::from(rings)
        };
        let total: f64 = (0..rings).map(ring).sum();
        assert!((total - 9.0).abs() < 1e-5, "{total}");
    }
}
