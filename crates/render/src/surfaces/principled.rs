//! glTF's material model at a hit.
//!
//! Of what goes through a body the base color is taken once, in two parts: its root where light enters, and where it leaves. Thin
//! things take it at once. What goes through reflects by the index of refraction alone, whatever `specular` says.

use super::{Indices, brushed, is_one, is_zero};
use crate::bsdf::{Bsdf, Coat, Dielectric, Ggx, Layers, Principled, Sheen, Sheet, ThroughLayers};
use crate::frame::Frame;
use crate::shading::{Shading, Textured, within_one};
use durer_math::Rgb;
use durer_scene::Paint;

/// What scatters light there, and the frame in which it does.
pub(super) fn at(
    material: &durer_scene::Principled,
    shading: &Shading<'_>,
    textured: &Textured<'_>,
    indices: Indices,
) -> (Frame, Bsdf) {
    let base_color = within_one(shading.color);
    let roughness = textured.amount(material.roughness);
    let (frame, ggx) = match is_zero(material.anisotropy) {
        true => (Frame::around(shading.normal()), Ggx::of_roughness(roughness, 0.0)),
        false => {
            let frame = brushed(shading, textured, material.anisotropy_rotation);
            (frame, Ggx::widened(roughness, textured.amount(material.anisotropy)))
        }
    };
    let eta = match indices.relative() {
        Some(eta) if !material.thin => eta,
        _ => material.ior / indices.before,
    };
    let straight_back = ((eta - 1.0) / (eta + 1.0)) as f32;
    let specular = textured.amount(material.specular);
    // The color of the reflection may be above 1, what it makes of it may not.
    let f0 = within_one(textured.color_of(material.specular_color) * (straight_back * straight_back));
    let layers = Layers {
        base_color,
        metallic: textured.amount(material.metallic),
        ggx,
        f0: f0 * specular as f32,
        f90: specular,
        through: through(material, textured, (base_color, ggx, eta), indices),
        sheen: sheen(material, textured),
        coat: coat(material, textured),
    };
    (frame, Bsdf::Principled(Principled::new(layers)))
}

/// True if all light that is not reflected at its boundary goes through, and nothing lies upon that.
pub(super) fn is_clear_body(material: &durer_scene::Principled) -> bool {
    let upon = [material.metallic, material.clearcoat, material.sheen_color];
    material.transmission == Paint::Color(Rgb::WHITE) && !material.thin && upon.into_iter().all(is_zero)
}

fn through(
    material: &durer_scene::Principled,
    textured: &Textured<'_>,
    (color, ggx, eta): (Rgb, Option<Ggx>, f64),
    indices: Indices,
) -> Option<(f64, ThroughLayers)> {
    if is_zero(material.transmission) {
        return None;
    }
    let half = color.map(f32::sqrt);
    let how = if material.thin || indices.behind.is_none() {
        ThroughLayers::Thin(Sheet::new(eta, color, ggx))
    } else if is_one(eta) {
        ThroughLayers::Clear(half)
    } else {
        ThroughLayers::Bent(Dielectric::new(eta, half, ggx))
    };
    Some((textured.amount(material.transmission), how))
}

fn sheen(material: &durer_scene::Principled, textured: &Textured<'_>) -> Option<Sheen> {
    if is_zero(material.sheen_color) {
        return None;
    }
    let color = textured.part(material.sheen_color);
    (!color.is_black()).then(|| Sheen::new(color, textured.amount(material.sheen_roughness)))
}

fn coat(material: &durer_scene::Principled, textured: &Textured<'_>) -> Option<Coat> {
    if is_zero(material.clearcoat) {
        return None;
    }
    let roughness = textured.amount(material.clearcoat_roughness);
    Some(Coat { strength: textured.amount(material.clearcoat), ggx: Ggx::of_roughness(roughness, 0.0) })
}
