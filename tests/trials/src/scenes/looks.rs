//! Materials, textures and images.

use super::{MATERIALS, Maker, TEXTURES};
use durer::imaging::{Alpha, Bitmap, Texels};
use durer::math::Rgb;
use durer::scene::{
    Attenuation, Channels, Classic, Emission, Encoding, Filter, ImageAsset, ImageId, ImageTexture, Mapping, Material,
    MaterialId, MaterialKind, Paint, Pattern, Space, Texture, TextureId, Wrap,
};
use std::sync::Arc;

impl Maker<'_, '_> {
    pub(super) fn material_id(&mut self) -> MaterialId {
        MaterialId(self.dice.below(MATERIALS) as u32)
    }

    /// A color, or one of the first `of` textures.
    pub(super) fn paint(&mut self, of: usize) -> Paint {
        match of > 0 && self.dice.one_in(2) {
            true => Paint::Texture(TextureId(self.dice.below(of) as u32)),
            false => Paint::Color(self.color()),
        }
    }

    fn paints(&mut self, of: usize) -> Vec<Paint> {
        let mut paints = self.some(3, |maker| maker.paint(of));
        paints.push(self.paint(of));
        paints
    }

    pub(super) fn material(&mut self) -> Material {
        let is_clear = self.dice.one_in(2);
        let attenuation = match is_clear && self.dice.one_in(2) {
            true => {
                let color = Rgb::new(self.fraction(), self.fraction(), self.fraction()).map(|part| part.max(1e-6));
                Some(Attenuation { color, distance: self.size() })
            }
            false => None,
        };
        let classic = Classic {
            color: self.paint(TEXTURES),
            ambient: self.strength(),
            diffuse: self.strength(),
            specular: self.light_color(),
            shininess: if self.is_odd() {
                self.dice.one_of(&[0.0, 1e-6, 1e6])
            } else {
                self.dice.within(1.0, 60.0) as f32
            },
            reflection: if self.dice.one_in(3) { self.color() } else { Rgb::BLACK },
            transparency: if is_clear { self.color() } else { Rgb::BLACK },
            ior: self.option(|maker| maker.ior()),
            fresnel: self.dice.one_in(2),
            attenuation,
        };
        Material {
            emission: if self.dice.one_in(4) { Emission::of(self.light_color()) } else { Emission::NONE },
            opacity: if self.dice.one_in(3) { self.paint(TEXTURES) } else { Paint::Color(Rgb::WHITE) },
            ..Material::of(MaterialKind::Classic(classic))
        }
    }

    pub(super) fn ior(&mut self) -> f64 {
        match self.is_odd() {
            true => self.dice.one_of(&[0.1, 1.0, 1.000_000_1, 10.0]),
            false => self.dice.within(1.1, 2.0),
        }
    }

    /// A texture of colors and of the textures before it.
    pub(super) fn texture(&mut self, before: usize) -> Texture {
        let space = self.dice.one_of(&[Space::Object, Space::Uv]);
        let wrap = self.dice.one_of(&[Wrap::Repeat, Wrap::Clamp, Wrap::Mirror]);
        let colors = [self.paint(before), self.paint(before)];
        let octaves = 1 + self.dice.below(16) as u32;
        let turbulence = if self.is_odd() { self.magnitude(-9, 6) } else { self.dice.unit() };
        let size = self.size();
        let pattern = match self.dice.below(8) {
            0 => Pattern::Checker { colors, size, space },
            1 => Pattern::Stripes { colors: self.paints(before), axis: self.direction(), width: size, space },
            2 => Pattern::Rings { colors: self.paints(before), width: size, space },
            3 => {
                let colors = self.paints(before);
                Pattern::Gradient { colors, axis: self.direction(), length: size, wrap, space }
            }
            4 => Pattern::Noise { colors, size, octaves },
            5 => Pattern::Marble { colors, size, turbulence, octaves },
            6 => Pattern::Wood { colors, size, turbulence, octaves },
            _ => Pattern::Image(self.shown(wrap)),
        };
        Texture { name: None, transform: self.transform(), pattern }
    }

    fn shown(&mut self, wrap: Wrap) -> ImageTexture {
        let half_height = self.size();
        let mappings = [Mapping::Uv, Mapping::Planar, Mapping::Spherical, Mapping::Cylindrical { half_height }];
        ImageTexture {
            image: ImageId(0),
            mapping: self.dice.one_of(&mappings),
            wrap,
            filter: self.dice.one_of(&[Filter::Nearest, Filter::Bilinear]),
            encoding: self.dice.one_of(&[Encoding::Srgb, Encoding::Linear]),
            channels: self.dice.one_of(&[Channels::Color, Channels::Alpha]),
            tint: self.light_color(),
        }
    }

    pub(super) fn image(&mut self) -> ImageAsset {
        let (width, height) = (1 + self.dice.below(3), 1 + self.dice.below(3));
        let count = width * height;
        let texels = match self.dice.below(3) {
            0 => Texels::U8(self.dice.some(count, |dice| [dice.byte(), dice.byte(), dice.byte()])),
            1 => Texels::U16(self.dice.some(count, |dice| [dice.byte().into(), u16::from(dice.byte()) << 8, 65535])),
            _ => Texels::F32((0..count).map(|_| [self.texel(), self.texel(), self.texel()]).collect()),
        };
        let alpha = match self.dice.below(4) {
            0 => Some(Alpha::U8(self.dice.some(count, |dice| dice.byte()))),
            1 => Some(Alpha::F32((0..count).map(|_| self.texel()).collect())),
            _ => None,
        };
        let bitmap = Bitmap { width: width as u32, height: height as u32, texels, alpha };
        ImageAsset { file: "image.pfm".to_owned(), bitmap: Arc::new(bitmap) }
    }

    /// A number in a file of measured light: anything finite.
    fn texel(&mut self) -> f32 {
        match self.is_odd() {
            true => self.dice.one_of(&[-1.0, 1e-40, 1e30, f32::MAX, f32::MIN]),
            false => self.fraction(),
        }
    }
}
