//! What Whitted's algorithm makes of materials: each kind in the numbers of the classic one, as near as these can come.
//!
//! That algorithm sends one ray in each of the directions of a mirror and of clear glass. What physical materials scatter
//! around these directions becomes Phong's highlight for lamps, and for all else it counts as given back in all directions.
//! Color, opacity and emission may be textures; where another number is one, its mean is taken. The tables of what becomes of
//! each field are in the guide.

mod means;

use durer_math::Rgb;
use durer_scene::{
    Attenuation, Classic, Conductor, Glass, MaterialKind, Matte, Metal, Mirror, Paint, Plastic, Principled, reflectance,
};

pub(crate) use means::Means;

/// The sharpest highlight; sharper ones fall between the pixels.
const MOST_SHININESS: f32 = 10_000.0;
/// Reflections weaker than this are not worth a ray each.
const LEAST_REFLECTION: f32 = 0.01;
/// Part of light that goes straight back from a clear coat of index 1.5.
const COAT: f32 = 0.04;

/// The classic material that is nearest.
pub(crate) fn whitted(kind: &MaterialKind, means: &mut Means<'_>) -> Classic {
    match kind {
        MaterialKind::Classic(classic) => classic.clone(),
        MaterialKind::Matte(Matte { color, roughness: _ }) => Classic { color: *color, ..diffuse(1.0) },
        MaterialKind::Metal(metal) => self::metal(metal, means),
        MaterialKind::Glass(glass) => self::glass(glass, means),
        MaterialKind::Plastic(plastic) => self::plastic(plastic, means),
        MaterialKind::Mirror(Mirror { color }) => {
            Classic { color: *color, reflection: means.of(*color), ..diffuse(0.0) }
        }
        MaterialKind::Principled(principled) => self::principled(principled, means),
    }
}

/// The parts of a color that are mirrored, and that pass: for kinds whose color says what is, not what is given back in all
/// directions. A texture, or a color of the thing itself, decides about it where it is met.
pub(crate) fn parts_of_color(kind: &MaterialKind, means: &mut Means<'_>) -> [Option<f32>; 2] {
    match kind {
        MaterialKind::Mirror(_) => [Some(1.0), None],
        MaterialKind::Metal(metal) => match metal.conductor {
            Conductor::Reflectance(_) => [Some(smooth(means.amount(metal.roughness))), None],
            Conductor::Named(_) | Conductor::Index { .. } => [None, None],
        },
        MaterialKind::Glass(glass) => [None, Some(if glass.thin { 1.0 - mirrored_by_sheet(glass.ior) } else { 1.0 })],
        MaterialKind::Classic(_) | MaterialKind::Matte(_) | MaterialKind::Plastic(_) | MaterialKind::Principled(_) => {
            [None, None]
        }
    }
}

/// Gives back this part of light in all directions, and as much of the usual part of ambient light.
fn diffuse(part: f32) -> Classic {
    Classic { ambient: Classic::default().ambient * part, diffuse: part, ..Classic::default() }
}

/// Phong's exponent for a roughness: half that of Blinn's 2/α² - 2 with α = roughness², and half again, since Phong's
/// angle, between the mirrored light and the eye, is twice Blinn's.
fn shininess(roughness: f32) -> f32 {
    let alpha = roughness * roughness;
    (0.5 / (alpha * alpha) - 0.5).clamp(1.0, MOST_SHININESS)
}

/// The strength of Phong's highlight whose lobe gives back this part of the light, at most 1.
fn highlight(reflectance: Rgb, shininess: f32) -> Rgb {
    let peak = reflectance * ((shininess + 2.0) * 0.5);
    peak * (1.0 / peak.max_component().max(1.0))
}

/// The part of what a rough surface reflects that is taken for a mirror image.
fn smooth(roughness: f32) -> f32 {
    (1.0 - roughness) * (1.0 - roughness)
}

/// The part of light that a smooth boundary of this index mirrors straight back.
fn straight_back(ior: f64) -> f32 {
    let root = ((ior - 1.0) / (ior + 1.0)) as f32;
    root * root
}

fn worth_a_ray(reflection: Rgb) -> Rgb {
    if reflection.max_component() < LEAST_REFLECTION { Rgb::BLACK } else { reflection }
}

fn metal(metal: &Metal, means: &mut Means<'_>) -> Classic {
    let roughness = means.amount(metal.roughness);
    let (color, mirrored) = match metal.conductor {
        Conductor::Named(name) => (Paint::Color(name.reflectance()), name.reflectance()),
        Conductor::Index { eta, k } => (Paint::Color(reflectance(eta, k)), reflectance(eta, k)),
        Conductor::Reflectance(color) => (color, means.of(color)),
    };
    Classic {
        color,
        specular: mirrored * (1.0 - roughness),
        shininess: shininess(roughness),
        reflection: worth_a_ray(mirrored * smooth(roughness)),
        ..diffuse(1.0 - smooth(roughness))
    }
}

/// A thin sheet reflects on both of its sides, once more for each time that light goes to and fro within: 2 R / (1 + R).
fn mirrored_by_sheet(ior: f64) -> f32 {
    let back = straight_back(ior);
    2.0 * back / (1.0 + back)
}

/// Rough glass is shown clear.
fn glass(glass: &Glass, means: &mut Means<'_>) -> Classic {
    let (shininess, back) = (shininess(means.amount(glass.roughness)), straight_back(glass.ior));
    let clear = Classic {
        color: glass.color,
        specular: highlight(Rgb::gray(back), shininess),
        shininess,
        transparency: means.of(glass.color),
        ..diffuse(0.0)
    };
    if glass.thin {
        let reflection = mirrored_by_sheet(glass.ior);
        let transparency = clear.transparency * (1.0 - reflection);
        return Classic { transparency, reflection: worth_a_ray(Rgb::gray(reflection)), ..clear };
    }
    Classic { ior: Some(glass.ior), fresnel: true, attenuation: glass.attenuation, ..clear }
}

fn plastic(plastic: &Plastic, means: &mut Means<'_>) -> Classic {
    let roughness = means.amount(plastic.roughness);
    let (coat, shininess) = (Rgb::gray(straight_back(plastic.ior)), shininess(roughness));
    Classic {
        color: plastic.color,
        specular: highlight(coat, shininess),
        shininess,
        reflection: worth_a_ray(coat * smooth(roughness)),
        ..diffuse(1.0)
    }
}

/// Metal m and roughness r: what a rough metal scatters is taken for matte, so `diffuse` is 1 - m (1 - r)². A sheen and the
/// direction of highlights are left out.
fn principled(principled: &Principled, means: &mut Means<'_>) -> Classic {
    let (metallic, roughness) = (means.amount(principled.metallic), means.amount(principled.roughness));
    let transmission = means.amount(principled.transmission) * (1.0 - metallic);
    // Means of images take a look at every pixel.
    let needs_base = metallic > 0.0 || transmission > 0.0;
    let base = if needs_base { means.of(principled.base_color) } else { Rgb::BLACK };
    let plain = Rgb::gray(straight_back(principled.ior)) * means.of(principled.specular_color);
    let back = plain.map(|part| part.min(1.0)) * means.amount(principled.specular);
    let shininess = shininess(roughness);
    let surface = Classic {
        color: principled.base_color,
        specular: highlight(back, shininess).lerp(base * (1.0 - roughness), metallic),
        shininess,
        reflection: worth_a_ray(back.lerp(base, metallic) * smooth(roughness)),
        ..diffuse(1.0 - metallic * smooth(roughness))
    };
    let clear = cleared(surface, principled, base, transmission);
    coated(clear, means.amount(principled.clearcoat), means.amount(principled.clearcoat_roughness))
}

/// The same surface if this part of the light goes through it.
fn cleared(surface: Classic, principled: &Principled, base: Rgb, transmission: f32) -> Classic {
    if transmission == 0.0 {
        return surface;
    }
    let transparency = base * transmission;
    // What passes is taken away from the rest by color; the share of the rest is to be 1 - transmission.
    let left = 1.0 - transparency.luminance();
    let share = if left > 0.0 { ((1.0 - transmission) / left).min(1.0) } else { 0.0 };
    let (diffuse, ambient) = (surface.diffuse * share, surface.ambient * share);
    let sheet = Classic { transparency, diffuse, ambient, ..surface };
    if principled.thin {
        // What is mirrored does not pass.
        let left = (Rgb::WHITE - sheet.reflection).map(|part| part.max(0.0));
        return Classic { transparency: sheet.transparency * left, ..sheet };
    }
    let attenuation: Option<Attenuation> = principled.attenuation;
    let reflection = sheet.reflection * (1.0 - transmission);
    Classic { ior: Some(principled.ior), fresnel: true, reflection, attenuation, ..sheet }
}

/// The same surface under a clear coat of this strength. There is one highlight, as sharp as that of the coat.
fn coated(surface: Classic, strength: f32, roughness: f32) -> Classic {
    if strength == 0.0 {
        return surface;
    }
    let (coat, shininess) = (Rgb::gray(COAT * strength), shininess(roughness));
    let brighter = |a: Rgb, b: Rgb| Rgb::new(a.r.max(b.r), a.g.max(b.g), a.b.max(b.b));
    let reflection = surface.reflection + coat * smooth(roughness);
    Classic {
        specular: brighter(surface.specular, highlight(coat, shininess)),
        shininess: surface.shininess.max(shininess),
        reflection: worth_a_ray(reflection.map(|part| part.min(1.0))),
        ..surface
    }
}

#[cfg(test)]
mod tests;
