//! Materials.

use super::Step;
use super::values::Checker;
use crate::{
    Attenuation, Classic, Conductor, Emission, Glass, Material, MaterialId, MaterialKind, Matte, Metal, Mirror, Paint,
    Plastic, Principled, Relief, TextureId,
};

pub(super) fn check(c: &mut Checker<'_>) {
    for (id, one) in (0..).zip(&c.scene.materials) {
        c.at(Step::Material(MaterialId(id)), |c| material(c, one));
    }
}

fn material(c: &mut Checker<'_>, material: &Material) {
    match material.kind.word() {
        None => parts(c, material),
        Some(word) => c.field(word, |c| parts(c, material)),
    }
}

fn parts(c: &mut Checker<'_>, material: &Material) {
    match &material.kind {
        MaterialKind::Classic(one) => classic(c, one),
        MaterialKind::Matte(Matte { color, roughness }) => {
            paint_in(c, "color", *color);
            amount(c, "roughness", *roughness, 0.0);
        }
        MaterialKind::Metal(one) => metal(c, one),
        MaterialKind::Glass(Glass { ior, roughness, color, attenuation, priority: _, thin: _ }) => {
            c.within("ior", *ior, 0.1, 10.0);
            amount(c, "roughness", *roughness, 0.0);
            paint_in(c, "color", *color);
            self::attenuation(c, *attenuation);
        }
        MaterialKind::Plastic(Plastic { color, ior, roughness }) => {
            paint_in(c, "color", *color);
            c.within("ior", *ior, 1.0, 10.0);
            amount(c, "roughness", *roughness, 0.0);
        }
        MaterialKind::Mirror(Mirror { color }) => paint_in(c, "color", *color),
        MaterialKind::Principled(one) => principled(c, one),
    }
    emission(c, &material.emission);
    paint_in(c, "opacity", material.opacity);
    match material.relief {
        Some(Relief::NormalMap(map)) => c.field("normal_map", |c| {
            c.field("texture", |c| exists(c, map.texture));
            c.strength("strength", map.strength);
        }),
        Some(Relief::Bump(bump)) => c.field("bump", |c| {
            paint_in(c, "height", bump.height);
            c.within("size", bump.size, -1e6, 1e6);
        }),
        None => {}
    }
}

fn classic(c: &mut Checker<'_>, classic: &Classic) {
    paint_in(c, "color", classic.color);
    c.strength("ambient", classic.ambient);
    c.strength("diffuse", classic.diffuse);
    c.light("specular", classic.specular);
    c.within("shininess", classic.shininess.into(), 0.0, 1e6);
    c.fraction("reflection", classic.reflection);
    c.fraction("transparency", classic.transparency);
    if let Some(ior) = classic.ior {
        c.within("ior", ior, 0.1, 10.0);
    }
    attenuation(c, classic.attenuation);
}

fn metal(c: &mut Checker<'_>, metal: &Metal) {
    match metal.conductor {
        Conductor::Named(_) => {}
        Conductor::Index { eta, k } => {
            let index = |c: &mut Checker<'_>, name: &'static str, value: durer_math::Rgb, least: f32| {
                let fine = value.to_array().iter().all(|x| (least..=100.0).contains(x));
                c.require(fine, name, format!("every component of {name} must be from {least} to 100"));
            };
            index(c, "eta", eta, 0.01);
            index(c, "k", k, 0.0);
        }
        Conductor::Reflectance(color) => paint_in(c, "color", color),
    }
    amount(c, "roughness", metal.roughness, 0.0);
    amount(c, "anisotropy", metal.anisotropy, -1.0);
    amount(c, "rotation", metal.rotation, -1.0);
}

fn principled(c: &mut Checker<'_>, principled: &Principled) {
    paint_in(c, "base_color", principled.base_color);
    amount(c, "metallic", principled.metallic, 0.0);
    amount(c, "roughness", principled.roughness, 0.0);
    c.within("ior", principled.ior, 1.0, 10.0);
    amount(c, "specular", principled.specular, 0.0);
    // As glTF has it: times the reflectance of the index, cut off at 1.
    c.field("specular_color", |c| light_here(c, "specular_color", principled.specular_color));
    amount(c, "transmission", principled.transmission, 0.0);
    attenuation(c, principled.attenuation);
    amount(c, "clearcoat", principled.clearcoat, 0.0);
    amount(c, "clearcoat_roughness", principled.clearcoat_roughness, 0.0);
    paint_in(c, "sheen_color", principled.sheen_color);
    amount(c, "sheen_roughness", principled.sheen_roughness, 0.0);
    amount(c, "anisotropy", principled.anisotropy, 0.0);
    amount(c, "anisotropy_rotation", principled.anisotropy_rotation, -1.0);
}

fn emission(c: &mut Checker<'_>, emission: &Emission) {
    let Emission { color, strength, sides: _ } = *emission;
    c.field("emission", |c| {
        // Where only the color is said, it stands in the field itself.
        c.field("color", |c| light_here(c, "emission", color));
        c.strength("strength", strength);
    });
}

fn attenuation(c: &mut Checker<'_>, attenuation: Option<Attenuation>) {
    let Some(attenuation) = attenuation else { return };
    c.field("attenuation", |c| {
        if c.fraction("color", attenuation.color) && attenuation.color.min_component() < 1e-6 {
            let help = "what takes all of a color away is not transparent; use a small number such as 0.001";
            c.field("color", |c| c.problem_with_help("every component of color must be above 0", help));
        }
        c.size("distance", attenuation.distance);
    });
}

/// A color from 0 to 1, or a texture that exists, in a field.
fn paint_in(c: &mut Checker<'_>, name: &'static str, paint: Paint) {
    c.field(name, |c| self::paint(c, name, paint));
}

/// A color from 0 to 1, or a texture that exists.
pub(super) fn paint(c: &mut Checker<'_>, name: &str, paint: Paint) {
    match paint {
        Paint::Color(color) => _ = c.fraction_here(name, color),
        Paint::Texture(_) => exists(c, paint),
    }
}

/// A number from `least` to 1, or a texture that exists, in a field.
fn amount(c: &mut Checker<'_>, name: &'static str, paint: Paint, least: f32) {
    let Paint::Color(color) = paint else { return c.field(name, |c| exists(c, paint)) };
    if !(color.r == color.g && color.g == color.b) && color.is_finite() {
        let help = "or a texture, of which the gray counts";
        c.field(name, |c| c.problem_with_help(format!("{name} must be a number, not a color"), help));
        return;
    }
    c.within(name, color.r.into(), least.into(), 1.0);
}

/// Light, which may be above 1, or a texture that exists.
fn light_here(c: &mut Checker<'_>, name: &str, paint: Paint) {
    match paint {
        Paint::Color(color) => _ = c.light_here(name, color),
        Paint::Texture(_) => exists(c, paint),
    }
}

/// That a texture exists.
fn exists(c: &mut Checker<'_>, paint: Paint) {
    if let Paint::Texture(TextureId(id)) = paint
        && id as usize >= c.scene.textures.len()
    {
        c.problem(format!("there is no texture {id}"));
    }
}
