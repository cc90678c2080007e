//! Decimal numbers from bytes, quickly: most are short, and for those one multiplication or division is exact.

/// The powers of ten that double precision holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// A number at the beginning of some bytes.
pub(super) struct Short {
    pub(super) value: f64,
    /// Bytes that it takes.
    pub(super) length: usize,
}

/// The nearest number to a decimal, which may also be infinite or NaN.
pub(super) fn parse(text: &[u8]) -> Option<f64> {
    match short(text) {
        Some(Short { value, length }) if length == text.len() => Some(value),
        _ => std::str::from_utf8(text).ok()?.parse().ok(),
    }
}

/// The number that `bytes` begin with, if its digits and its power of ten are both exact in double precision, so that
/// one operation rounds it correctly (Clinger 1990); `None` for all others.
#[inline]
pub(super) fn short(bytes: &[u8]) -> Option<Short> {
    let mut at = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let first = at;
    let mut digits: u64 = 0;
    take_digits(bytes, &mut at, &mut digits);
    let mut count = at - first;
    let mut power = 0;
    if bytes.get(at) == Some(&b'.') {
        at += 1;
        let start = at;
        take_digits(bytes, &mut at, &mut digits);
        count += at - start;
        power = -((at - start) as i32);
    }
    // 19 digits cannot overflow.
    if count == 0 || count > 19 {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(at) {
        power += exponent(bytes, &mut at)?;
    }
    if digits > 1 << 53 || power.unsigned_abs() > 22 {
        return None;
    }
    let scale = POWERS[power.unsigned_abs() as usize];
    let value = if power < 0 { digits as f64 / scale } else { digits as f64 * scale };
    Some(Short { value: if bytes[0] == b'-' { -value } else { value }, length: at })
}

#[inline]
fn take_digits(bytes: &[u8], at: &mut usize, digits: &mut u64) {
    while let Some(digit @ b'0'..=b'9') = bytes.get(*at) {
        *digits = digits.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        *at += 1;
    }
}

/// What stands from the `e` on; `None` if that is no exponent, or one of more than three digits.
fn exponent(bytes: &[u8], at: &mut usize) -> Option<i32> {
    *at += 1;
    let is_negative = bytes.get(*at) == Some(&b'-');
    *at += usize::from(matches!(bytes.get(*at), Some(b'-' | b'+')));
    let start = *at;
    let mut digits = 0;
    take_digits(bytes, at, &mut digits);
    let fits = (1..=3).contains(&(*at - start));
    fits.then(|| if is_negative { -(digits as i32) } else { digits as i32 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn odd_texts_are_as_the_standard_library_reads_them() {
        let texts = [
            "",
            "-",
            "+",
            ".",
            "-.",
            "e5",
            ".e5",
            "1",
            "+1",
            "-0",
            "007",
            "1.",
            ".5",
            "-.5e1",
            "1e",
            "1e+",
            "1e5",
            "1E-5",
            "1e22",
            "1e23",
            "1e-22",
            "1e-23",
            "1e-2147483648",
            "9007199254740993",
            "9007199254740992",
            "0.30000000000000004",
            "1e308",
            "1e309",
            "1e9999",
            "4.9e-324",
            "18446744073709551616",
            "99999999999999999999",
            "nan",
            "-inf",
            "infinity",
            "0x1",
            "1_000",
            "1,5",
            " 1",
            "1 ",
            "١",
        ];
        for text in texts {
            let expected = text.parse::<f64>().ok().map(f64::to_bits);
            assert_eq!(parse(text.as_bytes()).map(f64::to_bits), expected, "{text}");
        }
        assert_eq!(parse(b"\xff"), None);
    }

    proptest! {
        #[test]
        fn all_numbers_are_read_to_the_bit(x in any::<f64>(), digits in 0_usize..19, short in -1e6..1e6_f64) {
            for text in [format!("{x:?}"), format!("{x}"), format!("{short:.digits$}"), format!("{x:.digits$e}")] {
                let expected = text.parse::<f64>().unwrap();
                prop_assert_eq!(parse(text.as_bytes()).unwrap().to_bits(), expected.to_bits(), "{}", text);
            }
        }
    }
}
