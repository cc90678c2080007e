//! Pictures of several layers: beside the colors, what else is known of each pixel. Film files, as EXR, hold them.

use crate::files::exr::layers as exr;
use crate::{
    Bitmap, DecodeError, DecodeLimits, EncodeError, EncodeOptions, ExrSamples, FileFormat, Image, Texels, Transfer,
};
use durer_math::Rgb;
use half::f16;

/// The layer of what is seen. In files its channels have no prefix, so that programs that know nothing of layers show it.
pub const BEAUTY: &str = "beauty";

/// A picture of several layers, all of one size: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The layers, each with a name of its own.
    pub layers: Vec<Layer>,
}

/// Channels that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// `beauty`, `normal`, `object_id` …: letters, digits, `_` and, within, dots.
    pub name: String,
    /// The channels, each with a name of its own.
    pub channels: Vec<Channel>,
}

/// One number for each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// `R`, `G`, `B` and `A` of colors, `X`, `Y` and `Z` of vectors, `U` and `V` of coordinates on surfaces, `Z` alone of depth,
    /// `ID` of numbers that name things, `N` of counts.
    pub name: String,
    /// The numbers.
    pub samples: Samples,
}

/// The numbers of a channel, in the precision in which files hold them.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Half precision: 11 significant bits, up to 65504.
    Half(Vec<f16>),
    /// Single precision.
    Float(Vec<f32>),
    /// Whole numbers.
    Whole(Vec<u32>),
}

impl Samples {
    /// Numbers in this precision. In half precision finite ones stay finite.
    pub fn of(numbers: impl Iterator<Item = f32>, precision: ExrSamples) -> Samples {
        match precision {
            ExrSamples::Half => Samples::Half(numbers.map(nearest_half).collect()),
            ExrSamples::Float => Samples::Float(numbers.collect()),
        }
    }

    /// Number of pixels.
    #[allow(clippy::len_without_is_empty, reason = "a picture has pixels")]
    pub fn len(&self) -> usize {
        match self {
            Samples::Half(numbers) => numbers.len(),
            Samples::Float(numbers) => numbers.len(),
            Samples::Whole(numbers) => numbers.len(),
        }
    }

    /// That of the pixel with this index, rounded if it is a large whole number.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn get(&self, index: usize) -> f32 {
        match self {
            Samples::Half(numbers) => numbers[index].to_f32(),
            Samples::Float(numbers) => numbers[index],
            Samples::Whole(numbers) => numbers[index] as f32,
        }
    }
}

/// The nearest half; finite numbers stay finite.
pub(crate) fn nearest_half(v: f32) -> f16 {
    let largest = f16::MAX.to_f32();
    f16::from_f32(if v.is_finite() { v.clamp(-largest, largest) } else { v })
}

impl Layers {
    /// The layer of this name.
    pub fn get(&self, name: &str) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.name == name)
    }

    /// The only layer of a picture that has no others: its colors as beauty, of whole precision.
    pub fn of_image(image: &Image, alpha: Option<&[f32]>) -> Layers {
        let mut beauty = Layer::of_colors(BEAUTY, &image.pixels, ExrSamples::Float);
        beauty.channels.extend(alpha.map(|a| Channel { name: "A".to_owned(), samples: Samples::Float(a.to_vec()) }));
        Layers { width: image.width, height: image.height, layers: vec![beauty] }
    }

    /// As [`Layers::of_image`], of a picture file that holds one picture. Whole numbers are made linear by `transfer`. Colors
    /// come to be multiplied by alpha; those of floating-point files are already.
    pub fn of_bitmap(bitmap: &Bitmap, transfer: Transfer) -> Layers {
        let mut image = bitmap.to_image(transfer);
        let alpha: Option<Vec<f32>> =
            bitmap.alpha.as_ref().map(|alpha| (0..alpha.len()).map(|index| alpha.get(index)).collect());
        let is_straight = !matches!(bitmap.texels, Texels::F32(_));
        if let Some(alpha) = alpha.as_ref().filter(|_| is_straight) {
            image.pixels.iter_mut().zip(alpha).for_each(|(pixel, &alpha)| *pixel *= Rgb::gray(alpha));
        }
        Layers::of_image(&image, alpha.as_deref())
    }
}

impl Layer {
    /// A layer of colors, R, G and B.
    pub fn of_colors(name: &str, colors: &[Rgb], precision: ExrSamples) -> Layer {
        let component = |index: usize| colors.iter().map(move |color| color.to_array()[index]);
        Layer::new(name, [0, 1, 2].map(|i| (["R", "G", "B"][i], Samples::of(component(i), precision))))
    }

    /// A layer of these channels.
    pub fn new<const N: usize>(name: &str, channels: [(&str, Samples); N]) -> Layer {
        let channels = channels.map(|(name, samples)| Channel { name: name.to_owned(), samples });
        Layer { name: name.to_owned(), channels: channels.into() }
    }

    /// The channel of this name.
    pub fn channel(&self, name: &str) -> Option<&Samples> {
        self.channels.iter().find(|channel| channel.name == name).map(|channel| &channel.samples)
    }

    fn channel_names(&self) -> impl Iterator<Item = (&str, &str)> {
        self.channels.iter().map(|channel| (self.name.as_str(), channel.name.as_str()))
    }

    /// The channels of these names, if all are there.
    pub fn all_of<const N: usize>(&self, names: [&str; N]) -> Option<[&Samples; N]> {
        let found: Vec<&Samples> = names.iter().filter_map(|name| self.channel(name)).collect();
        found.try_into().ok()
    }
}

/// What a file says of one of its layers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayerFacts {
    /// The layer's name.
    pub name: String,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The names of its channels, and what their numbers are: `half`, `float` or `integer`.
    pub channels: Vec<(String, &'static str)>,
}

/// The layers in an EXR file.
///
/// # Errors
/// If the bytes do not begin as such a file does.
pub fn layer_facts(bytes: &[u8]) -> Result<Vec<LayerFacts>, DecodeError> {
    exr::about(bytes)
}

/// Reads the layers of an EXR file, or `only` that of this name. The bytes of the limits are for what is read: other layers
/// take no memory. Without such a layer the picture comes without layers.
///
/// # Errors
/// If the bytes are no EXR file, too large, or broken; or if the layers do not all have the same size.
pub fn decode_layers(bytes: &[u8], only: Option<&str>, limits: &DecodeLimits) -> Result<Layers, DecodeError> {
    exr::decode(bytes, only, limits)
}

/// Stores layers as the bytes of an EXR file; of the options the metadata count. The same layers give the same bytes, on
/// every machine.
///
/// # Errors
/// If there are no pixels, or not as many numbers as there are pixels, or two channels of one name.
pub fn encode_layers(picture: Layers, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let Layers { width, height, .. } = picture;
    if width == 0 || height == 0 {
        return Err(EncodeError::NoPixels { width, height });
    }
    let pixels = u64::from(width) * u64::from(height);
    let channels = || picture.layers.iter().flat_map(|layer| &layer.channels);
    if let Some(wrong) = channels().find(|channel| channel.samples.len() as u64 != pixels) {
        return Err(EncodeError::WrongPixelCount { width, height, count: wrong.samples.len() });
    }
    let mut names: Vec<(&str, &str)> = picture.layers.iter().flat_map(Layer::channel_names).collect();
    names.sort_unstable();
    if names.is_empty() || names.windows(2).any(|two| two[0] == two[1]) {
        let detail = "layers need channels, each with a name of its own".to_owned();
        return Err(EncodeError::Failed { format: FileFormat::Exr, detail });
    }
    exr::encode(picture, options)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Alpha;

    #[test]
    fn colors_of_whole_numbers_come_multiplied_by_alpha() {
        let alpha = Some(Alpha::U8(vec![51, 0]));
        let bitmap = Bitmap { width: 2, height: 1, texels: Texels::U8(vec![[255, 0, 255]; 2]), alpha };
        let layers = Layers::of_bitmap(&bitmap, Transfer::Srgb);
        let [r, g, b, a] = layers.get(BEAUTY).and_then(|beauty| beauty.all_of(["R", "G", "B", "A"])).unwrap();
        assert_eq!([r, g, b, a].map(|channel| channel.get(0)), [0.2, 0.0, 0.2, 0.2]);
        assert_eq!([r, g, b, a].map(|channel| channel.get(1)), [0.0; 4]);
        let linear = Bitmap { texels: Texels::F32(vec![[0.2, 0.0, 7.0]; 2]), ..bitmap };
        let layers = Layers::of_bitmap(&linear, Transfer::Srgb);
        assert_eq!(layers.get(BEAUTY).and_then(|beauty| beauty.channel("B")).unwrap().get(0), 7.0);
    }

    #[test]
    fn finite_numbers_stay_finite_in_half_precision() {
        let samples = Samples::of([1e9, -1e9, f32::INFINITY, 1.0 / 3.0].into_iter(), ExrSamples::Half);
        assert_eq!([0, 1, 2].map(|i| samples.get(i)), [65504.0, -65504.0, f32::INFINITY]);
        assert!((samples.get(3) - 1.0 / 3.0).abs() < 2e-4);
    }
}
