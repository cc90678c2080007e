//! MTL, the material libraries of OBJ files.
//!
//! The format describes surfaces of the same kind as ours: Phong's, with mirrors and glass. What follows shows where the
//! two differ, or where files mean other than what the description of the format says.

mod parse;
#[cfg(test)]
mod tests;

use super::warnings::Warnings;
use super::{beside, gathered};
use crate::limits::textures;
use crate::{AssetError, Assets, Limits};
use durer_imaging::decode;
use durer_math::{DVec3, Rgb};
use durer_scene::{
    Channels, Classic, Emission, Encoding, Filter, ImageAsset, ImageId, ImageTexture, Mapping, Material, MaterialId,
    MaterialKind, Paint, Pattern, Scene, Texture, TextureId, Transform, TransformStep, Wrap,
};
use parse::{Entry, Map};
use std::collections::BTreeMap;
use std::sync::Arc;

/// All libraries of one OBJ file, and what has become of those of their materials that are used.
pub(super) struct Library<'a> {
    /// The OBJ file; libraries and images lie beside it.
    file: &'a str,
    assets: &'a dyn Assets,
    limits: &'a Limits,
    entries: BTreeMap<String, Entry>,
    /// True if a library cannot be read: that its materials are missing goes without saying.
    lacks_some: bool,
    used: BTreeMap<String, Option<MaterialId>>,
    images: BTreeMap<String, Option<ImageId>>,
    texture_bytes: u64,
    /// Materials, textures and images.
    pub(super) scene: Scene,
}

impl<'a> Library<'a> {
    /// No materials yet, for an OBJ file.
    pub(super) fn new(file: &'a str, assets: &'a dyn Assets, limits: &'a Limits) -> Library<'a> {
        Library {
            file,
            assets,
            limits,
            entries: BTreeMap::new(),
            lacks_some: false,
            used: BTreeMap::new(),
            images: BTreeMap::new(),
            texture_bytes: 0,
            scene: gathered::nothing(),
        }
    }

    /// Reads a library; if it cannot be had there is a warning.
    pub(super) fn open(&mut self, name: &str, warnings: &mut Warnings) {
        match self.read(name, self.limits.max_file_bytes) {
            Ok((_, bytes)) => parse::parse(&bytes, &mut self.entries, warnings),
            Err(error) => {
                self.lacks_some = true;
                warnings.add(format!(
                    "{}; its materials became the default one",
                    cannot("read the materials", name, &error)
                ));
            }
        }
    }

    /// True if there is such a file.
    pub(super) fn has_file(&self, name: &str) -> bool {
        !matches!(self.read(name, self.limits.max_file_bytes), Err(AssetError::NotFound))
    }

    /// A file that the model names, and the name under which it was found. Models are moved around without care for the
    /// folders that their names lead through, so a file of that name beside the model will do.
    fn read(&self, name: &str, max_bytes: u64) -> Result<(String, Vec<u8>), AssetError> {
        let whole = beside(self.file, name);
        let error = match self.assets.read(&whole, max_bytes) {
            Ok(bytes) => return Ok((whole, bytes)),
            Err(error) => error,
        };
        let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let here = beside(self.file, last);
        if last.is_empty() || here == whole {
            return Err(error);
        }
        self.assets.read(&here, max_bytes).map(|bytes| (here, bytes)).map_err(|_| error)
    }

    /// The material of this name; `None`, with a warning, if there is none.
    pub(super) fn material(&mut self, name: &str, warnings: &mut Warnings) -> Option<MaterialId> {
        if let Some(known) = self.used.get(name) {
            return *known;
        }
        let id = match self.entries.get(name).cloned() {
            Some(entry) => {
                let material = self.make(&entry, warnings);
                self.scene.materials.push(material);
                Some(MaterialId(self.scene.materials.len() as u32 - 1))
            }
            None if self.lacks_some => None,
            None => {
                warnings.add(format!("there is no material `{}`; it became the default one", shorten(name)));
                None
            }
        };
        self.used.insert(name.to_owned(), id);
        id
    }

    fn make(&mut self, entry: &Entry, warnings: &mut Warnings) -> Material {
        let plain = entry.to_material();
        let MaterialKind::Classic(classic) = &plain.kind else { return plain };
        let Paint::Color(color) = classic.color else { return plain };
        // Some programs write black beside an image that is meant to be seen as it is.
        let tint = if color.is_black() { Rgb::WHITE } else { color };
        let color = entry.color_map.as_ref().and_then(|map| self.texture(map, Encoding::Srgb, tint, warnings));
        let opacity = entry.opacity_map.as_ref();
        let opacity = opacity.and_then(|map| self.texture(map, Encoding::Linear, Rgb::WHITE, warnings));
        let kind = MaterialKind::Classic(Classic { color: color.unwrap_or(classic.color), ..classic.clone() });
        Material { kind, opacity: opacity.unwrap_or(plain.opacity), ..plain }
    }

    fn texture(&mut self, map: &Map, encoding: Encoding, tint: Rgb, warnings: &mut Warnings) -> Option<Paint> {
        let image = self.image(&map.file, warnings)?;
        // Opacity is an image's alpha if it has one; otherwise it is painted in gray.
        let has_alpha = self.scene.images[image.0 as usize].bitmap.alpha.is_some();
        let channels = if encoding == Encoding::Linear && has_alpha { Channels::Alpha } else { Channels::Color };
        let pattern = Pattern::Image(ImageTexture {
            image,
            mapping: Mapping::Uv,
            wrap: if map.is_clamped { Wrap::Clamp } else { Wrap::Repeat },
            filter: Filter::Bilinear,
            encoding,
            channels,
            tint,
        });
        self.scene.textures.push(Texture { name: None, transform: map.transform(), pattern });
        Some(Paint::Texture(TextureId(self.scene.textures.len() as u32 - 1)))
    }

    fn image(&mut self, name: &str, warnings: &mut Warnings) -> Option<ImageId> {
        if let Some(known) = self.images.get(name) {
            return *known;
        }
        let id = match self.load(name) {
            Ok(image) => {
                self.texture_bytes += image.bitmap.memory();
                self.scene.images.push(image);
                Some(ImageId(self.scene.images.len() as u32 - 1))
            }
            Err(warning) => {
                warnings.add(warning);
                None
            }
        };
        self.images.insert(name.to_owned(), id);
        id
    }

    fn load(&self, name: &str) -> Result<ImageAsset, String> {
        let (file, bytes) =
            self.read(name, self.limits.max_file_bytes).map_err(|error| cannot("read the image", name, &error))?;
        let limits = textures::left(self.limits, self.texture_bytes);
        let bitmap =
            decode(&bytes, &limits).map_err(|error| format!("cannot use the image `{}`: {error}", shorten(name)))?;
        Ok(ImageAsset { file, bitmap: Arc::new(bitmap) })
    }
}

impl Entry {
    /// The material without its images.
    fn to_material(&self) -> Material {
        let default = Classic::default();
        let illumination = self.illumination.unwrap_or(2);
        let color = self.diffuse.unwrap_or(Rgb::gray(0.8));
        let specular = self.specular.unwrap_or(Rgb::BLACK);
        // Models 0 and 1 have no highlight. Model 0 would be one color without any shading, but files do not mean that.
        let highlight = if illumination >= 2 { specular } else { Rgb::BLACK };
        let transparency = self.transparency(illumination, specular);
        // Models 5 and 7 reflect after Fresnel, models 6 and 7 refract.
        let refracts = matches!(illumination, 6 | 7) && !transparency.is_black();
        let ior = self.refraction_index.filter(|ior| refracts && (0.1..=10.0).contains(ior) && *ior != 1.0);
        let fresnel = illumination == 7 && ior.is_some();
        // What Fresnel's equations give is all of the reflection.
        let reflects = illumination >= 3 && !fresnel;
        let classic = Classic {
            color: Paint::Color(color.map(gathered::part)),
            ambient: default.ambient * self.ambient_part(color),
            diffuse: 1.0,
            specular: highlight.map(|x| x.clamp(0.0, 1e6)),
            shininess: self.shininess.map_or(default.shininess, |exponent| exponent.clamp(0.0, 1e6) as f32),
            reflection: if reflects { specular.map(gathered::part) } else { Rgb::BLACK },
            transparency,
            ior,
            fresnel,
            ..default
        };
        let emission = Emission::of(self.emission.unwrap_or(Rgb::BLACK).map(|x| x.clamp(0.0, 1e6)));
        Material { emission, ..Material::of(MaterialKind::Classic(classic)) }
    }

    /// How much of the usual ambient light is given back. The format wants a color of its own for it, to be lit by light
    /// that no file tells of. Programs write that of the surface, white, or black where they have none; so only its
    /// brightness against that of the surface is used, and black says nothing.
    fn ambient_part(&self, color: Rgb) -> f32 {
        match self.ambient {
            Some(ambient) if ambient.luminance() > 0.0 && color.luminance() > 0.0 => {
                gathered::part(ambient.luminance() / color.luminance())
            }
            _ => 1.0,
        }
    }

    /// What shows through: as much as the surface is not there, in the color of the filter. A file with model 6 or 7, a
    /// filter and an opaque surface means glass, which lets through what it does not reflect.
    fn transparency(&self, illumination: u32, specular: Rgb) -> Rgb {
        let filter = self.filter.filter(|filter| !filter.is_black());
        let opacity = self.opacity.or(self.transparency.map(|part| 1.0 - part)).unwrap_or(1.0);
        let clear = match filter {
            Some(filter) if matches!(illumination, 6 | 7) && opacity >= 1.0 => (Rgb::WHITE - specular) * filter,
            filter => filter.unwrap_or(Rgb::WHITE) * (1.0 - opacity) as f32,
        };
        clear.map(gathered::part)
    }
}

impl Map {
    /// The format moves and scales coordinates on their way to the image: image = scale · uv + offset. Ours moves the
    /// image, so it is the other way round.
    fn transform(&self) -> Transform {
        let mut steps = Vec::new();
        if self.offset != [0.0; 2] {
            steps.push(TransformStep::Translate(DVec3::new(-self.offset[0], -self.offset[1], 0.0)));
        }
        if self.scale != [1.0; 2] {
            steps.push(TransformStep::Scale(DVec3::new(1.0 / self.scale[0], 1.0 / self.scale[1], 1.0)));
        }
        Transform { steps }
    }
}

fn cannot(what: &str, name: &str, error: &AssetError) -> String {
    let help = error.help().map_or(String::new(), |help| format!(" ({help})"));
    format!("cannot {what} `{}`: {error}{help}", shorten(name))
}

/// A name as messages show it.
fn shorten(name: &str) -> String {
    super::text::shown(name.as_bytes())
}
