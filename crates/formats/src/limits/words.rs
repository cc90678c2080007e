//! Limits in words: of the command line, and of messages.

use super::{Limit, Limits, Unit};
use crate::native::suggest;
use std::str::FromStr;

impl Limit {
    /// A value with its unit: `4 GiB of textures`.
    pub(super) fn amount(self, value: u64) -> String {
        match self.unit() {
            Unit::Seconds => format!("{value} s"),
            Unit::Bytes => {
                let what = match self {
                    Limit::Memory => "memory",
                    Limit::Textures => "textures",
                    _ => "files",
                };
                format!("{} of {what}", bytes(value))
            }
            Unit::Things => format!("{value} {}", self.key()),
        }
    }

    /// A value as the command line takes it.
    pub fn shown(self, value: u64) -> String {
        match self.unit() {
            _ if value == u64::MAX => "none".to_owned(),
            Unit::Seconds => value.to_string(),
            Unit::Bytes => bytes(value).replace(' ', ""),
            Unit::Things => UNITS_OF_THOUSANDS
                .iter()
                .rfind(|(_, factor)| value >= *factor && value.is_multiple_of(*factor))
                .map_or_else(|| value.to_string(), |(word, factor)| format!("{}{word}", value / factor)),
        }
    }
}

const UNITS_OF_THOUSANDS: [(&str, u64); 4] =
    [("k", 1_000), ("M", 1_000_000), ("G", 1_000_000_000), ("T", 1_000_000_000_000)];
const UNITS_OF_BYTES: [(&str, u64); 4] = [("KiB", 1 << 10), ("MiB", 1 << 20), ("GiB", 1 << 30), ("TiB", 1 << 40)];

/// Bytes as people say them: "1.5 GiB".
fn bytes(value: u64) -> String {
    match UNITS_OF_BYTES.iter().rfind(|(_, factor)| value >= *factor) {
        None => format!("{value} bytes"),
        Some((word, factor)) if value.is_multiple_of(*factor) => format!("{} {word}", value / factor),
        Some((word, factor)) => format!("{:.1} {word}", value as f64 / *factor as f64),
    }
}

impl FromStr for Limits {
    type Err = String;

    /// From words such as `untrusted,time=60,memory=2GiB,pixels=4M`: the defaults, or the limits for scenes of strangers,
    /// but for those that are named.
    fn from_str(text: &str) -> Result<Limits, String> {
        let mut words = text.split(',').map(str::trim).peekable();
        let mut limits = Limits::default();
        if words.next_if_eq(&"untrusted").is_some() {
            limits = Limits::untrusted();
        }
        for word in words {
            let (key, value) = word.split_once('=').ok_or_else(|| match word {
                "untrusted" => "`untrusted` must come first".to_owned(),
                _ => format!("expected KEY=VALUE, for example `pixels=4M`, found `{word}`"),
            })?;
            let limit = Limit::ALL.iter().find(|limit| limit.key() == key).ok_or_else(|| unknown(key))?;
            limits.set(*limit, value_of(*limit, value)?);
        }
        Ok(limits)
    }
}

fn unknown(key: &str) -> String {
    let keys: Vec<&str> = Limit::ALL.iter().map(|limit| limit.key()).collect();
    match suggest::nearest(key, keys.iter().copied()) {
        Some(meant) => format!("there is no limit `{key}`: did you mean `{meant}`?"),
        None => format!("there is no limit `{key}`, only {}", keys.join(", ")),
    }
}

fn value_of(limit: Limit, text: &str) -> Result<u64, String> {
    if text == "none" {
        return Ok(u64::MAX);
    }
    let digits = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let factor = match limit.unit() {
        _ if unit.is_empty() => Some(1),
        Unit::Seconds => (unit == "s").then_some(1),
        Unit::Things => factor(&UNITS_OF_THOUSANDS, unit),
        // Nobody means a thousand bytes, and few mind.
        Unit::Bytes => factor(&UNITS_OF_BYTES, unit).or_else(|| factor(&UNITS_OF_BYTES, &format!("{unit}iB"))),
    };
    let expected = match limit.unit() {
        Unit::Seconds => "a number of seconds",
        Unit::Bytes => "bytes, for example 500MiB or 2GiB",
        Unit::Things => "a number, for example 500k or 4M",
    };
    let wrong = || format!("{}: expected {expected}, found `{text}`", limit.key());
    let (number, factor): (f64, u64) = (number.parse().map_err(|_| wrong())?, factor.ok_or_else(wrong)?);
    let amount = number * factor as f64;
    // Parts of a byte are let pass where somebody thought in larger units.
    let is_whole = amount.fract() == 0.0 || (factor > 1 && limit.unit() == Unit::Bytes);
    if !is_whole {
        return Err(format!("{}: expected a whole number, found `{text}`", limit.key()));
    }
    // What is too large for an integer becomes the largest: no limit.
    let value = amount as u64;
    let most = Limits::default().max_nesting;
    if limit == Limit::Nesting && value > most {
        return Err(format!("nesting: at most {most} is possible, found `{text}`"));
    }
    Ok(value)
}

fn factor(units: &[(&str, u64)], word: &str) -> Option<u64> {
    units.iter().find(|(unit, _)| unit.eq_ignore_ascii_case(word)).map(|(_, factor)| *factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Limits, String> {
        text.parse()
    }

    #[test]
    fn words_become_limits() {
        let limits = read("time=60,memory=2GiB,pixels=4M,samples=1.5k,file=100MiB,values=none").unwrap();
        let expected = Limits {
            max_seconds: 60,
            max_memory: 2 << 30,
            max_pixels: 4_000_000,
            max_samples: 1500,
            max_file_bytes: 100 << 20,
            max_values: u64::MAX,
            ..Limits::default()
        };
        assert_eq!(limits, expected);
        assert_eq!(read("untrusted").unwrap(), Limits::untrusted());
        assert_eq!(read("untrusted,time=5s").unwrap(), Limits { max_seconds: 5, ..Limits::untrusted() });
    }

    #[test]
    fn wrong_words_get_help() {
        assert_eq!(read("pixel=4").unwrap_err(), "there is no limit `pixel`: did you mean `pixels`?");
        assert!(read("xyzzy=4").unwrap_err().contains("only time, memory, pixels"));
        assert!(read("pixels=4MiB").unwrap_err().contains("for example 500k or 4M, found `4MiB`"));
        assert!(read("pixels=-1").unwrap_err().contains("pixels: expected a number"));
        assert!(read("memory=").unwrap_err().contains("memory: expected bytes"));
        assert!(read("pixels").unwrap_err().contains("expected KEY=VALUE"));
        assert!(read("time=1,untrusted").unwrap_err().contains("must come first"));
        assert!(read("").is_err());
        for parts in ["pixels=1.5", "pixels=1.0005k", "time=0.5", "memory=1.5", "nesting=1.5"] {
            assert!(read(parts).unwrap_err().contains("expected a whole number"), "{parts}");
        }
        assert_eq!(read("memory=1.3GiB").unwrap().max_memory, 1_395_864_371);
        assert_eq!(read("nesting=201").unwrap_err(), "nesting: at most 200 is possible, found `201`");
        assert_eq!(read("nesting=200").unwrap().max_nesting, 200);
    }

    #[test]
    fn what_is_shown_can_be_read() {
        for limits in [Limits::default(), Limits::untrusted()] {
            let shown = |limit: &Limit| format!("{}={}", limit.key(), limit.shown(limits.get(*limit)));
            let words: Vec<String> = Limit::ALL.iter().map(shown).collect();
            assert_eq!(read(&words.join(",")).unwrap(), limits, "{words:?}");
        }
    }
}
