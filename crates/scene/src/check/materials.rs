//! Materials.

use super::Step;
use super::values::Checker;
use crate::{Material, MaterialId, Paint, TextureId};

pub(super) fn check(c: &mut Checker<'_>) {
    for (id, one) in (0..).zip(&c.scene.materials) {
        c.at(Step::Material(MaterialId(id)), |c| material(c, one));
    }
}

fn material(c: &mut Checker<'_>, material: &Material) {
    c.field("color", |c| paint(c, "color", material.color));
    c.field("opacity", |c| paint(c, "opacity", material.opacity));
    c.light("emission", material.emission);
    c.strength("ambient", material.ambient);
    c.strength("diffuse", material.diffuse);
    c.light("specular", material.specular);
    let shininess = material.shininess;
    c.within("shininess", shininess.into(), 0.0, 1e6);
    c.fraction("reflection", material.reflection);
    c.fraction("transparency", material.transparency);
    if let Some(ior) = material.ior {
        c.within("ior", ior, 0.1, 10.0);
    }
    if let Some(attenuation) = material.attenuation {
        c.field("attenuation", |c| {
            if c.fraction("color", attenuation.color) && attenuation.color.min_component() < 1e-6 {
                let help = "what takes all of a color away is not transparent; use a small number such as 0.001";
                c.field("color", |c| c.problem_with_help("every component of color must be above 0", help));
            }
            c.size("distance", attenuation.distance);
        });
    }
}

/// A colour from 0 to 1, or a texture that exists.
pub(super) fn paint(c: &mut Checker<'_>, name: &str, paint: Paint) {
    match paint {
        Paint::Color(color) => _ = c.fraction_here(name, color),
        Paint::Texture(TextureId(id)) if id as usize >= c.scene.textures.len() => {
            c.problem(format!("there is no texture {id}"));
        }
        Paint::Texture(_) => {}
    }
}
