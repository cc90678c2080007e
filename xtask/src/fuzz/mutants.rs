//! Input made of seeds by a few edits: the same each time, for it knows nothing of what the code does with it.

use durer_trials::Dice;

/// No mutant has more bytes.
pub(super) const MOST_BYTES: usize = 8192;

/// What may stand where a number stands in a text.
const NUMBERS: [&str; 16] = [
    "0",
    "-0",
    "1",
    "-1",
    "1e-30",
    "1e30",
    "1e308",
    "1e999",
    "-1e18",
    "255",
    "65536",
    "2147483648",
    "4294967295",
    "18446744073709551616",
    "nan",
    ".inf",
];
/// What may stand where a byte stands, or all bytes of a binary number.
const BYTES: [u8; 8] = [0, 1, 0x20, 0x3f, 0x7f, 0x80, 0xfe, 0xff];

/// The mutant with this number.
pub(super) fn mutant(seeds: &[Vec<u8>], number: u32) -> Vec<u8> {
    let mut dice = Dice::of_seed(u64::from(number) << 32);
    let mut bytes = seeds[any(&mut dice, seeds.len())].clone();
    bytes.truncate(MOST_BYTES);
    // Mostly few, since many leave nothing that is understood.
    for _ in 0..1 << dice.below(4) {
        let other = &seeds[any(&mut dice, seeds.len())];
        bytes = edited(bytes, other, &mut dice);
        bytes.truncate(MOST_BYTES);
    }
    bytes
}

/// One edit.
fn edited(mut bytes: Vec<u8>, other: &[u8], dice: &mut Dice<'_>) -> Vec<u8> {
    let start = any(dice, bytes.len() + 1);
    let end = (start + length(dice)).min(bytes.len());
    match dice.below(10) {
        0 if start < end => bytes[start] ^= 1 << dice.below(8),
        1 if start < end => bytes[start] = dice.byte(),
        2 => {
            let byte = dice.one_of(&BYTES);
            bytes[start..end].fill(byte);
        }
        3 => drop(bytes.drain(start..end)),
        4 => {
            let copy = bytes[start..end].to_vec();
            let to = any(dice, bytes.len() + 1);
            drop(bytes.splice(to..to, copy));
        }
        5 => {
            let from = any(dice, other.len() + 1);
            let taken = &other[from..(from + length(dice)).min(other.len())];
            drop(bytes.splice(start..end, taken.iter().copied()));
        }
        6 => bytes.truncate(start),
        _ => {
            let number = bytes[start..].iter().position(u8::is_ascii_digit).map_or(start, |digit| start + digit);
            let is_number = |byte: &u8| byte.is_ascii_digit() || b".-+eE".contains(byte);
            let digits = bytes[number..].iter().take_while(|byte| is_number(byte)).count();
            drop(bytes.splice(number..number + digits, dice.one_of(&NUMBERS).bytes()));
        }
    }
    bytes
}

/// From 0 to less than this, at least 0.
fn any(dice: &mut Dice<'_>, count: usize) -> usize {
    (dice.unit() * count as f64) as usize
}

/// How long a run of bytes is: mostly short.
fn length(dice: &mut Dice<'_>) -> usize {
    let most = 2 << dice.below(7);
    1 + any(dice, most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mutants_are_the_same_each_time_and_differ_from_each_other() {
        let seeds = [b"radius: 1.5\ncolor: [0.1, 0.2, 0.3]\n".to_vec(), vec![0; 20_000], Vec::new()];
        let mutants: Vec<_> = (0..1000).map(|number| mutant(&seeds, number)).collect();
        assert_eq!(mutants, (0..1000).map(|number| mutant(&seeds, number)).collect::<Vec<_>>());
        assert!(mutants.iter().all(|bytes| bytes.len() <= MOST_BYTES));
        let mut different = mutants;
        different.sort_unstable();
        different.dedup();
        assert!(different.len() > 800, "{} of 1000", different.len());
    }
}
