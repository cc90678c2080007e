//! Microfacets with the distribution of Trowbridge and Reitz ("GGX"), stretched along x and y.
//!
//! Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014. Directions are in the local frame; `h` are normals of
//! microfacets, which have h.z > 0.

use super::BROAD;
use durer_math::{DVec2, DVec3, functions::cos_sin_of_turns};
use std::f64::consts::PI;

/// A distribution of microfacets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ggx {
    /// Width along x and y, above 0.
    alpha: DVec2,
}

/// What is smoother than this reflects like a mirror: its highlights are below a sixteenth of a degree.
const SMOOTH: f64 = 1e-3;

impl Ggx {
    /// The distribution for roughness from 0 to 1 as users give it: squared, as in glTF, so that equal steps look equal.
    /// Anisotropy from -1 to 1 stretches highlights along x, or if negative along y. `None` if the surface is smooth.
    ///
    /// With aspect² = 1 - 0.9 |anisotropy|: Burley, "Physically Based Shading at Disney", 2012.
    pub(crate) fn of_roughness(roughness: f64, anisotropy: f64) -> Option<Ggx> {
        let alpha = (roughness * roughness).min(1.0);
        if anisotropy == 0.0 {
            return Ggx::new(DVec2::splat(alpha));
        }
        let aspect = (1.0 - 0.9 * anisotropy.abs().min(1.0)).sqrt();
        let (along, across) = ((alpha / aspect).min(1.0), alpha * aspect);
        Ggx::new(if anisotropy > 0.0 { DVec2::new(along, across) } else { DVec2::new(across, along) })
    }

    /// As [`Ggx::of_roughness`], but with glTF's measure of anisotropy from 0 to 1, which widens highlights along x only
    /// (KHR_materials_anisotropy).
    pub(crate) fn widened(roughness: f64, anisotropy: f64) -> Option<Ggx> {
        let alpha = (roughness * roughness).min(1.0);
        Ggx::new(DVec2::new(alpha + (1.0 - alpha) * anisotropy * anisotropy, alpha))
    }

    /// The distribution with these widths; `None` if the surface is smooth.
    pub(crate) fn new(alpha: DVec2) -> Option<Ggx> {
        (alpha.max_element() >= SMOOTH).then(|| Ggx { alpha: alpha.max(DVec2::splat(0.1 * SMOOTH)) })
    }

    /// True if it spreads light [broadly](super::Bsdf::is_broad), along both axes.
    pub(crate) fn is_broad(&self) -> bool {
        self.alpha.min_element() >= BROAD
    }

    /// The width of an even distribution that is about as rough.
    pub(crate) fn even_alpha(&self) -> f64 {
        if self.alpha.x == self.alpha.y { self.alpha.x } else { (self.alpha.x * self.alpha.y).sqrt() }
    }

    /// D: the area of microfacets with normal `h`, per solid angle and area of the surface.
    #[inline]
    pub(crate) fn density(&self, h: DVec3) -> f64 {
        let (x, y) = (h.x / self.alpha.x, h.y / self.alpha.y);
        let e = x * x + y * y + h.z * h.z;
        1.0 / (PI * self.alpha.x * self.alpha.y * e * e)
    }

    /// Smith's Λ: what hides microfacets from a direction, per area seen.
    #[inline]
    pub(crate) fn lambda(&self, w: DVec3) -> f64 {
        let (x, y) = (w.x * self.alpha.x, w.y * self.alpha.y);
        let z2 = w.z * w.z;
        if z2 == 0.0 {
            return f64::INFINITY;
        }
        0.5 * ((1.0 + (x * x + y * y) / z2).sqrt() - 1.0)
    }

    /// G₁: the part of microfacets that is seen.
    #[inline]
    pub(crate) fn masking(&self, w: DVec3) -> f64 {
        1.0 / (1.0 + self.lambda(w))
    }

    /// G₂: the part that is both seen and lit; correlated by height.
    #[inline]
    pub(crate) fn masking_shadowing(&self, a: DVec3, b: DVec3) -> f64 {
        1.0 / (1.0 + self.lambda(a) + self.lambda(b))
    }

    /// The density with which [`Ggx::sample`] finds `h`, per its solid angle: that of visible normals.
    #[cfg(test)]
    pub(crate) fn visible_pdf(&self, out: DVec3, h: DVec3) -> f64 {
        self.masking(out) * self.density(h) * out.dot(h).max(0.0) / out.z
    }

    /// A normal as often as it is seen from `out`, which is above the surface.
    ///
    /// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
    #[inline]
    pub(crate) fn sample(&self, out: DVec3, at: DVec2) -> DVec3 {
        let stretched = DVec3::new(self.alpha.x * out.x, self.alpha.y * out.y, out.z).normalize();
        let z = 1.0 - at.x * (1.0 + stretched.z);
        let sin = (1.0 - z * z).max(0.0).sqrt();
        let (cos_phi, sin_phi) = cos_sin_of_turns(at.y);
        let h = DVec3::new(sin * cos_phi, sin * sin_phi, z) + stretched;
        // Rounding may leave it a hair below the horizon, or, across the cap, nothing of it.
        DVec3::new(h.x * self.alpha.x, h.y * self.alpha.y, h.z.max(1e-12)).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::super::chi_square::{directions, sample_follows_pdf, sphere_integral};
    use super::*;

    fn distributions() -> impl Iterator<Item = Ggx> {
        [(0.08, 0.08), (0.3, 0.3), (1.0, 1.0), (0.1, 0.6)].into_iter().map(|(x, y)| Ggx::new(DVec2::new(x, y)).unwrap())
    }

    /// ∫ D (h·n) dh = 1, and what is seen from any direction fills the surface's projection: ∫ G₁ D max(0, w·h) dh = w·n.
    #[test]
    fn microfacets_cover_the_surface() {
        for ggx in distributions() {
            let covered = sphere_integral(&|h| if h.z > 0.0 { ggx.density(h) * h.z } else { 0.0 });
            assert!((covered - 1.0).abs() < 2e-4, "{ggx:?}: {covered}");
            for out in directions() {
                let seen = sphere_integral(&|h| if h.z > 0.0 { ggx.visible_pdf(out, h) } else { 0.0 });
                assert!((seen - 1.0).abs() < 1e-3, "{ggx:?} from {out}: {seen}");
            }
        }
    }

    #[test]
    fn normals_are_found_as_often_as_they_are_seen() {
        for ggx in distributions() {
            for out in directions() {
                let pdf = |h: DVec3| if h.z > 0.0 { ggx.visible_pdf(out, h) } else { 0.0 };
                sample_follows_pdf(&format!("{ggx:?} from {out}"), &|_, at| Some(ggx.sample(out, at)), &pdf);
            }
        }
    }

    #[test]
    fn anisotropy_stretches_but_never_beyond_one() {
        let ggx = Ggx::of_roughness(0.5, 0.8).unwrap();
        assert!((ggx.alpha.x * ggx.alpha.y - 0.0625).abs() < 1e-12 && ggx.alpha.x > ggx.alpha.y);
        assert_eq!(Ggx::of_roughness(0.5, -0.8).unwrap().alpha, DVec2::new(ggx.alpha.y, ggx.alpha.x));
        assert_eq!(Ggx::of_roughness(1.0, 1.0).unwrap().alpha.x, 1.0);
        assert_eq!(Ggx::of_roughness(0.03, 0.0), None);
    }
}
