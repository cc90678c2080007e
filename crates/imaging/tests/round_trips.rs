//! What is written is read again: exactly where the format can, within its precision where it cannot.

use durer_imaging::{
    Bitmap, DecodeLimits, EncodeOptions, ExrSamples, FileFormat, Image, PngDepth, Texels, Transfer, about, decode,
    encode,
};
use durer_math::Rgb;

fn read(bytes: &[u8]) -> Bitmap {
    decode(bytes, &DecodeLimits::default()).unwrap()
}

/// A picture with many different numbers, from deep shadow far beyond white.
fn gradient() -> Image {
    Image::from_fn(67, 41, |x, y| {
        let (x, y) = (x as f32 / 66.0, y as f32 / 40.0);
        Rgb::new(x * x * x * 30.0, y * 0.9 + 1e-4, x * y * y)
    })
}

fn write_png(depth: PngDepth, transfer: Transfer, image: &Image) -> Vec<u8> {
    encode(image, &EncodeOptions { png_depth: depth, transfer, ..EncodeOptions::default() }).unwrap()
}

fn round_trip(image: &Image, options: &EncodeOptions) -> Image {
    let bytes = encode(image, options).unwrap();
    assert_eq!(bytes, encode(image, options).unwrap(), "the same picture must give the same bytes");
    let bitmap = read(&bytes);
    assert_eq!(bitmap.alpha, None);
    bitmap.to_image(options.transfer)
}

#[test]
fn every_8_bit_number_survives_png() {
    let texels: Vec<[u8; 3]> = (0..=255).map(|v: u8| [v, 255 - v, v / 2]).collect();
    let bitmap = Bitmap { width: 16, height: 16, texels: Texels::U8(texels), alpha: None };
    for transfer in [Transfer::Srgb, Transfer::Linear] {
        let bytes = write_png(PngDepth::Eight, transfer, &bitmap.to_image(transfer));
        assert_eq!(read(&bytes), bitmap, "{transfer:?}");
    }
}

#[test]
fn every_16_bit_number_survives_png() {
    let texels: Vec<[u16; 3]> = (0..=65535).map(|v: u16| [v, 65535 - v, v / 3]).collect();
    let bitmap = Bitmap { width: 256, height: 256, texels: Texels::U16(texels), alpha: None };
    for transfer in [Transfer::Srgb, Transfer::Linear] {
        let bytes = write_png(PngDepth::Sixteen, transfer, &bitmap.to_image(transfer));
        assert_eq!(read(&bytes), bitmap, "{transfer:?}");
    }
}

#[test]
fn pfm_and_float_exr_are_exact() {
    let mut image = gradient();
    image.set(3, 3, Rgb::new(-2.5, f32::INFINITY, f32::MIN_POSITIVE));
    assert_eq!(round_trip(&image, &EncodeOptions::new(FileFormat::Pfm)), image);
    let options = EncodeOptions { exr_samples: ExrSamples::Float, ..EncodeOptions::new(FileFormat::Exr) };
    assert_eq!(round_trip(&image, &options), image);
}

#[test]
fn transfer_does_not_touch_linear_formats() {
    for format in FileFormat::ALL.into_iter().filter(|format| format.is_linear()) {
        let srgb = EncodeOptions::new(format);
        let linear = EncodeOptions { transfer: Transfer::Linear, ..srgb.clone() };
        assert_eq!(encode(&gradient(), &srgb).unwrap(), encode(&gradient(), &linear).unwrap());
    }
}

#[test]
fn half_exr_is_within_half_precision() {
    let mut image = gradient();
    image.set(0, 0, Rgb::new(1e9, -1e9, f32::INFINITY));
    let back = round_trip(&image, &EncodeOptions::new(FileFormat::Exr));
    assert_eq!(back.pixel(0, 0), Rgb::new(65504.0, -65504.0, f32::INFINITY));
    for (a, b) in image.pixels.iter().zip(&back.pixels).skip(1) {
        for (a, b) in a.to_array().into_iter().zip(b.to_array()) {
            assert!((a - b).abs() <= a.abs() / 2048.0 + 3e-8, "{a} {b}");
        }
    }
}

#[test]
fn hdr_is_within_one_percent_of_the_largest_component() {
    let image = gradient();
    let back = round_trip(&image, &EncodeOptions::new(FileFormat::Hdr));
    for (a, b) in image.pixels.iter().zip(&back.pixels) {
        let error = (*a - *b).map(f32::abs).max_component();
        assert!(error <= 0.004 * a.max_component(), "{a:?} {b:?}");
    }
}

#[test]
fn jpeg_is_close() {
    let image = Image::from_fn(64, 48, |x, y| Rgb::new(x as f32 / 64.0, y as f32 / 48.0, 0.3));
    let back = round_trip(&image, &EncodeOptions::new(FileFormat::Jpeg));
    let d = durer_imaging::compare(&image, &back).unwrap();
    assert!(d.mean < 0.01 && d.max < 0.1, "{d:?}");
}

#[test]
fn odd_sizes_survive_everywhere() {
    for format in FileFormat::ALL {
        for (width, height) in [(1, 1), (7, 1), (1, 9), (8, 3), (300, 2), (5, 40)] {
            let image = Image { width, height, pixels: vec![Rgb::WHITE; (width * height) as usize] };
            let back = round_trip(&image, &EncodeOptions::new(format));
            assert_eq!(back, image, "{format:?} {width} × {height}");
        }
    }
}

#[test]
fn nan_and_numbers_out_of_range_in_png() {
    let pixels = vec![Rgb::new(f32::NAN, -1.0, 2.0), Rgb::new(f32::INFINITY, f32::NEG_INFINITY, 1.0)];
    let image = Image::from_pixels(2, 1, pixels).unwrap();
    for transfer in [Transfer::Srgb, Transfer::Linear] {
        let back = read(&write_png(PngDepth::Eight, transfer, &image)).texels;
        assert_eq!(back, Texels::U8(vec![[0, 0, 255], [255, 0, 255]]));
        let back = read(&write_png(PngDepth::Sixteen, transfer, &image)).texels;
        assert_eq!(back, Texels::U16(vec![[0, 0, 65535], [65535, 0, 65535]]));
    }
}

#[test]
fn png_says_srgb_only_if_it_is() {
    let has = |bytes: &[u8], name: &[u8]| bytes.windows(4).any(|window| window == name);
    let image = gradient();
    let srgb = write_png(PngDepth::Eight, Transfer::Srgb, &image);
    let linear = write_png(PngDepth::Eight, Transfer::Linear, &image);
    assert!(has(&srgb, b"sRGB") && !has(&linear, b"sRGB") && !has(&linear, b"gAMA"));
}

#[test]
fn metadata_is_in_png_and_exr() {
    let metadata = vec![("Title".to_owned(), "room".to_owned()), ("Author".to_owned(), "Dürer".to_owned())];
    let png = encode(&gradient(), &EncodeOptions { metadata: metadata.clone(), ..EncodeOptions::default() }).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(&png)).read_info().unwrap();
    assert_eq!(reader.info().uncompressed_latin1_text[0].text, "room");
    assert_eq!(reader.info().utf8_text[0].get_text().unwrap(), "Dürer");
    let exr = encode(&gradient(), &EncodeOptions { metadata, ..EncodeOptions::new(FileFormat::Exr) }).unwrap();
    let expected = "Title: room\nAuthor: Dürer\n".as_bytes();
    assert!(exr.windows(expected.len()).any(|window| window == expected));
}

#[test]
fn a_file_tells_its_size_its_samples_and_its_metadata() {
    let metadata = vec![("Title".to_owned(), "room: a".to_owned()), ("Author".to_owned(), "Dürer".to_owned())];
    let told = |format, change: fn(&mut EncodeOptions)| {
        let mut options = EncodeOptions { metadata: metadata.clone(), ..EncodeOptions::new(format) };
        change(&mut options);
        let facts = about(&encode(&gradient(), &options).unwrap()).unwrap();
        assert_eq!((facts.format, facts.width, facts.height), (format, gradient().width, gradient().height));
        (facts.samples, facts.metadata)
    };
    let with = |samples: &str| (samples.to_owned(), metadata.clone());
    assert_eq!(told(FileFormat::Png, |_| {}), with("RGB, 8 bits each"));
    assert_eq!(told(FileFormat::Png, |o| o.png_depth = PngDepth::Sixteen), with("RGB, 16 bits each"));
    assert_eq!(told(FileFormat::Exr, |_| {}), with("B half, G half, R half"));
    assert_eq!(told(FileFormat::Exr, |o| o.exr_samples = ExrSamples::Float), with("B float, G float, R float"));
    let without = |samples: &str| (samples.to_owned(), Vec::new());
    assert_eq!(told(FileFormat::Jpeg, |_| {}), without("RGB, 8 bits each"));
    assert_eq!(told(FileFormat::Hdr, |_| {}), without("RGB, 8 bits each with one exponent"));
    assert_eq!(told(FileFormat::Pfm, |_| {}), without("RGB, 32-bit floating point each"));
}

#[test]
fn headers_cut_short_are_errors_and_no_panics() {
    for format in FileFormat::ALL {
        let file = encode(&gradient(), &EncodeOptions::new(format)).unwrap();
        for end in 0..file.len().min(400) {
            if let Ok(facts) = about(&file[..end]) {
                assert_eq!((facts.width, facts.height), (gradient().width, gradient().height), "{format:?} {end}");
            }
        }
    }
}

#[test]
fn bad_keywords_are_refused() {
    for keyword in ["", " x", "Dürer", &"k".repeat(80), "a\nb"] {
        let metadata = vec![(keyword.to_owned(), "text".to_owned())];
        let error = encode(&gradient(), &EncodeOptions { metadata, ..EncodeOptions::default() }).unwrap_err();
        assert_eq!(error.to_string(), format!("`{keyword}` cannot be a keyword of the metadata in a PNG file"));
    }
}
