//! How much a scene may ask for, so that those of strangers can be rendered: one table, from which come the fields, the
//! words of the command line, the defaults, and what messages say.
//!
//! Loading keeps those that bound what it reads, each before it takes the memory; the rest is for whoever renders.

use crate::native::suggest;
use std::fmt;
use std::str::FromStr;

/// What a limit counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Seconds,
    Bytes,
    Things,
}

/// Defines [`Limits`] and [`Limit`]: variant, field, key and unit of each limit, its default, its value for scenes of
/// strangers, and what it bounds.
macro_rules! limits {
    ($($limit:ident $field:ident $key:literal $unit:ident = $default:expr, $untrusted:expr => $about:literal;)+) => {
        /// How much a scene may ask for. `u64::MAX` stands for no limit.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub struct Limits {
            $(#[doc = $about] pub $field: u64,)+
            /// Diagnostics that are reported; the rest is counted.
            pub max_diagnostics: usize,
        }

        /// One of the [`Limits`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Limit {
            $(#[doc = $about] $limit,)+
        }

        impl Default for Limits {
            /// Enough for any scene by hand and most by program.
            fn default() -> Limits {
                Limits { $($field: $default,)+ max_diagnostics: 50 }
            }
        }

        impl Limits {
            /// For scenes of strangers: enough for a picture of a screen's size that is done in a minute or two.
            pub fn untrusted() -> Limits {
                Limits { $($field: $untrusted,)+ max_diagnostics: 50 }
            }

            /// The value of a limit.
            pub fn get(&self, limit: Limit) -> u64 {
                match limit {
                    $(Limit::$limit => self.$field,)+
                }
            }

            /// Changes a limit.
            pub fn set(&mut self, limit: Limit, value: u64) {
                match limit {
                    $(Limit::$limit => self.$field = value,)+
                }
            }
        }

        impl Limit {
            /// All of them.
            pub const ALL: &[Limit] = &[$(Limit::$limit),+];

            /// Its word on the command line.
            pub fn key(self) -> &'static str {
                match self {
                    $(Limit::$limit => $key,)+
                }
            }

            /// What it bounds, as a sentence.
            pub fn about(self) -> &'static str {
                match self {
                    $(Limit::$limit => $about,)+
                }
            }

            fn unit(self) -> Unit {
                match self {
                    $(Limit::$limit => Unit::$unit,)+
                }
            }
        }
    };
}

limits! {
    Time max_seconds "time" Seconds = u64::MAX, 120
        => "Seconds of the whole run by the clock on the wall.";
    Memory max_memory "memory" Bytes = 64 << 30, 1 << 30
        => "Bytes of memory, estimated before they are taken: film, geometry, search trees and textures.";
    Pixels max_pixels "pixels" Things = 400_000_000, 4_000_000
        => "Pixels of the picture.";
    Samples max_samples "samples" Things = 1_000_000_000_000, 100_000_000
        => "Rays of the eye in the whole picture, as many as anti-aliasing can ask for.";
    Primitives max_primitives "primitives" Things = 400_000_000, 2_000_000
        => "Shapes, triangles and particles; those in copies count once, and each copy of an object counts as one.";
    Textures max_texture_bytes "textures" Bytes = 4 << 30, 256 << 20
        => "Bytes of all images, unpacked.";
    Scene max_bytes "scene" Bytes = 64 << 20, 4 << 20
        => "Bytes of the scene file.";
    File max_file_bytes "file" Bytes = 8 << 30, 32 << 20
        => "Bytes of each other file: image, model, part of a model, table of numbers.";
    Files max_total_bytes "files" Bytes = 32 << 30, 128 << 20
        => "Bytes of all files that a scene names, together.";
    Values max_values "values" Things = 5_000_000, 500_000
        => "Values in the scene file, those of aliases counted at each use; objects that models bring.";
    Nesting max_nesting "nesting" Things = 200, 100
        => "Lists in mappings in lists …; at most 200, whatever is set.";
}

/// A scene asks for more than it may.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exceeded {
    /// Which limit.
    pub limit: Limit,
    /// What the scene asks for, if that is known; it is above `allowed`.
    pub asked: Option<u64>,
    /// The value of the limit.
    pub allowed: u64,
}

impl fmt::Display for Exceeded {
    /// As in "8 GiB of textures are more than the 4 GiB that are allowed".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let amount = |value| self.limit.amount(value);
        match self.asked {
            Some(asked) => write!(f, "it asks for {}, but only {} are allowed", amount(asked), amount(self.allowed)),
            None => write!(f, "it asks for more than the {} that are allowed", amount(self.allowed)),
        }
    }
}

impl std::error::Error for Exceeded {}

impl Exceeded {
    /// What to do about it, if the scene is trusted.
    pub fn help(&self) -> String {
        let enough = match (self.asked, self.limit.unit()) {
            (Some(asked), Unit::Bytes) => format!("{}MiB", asked.div_ceil(1 << 20)),
            (Some(asked), Unit::Seconds | Unit::Things) => asked.to_string(),
            (None, _) => "…".to_owned(),
        };
        format!("if you trust this scene, raise the limit: `--limits {}={enough}`", self.limit.key())
    }
}

impl Limit {
    /// A value with its unit: `4 GiB of textures`.
    fn amount(self, value: u64) -> String {
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
    let number: f64 = number.parse().map_err(|_| wrong())?;
    // What is too large for an integer becomes the largest: no limit.
    Ok((number * factor.ok_or_else(wrong)? as f64) as u64)
}

fn factor(units: &[(&str, u64)], word: &str) -> Option<u64> {
    units.iter().find(|(unit, _)| unit.eq_ignore_ascii_case(word)).map(|(_, factor)| *factor)
}

/// Images: what is left for them, and what to say of those that are too large.
pub(crate) mod textures {
    use super::{Limit, Limits};
    use durer_imaging::{DecodeError, DecodeLimits};

    /// What one more image may take if others take so many bytes.
    pub(crate) fn left(limits: &Limits, taken: u64) -> DecodeLimits {
        DecodeLimits { max_pixels: u64::MAX, max_bytes: limits.max_texture_bytes.saturating_sub(taken) }
    }

    /// What to do about an image that cannot be had.
    pub(crate) fn help(error: &DecodeError) -> Option<String> {
        let key = Limit::Textures.key();
        let too_large = matches!(error, DecodeError::TooManyBytes { .. } | DecodeError::TooManyPixels { .. });
        too_large.then(|| format!("if you trust this scene, raise the limit for all images: `--limits {key}=…`"))
    }
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
    }

    #[test]
    fn what_is_shown_can_be_read() {
        for limits in [Limits::default(), Limits::untrusted()] {
            let shown = |limit: &Limit| format!("{}={}", limit.key(), limit.shown(limits.get(*limit)));
            let words: Vec<String> = Limit::ALL.iter().map(shown).collect();
            assert_eq!(read(&words.join(",")).unwrap(), limits, "{words:?}");
        }
    }

    #[test]
    fn strangers_get_less_of_everything() {
        let (all, few) = (Limits::default(), Limits::untrusted());
        assert!(Limit::ALL.iter().all(|limit| few.get(*limit) < all.get(*limit)));
    }

    #[test]
    fn messages_name_limit_values_and_option() {
        let exceeded = Exceeded { limit: Limit::Pixels, asked: Some(5000), allowed: 4000 };
        assert_eq!(exceeded.to_string(), "it asks for 5000 pixels, but only 4000 pixels are allowed");
        assert!(exceeded.help().ends_with("raise the limit: `--limits pixels=5000`"), "{}", exceeded.help());
        let exceeded = Exceeded { limit: Limit::Memory, asked: Some((3 << 30) + 1), allowed: 1 << 30 };
        assert_eq!(exceeded.to_string(), "it asks for 3.0 GiB of memory, but only 1 GiB of memory are allowed");
        assert!(exceeded.help().contains("`--limits memory=3073MiB`"));
    }
}
