//! Portable float maps (Debevec): a text header, then single-precision numbers, bottom row first.

use crate::{Bitmap, DecodeError, DecodeLimits, FileFacts, FileFormat, Image, Texels};

/// The header's lines, and the bytes after them.
struct Header<'a> {
    channels: usize,
    width: u32,
    height: u32,
    /// Its sign is the byte order, negative meaning little-endian; its size multiplies the numbers.
    scale: f32,
    samples: &'a [u8],
}

pub(crate) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let header = parse_header(bytes)?;
    limits.check(header.width, header.height, 12)?;
    let row_bytes = header.width as usize * header.channels * 4;
    if header.samples.len() / row_bytes < header.height as usize {
        return Err(DecodeError::Truncated);
    }
    let rows = header.samples.chunks_exact(row_bytes).take(header.height as usize);
    let texels = rows.rev().flat_map(|row| row.chunks_exact(header.channels * 4)).map(|pixel| header.texel(pixel));
    let texels = Texels::F32(texels.collect());
    Ok(Bitmap { width: header.width, height: header.height, texels, alpha: None })
}

pub(crate) fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    let header = parse_header(bytes)?;
    let samples = if header.channels == 3 { "RGB, 32-bit floating point each" } else { "gray, 32-bit floating point" };
    Ok(FileFacts::plain(FileFormat::Pfm, (header.width, header.height), samples))
}

impl Header<'_> {
    /// The colour of a pixel of one or three numbers.
    fn texel(&self, pixel: &[u8]) -> [f32; 3] {
        [0, 1, 2].map(|channel| self.sample(&pixel[(channel % self.channels) * 4..]))
    }

    fn sample(&self, bytes: &[u8]) -> f32 {
        let bytes = [bytes[0], bytes[1], bytes[2], bytes[3]];
        let number = if self.scale < 0.0 { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) };
        number * self.scale.abs()
    }
}

fn parse_header(bytes: &[u8]) -> Result<Header<'_>, DecodeError> {
    let mut rest = bytes;
    let channels = match next_word(&mut rest)? {
        "PF" => 3,
        "Pf" => 1,
        other => return Err(corrupt(format!("starts with `{other}`"))),
    };
    let width = parse(next_word(&mut rest)?, "width")?;
    let height = parse(next_word(&mut rest)?, "height")?;
    let scale: f32 = parse(next_word(&mut rest)?, "scale")?;
    if !scale.is_finite() || scale == 0.0 {
        return Err(corrupt(format!("`{scale}` is no scale")));
    }
    Ok(Header { channels, width, height, scale, samples: rest })
}

/// Takes a word and the single white space after it off `rest`.
fn next_word<'a>(rest: &mut &'a [u8]) -> Result<&'a str, DecodeError> {
    const LONGEST: usize = 40;
    let start = rest.iter().position(|byte| !byte.is_ascii_whitespace()).ok_or(DecodeError::Truncated)?;
    let from_start = &rest[start..];
    let end = match from_start.iter().take(LONGEST).position(u8::is_ascii_whitespace) {
        Some(end) => end,
        None if from_start.len() < LONGEST => return Err(DecodeError::Truncated),
        None => return Err(corrupt("the header is not readable".into())),
    };
    *rest = &from_start[end + 1..];
    std::str::from_utf8(&from_start[..end]).map_err(|_| corrupt("the header is not readable".into()))
}

fn parse<T: std::str::FromStr>(word: &str, what: &str) -> Result<T, DecodeError> {
    word.parse().map_err(|_| corrupt(format!("`{word}` is no {what}")))
}

fn corrupt(detail: String) -> DecodeError {
    DecodeError::Corrupt { format: FileFormat::Pfm, detail }
}

pub(crate) fn encode(image: &Image) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    bytes.reserve(image.pixels.len() * 12);
    for pixel in image.rows().rev().flatten() {
        for component in pixel.to_array() {
            bytes.extend_from_slice(&component.to_le_bytes());
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> Result<Bitmap, String> {
        decode(bytes, &DecodeLimits::default()).map_err(|error| error.to_string())
    }

    fn file(header: &str, numbers: &[[u8; 4]]) -> Vec<u8> {
        [header.as_bytes(), numbers.as_flattened()].concat()
    }

    #[test]
    fn gray_big_endian_with_a_scale_and_the_bottom_row_first() {
        let bytes = file("Pf\n1 2\n2.0\n", &[1f32.to_be_bytes(), 3f32.to_be_bytes()]);
        let Ok(Bitmap { width: 1, height: 2, texels: Texels::F32(texels), .. }) = decoded(&bytes) else {
            panic!("not read");
        };
        assert_eq!(texels, [[6.0; 3], [2.0; 3]]);
    }

    #[test]
    fn a_sample_that_looks_like_white_space_stays_a_sample() {
        let number = f32::from_le_bytes(*b"\n  ?");
        let bytes = file("Pf 1 1 -1\n", &[number.to_le_bytes()]);
        assert_eq!(decoded(&bytes).map(|b| b.texels), Ok(Texels::F32(vec![[number; 3]])));
    }

    #[test]
    fn bad_headers() {
        let message = |header: &str| decoded(&file(header, &[])).unwrap_err();
        assert_eq!(
            message("PF\n100000 100000\n-1.0\n"),
            "100000 × 100000 pixels are more than the limit of 64 million"
        );
        assert_eq!(message("PF\n3 3\n-1.0\n"), "the file ends too early");
        assert_eq!(message("PF\n3"), "the file ends too early");
        assert_eq!(message("PF\n-3 3\n-1.0\n"), "broken PFM: `-3` is no width");
        assert_eq!(message("PF\n3 99999999999\n-1.0\n"), "broken PFM: `99999999999` is no height");
        assert_eq!(message("PF\n3 3\n0\n"), "broken PFM: `0` is no scale");
        assert_eq!(message("PFX\n3 3\n0\n"), "broken PFM: starts with `PFX`");
        assert_eq!(message(&format!("PF\n{}", "9".repeat(400))), "broken PFM: the header is not readable");
    }
}
