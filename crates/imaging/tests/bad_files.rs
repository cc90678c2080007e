//! Broken, hostile and truncated files give an error or, where damage cannot be told from content, a picture; never a
//! panic and never a large allocation.

use durer_imaging::{
    DecodeError, DecodeLimits, EncodeOptions, ExrSamples, FileFormat, Image, PngDepth, decode, encode,
};
use durer_math::Rgb;

/// One file of each kind we write.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let image = Image::from_fn(37, 23, |x, y| Rgb::new(x as f32 / 20.0, y as f32 / 23.0, (x * y % 5) as f32 * 0.2));
    let metadata = vec![("Software".to_owned(), "test".to_owned())];
    let new = |format| EncodeOptions { metadata: metadata.clone(), ..EncodeOptions::new(format) };
    let kinds = [
        ("PNG", new(FileFormat::Png)),
        ("PNG of 16 bits", EncodeOptions { png_depth: PngDepth::Sixteen, ..new(FileFormat::Png) }),
        ("JPEG", new(FileFormat::Jpeg)),
        ("EXR", new(FileFormat::Exr)),
        ("EXR of floats", EncodeOptions { exr_samples: ExrSamples::Float, ..new(FileFormat::Exr) }),
        ("HDR", new(FileFormat::Hdr)),
        ("PFM", new(FileFormat::Pfm)),
    ];
    kinds.into_iter().map(|(name, options)| (name, encode(&image, &options).unwrap())).collect()
}

/// Limits that a file of any size in the header can meet, so that only small allocations happen.
fn limits() -> DecodeLimits {
    DecodeLimits { max_pixels: 100_000, max_bytes: 2_000_000 }
}

#[test]
fn truncated_files_are_errors() {
    for (name, bytes) in files() {
        assert!(decode(&bytes, &limits()).is_ok(), "{name}");
        for length in (0..bytes.len()).step_by(7).chain(bytes.len() - 12..bytes.len()) {
            assert!(decode(&bytes[..length], &limits()).is_err(), "{name}: the first {length} of {}", bytes.len());
        }
    }
}

#[test]
fn a_file_cut_in_half_says_so() {
    for (name, bytes) in files() {
        let error = decode(&bytes[..bytes.len() / 2], &limits()).unwrap_err();
        assert_eq!(error.to_string(), "the file ends too early", "{name}");
    }
}

#[test]
fn flipped_bits_do_not_panic() {
    for (_, bytes) in files() {
        for index in 0..bytes.len() {
            // All bits of all bytes in the header, one of each later byte.
            let masks = if index < 500 { 0..8 } else { index % 8..index % 8 + 1 };
            for bit in masks {
                let mut broken = bytes.clone();
                broken[index] ^= 1 << bit;
                let _ = decode(&broken, &limits());
            }
        }
    }
}

#[test]
fn extreme_bytes_do_not_panic() {
    for (_, bytes) in files() {
        for index in 0..bytes.len().min(1000) {
            for patch in [[0x00; 4], [0xff; 4], [0x7f, 0xff, 0xff, 0xff], [0xff, 0xff, 0xff, 0x7f]] {
                for length in [1, 2, 4] {
                    let mut broken = bytes.clone();
                    let end = (index + length).min(broken.len());
                    broken[index..end].copy_from_slice(&patch[4 - (end - index)..]);
                    let _ = decode(&broken, &limits());
                }
            }
        }
    }
}

#[test]
fn signatures_followed_by_noise_do_not_panic() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut noise = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as u8
    };
    for (_, bytes) in files() {
        for start in [2, 4, 8, 11, 20, 40, 100, bytes.len() / 2] {
            for _ in 0..200 {
                let mut broken = bytes.clone();
                broken[start..].fill_with(&mut noise);
                let _ = decode(&broken, &limits());
            }
        }
    }
}

/// The bytes with `from` replaced by `to` where it first occurs.
fn patched(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = bytes.windows(from.len()).position(|window| window == from).unwrap();
    [&bytes[..at], to, &bytes[at + from.len()..]].concat()
}

#[test]
fn headers_that_claim_too_much_are_refused() {
    let image = Image::new(37, 23);
    let huge = 60_000u32;
    let file = |format| encode(&image, &EncodeOptions::new(format)).unwrap();
    let png = {
        let size = [huge.to_be_bytes(), huge.to_be_bytes()].concat();
        let header = [b"IHDR".as_slice(), &size, &[8, 2, 0, 0, 0]].concat();
        let mut bytes = patched(&file(FileFormat::Png), &[0, 0, 0, 37, 0, 0, 0, 23], &size);
        bytes[29..33].copy_from_slice(&crc(&header).to_be_bytes());
        bytes
    };
    let jpeg = patched(&file(FileFormat::Jpeg), &[8, 0, 23, 0, 37], &[8, 0xea, 0x60, 0xea, 0x60]);
    let window = |x: u32, y: u32| {
        let (x, y) = ((x - 1).to_le_bytes(), (y - 1).to_le_bytes());
        [b"dataWindow\0box2i\0\x10\0\0\0".as_slice(), &[0; 8], &x, &y].concat()
    };
    let exr = patched(&file(FileFormat::Exr), &window(37, 23), &window(huge, huge));
    let hdr = patched(&file(FileFormat::Hdr), b"-Y 23 +X 37", b"-Y 60000 +X 60000");
    let pfm = patched(&file(FileFormat::Pfm), b"37 23", b"60000 60000");
    for (name, bytes) in [("PNG", png), ("JPEG", jpeg), ("EXR", exr), ("HDR", hdr), ("PFM", pfm)] {
        let message = decode(&bytes, &DecodeLimits::default()).map(|_| ()).map_err(|error| error.to_string());
        assert_eq!(message, Err("60000 × 60000 pixels are more than the limit of 64 million".into()), "{name}");
    }
}

#[test]
fn broken_b44_blocks_are_no_panic() {
    use exr::prelude::{AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, LayerAttributes};
    use exr::prelude::{Layer, LineOrder, WritableImage, f16};
    // No block of 4 × 4 is flat, so that each takes 14 bytes and the file is not stored without compression.
    let numbers: Vec<f16> = (0..1024).map(|i| f16::from_f32((i % 7) as f32)).collect();
    let channel = |name| AnyChannel::new(name, FlatSamples::F16(numbers.clone()));
    let channels = AnyChannels::sort(["R", "G", "B"].into_iter().map(channel).collect());
    let encoding =
        Encoding { compression: Compression::B44, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let image = exr::prelude::Image::from_layer(Layer::new((32, 32), LayerAttributes::default(), encoding, channels));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    let mut bytes = bytes.into_inner();
    assert!(decode(&bytes, &limits()).is_ok());
    let tail = bytes.len() - 300;
    bytes[tail..].fill(0);
    let _ = decode(&bytes, &limits());
}

/// The checksum of PNG chunks.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc: u32, _| (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 })
    })
}

#[test]
fn limits_are_obeyed_by_every_format() {
    for (name, bytes) in files() {
        let few = DecodeLimits { max_pixels: 37 * 23 - 1, ..DecodeLimits::default() };
        assert!(
            matches!(decode(&bytes, &few), Err(DecodeError::TooManyPixels { width: 37, height: 23, .. })),
            "{name}"
        );
        let small = DecodeLimits { max_bytes: 37 * 23 * 3 - 1, ..DecodeLimits::default() };
        assert!(matches!(decode(&bytes, &small), Err(DecodeError::TooManyBytes { .. })), "{name}");
        assert!(decode(&bytes, &DecodeLimits { max_pixels: 37 * 23, max_bytes: 37 * 23 * 12 }).is_ok(), "{name}");
    }
}
