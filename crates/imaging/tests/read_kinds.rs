//! Kinds of files that we read but do not write.

use durer_imaging::{Alpha, Bitmap, DecodeLimits, Texels, decode};
use png::{BitDepth, ColorType};

fn read(bytes: &[u8]) -> Bitmap {
    decode(bytes, &DecodeLimits::default()).unwrap()
}

/// A PNG one row high.
fn png(width: u32, color: ColorType, depth: BitDepth, data: &[u8], palette: Option<(&[u8], &[u8])>) -> Bitmap {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, 1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some((colors, alphas)) = palette {
        encoder.set_palette(colors.to_vec());
        encoder.set_trns(alphas.to_vec());
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    let bitmap = read(&bytes);
    assert_eq!((bitmap.width, bitmap.height), (width, 1));
    bitmap
}

fn grays(values: &[u8]) -> Texels {
    Texels::U8(values.iter().map(|&v| [v; 3]).collect())
}

#[test]
fn gray_png_of_every_depth() {
    let gray = |width, depth, data: &[u8]| png(width, ColorType::Grayscale, depth, data, None).texels;
    assert_eq!(gray(4, BitDepth::One, &[0b0110_0000]), grays(&[0, 255, 255, 0]));
    assert_eq!(gray(4, BitDepth::Two, &[0b00_01_10_11]), grays(&[0, 85, 170, 255]));
    assert_eq!(gray(2, BitDepth::Four, &[0x3f]), grays(&[0x33, 255]));
    assert_eq!(gray(2, BitDepth::Eight, &[7, 200]), grays(&[7, 200]));
    assert_eq!(gray(1, BitDepth::Sixteen, &[1, 2]), Texels::U16(vec![[0x0102; 3]]));
}

#[test]
fn png_with_alpha() {
    let rgba = |data: &[u8]| png(2, ColorType::Rgba, BitDepth::Eight, data, None);
    let opaque = rgba(&[1, 2, 3, 255, 4, 5, 6, 255]);
    assert_eq!((opaque.texels, opaque.alpha), (Texels::U8(vec![[1, 2, 3], [4, 5, 6]]), None));
    assert_eq!(rgba(&[1, 2, 3, 255, 4, 5, 6, 254]).alpha, Some(Alpha::U8(vec![255, 254])));
    let gray = png(1, ColorType::GrayscaleAlpha, BitDepth::Eight, &[9, 0], None);
    assert_eq!((gray.texels, gray.alpha), (grays(&[9]), Some(Alpha::U8(vec![0]))));
    let deep = png(1, ColorType::Rgba, BitDepth::Sixteen, &[1, 2, 3, 4, 5, 6, 0xff, 0xff], None);
    assert_eq!((deep.texels, deep.alpha), (Texels::U16(vec![[0x0102, 0x0304, 0x0506]]), None));
    let deep = png(1, ColorType::GrayscaleAlpha, BitDepth::Sixteen, &[1, 2, 3, 4], None);
    assert_eq!(deep.alpha, Some(Alpha::U16(vec![0x0304])));
}

#[test]
fn png_with_a_palette() {
    let colors = [10, 20, 30, 40, 50, 60];
    let palette = |data: &[u8], alphas: &[u8]| png(3, ColorType::Indexed, BitDepth::Two, data, Some((&colors, alphas)));
    let opaque = palette(&[0b01_00_01_00], &[255, 255]);
    let expected = Texels::U8(vec![[40, 50, 60], [10, 20, 30], [40, 50, 60]]);
    assert_eq!((opaque.texels, opaque.alpha), (expected, None));
    let clear = palette(&[0b01_00_01_00], &[7, 255]);
    assert_eq!(clear.alpha, Some(Alpha::U8(vec![255, 7, 255])));
}

#[test]
fn interlaced_png() {
    // 3 × 3 grays of 50 y + 20 x, in the seven passes of Adam7.
    let bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x03\x08\0\0\0\x01\x04\x44\xda\xf5\0\0\0\x17IDAT\
        \x78\xda\x63\x60\x60\xd0\x60\x48\xe9\x61\x10\x61\xa8\x60\x30\x72\x8b\x02\0\x0f\x23\x02\x77\x4e\x4d\x84\x74\
        \0\0\0\0IEND\xae\x42\x60\x82";
    assert_eq!(read(bytes).texels, grays(&[0, 20, 40, 50, 70, 90, 100, 120, 140]));
}

/// A JPEG of one gray, 16 × 8 pixels.
fn gray_jpeg() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
    encoder.encode(&[77; 16 * 8], 16, 8, image::ExtendedColorType::L8).unwrap();
    bytes
}

#[test]
fn gray_jpeg_is_read_as_color() {
    assert_eq!(read(&gray_jpeg()).texels, grays(&[77; 16 * 8]));
}

#[test]
fn a_photo_is_turned_as_the_camera_was_held() {
    // An Exif segment whose only entry is the orientation, 6: to be turned by a quarter.
    let tiff = b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
    let exif = [b"\xff\xe1\0\x22Exif\0\0".as_slice(), tiff].concat();
    let plain = gray_jpeg();
    let turned = read(&[&plain[..2], &exif, &plain[2..]].concat());
    assert_eq!((turned.width, turned.height), (8, 16));
}

#[test]
fn exr_of_luminance_and_alpha() {
    use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, WritableImage};
    let channel = |name, samples: &[f32]| AnyChannel::new(name, FlatSamples::F32(samples.to_vec()));
    let write = |channels: Vec<AnyChannel<FlatSamples>>| {
        let channels = AnyChannels::sort(channels.into_iter().collect());
        let mut bytes = std::io::Cursor::new(Vec::new());
        let image = Image::from_channels((2, 1), channels);
        image.write().non_parallel().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    let gray = read(&write(vec![channel("Y", &[0.5, 7.0]), channel("A", &[1.0, 0.5])]));
    assert_eq!((gray.texels, gray.alpha), (Texels::F32(vec![[0.5; 3], [7.0; 3]]), Some(Alpha::F32(vec![1.0, 0.5]))));
    let opaque = read(&write(vec![channel("Y", &[0.5, 7.0]), channel("A", &[1.0, 1.0])]));
    assert_eq!(opaque.alpha, None);
    let depth = decode(&write(vec![channel("Z", &[1.0, 2.0])]), &DecodeLimits::default()).unwrap_err();
    assert_eq!(depth.to_string(), "EXR with no flat channels R, G and B cannot be read");
}
