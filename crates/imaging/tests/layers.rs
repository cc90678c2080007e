//! Layers of film files: what is written is read again, whole or one layer alone, and other programs' files are understood.

use durer_imaging::{
    Alpha, BEAUTY, DecodeError, DecodeLimits, EncodeOptions, ExrSamples, FileFormat, Image, Layer, Layers, PngDepth,
    Samples, Texels, Transfer, about, decode, decode_layers, encode, encode_layers, encode_with_alpha, layer_facts,
};
use durer_math::Rgb;

const SIZE: (u32, u32) = (37, 23);

fn pixels(color: impl Fn(f32, f32) -> Rgb) -> Vec<Rgb> {
    Image::from_fn(SIZE.0, SIZE.1, |x, y| color(x as f32, y as f32)).pixels
}

/// A film of layers in all precisions.
fn film() -> Layers {
    let beauty = Layer::of_colors(BEAUTY, &pixels(|x, y| Rgb::new(x * 2.0, y / 16.0, 0.5)), ExrSamples::Half);
    let albedo = Layer::of_colors("albedo", &pixels(|x, y| Rgb::new(0.25, x / 64.0, y / 32.0)), ExrSamples::Half);
    let count = (SIZE.0 * SIZE.1) as usize;
    let place = |k: f32| Samples::of((0..count).map(|i| i as f32 * k + 0.1), ExrSamples::Float);
    let mut depth: Vec<f32> = (0..count).map(|i| 3.0 + i as f32).collect();
    depth[7] = f32::INFINITY;
    let names = (0..count).map(|i| u32::MAX - i as u32).collect();
    let layers = vec![
        beauty,
        albedo,
        Layer::new("depth", [("Z", Samples::Float(depth))]),
        Layer::new("object_id", [("ID", Samples::Whole(names))]),
        Layer::new("position", [("X", place(1.0)), ("Y", place(-2.0)), ("Z", place(0.1))]),
    ];
    Layers { width: SIZE.0, height: SIZE.1, layers }
}

fn options() -> EncodeOptions {
    EncodeOptions { metadata: vec![("Software".into(), "a test".into())], ..EncodeOptions::new(FileFormat::Exr) }
}

fn read(bytes: &[u8], only: Option<&str>) -> Result<Layers, DecodeError> {
    decode_layers(bytes, only, &DecodeLimits::default())
}

#[test]
fn layers_survive_in_their_precision() {
    let bytes = encode_layers(film(), &options()).unwrap();
    assert_eq!(bytes, encode_layers(film(), &options()).unwrap(), "the same film must give the same bytes");
    assert_eq!(read(&bytes, None).unwrap(), film());
    for layer in film().layers {
        let alone = read(&bytes, Some(&layer.name)).unwrap();
        assert_eq!((alone.width, alone.height, alone.layers), (SIZE.0, SIZE.1, vec![layer]));
    }
    assert!(read(&bytes, Some("normal")).unwrap().layers.is_empty());
}

#[test]
fn who_knows_no_layers_sees_the_beauty() {
    let bytes = encode_layers(film(), &options()).unwrap();
    let seen = decode(&bytes, &DecodeLimits::default()).unwrap().to_image(Transfer::Srgb);
    assert_eq!(seen.pixels, pixels(|x, y| Rgb::new(x * 2.0, y / 16.0, 0.5)));
    let facts = about(&bytes).unwrap();
    assert_eq!(facts.metadata, options().metadata);
    assert!(facts.samples.contains("albedo.G half") && facts.samples.contains("object_id.ID integer"), "{facts:?}");
}

#[test]
fn layers_are_told_without_reading_them() {
    let bytes = encode_layers(film(), &options()).unwrap();
    let facts = layer_facts(&bytes[..2000]).unwrap();
    let told: Vec<String> = facts
        .iter()
        .map(|layer| {
            let channels: Vec<String> = layer.channels.iter().map(|(name, kind)| format!("{name} {kind}")).collect();
            format!("{} {}x{}: {}", layer.name, layer.width, layer.height, channels.join(", "))
        })
        .collect();
    let expected = [
        "beauty 37x23: R half, G half, B half",
        "albedo 37x23: R half, G half, B half",
        "depth 37x23: Z float",
        "object_id 37x23: ID integer",
        "position 37x23: X float, Y float, Z float",
    ];
    assert_eq!(told, expected);
}

#[test]
fn parts_of_other_programs_are_layers_too() {
    use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, LayerAttributes, WritableImage};
    let part = |name: &str, channels: &[&str], size: (usize, usize)| {
        let samples = |k: usize| FlatSamples::F32((0..size.0 * size.1).map(|i| (i * k) as f32).collect());
        let channels = channels.iter().enumerate().map(|(k, name)| AnyChannel::new(*name, samples(k + 1)));
        let tiled =
            Encoding { blocks: exr::prelude::Blocks::Tiles(exr::prelude::Vec2(4, 4)), ..Encoding::SMALL_LOSSLESS };
        exr::prelude::Layer::new(size, LayerAttributes::named(name), tiled, AnyChannels::sort(channels.collect()))
    };
    let write = |layers: Vec<_>| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let attributes = exr::prelude::ImageAttributes::new(exr::prelude::IntegerBounds::from_dimensions((9, 5)));
        let layers: exr::prelude::Layers<_> = layers.into_iter().collect();
        let image = exr::prelude::Image::from_layers(attributes, layers);
        image.write().non_parallel().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    let bytes = write(vec![part("beauty", &["B", "G", "R"], (9, 5)), part("depth", &["Z", "fog.V"], (9, 5))]);
    let layers = read(&bytes, None).unwrap();
    let names: Vec<&str> = layers.layers.iter().map(|layer| layer.name.as_str()).collect();
    assert_eq!(names, ["beauty", "depth", "fog"]);
    let [r, z, v] = [("beauty", "R"), ("depth", "Z"), ("fog", "V")]
        .map(|(layer, channel)| layers.get(layer).unwrap().channel(channel).unwrap().get(44));
    assert_eq!((r, z, v), (132.0, 44.0, 88.0));

    let uneven = write(vec![part("beauty", &["B", "G", "R"], (9, 5)), part("small", &["Z"], (3, 2))]);
    let error = read(&uneven, None).unwrap_err().to_string();
    assert_eq!(error, "EXR with layers of different sizes cannot be read");
    assert_eq!(read(&uneven, Some("small")).map(|layers| (layers.width, layers.height)).unwrap(), (3, 2));
}

#[test]
fn inconsistent_layers_are_refused() {
    let refused =
        |layers: Vec<Layer>| encode_layers(Layers { width: 2, height: 1, layers }, &options()).unwrap_err().to_string();
    let counts = |name: &str, length: usize| Layer::new(name, [("N", Samples::Whole(vec![1; length]))]);
    assert_eq!(refused(vec![counts("a", 3)]), "a picture of 2 × 1 pixels comes with 3 values");
    let names = "cannot write EXR: layers need channels, each with a name of its own";
    assert_eq!(refused(vec![]), names);
    assert_eq!(refused(vec![counts("a", 2), counts("a", 2)]), names);
}

#[test]
fn damaged_films_are_errors_or_pictures() {
    let limits = DecodeLimits { max_pixels: 100_000, max_bytes: 2_000_000 };
    let bytes = encode_layers(film(), &options()).unwrap();
    for length in (0..bytes.len()).step_by(11) {
        assert!(decode_layers(&bytes[..length], None, &limits).is_err(), "the first {length} of {}", bytes.len());
    }
    for index in 0..bytes.len() {
        for bit in if index < 1200 { 0..8 } else { index % 8..index % 8 + 1 } {
            let mut broken = bytes.clone();
            broken[index] ^= 1 << bit;
            let _ = layer_facts(&broken);
            let _ = decode_layers(&broken, None, &limits);
        }
    }
}

#[test]
fn limits_count_what_is_read() {
    let bytes = encode_layers(film(), &options()).unwrap();
    let pixels = u64::from(SIZE.0 * SIZE.1);
    let limits = DecodeLimits { max_pixels: pixels, max_bytes: 26 * pixels };
    assert!(matches!(decode_layers(&bytes, None, &limits), Err(DecodeError::TooManyBytes { .. })));
    assert!(decode_layers(&bytes, Some("object_id"), &limits).is_ok());
}

#[test]
fn png_and_exr_keep_alpha() {
    let image = Image { width: 3, height: 1, pixels: vec![Rgb::new(0.1, 0.2, 0.0), Rgb::gray(0.25), Rgb::BLACK] };
    let alpha = [0.2, 1.0, 0.0];
    for png_depth in [PngDepth::Eight, PngDepth::Sixteen] {
        let png = EncodeOptions { png_depth, transfer: Transfer::Linear, ..EncodeOptions::default() };
        let bitmap = decode(&encode_with_alpha(&image, &alpha, &png).unwrap(), &DecodeLimits::default()).unwrap();
        match (bitmap.texels, bitmap.alpha) {
            (Texels::U8(texels), Some(Alpha::U8(alphas))) => {
                assert_eq!(texels, [[128, 255, 0], [64, 64, 64], [0, 0, 0]]);
                assert_eq!(alphas, [51, 255, 0]);
            }
            (Texels::U16(texels), Some(Alpha::U16(alphas))) => {
                assert_eq!(texels, [[32768, 65535, 0], [16384, 16384, 16384], [0, 0, 0]]);
                assert_eq!(alphas, [13107, 65535, 0]);
            }
            other => panic!("{other:?}"),
        }
    }
    let exr = EncodeOptions { exr_samples: ExrSamples::Float, ..EncodeOptions::new(FileFormat::Exr) };
    let bitmap = decode(&encode_with_alpha(&image, &alpha, &exr).unwrap(), &DecodeLimits::default()).unwrap();
    assert_eq!(bitmap.to_image(Transfer::Srgb), image);
    assert_eq!(bitmap.alpha, Some(Alpha::F32(alpha.to_vec())));
}

#[test]
fn only_files_for_screens_are_developed() {
    use durer_imaging::ToneMapping;
    let image = Image { width: 1, height: 1, pixels: vec![Rgb::new(0.25, 4.0, 0.5)] };
    let read = |options: &EncodeOptions| {
        decode(&encode(&image, options).unwrap(), &DecodeLimits::default()).unwrap().to_image(options.transfer)
    };
    for tone_mapping in ToneMapping::ALL {
        for format in [FileFormat::Exr, FileFormat::Hdr, FileFormat::Pfm] {
            let options = EncodeOptions { exposure: 3.0, tone_mapping, ..EncodeOptions::new(format) };
            assert!((read(&options).pixels[0] - image.pixels[0]).map(f32::abs).max_component() < 0.02, "{format:?}");
        }
        let png =
            EncodeOptions { exposure: -1.0, tone_mapping, png_depth: PngDepth::Sixteen, ..EncodeOptions::default() };
        let shown = tone_mapping.apply(image.pixels[0], -1.0).map(|c| c.clamp(0.0, 1.0));
        assert!((read(&png).pixels[0] - shown).map(f32::abs).max_component() < 1e-4, "{tone_mapping:?}");
        let jpeg =
            EncodeOptions { exposure: -1.0, tone_mapping, jpeg_quality: 100, ..EncodeOptions::new(FileFormat::Jpeg) };
        assert!((read(&jpeg).pixels[0] - shown).map(f32::abs).max_component() < 0.05, "{tone_mapping:?}");
    }
}
