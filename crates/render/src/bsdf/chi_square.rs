//! For tests: does sampling find directions as often as the density says? Pearson's χ² test, as in Mitsuba and nori, and
//! integrals over the sphere.

use durer_math::{DVec2, DVec3, functions};
use std::f64::consts::PI;

/// Cells: from pole to pole by equal angles, and around.
const BINS: (usize, usize) = (20, 40);
/// Directions found for a test.
const SAMPLES: u32 = 20_000;
/// A test that is right fails with this probability; about as many are run as are allowed for here (Šidák's correction).
const SIGNIFICANCE: f64 = 0.01;
const TESTS: f64 = 1000.0;

/// Some directions above the surface, from steep to grazing, none along an axis but one.
pub(crate) fn directions() -> Vec<DVec3> {
    [(1.0, 0.0), (0.8, 40.0), (0.35, 130.0), (0.1, 265.0)]
        .into_iter()
        .map(|(z, degrees): (f64, f64)| {
            let (radius, angle) = ((1.0 - z * z).sqrt(), degrees.to_radians());
            DVec3::new(radius * functions::cos(angle), radius * functions::sin(angle), z)
        })
        .collect()
}

/// Numbers from 0 to 1 that look random (PCG's RXS-M-XS), for tests.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// The next one.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let word = (self.0 >> ((self.0 >> 59) + 5) ^ self.0).wrapping_mul(12_605_985_483_714_917_081);
        ((word >> 43 ^ word) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A point of the unit square.
    pub(crate) fn point(&mut self) -> DVec2 {
        DVec2::new(self.next(), self.next())
    }
}

/// Gauss and Legendre's rule with five points, on 0..1.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_55),
    (0.230_765_344_947_158_46, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_45),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_55),
];

/// The direction so far on the way from the south pole to the north pole, and around; and the sine of the angle to the pole.
fn direction(way: f64, turns: f64) -> (DVec3, f64) {
    let (down, radius) = functions::cos_sin_of_turns(0.5 * way);
    let (cos, sin) = functions::cos_sin_of_turns(turns);
    (DVec3::new(radius * cos, radius * sin, -down), radius)
}

/// The integral of a function over a cell, which is divided further until halving changes nothing.
fn cell_integral(f: &dyn Fn(DVec3) -> f64, (z0, z1): (f64, f64), (t0, t1): (f64, f64), depth: u32) -> f64 {
    let rule = |z0: f64, z1: f64, t0: f64, t1: f64| {
        let mut sum = 0.0;
        for (z, z_weight) in GAUSS {
            for (t, t_weight) in GAUSS {
                let (direction, sin) = direction(z0 + (z1 - z0) * z, t0 + (t1 - t0) * t);
                sum += z_weight * t_weight * sin * f(direction);
            }
        }
        sum * (z1 - z0) * (t1 - t0) * 2.0 * PI * PI
    };
    let (zm, tm) = (0.5 * (z0 + z1), 0.5 * (t0 + t1));
    let whole = rule(z0, z1, t0, t1);
    let quarters = [((z0, zm), (t0, tm)), ((z0, zm), (tm, t1)), ((zm, z1), (t0, tm)), ((zm, z1), (tm, t1))];
    let sum: f64 = quarters.iter().map(|&((a, b), (c, d))| rule(a, b, c, d)).sum();
    if depth == 0 || (sum - whole).abs() < 1e-7 + 1e-4 * sum.abs() {
        return sum;
    }
    quarters.into_iter().map(|(z, t)| cell_integral(f, z, t, depth - 1)).sum()
}

/// The integrals of a function of directions over all cells.
fn cells(f: &dyn Fn(DVec3) -> f64) -> Vec<f64> {
    let edge = |i: usize, count: usize| i as f64 / count as f64;
    let span = |i: usize, count: usize| (edge(i, count), edge(i + 1, count));
    let index = |i: usize| (span(i / BINS.1, BINS.0), span(i % BINS.1, BINS.1));
    (0..BINS.0 * BINS.1).map(index).map(|(z, t)| cell_integral(f, z, t, 6)).collect()
}

/// The integral of a function of directions over the sphere.
pub(crate) fn sphere_integral(f: &dyn Fn(DVec3) -> f64) -> f64 {
    cells(f).into_iter().sum()
}

/// Panics if directions that `sample` finds (from a number and a point of the unit square) are not distributed as `pdf`
/// says, per solid angle, or if some are not found at all that ought to be. The density's integral may be below 1: the rest
/// is the chance to find none.
pub(crate) fn sample_follows_pdf(what: &str, sample: &dyn Fn(f64, DVec2) -> Option<DVec3>, pdf: &dyn Fn(DVec3) -> f64) {
    let mut numbers = Numbers(0x5eed);
    let mut found = vec![0.0; BINS.0 * BINS.1];
    let mut none = 0.0;
    for _ in 0..SAMPLES {
        let one = numbers.next();
        match sample(one, numbers.point()) {
            None => none += 1.0,
            Some(direction) => {
                assert!((direction.length() - 1.0).abs() < 1e-9, "{what}: {direction} has not unit length");
                let row = ((1.0 - functions::acos(direction.z.clamp(-1.0, 1.0)) / PI) * BINS.0 as f64) as usize;
                let turns = functions::atan2(direction.y, direction.x) / (2.0 * PI);
                let column = ((turns - turns.floor()) * BINS.1 as f64) as usize;
                found[row.min(BINS.0 - 1) * BINS.1 + column.min(BINS.1 - 1)] += 1.0;
            }
        }
    }
    let mut expected: Vec<f64> = cells(pdf).into_iter().map(|part| part * f64::from(SAMPLES)).collect();
    let total: f64 = expected.iter().sum();
    assert!(total < 1.002 * f64::from(SAMPLES), "{what}: the density's integral is {}", total / f64::from(SAMPLES));
    expected.push((f64::from(SAMPLES) - total).max(0.0));
    found.push(none);
    let probability = chi_square(&found, &expected);
    let least = 1.0 - functions::pow_double(1.0 - SIGNIFICANCE, 1.0 / TESTS);
    assert!(probability > least, "{what}: counts would be so far off with probability {probability:e}");
}

/// The probability of counts that are as far from the expected ones as those found, or further. Cells with few are
/// taken together.
pub(crate) fn chi_square(found: &[f64], expected: &[f64]) -> f64 {
    let mut order: Vec<usize> = (0..expected.len()).collect();
    order.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    let (mut statistic, mut freedom) = (0.0, -1.0);
    let (mut pooled_found, mut pooled_expected) = (0.0, 0.0);
    let mut add = |found: f64, expected: f64| {
        statistic += (found - expected) * (found - expected) / expected;
        freedom += 1.0;
    };
    for index in order {
        if expected[index] > 5.0 && (pooled_expected == 0.0 || pooled_expected > 5.0) {
            if pooled_expected > 0.0 {
                add(pooled_found, pooled_expected);
                (pooled_found, pooled_expected) = (0.0, 0.0);
            }
            add(found[index], expected[index]);
        } else {
            pooled_found += found[index];
            pooled_expected += expected[index];
        }
    }
    if pooled_expected > 0.0 {
        add(pooled_found, pooled_expected);
    } else if pooled_found > 0.0 {
        // Found where nothing can be.
        return 0.0;
    }
    if freedom < 1.0 { 1.0 } else { 1.0 - lower_gamma(0.5 * freedom, 0.5 * statistic) }
}

/// The regularized lower incomplete gamma function, by its series (DLMF 8.11.4) or, for large x, by Wilson and Hilferty's
/// cube root, which is good to some digits there.
fn lower_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if a > 50.0 {
        let z = (functions::cbrt(x / a) - (1.0 - 1.0 / (9.0 * a))) * (3.0 * a.sqrt());
        return normal_below(z);
    }
    let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
    for _ in 0..10_000 {
        n += 1.0;
        term *= x / n;
        sum += term;
        if term < sum * 1e-15 {
            break;
        }
    }
    (sum * functions::pow_double(std::f64::consts::E, a * functions::ln(x) - x - ln_gamma(a))).min(1.0)
}

/// The probability that a normal variable is below z: Abramowitz and Stegun, 26.2.17.
fn normal_below(z: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.231_641_9 * z.abs());
    let tail = [1.330_274_429, -1.821_255_978, 1.781_477_937, -0.356_563_782, 0.319_381_530];
    let sum = tail.into_iter().fold(0.0, |sum, k| (sum + k) * t);
    let above = functions::pow_double(std::f64::consts::E, -0.5 * z * z) / (2.0 * PI).sqrt() * sum;
    if z > 0.0 { 1.0 - above } else { above }
}

/// ln Γ(a), by Stirling's series (DLMF 5.11.1) from 10 on.
fn ln_gamma(a: f64) -> f64 {
    if a < 10.0 {
        return ln_gamma(a + 1.0) - functions::ln(a);
    }
    let series = (1.0 / 12.0 - (1.0 / 360.0 - 1.0 / (1260.0 * a * a)) / (a * a)) / a;
    (a - 0.5) * functions::ln(a) - a + 0.5 * functions::ln(2.0 * PI) + series
}

/// Values from tables: χ² = 18.307 with 10 degrees of freedom is passed with probability 0.05, 124.342 with 100, too.
#[test]
fn tables_of_the_distribution() {
    for (freedom, statistic) in [(1.0, 3.841), (10.0, 18.307), (50.0, 67.505), (100.0, 124.342), (500.0, 553.127)] {
        let probability = 1.0 - lower_gamma(0.5 * freedom, 0.5 * statistic);
        assert!((probability - 0.05).abs() < 2e-4, "{freedom}: {probability}");
    }
}

/// A test of the test: what is drawn from another density is found out.
#[test]
fn wrong_densities_are_found_out() {
    let cosine = |direction: DVec3| super::warps::cosine_pdf(direction.z);
    let even = |_: f64, at: DVec2| {
        let (cos, sin) = functions::cos_sin_of_turns(at.y);
        let radius = (1.0 - at.x * at.x).sqrt();
        Some(DVec3::new(radius * cos, radius * sin, at.x))
    };
    assert!(std::panic::catch_unwind(|| sample_follows_pdf("", &even, &cosine)).is_err());
    sample_follows_pdf("even", &even, &|direction| if direction.z > 0.0 { 0.5 / PI } else { 0.0 });
    let warped = |_: f64, at: DVec2| Some(super::warps::cosine_hemisphere(at));
    sample_follows_pdf("cosine", &warped, &cosine);
}
