//! The sheen of cloth: fibers that stand up and scatter light most where they are seen from the side.
//!
//! Fibers that are nearly upright would give back several times what they get where they are seen from the side; there they are
//! dimmed, from either side alike, until they give back no more than all.
//!
//! The distribution of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017, with the visibility of
//! Neubelt and Pettineo, "Crafting a Next-Gen Material Pipeline for The Order: 1886", 2013; as glTF's KHR_materials_sheen.

use super::tables::SHEEN;
use durer_math::{DVec3, Rgb, functions::pow_wide};
use std::f64::consts::PI;

/// A sheen above something else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sheen {
    color: Rgb,
    roughness: f64,
}

/// Fibers that stand straighter are taken to be like this.
const LEAST_ROUGHNESS: f64 = 0.1;

impl Sheen {
    /// Of roughness 0 to 1, whose square is the distribution's.
    pub(crate) fn new(color: Rgb, roughness: f64) -> Sheen {
        Sheen { color, roughness: roughness.clamp(LEAST_ROUGHNESS, 1.0) }
    }

    /// The scattering function times the cosine of `toward`.
    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> Rgb {
        let dimmed = self.given_back(out.z).max(self.given_back(toward.z)).max(1.0);
        self.color * ((value(out, toward, self.roughness) * toward.z / dimmed) as f32)
    }

    /// What fibers give back that are not dimmed.
    fn given_back(&self, cos: f64) -> f64 {
        SHEEN.at(cos, self.roughness * self.roughness)
    }

    /// What it gives back of white light from everywhere, at most.
    pub(crate) fn albedo(&self, cos: f64) -> Rgb {
        self.color * self.given_back(cos).min(1.0) as f32
    }

    /// What is taken of light that goes on to what is below.
    pub(crate) fn taken(&self, cos: f64) -> f64 {
        f64::from(self.albedo(cos).max_component())
    }
}

/// The scattering function of white fibers.
pub(super) fn value(out: DVec3, toward: DVec3, roughness: f64) -> f64 {
    let roughness = roughness.max(LEAST_ROUGHNESS);
    let per_alpha = 1.0 / (roughness * roughness);
    let h = (out + toward).normalize_or_zero();
    let sin2 = (1.0 - h.z * h.z).max(0.0);
    let density = (2.0 + per_alpha) * f64::from(pow_wide(sin2, (0.5 * per_alpha) as f32)) / (2.0 * PI);
    density / (4.0 * (out.z + toward.z - out.z * toward.z))
}
