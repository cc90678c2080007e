//! Settings of the whole picture.

use super::decode::{Decoder, Fields};
use super::record::{
    Choice, FieldAbout, KindAbout, Record, choice, choice_value, encode_choice, fields, record, record_value,
};
use super::tree::{Node, NodeKind, shorten};
use super::value::{Value, number_text};
use super::write::{FieldsOut, Out, Writer};
use crate::diagnostics::Complaint;
use durer_imaging::{ToneMapping, Transfer};
use durer_math::Rgb;
use durer_scene::{
    Antialias, Background, Environment, Fog, ImageId, Integrator, PathSettings, Picture, PixelFilter, Place,
    RenderSettings, Step, Trees,
};
use serde_json::{Value as Json, json};
use std::rc::Rc;

record!(Picture {
    width: u32 = Picture::default().width => "Width in pixels.";
    height: u32 = Picture::default().height => "Height in pixels.";
    transfer: Transfer = Transfer::Srgb => "How linear light becomes the numbers of a file.";
    exposure: f32 = 0.0 => "Makes 8- and 16-bit files brighter by a factor of 2 for each 1; stops, as photographers count.";
    tone_mapping: ToneMapping = ToneMapping::None => "How light above 1 is brought into what 8- and 16-bit files can hold.";
});
record_value!(Picture, "picture", Picture::default());

choice! { Transfer, "transfer";
    Srgb "srgb": "Encoded for screens.", example "transfer: srgb", {}
    Linear "linear": "The numbers as they are.", example "transfer: linear", {}
}
choice_value!(Transfer, Transfer::Srgb);

choice! { ToneMapping, "tone mapping";
    None "none": "What is above 1 is white.", example "tone_mapping: none", {}
    Reinhard "reinhard": "That of Reinhard and others: soft, and less contrast.", example "tone_mapping: reinhard", {}
    Aces "aces": "As the film industry has it: much contrast, and bright colors turn white.", example "tone_mapping: aces", {}
    Agx "agx": "Like photographic film: bright colors fade into white.", example "tone_mapping: agx", {}
    PbrNeutral "pbr_neutral": "Leaves colors as they are, save the brightest.", example "tone_mapping: pbr_neutral", {}
}
choice_value!(ToneMapping, ToneMapping::None);

record!(RenderSettings {
    integrator: Integrator = Integrator::Whitted => "What is computed.";
    samples: Option<u32> = None => "Samples a pixel where light is sampled at random, 1 to 1e6; 64 if it is left out. With a `noise` or `time` it is the most of a pixel, 4096 if it is left out.";
    noise: Option<f32> = None => "Where light is sampled at random: samples are taken until the noise is below this everywhere: the standard error of a pixel over the root of its brightness, so that 0.02 is one in fifty in the white of a screen; 0.0001 to 1.";
    time: Option<f64> = None => "Begins no samples after this many seconds.";
    seed: u32 = 0 => "Where light is sampled at random: another number gives other noise.";
    light_samples: u32 = 16 => "`whitted`: shadow rays to each light that has an area, up to 4096; with 0, what glows lights nothing.";
    max_depth: u32 = RenderSettings::default().max_depth
        => "`whitted`: longest chain of rays: the eye's ray has depth 1, and rays deeper than this are black; 1 to 100.";
    min_weight: f32 = 0.001 => "`whitted`: rays that count less than this in the pixel are not traced; 0 traces all.";
    antialias: Antialias = Antialias::default() => "Where in a pixel rays are sent, and how many.";
    filter: PixelFilter = PixelFilter::Box => "How samples are weighed by their distance from a pixel's middle.";
    trees: Trees = Trees::Picture => "What the trees in which rays search are built for; the picture is the same.";
});
record_value!(RenderSettings, "render", RenderSettings::default());

/// Where files say what may be said elsewhere, too: all fields of `picture`, of `render` and of the path tracer.
pub(super) fn places() -> impl Iterator<Item = Place> {
    let fields_of = |way: &'static [&'static str], about: Vec<FieldAbout>| {
        let keys = about.into_iter().map(|field| field.key);
        keys.map(|key| Place { steps: way.iter().copied().chain([key]).map(Step::Field).collect() })
    };
    fields_of(&["picture"], Picture::about())
        .chain(fields_of(&["render"], RenderSettings::about()))
        .chain(fields_of(&["render", "integrator", "path"], PathSettings::about()))
}

/// What a file that names its integrator says for another than the one that renders, which may be `chosen_by` an overlay. (A
/// file that names none may be meant for several, which the command line chooses from.)
pub(super) fn warn_of_unused(
    root: &Node,
    integrator: &Integrator,
    chosen_by: Option<&str>,
    complaints: &mut Vec<Complaint>,
) {
    let Some((_, render)) = root.get("render") else { return };
    let Some((_, written)) = render.get("integrator") else { return };
    let word = integrator.word();
    // In place of one that cannot be read stands another, of which nobody has spoken.
    if chosen_by.is_none() && written.first_word() != Some(word) {
        return;
    }
    let whose = chosen_by.map_or("the integrator of this file".to_owned(), |name| format!("the choice of {name}"));
    let unused: &[(&str, &str)] = match integrator {
        Integrator::Path { .. } => &[
            ("max_depth", "`path` has a `max_depth` of its own: `integrator: {path: {max_depth: 16}}`"),
            ("min_weight", "`path` ends paths by chance, and loses no light"),
            ("light_samples", "`path` sends one shadow ray from each surface: more `samples` make shadows smoother"),
            ("antialias", "`path` spreads its `samples` over each pixel"),
        ],
        Integrator::AmbientOcclusion { .. } => &[
            ("max_depth", ""),
            ("min_weight", ""),
            ("light_samples", ""),
            ("antialias", "`samples` are spread over each pixel"),
        ],
        Integrator::Whitted => {
            let help = "for light at random say `integrator: path`";
            &[("samples", help), ("noise", help), ("time", help)]
        }
        Integrator::Uv => &[
            ("max_depth", ""),
            ("min_weight", ""),
            ("light_samples", ""),
            ("samples", ""),
            ("noise", ""),
            ("time", ""),
            ("antialias", "it shows the middle of each pixel"),
            ("filter", "it shows the middle of each pixel"),
        ],
        Integrator::Normals | Integrator::Depth => &[
            ("max_depth", ""),
            ("min_weight", ""),
            ("light_samples", ""),
            ("samples", "see `antialias`"),
            ("noise", ""),
            ("time", ""),
        ],
    };
    for (field, help) in unused {
        if let Some((key, _)) = render.get(field) {
            let complaint = Complaint::warning(key.span, format!("`{field}` means nothing to `{word}`, {whose}"));
            complaints.push(if help.is_empty() { complaint } else { complaint.help(*help) });
        }
    }
}

record!(PathSettings {
    max_depth: u32 = 16 => "The most surfaces that light may meet on its way from a light to the eye, 1 to 1e6.";
    clamp: Option<f32> = None => "Samples brighter than this are lowered to it: it takes away fireflies, and some light.";
    split: u32 = 1 => "So many paths go on from the first surface of each sample that spreads light, 1 to 64: a sample takes longer, and where most light comes by way of other things it has less noise for the time. With `reuse` all but the first only look for what cannot be shared.";
    reuse: u32 = 1 => "So many neighboring pixels use each path: 1, or 4, 16 or 64, those of a block. Where most light comes by way of other things it takes far less time to the same noise, and what is left of that is alike in the pixels of a block.";
});

choice! { Integrator, "integrator";
    Whitted "whitted": "Classic ray tracing: mirrors, glass and shadows, without noise.", example "integrator: whitted", {}
    Path "path": "All the light that there is, by path tracing.", example "integrator: {path: {max_depth: 32}}",
    (PathSettings)
    AmbientOcclusion "ambient_occlusion": "How much of the sky each point sees.",
    example "integrator: {ambient_occlusion: {distance: 2}}",
    {
        distance: Option<f64> = None => "What is further away hides nothing.";
    }
    Normals "normals": "The normals of what is seen, as colors.", example "integrator: normals", {}
    Depth "depth": "How far away it is.", example "integrator: depth", {}
    Uv "uv": "Its texture coordinates in the middle of each pixel, as red and green; `antialias` and `filter` do not matter.", example "integrator: uv", {}
}
choice_value!(Integrator, Integrator::Whitted);

choice! { Trees, "trees";
    Preview "preview": "A first look: built in the least time.", example "trees: preview", {}
    Picture "picture": "A picture with some rays a pixel.", example "trees: picture", {}
    ManyRays "many_rays": "Very many rays: built for the fastest search.", example "trees: many_rays", {}
}
choice_value!(Trees, Trees::Picture);

choice! { PixelFilter, "filter";
    Box "box": "A pixel is the mean of its area.", example "filter: box", {}
    Tent "tent": "Falls evenly to 0.", example "filter: tent",
    {
        radius: f64 = 1.0 => "Where it is 0, in pixels from the middle; 0.5 to 8.";
    }
    Gaussian "gaussian": "A bell, lowered so that it ends at 0: soft.", example "filter: {gaussian: {radius: 1.5, sigma: 0.5}}",
    {
        radius: f64 = 1.5 => "Where it is 0, in pixels from the middle; 0.5 to 8.";
        sigma: f64 = 0.5 => "Its standard deviation, in pixels; 0.1 to 8.";
    }
    Mitchell "mitchell": "That of Mitchell and Netravali, with B = C = 1/3: crisp.", example "filter: mitchell",
    {
        radius: f64 = 2.0 => "Where it is 0, in pixels from the middle; 0.5 to 8.";
    }
    BlackmanHarris "blackman_harris": "The window of Blackman and Harris: soft, without a trace of rings.",
    example "filter: {blackman_harris: {radius: 1.5}}",
    {
        radius: f64 = 1.5 => "Where it is 0, in pixels from the middle; 0.5 to 8.";
    }
}
choice_value!(PixelFilter, PixelFilter::Box);

choice! { Antialias, "antialias";
    Adaptive "adaptive": "Looks closer where something is to be seen: along edges, and where small things are.",
    example "antialias: {adaptive: {threshold: 0.02}}",
    {
        threshold: f32 = 0.03 => "Largest difference that is let pass: of red, green or blue, as on a screen, 0 to 1.";
        max_depth: u32 = 4 => "How often a pixel may be divided into quarters, 0 to 7.";
    }
    None "none": "One ray through the middle of each pixel.", example "antialias: none", {}
    Grid "grid": "n × n rays through the middles of a grid of cells; `{grid: 3}` for short.", example "antialias: {grid: 3}",
    {
        n: u32 = 3 => "Cells along each side, 1 to 64.";
    }
    Recursive "recursive": "2 × 2 rays; where they differ, each quarter is treated in the same way again.",
    example "antialias: {recursive: {threshold: 0.1, max_depth: 3}}",
    {
        threshold: f32 = 0.3 => "Largest difference that is let pass, summed over red, green and blue.";
        max_depth: u32 = 5 => "How often a pixel may be divided again, 0 to 10.";
    }
    Pov1 "pov1": "As POV-Ray's method 1: where a pixel differs from a neighbor, a grid of rays.",
    example "antialias: {pov1: {threshold: 0.3, depth: 3}}",
    {
        threshold: f32 = 0.3 => "Smallest difference that counts, summed over red, green and blue with a gamma of 2.5.";
        depth: u32 = 3 => "Cells along each side of the grid, 1 to 9.";
    }
    Pov2 "pov2": "As POV-Ray's method 2: where the corners of a pixel differ, its quarters in the same way.",
    example "antialias: {pov2: {threshold: 0.3, depth: 3}}",
    {
        threshold: f32 = 0.3 => "Smallest difference that counts, summed over red, green and blue with a gamma of 2.5.";
        depth: u32 = 3 => "A pixel has at most (2^(depth - 1) + 1)² rays; 1 to 9.";
    }
}

/// A choice like others, but for the short `grid: 3`.
impl Value for Antialias {
    fn noun() -> String {
        "`adaptive`, `none`, `grid: 3`, `recursive`, `pov1` or `pov2`".to_owned()
    }
    fn stand_in() -> Self {
        Antialias::None
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        if let (Some((_, n)), NodeKind::Mapping(entries)) = (node.get("grid"), &node.kind)
            && entries.len() == 1
            && (number_text(n).is_some() || matches!(n.kind, NodeKind::Scalar { .. }) && !n.is_null())
        {
            return u32::decode(n, cx).map(|n| Antialias::Grid { n });
        }
        if number_text(node).is_some() || matches!(node.text(), Some("true" | "false")) {
            return cx.expected_noun(node, &Self::noun(), Some("for example `antialias: {grid: 3}`".to_owned()));
        }
        if let Some(advice) = node.text().and_then(from_command_line) {
            return cx.expected_noun(node, &Self::noun(), Some(advice));
        }
        super::record::decode_choice(node, cx)
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match self {
            Antialias::Grid { n } => Out::Fields(vec![("grid".to_owned(), n.encode(writer))]),
            Antialias::Adaptive { .. }
            | Antialias::None
            | Antialias::Recursive { .. }
            | Antialias::Pov1 { .. }
            | Antialias::Pov2 { .. } => encode_choice(self, writer),
        }
    }
    fn schema() -> Json {
        let mut schema = super::schema::choice(&Antialias::kinds());
        let kinds = schema.get_mut("anyOf").and_then(Json::as_array_mut).into_iter().flatten();
        for grid in kinds.filter_map(|kind| kind.pointer_mut("/properties/grid")) {
            *grid = json!({ "description": grid["description"], "anyOf": [{ "type": "integer", "minimum": 1, "maximum": 64 }, grid.clone()] });
        }
        schema
    }
}

/// What to write for `grid:4` and `recursive:0.1`, the command line's way of saying it.
fn from_command_line(text: &str) -> Option<String> {
    let (word, value) = text.split_once(':')?;
    let (value, depth) = value.split_once(',').map_or((value, None), |(value, depth)| (value, Some(depth)));
    let number: f64 = value.trim().parse().ok()?;
    match word {
        "recursive" if depth.is_some() => {
            let depth: u32 = depth?.trim().parse().ok()?;
            Some(format!("write `antialias: {{recursive: {{threshold: {number}, max_depth: {depth}}}}}`"))
        }
        "grid" => Some(format!("write `antialias: {{grid: {number}}}`")),
        "recursive" => Some(format!("write `antialias: {{recursive: {{threshold: {number}}}}}`")),
        _ => None,
    }
}

/// `{bottom: …, top: …}`
struct Sky {
    bottom: Rgb,
    top: Rgb,
}

record!(Sky {
    bottom: Rgb => "Seen straight down.";
    top: Rgb => "Seen straight up.";
});

record!(Environment {
    image: ImageId => "A picture of all directions in latitude and longitude: its file, EXR, HDR, PFM, PNG or JPEG.";
    rotation_degrees as "rotation": f64 = 0.0
        => "Turns it about the y axis, in degrees, counterclockwise from above. At 0 its middle is toward +x, at 90 toward -z.";
    strength: f32 = 1.0 => "Multiplies its light.";
});

impl Value for Background {
    fn noun() -> String {
        "a color, {bottom: color, top: color}, or {image: file}".to_owned()
    }
    fn stand_in() -> Self {
        Background::default()
    }
    fn decode(node: &Rc<Node>, cx: &mut Decoder<'_>) -> Option<Self> {
        match &node.kind {
            NodeKind::Mapping(_) if ["image", "rotation", "strength"].iter().any(|key| node.get(key).is_some()) => {
                if node.get("image").is_none() {
                    let complaint = Complaint::error(node.span, "`background` needs `image`");
                    return cx.complain(complaint.help("for example `background: {image: sky.hdr, rotation: 90}`"));
                }
                super::record::decode_record("background", node, cx).map(Background::Image)
            }
            NodeKind::Mapping(_) => super::record::decode_record("background", node, cx)
                .map(|Sky { bottom, top }| Background::Gradient { bottom, top }),
            NodeKind::Scalar { .. } if node.is_null() => cx.expected::<Self>(node),
            NodeKind::Scalar { text, .. } if super::paint::image_file(text).is_some() => {
                cx.expected_noun(node, &Self::noun(), Some(format!("write `background: {{image: {}}}`", shorten(text))))
            }
            NodeKind::Scalar { .. } | NodeKind::Sequence(_) => Rgb::decode(node, cx).map(Background::Color),
        }
    }
    fn encode(&self, writer: &Writer<'_>) -> Out {
        match *self {
            Background::Color(color) => color.encode(writer),
            Background::Gradient { bottom, top } => super::record::encode_record(&Sky { bottom, top }, writer),
            Background::Image(map) => super::record::encode_record(&map, writer),
        }
    }
    fn schema() -> Json {
        let [sky, map] = [Sky::about(), Environment::about()].map(|about| super::schema::record(&about));
        json!({ "anyOf": [Rgb::schema(), sky, map] })
    }
}

choice! { Fog, "fog";
    Exponential "exponential": "Thickens evenly, as real fog does.",
    example "fog: {exponential: {color: lightgray, distance: 50}}",
    {
        color: Rgb => "Its color.";
        distance: f64 => "The length at which 1/e (37 %) of the light is left.";
    }
    Linear "linear": "Clear up to one distance, nothing but fog from another on.",
    example "fog: {linear: {color: lightgray, start: 10, end: 80}}",
    {
        color: Rgb => "Its color.";
        start: f64 => "Up to here the view is clear.";
        end: f64 => "From here on there is only fog.";
    }
}
choice_value!(Fog, Fog::Exponential { color: Rgb::BLACK, distance: 1.0 });
