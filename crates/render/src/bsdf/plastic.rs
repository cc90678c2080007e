//! Plastic: a clear coat over a matte base. Light that gets through the coat is spread by the base, and what the coat holds
//! back from inside comes to the base again and again.
//!
//! As "plastic" and "roughplastic" of Mitsuba (Jakob 2010): with `a` the base's color, F the part held back inside, and E(ω)
//! what the coat reflects, the base gives (1 - E(o)) (1 - E(i)) / (π (1 - Ē)) · a (1 - F) / (1 - a F). All of white is given
//! back by a white base, whatever the coat.

use super::Scattered;
use super::fresnel;
use super::ggx::Ggx;
use super::tables::DIELECTRIC;
use super::warps::{cosine_hemisphere, cosine_pdf};
use durer_math::{DVec2, DVec3, Rgb};

/// A coat over a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plastic {
    /// Index of refraction of the coat, over that around it, above 1.
    eta: f64,
    /// What the base gives of light that gets through the coat and out again.
    base: Rgb,
    /// How probable it is that light is looked for in the base, over that in the coat's reflection, for equal amounts.
    base_weight: f64,
    /// 1 - Ē: what the coat lets in of light from everywhere.
    entering: f64,
    rough: Option<(Ggx, f64)>,
}

impl Plastic {
    /// A coat with the relative index `eta` (at least 1) over a base of this color.
    pub(crate) fn new(eta: f64, color: Rgb, ggx: Option<Ggx>) -> Plastic {
        let rough = ggx.map(|ggx| (ggx, ggx.even_alpha()));
        let entering = 1.0
            - match rough {
                Some((_, alpha)) => DIELECTRIC.reflected_average(alpha, eta),
                None => fresnel::dielectric_average(eta),
            };
        let held_back = (1.0 - entering / (eta * eta)) as f32;
        let base = color.map(|a| a * (1.0 - held_back) / (1.0 - a * held_back));
        Plastic { eta, base, base_weight: f64::from(base.max_component()), entering, rough }
    }

    /// E(ω): what the coat reflects.
    fn reflected(&self, cos: f64) -> f64 {
        match self.rough {
            Some((_, alpha)) => DIELECTRIC.reflected(cos, alpha, self.eta),
            None => fresnel::dielectric(cos, self.eta).reflectance,
        }
    }

    pub(crate) fn is_broad(&self) -> bool {
        self.rough.is_none_or(|(ggx, _)| ggx.is_broad())
    }

    pub(crate) fn is_specular(&self) -> bool {
        false
    }

    /// The probability of the coat's reflection, if it reflects so much.
    fn coat_probability(&self, reflected: f64) -> f64 {
        let base = (1.0 - reflected) * self.base_weight;
        if base == 0.0 { 1.0 } else { (reflected / (reflected + base)).max(0.05) }
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        if toward.z <= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        let (reflected_o, reflected_i) = (self.reflected(out.z), self.reflected(toward.z));
        let coat = self.coat_probability(reflected_o);
        let cosine = cosine_pdf(toward.z);
        let mut value = self.base * (((1.0 - reflected_o) * (1.0 - reflected_i) / self.entering * cosine) as f32);
        let mut pdf = (1.0 - coat) * cosine;
        if let Some((ggx, _)) = &self.rough {
            let h = (out + toward).normalize();
            let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
            let density = ggx.density(h) / (4.0 * out.z);
            let reflectance = fresnel::dielectric(out.dot(h), self.eta).reflectance;
            value += Rgb::gray((reflectance * density / (o + i)) as f32);
            pdf += coat * density / o;
        }
        (value, pdf)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let reflected = self.reflected(out.z);
        let coat = self.coat_probability(reflected);
        let toward = match (&self.rough, lobe < coat) {
            (None, true) => return Some(Scattered::mirrored(out, Rgb::gray((reflected / coat) as f32))),
            (Some((ggx, _)), true) => {
                let h = ggx.sample(out, at);
                h * (2.0 * out.dot(h)) - out
            }
            (_, false) => cosine_hemisphere(at),
        };
        let (value, pdf) = self.evaluate(out, toward);
        Scattered::spread(toward, value, pdf)
    }

    /// What is given back of white light from everywhere.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        let reflected = self.reflected(out.z) as f32;
        self.base * (1.0 - reflected) + Rgb::gray(reflected)
    }
}
