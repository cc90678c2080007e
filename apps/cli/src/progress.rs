//! What the program is doing, on a terminal only: a line while it reads or builds, a bar while it renders.

use durer::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How often a line moves.
const BEAT: Duration = Duration::from_millis(100);

/// Whether progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Show {
    /// On standard error, if that is a terminal.
    Progress,
    /// Nothing is.
    Nothing,
}

/// A line that shows that something goes on; it vanishes when this is dropped.
pub(crate) struct Phase(ProgressBar);

impl Phase {
    /// Shows what goes on: `reading room.yaml`.
    pub(crate) fn begin(what: String, show: Show) -> Phase {
        let line = ProgressBar::with_draw_target(None, show.target());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  {elapsed}") {
            line.set_style(style);
        }
        if !line.is_hidden() {
            line.set_message(what);
            line.enable_steady_tick(BEAT);
        }
        Phase(line)
    }
}

impl Drop for Phase {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Shows how far rendering has come, and stops it when a flag is set.
pub(crate) struct Bar<'a> {
    bar: ProgressBar,
    stop: &'a AtomicBool,
}

impl Bar<'_> {
    /// A bar, empty so far.
    pub(crate) fn new(stop: &AtomicBool, show: Show) -> Bar<'_> {
        let bar = ProgressBar::with_draw_target(None, show.target());
        let template = "{wide_bar} {percent:>3} %  {elapsed} so far, {eta} to go";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Bar { bar, stop }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar<'_> {
    fn finished(&self, pixels: u64, of: u64) {
        if self.bar.is_hidden() {
            return;
        }
        self.bar.set_length(of);
        self.bar.set_position(pixels);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Show {
    /// Nothing, if the user wants quiet.
    pub(crate) fn unless(quiet: bool) -> Show {
        if quiet { Show::Nothing } else { Show::Progress }
    }

    fn target(self) -> ProgressDrawTarget {
        match self {
            Show::Progress if std::io::stderr().is_terminal() => ProgressDrawTarget::stderr(),
            Show::Progress | Show::Nothing => ProgressDrawTarget::hidden(),
        }
    }
}
