//! The mean of a paint, for numbers that cannot vary over a surface.

use durer_imaging::{Alpha, Bitmap, Texels, Transfer};
use durer_math::{DVec3, Rgb};
use durer_scene::{Channels, Encoding, ImageTexture, Paint, Pattern, Scene, TextureId};
use std::collections::BTreeMap;

/// The means of the textures of a scene; each is computed once, when it is asked for.
pub(crate) struct Means<'s> {
    scene: &'s Scene,
    /// No component of a texture's mean is more.
    most: f32,
    known: BTreeMap<u32, Rgb>,
    /// Of whole images, by their number and whether they are taken as sRGB.
    images: BTreeMap<(u32, bool), Rgb>,
}

impl<'s> Means<'s> {
    /// Those of parts of light that is given back, in a scene that passed its check: at most 1, though a picture may hold
    /// more, and be tinted.
    pub(crate) fn new(scene: &'s Scene) -> Means<'s> {
        Means { scene, most: 1.0, known: BTreeMap::new(), images: BTreeMap::new() }
    }

    /// Those of light that is given off.
    pub(crate) fn of_light(scene: &'s Scene) -> Means<'s> {
        Means { most: f32::MAX, ..Means::new(scene) }
    }

    /// The mean color.
    pub(crate) fn of(&mut self, paint: Paint) -> Rgb {
        match paint {
            Paint::Color(color) => color,
            Paint::Texture(TextureId(id)) => {
                if let Some(mean) = self.known.get(&id) {
                    return *mean;
                }
                let most = self.most;
                let mean = self.of_pattern(&self.scene.textures[id as usize].pattern).map(|part| part.min(most));
                self.known.insert(id, mean);
                mean
            }
        }
    }

    /// The mean of a number from 0 to 1.
    pub(crate) fn amount(&mut self, paint: Paint) -> f32 {
        match paint {
            // A gray would lose its last digit in the sum of its components.
            Paint::Color(color) => color.g.clamp(0.0, 1.0),
            Paint::Texture(_) => {
                let color = self.of(paint);
                if color.r == color.g && color.g == color.b { color.g } else { color.luminance() }.clamp(0.0, 1.0)
            }
        }
    }

    fn of_pattern(&mut self, pattern: &Pattern) -> Rgb {
        match pattern {
            Pattern::Checker { .. }
            | Pattern::Stripes { .. }
            | Pattern::Rings { .. }
            | Pattern::Noise { .. }
            | Pattern::Marble { .. }
            | Pattern::Wood { .. } => self.evenly(pattern.colors()),
            // The first and the last color have half the room of the others.
            Pattern::Gradient { colors, .. } => {
                let steps = colors.len().saturating_sub(1).max(1) as f32;
                let each = colors.windows(2).map(|pair| self.evenly(pair));
                each.fold(Rgb::BLACK, |sum, color| sum + color) * (1.0 / steps)
            }
            Pattern::Image(image) => self.of_image(image),
        }
    }

    fn evenly(&mut self, colors: &[Paint]) -> Rgb {
        let sum = colors.iter().fold(Rgb::BLACK, |sum, paint| sum + self.of(*paint));
        sum * (1.0 / colors.len().max(1) as f32)
    }

    fn of_image(&mut self, texture: &ImageTexture) -> Rgb {
        let bitmap = &self.scene.images[texture.image.0 as usize].bitmap;
        let key = (texture.image.0, texture.encoding == Encoding::Srgb);
        let mut colors = || *self.images.entry(key).or_insert_with(|| mean(bitmap, texture.encoding));
        let mean = match texture.channels {
            Channels::Color => colors(),
            Channels::Red => Rgb::gray(colors().r),
            Channels::Green => Rgb::gray(colors().g),
            Channels::Blue => Rgb::gray(colors().b),
            Channels::Alpha => Rgb::gray(bitmap.alpha.as_ref().map_or(1.0, mean_alpha)),
        };
        mean * texture.tint
    }
}

/// The mean of a picture's colors, linear.
fn mean(bitmap: &Bitmap, encoding: Encoding) -> Rgb {
    let transfer = match encoding {
        Encoding::Srgb => Transfer::Srgb,
        Encoding::Linear => Transfer::Linear,
    };
    let linear = |most: u16| -> Vec<f64> {
        let stored = (0..=most).map(|number| f32::from(number) / f32::from(most));
        stored.map(|stored| transfer.linear_from_stored(stored).into()).collect()
    };
    let sum = match &bitmap.texels {
        Texels::U8(texels) => sum(texels, &linear(u8::MAX.into()), |number| number.into()),
        Texels::U16(texels) => sum(texels, &linear(u16::MAX), |number| number.into()),
        Texels::F32(texels) => texels.iter().fold(DVec3::ZERO, |sum, texel| sum + DVec3::from(texel.map(f64::from))),
    };
    let mean = sum / (f64::from(bitmap.width) * f64::from(bitmap.height));
    Rgb::from(mean.to_array().map(|component| component.max(0.0) as f32))
}

/// The sum of what the numbers of texels stand for.
fn sum<T: Copy>(texels: &[[T; 3]], meaning: &[f64], index: impl Fn(T) -> usize) -> DVec3 {
    let add = |sum: DVec3, texel: &[T; 3]| sum + DVec3::from(texel.map(|number| meaning[index(number)]));
    texels.iter().fold(DVec3::ZERO, add)
}

fn mean_alpha(alpha: &Alpha) -> f32 {
    let sum: f64 = (0..alpha.len()).map(|at| f64::from(alpha.get(at))).sum();
    (sum / alpha.len().max(1) as f64).clamp(0.0, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_scene::{Filter, ImageAsset, ImageId, Mapping, Space, Texture, Transform, Wrap};
    use std::sync::Arc;

    fn scene(patterns: Vec<Pattern>) -> Scene {
        let texels = Texels::U8(vec![[255, 0, 51], [255, 255, 153]]);
        let alpha = Some(Alpha::U8(vec![255, 0]));
        let bitmap = Arc::new(Bitmap { width: 2, height: 1, texels, alpha });
        let texture = |pattern| Texture { name: None, transform: Transform::default(), pattern };
        Scene {
            images: vec![ImageAsset { file: "a.png".to_owned(), bitmap }],
            textures: patterns.into_iter().map(texture).collect(),
            ..Scene::default()
        }
    }

    fn image(channels: Channels) -> Pattern {
        let (mapping, wrap, filter, encoding) = (Mapping::Uv, Wrap::Repeat, Filter::Bilinear, Encoding::Linear);
        let (image, tint) = (ImageId(0), Rgb::gray(0.5));
        Pattern::Image(ImageTexture { image, mapping, wrap, filter, encoding, channels, tint })
    }

    #[test]
    fn means_of_images_are_those_of_their_channels() {
        let channels = [Channels::Color, Channels::Red, Channels::Green, Channels::Blue, Channels::Alpha];
        let scene = scene(channels.map(image).to_vec());
        let mut means = Means::new(&scene);
        let expected = [Rgb::new(0.5, 0.25, 0.2), Rgb::gray(0.5), Rgb::gray(0.25), Rgb::gray(0.2), Rgb::gray(0.25)];
        for (id, expected) in (0..).zip(expected) {
            let found = means.of(Paint::Texture(TextureId(id)));
            assert!((found - expected).map(f32::abs).max_component() < 1e-6, "{id}: {found:?}");
        }
        assert!((means.amount(Paint::Texture(TextureId(3))) - 0.2).abs() < 1e-6);
    }

    #[test]
    fn what_is_given_back_is_at_most_all_but_light_has_no_bound() {
        let mut bright = image(Channels::Color);
        if let Pattern::Image(image) = &mut bright {
            image.tint = Rgb::new(1000.0, 2.0, 1.0);
        }
        let scene = scene(vec![bright]);
        let texture = Paint::Texture(TextureId(0));
        assert_eq!(Means::new(&scene).of(texture), Rgb::new(1.0, 1.0, 0.4));
        assert_eq!(Means::of_light(&scene).of(texture), Rgb::new(1000.0, 1.0, 0.4));
    }

    #[test]
    fn means_of_patterns_are_those_of_their_colors() {
        let paint = |gray| Paint::Color(Rgb::gray(gray));
        let space = Space::Object;
        let checker = Pattern::Checker { colors: [paint(0.2), paint(0.6)], size: 1.0, space };
        let colors = vec![paint(0.0), paint(1.0), Paint::Texture(TextureId(0))];
        let gradient = Pattern::Gradient { colors, axis: DVec3::X, length: 1.0, wrap: Wrap::Clamp, space };
        let scene = scene(vec![checker, gradient]);
        let mut means = Means::new(&scene);
        assert!((means.amount(Paint::Texture(TextureId(0))) - 0.4).abs() < 1e-6);
        // Half of 0 to 1, half of 1 to 0.4.
        assert!((means.amount(Paint::Texture(TextureId(1))) - 0.6).abs() < 1e-6);
    }
}
