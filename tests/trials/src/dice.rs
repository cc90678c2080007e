//! Choices, taken from bytes that a fuzzer makes up, or from a seed without end.

/// Where choices come from.
#[derive(Clone, Debug)]
pub struct Dice<'b> {
    source: Source<'b>,
}

#[derive(Clone, Debug)]
enum Source<'b> {
    /// When they are used up, all further choices are the first of those that there are.
    Bytes(&'b [u8]),
    /// SplitMix64.
    Seed(u64),
}

impl<'b> Dice<'b> {
    /// Choices that bytes make, so that similar bytes make similar choices.
    pub fn of_bytes(bytes: &'b [u8]) -> Dice<'b> {
        Dice { source: Source::Bytes(bytes) }
    }

    /// Choices that look random and are the same every time.
    pub fn of_seed(seed: u64) -> Dice<'b> {
        Dice { source: Source::Seed(seed) }
    }

    fn bits(&mut self, count: usize) -> u32 {
        match &mut self.source {
            Source::Bytes(bytes) => {
                let (taken, rest) = bytes.split_at(count.min(bytes.len()));
                *bytes = rest;
                taken.iter().fold(0, |bits, byte| bits << 8 | u32::from(*byte))
            }
            Source::Seed(seed) => {
                *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
                let mut z = *seed;
                z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
                (z ^ (z >> 31)) as u32
            }
        }
    }

    /// A number from 0 to 255.
    pub fn byte(&mut self) -> u8 {
        self.bits(1) as u8
    }

    /// A whole number from 0 to less than `count`, which is from 1 to 256.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    /// True in about one of `of` cases.
    pub fn one_in(&mut self, of: usize) -> bool {
        self.below(of) == of - 1
    }

    /// One of these.
    ///
    /// # Panics
    /// If there are none.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A number from 0 to less than 1.
    pub fn unit(&mut self) -> f64 {
        f64::from(self.bits(4)) / 4_294_967_296.0
    }

    /// A number from `least` to `most`.
    pub fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// So many things.
    pub fn some<T>(&mut self, count: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..count).map(|_| make(self)).collect()
    }
}
