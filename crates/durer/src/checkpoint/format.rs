//! The bytes of a checkpoint.

use super::{Checkpoint, CheckpointError, CheckpointOutline, Origin};
use crate::SceneHash;
use durer_math::{DVec2, Rgb};
use durer_render::{BadSample, Calm, Film, FilmOutline, FilmParts, Part, RayCounts, Region, SampleRange, Sums};
use durer_scene::{Integrator, PathSettings};
use twox_hash::XxHash3_128;

/// How files begin. The last three bytes are changed by programs that take the file for a text.
const MAGIC: &[u8; 8] = b"durer\x1a\r\n";

/// Of the format.
pub(super) const VERSION: u32 = 4;

/// The most pixels that a picture has in a row or a column.
const MOST_ACROSS: u32 = 65_535;

/// Bytes of a hash.
const HASH: usize = 16;

const MADE_BY: &str = env!("CARGO_PKG_VERSION");

/// The bytes of a checkpoint. The seconds are those that the film has taken so far; of a finished one they are not kept, since
/// films with the same samples have the same bytes.
pub fn encode_checkpoint(origin: &Origin, scene: &SceneHash, film: &Film, seconds: f64) -> Vec<u8> {
    let mut out = Vec::with_capacity(most_bytes(film));
    out.extend_from_slice(MAGIC);
    out.extend_from_slice(&VERSION.to_le_bytes());
    text(&mut out, MADE_BY);
    text(&mut out, &origin.folder);
    out.extend_from_slice(&(origin.words.len() as u32).to_le_bytes());
    origin.words.iter().for_each(|word| text(&mut out, word));
    out.extend_from_slice(&(scene.parts.len() as u32).to_le_bytes());
    for (name, hash) in &scene.parts {
        text(&mut out, name);
        out.extend_from_slice(&hash.to_le_bytes());
    }
    put_integrator(&mut out, &scene.integrator);
    out.extend_from_slice(&scene.size.0.to_le_bytes());
    out.extend_from_slice(&scene.size.1.to_le_bytes());
    let seconds = if film.is_complete() { 0.0 } else { seconds };
    out.extend_from_slice(&seconds.to_le_bytes());
    put_film(&mut out, film);
    let checksum = XxHash3_128::oneshot(&out);
    out.extend_from_slice(&checksum.to_le_bytes());
    out
}

fn text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(&(text.len() as u32).to_le_bytes());
    out.extend_from_slice(text.as_bytes());
}

/// Its word and its numbers.
fn put_integrator(out: &mut Vec<u8>, integrator: &Integrator) {
    text(out, integrator.word());
    match *integrator {
        Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) => {
            [max_depth, split, reuse].iter().for_each(|number| out.extend_from_slice(&number.to_le_bytes()));
            put_if_any(out, clamp.map(f64::from));
        }
        Integrator::AmbientOcclusion { distance } => put_if_any(out, distance),
        Integrator::Whitted | Integrator::Normals | Integrator::Depth | Integrator::Uv => {}
    }
}

fn put_if_any(out: &mut Vec<u8>, number: Option<f64>) {
    out.push(u8::from(number.is_some()));
    out.extend_from_slice(&number.unwrap_or(0.0).to_le_bytes());
}

/// Of a film, and of all else that is not unusually long.
fn most_bytes(film: &Film) -> usize {
    let pixel = film.sums().map_or(PIXEL, |sums| if sums.direct.is_empty() { SUMS } else { SUMS + DIRECT });
    let cells = film.sums().map_or(0, |sums| sums.calm.len() * CALM);
    pixel * film.pixels().len() + cells + film.finished_tiles().len() + 4096
}

fn put_region(out: &mut Vec<u8>, Region { x, y, width, height }: Region) {
    [x, y, width, height].iter().for_each(|number| out.extend_from_slice(&number.to_le_bytes()));
}

fn put_film(out: &mut Vec<u8>, film: &Film) {
    let RayCounts { eye, reflected, transmitted, shadow, cut_off } = film.rays();
    put_region(out, film.region());
    for number in [eye, reflected, transmitted, shadow, cut_off, film.bad_samples()] {
        out.extend_from_slice(&number.to_le_bytes());
    }
    let first = film.first_bad_sample();
    let at = first.map_or(DVec2::ZERO, |BadSample { at }| at);
    out.push(u8::from(first.is_some()));
    at.to_array().iter().for_each(|number| out.extend_from_slice(&number.to_le_bytes()));
    out.push(u8::from(film.sums().is_some()));
    if let Some(sums) = film.sums() {
        out.push(u8::from(film.is_complete()));
        out.push(u8::from(!sums.direct.is_empty()));
        put_sums(out, sums);
        return;
    }
    out.extend(film.finished_tiles().iter().map(|&finished| u8::from(finished)));
    for component in film.pixels().iter().flat_map(|pixel| pixel.to_array()) {
        out.extend_from_slice(&component.to_le_bytes());
    }
    out.extend_from_slice(film.depths());
}

/// Bytes of a finished pixel.
const PIXEL: usize = 12 + 1;
/// Of the sums of a pixel.
const SUMS: usize = 4 + 2 * 4 + 3 * 16 + 16;
/// Of the sums of its direct light.
const DIRECT: usize = 3 * 16;
/// Of what is known of the noise of a cell.
const CALM: usize = 4 + 1 + 4;

fn put_sums(out: &mut Vec<u8>, sums: &Sums) {
    out.extend_from_slice(&(sums.parts.len() as u32).to_le_bytes());
    for Part { region, samples } in &sums.parts {
        put_region(out, *region);
        out.extend_from_slice(&samples.start.to_le_bytes());
        out.extend_from_slice(&samples.end.to_le_bytes());
    }
    out.extend_from_slice(&(sums.calm.len() as u32).to_le_bytes());
    for Calm { samples, passes, first } in &sums.calm {
        out.extend_from_slice(&samples.to_le_bytes());
        out.push(*passes);
        out.extend_from_slice(&first.to_le_bytes());
    }
    let counts = sums.taken.iter().chain(sums.counts.as_flattened());
    counts.for_each(|count| out.extend_from_slice(&count.to_le_bytes()));
    let amounts = [&sums.colors[..], &sums.direct].into_iter().flatten().flatten().chain(&sums.squares);
    amounts.for_each(|amount| out.extend_from_slice(&amount.to_le_bytes()));
}

impl Checkpoint {
    /// Reads the bytes of a checkpoint, whatever they may be. Takes no more memory than a small multiple of their number.
    ///
    /// # Errors
    ///
    /// They are not those of a checkpoint that was made by this version of durer.
    pub fn decode(bytes: &[u8]) -> Result<Checkpoint, CheckpointError> {
        // Whatever is wrong with the first bytes is told first.
        begin(bytes)?;
        let (content, checksum) = bytes.split_last_chunk::<HASH>().ok_or(CheckpointError::Damaged)?;
        if XxHash3_128::oneshot(content).to_le_bytes() != *checksum {
            return Err(CheckpointError::Damaged);
        }
        let mut input = made_here(content)?;
        let checkpoint = input.checkpoint().ok_or(CheckpointError::Damaged)?;
        if input.0.is_empty() { Ok(checkpoint) } else { Err(CheckpointError::Damaged) }
    }
}

impl CheckpointOutline {
    /// Reads it from the first bytes of a checkpoint, which has `length` of them. Whether the others are right, it does not say;
    /// but no film is larger than its picture, nor than what so many bytes can hold.
    pub(super) fn decode(bytes: &[u8], length: u64) -> Result<CheckpointOutline, CheckpointError> {
        begin(bytes)?;
        let (outline, pixel) = made_here(bytes)?.outline().ok_or(CheckpointError::Damaged)?;
        let (region, (width, height)) = (outline.film.region, outline.scene.size);
        let edges = (region.x.checked_add(region.width), region.y.checked_add(region.height));
        let lies_inside = edges.0.is_some_and(|right| right <= width) && edges.1.is_some_and(|bottom| bottom <= height);
        let is_there = region.pixels().checked_mul(pixel as u64).is_some_and(|bytes| bytes <= length);
        let fits = width.max(height) <= MOST_ACROSS && lies_inside && is_there;
        if fits { Ok(outline) } else { Err(CheckpointError::Damaged) }
    }
}

/// What follows the version of the format.
fn begin(bytes: &[u8]) -> Result<Input<'_>, CheckpointError> {
    let rest = bytes.strip_prefix(MAGIC).ok_or(match MAGIC.starts_with(bytes) {
        true => CheckpointError::Damaged,
        false => CheckpointError::AnotherKind,
    })?;
    let (version, rest) = rest.split_first_chunk().ok_or(CheckpointError::Damaged)?;
    let version = u32::from_le_bytes(*version);
    if version == VERSION { Ok(Input(rest)) } else { Err(CheckpointError::OtherFormat(version)) }
}

/// What follows the version of the program, if it is ours.
fn made_here(bytes: &[u8]) -> Result<Input<'_>, CheckpointError> {
    let mut input = begin(bytes)?;
    let made_by = input.text().ok_or(CheckpointError::Damaged)?;
    if made_by == MADE_BY { Ok(input) } else { Err(CheckpointError::OtherVersion(made_by)) }
}

/// What stands before the film.
struct Head {
    origin: Origin,
    scene: SceneHash,
    seconds: f64,
}

/// What is still to be read. Each method gives `None` if it is not there.
struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        let (first, rest) = self.0.split_at_checked(usize::try_from(length).ok()?)?;
        self.0 = rest;
        Some(first)
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    fn flag(&mut self) -> Option<bool> {
        self.array().and_then(|[byte]| truth(byte))
    }

    fn text(&mut self) -> Option<String> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(length.into())?).ok().map(str::to_owned)
    }

    /// A list that begins with its length. It grows as its elements are found to be there.
    fn list<T>(&mut self, element: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let length = self.u32()?;
        let mut list = Vec::new();
        for _ in 0..length {
            list.push(element(self)?);
        }
        Some(list)
    }

    fn head(&mut self) -> Option<Head> {
        let origin = Origin { folder: self.text()?, words: self.list(Input::text)? };
        let parts = self.list(|input| Some((input.text()?, u128::from_le_bytes(input.array()?))))?;
        let scene = SceneHash { parts, integrator: self.integrator()?, size: (self.u32()?, self.u32()?) };
        let seconds =
            Some(f64::from_le_bytes(self.array()?)).filter(|seconds| seconds.is_finite() && *seconds >= 0.0)?;
        Some(Head { origin, scene, seconds })
    }

    fn integrator(&mut self) -> Option<Integrator> {
        let path = |input: &mut Self| {
            let (max_depth, split, reuse) = (input.u32()?, input.u32()?, input.u32()?);
            let clamp = input.number_if_any()?;
            // Of single precision: a film has one form.
            if clamp.is_some_and(|clamp| f64::from(clamp as f32) != clamp) {
                return None;
            }
            let clamp = clamp.map(|clamp| clamp as f32);
            Some(Integrator::Path(PathSettings { max_depth, clamp, split, reuse }))
        };
        match self.text()?.as_str() {
            "path" => path(self),
            "ambient_occlusion" => Some(Integrator::AmbientOcclusion { distance: self.number_if_any()? }),
            word => [Integrator::Whitted, Integrator::Normals, Integrator::Depth, Integrator::Uv]
                .into_iter()
                .find(|integrator| integrator.word() == word),
        }
    }

    /// What says nothing must be written as nothing.
    fn number_if_any(&mut self) -> Option<Option<f64>> {
        let (is_there, number) = (self.flag()?, f64::from_le_bytes(self.array()?));
        let is_fine = number.is_finite() && (is_there || number.to_bits() == 0);
        is_fine.then_some(is_there.then_some(number))
    }

    fn checkpoint(&mut self) -> Option<Checkpoint> {
        let Head { origin, scene, seconds } = self.head()?;
        let film = self.film()?;
        // A finished film has one form.
        if film.is_complete() && seconds.to_bits() != 0 {
            return None;
        }
        Some(Checkpoint { origin, scene, seconds, film })
    }

    /// With the bytes that each pixel takes.
    fn outline(&mut self) -> Option<(CheckpointOutline, usize)> {
        let Head { origin, scene, .. } = self.head()?;
        let FilmParts { region, .. } = self.account()?;
        let mut film = FilmOutline { region, ..FilmOutline::default() };
        let mut pixel = PIXEL;
        if self.flag()? {
            film.is_complete = self.flag()?;
            film.direct = self.flag()?;
            film.parts = self.parts()?;
            pixel = if film.direct { SUMS + DIRECT } else { SUMS };
        }
        film.is_possible().then_some((CheckpointOutline { origin, scene, film }, pixel))
    }

    /// All of a film but its pixels.
    fn account(&mut self) -> Option<FilmParts> {
        let region = self.region()?;
        let [eye, reflected, transmitted] = [self.u64()?, self.u64()?, self.u64()?];
        let rays = RayCounts { eye, reflected, transmitted, shadow: self.u64()?, cut_off: self.u64()? };
        let bad_samples = self.u64()?;
        let is_there = self.flag()?;
        let at = DVec2::new(f64::from_le_bytes(self.array()?), f64::from_le_bytes(self.array()?));
        // What says nothing must be written as nothing: a film has one form.
        if !is_there && at.to_array().map(f64::to_bits) != [0, 0] {
            return None;
        }
        let first_bad_sample = is_there.then_some(BadSample { at });
        Some(FilmParts { region, rays, bad_samples, first_bad_sample, ..FilmParts::default() })
    }

    fn film(&mut self) -> Option<Film> {
        let parts = self.account()?;
        Film::from_parts(if self.flag()? { self.with_sums(parts)? } else { self.with_pixels(parts)? })
    }

    fn parts(&mut self) -> Option<Vec<Part>> {
        self.list(|input| {
            let region = input.region()?;
            Some(Part { region, samples: SampleRange { start: input.u32()?, end: input.u32()? } })
        })
    }

    fn region(&mut self) -> Option<Region> {
        Some(Region { x: self.u32()?, y: self.u32()?, width: self.u32()?, height: self.u32()? })
    }

    fn with_pixels(&mut self, parts: FilmParts) -> Option<FilmParts> {
        let region = parts.region;
        let finished = self.bytes(region.tile_count())?.iter().map(|&byte| truth(byte)).collect::<Option<_>>()?;
        let colors = self.bytes(region.pixels().checked_mul(12)?)?;
        let pixels = colors.chunks_exact(12).map(color).collect();
        let depths = self.bytes(region.pixels())?.to_vec();
        Some(FilmParts { pixels, depths, finished, ..parts })
    }

    fn with_sums(&mut self, parts: FilmParts) -> Option<FilmParts> {
        let (region, is_finished, has_direct) = (parts.region, self.flag()?, self.flag()?);
        let of = self.parts()?;
        let calm = self.list(|input| {
            let (samples, [passes], first) = (input.u32()?, input.array()?, input.u32()?);
            Some(Calm { samples, passes, first })
        })?;
        let pixels = region.pixels();
        let numbers =
            |bytes: &[u8]| bytes.as_chunks().0.iter().map(|&bytes| u32::from_le_bytes(bytes)).collect::<Vec<_>>();
        let amounts =
            |bytes: &[u8]| bytes.as_chunks().0.iter().map(|&bytes| i128::from_le_bytes(bytes)).collect::<Vec<_>>();
        let sums = Sums {
            parts: of,
            taken: numbers(self.bytes(pixels.checked_mul(4)?)?),
            counts: numbers(self.bytes(pixels.checked_mul(8)?)?).as_chunks().0.to_vec(),
            colors: amounts(self.bytes(pixels.checked_mul(48)?)?).as_chunks().0.to_vec(),
            direct: amounts(self.bytes(if has_direct { pixels.checked_mul(48)? } else { 0 })?).as_chunks().0.to_vec(),
            squares: amounts(self.bytes(pixels.checked_mul(16)?)?),
            calm,
        };
        // All sums of so many pixels are there, so that there are not too many tiles either.
        let finished = vec![is_finished; usize::try_from(region.tile_count()).ok()?];
        Some(FilmParts { finished, sums: Some(sums), ..parts })
    }
}

/// Of a byte that is 0 or 1.
fn truth(byte: u8) -> Option<bool> {
    match byte {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    }
}

/// Of 12 bytes.
fn color(bytes: &[u8]) -> Rgb {
    let component = |at: usize| bytes[at..].first_chunk().map_or(0.0, |bytes| f32::from_le_bytes(*bytes));
    Rgb::new(component(0), component(4), component(8))
}
