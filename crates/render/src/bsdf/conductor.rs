//! Metals: rough ones by GGX with what meets several microfacets, smooth ones as mirrors.

use super::fresnel::Reflectance;
use super::ggx::Ggx;
use super::tables::REFLECTED;
use super::warps::{cosine_hemisphere, cosine_pdf};
use super::{How, Scattered};
use durer_math::{DVec2, DVec3, Rgb};

/// A metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conductor {
    reflectance: Reflectance,
    /// Its microfacets, unless it is smooth.
    rough: Option<Rough>,
}

/// Microfacets that reflect all light or some.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rough {
    ggx: Ggx,
    alpha: f64,
    /// The color of light that meets several microfacets, over what is missing of it from everywhere.
    multiple: Rgb,
}

impl Conductor {
    /// `average` is the mean of the reflectance over all directions.
    pub(crate) fn new(reflectance: Reflectance, average: Rgb, ggx: Option<Ggx>) -> Conductor {
        let rough = ggx.map(|ggx| {
            let alpha = ggx.even_alpha();
            Rough { ggx, alpha, multiple: multiple(average, REFLECTED.all.average(alpha)) }
        });
        Conductor { reflectance, rough }
    }

    pub(crate) fn is_broad(&self) -> bool {
        self.rough.is_some_and(|rough| rough.ggx.is_broad())
    }

    pub(crate) fn is_specular(&self) -> bool {
        self.rough.is_none()
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        let Some(Rough { ggx, alpha, multiple }) = &self.rough else { return (Rgb::BLACK, 0.0) };
        if toward.z <= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        let h = (out + toward).normalize();
        let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
        let density = ggx.density(h) / (4.0 * out.z);
        let (single_o, single_i) = (REFLECTED.all.at(out.z, *alpha), REFLECTED.all.at(toward.z, *alpha));
        let cosine = cosine_pdf(toward.z);
        let single = self.reflectance.at(out.dot(h)) * ((density / (o + i)) as f32);
        let several = *multiple * (((1.0 - single_o) * (1.0 - single_i) * cosine) as f32);
        (single + several, single_o * density / o + (1.0 - single_o) * cosine)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let Some(Rough { ggx, alpha, .. }) = &self.rough else {
            return Some(Scattered::mirrored(out, self.reflectance.at(out.z)));
        };
        let toward = if lobe < REFLECTED.all.at(out.z, *alpha) {
            let h = ggx.sample(out, at);
            h * (2.0 * out.dot(h)) - out
        } else {
            cosine_hemisphere(at)
        };
        let (value, pdf) = self.evaluate(out, toward);
        Scattered::spread(toward, value, pdf)
    }

    /// What is given back of white light from everywhere, about.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        match &self.rough {
            None => self.reflectance.at(out.z),
            Some(_) => self.reflectance.at(out.z.max(0.2)),
        }
    }
}

/// The color of light that meets several microfacets, if `average` of it is left at each and `single` leaves after the first;
/// over what does not. Kulla and Conty 2017, with the correction that white stays white: F̄² Ē / (1 - F̄ (1 - Ē)) / (1 - Ē).
pub(crate) fn multiple(average: Rgb, single: f64) -> Rgb {
    let (single, missing) = (single as f32, (1.0 - single) as f32);
    if missing < 1e-5 {
        return Rgb::BLACK;
    }
    average.map(|f| f * f * single / ((1.0 - f * missing) * missing))
}

impl Scattered {
    /// Into the mirrored direction alone.
    pub(super) fn mirrored(out: DVec3, weight: Rgb) -> Scattered {
        Scattered { direction: DVec3::new(-out.x, -out.y, out.z), weight, how: How::Only, scale: 1.0 }
    }

    /// Into a direction among others, of which value and density are known.
    pub(super) fn spread(direction: DVec3, value: Rgb, pdf: f64) -> Option<Scattered> {
        let weight = value * ((1.0 / pdf) as f32);
        (pdf > 0.0 && weight.is_finite()).then_some(Scattered {
            direction,
            weight,
            how: How::Spread { pdf },
            scale: 1.0,
        })
    }
}
