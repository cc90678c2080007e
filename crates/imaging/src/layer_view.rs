//! A layer as a picture for people to look at: light as it is, directions and places as colors, numbers that name things in
//! false colors.

use crate::false_color::magma;
use crate::{Image, Layers, Samples, linear_from_srgb};
use durer_math::Rgb;

/// A layer as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerView {
    /// The picture.
    pub image: Image,
    /// How much of each pixel is there, if the layer says so; the colors are multiplied by it.
    pub alpha: Option<Vec<f32>>,
    /// What its numbers mean.
    pub meaning: Meaning,
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Light, to be exposed, tone-mapped and put through a transfer curve.
    Light,
    /// Other numbers from 0 to 1, to be stored as they are.
    Numbers,
    /// Colors chosen for screens: to be put through the curve of sRGB and nothing else.
    FalseColor,
}

impl Layers {
    /// The layer of this name as a picture:
    ///
    /// * colors, channels R, G and B, are light;
    /// * a normal, X, Y and Z from -1 to 1, comes from 0 to 1; 0, for no normal, is black;
    /// * other vectors, X, Y and Z, lie between their least and their greatest numbers, each for itself;
    /// * coordinates on surfaces, U and V, are red and green; of those outside of 0 to 1 the whole parts are left out;
    /// * depth, Z alone, is white for the least and almost black for the greatest, black where nothing is; what is much farther
    ///   away than half of the picture, as ends of infinite planes are, is darker still and takes no range from the rest;
    /// * whole numbers that name things have a false color each, black for 0, which names nothing;
    /// * other numbers, as counts, are in false colors from 0, black, to the greatest, pale yellow.
    ///
    /// `None` if there is no such layer, or none of these channels in it.
    pub fn view(&self, name: &str) -> Option<LayerView> {
        let layer = self.get(name)?;
        let picture = |meaning, pixels| {
            let image = Image { width: self.width, height: self.height, pixels };
            Some(LayerView { image, alpha: None, meaning })
        };
        if let Some(colors) = layer.all_of(["R", "G", "B"]) {
            let alpha = layer.channel("A").map(|alpha| numbers(alpha).collect());
            return picture(Meaning::Light, triples(colors)).map(|view| LayerView { alpha, ..view });
        }
        if let Some(vector) = layer.all_of(["X", "Y", "Z"]) {
            let is_normal = name.rsplit('.').next().is_some_and(|last| last.eq_ignore_ascii_case("normal"));
            return picture(Meaning::Numbers, if is_normal { normals(vector) } else { between_bounds(vector) });
        }
        if let Some([u, v]) = layer.all_of(["U", "V"]) {
            let part = |x: f32| if (0.0..=1.0).contains(&x) { x } else { x - x.floor() };
            let pixels = numbers(u).zip(numbers(v)).map(|(u, v)| Rgb::new(part(u), part(v), 0.0));
            return picture(Meaning::Numbers, pixels.collect());
        }
        if let Some(depth) = layer.channel("Z") {
            return picture(Meaning::Numbers, depths(depth));
        }
        let only = &layer.channels.first()?.samples;
        let pixels = match (only, layer.channel("ID")) {
            (_, Some(Samples::Whole(names))) => names.iter().map(|&name| named(name)).collect(),
            (_, Some(names)) => numbers(names).map(|name| named(name as u32)).collect(),
            (only, None) => amounts(only),
        };
        picture(Meaning::FalseColor, pixels)
    }
}

fn numbers(samples: &Samples) -> impl Iterator<Item = f32> + '_ {
    (0..samples.len()).map(|index| samples.get(index))
}

fn triples([a, b, c]: [&Samples; 3]) -> Vec<Rgb> {
    (0..a.len()).map(|index| Rgb::new(a.get(index), b.get(index), c.get(index))).collect()
}

fn normals(vector: [&Samples; 3]) -> Vec<Rgb> {
    let shown = |n: Rgb| if n.is_black() { n } else { (n + Rgb::WHITE) * 0.5 };
    triples(vector).into_iter().map(shown).collect()
}

/// The least and the greatest of the finite numbers.
fn bounds(samples: &Samples) -> (f32, f32) {
    let finite = numbers(samples).filter(|x| x.is_finite());
    finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)))
}

/// From 0 for the least to 1 for the greatest; halfway if they are the same.
fn share(x: f32, (least, most): (f32, f32)) -> f32 {
    // Twice the halves: the difference of two large numbers may not be finite.
    let length = most * 0.5 - least * 0.5;
    if length > 0.0 { ((x * 0.5 - least * 0.5) / length).clamp(0.0, 1.0) } else { 0.5 }
}

fn between_bounds(vector: [&Samples; 3]) -> Vec<Rgb> {
    let [x, y, z] = vector.map(bounds);
    let shown = |p: Rgb| match p.is_finite() {
        true => Rgb::new(share(p.r, x), share(p.g, y), share(p.b, z)),
        false => Rgb::BLACK,
    };
    triples(vector).into_iter().map(shown).collect()
}

fn depths(depth: &Samples) -> Vec<Rgb> {
    /// The end of the range is not yet as black as nothing, nor is what lies beyond.
    const FARTHEST: f32 = 0.05;
    let (least, far) = match bounds(depth) {
        (least, most) if least < most => (least, most.min(far(depth, least))),
        // All of it is nearest.
        (least, _) => (least, f32::MAX),
    };
    let shown = |z: f32| match z {
        z if !z.is_finite() => 0.0,
        z if z <= far => 1.0 - (1.0 - FARTHEST) * share(z, (least, far)),
        z => FARTHEST * (0.2 + 0.8 * ((far - least) / (z - least)).clamp(0.0, 1.0)),
    };
    numbers(depth).map(|z| Rgb::gray(shown(z))).collect()
}

/// How far the range of depths is to go: four times as far as the middle one of all is behind the nearest.
fn far(depth: &Samples, least: f32) -> f32 {
    let mut finite: Vec<f32> = numbers(depth).filter(|z| z.is_finite()).collect();
    let middle = finite.len() / 2;
    let (_, median, _) = finite.select_nth_unstable_by(middle, f32::total_cmp);
    let far = least + 4.0 * (*median - least);
    if far > least { far } else { f32::MAX }
}

fn amounts(samples: &Samples) -> Vec<Rgb> {
    let (_, most) = bounds(samples);
    numbers(samples).map(|x| magma(if most > 0.0 { x / most } else { 0.0 })).collect()
}

/// A color that tells the number apart from others. Hues follow each other by the golden section of a turn, so that those of
/// numbers that lie side by side differ most.
fn named(number: u32) -> Rgb {
    if number == 0 {
        return Rgb::BLACK;
    }
    let turn = number.wrapping_mul(0x9e37_79b9);
    // Three eighths of the numbers are paler or darker, by other bits.
    let (strength, brightness) = match (turn >> 3) & 7 {
        0 => (0.45, 1.0),
        1 => (0.75, 0.6),
        2 => (0.45, 0.75),
        _ => (0.75, 0.95),
    };
    let hue = turn as f32 / 4_294_967_296.0 * 6.0;
    let component = |at: f32| {
        // A color wheel of HSV: a component is all there for a third of the turn, and gone for another.
        let away = (hue - at).abs();
        let away = away.min(6.0 - away);
        brightness * (1.0 - strength * (away - 1.0).clamp(0.0, 1.0))
    };
    Rgb::new(component(0.0), component(2.0), component(4.0)).map(linear_from_srgb)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ExrSamples, Layer};

    fn one(name: &str, channels: &[(&str, Vec<f32>)]) -> LayerView {
        let channels = channels.iter().map(|(name, numbers)| crate::Channel {
            name: (*name).to_owned(),
            samples: Samples::of(numbers.iter().copied(), ExrSamples::Float),
        });
        let layer = Layer { name: name.to_owned(), channels: channels.collect() };
        let width = layer.channels[0].samples.len() as u32;
        Layers { width, height: 1, layers: vec![layer] }.view(name).unwrap()
    }

    fn assert_near(a: Rgb, b: [f32; 3]) {
        assert!((a - Rgb::from(b)).map(f32::abs).max_component() < 1e-6, "{a:?} is not {b:?}");
    }

    #[test]
    fn colors_are_light_with_their_alpha() {
        let color = |v: f32| vec![v, 2.0 * v];
        let view = one("x", &[("R", color(0.1)), ("B", color(9.0)), ("G", color(0.2)), ("A", color(0.5))]);
        assert_eq!((view.meaning, view.image.pixels[1]), (Meaning::Light, Rgb::new(0.2, 0.4, 18.0)));
        assert_eq!(view.alpha, Some(vec![0.5, 1.0]));
    }

    #[test]
    fn normals_come_from_0_to_1_and_none_is_black() {
        let view = one("room.Normal", &[("X", vec![-1.0, 0.0]), ("Y", vec![0.0, 0.0]), ("Z", vec![0.0, 0.0])]);
        assert_eq!(view.meaning, Meaning::Numbers);
        assert_eq!(view.image.pixels, [Rgb::new(0.0, 0.5, 0.5), Rgb::BLACK]);
    }

    #[test]
    fn places_lie_between_their_bounds() {
        let far = f32::INFINITY;
        let (x, y, z) = (vec![-3e38, 3e38, far, 0.0], vec![1.0, 3.0, far, 2.0], vec![5.0, 5.0, far, 5.0]);
        let view = one("position", &[("X", x), ("Y", y), ("Z", z)]);
        assert_near(view.image.pixels[0], [0.0, 0.0, 0.5]);
        assert_near(view.image.pixels[1], [1.0, 1.0, 0.5]);
        assert_eq!(view.image.pixels[2], Rgb::BLACK);
        assert_near(view.image.pixels[3], [0.5, 0.5, 0.5]);
    }

    #[test]
    fn near_is_white_far_is_dark_and_nothing_is_black() {
        let grays = |z: Vec<f32>| one("depth", &[("Z", z)]).image.pixels.iter().map(|p| p.g).collect::<Vec<_>>();
        let shown = grays(vec![2.0, 12.0, 7.0, f32::INFINITY]);
        assert!((shown[0] - 1.0).abs() < 1e-6 && (shown[1] - 0.05).abs() < 1e-6 && shown[3] == 0.0, "{shown:?}");
        assert!((shown[2] - 0.525).abs() < 1e-6);
        assert_eq!(grays(vec![4.0, 4.0]), [1.0, 1.0]);
        // A plane without end under what stands on it takes no range from that.
        let shown = grays(vec![2.0, 3.0, 4.0, 5.0, 1e3, 1e30, f32::INFINITY]);
        assert!(shown[0] - shown[3] > 0.2 && shown[4] < 0.05 && shown[5] > 0.0 && shown[5] < shown[4], "{shown:?}");
        assert!(shown.windows(2).all(|pair| pair[0] > pair[1]), "{shown:?}");
        assert_eq!(grays(vec![f32::INFINITY]), [0.0]);
    }

    #[test]
    fn coordinates_beyond_1_begin_anew() {
        let view = one("uv", &[("U", vec![0.25, 1.0, 3.5]), ("V", vec![0.0, 1.0, -0.25])]);
        assert_eq!(view.image.pixels, [[0.25, 0.0, 0.0], [1.0, 1.0, 0.0], [0.5, 0.75, 0.0]].map(Rgb::from));
    }

    #[test]
    fn numbers_that_name_things_have_colors_of_their_own() {
        let names: Vec<u32> = (0..300).collect();
        let layer = Layer::new("object_id", [("ID", Samples::Whole(names))]);
        let view = Layers { width: 300, height: 1, layers: vec![layer] }.view("object_id").unwrap();
        assert_eq!((view.meaning, view.image.pixels[0]), (Meaning::FalseColor, Rgb::BLACK));
        for (a, b) in (1..300).flat_map(|a| (1..a).map(move |b| (a, b))) {
            let [a, b] = [a, b].map(|i| view.image.pixels[i].map(crate::srgb_from_linear));
            assert!((a - b).map(f32::abs).max_component() > 1e-4);
            assert!(a.max_component() >= 0.59 && a.max_component() <= 1.0, "{a:?}");
        }
        for pair in view.image.pixels[1..].windows(2) {
            let apart = (pair[0] - pair[1]).map(f32::abs).max_component();
            assert!(apart > 0.2, "neighbors look alike: {pair:?}");
        }
    }

    #[test]
    fn counts_are_in_false_colors_up_to_the_greatest() {
        let view = one("samples", &[("N", vec![0.0, 32.0, 64.0])]);
        assert_eq!(view.meaning, Meaning::FalseColor);
        assert_eq!(view.image.pixels, [0.0, 0.5, 1.0].map(magma));
    }

    #[test]
    fn what_is_not_there_is_not_shown() {
        let layers = Layers { width: 1, height: 1, layers: vec![Layer { name: "empty".into(), channels: Vec::new() }] };
        assert_eq!((layers.view("depth"), layers.view("empty")), (None, None));
    }
}
