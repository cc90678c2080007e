//! Gradient noise, and sums of it at several scales: what noise, marble and wood are made from.
//!
//! Ken Perlin, "Improving Noise", SIGGRAPH 2002, with a permutation of our own.

use super::cells::fraction;
use durer_math::DVec3;

/// The numbers 0..=255 in an order that stays for good: pictures depend on it.
static PERMUTATION: [u8; 256] = shuffled();

/// The midpoints of a cube's edges, and four of them again to make sixteen.
const GRADIENTS: [DVec3; 16] = [
    DVec3::new(1.0, 1.0, 0.0),
    DVec3::new(-1.0, 1.0, 0.0),
    DVec3::new(1.0, -1.0, 0.0),
    DVec3::new(-1.0, -1.0, 0.0),
    DVec3::new(1.0, 0.0, 1.0),
    DVec3::new(-1.0, 0.0, 1.0),
    DVec3::new(1.0, 0.0, -1.0),
    DVec3::new(-1.0, 0.0, -1.0),
    DVec3::new(0.0, 1.0, 1.0),
    DVec3::new(0.0, -1.0, 1.0),
    DVec3::new(0.0, 1.0, -1.0),
    DVec3::new(0.0, -1.0, -1.0),
    DVec3::new(1.0, 1.0, 0.0),
    DVec3::new(-1.0, 1.0, 0.0),
    DVec3::new(0.0, -1.0, 1.0),
    DVec3::new(0.0, -1.0, -1.0),
];

/// Between one scale of a fractal sum and the next. Without it the lattices of all scales would share their points, and
/// as each is 0 at its own, flat spots would stand in rows.
const SHIFT: DVec3 = DVec3::new(31.347, 57.571, 89.737);

/// The sum of `octaves` scales of noise, each half the size and half the strength of the one before, divided by the sum
/// of the strengths: in -1..=1, and 0 on average. The largest blotches have the size 1.
pub(super) fn fractal_noise(point: DVec3, octaves: u32) -> f64 {
    let (mut sum, mut strengths) = (0.0, 0.0);
    let (mut scaled, mut strength) = (point, 1.0);
    for _ in 0..octaves {
        sum += strength * gradient_noise(scaled);
        strengths += strength;
        scaled = scaled * 2.0 + SHIFT;
        strength *= 0.5;
    }
    // The extremes of a single scale lie near ±1.04, at places so rare that no picture shows them cut off.
    (sum / strengths).clamp(-1.0, 1.0)
}

/// 0 at the points of the integer lattice, with a gradient of its own at each; smooth to the second derivative; repeats
/// after 256 in each direction.
fn gradient_noise(point: DVec3) -> f64 {
    let near = DVec3::new(fraction(point.x), fraction(point.y), fraction(point.z));
    let far = near - DVec3::ONE;
    let [x0, y0, z0] = [point.x, point.y, point.z].map(|c| c.floor() as i64 as u8);
    let [x1, y1, z1] = [x0, y0, z0].map(|c| c.wrapping_add(1));

    let (a, b) = (permuted(x0), permuted(x1));
    let (aa, ab) = (permuted(a.wrapping_add(y0)), permuted(a.wrapping_add(y1)));
    let (ba, bb) = (permuted(b.wrapping_add(y0)), permuted(b.wrapping_add(y1)));
    let slope =
        |hash: u8, z: u8, offset: DVec3| GRADIENTS[usize::from(permuted(hash.wrapping_add(z)) & 15)].dot(offset);

    let [u, v, w] = [near.x, near.y, near.z].map(fade);
    let face = |z: u8, dz: f64| {
        let low = lerp(u, slope(aa, z, DVec3::new(near.x, near.y, dz)), slope(ba, z, DVec3::new(far.x, near.y, dz)));
        let high = lerp(u, slope(ab, z, DVec3::new(near.x, far.y, dz)), slope(bb, z, DVec3::new(far.x, far.y, dz)));
        lerp(v, low, high)
    };
    lerp(w, face(z0, near.z), face(z1, far.z))
}

/// From 0 to 1 with no slope and no bend at either end.
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn lerp(t: f64, a: f64, b: f64) -> f64 {
    a + t * (b - a)
}

fn permuted(i: u8) -> u8 {
    PERMUTATION[usize::from(i)]
}

/// Fisher and Yates' shuffle, drawing from SplitMix64 (Steele, Lea and Flood 2014) with the seed 0.
const fn shuffled() -> [u8; 256] {
    let mut order = [0; 256];
    let mut i = 0;
    while i < 256 {
        order[i] = i as u8;
        i += 1;
    }
    let mut state: u64 = 0;
    while i > 1 {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let j = (z % i as u64) as usize;
        i -= 1;
        (order[i], order[j]) = (order[j], order[i]);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points all over a block of space, none on the lattice.
    fn points() -> impl Iterator<Item = DVec3> {
        (0..20_000).map(|i| {
            let i = f64::from(i);
            DVec3::new(i * 0.618_034 % 47.0 - 20.0, i * 0.754_878 % 53.0 - 30.0, i * 0.569_84 % 41.0 - 10.0)
        })
    }

    #[test]
    fn the_permutation_holds_every_number_once() {
        let mut sorted = PERMUTATION;
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(i, &n)| i == usize::from(n)));
    }

    /// The definition, written out: eight corners, each with the weight of the point opposite to it.
    #[test]
    fn noise_is_the_weighted_sum_over_eight_corners() {
        for point in points().take(2_000) {
            let base = point.floor();
            let mut sum = 0.0;
            for corner in 0..8 {
                let step = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2));
                let lattice = base + step;
                let wrapped = |c: f64| c.rem_euclid(256.0) as usize;
                let hash = usize::from(PERMUTATION[wrapped(lattice.x)]);
                let hash = usize::from(PERMUTATION[(hash + wrapped(lattice.y)) % 256]);
                let hash = PERMUTATION[(hash + wrapped(lattice.z)) % 256];
                let weight = |inside: f64, far: f64| if far == 1.0 { fade(inside) } else { 1.0 - fade(inside) };
                let inside = point - base;
                sum += GRADIENTS[usize::from(hash % 16)].dot(point - lattice)
                    * weight(inside.x, step.x)
                    * weight(inside.y, step.y)
                    * weight(inside.z, step.z);
            }
            assert!((gradient_noise(point) - sum).abs() < 1e-12, "{point}");
        }
    }

    #[test]
    fn one_scale_is_zero_on_the_lattice_but_several_are_not() {
        let mut flat = 0;
        for i in -300..300 {
            let point = DVec3::new(f64::from(i), f64::from(i * 7 % 31), f64::from(-i));
            assert_eq!(fractal_noise(point, 1), 0.0);
            flat += i32::from(fractal_noise(point, 3).abs() < 1e-3);
        }
        assert!(flat < 10, "{flat} of 600 lattice points are flat at every scale");
    }

    #[test]
    fn values_fill_the_range_and_average_to_zero() {
        for octaves in [1, 4, 16] {
            let values: Vec<f64> = points().map(|p| fractal_noise(p, octaves)).collect();
            let (least, most) = values.iter().fold((0.0_f64, 0.0_f64), |(l, m), v| (l.min(*v), m.max(*v)));
            assert!(least >= -1.0 && most <= 1.0, "{octaves} octaves: {least} to {most}");
            assert!(least < -0.5 && most > 0.5, "{octaves} octaves: {least} to {most}");
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            assert!(mean.abs() < 0.02, "{octaves} octaves: mean {mean}");
        }
    }

    #[test]
    fn noise_is_continuous_across_cells() {
        for i in -20..20 {
            let boundary = DVec3::new(f64::from(i), 0.3, 7.7);
            for point in [boundary, DVec3::new(0.3, boundary.x, 7.7), DVec3::new(0.3, 7.7, boundary.x)] {
                let step = DVec3::splat(1e-9);
                assert!((gradient_noise(point - step) - gradient_noise(point + step)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_values_never_change() {
        let hash = points().take(1_000).fold(0xcbf2_9ce4_8422_2325_u64, |hash, point| {
            (hash ^ fractal_noise(point, 5).to_bits()).wrapping_mul(0x0100_0000_01b3)
        });
        assert_eq!(hash, 0x42f2_3983_6b27_9ca0, "{hash:#x}");
    }

    #[test]
    fn no_number_breaks_it() {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, f64::MAX, -1e-300] {
            for point in [DVec3::splat(x), DVec3::new(x, 0.5, 0.5)] {
                let value = fractal_noise(point, 16);
                assert!((-1.0..=1.0).contains(&value), "{point}: {value}");
            }
        }
    }
}
