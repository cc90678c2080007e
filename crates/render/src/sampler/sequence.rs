//! The points behind the random numbers: two digital sequences of base 2, in two variables, that fit each other.
//!
//! Sobol's first two dimensions can be read as power series: sample number i, with bits i₀ i₁ i₂ …, stands for the
//! polynomial i₀ + i₁ z + i₂ z² + … over the field of two elements; the coefficients of its expansion around z = 0 are the
//! binary digits of x, and those around z = 1 of y. The first 2ᵏ samples are the polynomials of degree less than k, and one
//! of these that vanishes to order a at 0 and to order b at 1, with a + b ≥ k, is zero: so each elementary interval has
//! exactly one point, which is what a (0, k, 2)-net is.
//!
//! Pixels continue this on the other side (the construction is one of Niederreiter and Xing, "Low-discrepancy sequences and
//! global function fields with many rational places", 1996, for the rational functions): with p = 1 + z + z², which has no
//! root, the j-th digit of base 4 along the Z-curve stands for (a + b z) / pʲ. The first 2ᵏ samples of the pixels that differ
//! in their first j digits are the functions with no pole but of order j at p and of order k - 1 at infinity: a space of
//! dimension k + 2j, in which a function with k + 2j zeros is zero. So they are a net as well.

/// The first 32 digits of x and of y, highest first, for the sample and the pixel in a tile, both with their bits reversed.
#[inline]
pub(super) fn point(index: u32, pixel: u32) -> [u32; 2] {
    let [x, y] = PIXELS[(pixel >> 24) as usize];
    [index ^ x, around_one(index) ^ y]
}

/// From the expansion around 0 to that around 1: the digit r of y is the sum of all digits s of x for which the binomial of
/// s over r is odd, which is where s has all bits of r (Lucas), so that it goes bit by bit of s.
#[inline]
const fn around_one(x: u32) -> u32 {
    let x = x ^ (x & 0x5555_5555) << 1;
    let x = x ^ (x & 0x3333_3333) << 2;
    let x = x ^ (x & 0x0f0f_0f0f) << 4;
    let x = x ^ (x & 0x00ff_00ff) << 8;
    x ^ x << 16
}

/// What each of the 256 pixels of a tile adds to x and y, by the reversed bits of its place.
static PIXELS: [[u32; 2]; 256] = pixels();

const fn pixels() -> [[u32; 2]; 256] {
    let mut columns = [[0; 2]; 8];
    // Around 0 and around 1, p is the same: 1 + u + u² with u = z - 1.
    let mut power = 1 << 31;
    let mut digit = 0;
    while digit < 4 {
        power = over_p(power);
        columns[2 * digit] = [power, power];
        columns[2 * digit + 1] = [power >> 1, power ^ power >> 1];
        digit += 1;
    }
    let mut all = [[0; 2]; 256];
    let mut place = 0;
    while place < 256 {
        let mut bit = 0;
        while bit < 8 {
            if place >> (7 - bit) & 1 == 1 {
                all[place] = [all[place][0] ^ columns[bit][0], all[place][1] ^ columns[bit][1]];
            }
            bit += 1;
        }
        place += 1;
    }
    all
}

/// Divides a power series, its lowest coefficient in the highest bit, by 1 + z + z²: 1 / p = (1 + z) / (1 + z³).
const fn over_p(series: u32) -> u32 {
    let series = series ^ series >> 1;
    let mut sum = series;
    let mut shift = 3;
    while shift < 32 {
        sum ^= series >> shift;
        shift += 3;
    }
    sum
}

/// The place of a pixel along the Z-curve through a tile of 2ⁿ pixels along its edges.
pub(super) fn z_curve(x: u32, y: u32, n: u32) -> u32 {
    (0..n).fold(0, |place, bit| place | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1))
}

/// A permutation of numbers with reversed bits, in which each digit of base 4 is permuted in a way that depends on all
/// higher digits: what lies together in blocks of 4ⁿ numbers stays together.
#[inline]
pub(super) fn shuffle(bits: u32, key: u32) -> u32 {
    // Flips of base 2 on both sides of a sum within digits make nearly all permutations of four.
    let bits = flip(bits, key);
    let below = bits.wrapping_add(key.rotate_left(11)).wrapping_mul(0x9e37_79b1);
    let bits = bits ^ (bits >> 1 & below << 1 & 0x5555_5555);
    flip(bits, key.rotate_left(16) ^ 0x85eb_ca6b)
}

/// Owen's scrambling: each bit is flipped, or not, depending on all higher bits.
#[inline]
pub(super) fn owen_scramble(bits: u32, key: u32) -> u32 {
    flip(bits.reverse_bits(), key).reverse_bits()
}

/// Flips each bit, or not, depending on all lower bits: the hash of Laine and Karras, "Stratified Sampling for Stochastic
/// Transparency", EGSR 2011, with the multipliers that Vegdahl found ("Building a Better LK Hash", 2021).
#[inline]
fn flip(bits: u32, key: u32) -> u32 {
    let bits = bits ^ bits.wrapping_mul(0x3d20_adea);
    let bits = bits.wrapping_add(key);
    let bits = bits.wrapping_mul(key >> 16 | 1);
    let bits = bits ^ bits.wrapping_mul(0x0552_6c56);
    bits ^ bits.wrapping_mul(0x53a2_2864)
}
