//! What the points promise: nets for each pixel and for blocks of them, no pattern between pairs, errors that fall fast
//! and differ between neighbors.

use super::*;
use durer_math::functions::{cos, sin};

const PAIRS: [(u32, Purpose); 4] =
    [(0, Purpose::Pixel), (1, Purpose::Direction), (1, Purpose::LightPoint), (7, Purpose::Direction)];

/// True if each elementary interval of their area has exactly one of the points, whose number is a power of two.
fn are_net(points: &[DVec2]) -> bool {
    let bits = points.len().trailing_zeros();
    (0..=bits).all(|across| {
        let down = bits - across;
        let mut seen = vec![false; points.len()];
        points.iter().all(|point| {
            let (column, row) =
                ((point.x * f64::from(1 << across)) as usize, (point.y * f64::from(1 << down)) as usize);
            !std::mem::replace(&mut seen[column << down | row], true)
        })
    })
}

fn points(pixels: &[(u32, u32)], samples: std::ops::Range<u32>, (depth, purpose): (u32, Purpose)) -> Vec<DVec2> {
    let of_pixel = |&pixel| samples.clone().map(move |sample| Sampler::new(7, pixel, sample).two(depth, purpose));
    pixels.iter().flat_map(of_pixel).collect()
}

fn block((x, y): (u32, u32), edge: u32) -> Vec<(u32, u32)> {
    (0..edge).flat_map(|row| (0..edge).map(move |column| (x + column, y + row))).collect()
}

#[test]
fn the_samples_of_a_pixel_are_nets() {
    for pixel in [(0, 0), (5, 3), (1000, 777), (65_534, 12)] {
        for pair in PAIRS {
            for power in [0, 2, 4, 6, 8] {
                let count = 1 << power;
                assert!(are_net(&points(&[pixel], 0..count, pair)), "{pixel:?}, {pair:?}, {count}");
                assert!(are_net(&points(&[pixel], 3 * count..4 * count, pair)), "{pixel:?}, {pair:?}, later {count}");
            }
        }
        for power in 0..10 {
            assert!(are_net(&points(&[pixel], 0..1 << power, PAIRS[0])), "{pixel:?}, 2^{power}");
        }
    }
}

#[test]
fn the_samples_of_blocks_of_pixels_are_nets() {
    for pair in PAIRS {
        for power in [0, 2, 4] {
            for edge in [2, 4, 8, 16] {
                let corner = (32 + 16 - edge, 16);
                let points = points(&block(corner, edge), 0..1 << power, pair);
                assert!(are_net(&points), "{pair:?}, {edge}, {power}");
            }
        }
    }
}

#[test]
fn split_samples_are_nets() {
    let points = (0..4).flat_map(|sample| {
        let sampler = Sampler::new(0, (3, 4), sample);
        (0..16).map(move |number| sampler.split(number, 16).two(1, Purpose::LightPoint))
    });
    assert!(are_net(&points.collect::<Vec<_>>()));
    let of_place = Sampler::of_place(0, DVec2::new(3.5, 4.25));
    assert!(are_net(&(0..16).map(|n| of_place.split(n, 16).two(1, Purpose::LightPoint)).collect::<Vec<_>>()));
}

/// What depends on two pairs, or on two places, is not estimated much worse than by numbers that know nothing of each other.
#[test]
fn pairs_do_not_know_each_other() {
    let (samples, tries) = (64, 2000);
    for (one, other) in [(0, 1), (1, 2), (1, 3)] {
        for axes in [[0, 0], [0, 1], [1, 1]] {
            let sums = (0..tries).map(|place: u32| {
                let pixel = (place % 251 * 16, place / 251 * 16);
                let product = |sample| {
                    let sampler = Sampler::new(1, pixel, sample);
                    let at = |pair: usize, axis: usize| sampler.two(PAIRS[pair].0, PAIRS[pair].1)[axis] - 0.5;
                    12.0 * at(one, axes[0]) * at(other, axes[1])
                };
                (0..samples).map(product).sum::<f64>()
            });
            let sums: Vec<f64> = sums.collect();
            let mean = sums.iter().sum::<f64>() / f64::from(tries * samples);
            let variance = sums.iter().map(|sum| sum * sum).sum::<f64>() / f64::from(tries * samples);
            assert!(mean.abs() < 4.0 / f64::from(tries * samples).sqrt(), "{one} {other} {axes:?}: {mean}");
            assert!((0.5..1.6).contains(&variance), "{one} {other} {axes:?}: {variance}");
        }
    }
}

/// Numbers are even, whatever they are for: no part of the square gets more than its share.
#[test]
fn first_samples_fill_the_square_evenly() {
    for pair in PAIRS {
        let mut counts = [0_u32; 64];
        for place in 0..16_384 {
            let pixel = (place % 128 * 16 + 5, place / 128 * 16 + 9);
            let point = Sampler::new(3, pixel, 0).two(pair.0, pair.1);
            counts[(point.x * 8.0) as usize * 8 + (point.y * 8.0) as usize] += 1;
        }
        let chi_square: f64 = counts.iter().map(|&count| squared(f64::from(count) - 256.0) / 256.0).sum();
        assert!((25.0..120.0).contains(&chi_square), "{pair:?}: {chi_square}");
    }
}

fn squared(number: f64) -> f64 {
    number * number
}

fn smooth(at: DVec2) -> f64 {
    // Its mean over the square is (1 - cos 1) · sin 1.
    sin(at.x) * cos(at.y)
}

const SMOOTH: f64 = 0.459_697_694_131_860_3 * 0.841_470_984_807_896_5;

/// Root of the mean square of the error of a pixel.
fn error(count: u32, f: impl Fn(DVec2) -> f64, truth: f64) -> f64 {
    let tries = 200;
    let squares = (0..tries).map(|place| {
        let sum: f64 = points(&[(place * 16 + 3, 8)], 0..count, PAIRS[1]).into_iter().map(&f).sum();
        squared(sum / f64::from(count) - truth)
    });
    (squares.sum::<f64>() / f64::from(tries)).sqrt()
}

#[test]
fn errors_fall_faster_than_those_of_chance() {
    // By chance it would be 8 times less; with a smooth integrand it is about 64 · 8 times less, at an edge 64^(3/4).
    let gain = error(4, smooth, SMOOTH) / error(256, smooth, SMOOTH);
    assert!(gain > 200.0, "{gain}");
    let edge = |at: DVec2| if at.x + 0.7 * at.y < 0.9 { 1.0 } else { 0.0 };
    // The area below the line from (0.9, 0) to (0.2, 1).
    let gain = error(4, edge, 0.55) / error(256, edge, 0.55);
    assert!(gain > 14.0, "{gain}");
}

/// The error of the mean over blocks of pixels falls much faster with their size than that of pixels that know nothing of
/// each other: there is little of it at low frequencies.
#[test]
fn the_error_of_neighbors_is_blue() {
    let edge = |at: DVec2| if at.x < 0.4 || at.y > 0.8 { 1.0 } else { 0.0 };
    for samples in [1, 4] {
        for pair in [PAIRS[1], PAIRS[2]] {
            let error_of = |size: u32| {
                let corners = (0..64 / size).flat_map(|y| (0..64 / size).map(move |x| (x * size, y * size)));
                let errors = corners.map(|corner| {
                    let points = points(&block(corner, size), 0..samples, pair);
                    let mean = points.iter().map(|&at| edge(at)).sum::<f64>() / points.len() as f64;
                    squared(mean - 0.52)
                });
                errors.sum::<f64>() / f64::from(64 / size * (64 / size))
            };
            let white = error_of(1) / 16.0;
            let found = error_of(4);
            assert!(found < 0.35 * white, "{samples}, {pair:?}: {found}, white {white}");
        }
    }
}

#[test]
fn pixels_seeds_and_samples_differ() {
    let number = |seed, pixel, sample| Sampler::new(seed, pixel, sample).two(2, Purpose::Direction);
    let first = number(0, (1, 1), 0);
    for other in [number(1, (1, 1), 0), number(0, (2, 1), 0), number(0, (1, 2), 0), number(0, (17, 1), 0)] {
        assert_ne!(first, other);
    }
    assert_ne!(first, number(0, (1, 1), u32::MAX));
}

/// Pictures are made of these numbers: they change only together with all pictures.
#[test]
fn the_numbers_stay_what_they_are() {
    let bits = |sampler: Sampler, depth, purpose| (sampler.two(depth, purpose) * 4_294_967_296.0).to_array();
    let cases = [
        bits(Sampler::new(0, (0, 0), 0), 0, Purpose::Pixel),
        bits(Sampler::new(0, (0, 0), 1), 0, Purpose::Pixel),
        bits(Sampler::new(1, (100, 50), 77), 3, Purpose::Direction),
        bits(Sampler::of_place(2, DVec2::new(1.5, 2.25)), 1, Purpose::LightPoint),
    ];
    let golden = [
        [225_505_807, 3_925_057_946],
        [3_263_307_760, 1_175_040_130],
        [1_969_550_029, 4_030_703_852],
        [2_805_325_353, 2_936_390_059],
    ];
    assert_eq!(cases.map(|[x, y]| [x as u32, y as u32]), golden);
}
