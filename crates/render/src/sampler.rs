//! Random numbers: pure functions of seed, pixel, sample and purpose.

use durer_math::DVec2;

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
}

/// The random numbers of one sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    key: u64,
}

impl Sampler {
    /// Those of a sample of a pixel.
    pub(crate) fn new(seed: u32, (x, y): (u32, u32), sample: u32) -> Sampler {
        let pixel = u64::from(x) << 32 | u64::from(y);
        Sampler { key: mix(mix(pixel ^ mix(u64::from(seed))) ^ u64::from(sample)) }
    }

    /// Those of a ray of the eye that belongs to no pixel alone, through a place of the picture.
    pub(crate) fn of_place(seed: u32, at: DVec2) -> Sampler {
        Sampler { key: mix(mix(at.x.to_bits() ^ mix(u64::from(seed))) ^ at.y.to_bits()) }
    }

    /// A number from 0 to less than 1, for the surface that the ray of this depth has hit (0 before there is any).
    pub(crate) fn one(&self, depth: u32, purpose: Purpose) -> f64 {
        self.two(depth, purpose).x
    }

    /// A point of the unit square, right and upper edge excluded.
    pub(crate) fn two(&self, depth: u32, purpose: Purpose) -> DVec2 {
        let bits = mix(self.key ^ mix(u64::from(depth) << 8 | purpose as u64));
        let unit = |bits: u64| (bits & 0xffff_ffff) as f64 / 4_294_967_296.0;
        DVec2::new(unit(bits), unit(bits >> 32))
    }
}

/// The finalizer of SplitMix64 (Steele, Lea, Flood 2014).
fn mix(bits: u64) -> u64 {
    let bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}
