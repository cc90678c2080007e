//! How much a scene may ask for, so that those of strangers can be rendered: one table, from which come the fields, the
//! words of the command line, the defaults, and what messages say.
//!
//! Loading keeps those that bound what it reads, each before it takes the memory; the rest is for whoever renders.

pub(crate) mod textures;
mod words;

use std::fmt;

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
    Samples max_samples "samples" Things = 100_000_000_000_000, 1_000_000_000_000
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

#[cfg(test)]
mod tests {
    use super::*;

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
