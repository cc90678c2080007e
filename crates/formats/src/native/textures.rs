//! Textures: named under `textures:`, or written where they are used.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, choice_value, example_of, fields, record};
use super::tree::{Node, NodeKind};
use super::value::Value;
use super::write::{FieldsOut, Out, Writer};
use durer_math::{DVec3, Rgb};
use durer_scene::{
    Channels, Encoding, Filter, ImageId, ImageTexture, Mapping, Paint, Pattern, Space, Texture, Transform, Wrap,
};
use serde_json::{Value as Json, json};
use std::rc::Rc;

const WHITE: Paint = Paint::Color(Rgb::WHITE);
const BLACK: Paint = Paint::Color(Rgb::BLACK);

fn rgb(r: f32, g: f32, b: f32) -> Paint {
    Paint::Color(Rgb::new(r, g, b))
}

choice! { Pattern, "texture";
    Checker "checker": "Cubes of two colors in turn; on a flat surface, squares.",
    example "checker: {colors: [white, black], size: 0.5}",
    {
        colors: [Paint; 2] = [WHITE, BLACK] => "The two colors or textures.";
        size: f64 = 1.0 => "Edge of a cube.";
        space: Space = Space::Object => "The coordinates used.";
    }
    Stripes "stripes": "Slabs of colors in turn.",
    example "stripes: {colors: [white, red, white, blue], axis: [0, 1, 0], width: 0.25}",
    {
        colors: Vec<Paint> = vec![WHITE, BLACK] => "Two or more colors or textures.";
        axis: DVec3 = DVec3::X => "Direction across the stripes; any length but zero.";
        width: f64 = 1.0 => "Thickness of one slab.";
        space: Space = Space::Object => "The coordinates used.";
    }
    Rings "rings": "Tubes around the y axis, colors in turn.",
    example "rings: {colors: [white, red], width: 0.2}",
    {
        colors: Vec<Paint> = vec![WHITE, BLACK] => "Two or more colors or textures.";
        width: f64 = 1.0 => "Thickness of one tube.";
        space: Space = Space::Object => "The coordinates used; with `uv`, rings around (0, 0).";
    }
    Gradient "gradient": "Colors blended into each other at equal steps.",
    example "gradient: {colors: [navy, orange, white], axis: [0, 1, 0], length: 2}",
    {
        colors: Vec<Paint> = vec![BLACK, WHITE] => "Two or more colors or textures.";
        axis: DVec3 = DVec3::Y => "Direction of the gradient; any length but zero.";
        length: f64 = 1.0 => "From the first color to the last.";
        wrap: Wrap = Wrap::Repeat => "What is beyond.";
        space: Space = Space::Object => "The coordinates used.";
    }
    Image "image": "A picture from a file (PNG, JPEG, HDR, EXR, PFM).",
    example "image: {file: earth.png, mapping: spherical}",
    (ImageTexture)
    Noise "noise": "Blotches of fractal noise.",
    example "noise: {colors: [skyblue, white], size: 0.5}",
    {
        colors: [Paint; 2] = [WHITE, BLACK] => "At the least and at the greatest values.";
        size: f64 = 1.0 => "Size of the largest blotches.";
        octaves: u32 = 4 => "How many scales of noise are added, each half the size of the one before; 1 to 16.";
    }
    Marble "marble": "Veins across the x axis, bent by noise.",
    example "marble: {size: 0.8, turbulence: 3}",
    {
        colors: [Paint; 2] = [rgb(0.9, 0.88, 0.85), rgb(0.15, 0.15, 0.2)] => "The stone and its veins.";
        size: f64 = 1.0 => "Distance between veins.";
        turbulence: f64 = 2.0 => "How far the veins are bent, in multiples of their distance.";
        octaves: u32 = 6 => "Scales of noise, 1 to 16.";
    }
    Wood "wood": "Year rings around the y axis, bent by noise.",
    example "wood: {size: 0.2}",
    {
        colors: [Paint; 2] = [rgb(0.55, 0.3, 0.12), rgb(0.28, 0.13, 0.05)] => "Early and late wood.";
        size: f64 = 0.2 => "Distance between rings.";
        turbulence: f64 = 0.3 => "How far the rings are bent, in multiples of their distance.";
        octaves: u32 = 3 => "Scales of noise, 1 to 16.";
    }
}

record!(ImageTexture {
    image as "file": ImageId => "The file, relative to the scene file.";
    mapping: Mapping = Mapping::Uv => "How a point becomes a place on the image.";
    wrap: Wrap = Wrap::Repeat => "What is beyond the edges of the image.";
    filter: Filter = Filter::Bilinear => "What is between the centers of pixels.";
    encoding: Encoding = Encoding::Srgb => "What the numbers in the file mean.";
    channels: Channels = Channels::Color => "Which of its channels are shown.";
    tint: Rgb = Rgb::WHITE => "Multiplies what the file says; not negative.";
});

choice! { Mapping, "mapping";
    Uv "uv": "The surface's own coordinates.", example "mapping: uv", {}
    Planar "planar": "Straight down the z axis, one image to a unit square.", example "mapping: planar", {}
    Spherical "spherical": "Around the origin, like a globe.", example "mapping: spherical", {}
    Cylindrical "cylindrical": "Around the y axis, like a label.", example "mapping: {cylindrical: {half_height: 1}}",
    {
        half_height: f64 => "The image reaches from minus this to this height.";
    }
}
choice_value!(Mapping, Mapping::Uv);

choice! { Space, "space";
    Object "object": "The object's own, before its transforms: the pattern is carved from a block.", example "space: object", {}
    Uv "uv": "The surface's coordinates.", example "space: uv", {}
}
choice_value!(Space, Space::Object);

choice! { Wrap, "wrap";
    Repeat "repeat": "The same again.", example "wrap: repeat", {}
    Clamp "clamp": "The color of the edge.", example "wrap: clamp", {}
    Mirror "mirror": "The same mirrored, in turn.", example "wrap: mirror", {}
}
choice_value!(Wrap, Wrap::Repeat);

choice! { Filter, "filter";
    Nearest "nearest": "The color of the nearest pixel.", example "filter: nearest", {}
    Bilinear "bilinear": "Blended from the four around.", example "filter: bilinear", {}
}
choice_value!(Filter, Filter::Bilinear);

choice! { Encoding, "encoding";
    Srgb "srgb": "Colors for screens, as in photographs.", example "encoding: srgb", {}
    Linear "linear": "Linear light, as in measured data.", example "encoding: linear", {}
}
choice_value!(Encoding, Encoding::Srgb);

choice! { Channels, "channels";
    Color "color": "Its colors.", example "channels: color", {}
    Red "red": "Its red, as gray. This and the next two are for numbers such as `roughness`.", example "channels: red", {}
    Green "green": "Its green, as gray.", example "channels: green", {}
    Blue "blue": "Its blue, as gray.", example "channels: blue", {}
    Alpha "alpha": "Its alpha channel, as gray; white if it has none. For the `opacity` of materials.", example "channels: alpha", {}
}
choice_value!(Channels, Channels::Color);

/// The field that all textures have.
pub(crate) struct Placing {
    transform: Transform,
}

record!(Placing {
    transform: Transform = Transform::default() => "Steps that move the pattern, the first one first.";
});

impl Value for Texture {
    fn noun() -> String {
        "a texture".to_owned()
    }
    fn stand_in() -> Self {
        let pattern = Pattern::Checker { colors: [WHITE, BLACK], size: 1.0, space: Space::Object };
        Texture { name: None, transform: Transform::default(), pattern }
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        let words: Vec<&'static str> = Pattern::WORDS.iter().map(|(word, _)| *word).collect();
        let mut from = Fields::of_kind(node, cx, "texture", &words)?;
        let word = from.word();
        from.set_example(example_of::<Pattern>(word));
        let pattern = Pattern::read(word, &mut from);
        let Placing { transform } = Placing::read(&mut from);
        from.finish();
        Some(Texture { name: None, transform, pattern: pattern? })
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let mut out = FieldsOut::new(writer);
        self.pattern.write(&mut out);
        Placing { transform: self.transform.clone() }.write(&mut out);
        // Never a bare word, which would be a name where a texture is used.
        match out.into_kind(self.pattern.word()) {
            Out::Plain(word) => Out::Fields(vec![(word, Out::Fields(Vec::new()))]),
            out => out,
        }
    }
    fn schema() -> Json {
        json!({ "$ref": "#/$defs/texture" })
    }
}

/// The image file of a texture, which is read at once.
impl Value for ImageId {
    fn noun() -> String {
        "the name of an image file".to_owned()
    }
    fn stand_in() -> Self {
        ImageId(0)
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Scalar { text, .. } if !node.is_null() => super::images::load(text, node, cx),
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) | NodeKind::Mapping(_) => cx.expected::<Self>(node),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        let image = writer.scene.and_then(|scene| scene.images.get(self.0 as usize));
        Out::Text(image.map_or_else(|| format!("missing image {}", self.0), |image| image.file.clone()))
    }
    fn schema() -> Json {
        json!({ "type": "string" })
    }
}
