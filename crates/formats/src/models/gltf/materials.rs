//! Materials: from metal and roughness to the classic ones. The formulas are in the description of [`super`].

use super::super::ModelError;
use super::images::{Images, TextureUse};
use super::source::Source;
use super::value::Value;
use durer_math::Rgb;
use durer_scene::{Attenuation, Classic, Emission, Encoding, Material, MaterialId, MaterialKind, Paint};
use std::collections::HashMap;

/// The materials that are used, with their textures.
#[derive(Default)]
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    pub(super) images: Images,
    known: HashMap<usize, Finish>,
}

/// What a primitive has to know of its material.
#[derive(Clone, Copy)]
pub(super) struct Finish {
    pub(super) id: MaterialId,
    /// Which texture coordinates it uses.
    pub(super) uv_set: usize,
    /// What vertex colors are to be multiplied by: white if a texture does that.
    pub(super) tint: Rgb,
    pub(super) has_texture: bool,
    /// True if alpha has a meaning.
    pub(super) has_alpha: bool,
}

/// Reflections weaker than this are not worth a ray each.
const LEAST_REFLECTION: f32 = 0.01;
/// The sharpest highlight; sharper ones fall between the pixels.
const MOST_SHININESS: f32 = 10_000.0;
/// Rougher than this, what shines through would be blurred visibly.
const LEAST_ROUGH: f32 = 0.2;
/// The brightest light that scenes allow.
const BRIGHTEST: f64 = 1e6;

/// A surface as glTF describes it, from either of its two models.
struct Surface {
    /// Linear.
    base: Rgb,
    alpha: f32,
    texture: Option<TextureUse>,
    metallic: f32,
    roughness: f32,
    /// What is mirrored straight back where it is not metal.
    reflectance: Rgb,
    /// Without highlights, and lit by nothing.
    unlit: bool,
}

impl Materials {
    /// The material with this index.
    pub(super) fn get<'a>(
        &mut self,
        source: &Source<'a>,
        index: usize,
        value: &Value<'a>,
    ) -> Result<Finish, ModelError> {
        if let Some(known) = self.known.get(&index) {
            return Ok(*known);
        }
        note_unused_textures(source, value)?;
        let surface = self.surface(source, value)?;
        let color = match &surface.texture {
            Some(texture) => self.images.color(source, texture, surface.base)?,
            None => Paint::Color(surface.base),
        };
        // The mean takes a look at every pixel.
        let metal = if surface.metallic > 0.0 { self.mean_base(source, &surface)? } else { Rgb::BLACK };
        let mut material = Classic { color, ..classic(&surface, metal) };
        self.add_transmission(source, value, &surface, &mut material)?;
        let opacity = self.add_alpha(source, value, &surface, &mut material)?;
        let emission = Emission::of(self.emission(source, value, &surface)?);
        let material = Material::of(MaterialKind::Classic(material));
        let material = Material { opacity: opacity.unwrap_or(material.opacity), emission, ..material };
        let has_texture = surface.texture.is_some();
        let finish = Finish {
            id: MaterialId(self.list.len() as u32),
            uv_set: surface.texture.as_ref().map_or(0, |texture| texture.uv_set),
            tint: if has_texture { Rgb::WHITE } else { surface.base },
            has_texture,
            has_alpha: !matches!(value.text("alphaMode")?, None | Some("OPAQUE")),
        };
        self.list.push(material);
        self.known.insert(index, finish);
        Ok(finish)
    }

    fn surface<'a>(&mut self, source: &Source<'a>, material: &Value<'a>) -> Result<Surface, ModelError> {
        let unlit = material.extension("KHR_materials_unlit")?.is_some();
        if let Some(glossy) = material.extension("KHR_materials_pbrSpecularGlossiness")? {
            return specular_glossiness(source, &glossy, unlit);
        }
        let (mut base, mut alpha, mut texture) = (Rgb::WHITE, 1.0, None);
        let (mut metallic, mut roughness) = (1.0, 1.0);
        if let Some(pbr) = material.object("pbrMetallicRoughness")? {
            (base, alpha) = color_and_alpha(&pbr, "baseColorFactor")?;
            texture = TextureUse::of(source, &pbr, "baseColorTexture")?;
            (metallic, roughness) = (fraction(&pbr, "metallicFactor", 1.0)?, fraction(&pbr, "roughnessFactor", 1.0)?);
            if !unlit && let Some(map) = TextureUse::of(source, &pbr, "metallicRoughnessTexture")? {
                source.notes.add("only the mean of metallic-roughness textures is used", material.place);
                let mean = self.images.mean(source, &map, Encoding::Linear)?;
                (metallic, roughness) = (metallic * mean.b, roughness * mean.g);
            }
        }
        Ok(Surface { base, alpha, texture, metallic, roughness, reflectance: reflectance(source, material)?, unlit })
    }

    /// The color, where only one can be used.
    fn mean_base(&mut self, source: &Source<'_>, surface: &Surface) -> Result<Rgb, ModelError> {
        match &surface.texture {
            Some(texture) => Ok(surface.base * self.images.mean(source, texture, Encoding::Srgb)?),
            None => Ok(surface.base),
        }
    }

    /// KHR_materials_transmission and KHR_materials_volume.
    fn add_transmission<'a>(
        &mut self,
        source: &Source<'a>,
        value: &Value<'a>,
        surface: &Surface,
        material: &mut Classic,
    ) -> Result<(), ModelError> {
        let Some(extension) = value.extension("KHR_materials_transmission")? else { return Ok(()) };
        let transmission = fraction(&extension, "transmissionFactor", 0.0)? * (1.0 - surface.metallic);
        if transmission == 0.0 || surface.unlit {
            return Ok(());
        }
        if surface.roughness > LEAST_ROUGH {
            source.notes.add("rough transparent materials are shown clear", value.place);
        }
        material.transparency = self.mean_base(source, surface)? * transmission;
        // The renderer takes what passes away from the rest, by color; the share of the rest is to be 1 - transmission.
        let left = 1.0 - material.transparency.luminance();
        let share = if left > 0.0 { ((1.0 - transmission) / left).min(1.0) } else { 0.0 };
        (material.diffuse, material.ambient) = (material.diffuse * share, material.ambient * share);
        if let Some(volume) = value.extension("KHR_materials_volume")?
            && volume.number("thicknessFactor")?.unwrap_or(0.0) > 0.0
        {
            material.ior = Some(ior(value)?.clamp(1.0, 10.0));
            material.fresnel = true;
            material.reflection = material.reflection * (1.0 - transmission);
            material.attenuation = attenuation(&volume)?;
        }
        Ok(())
    }

    /// `alphaMode`: all there is; or by degrees, from the factor as transparency and from the texture as opacity. Gives the
    /// opacity, if it is not that of a whole surface.
    fn add_alpha<'a>(
        &mut self,
        source: &Source<'a>,
        value: &Value<'a>,
        surface: &Surface,
        material: &mut Classic,
    ) -> Result<Option<Paint>, ModelError> {
        let alpha = surface.alpha;
        match value.text("alphaMode")? {
            None | Some("OPAQUE") => {}
            Some("BLEND") => {
                let by_texture = match &surface.texture {
                    Some(texture) => self.images.alpha(source, texture, alpha)?,
                    None => None,
                };
                if by_texture.is_some() {
                    return Ok(by_texture);
                }
                material.transparency = material.transparency * alpha + Rgb::gray(1.0 - alpha);
            }
            Some("MASK") => {
                let cutoff = value.number("alphaCutoff")?.unwrap_or(0.5) as f32;
                let by_texture = match &surface.texture {
                    Some(texture) if alpha > 0.0 => self.images.mask(source, texture, cutoff / alpha)?,
                    _ => None,
                };
                return Ok(by_texture.or((alpha < cutoff).then_some(Paint::Color(Rgb::BLACK))));
            }
            Some(_) => return Err(value.fault("alphaMode must be OPAQUE, MASK or BLEND")),
        }
        Ok(None)
    }

    /// `emissiveFactor` and KHR_materials_emissive_strength.
    fn emission<'a>(&mut self, source: &Source<'a>, value: &Value<'a>, surface: &Surface) -> Result<Rgb, ModelError> {
        if surface.unlit {
            return Ok(Rgb::BLACK);
        }
        let [r, g, b] = value.numbers("emissiveFactor")?.unwrap_or([0.0; 3]);
        let strength = match value.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.number("emissiveStrength")?.unwrap_or(1.0),
            None => 1.0,
        };
        let factor = Rgb::from([r, g, b].map(|factor| (factor * strength).clamp(0.0, BRIGHTEST) as f32));
        if factor.is_black() {
            return Ok(Rgb::BLACK);
        }
        Ok(match TextureUse::of(source, value, "emissiveTexture")? {
            Some(texture) => {
                source.notes.add("only the mean of emissive textures is used", value.place);
                factor * self.images.mean(source, &texture, Encoding::Srgb)?
            }
            None => factor,
        })
    }
}

/// KHR_materials_pbrSpecularGlossiness.
fn specular_glossiness<'a>(source: &Source<'a>, glossy: &Value<'a>, unlit: bool) -> Result<Surface, ModelError> {
    let (base, alpha) = color_and_alpha(glossy, "diffuseFactor")?;
    if glossy.has("specularGlossinessTexture") {
        source.notes.add("specular-glossiness textures are not used", glossy.place);
    }
    Ok(Surface {
        base,
        alpha,
        texture: TextureUse::of(source, glossy, "diffuseTexture")?,
        metallic: 0.0,
        roughness: 1.0 - fraction(glossy, "glossinessFactor", 1.0)?,
        reflectance: color(glossy, "specularFactor")?,
        unlit,
    })
}

/// Everything that follows from metal, with its mean color, and roughness alone.
fn classic(surface: &Surface, metal: Rgb) -> Classic {
    let &Surface { metallic, roughness, reflectance, unlit, .. } = surface;
    let default = Classic::default();
    if unlit {
        return Classic { ambient: 1.0, diffuse: 0.0, ..default };
    }
    let smooth = (1.0 - roughness) * (1.0 - roughness);
    let shininess = shininess(roughness);
    let diffuse = 1.0 - metallic * smooth;
    let reflection = reflectance.lerp(metal, metallic) * smooth;
    Classic {
        ambient: default.ambient * diffuse,
        diffuse,
        specular: highlight(reflectance, shininess).lerp(metal * (1.0 - roughness), metallic),
        shininess,
        reflection: if reflection.max_component() < LEAST_REFLECTION { Rgb::BLACK } else { reflection },
        ..default
    }
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

/// The part of light that a surface which is not metal mirrors straight back: KHR_materials_ior and KHR_materials_specular.
fn reflectance<'a>(source: &Source<'a>, material: &Value<'a>) -> Result<Rgb, ModelError> {
    let ior = ior(material)?;
    let root = ((ior - 1.0) / (ior + 1.0)) as f32;
    let plain = Rgb::gray(root * root);
    let Some(specular) = material.extension("KHR_materials_specular")? else { return Ok(plain) };
    if specular.has("specularTexture") || specular.has("specularColorTexture") {
        source.notes.add("specular textures are not used", material.place);
    }
    let factor = fraction(&specular, "specularFactor", 1.0)?;
    let [r, g, b] = specular.numbers("specularColorFactor")?.unwrap_or([1.0; 3]);
    let color = Rgb::from([r, g, b].map(|factor| factor.clamp(0.0, BRIGHTEST) as f32));
    Ok((plain * color).map(|component| component.min(1.0)) * factor)
}

/// The index of refraction. 0 stands for infinity in the extension.
fn ior(material: &Value<'_>) -> Result<f64, ModelError> {
    match material.extension("KHR_materials_ior")? {
        Some(extension) => Ok(extension.number("ior")?.unwrap_or(1.5).clamp(0.0, 1e6)),
        None => Ok(1.5),
    }
}

fn attenuation(volume: &Value<'_>) -> Result<Option<Attenuation>, ModelError> {
    let color = color(volume, "attenuationColor")?.map(|component| component.max(1e-4));
    match volume.number("attenuationDistance")? {
        Some(distance) if distance > 0.0 && color != Rgb::WHITE => {
            Ok(Some(Attenuation { color, distance: distance.clamp(1e-9, 1e12) }))
        }
        _ => Ok(None),
    }
}

/// Notes the textures that are not used yet.
fn note_unused_textures(source: &Source<'_>, material: &Value<'_>) -> Result<(), ModelError> {
    let note = |from: Option<Value<'_>>, field, sentence| {
        if from.is_some_and(|from| from.has(field)) {
            source.notes.add(sentence, material.place);
        }
    };
    note(Some(*material), "normalTexture", "normal textures are not used");
    note(Some(*material), "occlusionTexture", "occlusion textures are not used");
    let transmission = material.extension("KHR_materials_transmission")?;
    note(transmission, "transmissionTexture", "transmission textures are not used");
    note(material.extension("KHR_materials_volume")?, "thicknessTexture", "thickness textures are not used");
    Ok(())
}

fn fraction(from: &Value<'_>, field: &'static str, or: f32) -> Result<f32, ModelError> {
    Ok(from.number(field)?.map_or(or, |number| number.clamp(0.0, 1.0) as f32))
}

/// A color; white unless the file says otherwise.
fn color(from: &Value<'_>, field: &'static str) -> Result<Rgb, ModelError> {
    let color = from.numbers::<3>(field)?.unwrap_or([1.0; 3]);
    Ok(Rgb::from(color.map(|component| component.clamp(0.0, 1.0) as f32)))
}

/// A color with alpha; white, and all there, unless the file says otherwise.
fn color_and_alpha(from: &Value<'_>, field: &'static str) -> Result<(Rgb, f32), ModelError> {
    let color = from.numbers::<4>(field)?.unwrap_or([1.0; 4]);
    let [r, g, b, alpha] = color.map(|component| component.clamp(0.0, 1.0) as f32);
    Ok((Rgb::new(r, g, b), alpha))
}
