//! Numbers as people read them.

use durer::math::{DVec3, Rgb};

/// With six significant digits and no trailing zeros: `0.333333`, `12`, `1.5e-9`.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.5e}");
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    match exponent.parse::<i32>() {
        Ok(exponent @ -5..=8) => trimmed(&format!("{value:.*}", (5 - exponent).max(0) as usize)),
        Ok(_) | Err(_) => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

fn trimmed(digits: &str) -> String {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => digits.to_owned(),
    }
}

/// `(x, y, z)`, short.
pub(crate) fn vector(v: DVec3) -> String {
    format!("({}, {}, {})", short(v.x), short(v.y), short(v.z))
}

/// The fewest digits that give back this very number.
pub(crate) fn exact(value: f32) -> String {
    let plain = format!("{value}");
    if plain.len() <= 12 { plain } else { format!("{value:e}") }
}

/// The three components, short; one if they are equal.
pub(crate) fn color(color: Rgb) -> String {
    let [r, g, b] = color.to_array().map(|v| short(f64::from(v)));
    if r == g && g == b { r } else { format!("{r} {g} {b}") }
}

/// With commas between thousands: `1,234,567`.
pub(crate) fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// `512 bytes`, `1.2 kB`, `34.5 MB`, with thousands, not 1024.
pub(crate) fn bytes(number: u64) -> String {
    match number as f64 {
        n if n < 1e3 => format!("{number} bytes"),
        n if n < 1e6 => format!("{:.1} kB", n / 1e3),
        n if n < 1e9 => format!("{:.1} MB", n / 1e6),
        n => format!("{:.1} GB", n / 1e9),
    }
}

/// `1 light`, `3 lights`; the plural ends in `s`, after s and x in `es`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    let ending = match number {
        1 => "",
        _ if noun.ends_with(['s', 'x']) => "es",
        _ => "s",
    };
    format!("{} {noun}{ending}", thousands(number as u64))
}

/// `1 sample a pixel`, `8 samples a pixel`, `3 to 8 samples a pixel`.
pub(crate) fn samples_a_pixel(least: u32, most: u32) -> String {
    match (least, most) {
        (1, 1) => "1 sample a pixel".to_owned(),
        _ if least == most => format!("{least} samples a pixel"),
        _ => format!("{least} to {most} samples a pixel"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers() {
        let cases = [
            (0.0, "0"),
            (1.0 / 3.0, "0.333333"),
            (-12.0, "-12"),
            (100_000.0, "100000"),
            (123_456_789.0, "123456789"),
            (1.5e-9, "1.5e-9"),
            (-2e12, "-2e12"),
            (0.000_123_456_7, "0.000123457"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn exact_numbers_come_back() {
        for bits in (0..0x7f80_0000u32).step_by(9_999_991) {
            let value = f32::from_bits(bits);
            assert_eq!(exact(value).parse::<f32>().map(f32::to_bits), Ok(bits));
        }
    }

    #[test]
    fn counts() {
        assert_eq!(thousands(1_234_567), "1,234,567");
        assert_eq!(thousands(100), "100");
        assert_eq!(
            (count(1, "box"), count(2, "box"), count(0, "light")),
            ("1 box".into(), "2 boxes".into(), "0 lights".into())
        );
        assert_eq!(bytes(12_340), "12.3 kB");
        let cases = [((1, 1), "1 sample a pixel"), ((0, 0), "0 samples a pixel"), ((0, 1), "0 to 1 samples a pixel")];
        for ((least, most), words) in cases {
            assert_eq!(samples_a_pixel(least, most), words);
        }
    }
}
