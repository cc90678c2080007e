//! How light is scattered at a point of a surface, in a frame whose z axis is the shading normal, on the side that the ray
//! came from. Directions point away from the surface and have unit length.
//!
//! One file for each kind of surface. A [`Bsdf`] is made anew at each hit, by value; the commonest, [`Bsdf::Diffuse`], is three
//! numbers. Where light may take several ways, one is chosen at random, and the density is that of all of them.

#[cfg(test)]
pub(crate) mod chi_square;
mod classic;
mod conductor;
mod dielectric;
mod fresnel;
mod ggx;
mod oren_nayar;
mod plastic;
mod principled;
mod sheen;
mod sheet;
mod tables;
mod warps;

pub(crate) use classic::{Classic, Parts, Through};
pub(crate) use conductor::Conductor;
pub(crate) use dielectric::Dielectric;
pub(crate) use fresnel::Reflectance;
pub(crate) use ggx::Ggx;
pub(crate) use oren_nayar::OrenNayar;
pub(crate) use plastic::Plastic;
pub(crate) use principled::{Coat, Layers, Principled, Through as ThroughLayers};
pub(crate) use sheen::Sheen;
pub(crate) use sheet::Sheet;

use durer_math::{DVec2, DVec3, Rgb};
use warps::{cosine_hemisphere, cosine_pdf};

/// How light is scattered at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bsdf {
    /// Lambert's law: this part of light goes in all directions.
    Diffuse(Rgb),
    OrenNayar(OrenNayar),
    Conductor(Conductor),
    /// A mirror of this color at all angles.
    Mirror(Rgb),
    Dielectric(Dielectric),
    /// A boundary between media that bend light alike: all goes straight on, takes on this color, and shadow rays do not know.
    Clear(Rgb),
    Sheet(Sheet),
    Plastic(Plastic),
    Classic(Classic),
    Principled(Principled),
}

/// A direction chosen at random.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    /// Where the path goes on; below the surface (z < 0) if light gets through.
    pub(crate) direction: DVec3,
    /// The scattering function times |cos θ|, divided by the density.
    pub(crate) weight: Rgb,
    pub(crate) how: How,
    /// The part of the weight that is due to radiance being squeezed into fewer directions where it is let through into a denser
    /// medium, 1/η². It says nothing of how much light is left, so roulette must not count it.
    pub(crate) scale: f32,
}

/// How a direction was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum How {
    /// Among all directions, with this density (per solid angle), which [`Bsdf::evaluate`] gives, too.
    Spread { pdf: f64 },
    /// It is the only one: mirrors, smooth glass.
    Only,
    /// As if there were no surface: straight on. Shadow rays go this way, too, with [`Bsdf::straight`].
    Straight,
}

/// Microfacets of this width spread light [broadly](Bsdf::is_broad). Where all is silver of alpha 0.2, light that was looked for
/// from one direction and used for others made bright dots, with 0.36 none.
const BROAD: f64 = 0.3;

/// A surface seen so nearly edge-on scatters nothing: numbers end there.
const EDGE_ON: f64 = 1e-7;

impl Bsdf {
    /// True if it scatters light only into directions that cannot be found by aiming at lights.
    pub(crate) fn is_specular(&self) -> bool {
        match self {
            Bsdf::Diffuse(_) | Bsdf::OrenNayar(_) => false,
            Bsdf::Mirror(_) | Bsdf::Clear(_) => true,
            Bsdf::Sheet(sheet) => sheet.is_specular(),
            Bsdf::Conductor(conductor) => conductor.is_specular(),
            Bsdf::Dielectric(dielectric) => dielectric.is_specular(),
            Bsdf::Plastic(plastic) => plastic.is_specular(),
            Bsdf::Classic(classic) => classic.is_specular(),
            Bsdf::Principled(principled) => principled.is_specular(),
        }
    }

    /// True if it is much the same from wherever it is seen: light that was found for one direction serves another.
    pub(crate) fn is_broad(&self) -> bool {
        match self {
            Bsdf::Diffuse(_) | Bsdf::OrenNayar(_) => true,
            Bsdf::Mirror(_) | Bsdf::Clear(_) | Bsdf::Sheet(_) | Bsdf::Dielectric(_) => false,
            Bsdf::Conductor(conductor) => conductor.is_broad(),
            Bsdf::Plastic(plastic) => plastic.is_broad(),
            Bsdf::Classic(classic) => classic.is_broad(),
            Bsdf::Principled(principled) => principled.is_broad(),
        }
    }

    /// True if there is but one way in which it scatters light: [`Bsdf::sample`] chooses none.
    pub(crate) fn has_one_lobe(&self) -> bool {
        matches!(self, Bsdf::Diffuse(_) | Bsdf::OrenNayar(_) | Bsdf::Mirror(_) | Bsdf::Clear(_))
    }

    /// True if light from behind the surface may be found by aiming at it.
    pub(crate) fn spreads_through(&self) -> bool {
        match self {
            Bsdf::Dielectric(dielectric) => !dielectric.is_specular(),
            Bsdf::Sheet(sheet) => !sheet.is_specular(),
            Bsdf::Principled(principled) => principled.spreads_through(),
            Bsdf::Diffuse(_)
            | Bsdf::OrenNayar(_)
            | Bsdf::Mirror(_)
            | Bsdf::Clear(_)
            | Bsdf::Conductor(_)
            | Bsdf::Plastic(_)
            | Bsdf::Classic(_) => false,
        }
    }

    /// The scattering function times |cos θ| of `toward`, and the density with which [`Bsdf::sample`] finds it.
    #[inline]
    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Rgb, f64) {
        if out.z < EDGE_ON || toward.z.abs() < EDGE_ON {
            return (Rgb::BLACK, 0.0);
        }
        match self {
            Bsdf::Diffuse(color) => {
                let pdf = cosine_pdf(toward.z);
                (*color * pdf as f32, pdf)
            }
            Bsdf::OrenNayar(_) if toward.z < 0.0 => (Rgb::BLACK, 0.0),
            Bsdf::OrenNayar(rough) => (rough.evaluate(out, toward), cosine_pdf(toward.z)),
            Bsdf::Mirror(_) | Bsdf::Clear(_) => (Rgb::BLACK, 0.0),
            Bsdf::Sheet(sheet) => sheet.evaluate(out, toward),
            Bsdf::Conductor(conductor) => conductor.evaluate(out, toward),
            Bsdf::Dielectric(dielectric) => dielectric.evaluate(out, toward),
            Bsdf::Plastic(plastic) => plastic.evaluate(out, toward),
            Bsdf::Classic(classic) => classic.evaluate(out, toward),
            Bsdf::Principled(principled) => principled.evaluate(out, toward),
        }
    }

    /// A direction to go on in: `lobe` chooses how, `at` where.
    #[inline]
    pub(crate) fn sample(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        if out.z < EDGE_ON {
            return None;
        }
        let scattered = match self {
            Bsdf::Diffuse(color) => {
                let direction = cosine_hemisphere(at);
                let pdf = cosine_pdf(direction.z);
                Scattered { direction, weight: *color, how: How::Spread { pdf }, scale: 1.0 }
            }
            Bsdf::OrenNayar(rough) => {
                let direction = cosine_hemisphere(at);
                Scattered::spread(direction, rough.evaluate(out, direction), cosine_pdf(direction.z))?
            }
            Bsdf::Mirror(color) => Scattered::mirrored(out, *color),
            Bsdf::Clear(tint) => Scattered { direction: -out, weight: *tint, how: How::Only, scale: 1.0 },
            Bsdf::Sheet(sheet) => sheet.sample(out, lobe, at)?,
            Bsdf::Conductor(conductor) => conductor.sample(out, lobe, at)?,
            Bsdf::Dielectric(dielectric) => dielectric.sample(out, lobe, at)?,
            Bsdf::Plastic(plastic) => plastic.sample(out, lobe, at)?,
            Bsdf::Classic(classic) => classic.sample(out, lobe, at)?,
            Bsdf::Principled(principled) => principled.sample(out, lobe, at)?,
        };
        (scattered.direction.z.abs() >= EDGE_ON).then_some(scattered)
    }

    /// The same for what the eye sees, itself or in mirrors: smooth glass reflects more often than it should, and what it reflects
    /// counts the less. For what is mirrored faintly may be much brighter than all that is behind.
    pub(crate) fn sample_seen(&self, out: DVec3, lobe: f64, at: DVec2) -> Option<Scattered> {
        match self {
            Bsdf::Dielectric(dielectric) if dielectric.is_specular() && out.z >= EDGE_ON => {
                dielectric.sample_seen(out, lobe)
            }
            other => other.sample(out, lobe, at),
        }
    }

    /// The one direction to a side in which a smooth boundary or mirror scatters, with the chance that [`Bsdf::sample`] takes it in
    /// its weight: who goes there goes on purpose. `None` if there is none, or if the surface is another.
    pub(crate) fn only(&self, out: DVec3, passes: bool) -> Option<Scattered> {
        if out.z < EDGE_ON {
            return None;
        }
        match self {
            Bsdf::Dielectric(dielectric) => dielectric.only(out, passes),
            Bsdf::Conductor(conductor) if !passes && conductor.is_specular() => conductor.sample(out, 0.0, DVec2::ZERO),
            Bsdf::Mirror(color) if !passes => Some(Scattered::mirrored(out, *color)),
            Bsdf::Diffuse(_)
            | Bsdf::OrenNayar(_)
            | Bsdf::Conductor(_)
            | Bsdf::Mirror(_)
            | Bsdf::Clear(_)
            | Bsdf::Sheet(_)
            | Bsdf::Plastic(_)
            | Bsdf::Classic(_)
            | Bsdf::Principled(_) => None,
        }
    }

    /// What light that goes straight on keeps, if the surface lets it: what [`How::Straight`] is sampled for.
    pub(crate) fn straight(&self, out: DVec3) -> Rgb {
        match self {
            Bsdf::Diffuse(_)
            | Bsdf::OrenNayar(_)
            | Bsdf::Mirror(_)
            | Bsdf::Clear(_)
            | Bsdf::Conductor(_)
            | Bsdf::Dielectric(_)
            | Bsdf::Plastic(_) => Rgb::BLACK,
            Bsdf::Sheet(sheet) => sheet.straight(out),
            Bsdf::Classic(classic) => classic.straight(out),
            Bsdf::Principled(principled) => principled.straight(out),
        }
    }

    /// The part of white light from everywhere that is scattered to `out`, about: the albedo of layers for denoisers.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        match self {
            Bsdf::Diffuse(color) | Bsdf::Mirror(color) | Bsdf::Clear(color) => *color,
            Bsdf::OrenNayar(rough) => rough.albedo(out),
            Bsdf::Sheet(sheet) => sheet.albedo(out),
            Bsdf::Conductor(conductor) => conductor.albedo(out),
            Bsdf::Dielectric(dielectric) => dielectric.albedo(out),
            Bsdf::Plastic(plastic) => plastic.albedo(out),
            Bsdf::Classic(classic) => classic.albedo(),
            Bsdf::Principled(principled) => principled.albedo(out),
        }
    }
}

#[cfg(test)]
mod tests;
