//! How light is scattered at a point of a surface, in a frame whose z axis is the shading normal, on the side that the ray
//! came from. Directions point away from the surface and have unit length.

use durer_math::{DVec2, DVec3, Rgb, functions};
use std::f64::consts::PI;

/// How light is scattered at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bsdf {
    diffuse: Rgb,
}

/// A direction chosen at random.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    /// Where the path goes on; below the surface (z < 0) if light gets through.
    pub(crate) direction: DVec3,
    /// The scattering function times |cos θ|, divided by the density.
    pub(crate) weight: Rgb,
    pub(crate) how: How,
}

/// How a direction was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum How {
    /// Among all directions, with this density (per solid angle), which [`Bsdf::evaluate`] gives, too.
    Spread { pdf: f64 },
    /// It is the only one: mirrors, smooth glass.
    Only,
    /// As if there were no surface: straight on. Shadow rays go this way, too.
    Straight,
}

impl Bsdf {
    /// Lambert's: the part `albedo` of light in all directions.
    pub(crate) fn diffuse(albedo: Rgb) -> Bsdf {
        Bsdf { diffuse: albedo }
    }

    /// True if it scatters light only into directions that cannot be found by aiming at lights.
    pub(crate) fn is_specular(&self) -> bool {
        false
    }

    /// The scattering function times |cos θ| of `toward`, and the density with which [`Bsdf::sample`] finds it.
    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        if out.z <= 0.0 || toward.z <= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        let pdf = toward.z / PI;
        (self.diffuse * pdf as f32, pdf)
    }

    /// A direction to go on in: `lobe` chooses how, `at` where.
    pub(crate) fn sample(&self, out: DVec3, _lobe: f64, at: DVec2) -> Option<Scattered> {
        if out.z <= 0.0 {
            return None;
        }
        let (radius, angle) = (at.x.sqrt(), 2.0 * PI * at.y);
        let (x, y) = (radius * functions::cos(angle), radius * functions::sin(angle));
        let z = (1.0 - at.x).max(0.0).sqrt();
        let pdf = z / PI;
        (z > 0.0).then_some(Scattered {
            direction: DVec3::new(x, y, z),
            weight: self.diffuse,
            how: How::Spread { pdf },
        })
    }

    /// The part of white light from everywhere that is scattered, about: the albedo of layers for denoisers.
    pub(crate) fn albedo(&self) -> Rgb {
        self.diffuse
    }
}
