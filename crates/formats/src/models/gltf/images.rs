//! Images and textures: pictures in buffers or files, and how they lie on surfaces.

use super::super::ModelError;
use super::source::Source;
use super::value::{Place, Value};
use crate::limits::textures;
use crate::{Exceeded, Limit};
use durer_imaging::{Alpha, Bitmap, Texels, decode};
use durer_math::functions::{atan2, cos, sin};
use durer_math::{DAffine3, DMat3, DVec3, Rgb};
use durer_scene::{
    Channels, Encoding, Filter, ImageAsset, ImageId, ImageTexture, Mapping, Paint, Pattern, Texture, TextureId,
    Transform, TransformStep, Wrap,
};
use std::borrow::Cow;
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The pictures that are used, and the textures that show them.
#[derive(Default)]
pub(super) struct Images {
    pub(super) images: Vec<ImageAsset>,
    pub(super) textures: Vec<Texture>,
    /// The id of each picture, by what it is made from.
    ids: HashMap<Key, ImageId>,
    /// Pixels of all pictures that are kept.
    bytes: u64,
}

/// What a picture is made from: an image, and what is made of it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    image: usize,
    made: Made,
}

/// What is made of an image. Numbers are there by their bits.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Made {
    /// Itself.
    Whole,
    /// The least alpha that counts as there.
    Mask(u32),
    /// How directions in it are turned, to so many turns more.
    Turns(u64),
}

/// What a material says of one of its textures.
pub(super) struct TextureUse {
    image: usize,
    place: Place,
    /// Which texture coordinates it uses.
    pub(super) uv_set: usize,
    transform: Transform,
    wrap: Wrap,
    filter: Filter,
}

/// What the numbers of an image mean.
#[derive(Clone, Copy)]
pub(super) enum Meaning {
    /// Colors for screens.
    Color,
    /// The numbers in these channels, as they are.
    Numbers(Channels),
}

/// The `magFilter` without blending.
const NEAREST: usize = 9728;
/// The least and the largest scale of texture coordinates, since transforms must be reversible; and the farthest that
/// they can be moved.
const SCALES: (f64, f64) = (1e-6, 1e6);

impl TextureUse {
    /// The texture that a field refers to, if it has a picture.
    pub(super) fn of<'a>(
        source: &Source<'a>,
        material: &Value<'a>,
        field: &'static str,
    ) -> Result<Option<TextureUse>, ModelError> {
        let Some(reference) = material.object(field)? else { return Ok(None) };
        let Some((_, texture)) = source.referred(&reference, "index", "textures")? else {
            return Err(reference.fault("`index` is missing"));
        };
        let Some((image, value)) = source.referred(&texture, "source", "images")? else {
            source.notes.add("textures are left out that have no PNG or JPEG image", texture.place);
            return Ok(None);
        };
        let mut uv_set = reference.whole("texCoord")?.unwrap_or(0);
        let mut transform = Transform::default();
        if let Some(placing) = reference.extension("KHR_texture_transform")? {
            uv_set = placing.whole("texCoord")?.unwrap_or(uv_set);
            transform = texture_transform(&placing)?;
        }
        let (wrap, filter) = match source.referred(&texture, "sampler", "samplers")? {
            Some((_, sampler)) => sampling(source, &sampler)?,
            None => (Wrap::Repeat, Filter::Bilinear),
        };
        Ok(Some(TextureUse { image, place: value.place, uv_set, transform, wrap, filter }))
    }
}

fn sampling(source: &Source<'_>, sampler: &Value<'_>) -> Result<(Wrap, Filter), ModelError> {
    let wrap = |field| -> Result<Wrap, ModelError> {
        Ok(match sampler.whole(field)? {
            None | Some(10497) => Wrap::Repeat,
            Some(33071) => Wrap::Clamp,
            Some(33648) => Wrap::Mirror,
            Some(other) => return Err(sampler.fault(format!("there is no {field} {other}"))),
        })
    };
    let (across, down) = (wrap("wrapS")?, wrap("wrapT")?);
    if across != down {
        source.notes.add("textures go on upwards as they do sideways, though the file says otherwise", sampler.place);
    }
    let filter = if sampler.whole("magFilter")? == Some(NEAREST) { Filter::Nearest } else { Filter::Bilinear };
    Ok((across, filter))
}

/// The map from the image to texture coordinates, v upwards, by KHR_texture_transform: the inverse of what it says, which
/// is with v downwards, to scale, turn and move the coordinates.
fn texture_transform(placing: &Value<'_>) -> Result<Transform, ModelError> {
    let [x, y] = placing.numbers("offset")?.unwrap_or([0.0; 2]).map(|offset: f64| offset.clamp(-SCALES.1, SCALES.1));
    let [a, b] = placing.numbers("scale")?.unwrap_or([1.0; 2]);
    let angle = placing.number("rotation")?.unwrap_or(0.0);
    let [a, b] = [a, b].map(|scale: f64| scale.abs().clamp(SCALES.0, SCALES.1).copysign(scale));
    // The direction is that of the example in the extension's text, and of other programs.
    let (s, c) = (sin(angle), cos(angle));
    let flip = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)), translation: DVec3::Y };
    let image_from_uv = DAffine3 {
        matrix3: DMat3::from_cols(DVec3::new(c * a, -s * a, 0.0), DVec3::new(s * b, c * b, 0.0), DVec3::Z),
        translation: DVec3::new(x, y, 0.0),
    };
    let uv_from_image = flip * image_from_uv.inverse() * flip;
    if uv_from_image.abs_diff_eq(DAffine3::IDENTITY, 0.0) {
        return Ok(Transform::default());
    }
    Ok(Transform { steps: vec![matrix_step(&uv_from_image)] })
}

/// A map as a step of a transform.
pub(super) fn matrix_step(map: &DAffine3) -> TransformStep {
    let (m, t) = (map.matrix3, map.translation);
    TransformStep::Matrix([0, 1, 2].map(|row| [m.x_axis[row], m.y_axis[row], m.z_axis[row], t[row]]))
}

impl Images {
    /// A texture of the image, times a color.
    pub(super) fn show(
        &mut self,
        source: &Source<'_>,
        used: &TextureUse,
        meaning: Meaning,
        tint: Rgb,
    ) -> Result<Paint, ModelError> {
        let image = self.image(source, used, Made::Whole)?;
        Ok(self.paint(used, image, meaning, tint))
    }

    /// A texture of the turns, counterclockwise from u to v, of the directions in red and green, and so many more. Not blended:
    /// between almost one turn and none lies no half turn.
    pub(super) fn turns(&mut self, source: &Source<'_>, used: &TextureUse, more: f64) -> Result<Paint, ModelError> {
        let image = self.image(source, used, Made::Turns(more.to_bits()))?;
        let used = TextureUse { transform: used.transform.clone(), filter: Filter::Nearest, ..*used };
        Ok(self.paint(&used, image, Meaning::Numbers(Channels::Red), Rgb::WHITE))
    }

    /// A texture of the image's alpha; `None` if it has none.
    pub(super) fn alpha(
        &mut self,
        source: &Source<'_>,
        used: &TextureUse,
        factor: f32,
    ) -> Result<Option<Paint>, ModelError> {
        let image = self.image(source, used, Made::Whole)?;
        let has_alpha = self.images[image.0 as usize].bitmap.alpha.is_some();
        Ok(has_alpha.then(|| self.paint(used, image, Meaning::Numbers(Channels::Alpha), Rgb::gray(factor))))
    }

    /// A texture that is white where the image's alpha is at least `cutoff`, black elsewhere; `None` if it has no alpha.
    pub(super) fn mask(
        &mut self,
        source: &Source<'_>,
        used: &TextureUse,
        cutoff: f32,
    ) -> Result<Option<Paint>, ModelError> {
        let image = self.image(source, used, Made::Whole)?;
        if self.images[image.0 as usize].bitmap.alpha.is_none() {
            return Ok(None);
        }
        let image = self.image(source, used, Made::Mask(cutoff.to_bits()))?;
        Ok(Some(self.paint(used, image, Meaning::Numbers(Channels::Alpha), Rgb::WHITE)))
    }

    fn paint(&mut self, used: &TextureUse, image: ImageId, meaning: Meaning, tint: Rgb) -> Paint {
        let (channels, encoding) = match meaning {
            Meaning::Color => (Channels::Color, Encoding::Srgb),
            Meaning::Numbers(channels) => (channels, Encoding::Linear),
        };
        let (wrap, filter) = (used.wrap, used.filter);
        let image = ImageTexture { image, mapping: Mapping::Uv, wrap, filter, encoding, channels, tint };
        self.textures.push(Texture { name: None, transform: used.transform.clone(), pattern: Pattern::Image(image) });
        Paint::Texture(TextureId(self.textures.len() as u32 - 1))
    }

    fn image(&mut self, source: &Source<'_>, used: &TextureUse, made: Made) -> Result<ImageId, ModelError> {
        let key = Key { image: used.image, made };
        if let Some(id) = self.ids.get(&key) {
            return Ok(*id);
        }
        let (bitmap, suffix) = match made {
            Made::Whole => (read(source, used, &mut self.bytes)?, String::new()),
            Made::Mask(cutoff) => {
                let cutoff = f32::from_bits(cutoff);
                let bitmap = self.whole_for(source, used, 4)?;
                (masked(&bitmap, cutoff), format!(" where alpha is at least {cutoff}"))
            }
            Made::Turns(more) => {
                let more = f64::from_bits(more);
                let bitmap = self.whole_for(source, used, 6)?;
                (turned(&bitmap, more), format!(" as turns, and {more} more"))
            }
        };
        let file = source.image_name(used.image)? + &suffix;
        source.budget.spend(1, file.len(), used.place)?;
        let id = ImageId(self.images.len() as u32);
        self.images.push(ImageAsset { file, bitmap: Arc::new(bitmap) });
        self.ids.insert(key, id);
        Ok(id)
    }
}

impl Images {
    /// The image itself, of which something is to be made that takes so many bytes for each pixel; counts them before.
    fn whole_for(&mut self, source: &Source<'_>, used: &TextureUse, each: u64) -> Result<Arc<Bitmap>, ModelError> {
        let whole = self.image(source, used, Made::Whole)?;
        let bitmap = Arc::clone(&self.images[whole.0 as usize].bitmap);
        let bytes = each * u64::from(bitmap.width) * u64::from(bitmap.height);
        take(source, bytes, &mut self.bytes, used.place)?;
        Ok(bitmap)
    }
}

/// Reads a picture and counts its pixels.
fn read(source: &Source<'_>, used: &TextureUse, taken: &mut u64) -> Result<Bitmap, ModelError> {
    let bytes = source.image_bytes(used.image)?;
    // Pictures may share their bytes; the time that they take is to be paid for each.
    source.budget.spend(bytes.len(), 1, used.place)?;
    let bitmap = decode(&bytes, &textures::left(source.limits, *taken)).map_err(|error| {
        let help = textures::help(&error);
        ModelError { help, ..used.place.fault(error) }
    })?;
    *taken += bitmap.memory();
    Ok(bitmap)
}

/// Counts the bytes of a picture before it is made.
fn take(source: &Source<'_>, bytes: u64, taken: &mut u64, place: Place) -> Result<(), ModelError> {
    let allowed = source.limits.max_texture_bytes;
    *taken = taken.saturating_add(bytes);
    if *taken <= allowed {
        return Ok(());
    }
    let exceeded = Exceeded { limit: Limit::Textures, asked: Some(*taken), allowed };
    Err(place.fault(format!("with this, the images are too large: {exceeded}")).help(exceeded.help()))
}

/// Nothing but an alpha channel: all where that of `bitmap` is at least `cutoff`, nothing elsewhere.
fn masked(bitmap: &Bitmap, cutoff: f32) -> Bitmap {
    let pixels = bitmap.width as usize * bitmap.height as usize;
    let is_there = |at| bitmap.alpha.as_ref().is_none_or(|alpha| alpha.get(at) >= cutoff);
    let alpha = (0..pixels).map(|at| if is_there(at) { 255 } else { 0 }).collect();
    let texels = Texels::U8(vec![[0; 3]; pixels]);
    Bitmap { width: bitmap.width, height: bitmap.height, texels, alpha: Some(Alpha::U8(alpha)) }
}

/// How far directions are turned, counterclockwise from x, in turns from 0 to 1, and so many more. Their x and y from -1 to 1 are
/// stored as red and green from 0 to 1.
fn turned(bitmap: &Bitmap, more: f64) -> Bitmap {
    let turns = |x: f64, y: f64| {
        let turns = atan2(2.0 * y - 1.0, 2.0 * x - 1.0) / TAU + more;
        // One turn is none.
        [((turns - turns.floor()) * f64::from(u16::MAX)).round() as u16; 3]
    };
    let of = |[x, y, _]: [f64; 3]| turns(x, y);
    let texels = match &bitmap.texels {
        Texels::U8(texels) => texels.iter().map(|texel| of(texel.map(|x| f64::from(x) / 255.0))).collect(),
        Texels::U16(texels) => texels.iter().map(|texel| of(texel.map(|x| f64::from(x) / 65_535.0))).collect(),
        Texels::F32(texels) => texels.iter().map(|texel| of(texel.map(f64::from))).collect(),
    };
    Bitmap { width: bitmap.width, height: bitmap.height, texels: Texels::U16(texels), alpha: None }
}

impl<'a> Source<'a> {
    /// What messages call an image.
    fn image_name(&self, index: usize) -> Result<String, ModelError> {
        let image = self.item("images", index, Place::default())?;
        match image.text("uri")? {
            Some(uri) if !uri.starts_with("data:") => self.files.path(uri, image.place),
            _ => Ok(format!("{}#images[{index}]", self.file)),
        }
    }

    /// The bytes of an image file.
    fn image_bytes(&self, index: usize) -> Result<Cow<'_, [u8]>, ModelError> {
        let image = self.item("images", index, Place::default())?;
        if let Some(uri) = image.text("uri")? {
            return Ok(Cow::Owned(self.files.read(uri, self.limits.max_file_bytes, image.place)?));
        }
        match self.view(&image)? {
            Some(view) => Ok(Cow::Borrowed(view.bytes)),
            None => Err(image.fault("this image has neither `uri` nor `bufferView`")),
        }
    }
}
