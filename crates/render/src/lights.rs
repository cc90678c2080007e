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
            LightKind::Point { position, falloff } => Kind::Point { position, falloff },
            LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff } => {
                let cosine = |degrees: f64| cos(degrees.to_radians());
                let cone = Cone { inner: cosine(inner_half_angle_degrees), outer: cosine(half_angle_degrees) };
                Kind::Spot { position, axis: (target - position).normalize(), cone, falloff }
            }
            LightKind::Directional { direction } => Kind::Directional { towards: -direction.normalize() },
        };
        Light { power: light.color * light.intensity, kind }
    }

    /// The point that it shines from, if there is one.
    pub(crate) fn position(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Point { position, .. } | Kind::Spot { position, .. } => Some(position),
            Kind::Directional { .. } => None,
        }
    }

    /// What arrives, if that is the same everywhere.
    pub(crate) fn everywhere(&self) -> Option<Rgb> {
        match self.kind {
            Kind::Point { falloff: Falloff::None, .. } | Kind::Directional { .. } => Some(self.power),
            Kind::Point { .. } | Kind::Spot { .. } => None,
        }
    }

    /// For a spot, its axis and the cosine of the angle to it beyond which it gives no light.
    pub(crate) fn cone(&self) -> Option<(DVec3, f64)> {
        match self.kind {
            Kind::Spot { axis, cone, .. } => Some((axis, cone.outer)),
            Kind::Point { .. } | Kind::Directional { .. } => None,
        }
    }

    /// What arrives at a point; `None` where the light does not shine.
    #[inline]
    pub(crate) fn arriving(&self, at: DVec3) -> Option<Arriving> {
        match &self.kind {
            Kind::Point { position, .. } | Kind::Spot { position, .. } => {
                let to_light = *position - at;
                let squared = to_light.length_squared();
                let distance = squared.sqrt();
                self.arriving_along(to_light * (1.0 / distance), distance, squared)
            }
            Kind::Directional { .. } => self.arriving_along(DVec3::ZERO, f64::INFINITY, f64::INFINITY),
        }
    }

    /// What arrives at a point from which the light is seen in a direction and at a distance, whose square is known.
    /// Directional lights know their own.
    #[inline]
    pub(crate) fn arriving_along(&self, direction: DVec3, distance: f64, squared: f64) -> Option<Arriving> {
        match &self.kind {
            Kind::Point { .. } | Kind::Spot { .. } if squared == 0.0 => None,
            Kind::Point { falloff, .. } => {
                Some(Arriving { direction, distance, light: self.fallen_off(*falloff, squared) })
            }
            Kind::Spot { axis, cone, falloff, .. } => {
                let strength = cone.strength(-direction.dot(*axis));
                let light = self.fallen_off(*falloff, squared) * strength;
                (strength > 0.0).then_some(Arriving { direction, distance, light })
            }
            Kind::Directional { towards } => {
                Some(Arriving { direction: *towards, distance: f64::INFINITY, light: self.power })
            }
        }
    }

    #[inline]
    fn fallen_off(&self, falloff: Falloff, squared: f64) -> Rgb {
        match falloff {
            Falloff::None => self.power,
            Falloff::InverseSquare => {
                let near = self.power * ((1.0 / squared).min(1e24) as f32);
                near.map(|component| component.min(BRIGHTEST))
            }
        }
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

    fn light(kind: LightKind) -> Light {
        Light::compile(&durer_scene::Light { name: None, color: Rgb::WHITE, intensity: 0.5, kind })
    }

    #[test]
    fn falloff_none_is_constant_and_inverse_square_quarters_at_twice_the_distance() {
        let at = |falloff, x| {
            light(LightKind::Point { position: DVec3::ZERO, falloff }).arriving(DVec3::X * x).unwrap().light.r
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
