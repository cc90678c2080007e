//! The layers of a film file: the picture, and beside it what is known of each pixel.

use durer_imaging::{BEAUTY, Channel, ExrSamples, Layer, Layers, Samples};
use durer_math::Rgb;
use durer_render::{Film, Region, SeenFirst, Sums};
use durer_scene::Integrator;

/// A layer that a film file can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FilmLayer {
    /// The picture: R, G, B.
    Beauty,
    /// The color of what is seen first: R, G, B.
    Albedo,
    /// Its normal in world space, from -1 to 1: X, Y, Z.
    Normal,
    /// How far away it is along the view, in world units: Z.
    Depth,
    /// Where it is in world space: X, Y, Z.
    Position,
    /// Its texture coordinates: U, V.
    Uv,
    /// The number of its shape, from 1: ID.
    ObjectId,
    /// The number of its material, from 1: ID.
    MaterialId,
    /// Of light that paths found, what came by one surface at most: R, G, B.
    Direct,
    /// ... and the rest, which came by more: R, G, B.
    Indirect,
    /// The variance that is left in the luminance of each pixel, as far as its samples tell: V.
    Variance,
    /// How many samples each pixel has: N.
    Samples,
}

impl FilmLayer {
    /// All of them, in the order in which files have them.
    pub const ALL: [FilmLayer; 12] = [
        FilmLayer::Beauty,
        FilmLayer::Albedo,
        FilmLayer::Normal,
        FilmLayer::Depth,
        FilmLayer::Position,
        FilmLayer::Uv,
        FilmLayer::ObjectId,
        FilmLayer::MaterialId,
        FilmLayer::Direct,
        FilmLayer::Indirect,
        FilmLayer::Variance,
        FilmLayer::Samples,
    ];

    /// What files call it.
    pub fn name(self) -> &'static str {
        match self {
            FilmLayer::Beauty => BEAUTY,
            FilmLayer::Albedo => "albedo",
            FilmLayer::Normal => "normal",
            FilmLayer::Depth => "depth",
            FilmLayer::Position => "position",
            FilmLayer::Uv => "uv",
            FilmLayer::ObjectId => "object_id",
            FilmLayer::MaterialId => "material_id",
            FilmLayer::Direct => "direct",
            FilmLayer::Indirect => "indirect",
            FilmLayer::Variance => "variance",
            FilmLayer::Samples => "samples",
        }
    }

    /// That of this name.
    pub fn named(name: &str) -> Option<FilmLayer> {
        FilmLayer::ALL.into_iter().find(|layer| layer.name() == name)
    }

    /// True if pictures by this integrator have it.
    pub fn is_of(self, integrator: &Integrator) -> bool {
        match self.source() {
            Source::Picture | Source::SeenFirst => true,
            Source::Paths => matches!(integrator, Integrator::Path { .. }),
            Source::Sums => integrator.takes_samples(),
        }
    }

    /// True if it is made of what the eye's rays meet first.
    pub fn is_seen_first(self) -> bool {
        self.source() == Source::SeenFirst
    }

    /// True if it is made of what the film knows apart of direct light.
    pub fn is_of_paths(self) -> bool {
        self.source() == Source::Paths
    }

    /// What it is made of.
    fn source(self) -> Source {
        match self {
            FilmLayer::Beauty => Source::Picture,
            FilmLayer::Albedo
            | FilmLayer::Normal
            | FilmLayer::Depth
            | FilmLayer::Position
            | FilmLayer::Uv
            | FilmLayer::ObjectId
            | FilmLayer::MaterialId => Source::SeenFirst,
            FilmLayer::Direct | FilmLayer::Indirect => Source::Paths,
            FilmLayer::Variance | FilmLayer::Samples => Source::Sums,
        }
    }

    /// The most bytes that it takes in a file for each pixel, if nothing can be compressed; colors are in this precision.
    fn bytes(self, colors: ExrSamples) -> u64 {
        match self {
            // With alpha.
            FilmLayer::Beauty => match colors {
                ExrSamples::Half => 8,
                ExrSamples::Float => 16,
            },
            FilmLayer::Albedo | FilmLayer::Direct | FilmLayer::Indirect => match colors {
                ExrSamples::Half => 6,
                ExrSamples::Float => 12,
            },
            FilmLayer::Normal => 6,
            FilmLayer::Position => 12,
            FilmLayer::Uv => 8,
            FilmLayer::Depth
            | FilmLayer::ObjectId
            | FilmLayer::MaterialId
            | FilmLayer::Variance
            | FilmLayer::Samples => 4,
        }
    }

    /// The most bytes that the file of these layers of a picture takes.
    pub fn most_bytes(layers: &[FilmLayer], colors: ExrSamples, width: u32, height: u32) -> u64 {
        let for_each_pixel: u64 = layers.iter().map(|layer| layer.bytes(colors)).sum();
        let raw = for_each_pixel * u64::from(width) * u64::from(height);
        raw + raw / 64 + 16 * u64::from(height) + 16_384
    }
}

/// What layers are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    /// The pixels.
    Picture,
    /// What the eye's rays meet first.
    SeenFirst,
    /// What the film keeps apart of direct light.
    Paths,
    /// What the film knows of its samples.
    Sums,
}

/// The layers of a film, those that there are: integrators other than path tracing know no direct and indirect light, and
/// those that take no samples know nothing of them.
///
/// Light and albedo are in the precision for colors, ids and counts are whole numbers; depth, places, coordinates and variance
/// are in single precision, normals in half. The beauty gets an alpha if there is one, a number for each pixel (see
/// [`coverage`](crate::coverage)).
pub fn film_layers(
    (film, alpha): (&Film, Option<&[f32]>),
    seen: Option<&SeenFirst>,
    layers: &[FilmLayer],
    colors: ExrSamples,
) -> Layers {
    let Region { width, height, .. } = film.region();
    let seen = seen.filter(|seen| seen.region == film.region());
    let direct = film.sums().and_then(direct_light);
    let layer = |layer: &FilmLayer| match layer.source() {
        Source::Picture => {
            let mut beauty = Layer::of_colors(layer.name(), film.pixels(), colors);
            let alpha = alpha.map(|alpha| Samples::of(alpha.iter().copied(), colors));
            beauty.channels.extend(alpha.map(|samples| Channel { name: "A".to_owned(), samples }));
            Some(beauty)
        }
        Source::SeenFirst => of_seen(*layer, seen?, colors),
        Source::Paths => of_paths(*layer, film.pixels(), direct.as_ref()?, colors),
        Source::Sums => of_sums(*layer, film.sums()?),
    };
    Layers { width, height, layers: layers.iter().filter_map(layer).collect() }
}

/// Of each pixel, if the film keeps it.
fn direct_light(sums: &Sums) -> Option<Vec<Rgb>> {
    (0..sums.taken.len()).map(|pixel| sums.direct_mean(pixel)).collect()
}

fn of_seen(layer: FilmLayer, seen: &SeenFirst, colors: ExrSamples) -> Option<Layer> {
    let name = layer.name();
    let vector = |vectors: &[[f32; 3]], precision| {
        let component = |index: usize| Samples::of(vectors.iter().map(|vector| vector[index]), precision);
        Layer::new(name, [("X", component(0)), ("Y", component(1)), ("Z", component(2))])
    };
    match layer {
        FilmLayer::Albedo => Some(Layer::of_colors(name, &seen.albedo, colors)),
        FilmLayer::Normal => Some(vector(&seen.normal, ExrSamples::Half)),
        FilmLayer::Depth => Some(Layer::new(name, [("Z", Samples::Float(seen.depth.clone()))])),
        FilmLayer::Position => Some(vector(&seen.position, ExrSamples::Float)),
        FilmLayer::Uv => {
            let component = |index: usize| Samples::Float(seen.uv.iter().map(|uv| uv[index]).collect());
            Some(Layer::new(name, [("U", component(0)), ("V", component(1))]))
        }
        FilmLayer::ObjectId => Some(Layer::new(name, [("ID", Samples::Whole(seen.object_id.clone()))])),
        FilmLayer::MaterialId => Some(Layer::new(name, [("ID", Samples::Whole(seen.material_id.clone()))])),
        FilmLayer::Beauty | FilmLayer::Direct | FilmLayer::Indirect | FilmLayer::Variance | FilmLayer::Samples => None,
    }
}

fn of_paths(layer: FilmLayer, all: &[Rgb], direct: &[Rgb], colors: ExrSamples) -> Option<Layer> {
    if layer == FilmLayer::Direct {
        return Some(Layer::of_colors(layer.name(), direct, colors));
    }
    let indirect: Vec<Rgb> = all.iter().zip(direct).map(|(&all, &direct)| all - direct).collect();
    Some(Layer::of_colors(layer.name(), &indirect, colors))
}

fn of_sums(layer: FilmLayer, sums: &Sums) -> Option<Layer> {
    if layer == FilmLayer::Samples {
        return Some(Layer::new(layer.name(), [("N", Samples::Whole(sums.taken.clone()))]));
    }
    let variances = (0..sums.taken.len()).map(|pixel| sums.variance(pixel) as f32);
    Some(Layer::new(layer.name(), [("V", Samples::Float(variances.collect()))]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_imaging::{EncodeOptions, FileFormat, encode_layers};

    #[test]
    fn layers_are_found_by_their_names() {
        for layer in FilmLayer::ALL {
            assert_eq!(FilmLayer::named(layer.name()), Some(layer));
        }
        assert_eq!(FilmLayer::named("beauties"), None);
    }

    #[test]
    fn what_is_seen_first_fills_the_layers() {
        let text = "
            picture: {width: 40, height: 30}
            camera: {position: [0, 0, 5], look_at: [0, 0, 0]}
            materials: {red: {color: [0.5, 0.25, 0.125]}}
            objects:
              - sphere: {center: [9, 9, 9], radius: 0.1}
              - box: {min: [-1, -1, -1], max: [1, 1, 0], material: red}";
        let loaded = crate::load_str(text, "test", &crate::NoAssets, &crate::Limits::default()).unwrap();
        let scene = crate::compile(&loaded.scene);
        let options = crate::RenderOptions::default();
        let film = crate::render(&scene, &options, &()).unwrap();
        let seen = crate::seen_first(&scene, &options, &()).unwrap();
        let layers = film_layers((&film, None), Some(&seen), &FilmLayer::ALL, ExrSamples::Float);
        assert_eq!(layers.layers.len(), 8, "there are no samples");
        let (middle, corner) = (15 * 40 + 20, 0);
        let at = |layer: FilmLayer, channel: &str, pixel: usize| {
            layers.get(layer.name()).and_then(|layer| layer.channel(channel)).map(|samples| samples.get(pixel))
        };
        let known = [
            (FilmLayer::Albedo, "R", 0.5, 0.0),
            (FilmLayer::Albedo, "B", 0.125, 0.0),
            (FilmLayer::Normal, "X", 0.0, 0.0),
            (FilmLayer::Normal, "Z", 1.0, 0.0),
            (FilmLayer::Depth, "Z", 5.0, f32::INFINITY),
            (FilmLayer::Position, "Z", 0.0, 0.0),
            (FilmLayer::ObjectId, "ID", 2.0, 0.0),
            (FilmLayer::MaterialId, "ID", 1.0, 0.0),
        ];
        for (layer, channel, inside, outside) in known {
            assert_eq!(at(layer, channel, middle), Some(inside), "{layer:?} {channel}");
            assert_eq!(at(layer, channel, corner), Some(outside), "{layer:?} {channel}");
        }
        assert_eq!((seen.coverage[middle], seen.coverage[corner]), (1.0, 0.0));
        let x = at(FilmLayer::Position, "X", middle).unwrap();
        assert!(x > 0.0 && x < 0.1 && at(FilmLayer::Uv, "U", middle).unwrap() > 0.5, "{x}");
        assert_eq!(at(FilmLayer::Beauty, "G", middle), Some(film.pixels()[middle].g));
        let share = seen.coverage.iter().filter(|&&part| part > 0.0 && part < 1.0).count();
        assert!(share > 20, "edges are partly covered: {share}");
        let without = film_layers((&film, None), None, &FilmLayer::ALL, ExrSamples::Half);
        assert_eq!(without.layers.len(), 1);
        let most = FilmLayer::most_bytes(&FilmLayer::ALL, ExrSamples::Float, 40, 30);
        let bytes = encode_layers(layers, &EncodeOptions::new(FileFormat::Exr)).unwrap().len() as u64;
        assert!(bytes <= most && most < 40 * 30 * 102 + 30_000, "{bytes} of {most}");
    }

    #[test]
    fn films_of_samples_have_more_layers() {
        let text = "
            picture: {width: 12, height: 8}
            render: {integrator: path, samples: 6}
            background: white
            objects: [plane, sphere: {center: [0, 1, 0]}]";
        let loaded = crate::load_str(text, "test", &crate::NoAssets, &crate::Limits::default()).unwrap();
        let scene = crate::compile(&loaded.scene);
        let options = crate::RenderOptions { direct: true, ..crate::RenderOptions::default() };
        let film = crate::render(&scene, &options, &()).unwrap();
        let wanted =
            [FilmLayer::Beauty, FilmLayer::Direct, FilmLayer::Indirect, FilmLayer::Variance, FilmLayer::Samples];
        let layers = film_layers((&film, None), None, &wanted, ExrSamples::Float);
        let at = |layer: FilmLayer, channel: &str, pixel: usize| {
            layers.get(layer.name()).and_then(|layer| layer.channel(channel)).map(|samples| samples.get(pixel)).unwrap()
        };
        let mut most_indirect: f32 = 0.0;
        for pixel in 0..96 {
            let [all, direct, indirect] =
                [FilmLayer::Beauty, FilmLayer::Direct, FilmLayer::Indirect].map(|layer| at(layer, "G", pixel));
            assert!((all - direct - indirect).abs() < 1e-6 && indirect > -1e-6, "{all} {direct} {indirect}");
            most_indirect = most_indirect.max(indirect);
            assert_eq!(at(FilmLayer::Samples, "N", pixel), 6.0);
            assert_eq!(at(FilmLayer::Variance, "V", pixel), film.sums().unwrap().variance(pixel) as f32);
        }
        assert!(most_indirect > 0.05, "the floor lights the ball: {most_indirect}");
    }

    /// Parts are parts of the whole, whatever the threads.
    #[test]
    fn a_part_is_a_part_of_the_whole() {
        let text = "{picture: {width: 70, height: 50}, objects: [sphere: {radius: 1}, torus: {}]}";
        let loaded = crate::load_str(text, "test", &crate::NoAssets, &crate::Limits::default()).unwrap();
        let scene = crate::compile(&loaded.scene);
        let seen = |region, threads| {
            let options = crate::RenderOptions { region, threads, ..crate::RenderOptions::default() };
            crate::seen_first(&scene, &options, &()).unwrap()
        };
        let whole = seen(None, Some(1));
        assert_eq!(whole, seen(None, Some(3)));
        let part = seen(Some(Region { x: 30, y: 10, width: 20, height: 30 }), None);
        for (index, (albedo, id)) in part.normal.iter().zip(&part.object_id).enumerate() {
            let at = (10 + index / 20) * 70 + 30 + index % 20;
            assert_eq!((albedo, id), (&whole.normal[at], &whole.object_id[at]));
        }
    }
}
