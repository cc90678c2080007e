//! Short numbers that tell data apart: equal data have equal ones, on every machine, and others, in practice, never.

use std::fmt;
use twox_hash::XxHash3_128;

/// A hash of 128 bits, XXH3 without a seed. Against chance, not against those who make data fit. Shown as 32 hexadecimal
/// digits, as `xxhsum -H2` does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(pub u128);

impl Fingerprint {
    /// That of bytes.
    pub fn of(bytes: &[u8]) -> Fingerprint {
        Fingerprint(XxHash3_128::oneshot(bytes))
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `xxhsum -H2` gives them.
    #[test]
    fn known_answers() {
        assert_eq!(Fingerprint::of(b"").to_string(), "99aa06d3014798d86001c324468d497f");
        assert_eq!(Fingerprint::of(b"same scene, same bytes").to_string(), "84edc6e3af94ccbd629b5b903271d6a8");
    }

    #[test]
    fn one_bit_changes_it() {
        let data: Vec<u8> = (0..2000_u32).map(|i| (i * 7) as u8).collect();
        for at in [0, 3, 17, 128, 240, 241, 1999] {
            let mut other = data.clone();
            other[at] ^= 1;
            assert_ne!(Fingerprint::of(&data), Fingerprint::of(&other), "{at}");
        }
    }
}
