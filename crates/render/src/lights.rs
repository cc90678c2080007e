//! Lights: what arrives at a point, from where.

use durer_math::functions::{cos, sin};
use durer_math::{DVec2, DVec3, Rgb, any_orthonormal_pair};
use durer_scene::{Falloff, LightKind};
use std::f64::consts::PI;

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
    Point { ball: Ball, falloff: Falloff },
    Spot { ball: Ball, axis: DVec3, cone: Cone, falloff: Falloff },
    Directional { towards: DVec3 },
}

/// Where a lamp is. With a radius, it is a ball of even radiance that no ray sees: it lights, and casts soft shadows, but is
/// not in the picture. From outside it lights as a point in its middle does, if nothing is in the way; that is what tells a
/// surface that faces it how bright it is, and whether it is in a spot's cone.
#[derive(Clone, Copy, Debug)]
struct Ball {
    middle: DVec3,
    radius: f64,
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
            LightKind::Point { position, falloff, radius } => {
                Kind::Point { ball: Ball { middle: position, radius }, falloff }
            }
            LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius } => {
                let cosine = |degrees: f64| cos(degrees.to_radians());
                let cone = Cone { inner: cosine(inner_half_angle_degrees), outer: cosine(half_angle_degrees) };
                let ball = Ball { middle: position, radius };
                Kind::Spot { ball, axis: (target - position).normalize(), cone, falloff }
            }
            LightKind::Directional { direction } => Kind::Directional { towards: -direction.normalize() },
        };
        Light { power: light.color * light.classic_intensity(), kind }
    }

    fn ball(&self) -> Option<&Ball> {
        match &self.kind {
            Kind::Point { ball, .. } | Kind::Spot { ball, .. } => Some(ball),
            Kind::Directional { .. } => None,
        }
    }

    /// The point that it shines from, if there is one.
    pub(crate) fn position(&self) -> Option<DVec3> {
        self.ball().filter(|ball| ball.radius == 0.0).map(|ball| ball.middle)
    }

    /// That of the ball that it shines from; 0 for points and directional lights.
    #[inline]
    pub(crate) fn radius(&self) -> f64 {
        self.ball().map_or(0.0, |ball| ball.radius)
    }

    /// The middle and the radius of what it shines from, if it weakens with distance.
    pub(crate) fn place(&self) -> Option<(DVec3, f64)> {
        match &self.kind {
            Kind::Point { ball, falloff: Falloff::InverseSquare }
            | Kind::Spot { ball, falloff: Falloff::InverseSquare, .. } => Some((ball.middle, ball.radius)),
            Kind::Point { falloff: Falloff::None, .. }
            | Kind::Spot { falloff: Falloff::None, .. }
            | Kind::Directional { .. } => None,
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
        self.cones().map(|(axis, [_, outer])| (axis, outer))
    }

    /// For a spot, its axis and the cosines of the angles to it up to which it gives full light, and beyond which none.
    pub(crate) fn cones(&self) -> Option<(DVec3, [f64; 2])> {
        match self.kind {
            Kind::Spot { axis, cone, .. } => Some((axis, [cone.inner, cone.outer])),
            Kind::Point { .. } | Kind::Directional { .. } => None,
        }
    }

    /// The luminance of the irradiance on a surface that faces it; of what weakens with distance, at distance 1.
    pub(crate) fn luminance(&self) -> f64 {
        PI * f64::from(self.power.luminance()).max(0.0)
    }

    /// What arrives at a point; `None` where the light does not shine.
    #[inline]
    pub(crate) fn arriving(&self, at: DVec3) -> Option<Arriving> {
        match &self.kind {
            Kind::Point { ball, .. } | Kind::Spot { ball, .. } => {
                let to_light = ball.middle - at;
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

    /// What arrives from a place on the side of its ball that is seen from a point, chosen by two numbers from 0 to 1; `None`
    /// where it does not shine. The mean of all, times the cosine to a surface that sees all of the ball, is what arrives from
    /// its middle. From inside of the ball, which no size of a lamp keeps anyone from, it comes from all directions, and what
    /// weakens with distance is as bright as on its surface.
    pub(crate) fn arriving_from_ball(&self, at: DVec3, choice: DVec2) -> Option<Arriving> {
        let Ball { middle, radius } = *self.ball()?;
        let to_middle = middle - at;
        let squared = to_middle.length_squared();
        let outside = squared > radius * radius;
        // 1 less the cosine of the half-angle under which it is seen; inside, as wide as it gets.
        let sine2 = if outside { radius * radius / squared } else { 1.0 };
        let whole = if outside { sine2 / (1.0 + (1.0 - sine2).sqrt()) } else { 2.0 };
        let axis = to_middle.try_normalize().unwrap_or(DVec3::Y);
        let less = choice.x * whole;
        let (cosine, sine) = (1.0 - less, (less * (2.0 - less)).max(0.0).sqrt());
        let (u, v) = any_orthonormal_pair(axis);
        let angle = 2.0 * PI * choice.y;
        let direction = (axis * cosine + (u * cos(angle) + v * sin(angle)) * sine).normalize();
        let along = to_middle.dot(direction);
        let half_chord = (radius * radius - (to_middle - direction * along).length_squared()).max(0.0).sqrt();
        let distance = if outside { along - half_chord } else { along + half_chord };
        let point = self.arriving(if outside { at } else { middle - axis * radius })?;
        // Even radiance L gives π L sine2 from a ball as a whole; chosen evenly from 2π `whole`, the mean must be that.
        let light = point.light * (2.0 * whole / sine2) as f32;
        (distance > 0.0).then_some(Arriving { direction, distance, light })
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
