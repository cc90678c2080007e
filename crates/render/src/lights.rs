//! Lights: what arrives at a point, from where.

use durer_math::{DVec3, Rgb, functions::cos};
use durer_scene::{Falloff, LightKind};

/// A lamp seen from within a hair's breadth is bright, not infinite: as bright as the strongest is without falloff. All that
/// materials make of it is then within single precision.
const BRIGHTEST: f32 = 1e12;

/// A light, compiled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    /// Colour times intensity.
    power: Rgb,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Point { position: DVec3, falloff: Falloff },
    Spot { position: DVec3, axis: DVec3, cone: Cone, falloff: Falloff },
    Directional { towards: DVec3 },
}

/// A spot's cone: full light where the cosine to the axis is at least `inner`, none where it is below `outer`.
#[derive(Clone, Copy, Debug)]
struct Cone {
    inner: f64,
    outer: f64,
}

/// What arrives at a point if nothing is in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arriving {
    /// Where the light is, from the point; unit length.
    pub(crate) direction: DVec3,
    /// How far away it is; infinite for directional lights.
    pub(crate) distance: f64,
    /// The light, on a surface that faces it.
    pub(crate) light: Rgb,
}

impl Light {
    pub(crate) fn compile(light: &durer_scene::Light) -> Light {
        let kind = match light.kind {
            LightKind::Point { position, falloff, radius: _ } => Kind::Point { position, falloff },
            LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius: _ } => {
                let cosine = |degrees: f64| cos(degrees.to_radians());
                let cone = Cone { inner: cosine(inner_half_angle_degrees), outer: cosine(half_angle_degrees) };
                Kind::Spot { position, axis: (target - position).normalize(), cone, falloff }
            }
            LightKind::Directional { direction } => Kind::Directional { towards: -direction.normalize() },
        };
        Light { power: light.color * light.classic_intensity(), kind }
    }

    /// The point that it shines from, if there is one.
    pub(crate) fn position(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Point { position, .. } | Kind::Spot { position, .. } => Some(position),
            Kind::Directional { .. } => None,
        }
    }

    /// What arrives at a point; `None` where the light does not shine.
    #[inline]
    pub(crate) fn arriving(&self, at: DVec3) -> Option<Arriving> {
        match &self.kind {
            Kind::Point { position, falloff } => self.arriving_from(*position, at, *falloff),
            Kind::Spot { position, axis, cone, falloff } => {
                let mut arriving = self.arriving_from(*position, at, *falloff)?;
                let strength = cone.strength(-arriving.direction.dot(*axis));
                arriving.light = arriving.light * strength;
                (strength > 0.0).then_some(arriving)
            }
            Kind::Directional { towards } => {
                Some(Arriving { direction: *towards, distance: f64::INFINITY, light: self.power })
            }
        }
    }

    #[inline]
    fn arriving_from(&self, position: DVec3, at: DVec3, falloff: Falloff) -> Option<Arriving> {
        let to_light = position - at;
        let squared = to_light.length_squared();
        if squared == 0.0 {
            return None;
        }
        let distance = squared.sqrt();
        let light = match falloff {
            Falloff::None => self.power,
            Falloff::InverseSquare => {
                let near = self.power * ((1.0 / squared).min(1e24) as f32);
                near.map(|component| component.min(BRIGHTEST))
            }
        };
        Some(Arriving { direction: to_light * (1.0 / distance), distance, light })
    }
}

impl Cone {
    /// 1 inside, 0 outside, between them Hermite's smooth step in the cosine.
    fn strength(&self, cosine: f64) -> f32 {
        if cosine >= self.inner {
            1.0
        } else if cosine < self.outer {
            0.0
        } else {
            let s = (cosine - self.outer) / (self.inner - self.outer);
            (s * s * (3.0 - 2.0 * s)) as f32
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_scene::Strength;

    fn light(kind: LightKind) -> Light {
        Light::compile(&durer_scene::Light { name: None, color: Rgb::WHITE, strength: Strength::Classic(0.5), kind })
    }

    #[test]
    fn falloff_none_is_constant_and_inverse_square_quarters_at_twice_the_distance() {
        let at = |falloff, x| {
            light(LightKind::Point { position: DVec3::ZERO, falloff, radius: 0.0 })
                .arriving(DVec3::X * x)
                .unwrap()
                .light
                .r
        };
        assert_eq!((at(Falloff::None, 1.0), at(Falloff::None, 7.0)), (0.5, 0.5));
        assert_eq!((at(Falloff::InverseSquare, 1.0), at(Falloff::InverseSquare, 2.0)), (0.5, 0.125));
    }

    #[test]
    fn a_hard_spots_circle_has_the_radius_of_its_cone() {
        // On a wall at distance 10, half-angle 15°: radius 10 tan 15°.
        let spot = light(LightKind::Spot {
            position: DVec3::new(0.0, 0.0, 10.0),
            target: DVec3::ZERO,
            half_angle_degrees: 15.0,
            inner_half_angle_degrees: 15.0,
            falloff: Falloff::None,
            radius: 0.0,
        });
        let radius = 10.0 * 0.267_949_192_431_122_7;
        for direction in [DVec3::X, DVec3::Y, DVec3::new(0.6, -0.8, 0.0)] {
            assert!(spot.arriving(direction * (radius - 1e-9)).is_some_and(|a| a.light.r == 0.5));
            assert!(spot.arriving(direction * (radius + 1e-9)).is_none());
        }
        assert!(spot.arriving(DVec3::new(0.0, 0.0, 20.0)).is_none(), "nothing behind it");
    }

    #[test]
    fn a_soft_spot_is_half_as_bright_midway_between_the_cosines() {
        let spot = light(LightKind::Spot {
            position: DVec3::ZERO,
            target: DVec3::X,
            half_angle_degrees: 60.0,
            inner_half_angle_degrees: 0.0,
            falloff: Falloff::None,
            radius: 0.0,
        });
        // Cosines 1 and 1/2; midway 3/4.
        let at = DVec3::new(0.75, (1.0_f64 - 0.75 * 0.75).sqrt(), 0.0);
        assert!((spot.arriving(at).unwrap().light.r - 0.25).abs() < 1e-7);
    }

    #[test]
    fn directional_light_comes_from_against_its_direction() {
        let arriving =
            light(LightKind::Directional { direction: DVec3::new(0.0, -3.0, 0.0) }).arriving(DVec3::X).unwrap();
        assert_eq!((arriving.direction, arriving.distance), (DVec3::Y, f64::INFINITY));
    }
}
