//! Materials: glTF's metallic-roughness model is the scene's principled one.

use super::super::ModelError;
use super::images::{Images, Meaning, TextureUse};
use super::source::Source;
use super::value::Value;
use durer_math::Rgb;
use durer_scene::{
    Attenuation, Channels, Classic, Emission, Material, MaterialId, MaterialKind, NormalMap, Paint, Principled, Relief,
};
use std::collections::HashMap;
use std::f64::consts::TAU;

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

/// The brightest light that scenes allow.
const BRIGHTEST: f64 = 1e6;
/// The greatest index of refraction that scenes allow.
const GREATEST_IOR: f64 = 10.0;
/// What is mirrored straight back at an index of 1.5.
const USUAL_REFLECTANCE: f32 = 0.04;

/// A material while it is read.
struct Reader<'m, 's, 'a> {
    images: &'m mut Images,
    source: &'s Source<'a>,
    /// The set of texture coordinates of its first texture.
    uv_set: Option<usize>,
}

/// What the two models of glTF have in common.
struct Base<'a> {
    /// Where its fields stand.
    value: Option<Value<'a>>,
    /// Linear.
    color: Rgb,
    alpha: f32,
    texture: Option<TextureUse>,
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
        let mut reader = Reader { images: &mut self.images, source, uv_set: None };
        let (material, base) = reader.material(value)?;
        let uv_set = reader.uv_set;
        let finish = Finish {
            id: MaterialId(self.list.len() as u32),
            uv_set: uv_set.unwrap_or(0),
            tint: if base.texture.is_some() { Rgb::WHITE } else { base.color },
            has_texture: uv_set.is_some(),
            has_alpha: !matches!(value.text("alphaMode")?, None | Some("OPAQUE")),
        };
        self.list.push(material);
        self.known.insert(index, finish);
        Ok(finish)
    }
}

impl<'a> Reader<'_, '_, 'a> {
    fn material(&mut self, value: &Value<'a>) -> Result<(Material, Base<'a>), ModelError> {
        self.note_unused(value)?;
        let glossy = value.extension("KHR_materials_pbrSpecularGlossiness")?;
        let base = match &glossy {
            Some(glossy) => self.base(Some(*glossy), "diffuseFactor", "diffuseTexture")?,
            None => self.base(value.object("pbrMetallicRoughness")?, "baseColorFactor", "baseColorTexture")?,
        };
        let color = match &base.texture {
            Some(texture) => self.images.show(self.source, texture, Meaning::Color, base.color)?,
            None => Paint::Color(base.color),
        };
        let is_unlit = value.extension("KHR_materials_unlit")?.is_some();
        let kind = if is_unlit {
            MaterialKind::Classic(Classic { color, ambient: 1.0, diffuse: 0.0, ..Classic::default() })
        } else if let Some(glossy) = &glossy {
            MaterialKind::Principled(Box::new(self.specular_glossiness(glossy, color)?))
        } else {
            MaterialKind::Principled(Box::new(self.principled(value, &base, color)?))
        };
        let opacity = self.opacity(value, &base)?;
        let (emission, relief) = match is_unlit {
            true => (Emission::NONE, None),
            false => (self.emission(value)?, self.relief(value)?),
        };
        Ok((Material { name: None, kind, emission, opacity, relief }, base))
    }

    fn base(
        &mut self,
        value: Option<Value<'a>>,
        factor: &'static str,
        field: &'static str,
    ) -> Result<Base<'a>, ModelError> {
        let (mut color, mut alpha, mut texture) = (Rgb::WHITE, 1.0, None);
        if let Some(value) = &value {
            (color, alpha) = color_and_alpha(value, factor)?;
            texture = self.texture(value, field)?;
        }
        Ok(Base { value, color, alpha, texture })
    }

    /// KHR_materials_pbrSpecularGlossiness: what is mirrored straight back is said as a color, and nothing is metal.
    fn specular_glossiness(&mut self, glossy: &Value<'a>, base_color: Paint) -> Result<Principled, ModelError> {
        if glossy.has("specularGlossinessTexture") {
            self.source.notes.add("specular-glossiness textures are not used", glossy.place);
        }
        Ok(Principled {
            base_color,
            roughness: gray(1.0 - fraction(glossy, "glossinessFactor", 1.0)?),
            specular_color: Paint::Color(color(glossy, "specularFactor")? * (1.0 / USUAL_REFLECTANCE)),
            ..Principled::default()
        })
    }

    fn principled(&mut self, value: &Value<'a>, base: &Base<'a>, base_color: Paint) -> Result<Principled, ModelError> {
        let (mut metallic, mut roughness) = (gray(1.0), gray(1.0));
        if let Some(pbr) = &base.value {
            let map = "metallicRoughnessTexture";
            metallic = self.amount(pbr, "metallicFactor", 1.0, map, Channels::Blue)?;
            roughness = self.amount(pbr, "roughnessFactor", 1.0, map, Channels::Green)?;
        }
        let mut principled = Principled { base_color, metallic, roughness, ..Principled::default() };
        self.add_specular(value, &mut principled)?;
        self.add_transmission(value, &mut principled)?;
        self.add_coat_and_sheen(value, &mut principled)?;
        self.add_anisotropy(value, &mut principled)?;
        Ok(principled)
    }

    /// KHR_materials_ior and KHR_materials_specular. An index that scenes do not have becomes the nearest, and the color of
    /// the reflection makes up for it; 0 stands for infinity in the extension.
    fn add_specular(&mut self, value: &Value<'a>, principled: &mut Principled) -> Result<(), ModelError> {
        let ior = ior(value)?;
        principled.ior = if ior == 0.0 { GREATEST_IOR } else { ior.clamp(1.0, GREATEST_IOR) };
        let missing = match straight_back(principled.ior) {
            least if least > 0.0 && principled.ior != ior => straight_back(ior) / least,
            _ => 1.0,
        };
        let Some(specular) = value.extension("KHR_materials_specular")? else {
            principled.specular_color = gray(missing);
            return Ok(());
        };
        principled.specular = self.amount(&specular, "specularFactor", 1.0, "specularTexture", Channels::Alpha)?;
        let [r, g, b] = specular.numbers("specularColorFactor")?.unwrap_or([1.0; 3]);
        let factor = Rgb::from([r, g, b].map(|factor: f64| factor.clamp(0.0, BRIGHTEST) as f32)) * missing;
        principled.specular_color = self.tinted(&specular, factor, "specularColorTexture")?;
        Ok(())
    }

    /// KHR_materials_transmission and KHR_materials_volume; without a thickness, a surface is a sheet.
    fn add_transmission(&mut self, value: &Value<'a>, principled: &mut Principled) -> Result<(), ModelError> {
        if let Some(extension) = value.extension("KHR_materials_transmission")? {
            principled.transmission =
                self.amount(&extension, "transmissionFactor", 0.0, "transmissionTexture", Channels::Red)?;
        }
        let volume = value.extension("KHR_materials_volume")?;
        let thickness = volume.map(|volume| volume.number("thicknessFactor")).transpose()?.flatten();
        principled.thin = !thickness.is_some_and(|thickness| thickness > 0.0);
        if let Some(volume) = volume.filter(|_| !principled.thin) {
            principled.attenuation = attenuation(&volume)?;
        }
        Ok(())
    }

    /// KHR_materials_clearcoat and KHR_materials_sheen.
    fn add_coat_and_sheen(&mut self, value: &Value<'a>, principled: &mut Principled) -> Result<(), ModelError> {
        if let Some(coat) = value.extension("KHR_materials_clearcoat")? {
            let (strength, roughness) = ("clearcoatTexture", "clearcoatRoughnessTexture");
            principled.clearcoat = self.amount(&coat, "clearcoatFactor", 0.0, strength, Channels::Red)?;
            principled.clearcoat_roughness =
                self.amount(&coat, "clearcoatRoughnessFactor", 0.0, roughness, Channels::Green)?;
        }
        if let Some(sheen) = value.extension("KHR_materials_sheen")? {
            let factor = sheen.numbers::<3>("sheenColorFactor")?.unwrap_or([0.0; 3]);
            let factor = Rgb::from(factor.map(|component| component.clamp(0.0, 1.0) as f32));
            principled.sheen_color = self.tinted(&sheen, factor, "sheenColorTexture")?;
            let roughness = "sheenRoughnessTexture";
            principled.sheen_roughness =
                self.amount(&sheen, "sheenRoughnessFactor", 0.0, roughness, Channels::Alpha)?;
        }
        Ok(())
    }

    /// KHR_materials_anisotropy: the texture has directions in red and green, and strengths in blue.
    fn add_anisotropy(&mut self, value: &Value<'a>, principled: &mut Principled) -> Result<(), ModelError> {
        let Some(extension) = value.extension("KHR_materials_anisotropy")? else { return Ok(()) };
        let texture = "anisotropyTexture";
        principled.anisotropy = self.amount(&extension, "anisotropyStrength", 0.0, texture, Channels::Blue)?;
        let turns = extension.number("anisotropyRotation")?.unwrap_or(0.0) / TAU;
        let turns = turns - turns.floor();
        let directions = if is_black(principled.anisotropy) { None } else { self.texture(&extension, texture)? };
        principled.anisotropy_rotation = match directions {
            Some(directions) => self.images.turns(self.source, &directions, turns)?,
            None => gray(turns as f32),
        };
        Ok(())
    }

    /// `alphaMode`: all there is; or what the factor and the texture say; or where that reaches the cutoff.
    fn opacity(&mut self, value: &Value<'a>, base: &Base<'a>) -> Result<Paint, ModelError> {
        let alpha = base.alpha;
        Ok(match value.text("alphaMode")? {
            None | Some("OPAQUE") => gray(1.0),
            Some("BLEND") => {
                let by_texture = match &base.texture {
                    Some(texture) => self.images.alpha(self.source, texture, alpha)?,
                    None => None,
                };
                by_texture.unwrap_or(gray(alpha))
            }
            Some("MASK") => {
                let cutoff = value.number("alphaCutoff")?.unwrap_or(0.5) as f32;
                let by_texture = match &base.texture {
                    Some(texture) if alpha > 0.0 => self.images.mask(self.source, texture, cutoff / alpha)?,
                    _ => None,
                };
                by_texture.unwrap_or(gray(if alpha < cutoff { 0.0 } else { 1.0 }))
            }
            Some(_) => return Err(value.fault("alphaMode must be OPAQUE, MASK or BLEND")),
        })
    }

    /// `emissiveFactor` and KHR_materials_emissive_strength.
    fn emission(&mut self, value: &Value<'a>) -> Result<Emission, ModelError> {
        let [r, g, b] = value.numbers("emissiveFactor")?.unwrap_or([0.0; 3]);
        let strength = match value.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.number("emissiveStrength")?.unwrap_or(1.0),
            None => 1.0,
        };
        let factor = Rgb::from([r, g, b].map(|factor: f64| factor.clamp(0.0, 1.0) as f32));
        if factor.is_black() {
            return Ok(Emission::NONE);
        }
        let color = self.tinted(value, factor, "emissiveTexture")?;
        Ok(Emission { color, strength: strength.clamp(0.0, BRIGHTEST) as f32, ..Emission::NONE })
    }

    /// `normalTexture`.
    fn relief(&mut self, value: &Value<'a>) -> Result<Option<Relief>, ModelError> {
        let Some(texture) = self.texture(value, "normalTexture")? else { return Ok(None) };
        let scale = value.object("normalTexture")?.map(|reference| reference.number("scale")).transpose()?.flatten();
        let strength = scale.unwrap_or(1.0).clamp(0.0, BRIGHTEST) as f32;
        let texture = self.images.show(self.source, &texture, Meaning::Numbers(Channels::Color), Rgb::WHITE)?;
        Ok(Some(Relief::NormalMap(NormalMap { texture, strength })))
    }

    /// A number from 0 to 1, times a channel of a texture.
    fn amount(
        &mut self,
        value: &Value<'a>,
        factor: &'static str,
        or: f32,
        field: &'static str,
        channel: Channels,
    ) -> Result<Paint, ModelError> {
        let factor = fraction(value, factor, or)?;
        if factor == 0.0 {
            return Ok(gray(0.0));
        }
        match self.texture(value, field)? {
            Some(texture) => self.images.show(self.source, &texture, Meaning::Numbers(channel), Rgb::gray(factor)),
            None => Ok(gray(factor)),
        }
    }

    /// A color, times that of a texture.
    fn tinted(&mut self, value: &Value<'a>, factor: Rgb, field: &'static str) -> Result<Paint, ModelError> {
        if factor.is_black() {
            return Ok(Paint::Color(factor));
        }
        match self.texture(value, field)? {
            Some(texture) => self.images.show(self.source, &texture, Meaning::Color, factor),
            None => Ok(Paint::Color(factor)),
        }
    }

    /// A texture of the material. Meshes have one set of texture coordinates: that of the first texture.
    fn texture(&mut self, value: &Value<'a>, field: &'static str) -> Result<Option<TextureUse>, ModelError> {
        let texture = TextureUse::of(self.source, value, field)?;
        if let Some(texture) = &texture
            && *self.uv_set.get_or_insert(texture.uv_set) != texture.uv_set
        {
            let sentence = "all textures of a material are laid on by the texture coordinates of the first";
            self.source.notes.add(sentence, value.place);
        }
        Ok(texture)
    }

    /// Notes the textures that are not used.
    fn note_unused(&self, material: &Value<'a>) -> Result<(), ModelError> {
        let note = |from: Option<Value<'_>>, field, sentence| {
            if from.is_some_and(|from| from.has(field)) {
                self.source.notes.add(sentence, material.place);
            }
        };
        let occlusion = "occlusion textures are not used: where light does not come is computed";
        note(Some(*material), "occlusionTexture", occlusion);
        note(material.extension("KHR_materials_volume")?, "thicknessTexture", "thickness textures are not used");
        let coat = material.extension("KHR_materials_clearcoat")?;
        note(coat, "clearcoatNormalTexture", "clear coats have no normal textures of their own");
        Ok(())
    }
}

fn is_black(paint: Paint) -> bool {
    paint == Paint::Color(Rgb::BLACK)
}

fn gray(amount: f32) -> Paint {
    Paint::Color(Rgb::gray(amount))
}

/// The part of light that a smooth boundary of this index mirrors straight back; 0 stands for infinity.
fn straight_back(ior: f64) -> f32 {
    let root = ((ior - 1.0) / (ior + 1.0)) as f32;
    root * root
}

/// The index of refraction.
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
