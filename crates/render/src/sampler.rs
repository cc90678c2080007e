//! Random numbers: pure functions of seed, pixel, number of the sample and purpose.
//!
//! Each purpose gets a pair of numbers, a point of the unit square, from a sequence of its own (padding). The samples of
//! one pixel follow Sobol's (0, 2)-sequence, and neighbors share the work: in every block of 2ʲ × 2ʲ pixels of a tile, the
//! first 2ᵏ samples of all pixels together are a (0, k + 2j, 2)-net, whatever k and j. So the error of a pixel falls as
//! fast as that of Sobol's sequence, and what is left of it differs from pixel to pixel (blue noise), as with the orders
//! along a Z-curve of Ahmed and Wonka, "Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical
//! ordering of pixels", ACM TOG 39(6), 2020. Theirs must know how many samples there will be; here no sample depends on
//! that, so that more can follow, and parts can be merged. How, is told in `sequence.rs`.
//!
//! The order of samples and of pixels is shuffled for each pair, and the points are scrambled as Owen's method does, both
//! by hashing (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). Shuffled are digits of base 4, so that
//! the nets are those of powers of four: with base 2, of two samples next to each other one would be in the left halves of
//! two pairs and the other in the right halves, or crosswise, always; the error of what depends on both would double. The
//! place in the pixel comes in its own order, with nets for each power of two.

mod sequence;
#[cfg(test)]
mod tests;

use durer_math::DVec2;
use sequence::{owen_scramble, shuffle};

/// What a pair of random numbers is for. A new purpose shifts no other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// The place within the pixel.
    Pixel,
    /// The place on the lens.
    Lens,
    /// Which light.
    Light,
    /// Where on the light.
    LightPoint,
    /// Which of the ways in which a surface scatters.
    Lobe,
    /// In which direction it does.
    Direction,
    /// Whether there is a surface at all, where it is but partly there.
    Opacity,
    /// Whether the path goes on.
    Roulette,
    /// Which caster throws light, and how.
    Caster,
}

/// The random numbers of one sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    /// Of the tile that the pixel lies in.
    key: u64,
    /// The pixel's place in the tile along the Z-curve, its bits reversed.
    pixel: u32,
    /// The sample's number, its bits reversed.
    index: u32,
}

/// The edge of a tile is 2 to this power, in pixels: errors are spread within tiles.
const TILE_BITS: u32 = 4;

impl Sampler {
    /// Those of a sample of a pixel.
    pub(crate) fn new(seed: u32, (x, y): (u32, u32), sample: u32) -> Sampler {
        let tile = u64::from(x >> TILE_BITS) << 32 | u64::from(y >> TILE_BITS);
        Sampler {
            key: mix(mix(u64::from(seed)) ^ tile),
            pixel: sequence::z_curve(x, y, TILE_BITS).reverse_bits(),
            index: sample.reverse_bits(),
        }
    }

    /// Those of a ray of the eye that belongs to no pixel alone, through a place of the picture.
    pub(crate) fn of_place(seed: u32, at: DVec2) -> Sampler {
        Sampler { key: mix(mix(at.x.to_bits() ^ mix(u64::from(seed))) ^ at.y.to_bits()), pixel: 0, index: 0 }
    }

    /// Those of one of several rays that a sample is split into: of this number, less than `count`. Together they are as
    /// well distributed as so many samples, if their count is a power of two.
    pub(crate) fn split(&self, number: u32, count: u32) -> Sampler {
        let index = self.index.reverse_bits().wrapping_mul(count).wrapping_add(number);
        Sampler { index: index.reverse_bits(), ..*self }
    }

    /// Others for the same sample, that have nothing to do with these.
    pub(crate) fn another(&self) -> Sampler {
        Sampler { key: mix(self.key), ..*self }
    }

    /// A number from 0 to less than 1, for the surface that the ray of this depth has hit (0 before there is any).
    pub(crate) fn one(&self, depth: u32, purpose: Purpose) -> f64 {
        self.at(depth, purpose).x
    }

    /// A point of the unit square, right and upper edge excluded.
    pub(crate) fn two(&self, depth: u32, purpose: Purpose) -> DVec2 {
        self.at(depth, purpose)
    }

    /// Inlined, so that the compiler drops the coordinate that is not looked at.
    #[inline(always)]
    fn at(&self, depth: u32, purpose: Purpose) -> DVec2 {
        let pair = self.key.wrapping_add((u64::from(depth) << 8 | purpose as u64).wrapping_mul(GOLDEN));
        let (order, scramble) = (mix(pair), mix(pair ^ 0x5851_f42d_4c95_7f2d));
        let index = if purpose == Purpose::Pixel { self.index } else { shuffle(self.index, order as u32) };
        let pixel = shuffle(self.pixel, (order >> 32) as u32);
        let [x, y] = sequence::point(index, pixel);
        let unit = |bits: u32, key: u32| f64::from(owen_scramble(bits, key)) / 4_294_967_296.0;
        DVec2::new(unit(x, scramble as u32), unit(y, (scramble >> 32) as u32))
    }
}

/// 2⁶⁴ divided by the golden ratio, odd.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finalizer of SplitMix64 (Steele, Lea, Flood 2014).
fn mix(bits: u64) -> u64 {
    let bits = bits.wrapping_add(GOLDEN);
    let bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}
