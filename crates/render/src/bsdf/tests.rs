//! Laws that every surface must keep.

use super::chi_square::{Numbers, directions, sample_follows_pdf, sphere_integral};
use super::*;

/// A surface, and how far from 1 it may be what it gives back of white light; `None` if it takes some away.
struct Kind {
    name: String,
    bsdf: Bsdf,
    /// The same surface seen from behind, if light gets through.
    behind: Option<Bsdf>,
    lossless: Option<f64>,
    /// How radiance is scaled that is let through: 1/η².
    squeeze: f64,
}

impl Kind {
    fn new(name: &str, bsdf: Bsdf, lossless: Option<f64>) -> Kind {
        Kind { name: name.to_owned(), bsdf, behind: None, lossless, squeeze: 1.0 }
    }
}

fn roughnesses() -> [f64; 4] {
    [0.0, 0.25, 0.6, 1.0]
}

fn kinds() -> Vec<Kind> {
    let color = Rgb::new(0.9, 0.5, 0.1);
    let mut kinds = vec![
        Kind::new("white", Bsdf::Diffuse(Rgb::WHITE), Some(1e-6)),
        Kind::new("mirror", Bsdf::Mirror(Rgb::WHITE), Some(1e-6)),
        Kind::new("pane", Bsdf::Sheet(Sheet::new(1.5, Rgb::WHITE, None)), Some(1e-6)),
        Kind::new("pane in water", Bsdf::Sheet(Sheet::new(0.75, color, None)), None),
    ];
    for roughness in roughnesses() {
        let ggx = Ggx::of_roughness(roughness, 0.0);
        let mut add = |name: &str, bsdf, lossless| {
            kinds.push(Kind::new(&format!("{name} of roughness {roughness}"), bsdf, lossless));
        };
        add("white", Bsdf::OrenNayar(OrenNayar::new(Rgb::WHITE, roughness)), Some(2e-3));
        add("matte", Bsdf::OrenNayar(OrenNayar::new(color, roughness)), None);
        let white = Reflectance::Schlick { f0: Rgb::WHITE, f90: Rgb::WHITE };
        add("white metal", Bsdf::Conductor(Conductor::new(white, white.average(), ggx)), Some(1e-2));
        let gold = Reflectance::Complex { eta: Rgb::new(0.2, 0.4, 1.4), k: Rgb::new(3.5, 2.5, 1.8) };
        add("metal", Bsdf::Conductor(Conductor::new(gold, gold.average(), ggx)), None);
        let brushed = Ggx::of_roughness(roughness, 0.7);
        add("brushed metal", Bsdf::Conductor(Conductor::new(gold, gold.average(), brushed)), None);
        add("white plastic", Bsdf::Plastic(Plastic::new(1.5, Rgb::WHITE, ggx)), Some(1e-2));
        add("plastic", Bsdf::Plastic(Plastic::new(1.8, color, ggx)), None);
        let layers = Layers {
            base_color: Rgb::WHITE,
            metallic: 0.0,
            ggx,
            f0: Rgb::gray(0.04),
            f90: 1.0,
            through: None,
            sheen: None,
            coat: None,
        };
        let mut principled = |name: &str, layers, lossless| {
            add(name, Bsdf::Principled(Principled::new(layers)), lossless);
        };
        principled("white principled", layers, Some(1e-2));
        principled("white principled metal", Layers { metallic: 1.0, ..layers }, Some(1e-2));
        let colored = Layers { base_color: color, metallic: 0.3, f0: Rgb::new(0.04, 0.03, 0.06), ..layers };
        principled("principled", colored, None);
        let sheen = Some(Sheen::new(Rgb::new(1.0, 0.8, 0.5), roughness));
        principled("cloth", Layers { sheen, ..layers }, None);
        principled("fuzzy cloth", Layers { sheen: Some(Sheen::new(Rgb::WHITE, 0.0)), ..colored }, None);
        for ggx in [None, Ggx::of_roughness(0.4, 0.0)] {
            let coat = Some(Coat { strength: 0.9, ggx });
            principled("coated", Layers { coat, ..layers }, None);
            principled("coated cloth", Layers { coat, sheen, ..colored }, None);
        }
        let thin = Some((1.0, principled::Through::Thin(Sheet::new(1.5, Rgb::WHITE, ggx))));
        principled("principled pane", Layers { through: thin, ..layers }, Some(1e-2));
        let half = Some((0.5, principled::Through::Thin(Sheet::new(1.5, color, ggx))));
        principled("principled half pane", Layers { through: half, sheen, ..colored }, None);
        let bent = |eta| Some((0.7, principled::Through::Bent(Dielectric::new(eta, Rgb::WHITE, ggx))));
        principled("principled half glass", Layers { through: bent(1.5), ..layers }, Some(1.5e-2));
        principled("from within principled half glass", Layers { through: bent(1.0 / 1.5), ..layers }, Some(1.5e-2));
        add("rough pane", Bsdf::Sheet(Sheet::new(1.5, Rgb::WHITE, ggx)), Some(1e-2));
        for eta in [1.3, 2.4] {
            for eta in [eta, 1.0 / eta] {
                let glass = |eta| Bsdf::Dielectric(Dielectric::new(eta, Rgb::WHITE, ggx));
                let mut kind = Kind::new(&format!("glass {eta:.3} of roughness {roughness}"), glass(eta), Some(1.5e-2));
                (kind.behind, kind.squeeze) = (Some(glass(1.0 / eta)), 1.0 / (eta * eta));
                kinds.push(kind);
            }
        }
    }
    let parts = Parts {
        diffuse: color,
        specular: Rgb::gray(0.5),
        shininess: 30.0,
        reflection: Rgb::gray(0.2),
        transparency: Rgb::BLACK,
    };
    let clear = Parts { transparency: Rgb::new(0.3, 0.6, 0.9), ..parts };
    let glossy = Parts { specular: Rgb::WHITE, diffuse: Rgb::BLACK, shininess: 2000.0, ..clear };
    let glass = Dielectric::new(1.5, Rgb::WHITE, None);
    for (name, parts, through) in [
        ("classic", parts, Through::Straight),
        ("clear classic", clear, Through::Straight),
        ("classic sheet", clear, Through::Sheet(Sheet::new(1.5, Rgb::WHITE, None))),
        ("classic glass", clear, Through::Bent(glass)),
        ("classic glass without reflection", clear, Through::Bent(Dielectric::without_reflection(1.3, Rgb::WHITE))),
        ("glossy classic", glossy, Through::Straight),
    ] {
        kinds.push(Kind::new(name, Bsdf::Classic(Classic::new(parts, through)), None));
    }
    kinds
}

/// Evenly spread numbers for sampling, the same each time.
fn places(count: u32) -> impl Iterator<Item = (f64, DVec2)> {
    let step = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_7];
    (0..count).map(move |i| {
        let at = step.map(|step| (0.5 + f64::from(i) * step).fract());
        (at[0], DVec2::new(at[1], at[2]))
    })
}

/// The scattering function times cosine, over all directions, by sampling: what is given back under a white sky. What is let
/// through counts without being squeezed.
fn given_back(bsdf: &Bsdf, out: DVec3) -> Rgb {
    const COUNT: u32 = 6000;
    let weight = |(lobe, at): (f64, DVec2)| {
        bsdf.sample(out, lobe, at).map_or(Rgb::BLACK, |scattered| scattered.weight * (1.0 / scattered.scale))
    };
    places(COUNT).map(weight).fold(Rgb::BLACK, |sum, weight| sum + weight) * (1.0 / COUNT as f32)
}

#[test]
fn nothing_gives_back_more_than_it_gets_and_white_gives_back_all() {
    for Kind { name, bsdf, lossless, .. } in kinds() {
        for out in directions() {
            let found = given_back(&bsdf, out);
            assert!(found.max_component() < 1.0 + lossless.unwrap_or(6e-3) as f32, "{name} at {out}: {found:?}");
            if let Some(tolerance) = lossless {
                assert!(found.min_component() > 1.0 - tolerance as f32, "{name} at {out}: {found:?}");
            }
        }
    }
}

/// What sampling gives is what evaluating gives: value, density, and no directions where there is no value.
#[test]
fn samples_are_what_evaluation_says() {
    for Kind { name, bsdf, .. } in kinds() {
        for out in directions() {
            let mut is_spread = false;
            for (lobe, at) in places(500) {
                let Some(scattered) = bsdf.sample(out, lobe, at) else { continue };
                let How::Spread { pdf } = scattered.how else { continue };
                is_spread = true;
                let (value, density) = bsdf.evaluate(out, scattered.direction);
                assert!((pdf / density - 1.0).abs() < 1e-5, "{name}: {pdf} is not {density}");
                let expected = value * ((1.0 / pdf) as f32);
                let off = (scattered.weight - expected).map(f32::abs).max_component();
                assert!(off <= 1e-4 * expected.max_component(), "{name}: {scattered:?} is not {expected:?}");
            }
            assert!(!(is_spread && bsdf.is_specular()), "{name}");
        }
    }
}

#[test]
fn directions_are_found_as_often_as_the_density_says() {
    for Kind { name, bsdf, .. } in kinds().into_iter().filter(|kind| !kind.bsdf.is_specular()) {
        for out in directions() {
            let sample = |lobe: f64, at: DVec2| {
                let scattered = bsdf.sample(out, lobe, at)?;
                matches!(scattered.how, How::Spread { .. }).then_some(scattered.direction)
            };
            sample_follows_pdf(&format!("{name} at {out}"), &sample, &|toward| bsdf.evaluate(out, toward).1);
        }
    }
}

/// Helmholtz: light takes the same way back. Through a boundary, radiance over the square of the index does.
#[test]
fn light_takes_the_same_way_back() {
    let mut numbers = Numbers(7);
    for Kind { name, bsdf, behind, squeeze, .. } in kinds() {
        for _ in 0..200 {
            let (a, b) = (warps::cosine_hemisphere(numbers.point()), warps::cosine_hemisphere(numbers.point()));
            let value =
                |bsdf: &Bsdf, out: DVec3, toward: DVec3| bsdf.evaluate(out, toward).0 * (1.0 / toward.z.abs() as f32);
            let near = |there: Rgb, back: Rgb| {
                let off = (there - back).map(f32::abs).max_component();
                assert!(off <= 1e-4 * there.max_component().max(1e-6), "{name}: {there:?} is not {back:?}");
            };
            near(value(&bsdf, a, b), value(&bsdf, b, a));
            if let Some(behind) = behind {
                // Seen from behind, the frame is turned over.
                let turned = |w: DVec3| DVec3::new(w.x, w.y, -w.z);
                let (there, back) = (value(&bsdf, a, turned(b)), value(&behind, b, turned(a)));
                near(there * (1.0 / squeeze as f32), back);
            }
        }
    }
}

/// With little roughness, what is given back from a sky that is dark but for a broad cap is what a smooth surface gives.
#[test]
fn the_smooth_limit_is_smooth() {
    let sky = |direction: DVec3| if direction.x * 0.6 + direction.z * 0.8 > 0.3 { 1.0 } else { 0.0 };
    let smooth_and_rough = |make: &dyn Fn(Option<Ggx>) -> Bsdf| {
        [None, Ggx::new(DVec2::splat(2e-3))].map(|ggx| {
            let bsdf = make(ggx);
            directions().map_each(|out| {
                let lit = |(lobe, at): (f64, DVec2)| {
                    bsdf.sample(out, lobe, at).map_or(0.0, |found| f64::from(found.weight.r) * sky(found.direction))
                };
                places(4000).map(lit).sum::<f64>() / 4000.0
            })
        })
    };
    let metal = Reflectance::Complex { eta: Rgb::gray(0.4), k: Rgb::gray(2.5) };
    let makes: [&dyn Fn(Option<Ggx>) -> Bsdf; 3] = [
        &|ggx| Bsdf::Conductor(Conductor::new(metal, metal.average(), ggx)),
        &|ggx| Bsdf::Dielectric(Dielectric::new(1.5, Rgb::WHITE, ggx)),
        &|ggx| Bsdf::Plastic(Plastic::new(1.5, Rgb::gray(0.5), ggx)),
    ];
    for make in makes {
        let [smooth, rough] = smooth_and_rough(make);
        for (smooth, rough) in smooth.into_iter().zip(rough) {
            assert!((smooth - rough).abs() < 0.012, "{rough} is not {smooth}");
        }
    }
}

trait MapEach {
    fn map_each(self, f: impl FnMut(DVec3) -> f64) -> Vec<f64>;
}

impl MapEach for Vec<DVec3> {
    fn map_each(self, f: impl FnMut(DVec3) -> f64) -> Vec<f64> {
        self.into_iter().map(f).collect()
    }
}

/// The matte part of plastic and of what else is spread evenly is what its closed form says: the integral of `evaluate` is
/// what sampling sums.
#[test]
fn integrals_agree_with_sampling() {
    for Kind { name, bsdf, .. } in kinds() {
        let out = directions()[1];
        let only = places(6000).filter_map(|(lobe, at)| bsdf.sample(out, lobe, at));
        let only = only.filter(|found| !matches!(found.how, How::Spread { .. }));
        let only: f64 = only.map(|found| f64::from(found.weight.g)).sum::<f64>() / 6000.0;
        let spread = sphere_integral(&|toward| f64::from(bsdf.evaluate(out, toward).0.g));
        let sampled = places(6000).filter_map(|(lobe, at)| bsdf.sample(out, lobe, at));
        let sampled = sampled.map(|found| f64::from(found.weight.g)).sum::<f64>() / 6000.0;
        assert!(
            (only + spread - sampled).abs() < 2e-2 * sampled.max(1.0),
            "{name}: {only} + {spread} is not {sampled}"
        );
    }
}

/// Neither at the edges of what numbers can be nor in between is anything infinite, negative or no number.
#[test]
fn numbers_stay_numbers() {
    let mut numbers = Numbers(99);
    let extreme = [0.0, 1e-300, 1e-16, 1e-9, 1e-5, 0.5, 1.0 - 1e-9, 1.0 - f64::EPSILON / 2.0];
    let tilts = [1.0, 0.999_999_9, 0.5, 1e-3, 1e-6, 1e-8, 1e-12, 0.0, -0.3];
    for Kind { name, bsdf, .. } in kinds() {
        for round in 0..600 {
            let mut any = |i: usize| match round % 2 {
                0 => extreme[(numbers.next() * extreme.len() as f64) as usize],
                _ => numbers.next() * if i == 9 { 0.0 } else { 1.0 },
            };
            let (lobe, at) = (any(0), DVec2::new(any(1), any(2)));
            let tilted = |z: f64, turns: f64| {
                let (cos, sin) = durer_math::functions::cos_sin_of_turns(turns);
                let radius = (1.0_f64 - z * z).sqrt();
                DVec3::new(radius * cos, radius * sin, z)
            };
            let out = tilted(tilts[(numbers.next() * tilts.len() as f64) as usize], numbers.next());
            let toward = tilted(-tilts[(numbers.next() * tilts.len() as f64) as usize], numbers.next());
            for toward in [toward, -toward, tilted(out.z, 0.3), DVec3::new(-out.x, -out.y, out.z), -out] {
                let (value, pdf) = bsdf.evaluate(out, toward);
                let fine = value.is_finite() && value.min_component() >= 0.0 && pdf.is_finite() && pdf >= 0.0;
                assert!(fine, "{name}: {value:?}, {pdf} from {out} to {toward}");
            }
            if let Some(found) = bsdf.sample(out, lobe, at) {
                let fine =
                    found.weight.is_finite() && found.weight.min_component() >= 0.0 && found.direction.is_finite();
                assert!(fine, "{name}: {found:?} from {out} by {lobe}, {at}");
                // Oren and Nayar's grooves are bright where both directions graze them.
                let bounded = found.weight.max_component() / found.scale < 30.0 || matches!(bsdf, Bsdf::OrenNayar(_));
                assert!(bounded, "{name}: {found:?} from {out}");
            }
        }
    }
}
