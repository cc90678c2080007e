//! Radiance HDR (Ward, "Real Pixels", Graphics Gems II): three mantissas of 8 bits that share an exponent.
//!
//! Read and written by our own code: the `image` crate writes through the platform's `log2`, and its reader trips over
//! a long row of old-style run lengths. Mantissas are rounded, not cut, which is best for the many readers that, like
//! this one, add no half to them. The note EXPOSURE is not applied, as in other renderers.

use crate::{Bitmap, DecodeError, DecodeLimits, FileFacts, FileFormat, Image, Texels};
use durer_math::Rgb;

/// Rows of other widths are never run-length encoded in the new style.
const RLE_WIDTHS: std::ops::RangeInclusive<usize> = 8..=32767;

/// A pixel as stored: mantissas of red, green and blue, and the exponent.
type Rgbe = [u8; 4];

pub(crate) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Bitmap, DecodeError> {
    let mut rest = bytes;
    let (width, height) = read_header(&mut rest)?;
    limits.check(width, height, 12)?;
    // The rows grow as they come, so that a short file with a large header costs little.
    let mut texels = Vec::new();
    let mut row = vec![[0; 4]; width as usize];
    for _ in 0..height {
        read_row(&mut rest, &mut row)?;
        texels.extend(row.iter().map(|&pixel| light(pixel)));
    }
    Ok(Bitmap { width, height, texels: Texels::F32(texels), alpha: None })
}

pub(crate) fn about(bytes: &[u8]) -> Result<FileFacts, DecodeError> {
    let size = read_header(&mut &bytes[..])?;
    Ok(FileFacts::plain(FileFormat::Hdr, size, "RGB, 8 bits each with one exponent"))
}

/// Reads the lines up to the empty one, and the one with the size after it.
fn read_header(rest: &mut &[u8]) -> Result<(u32, u32), DecodeError> {
    loop {
        let line = next_line(rest)?;
        if line.is_empty() {
            break;
        }
        if let Some(format) = line.strip_prefix(b"FORMAT=".as_slice())
            && format.trim_ascii() != b"32-bit_rle_rgbe"
        {
            return Err(unsupported(format!("colors of kind `{}`", String::from_utf8_lossy(format.trim_ascii()))));
        }
    }
    let line = String::from_utf8_lossy(next_line(rest)?);
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    match words[..] {
        ["-Y", height, "+X", width] => match (width.parse(), height.parse()) {
            (Ok(width), Ok(height)) => Ok((width, height)),
            _ => Err(corrupt(&format!("`{line}` is no size"))),
        },
        ["-Y" | "+Y", _, "-X" | "+X", _] | ["-X" | "+X", _, "-Y" | "+Y", _] => {
            Err(unsupported(format!("pixels in the order `{line}`")))
        }
        _ => Err(corrupt("there is no size")),
    }
}

/// Takes a line and its end off `rest`.
fn next_line<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8], DecodeError> {
    const LONGEST: usize = 4096;
    match rest.iter().take(LONGEST).position(|&byte| byte == b'\n') {
        Some(end) => {
            let line = &rest[..end];
            *rest = &rest[end + 1..];
            Ok(line.strip_suffix(b"\r").unwrap_or(line))
        }
        None if rest.len() < LONGEST => Err(DecodeError::Truncated),
        None => Err(corrupt("the header is not readable")),
    }
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> Result<&'a [u8], DecodeError> {
    let (taken, after) = rest.split_at_checked(count).ok_or(DecodeError::Truncated)?;
    *rest = after;
    Ok(taken)
}

fn take_byte(rest: &mut &[u8]) -> Result<u8, DecodeError> {
    let (&byte, after) = rest.split_first().ok_or(DecodeError::Truncated)?;
    *rest = after;
    Ok(byte)
}

fn take_pixel(rest: &mut &[u8]) -> Result<Rgbe, DecodeError> {
    let (&pixel, after) = rest.split_first_chunk().ok_or(DecodeError::Truncated)?;
    *rest = after;
    Ok(pixel)
}

/// Reads one row in whichever of the three ways it is stored: new runs, old runs, or flat.
fn read_row(rest: &mut &[u8], row: &mut [Rgbe]) -> Result<(), DecodeError> {
    let marker = rest.first_chunk::<4>().ok_or(DecodeError::Truncated)?;
    let marked_width = usize::from(marker[2]) << 8 | usize::from(marker[3]);
    if marker[..2] != [2, 2] || marker[2] >= 128 || !RLE_WIDTHS.contains(&row.len()) {
        return read_old_row(rest, row);
    }
    if marked_width != row.len() {
        return Err(corrupt("a row has the wrong length"));
    }
    *rest = &rest[4..];
    (0..4).try_for_each(|component| read_component(rest, row, component))
}

/// Reads one component of a row: runs of one byte (codes above 128) and stretches of different ones.
fn read_component(rest: &mut &[u8], row: &mut [Rgbe], component: usize) -> Result<(), DecodeError> {
    let mut x = 0;
    while x < row.len() {
        let code = usize::from(take_byte(rest)?);
        let length = if code > 128 { code - 128 } else { code };
        if length == 0 || length > row.len() - x {
            return Err(corrupt("a run does not fit into its row"));
        }
        let stretch = &mut row[x..x + length];
        if code > 128 {
            let value = take_byte(rest)?;
            stretch.iter_mut().for_each(|pixel| pixel[component] = value);
        } else {
            let values = take(rest, length)?;
            stretch.iter_mut().zip(values).for_each(|(pixel, &value)| pixel[component] = value);
        }
        x += length;
    }
    Ok(())
}

/// Reads a row of whole pixels, where (1, 1, 1, n) repeats the pixel before n times, and marks that follow each other
/// are the digits of n, the lowest first.
fn read_old_row(rest: &mut &[u8], row: &mut [Rgbe]) -> Result<(), DecodeError> {
    let (mut x, mut shift) = (0, 0);
    while x < row.len() {
        let pixel = take_pixel(rest)?;
        if pixel[..3] != [1, 1, 1] {
            (row[x], shift) = (pixel, 0);
            x += 1;
            continue;
        }
        let length = usize::from(pixel[3]) << shift;
        if x == 0 || shift > 16 || length > row.len() - x {
            return Err(corrupt("a run does not fit into its row"));
        }
        let repeated = row[x - 1];
        row[x..x + length].fill(repeated);
        (x, shift) = (x + length, shift + 8);
    }
    Ok(())
}

/// Linear light of a stored pixel: mantissa × 2^(exponent - 136).
fn light([r, g, b, exponent]: Rgbe) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = power_of_two(i32::from(exponent) - 136);
    [r, g, b].map(|mantissa| (f64::from(mantissa) * unit) as f32)
}

/// 2 to the power `n`, for |n| ≤ 1000.
fn power_of_two(n: i32) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52)
}

fn corrupt(detail: &str) -> DecodeError {
    DecodeError::Corrupt { format: FileFormat::Hdr, detail: detail.to_owned() }
}

fn unsupported(detail: String) -> DecodeError {
    DecodeError::Unsupported { format: FileFormat::Hdr, detail }
}

pub(crate) fn encode(image: &Image) -> Vec<u8> {
    let size = format!("-Y {} +X {}\n", image.height, image.width);
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}").into_bytes();
    for row in image.rows() {
        write_row(&mut bytes, row);
    }
    bytes
}

fn write_row(bytes: &mut Vec<u8>, row: &[Rgb]) {
    let pixels: Vec<Rgbe> = row.iter().map(|&color| stored(color)).collect();
    if !RLE_WIDTHS.contains(&row.len()) {
        bytes.extend_from_slice(pixels.as_flattened());
        return;
    }
    bytes.extend_from_slice(&[2, 2, (row.len() >> 8) as u8, row.len() as u8]);
    for component in 0..4 {
        let values: Vec<u8> = pixels.iter().map(|pixel| pixel[component]).collect();
        write_runs(bytes, &values);
    }
}

/// Writes runs of four equal bytes or more as runs, and what lies between as it is.
fn write_runs(bytes: &mut Vec<u8>, values: &[u8]) {
    const SHORTEST_RUN: usize = 4;
    let mut different = 0..0;
    for run in values.chunk_by(|a, b| a == b) {
        if run.len() < SHORTEST_RUN {
            different.end += run.len();
            continue;
        }
        write_different(bytes, &values[different.clone()]);
        for part in run.chunks(127) {
            bytes.extend_from_slice(&[128 + part.len() as u8, part[0]]);
        }
        different = different.end + run.len()..different.end + run.len();
    }
    write_different(bytes, &values[different]);
}

fn write_different(bytes: &mut Vec<u8>, values: &[u8]) {
    for part in values.chunks(128) {
        bytes.push(part.len() as u8);
        bytes.extend_from_slice(part);
    }
}

/// The stored pixel of an amount of light. Negative numbers and NaN become 0, too large ones the largest.
fn stored(color: Rgb) -> Rgbe {
    const LARGEST: f64 = 255.0 * (1u128 << 119) as f64;
    let color = color.to_array().map(|v| if v > 0.0 { f64::from(v).min(LARGEST) } else { 0.0 });
    let largest = color[0].max(color[1]).max(color[2]);
    // The exponent that puts the largest mantissa between 128 and 256, from the bits of the number.
    let mut exponent = (largest.to_bits() >> 52) as i32 - 1022;
    if (largest * power_of_two(8 - exponent.max(-127))).round() >= 256.0 {
        exponent += 1;
    }
    if exponent < -127 {
        return [0; 4];
    }
    let [r, g, b] = color.map(|v| (v * power_of_two(8 - exponent)).round() as u8);
    [r, g, b, (exponent + 128) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "#?RADIANCE\nSOFTWARE=test\nFORMAT=32-bit_rle_rgbe\n\n";

    fn decoded(text: &str, data: &[u8]) -> Result<Vec<[f32; 3]>, String> {
        match decode(&[text.as_bytes(), data].concat(), &DecodeLimits::default()) {
            Ok(Bitmap { texels: Texels::F32(texels), .. }) => Ok(texels),
            Ok(_) => Err("not floating point".into()),
            Err(error) => Err(error.to_string()),
        }
    }

    #[test]
    fn stored_pixels_of_known_numbers() {
        assert_eq!(stored(Rgb::new(1.0, 0.5, 0.25)), [128, 64, 32, 129]);
        assert_eq!(stored(Rgb::gray(0.999_9)), [128, 128, 128, 129]);
        assert_eq!(stored(Rgb::BLACK), [0; 4]);
        assert_eq!(stored(Rgb::new(-1.0, f32::NAN, 1e-39)), [0; 4]);
        assert_eq!(stored(Rgb::gray(f32::MAX)), [255; 4]);
        assert_eq!(stored(Rgb::gray(f32::INFINITY)), [255; 4]);
        assert_eq!(light([128, 64, 32, 129]), [1.0, 0.5, 0.25]);
        assert_eq!(light([9, 9, 9, 0]), [0.0; 3]);
    }

    #[test]
    fn every_exponent_survives() {
        for n in -126..127 {
            let x = power_of_two(n) as f32;
            assert_eq!(light(stored(Rgb::gray(x))), [x; 3], "2^{n}");
        }
    }

    #[test]
    fn old_runs_and_flat_rows() {
        let data = [128, 128, 128, 129, 1, 1, 1, 2, 64, 64, 64, 129];
        assert_eq!(decoded(&format!("{HEAD}-Y 1 +X 4\n"), &data), Ok(vec![[1.0; 3], [1.0; 3], [1.0; 3], [0.5; 3]]));
        let error = "broken HDR: a run does not fit into its row";
        assert_eq!(decoded(&format!("{HEAD}-Y 1 +X 4\n"), &[1, 1, 1, 2]), Err(error.into()));
        let endless = [&data[..4], &[1, 1, 1, 0].repeat(12)].concat();
        assert_eq!(decoded(&format!("{HEAD}-Y 1 +X 4\n"), &endless), Err(error.into()));
    }

    #[test]
    fn bad_headers() {
        let message = |text: &str| decoded(text, &[]).unwrap_err();
        assert_eq!(
            message(&format!("{HEAD}-Y 100000 +X 100000\n")),
            "100000 × 100000 pixels are more than the limit of 64 million"
        );
        assert_eq!(message(&format!("{HEAD}-Y 3 +X 3\n")), "the file ends too early");
        assert_eq!(message("#?RADIANCE\nFORMAT=32"), "the file ends too early");
        assert_eq!(message(&format!("{HEAD}+X 3 -Y 3\n")), "HDR with pixels in the order `+X 3 -Y 3` cannot be read");
        assert_eq!(message(&format!("{HEAD}-Y 3 +X x\n")), "broken HDR: `-Y 3 +X x` is no size");
        assert_eq!(message(&format!("{HEAD}3 3\n")), "broken HDR: there is no size");
        let xyz = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 3 +X 3\n";
        assert_eq!(message(xyz), "HDR with colors of kind `32-bit_rle_xyze` cannot be read");
    }

    #[test]
    fn long_runs_and_long_differences_survive() {
        let image = Image::from_fn(1000, 3, |x, y| match y {
            0 => Rgb::WHITE,
            1 => Rgb::gray((x % 7) as f32),
            _ => Rgb::new((x / 50) as f32, 1.0, (x % 50 / 3) as f32),
        });
        let bytes = encode(&image);
        let bitmap = decode(&bytes, &DecodeLimits::default()).unwrap();
        assert_eq!(bitmap.to_image(crate::Transfer::Linear), image);
        assert!(bytes.len() < 3000 * 3, "{}", bytes.len());
    }
}
