//! `durer develop`.

use crate::workshop::Workshop;
use durer::imaging::{
    EncodeOptions, ExrSamples, FileFormat, Image, Layer, Layers, Samples, ToneMapping, encode_layers,
};
use durer::math::Rgb;

/// Light of a color for each pixel, from dark to brighter than white.
fn light() -> Image {
    Image::from_fn(8, 2, |x, y| Rgb::new(x as f32 * 0.5, 0.1 * x as f32, y as f32 * 2.0))
}

/// A folder with `film.exr`: light that is half there in the lower row, depth, and names of objects.
fn film(metadata: &[(&str, &str)]) -> Workshop {
    let workshop = Workshop::new();
    let mut layers = Layers::of_image(&light(), Some(&[[1.0; 8], [0.5; 8]].concat()));
    let numbers = || (0..16).map(|i| i as f32);
    layers.layers.push(Layer::new("depth", [("Z", Samples::of(numbers(), ExrSamples::Float))]));
    layers.layers.push(Layer::new("object_id", [("ID", Samples::Whole((0..16).collect()))]));
    layers.layers.push(Layer::new("odd", []));
    layers.layers.retain(|layer| !layer.channels.is_empty());
    let metadata = metadata.iter().map(|(keyword, text)| ((*keyword).to_owned(), (*text).to_owned())).collect();
    let options = EncodeOptions { metadata, ..EncodeOptions::new(FileFormat::Exr) };
    std::fs::write(workshop.path("film.exr"), encode_layers(layers, &options).unwrap()).unwrap();
    workshop
}

fn assert_shows(workshop: &Workshop, name: &str, expected: impl Fn(Rgb) -> Rgb) {
    let picture = workshop.picture(name);
    // The upper row is all there.
    for (shown, light) in picture.pixels.iter().zip(light().pixels).take(8) {
        let expected = expected(light).map(|c| c.clamp(0.0, 1.0));
        assert!((*shown - expected).map(f32::abs).max_component() < 0.01, "{name}: {shown:?} is not {expected:?}");
    }
}

#[test]
fn light_is_developed_as_asked() {
    let workshop = film(&[]);
    let ran = workshop.fine("develop film.exr");
    assert!(ran.stderr.starts_with("film.png: 8 × 2 pixels, "), "{}", ran.stderr);
    assert_shows(&workshop, "film.png", |light| light);
    workshop.fine("develop film.exr -o a.png --exposure -1 --tone-mapping aces -q");
    assert_shows(&workshop, "a.png", |light| ToneMapping::Aces.apply(light, -1.0));
    for mapping in ToneMapping::ALL {
        workshop.fine(&format!("develop film.exr -o b.png --tone-mapping {} --bit-depth 16 -q", mapping.word()));
        assert_shows(&workshop, "b.png", |light| mapping.apply(light, 0.0));
    }
    workshop.fine("develop film.exr -o c.jpg --quality 100");
    assert_eq!(workshop.picture("c.jpg").width, 8);
    workshop.fine("develop film.exr -o d.pfm");
    assert_eq!(workshop.picture("d.pfm"), light());
}

#[test]
fn what_is_half_there_is_half_there_in_png() {
    let workshop = film(&[]);
    workshop.fine("develop film.exr");
    let limits = durer::imaging::DecodeLimits::default();
    let bitmap = durer::read_picture(&workshop.path("film.png"), &limits).unwrap();
    let alpha = bitmap.alpha.as_ref().expect("there is alpha");
    assert_eq!((alpha.get(7), (alpha.get(8) * 255.0) as u32), (1.0, 128));
    let straight = bitmap.to_image(durer::imaging::Transfer::Srgb).pixel(1, 1);
    assert!((straight - Rgb::new(1.0, 0.2, 1.0)).map(f32::abs).max_component() < 0.01, "{straight:?}");
}

#[test]
fn the_films_own_settings_hold_unless_others_are_given() {
    let workshop = film(&[("Exposure", "-2"), ("Tone mapping", "pbr_neutral"), ("Scene", "abc")]);
    workshop.fine("develop film.exr -o a.png");
    assert_shows(&workshop, "a.png", |light| ToneMapping::PbrNeutral.apply(light, -2.0));
    assert!(workshop.fine("info a.png").stdout.contains("Scene    abc"), "{}", workshop.fine("info a.png").stdout);
    workshop.fine("develop film.exr -o b.png --exposure 0 --tone-mapping none");
    assert_shows(&workshop, "b.png", |light| light);
    let strange = film(&[("Exposure", "very"), ("Tone mapping", "magic"), ("Transfer", "loud")]);
    strange.fine("develop film.exr -o a.png");
    assert_shows(&strange, "a.png", |light| light);
}

#[test]
fn layers_are_listed_and_shown() {
    let workshop = film(&[]);
    let list = workshop.fine("develop film.exr --list").stdout;
    let expected = "beauty     8 × 2  R float, G float, B float, A float\n\
        depth      8 × 2  Z float\n\
        object_id  8 × 2  ID integer\n";
    assert_eq!(list, expected);
    let json = workshop.fine("develop film.exr --list --json").json();
    assert_eq!(json[2]["channels"][0], serde_json::json!({ "name": "ID", "samples": "integer" }));
    workshop.fine("develop film.exr --layer depth");
    let depth = workshop.picture("film.depth.png");
    assert!(depth.pixels[0] == Rgb::WHITE && depth.pixels[15].g < 0.05 && depth.pixels[1].g < 1.0);
    workshop.fine("develop film.exr --layer object_id -o names.png");
    let names = workshop.picture("names.png").pixels;
    assert!(names[0] == Rgb::BLACK && names[1] != names[2]);
    workshop.fails("develop film.exr --layer normal", 2, "has no layer `normal`; it has beauty, depth, object_id");
    workshop.fails("develop film.exr --layer depth --exposure 1", 2, "--exposure is for light; the layer `depth`");
    workshop.fails("develop film.exr --layer object_id --transfer linear", 2, "--transfer is for light");
}

#[test]
fn other_pictures_can_be_developed_too() {
    let workshop = film(&[]);
    for name in ["a.hdr", "a.pfm", "a.png", "a.jpg"] {
        workshop.fine(&format!("develop film.exr -o {name}"));
        workshop.fine(&format!("develop {name} -o again.png --exposure 1"));
    }
    workshop.fine("develop a.pfm -o b.png --tone-mapping reinhard");
    assert_shows(&workshop, "b.png", |light| ToneMapping::Reinhard.apply(light, 0.0));
    assert_eq!(workshop.fine("develop a.hdr --list").stdout, "beauty  8 × 2  \n");
}

#[test]
fn what_cannot_be_done_is_said() {
    let workshop = film(&[]);
    workshop.fails("develop missing.exr", 4, "missing.exr");
    workshop.fails("develop room.yaml", 4, "not a PNG, JPEG, HDR, EXR or PFM file");
    workshop.fails("develop film.exr -o film.bmp", 2, "bmp");
    workshop.fails("develop film.exr -o no/film.png", 4, "no/film.png");
    workshop.fails("develop film.exr -o a.hdr --exposure 1", 2, "--exposure is for PNG and JPEG; HDR holds the light");
    workshop.fails("develop film.exr --exposure much", 2, "from -100 to 100");
    workshop.fails("develop film.exr --tone-mapping loud", 2, "pbr_neutral");
    workshop.fails("develop film.exr --list -o a.png", 2, "--list");
    let bytes = workshop.bytes("film.exr");
    std::fs::write(workshop.path("cut.exr"), &bytes[..bytes.len() / 2]).unwrap();
    workshop.fails("develop cut.exr", 4, "ends too early");
    assert!(!workshop.path("cut.png").exists() && !workshop.names().iter().any(|name| name.ends_with(".part")));
}
