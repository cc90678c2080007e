//! Rough matte surfaces: Lambertian microfacets in V-shaped grooves, without loss.
//!
//! The model EON: Portsmouth, Kutz, Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", 2024. It is Fujii's
//! form of Oren and Nayar's model with a term for light that meets several microfacets.

use durer_math::{DVec3, Rgb, functions::acos};
use std::f64::consts::{FRAC_1_PI, PI};

/// A rough matte surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OrenNayar {
    color: Rgb,
    /// From 0, which is Lambert's surface, to 1.
    roughness: f64,
    /// What light from everywhere gives that meets one microfacet.
    average: f64,
    /// A: with which one microfacet's light is scaled.
    scale: f64,
    /// The color that light has which meets several.
    multiple: Rgb,
}

impl OrenNayar {
    pub(crate) fn new(color: Rgb, roughness: f64) -> OrenNayar {
        let scale = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
        let average = scale * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness);
        let multiple = color.map(|c| c * c * average as f32 / (1.0 - c * (1.0 - average as f32)));
        OrenNayar { color, roughness, average, scale, multiple }
    }

    /// What light that meets one microfacet gives back, of white.
    fn single(&self, cos: f64) -> f64 {
        let cos = cos.clamp(1e-6, 1.0);
        let sin = (1.0 - cos * cos).sqrt();
        let g = sin * (acos(cos) - sin * cos) + (2.0 / 3.0) * (sin / cos * (1.0 - sin * sin * sin) - sin);
        self.scale * (1.0 + self.roughness * FRAC_1_PI * g)
    }

    /// The scattering function times the cosine of `toward`.
    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> Rgb {
        let s = out.x * toward.x + out.y * toward.y;
        let s = if s > 0.0 { s / out.z.max(toward.z) } else { s };
        let single = self.color * ((FRAC_1_PI * self.scale * (1.0 + self.roughness * s)) as f32);
        let lost = (1.0 - self.single(out.z)).max(0.0) * (1.0 - self.single(toward.z)).max(0.0);
        let multiple = self.multiple * ((FRAC_1_PI * lost / (1.0 - self.average).max(1e-7)) as f32);
        (single + multiple) * toward.z as f32
    }

    /// What is given back of white light from everywhere.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        let single = self.single(out.z);
        self.color * single as f32 + self.multiple * (1.0 - single).max(0.0) as f32
    }
}
