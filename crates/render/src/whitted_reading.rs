//! What Whitted's algorithm makes of materials: each kind in the numbers of the classic one, as near as these can come.

use durer_math::Rgb;
use durer_scene::{
    Classic, Conductor, Glass, MaterialKind, Matte, Metal, Mirror, Paint, Plastic, Principled, reflectance,
};

/// The sharpest highlight; sharper ones fall between the pixels.
const MOST_SHININESS: f32 = 10_000.0;

/// The classic material that is nearest.
pub(crate) fn whitted(kind: &MaterialKind) -> Classic {
    match kind {
        MaterialKind::Classic(classic) => classic.clone(),
        MaterialKind::Matte(Matte { color, roughness: _ }) => Classic { color: *color, ..diffuse(1.0) },
        MaterialKind::Metal(metal) => self::metal(metal),
        MaterialKind::Glass(glass) => self::glass(glass),
        MaterialKind::Plastic(plastic) => self::plastic(plastic),
        MaterialKind::Mirror(Mirror { color }) => Classic { color: *color, reflection: mean(*color), ..diffuse(0.0) },
        MaterialKind::Principled(principled) => self::principled(principled),
    }
}

/// Gives back this part of light in all directions, and no more than the usual part of ambient light.
fn diffuse(part: f32) -> Classic {
    Classic { ambient: Classic::default().ambient * part, diffuse: part, ..Classic::default() }
}

/// What can only be one color: that of a texture is taken as middle gray.
fn mean(paint: Paint) -> Rgb {
    match paint {
        Paint::Color(color) => color,
        Paint::Texture(_) => Rgb::gray(0.5),
    }
}

fn amount(paint: Paint) -> f32 {
    mean(paint).luminance().clamp(0.0, 1.0)
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

/// The part that a smooth boundary of this index mirrors straight back.
fn straight_back(ior: f64) -> f32 {
    let root = ((ior - 1.0) / (ior + 1.0)) as f32;
    root * root
}

/// Smooth ones mirror; what rough ones blur is given back in all directions instead.
fn metal(metal: &Metal) -> Classic {
    let roughness = amount(metal.roughness);
    let mirrored = match metal.conductor {
        Conductor::Named(name) => name.reflectance(),
        Conductor::Index { eta, k } => reflectance(eta, k),
        Conductor::Reflectance(color) => mean(color),
    };
    let smooth = (1.0 - roughness) * (1.0 - roughness);
    Classic {
        color: match metal.conductor {
            Conductor::Reflectance(color) => color,
            Conductor::Named(_) | Conductor::Index { .. } => Paint::Color(mirrored),
        },
        specular: mirrored * (1.0 - roughness),
        shininess: shininess(roughness),
        reflection: mirrored * smooth,
        ..diffuse(1.0 - smooth)
    }
}

fn glass(glass: &Glass) -> Classic {
    let shininess = shininess(amount(glass.roughness));
    Classic {
        color: glass.color,
        specular: highlight(Rgb::gray(straight_back(glass.ior)), shininess),
        shininess,
        transparency: mean(glass.color),
        ior: Some(glass.ior).filter(|_| !glass.thin),
        fresnel: !glass.thin,
        reflection: if glass.thin { Rgb::gray(2.0 * straight_back(glass.ior)) } else { Rgb::BLACK },
        attenuation: glass.attenuation.filter(|_| !glass.thin),
        ..diffuse(0.0)
    }
}

fn plastic(plastic: &Plastic) -> Classic {
    let roughness = amount(plastic.roughness);
    let (coat, shininess) = (Rgb::gray(straight_back(plastic.ior)), shininess(roughness));
    Classic {
        color: plastic.color,
        specular: highlight(coat, shininess),
        shininess,
        reflection: coat * ((1.0 - roughness) * (1.0 - roughness)),
        ..diffuse(1.0)
    }
}

fn principled(principled: &Principled) -> Classic {
    let (metallic, roughness) = (amount(principled.metallic), amount(principled.roughness));
    let smooth = (1.0 - roughness) * (1.0 - roughness);
    let (metal, shininess) = (mean(principled.base_color), shininess(roughness));
    let color = mean(principled.specular_color) * straight_back(principled.ior);
    let coat = color.map(|part| part.min(1.0)) * amount(principled.specular);
    let transmission = amount(principled.transmission) * (1.0 - metallic);
    let transparency = metal * transmission;
    let left = 1.0 - transparency.luminance();
    let share = if left > 0.0 { ((1.0 - transmission) / left).min(1.0) } else { 0.0 };
    let bends = transmission > 0.0 && !principled.thin;
    let reflection = coat.lerp(metal, metallic) * smooth;
    Classic {
        color: principled.base_color,
        specular: highlight(coat, shininess).lerp(metal * (1.0 - roughness), metallic),
        shininess,
        reflection: if bends { reflection * (1.0 - transmission) } else { reflection },
        transparency,
        ior: Some(principled.ior).filter(|_| bends),
        fresnel: bends,
        attenuation: principled.attenuation.filter(|_| bends),
        ..diffuse((1.0 - metallic * smooth) * share)
    }
}
