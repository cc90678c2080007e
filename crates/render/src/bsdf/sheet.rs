//! Thin sheets of a dielectric, such as panes: two boundaries in one place, between which light goes to and fro.
//!
//! Light that gets through goes straight on. A rough sheet spreads it as much as what it reflects, as KHR_materials_transmission
//! of glTF has it: microfacets of GGX reflect it, and what gets through comes out on the other side in place of this one.

use super::fresnel;
use super::ggx::Ggx;
use super::tables::REFLECTED;
use super::warps::{cosine_hemisphere, cosine_pdf};
use super::{How, Scattered};
use durer_math::{DVec2, DVec3, Rgb};

/// A thin sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sheet {
    /// Index of refraction in it, over that around it.
    eta: f64,
    /// What color light takes on that is let through.
    tint: Rgb,
    /// Microfacets and their width, unless it is smooth.
    rough: Option<(Ggx, f64)>,
}

impl Sheet {
    pub(crate) fn new(eta: f64, tint: Rgb, ggx: Option<Ggx>) -> Sheet {
        Sheet { eta, tint, rough: ggx.map(|ggx| (ggx, ggx.even_alpha())) }
    }

    pub(crate) fn is_specular(&self) -> bool {
        self.rough.is_none()
    }

    /// The part that is reflected: with R at each boundary, R + (1-R)² R (1 + R² + R⁴ + …) = 2R / (1 + R).
    fn reflectance(&self, cos: f64) -> f64 {
        let once = fresnel::dielectric(cos, self.eta).reflectance;
        2.0 * once / (1.0 + once)
    }

    /// Of light that meets several microfacets, the part that stays on its side: the same under all angles, for light takes the
    /// same way back.
    fn average_reflectance(&self) -> f64 {
        self.reflectance(0.5)
    }

    /// What goes straight on.
    pub(crate) fn straight(&self, out: DVec3) -> Rgb {
        match self.rough {
            None => self.tint * ((1.0 - self.reflectance(out.z)) as f32),
            Some(_) => Rgb::BLACK,
        }
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        let Some((ggx, alpha)) = &self.rough else { return (Rgb::BLACK, 0.0) };
        let folded = DVec3::new(toward.x, toward.y, toward.z.abs());
        let h = (out + folded).normalize();
        let (once, cosine) = (REFLECTED.all.at(out.z, *alpha), cosine_pdf(folded.z));
        let missing = (1.0 - once) * (1.0 - REFLECTED.all.at(folded.z, *alpha));
        let several = missing / (1.0 - REFLECTED.all.average(*alpha)).max(1e-9);
        let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(folded));
        let density = ggx.density(h) / (4.0 * out.z);
        let (mut part, mut average) = (self.reflectance(out.dot(h)), self.average_reflectance());
        let tint = if toward.z > 0.0 { Rgb::WHITE } else { self.tint };
        if toward.z < 0.0 {
            (part, average) = (1.0 - part, 1.0 - average);
        }
        let value = part * density / (o + i) + average * several * cosine;
        (tint * value as f32, once * part * density / o + (1.0 - once) * average * cosine)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let Some((ggx, alpha)) = &self.rough else { return Some(self.sample_smooth(out, lobe)) };
        let once = REFLECTED.all.at(out.z, *alpha);
        let (toward, lobe, reflected) = if lobe < once {
            let h = ggx.sample(out, at);
            let cos = out.dot(h);
            (h * (2.0 * cos) - out, lobe / once, self.reflectance(cos))
        } else {
            (cosine_hemisphere(at), (lobe - once) / (1.0 - once), self.average_reflectance())
        };
        if toward.z <= 0.0 {
            return None;
        }
        let toward = if lobe < reflected { toward } else { DVec3::new(toward.x, toward.y, -toward.z) };
        let (value, pdf) = self.evaluate(out, toward);
        Scattered::spread(toward, value, pdf)
    }

    /// Without roughness.
    pub(crate) fn sample_smooth(&self, out: DVec3, lobe: f64) -> Scattered {
        if lobe < self.reflectance(out.z) {
            return Scattered::mirrored(out, Rgb::WHITE);
        }
        Scattered { direction: -out, weight: self.tint, how: How::Straight, scale: 1.0 }
    }

    /// What goes on of white light, about, to either side.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        let reflected = self.reflectance(out.z) as f32;
        self.tint * (1.0 - reflected) + Rgb::gray(reflected)
    }
}
