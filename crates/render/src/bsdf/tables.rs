//! What rough surfaces give back after light has met one microfacet, summed over all directions once and looked up since.
//!
//! What is missing has met several microfacets, and is added by what uses the tables (Kulla and Conty, "Revisiting
//! Physically Based Shading at Imageworks", SIGGRAPH 2017). Tables are computed when first asked for, always to the same
//! bits; scenes ask while they are compiled.

use super::fresnel::{self, schlick_weight};
use super::ggx::Ggx;
use super::sheen;
use super::warps::even_hemisphere;
use durer_math::{DVec2, DVec3};
use std::array;
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

/// Steps of roughness (the square root of α), and of the square root of the cosine: both lie closest where tables bend.
const STEPS: usize = 24;
/// Directions summed for each entry: a number of Fibonacci's, so that their lattice has no seam.
const SUMMED: u32 = 610;
/// Fibonacci's number before it.
const TURNS: u32 = 377;

/// A function of cosine and roughness between its nodes: bilinear.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// By roughness, then by the square root of the cosine.
    nodes: [[f32; STEPS + 1]; STEPS + 1],
    /// For each roughness, the mean over all cosines μ of the same bilinear function: 2 ∫ f(μ) μ dμ.
    averages: [f32; STEPS + 1],
}

/// What reflection by microfacets that reflect everything gives back, and the part of Schlick's weight (1 - cos)⁵ in it.
pub(crate) struct Reflected {
    pub(crate) all: Table,
    pub(crate) schlick: Table,
}

/// What boundaries between dielectrics give back.
pub(crate) struct Dielectric {
    /// Light that is reflected, from the side of the thinner medium.
    reflected: Slices,
    /// Light that is reflected or let through, from there.
    either: Slices,
    /// The same from the side of the denser medium.
    either_from_dense: Slices,
}

/// Tables for several indices of refraction, evenly spaced in (η - 1) / (η + 1). Each is computed when first asked for.
struct Slices {
    of: fn(f64) -> Table,
    tables: [OnceLock<Table>; INDICES],
}

const INDICES: usize = 31;
const LAST_INDEX: f64 = 0.6;

/// Of mirrors.
pub(crate) static REFLECTED: LazyLock<Reflected> = LazyLock::new(|| {
    let weight = |weigh: fn(f64) -> f64| {
        move |ggx: &Ggx, out: DVec3, h: DVec3| {
            let cos = out.dot(h);
            let toward = h * (2.0 * cos) - out;
            if toward.z > 0.0 { weigh(cos) * kept(ggx, out, toward) } else { 0.0 }
        }
    };
    Reflected {
        all: Table::summed(weight(|_| 1.0), |_| 1.0),
        schlick: Table::summed(weight(schlick_weight), schlick_weight),
    }
});

/// Of rough glass.
pub(crate) static DIELECTRIC: Dielectric = Dielectric {
    reflected: Slices::new(|eta| {
        let smooth = |cos| fresnel::dielectric(cos, eta).reflectance;
        Table::summed(|ggx, out, h| reflected_part(ggx, out, h, eta), smooth)
    }),
    either: Slices::new(either_way),
    either_from_dense: Slices::new(|eta| either_way(1.0 / eta)),
};

/// What cloth gives back, by roughness; above 1 for upright fibers seen from the side.
pub(crate) static SHEEN: LazyLock<Table> = LazyLock::new(|| {
    Table::of(|roughness, out| {
        mean(|at| {
            let toward = even_hemisphere(at);
            2.0 * PI * sheen::value(out, toward, roughness) * toward.z
        })
    })
});

fn either_way(eta: f64) -> Table {
    Table::summed(|ggx, out, h| reflected_part(ggx, out, h, eta) + transmitted_part(ggx, out, h, eta), |_| 1.0)
}

fn reflected_part(ggx: &Ggx, out: DVec3, h: DVec3, eta: f64) -> f64 {
    let cos = out.dot(h);
    let toward = h * (2.0 * cos) - out;
    if toward.z > 0.0 { fresnel::dielectric(cos, eta).reflectance * kept(ggx, out, toward) } else { 0.0 }
}

fn transmitted_part(ggx: &Ggx, out: DVec3, h: DVec3, eta: f64) -> f64 {
    let cos = out.dot(h);
    let boundary = fresnel::dielectric(cos, eta);
    let toward = h * (cos / eta - boundary.cos_behind) - out / eta;
    if toward.z < 0.0 { (1.0 - boundary.reflectance) * kept(ggx, out, toward) } else { 0.0 }
}

/// The part of light found by a visible normal that is not hidden on its way on.
fn kept(ggx: &Ggx, out: DVec3, toward: DVec3) -> f64 {
    ggx.masking_shadowing(out, toward) / ggx.masking(out)
}

impl Table {
    /// For each cosine and roughness, the mean of `weight` over visible normals; `smooth` is what it is without roughness.
    fn summed(weight: impl Fn(&Ggx, DVec3, DVec3) -> f64, smooth: impl Fn(f64) -> f64) -> Table {
        Table::of(|roughness, out| match Ggx::new(DVec2::splat(roughness * roughness)) {
            Some(ggx) => mean(|at| weight(&ggx, out, ggx.sample(out, at))),
            None => smooth(out.z),
        })
    }

    /// A function of roughness and the direction of the eye.
    fn of(value: impl Fn(f64, DVec3) -> f64) -> Table {
        let node = |i: usize, j: usize| {
            let at = |i: usize| i as f64 / STEPS as f64;
            let cos = at(j).max(1e-3) * at(j).max(1e-3);
            value(at(i), DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)) as f32
        };
        let nodes: [_; STEPS + 1] = array::from_fn(|i| array::from_fn(|j| node(i, j)));
        let averages = nodes.map(|row| average(&row));
        Table { nodes, averages }
    }

    /// The value for a cosine and a width α of microfacets.
    #[inline]
    pub(crate) fn at(&self, cos: f64, alpha: f64) -> f64 {
        let (i, u) = place(alpha.sqrt());
        let (j, v) = place(cos.abs().sqrt());
        let row = |i: usize| f64::from(self.nodes[i][j]) * (1.0 - v) + f64::from(self.nodes[i][j + 1]) * v;
        row(i) * (1.0 - u) + row(i + 1) * u
    }

    /// The mean over all directions, weighted by the cosine.
    #[inline]
    pub(crate) fn average(&self, alpha: f64) -> f64 {
        let (i, u) = place(alpha.sqrt());
        f64::from(self.averages[i]) * (1.0 - u) + f64::from(self.averages[i + 1]) * u
    }
}

impl Dielectric {
    /// The part that a boundary with relative index `eta` above 1 reflects.
    pub(crate) fn reflected(&self, cos: f64, alpha: f64, eta: f64) -> f64 {
        self.reflected.of(eta, |table| table.at(cos, alpha))
    }

    /// The mean of [`Dielectric::reflected`] over all directions.
    pub(crate) fn reflected_average(&self, alpha: f64, eta: f64) -> f64 {
        self.reflected.of(eta, |table| table.average(alpha))
    }

    /// The part that goes on from a boundary with relative index `eta`, to either side.
    pub(crate) fn either(&self, cos: f64, alpha: f64, eta: f64) -> f64 {
        let (slices, eta) = self.toward(eta);
        slices.of(eta, |table| table.at(cos, alpha))
    }

    /// The mean of [`Dielectric::either`] over all directions.
    pub(crate) fn either_average(&self, alpha: f64, eta: f64) -> f64 {
        let (slices, eta) = self.toward(eta);
        slices.of(eta, |table| table.average(alpha))
    }

    fn toward(&self, eta: f64) -> (&Slices, f64) {
        if eta >= 1.0 { (&self.either, eta) } else { (&self.either_from_dense, 1.0 / eta) }
    }
}

impl Slices {
    const fn new(of: fn(f64) -> Table) -> Slices {
        Slices { of, tables: [const { OnceLock::new() }; INDICES] }
    }

    fn of(&self, eta: f64, value: impl Fn(&Table) -> f64) -> f64 {
        let s = (eta - 1.0) / (eta + 1.0) / LAST_INDEX * (INDICES - 1) as f64;
        let s = s.clamp(0.0, (INDICES - 1) as f64);
        let i = (s as usize).min(INDICES - 2);
        let u = s - i as f64;
        value(self.table(i)) * (1.0 - u) + value(self.table(i + 1)) * u
    }

    fn table(&self, index: usize) -> &Table {
        self.tables[index].get_or_init(|| {
            let s = LAST_INDEX * index as f64 / (INDICES - 1) as f64;
            (self.of)((1.0 + s) / (1.0 - s))
        })
    }
}

/// The node before a place from 0 to 1, and how far it is on the way to the next.
#[inline]
fn place(at: f64) -> (usize, f64) {
    let x = at.clamp(0.0, 1.0) * STEPS as f64;
    let i = (x as usize).min(STEPS - 1);
    (i, x - i as f64)
}

/// 2 ∫ f(μ) μ dμ = 4 ∫ f(t²) t³ dt of a row, exactly: with f linear in t from node to node.
fn average(row: &[f32; STEPS + 1]) -> f32 {
    let step = 1.0 / STEPS as f64;
    let mut sum = 0.0;
    for (j, ends) in row.windows(2).enumerate() {
        let (a, b) = (j as f64 * step, (j + 1) as f64 * step);
        let slope = (f64::from(ends[1]) - f64::from(ends[0])) / step;
        let fourth = |t: f64| t * t * t * t;
        sum += (f64::from(ends[0]) - slope * a) * (fourth(b) - fourth(a));
        sum += slope * 0.8 * (fourth(b) * b - fourth(a) * a);
    }
    sum as f32
}

/// The mean of a function over the unit square, of which y goes around.
///
/// Summed functions of visible normals bend, and fall steeply, where x is near 1, which is where light leaves along the
/// surface. Points lie closer there and count less: x = 1 - (1 - t)² for even t. With evenly spread ones sums came out too
/// small, and what uses them gave back a thousandth more light than there was.
fn mean(f: impl Fn(DVec2) -> f64) -> f64 {
    let part = |k: u32| {
        let (at, weight) = spread(k);
        weight * f(at)
    };
    (0..SUMMED).map(part).sum::<f64>() / f64::from(SUMMED)
}

/// Points of Fibonacci's lattice, drawn towards x = 1, and what each counts.
fn spread(k: u32) -> (DVec2, f64) {
    let n = f64::from(SUMMED);
    let left = 1.0 - (f64::from(k) + 0.5) / n;
    let y = (f64::from(k * TURNS % SUMMED) + 0.5) / n;
    (DVec2::new(1.0 - left * left, y), 2.0 * left)
}

#[cfg(test)]
mod tests {
    use super::super::chi_square::sphere_integral;
    use super::*;

    /// Between nodes, too, a table is near to what integrating over directions, instead of normals, gives.
    #[test]
    fn tables_agree_with_integrals_over_directions() {
        for (alpha, cos) in [(0.1, 0.9), (0.1, 0.3), (0.4, 0.7), (0.7, 0.15), (1.0, 0.95), (0.9, 0.4)] {
            let ggx = Ggx::new(DVec2::splat(alpha)).unwrap();
            let out = DVec3::new(f64::sqrt(1.0 - cos * cos), 0.0, cos);
            let reflected = |toward: DVec3| {
                let h = (out + toward).normalize();
                let value = ggx.density(h) * ggx.masking_shadowing(out, toward) / (4.0 * out.z);
                if toward.z > 0.0 { (value, out.dot(h)) } else { (0.0, 1.0) }
            };
            let near = |found: f64, expected: f64| {
                assert!((found - expected).abs() < 6e-3, "α {alpha}, cos {cos}: {found}, not {expected}");
            };
            near(REFLECTED.all.at(cos, alpha), sphere_integral(&|toward| reflected(toward).0));
            let schlick = |toward| reflected(toward).0 * schlick_weight(reflected(toward).1);
            near(REFLECTED.schlick.at(cos, alpha), sphere_integral(&schlick));
            let glass = |toward| reflected(toward).0 * fresnel::dielectric(reflected(toward).1, 1.5).reflectance;
            near(DIELECTRIC.reflected(cos, alpha, 1.5), sphere_integral(&glass));
        }
    }

    /// What is missing is added, so tables that are too low on the whole would make light.
    #[test]
    fn tables_are_neither_low_nor_high_on_the_whole() {
        for roughness in [0.15_f64, 0.25, 0.35, 0.55, 0.8, 1.0] {
            let alpha = roughness * roughness;
            let ggx = Ggx::new(DVec2::splat(alpha)).unwrap();
            let mut off = [0.0; 2];
            for step in 0..10 {
                let cos = 0.05 + 0.1 * f64::from(step);
                let out = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let normals = 300;
                let summed = |part: &dyn Fn(DVec3) -> f64| {
                    let each = |k: u32| {
                        let [x, y] = [k / normals, k % normals].map(|i| (f64::from(i) + 0.5) / f64::from(normals));
                        part(ggx.sample(out, DVec2::new(x, y)))
                    };
                    (0..normals * normals).map(each).sum::<f64>() / f64::from(normals * normals)
                };
                let mirror = summed(&|h| {
                    let toward = h * (2.0 * out.dot(h)) - out;
                    if toward.z > 0.0 { kept(&ggx, out, toward) } else { 0.0 }
                });
                let weight = 0.2 * cos;
                off[0] += weight * (REFLECTED.all.at(cos, alpha) - mirror);
                let eta = 1.0 / 1.5;
                let glass = summed(&|h| reflected_part(&ggx, out, h, eta) + transmitted_part(&ggx, out, h, eta));
                off[1] += weight * (DIELECTRIC.either(cos, alpha, eta) - glass);
            }
            assert!(off.iter().all(|off| off.abs() < 1e-3), "roughness {roughness}: off by {off:?}");
        }
    }

    #[test]
    fn averages_are_those_of_the_interpolated_function() {
        for alpha in [0.01, 0.2, 0.55, 1.0] {
            let count = 100_000;
            let part = |i: i32| {
                let cos = (f64::from(i) + 0.5) / f64::from(count);
                2.0 * cos * REFLECTED.all.at(cos, alpha)
            };
            let summed = (0..count).map(part).sum::<f64>() / f64::from(count);
            assert!((REFLECTED.all.average(alpha) - summed).abs() < 1e-5);
        }
    }

    /// What does not meet a second microfacet is all of the light on a smooth surface, and less the rougher it is.
    #[test]
    fn rougher_surfaces_lose_more() {
        let mut before = (1.0, 1.0);
        for step in 0..=20 {
            let alpha = f64::from(step) / 20.0;
            let now = (REFLECTED.all.average(alpha), DIELECTRIC.either_average(alpha, 1.5));
            assert!(now.0 <= before.0 + 1e-4 && now.1 <= before.1 + 1e-3, "{alpha}: {now:?} after {before:?}");
            before = now;
        }
        assert!(before.0 < 0.7 && before.0 > 0.4, "{before:?}");
    }
}
