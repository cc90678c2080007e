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
    #[arg(long, value_name = "SECONDS", default_value_t = 20, allow_negative_numbers = true)]
    checkpoint_every: u32,
}

impl Saving {
    /// When checkpoints are written, and how often.
    pub(super) fn times(&self) -> (When, Duration) {
        let when = match (&self.checkpoint, self.no_checkpoint) {
            (Some(_), _) => When::Always,
            (None, true) => When::Never,
            (None, false) => When::IfLong,
        };
        (when, Duration::from_secs(self.checkpoint_every.into()))
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
