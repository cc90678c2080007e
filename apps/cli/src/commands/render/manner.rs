//! How a render is carried out and told of, whether it is a new one or goes on with an old one.

use crate::progress::{ProgressFormat, Show};
use clap::{Args, ValueEnum};
use std::time::Instant;

/// Options that change no pixel.
#[derive(Args, Debug)]
pub(crate) struct Manner {
    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_negative_numbers = true)]
    pub(super) threads: Option<u16>,

    /// Print statistics to standard output, in place of the line at the end
    #[arg(long, value_name = "FORMAT")]
    pub(super) stats: Option<StatsFormat>,

    /// How progress is shown
    #[arg(long, value_name = "HOW", default_value = "bar")]
    progress: ProgressFormat,

    /// Show neither the bar nor the line at the end, only warnings and errors
    #[arg(short, long)]
    pub(super) quiet: bool,
}

/// How statistics are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StatsFormat {
    /// As a JSON object
    Json,
}

impl Manner {
    /// True if only warnings and errors are shown.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// How progress is shown from now on.
    pub(super) fn show(&self) -> Show {
        match self.progress {
            ProgressFormat::Json => Show::Json(Instant::now()),
            ProgressFormat::Bar => Show::unless(self.quiet),
        }
    }
}
