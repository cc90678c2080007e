//! The material model of glTF 2.0 with its extensions: layers over layers.
//!
//! From below: metal, or a matte base, or a boundary that lets light through; reflection at the surface, for which what is no metal
//! gives up as much; sheen; a clear coat. A layer takes from those below what it gives back itself, looked up for both
//! directions (Kulla and Conty 2017; Khronos, glTF 2.0, appendix B, and KHR_materials_sheen): so nothing is ever more than 1.
//! Light goes the same way back.

use super::conductor::multiple;
use super::dielectric::Dielectric;
use super::fresnel::{Reflectance, schlick_weight};
use super::ggx::Ggx;
use super::sheen::Sheen;
use super::sheet::Sheet;
use super::tables::REFLECTED;
use super::warps::{EVEN_PDF, cosine_hemisphere, cosine_pdf, even_hemisphere};
use super::{How, Scattered};
use durer_math::{DVec2, DVec3, Rgb};

/// What a principled surface is made of, at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers {
    pub(crate) base_color: Rgb,
    /// From 0 to 1.
    pub(crate) metallic: f64,
    pub(crate) ggx: Option<Ggx>,
    /// What is reflected straight back of light by what is no metal, and the part of light at grazing angles.
    pub(crate) f0: Rgb,
    pub(crate) f90: f64,
    /// What is let through of what is no metal: how much of it, and how.
    pub(crate) through: Option<(f64, Through)>,
    pub(crate) sheen: Option<Sheen>,
    pub(crate) coat: Option<Coat>,
}

/// How light gets through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Through {
    Bent(Dielectric),
    Thin(Sheet),
    /// Straight, in a color, where what is on both sides bends light alike; shadow rays do not know.
    Clear(Rgb),
}

/// A clear coat with index of refraction 1.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coat {
    /// How much of it there is, from 0 to 1.
    pub(crate) strength: f64,
    pub(crate) ggx: Option<Ggx>,
}

/// A principled surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Principled {
    /// Reflection of metal and of what is none but opaque, in the parts that there are of them.
    reflectance: Reflectance,
    ggx: Option<Ggx>,
    alpha: f64,
    /// Of metal: light that meets several microfacets.
    multiple: Rgb,
    /// The matte base, over what the surface lets in from everywhere.
    matte: Rgb,
    /// Of light from everywhere, what the surface lets in, and what meets several microfacets.
    averages: [f64; 2],
    /// What is reflected above the base: straight back, and at grazing angles.
    above: [f64; 2],
    through: Option<(f64, Through)>,
    sheen: Option<Sheen>,
    coat: Option<Coat>,
}

/// The probabilities of the ways to go on.
#[derive(Clone, Copy, Debug)]
struct Chances {
    coat: f64,
    reflection: f64,
    /// In all directions: for the matte base, and what meets several microfacets.
    matte: f64,
    sheen: f64,
    through: f64,
}

/// At normal incidence a coat of index 1.5 reflects ((1.5 - 1)/(1.5 + 1))².
const COAT_F0: f64 = 0.04;

impl Principled {
    pub(crate) fn new(layers: Layers) -> Principled {
        let Layers { base_color, metallic, ggx, f0, f90, through, sheen, coat } = layers;
        let through_part = through.map_or(0.0, |(part, _)| (1.0 - metallic) * part);
        let opaque = 1.0 - metallic - through_part;
        let alpha = ggx.map_or(0.0, |ggx| ggx.even_alpha());
        let above = [f64::from(f0.max_component()), f90];
        let reflectance = Reflectance::Schlick {
            f0: base_color * metallic as f32 + f0 * opaque as f32,
            f90: Rgb::gray((metallic + f90 * opaque) as f32),
        };
        let single = REFLECTED.all.average(alpha);
        let metal = Reflectance::Schlick { f0: base_color, f90: Rgb::WHITE };
        let let_in = 1.0 - mixed(above, single, REFLECTED.schlick.average(alpha));
        Principled {
            reflectance,
            ggx,
            alpha,
            multiple: multiple(metal.average(), single) * metallic as f32,
            matte: base_color * ((opaque / let_in.max(1e-6)) as f32),
            averages: [let_in, 1.0 - single],
            above,
            through: through.map(|(_, how)| (through_part, how)).filter(|(part, _)| *part > 0.0),
            sheen,
            coat: coat.filter(|coat| coat.strength > 0.0),
        }
    }

    /// What is let in to the matte base.
    fn let_in(&self, cos: f64) -> f64 {
        1.0 - mixed(self.above, REFLECTED.all.at(cos, self.alpha), REFLECTED.schlick.at(cos, self.alpha))
    }

    /// What is left, on its way down and up again, of light by coat and sheen: less what the flatter way loses.
    fn below_coat(&self, out: DVec3, toward: DVec3) -> f64 {
        let left = |coat: &Coat| 1.0 - coat.taken(out.z).max(coat.taken(toward.z.abs()));
        self.coat.as_ref().map_or(1.0, left)
    }

    fn below_sheen(&self, out: DVec3, toward: DVec3) -> f64 {
        let left = |sheen: &Sheen| 1.0 - sheen.taken(out.z).max(sheen.taken(toward.z.abs()));
        self.below_coat(out, toward) * self.sheen.as_ref().map_or(1.0, left)
    }

    fn chances(&self, out: DVec3) -> Chances {
        let bright = |color: Rgb| f64::from(color.luminance());
        let single = REFLECTED.all.at(out.z, self.alpha);
        let reflected = self.reflectance.at(0.0) - self.reflectance.at(1.0);
        let reflected =
            bright(self.reflectance.at(1.0)) * single + bright(reflected) * REFLECTED.schlick.at(out.z, self.alpha);
        let sheen = self.sheen.map_or(0.0, |sheen| bright(sheen.albedo(out.z)));
        let [let_in, missing] = self.averages;
        let matte = bright(self.matte) * self.let_in(out.z) * let_in;
        let coat = self.coat.map_or(0.0, |coat| coat.taken(out.z));
        let matte = matte + bright(self.multiple) * (1.0 - single) * missing;
        let through = self.through.map_or(0.0, |(part, _)| part);
        let sum = coat + reflected + matte + sheen + through;
        if sum <= 0.0 {
            return Chances { coat: 0.0, reflection: 1.0, matte: 0.0, sheen: 0.0, through: 0.0 };
        }
        let [coat, reflection, matte, sheen, through] = [coat, reflected, matte, sheen, through].map(|part| part / sum);
        Chances { coat, reflection, matte, sheen, through }
    }

    pub(crate) fn is_broad(&self) -> bool {
        self.ggx.is_some_and(|ggx| ggx.is_broad()) && self.through.is_none() && self.coat.is_none()
    }

    pub(crate) fn is_specular(&self) -> bool {
        let is_spread = self.ggx.is_some()
            || !self.matte.is_black()
            || self.sheen.is_some()
            || self.spreads_through()
            || self.coat.is_some_and(|coat| coat.ggx.is_some());
        !is_spread
    }

    pub(crate) fn spreads_through(&self) -> bool {
        match &self.through {
            Some((_, Through::Bent(dielectric))) => !dielectric.is_specular(),
            Some((_, Through::Thin(sheet))) => !sheet.is_specular(),
            Some((_, Through::Clear(_))) | None => false,
        }
    }

    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        let chances = self.chances(out);
        let (mut value, mut pdf) = (Rgb::BLACK, 0.0);
        if let Some((part, how)) = &self.through {
            let (through, density) = match how {
                Through::Bent(dielectric) => dielectric.evaluate(out, toward),
                Through::Thin(sheet) => sheet.evaluate(out, toward),
                Through::Clear(_) => (Rgb::BLACK, 0.0),
            };
            value += through * *part as f32;
            pdf += chances.through * density;
        }
        if toward.z < 0.0 {
            return (value * self.below_sheen(out, toward) as f32, pdf);
        }
        let cosine = cosine_pdf(toward.z);
        pdf += chances.matte * cosine + chances.sheen * EVEN_PDF;
        let let_in = self.let_in(out.z) * self.let_in(toward.z);
        value += self.matte * ((let_in * cosine) as f32);
        let h = (out + toward).normalize();
        if let Some(ggx) = &self.ggx {
            let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
            let density = ggx.density(h) / (4.0 * out.z);
            value += self.reflectance.at(out.dot(h)) * ((density / (o + i)) as f32);
            pdf += chances.reflection * density / o;
            let missing = |cos: f64| 1.0 - REFLECTED.all.at(cos, self.alpha);
            value += self.multiple * ((missing(out.z) * missing(toward.z) * cosine) as f32);
        }
        value = value * self.below_sheen(out, toward) as f32;
        if let Some(sheen) = &self.sheen {
            value += sheen.evaluate(out, toward) * self.below_coat(out, toward) as f32;
        }
        if let Some(Coat { strength, ggx: Some(ggx) }) = &self.coat {
            let (o, i) = (1.0 + ggx.lambda(out), ggx.lambda(toward));
            let density = ggx.density(h) / (4.0 * out.z);
            value += Rgb::gray((strength * coat_reflectance(out.dot(h)) * density / (o + i)) as f32);
            pdf += chances.coat * density / o;
        }
        (value, pdf)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        let chances = self.chances(out);
        let reflected = |ggx: &Ggx| {
            let h = ggx.sample(out, at);
            h * (2.0 * out.dot(h)) - out
        };
        let toward = if lobe < chances.coat {
            let coat = self.coat.as_ref()?;
            match &coat.ggx {
                Some(ggx) => reflected(ggx),
                None => {
                    let weight = coat.strength * coat_reflectance(out.z) / chances.coat;
                    return Some(Scattered::mirrored(out, Rgb::gray(weight as f32)));
                }
            }
        } else if lobe < chances.coat + chances.reflection {
            match &self.ggx {
                Some(ggx) => reflected(ggx),
                None => {
                    let weight = self.below_sheen(out, out) / chances.reflection;
                    return Some(Scattered::mirrored(out, self.reflectance.at(out.z) * weight as f32));
                }
            }
        } else if lobe < chances.coat + chances.reflection + chances.matte {
            cosine_hemisphere(at)
        } else if lobe < 1.0 - chances.through || self.through.is_none() {
            even_hemisphere(at)
        } else {
            let rest = (lobe + chances.through - 1.0) / chances.through;
            let scattered = self.sample_through(out, rest.clamp(0.0, 1.0 - f64::EPSILON), at)?;
            if !matches!(scattered.how, How::Spread { .. }) {
                let (part, _) = self.through?;
                let weight = part * self.below_sheen(out, scattered.direction) / chances.through;
                return Some(Scattered { weight: scattered.weight * weight as f32, ..scattered });
            }
            let (value, pdf) = self.evaluate(out, scattered.direction);
            let found = Scattered::spread(scattered.direction, value, pdf)?;
            return Some(Scattered { scale: scattered.scale, ..found });
        };
        let (value, pdf) = if toward.z > 0.0 { self.evaluate(out, toward) } else { return None };
        Scattered::spread(toward, value, pdf)
    }

    fn sample_through(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        match self.through?.1 {
            Through::Bent(dielectric) => dielectric.sample(out, lobe, at),
            Through::Thin(sheet) => sheet.sample(out, lobe, at),
            Through::Clear(weight) => Some(Scattered { direction: -out, weight, how: How::Only, scale: 1.0 }),
        }
    }

    /// What goes straight on.
    pub(crate) fn straight(&self, out: DVec3) -> Rgb {
        match &self.through {
            Some((part, Through::Thin(sheet))) => sheet.straight(out) * ((part * self.below_sheen(out, out)) as f32),
            Some((_, Through::Bent(_) | Through::Clear(_))) | None => Rgb::BLACK,
        }
    }

    /// What goes on of white light, about, to either side.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        let through = match &self.through {
            Some((part, Through::Bent(dielectric))) => dielectric.albedo(out) * *part as f32,
            Some((part, Through::Thin(sheet))) => sheet.albedo(out) * *part as f32,
            Some((part, Through::Clear(tint))) => *tint * *part as f32,
            None => Rgb::BLACK,
        };
        let below =
            through + self.reflectance.at(out.z.max(0.2)) + self.matte * (self.let_in(out.z) * self.averages[0]) as f32;
        let sheen = self.sheen.map_or(Rgb::BLACK, |sheen| sheen.albedo(out.z)) * self.below_coat(out, out) as f32;
        let coat = self.coat.map_or(0.0, |coat| coat.taken(out.z));
        below * self.below_sheen(out, out) as f32 + sheen + Rgb::gray(coat as f32)
    }
}

impl Coat {
    /// What the coat gives back, and takes from what is below.
    fn taken(&self, cos: f64) -> f64 {
        let part = match self.ggx {
            None => coat_reflectance(cos),
            Some(ggx) => {
                let alpha = ggx.even_alpha();
                mixed([COAT_F0, 1.0], REFLECTED.all.at(cos, alpha), REFLECTED.schlick.at(cos, alpha))
            }
        };
        self.strength * part
    }
}

fn coat_reflectance(cos: f64) -> f64 {
    COAT_F0 + (1.0 - COAT_F0) * schlick_weight(cos)
}

/// What is given back with Schlick's reflectance from f0 to f90, if microfacets give back `all` and Schlick's part of it.
fn mixed([f0, f90]: [f64; 2], all: f64, schlick: f64) -> f64 {
    f0 * all + (f90 - f0) * schlick
}
