//! Boundaries of glass, water and the like, smooth or rough: light is reflected, or bent and let through.
//!
//! Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007. As in pbrt, paths carry radiance:
//! what is let through into a medium that is η times as dense is spread over fewer directions, and radiance there is η² times
//! as great. So a path's weight is divided by η² where it enters, and the division is undone where it leaves.

use super::fresnel;
use super::ggx::Ggx;
use super::tables::DIELECTRIC;
use super::warps::{cosine_hemisphere, cosine_pdf};
use super::{How, Scattered};
use durer_math::{DVec2, DVec3, Rgb};

/// Of what the eye sees of smooth glass, as many samples as this look at what it mirrors, at least: in a thousand things under a
/// sun, most of the noise of glass was its glints. More would make what is behind noisy.
const SEEN: f64 = 0.1;

/// A boundary between dielectrics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dielectric {
    /// Index of refraction behind it, over that before it; not 1.
    eta: f64,
    /// What color light takes on that is let through.
    tint: Rgb,
    /// If false, all is let through that is not reflected totally.
    reflects: bool,
    rough: Option<Rough>,
}

/// Microfacets, and what happens to light that meets several of them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rough {
    ggx: Ggx,
    alpha: f64,
    several: Several,
}

/// Light that meets several microfacets leaves evenly spread, to either side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Several {
    /// Of it, the part that stays on the side that it came from.
    back: f64,
    /// What it is on the side that it came from and on the other, over what is missing from everywhere there.
    scales: [f64; 2],
}

impl Dielectric {
    /// A boundary with the relative index `eta`.
    pub(crate) fn new(eta: f64, tint: Rgb, ggx: Option<Ggx>) -> Dielectric {
        let rough = ggx.map(|ggx| {
            let alpha = ggx.even_alpha();
            Rough { ggx, alpha, several: Several::new(alpha, eta) }
        });
        Dielectric { eta, tint, reflects: true, rough }
    }

    /// A smooth one that reflects nothing but what it must.
    pub(crate) fn without_reflection(eta: f64, tint: Rgb) -> Dielectric {
        Dielectric { eta, tint, reflects: false, rough: None }
    }

    pub(crate) fn is_specular(&self) -> bool {
        self.rough.is_none()
    }

    /// The part that is reflected under an angle with this cosine.
    fn reflectance(&self, cos: f64) -> f64 {
        let reflectance = fresnel::dielectric(cos, self.eta).reflectance;
        if self.reflects || reflectance == 1.0 { reflectance } else { 0.0 }
    }

    /// What radiance is multiplied with when it is let through.
    fn squeeze(&self) -> f64 {
        1.0 / (self.eta * self.eta)
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        let Some(Rough { ggx, alpha, several }) = &self.rough else { return (Rgb::BLACK, 0.0) };
        let once = DIELECTRIC.either(out.z, *alpha, self.eta);
        let cosine = cosine_pdf(toward.z.abs());
        if toward.z > 0.0 {
            let h = (out + toward).normalize();
            let reflectance = self.reflectance(out.dot(h));
            let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
            let density = reflectance * ggx.density(h) / (4.0 * out.z);
            let missing = (1.0 - once) * (1.0 - DIELECTRIC.either(toward.z, *alpha, self.eta));
            let value = density / (o + i) + several.back * several.scales[0] * missing * cosine;
            (Rgb::gray(value as f32), once * density / o + (1.0 - once) * several.back * cosine)
        } else {
            let missing = (1.0 - once) * (1.0 - DIELECTRIC.either(-toward.z, *alpha, 1.0 / self.eta));
            let onward = 1.0 - several.back;
            let mut value = onward * several.scales[1] * missing * cosine;
            let mut pdf = (1.0 - once) * onward * cosine;
            if let Some((h, jacobian)) = self.normal_between(out, toward) {
                let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
                let passed = 1.0 - self.reflectance(out.dot(h));
                let density = passed * ggx.density(h) * out.dot(h) / out.z * jacobian;
                value += density / (o + i);
                pdf += once * density / o;
            }
            (self.tint * ((value * self.squeeze()) as f32), pdf)
        }
    }

    /// The normal of the microfacet that bends light from one direction to the other, and the solid angle of normals per
    /// solid angle of `toward`; `None` if none does.
    fn normal_between(&self, out: DVec3, toward: DVec3) -> Option<(DVec3, f64)> {
        let h = out + toward * self.eta;
        let h = if self.eta > 1.0 { -h } else { h };
        let h = h.try_normalize()?;
        let (cos_out, cos_toward) = (out.dot(h), toward.dot(h));
        if h.z <= 0.0 || cos_out <= 0.0 || cos_toward >= 0.0 {
            return None;
        }
        let sum = cos_out + self.eta * cos_toward;
        Some((h, self.eta * self.eta * -cos_toward / (sum * sum)))
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let Some(Rough { ggx, alpha, several }) = &self.rough else { return Some(self.sample_smooth(out, lobe)) };
        let once = DIELECTRIC.either(out.z, *alpha, self.eta);
        let toward = if lobe < once {
            let lobe = lobe / once;
            let h = ggx.sample(out, at);
            let cos = out.dot(h);
            let boundary = fresnel::dielectric(cos, self.eta);
            let back = h * (2.0 * cos) - out;
            let onward = h * (cos / self.eta - boundary.cos_behind) - out / self.eta;
            let (toward, is_right) = match lobe < boundary.reflectance {
                true => (back, back.z > 0.0),
                false => (onward.normalize(), onward.z < 0.0),
            };
            if !is_right {
                return None;
            }
            toward
        } else {
            let lobe = (lobe - once) / (1.0 - once);
            let direction = cosine_hemisphere(at);
            if lobe < several.back { direction } else { -direction }
        };
        let (value, pdf) = self.evaluate(out, toward);
        let scale = if toward.z < 0.0 { self.squeeze() as f32 } else { 1.0 };
        Scattered::spread(toward, value, pdf).map(|scattered| Scattered { scale, ..scattered })
    }

    fn sample_smooth(&self, out: DVec3, lobe: f64) -> Scattered {
        let boundary = fresnel::dielectric(out.z, self.eta);
        if lobe < self.reflectance(out.z) {
            return Scattered::mirrored(out, Rgb::WHITE);
        }
        let direction = DVec3::new(-out.x / self.eta, -out.y / self.eta, -boundary.cos_behind).normalize();
        let scale = self.squeeze() as f32;
        Scattered { direction, weight: self.tint * scale, how: How::Only, scale }
    }

    /// One of the two directions of a smooth one: the mirrored one, if there is one, at least as often as [`SEEN`].
    pub(crate) fn sample_seen(&self, out: DVec3, lobe: f64) -> Option<Scattered> {
        let reflectance = self.reflectance(out.z);
        let chance = if reflectance > 0.0 { reflectance.max(SEEN) } else { 0.0 };
        let passes = lobe >= chance;
        let chance = if passes { 1.0 - chance } else { chance };
        let scattered = self.only(out, passes)?;
        Some(Scattered { weight: scattered.weight * (1.0 / chance) as f32, ..scattered })
    }

    /// The one direction to a side, if it is smooth; the chance of it is in the weight.
    pub(crate) fn only(&self, out: DVec3, passes: bool) -> Option<Scattered> {
        let reflectance = self.reflectance(out.z);
        let (lobe, chance) = if passes { (1.0, 1.0 - reflectance) } else { (-1.0, reflectance) };
        if self.rough.is_some() || chance <= 0.0 {
            return None;
        }
        let scattered = self.sample_smooth(out, lobe);
        Some(Scattered { weight: scattered.weight * chance as f32, ..scattered })
    }

    /// What goes on of white light, about, to either side.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        let reflected = self.reflectance(out.z) as f32;
        self.tint * (1.0 - reflected) + Rgb::gray(reflected)
    }
}

impl Several {
    /// That nothing is lost says how much there is in all; that light may go each way back, how it is divided: what
    /// passes from one side to the other and what passes back must be as 1 to η² (Veach 1997, §5.2), each times what is
    /// missing from everywhere on the side where it goes.
    fn new(alpha: f64, eta: f64) -> Several {
        let before = 1.0 - DIELECTRIC.either_average(alpha, eta);
        let behind = 1.0 - DIELECTRIC.either_average(alpha, 1.0 / eta);
        if before < 1e-6 || behind < 1e-6 {
            return Several { back: 1.0, scales: [0.0, 0.0] };
        }
        // Of light in the thinner medium as much is let through as a smooth boundary would, if that can be.
        let (thin, dense, n) = if eta > 1.0 { (before, behind, eta) } else { (behind, before, 1.0 / eta) };
        let from_thin = (1.0 - fresnel::dielectric_average(n)).min(dense * n * n / thin);
        let from_dense = from_thin * thin / (dense * n * n);
        let onward = if eta > 1.0 { from_thin } else { from_dense };
        Several { back: 1.0 - onward, scales: [1.0 / before, 1.0 / behind] }
    }
}
