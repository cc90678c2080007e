//! Random numbers and hashes that are the same in every language.

use crate::vector::Vector;

/// 2⁶⁴ divided by the golden ratio.
pub const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Steele, Lea and Flood's SplitMix64 ("Fast splittable pseudorandom number generators", 2014), from a state.
#[derive(Clone, Copy, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next number from 0 to 1, in steps of 2⁻²⁴: exact in single precision too.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        unit(mix(self.0))
    }

    /// The next point of the unit cube.
    pub fn in_cube(&mut self) -> Vector {
        Vector::from_fn(|_| self.unit())
    }

    /// The next direction, evenly distributed: a point in the ball, found by rejection.
    pub fn direction(&mut self) -> Vector {
        loop {
            let point = Vector::from_fn(|_| 2.0 * self.unit() - 1.0);
            let squared = point.dot(point);
            if (1e-9..=1.0).contains(&squared) {
                return point * (1.0 / squared.sqrt());
            }
        }
    }
}

/// The finalizer of SplitMix64.
pub fn mix(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A number from 0 to 1 from the upper bits of a hash.
pub fn unit(hash: u64) -> f64 {
    (hash >> 40) as f64 * (1.0 / 16_777_216.0)
}

/// Fowler, Noll and Vo's hash FNV-1a.
pub fn fnv(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
    bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, step)
}
