//! Classic materials as physics would have them.
//!
//! The part 1 - transparency of the surface is opaque: it gives back light by Lambert's law, and around the mirrored direction
//! by Phong's lobe, with its integral scaled as Lafortune and Willems do ("Using the Modified Phong Reflectance Model for
//! Physically Based Rendering", 1994): specular (n + 2) / 2π · cosⁿ. The part `reflection` is mirrored. The rest goes through:
//! straight, or, where there is an index of refraction, bent. What would give back more than it gets is scaled down, all
//! colors alike. Ambient light is left out: it stands for light that is followed here.

use super::dielectric::Dielectric;
use super::sheet::Sheet;
use super::warps::{cosine_hemisphere, cosine_pdf};
use super::{How, Scattered};
use durer_math::{
    DVec2, DVec3, Rgb, any_orthonormal_pair,
    functions::{cos_sin_of_turns, pow_double, pow_wide},
};
use std::f64::consts::PI;

/// A classic surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Classic {
    diffuse: Rgb,
    specular: Rgb,
    shininess: f32,
    reflection: Rgb,
    transparency: Rgb,
    through: Through,
    /// The probability of each of the four above.
    chances: [f64; 4],
}

/// How light gets through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Through {
    /// As if there were nothing.
    Straight,
    /// The same, but where what is on both sides bends light alike: shadow rays do not know.
    Clear,
    /// Straight, but for what both boundaries of a thin sheet reflect.
    Sheet(Sheet),
    /// Bent.
    Bent(Dielectric),
}

/// What a classic surface is made of, as users say it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parts {
    /// Color times the part that is given back in all directions.
    pub(crate) diffuse: Rgb,
    pub(crate) specular: Rgb,
    pub(crate) shininess: f32,
    pub(crate) reflection: Rgb,
    pub(crate) transparency: Rgb,
}

impl Classic {
    pub(crate) fn new(parts: Parts, through: Through) -> Classic {
        let opaque = Rgb::WHITE - parts.transparency;
        let (diffuse, specular) = (opaque * parts.diffuse, opaque * parts.specular);
        let most = (diffuse + specular + parts.reflection + parts.transparency).max_component();
        let scale = if most > 1.0 { 1.0 / most } else { 1.0 };
        let all = [diffuse, specular, parts.reflection, parts.transparency].map(|part| part * scale);
        let weights = all.map(|part| f64::from(part.luminance()));
        let sum: f64 = weights.iter().sum();
        let chances = weights.map(|weight| if sum > 0.0 { weight / sum } else { 0.0 });
        let [diffuse, specular, reflection, transparency] = all;
        Classic { diffuse, specular, shininess: parts.shininess, reflection, transparency, through, chances }
    }

    pub(crate) fn is_broad(&self) -> bool {
        self.chances[0] > 0.0 && self.chances[1] == 0.0
    }

    pub(crate) fn is_specular(&self) -> bool {
        self.chances[0] + self.chances[1] == 0.0
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        if toward.z <= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        let cosine = cosine_pdf(toward.z);
        let (mut value, mut pdf) = (self.diffuse * cosine as f32, self.chances[0] * cosine);
        if self.chances[1] > 0.0 {
            // Between `toward` and the mirrored direction.
            let cos = out.z * toward.z - out.x * toward.x - out.y * toward.y;
            if cos > 0.0 {
                let lobe = f64::from(pow_wide(cos.min(1.0), self.shininess)) / (2.0 * PI);
                let n = f64::from(self.shininess);
                value += self.specular * ((lobe * (n + 2.0) * toward.z) as f32);
                pdf += self.chances[1] * lobe * (n + 1.0);
            }
        }
        (value, pdf)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let [diffuse, specular, reflection, through] = self.chances;
        let weighed = |part: Rgb, chance: f64| part * ((1.0 / chance) as f32);
        let toward = if lobe < diffuse {
            cosine_hemisphere(at)
        } else if lobe < diffuse + specular {
            let toward = self.around_mirrored(out, at);
            if toward.z <= 0.0 {
                return None;
            }
            toward
        } else if lobe < diffuse + specular + reflection {
            return Some(Scattered::mirrored(out, weighed(self.reflection, reflection)));
        } else if through > 0.0 {
            let rest = ((lobe - diffuse - specular - reflection) / through).clamp(0.0, 1.0 - f64::EPSILON);
            let weight = weighed(self.transparency, through);
            let scattered = match &self.through {
                Through::Straight => Scattered { direction: -out, weight: Rgb::WHITE, how: How::Straight, scale: 1.0 },
                Through::Clear => Scattered { direction: -out, weight: Rgb::WHITE, how: How::Only, scale: 1.0 },
                Through::Sheet(sheet) => sheet.sample_smooth(out, rest),
                Through::Bent(dielectric) => dielectric.sample(out, rest, at)?,
            };
            return Some(Scattered { weight: scattered.weight * weight, ..scattered });
        } else {
            return None;
        };
        let (value, pdf) = self.evaluate(out, toward);
        Scattered::spread(toward, value, pdf)
    }

    /// A direction by Phong's lobe: densest in the mirrored one.
    fn around_mirrored(&self, out: DVec3, at: DVec2) -> DVec3 {
        let mirrored = DVec3::new(-out.x, -out.y, out.z);
        let cos = pow_double(1.0 - at.x, 1.0 / (f64::from(self.shininess) + 1.0));
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (x, y) = any_orthonormal_pair(mirrored);
        let (cos_phi, sin_phi) = cos_sin_of_turns(at.y);
        (x * (sin * cos_phi) + y * (sin * sin_phi) + mirrored * cos).normalize()
    }

    /// What goes straight on.
    pub(crate) fn straight(&self, out: DVec3) -> Rgb {
        match &self.through {
            Through::Straight => self.transparency,
            Through::Sheet(sheet) => self.transparency * sheet.straight(out),
            Through::Clear | Through::Bent(_) => Rgb::BLACK,
        }
    }

    /// What goes on of white light, about, to either side.
    pub(crate) fn albedo(&self) -> Rgb {
        self.diffuse + self.specular + self.reflection + self.transparency
    }
}
