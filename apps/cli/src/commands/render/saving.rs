//! Whether, where and how often checkpoints are written.

use super::saver::When;
use clap::Args;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Options of checkpoints.
#[derive(Args, Debug)]
#[command(next_help_heading = "Checkpoints")]
pub(super) struct Saving {
    /// Keep what is finished in this file from time to time, so that `durer resume FILE` can go on [default: the
    /// picture's name with .durer-checkpoint, once it is clear that the render takes over a minute]
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,

    /// Write no checkpoints
    #[arg(long, conflicts_with = "checkpoint")]
    pub(super) no_checkpoint: bool,

    /// Seconds between checkpoints; more if writing one takes long
    #[arg(long, value_name = "SECONDS", default_value = "20", value_parser = seconds, allow_negative_numbers = true)]
    checkpoint_every: Duration,
}

impl Saving {
    /// When checkpoints are written, and how often.
    pub(super) fn times(&self) -> (When, Duration) {
        let when = match (&self.checkpoint, self.no_checkpoint) {
            (Some(_), _) => When::Always,
            (None, true) => When::Never,
            (None, false) => When::IfLong,
        };
        (when, self.checkpoint_every)
    }

    /// The checkpoints of a picture.
    pub(super) fn path(&self, picture: &Path) -> PathBuf {
        self.checkpoint.clone().unwrap_or_else(|| {
            let mut name: OsString = picture.as_os_str().to_owned();
            name.push(".durer-checkpoint");
            PathBuf::from(name)
        })
    }
}

/// As `--time` takes them: parts of seconds, too.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: Option<f64> = text.parse().ok();
    let seconds = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or_else(|| "expected a number of seconds from 0 up, for example 20 or 0.5".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_have_parts() {
        for (text, milliseconds) in [("20", 20_000), ("0.5", 500), ("0", 0), ("1e-3", 1), ("1e9", 1_000_000_000_000)] {
            assert_eq!(seconds(text), Ok(Duration::from_millis(milliseconds)));
        }
        for wrong in ["", "-1", "nan", "inf", "1e300", "1s", "0,5"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
