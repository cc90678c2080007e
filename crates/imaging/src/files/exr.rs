//! OpenEXR, by the `exr` crate, on one thread: one layer of R, G and B, or of luminance alone. Files of several layers are in
//! `layers`.

pub(crate) mod layers;

use ::exr::error::Error;
use ::exr::meta::header::Header;
use ::exr::meta::{BlockDescription, MetaData};
use ::exr::prelude::*;
use std::io::Cursor;
use std::result::Result;

use crate::layers::Samples;
use crate::{Alpha, Bitmap, DecodeError, DecodeLimits, EncodeError, EncodeOptions, FileFacts, FileFormat, Texels};

/// Pixels as they come in, in any order.
struct Canvas {
    width: usize,
    texels: Vec<[f32; 3]>,
    /// Empty as long as all pixels are opaque.
    alphas: Vec<f32>,
}

impl Canvas {
    fn new(size: Vec2<usize>) -> Canvas {
        Canvas { width: size.width(), texels: vec![[0.0; 3]; size.area()], alphas: Vec::new() }
    }

    fn set(&mut self, at: Vec2<usize>, texel: [f32; 3], alpha: f32) {
        let index = at.y() * self.width + at.x();
        self.texels[index] = texel;
        if alpha != 1.0 && self.alphas.is_empty() {
            self.alphas = vec![1.0; self.texels.len()];
        }
        if let Some(slot) = self.alphas.get_mut(index) {
            *slot = alpha;
        }
    }
}

/// Reads the first layer that has the channels R, G and B, or else the first with Y, over its data window.
///
/// In builds that check for overflow the crate panics over broken B44 data; that ends here, as an error.
pub(crate) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let read = std::panic::catch_unwind(|| decode_flat(bytes, limits));
    read.unwrap_or_else(|_| Err(corrupt("its compressed data make no sense".into())))
}

fn decode_flat(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let headers = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(decode_error)?.headers;
    headers.iter().try_for_each(|header| check_size(header, limits))?;
    let (canvas, size) = if headers.iter().any(|header| has_channels(header, &["R", "G", "B"])) {
        read_rgb(bytes)?
    } else if headers.iter().any(|header| has_channels(header, &["Y"])) {
        read_luminance(bytes)?
    } else {
        return Err(unsupported("no flat channels R, G and B".into()));
    };
    let (width, height) = (size.width() as u32, size.height() as u32);
    let alpha = (!canvas.alphas.is_empty()).then_some(Alpha::F32(canvas.alphas));
    Ok(Bitmap { width, height, texels: Texels::F32(canvas.texels), alpha })
}

pub(crate) fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    let headers = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(decode_error)?.headers;
    let header = headers.first().ok_or_else(|| corrupt("there is no layer".into()))?;
    let word = |samples: SampleType| match samples {
        SampleType::F16 => "half",
        SampleType::F32 => "float",
        SampleType::U32 => "integer",
    };
    let channels: Vec<String> =
        header.channels.list.iter().map(|c| format!("{} {}", c.name, word(c.sample_type))).collect();
    let size = (header.layer_size.width() as u32, header.layer_size.height() as u32);
    let metadata = header.own_attributes.comments.as_ref().map(pairs).unwrap_or_default();
    Ok(FileFacts { metadata, ..FileFacts::plain(FileFormat::Exr, size, &channels.join(", ")) })
}

/// The lines of the attribute [`comments`] writes; a line of another kind has that attribute's name for a keyword.
fn pairs(comments: &Text) -> Vec<(String, String)> {
    // A character of the crate's is a byte of UTF-8.
    let bytes: Vec<u8> = comments.bytes().to_vec();
    let pair = |line: &str| {
        let (keyword, text) = line.split_once(": ").unwrap_or(("comments", line));
        (keyword.to_owned(), text.to_owned())
    };
    String::from_utf8_lossy(&bytes).lines().map(pair).collect()
}

/// Refuses a layer that is too large, has no pixels, or is cut into blocks too large to hold in memory.
fn check_size(header: &Header, limits: &DecodeLimits) -> Result<(), DecodeError> {
    let side = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
    let (width, height) = (side(header.layer_size.width()), side(header.layer_size.height()));
    limits.check(width, height, if has_channels(header, &["A"]) { 16 } else { 12 })?;
    let block = match header.blocks {
        BlockDescription::ScanLines => Vec2(header.layer_size.width(), header.compression.scan_lines_per_block()),
        BlockDescription::Tiles(tiles) => tiles.tile_size,
    };
    let block_pixels = (block.width() as u64).saturating_mul(block.height() as u64);
    if block_pixels.saturating_mul(header.channels.bytes_per_pixel as u64) > limits.max_bytes {
        return Err(corrupt("its blocks are too large".into()));
    }
    Ok(())
}

/// True if the layer is flat (one color a pixel, not a stack of samples) and has these channels.
fn has_channels(header: &Header, names: &[&str]) -> bool {
    let has = |name: &&str| header.channels.list.iter().any(|channel| channel.name == **name);
    !header.deep && names.iter().all(has)
}

fn read_rgb(bytes: &[u8]) -> Result<(Canvas, Vec2<usize>), DecodeError> {
    let layers = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| Canvas::new(size),
            |canvas: &mut Canvas, at, (r, g, b, alpha): (f32, f32, f32, f32)| canvas.set(at, [r, g, b], alpha),
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel();
    let layer = layers.from_buffered(Cursor::new(bytes)).map_err(decode_error)?.layer_data;
    Ok((layer.channel_data.pixels, layer.size))
}

fn read_luminance(bytes: &[u8]) -> Result<(Canvas, Vec2<usize>), DecodeError> {
    let layers = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("Y")
        .optional("A", 1.0)
        .collect_pixels(
            |size, _| Canvas::new(size),
            |canvas: &mut Canvas, at, (y, alpha): (f32, f32)| canvas.set(at, [y; 3], alpha),
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel();
    let layer = layers.from_buffered(Cursor::new(bytes)).map_err(decode_error)?.layer_data;
    Ok((layer.channel_data.pixels, layer.size))
}

fn corrupt(detail: String) -> DecodeError {
    DecodeError::Corrupt { format: FileFormat::Exr, detail }
}

fn unsupported(detail: String) -> DecodeError {
    DecodeError::Unsupported { format: FileFormat::Exr, detail }
}

fn decode_error(error: Error) -> DecodeError {
    match error {
        // What the crate makes of an unexpected end of the file.
        Error::Invalid(detail) if detail == "reference to missing bytes" => DecodeError::Truncated,
        Error::Invalid(detail) => corrupt(detail.into_owned()),
        Error::NotSupported(detail) => unsupported(detail.into_owned()),
        Error::Io(error) => corrupt(error.to_string()),
        Error::Aborted => corrupt("reading stopped".into()),
    }
}

fn flat(samples: Samples) -> FlatSamples {
    match samples {
        Samples::Half(numbers) => FlatSamples::F16(numbers),
        Samples::Float(numbers) => FlatSamples::F32(numbers),
        Samples::Whole(numbers) => FlatSamples::U32(numbers),
    }
}

/// R, G and B, and A if there is one.
pub(crate) fn encode(
    image: &crate::Image,
    alpha: Option<&[f32]>,
    options: &EncodeOptions,
) -> Result<Vec<u8>, EncodeError> {
    let samples = |numbers: &mut dyn Iterator<Item = f32>| flat(Samples::of(numbers, options.exr_samples));
    let color = |name: &str, component: usize| {
        AnyChannel::new(name, samples(&mut image.pixels.iter().map(|pixel| pixel.to_array()[component])))
    };
    let alpha = alpha.map(|alpha| AnyChannel::new("A", samples(&mut alpha.iter().copied())));
    let channels = [color("R", 0), color("G", 1), color("B", 2)].into_iter().chain(alpha);
    write((image.width, image.height), channels.collect(), options)
}

/// Scan lines from the top, in ZIP blocks of 16.
fn write(
    (width, height): (u32, u32),
    channels: SmallVec<[AnyChannel<FlatSamples>; 4]>,
    options: &EncodeOptions,
) -> Result<Vec<u8>, EncodeError> {
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let attributes = LayerAttributes { comments: comments(options), ..LayerAttributes::default() };
    let size = (width as usize, height as usize);
    let layer = Layer::new(size, attributes, encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| EncodeError::Failed { format: FileFormat::Exr, detail: error.to_string() })?;
    Ok(bytes.into_inner())
}

/// The metadata in one attribute, a line each, in UTF-8: the crate keeps attributes of other names in a hash map, whose
/// order would make the bytes of the file change from run to run.
fn comments(options: &EncodeOptions) -> Option<Text> {
    if options.metadata.is_empty() {
        return None;
    }
    let lines: String = options.metadata.iter().map(|(keyword, text)| format!("{keyword}: {text}\n")).collect();
    // The crate stores a character of Latin-1 as one byte, so the bytes of UTF-8 go in as such characters.
    Text::new_or_none(lines.bytes().map(char::from).collect::<String>())
}
