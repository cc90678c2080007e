//! Files of several layers: one part, whose channels have the layer before their name, `normal.X`, as Blender and Nuke read
//! them; the beauty's have none. Read are those of other programs as well, which may have a part for each layer.

use super::{check_size, corrupt, decode_error, flat, unsupported, write};
use crate::layers::{BEAUTY, Channel, Layer, Layers, Samples};
use crate::{DecodeError, DecodeLimits, EncodeError, EncodeOptions, LayerFacts};
use ::exr::block::lines::LineRef;
use ::exr::block::reader::ChunksReader;
use ::exr::meta::attribute::{ChannelDescription, SampleType};
use ::exr::meta::header::Header;
use ::exr::prelude::{AnyChannel, Text, Vec2, f16};
use std::io::Cursor;

/// Where a channel of a file belongs: part, number in the part, and the index of its layer and in that.
struct Wanted {
    part: usize,
    number: usize,
    layer: usize,
    channel: usize,
}

/// The layers in the order in which the file names their channels, beauty first.
pub(crate) fn about(bytes: &[u8]) -> Result<Vec<LayerFacts>, DecodeError> {
    let headers = headers(bytes)?;
    let mut layers: Vec<LayerFacts> = Vec::new();
    for header in headers.iter().filter(|header| !header.deep) {
        for described in &header.channels.list {
            let (layer, channel) = names(&headers, header, described);
            let entry = (channel, precision(described.sample_type));
            match layers.iter_mut().find(|known| known.name == layer) {
                Some(known) => known.channels.push(entry),
                None => {
                    let (width, height) = size(header);
                    layers.push(LayerFacts { name: layer, width, height, channels: vec![entry] });
                }
            }
        }
    }
    layers.sort_by_key(|layer| layer.name != BEAUTY);
    layers.iter_mut().for_each(|layer| layer.channels.sort_by_key(|(name, _)| in_usual_order(name)));
    Ok(layers)
}

/// Reads the layer of this name only, or all.
///
/// As in [`super::decode`], panics of the crate over broken data end here.
pub(crate) fn decode(bytes: &[u8], only: Option<&str>, limits: &DecodeLimits) -> Result<Layers, DecodeError> {
    let read = std::panic::catch_unwind(|| decode_wanted(bytes, only, limits));
    read.unwrap_or_else(|_| Err(corrupt("its compressed data make no sense".into())))
}

fn decode_wanted(bytes: &[u8], only: Option<&str>, limits: &DecodeLimits) -> Result<Layers, DecodeError> {
    let headers = headers(bytes)?;
    headers.iter().try_for_each(|header| check_size(header, limits))?;
    let (mut picture, wanted) = plan(&headers, only, limits)?;
    let file = ::exr::block::read(Cursor::new(bytes), false).map_err(decode_error)?;
    let chunks = file.filter_chunks(false, |_, tile, block| {
        tile.level_index == Vec2(0, 0) && wanted.iter().any(|wanted| wanted.part == block.layer)
    });
    let mut blocks = chunks.map_err(decode_error)?.sequential_decompressor(false);
    while let Some(block) = blocks.decompress_next_block() {
        let block = block.map_err(decode_error)?;
        let Some(header) = headers.get(block.index.layer) else { continue };
        for line in block.lines(&header.channels) {
            let part = block.index.layer;
            let place = wanted.iter().find(|wanted| wanted.part == part && wanted.number == line.location.channel);
            if let Some(Wanted { layer, channel, .. }) = place {
                let samples = &mut picture.layers[*layer].channels[*channel].samples;
                put(line, samples, picture.width as usize)?;
            }
        }
    }
    Ok(picture)
}

fn headers(bytes: &[u8]) -> Result<Vec<Header>, DecodeError> {
    let meta = ::exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(decode_error)?;
    Ok(meta.headers.to_vec())
}

/// Room for what is wanted, and where it goes.
fn plan(headers: &[Header], only: Option<&str>, limits: &DecodeLimits) -> Result<(Layers, Vec<Wanted>), DecodeError> {
    let mut found: Vec<(String, String, usize, usize)> = Vec::new();
    for (part, header) in headers.iter().enumerate().filter(|(_, header)| !header.deep) {
        for (number, described) in header.channels.list.iter().enumerate() {
            let (layer, channel) = names(headers, header, described);
            let is_new = !found.iter().any(|(l, c, ..)| *l == layer && *c == channel);
            if is_new && only.is_none_or(|only| only == layer) {
                if described.sampling != Vec2(1, 1) {
                    return Err(unsupported(format!("fewer samples than pixels in channel {}", described.name)));
                }
                found.push((layer, channel, part, number));
            }
        }
    }
    let described = |part: usize, number: usize| &headers[part].channels.list[number];
    let (width, height) = found.first().map_or((0, 0), |(_, _, part, _)| size(&headers[*part]));
    if found.iter().any(|(_, _, part, _)| size(&headers[*part]) != (width, height)) {
        return Err(unsupported("layers of different sizes".into()));
    }
    let bytes_of = |(_, _, part, number): &(String, String, usize, usize)| {
        described(*part, *number).sample_type.bytes_per_sample() as u64
    };
    let pixels = match found.is_empty() {
        true => 0,
        false => limits.check(width, height, found.iter().map(bytes_of).sum())?,
    };
    found.sort_by_key(|(layer, channel, ..)| (layer != BEAUTY, layer.clone(), in_usual_order(channel)));
    let mut picture = Layers { width, height, layers: Vec::new() };
    let mut wanted = Vec::new();
    for (layer, channel, part, number) in found {
        if picture.layers.last().is_none_or(|last| last.name != layer) {
            picture.layers.push(Layer { name: layer, channels: Vec::new() });
        }
        let index = picture.layers.len() - 1;
        let channels = &mut picture.layers[index].channels;
        wanted.push(Wanted { part, number, layer: index, channel: channels.len() });
        channels.push(Channel { name: channel, samples: zeros(described(part, number).sample_type, pixels) });
    }
    Ok((picture, wanted))
}

/// What comes first is said first: R before G, X before Y, and A at the end.
fn in_usual_order(channel: &str) -> (usize, String) {
    const ORDER: [&str; 9] = ["R", "G", "B", "X", "Y", "Z", "U", "V", "A"];
    (ORDER.iter().position(|known| *known == channel).unwrap_or(ORDER.len()), channel.to_owned())
}

fn zeros(kind: SampleType, pixels: usize) -> Samples {
    match kind {
        SampleType::F16 => Samples::Half(vec![f16::ZERO; pixels]),
        SampleType::F32 => Samples::Float(vec![0.0; pixels]),
        SampleType::U32 => Samples::Whole(vec![0; pixels]),
    }
}

fn precision(kind: SampleType) -> &'static str {
    match kind {
        SampleType::F16 => "half",
        SampleType::F32 => "float",
        SampleType::U32 => "integer",
    }
}

/// Puts a part of a row where it belongs.
fn put(line: LineRef<'_>, samples: &mut Samples, width: usize) -> Result<(), DecodeError> {
    let Vec2(x, y) = line.location.position;
    let range = y * width + x..y * width + x + line.location.sample_count;
    let outside = || corrupt("pixels lie outside of the picture".into());
    match samples {
        Samples::Half(numbers) => line.read_samples_into_slice(numbers.get_mut(range).ok_or_else(outside)?),
        Samples::Float(numbers) => line.read_samples_into_slice(numbers.get_mut(range).ok_or_else(outside)?),
        Samples::Whole(numbers) => line.read_samples_into_slice(numbers.get_mut(range).ok_or_else(outside)?),
    }
    .map_err(decode_error)
}

fn size(header: &Header) -> (u32, u32) {
    let side = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
    (side(header.layer_size.width()), side(header.layer_size.height()))
}

/// The names of a channel's layer and, there, of itself: what stands before and after the last dot. Where nothing stands
/// before it, the name of the part counts, if there are several.
fn names(headers: &[Header], header: &Header, channel: &ChannelDescription) -> (String, String) {
    let text = |text: &Text| String::from_utf8_lossy(text.bytes()).into_owned();
    let name = channel.name.to_string();
    match (name.rsplit_once('.'), &header.own_attributes.layer_name) {
        (Some((layer, channel)), _) => (layer.to_owned(), channel.to_owned()),
        (None, Some(part)) if headers.len() > 1 => (text(part), name),
        (None, _) => (BEAUTY.to_owned(), name),
    }
}

/// One part with all layers.
pub(crate) fn encode(picture: Layers, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let Layers { width, height, layers } = picture;
    let channels = layers.into_iter().flat_map(|Layer { name: layer, channels }| {
        channels.into_iter().map(move |Channel { name, samples }| {
            let name = if layer == BEAUTY { name } else { format!("{layer}.{name}") };
            AnyChannel::new(name.as_str(), flat(samples))
        })
    });
    write((width, height), channels.collect(), options)
}
