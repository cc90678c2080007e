//! The progress bar, on a terminal only.

use durer::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};

/// Shows how far rendering has come, and stops it when a flag is set.
pub(super) struct Bar<'a> {
    bar: ProgressBar,
    stop: &'a AtomicBool,
}

impl Bar<'_> {
    /// A bar on standard error; hidden if that is no terminal.
    pub(super) fn new(stop: &AtomicBool, hidden: bool) -> Bar<'_> {
        let shown = !hidden && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(None, target);
        let template = "{wide_bar} {percent:>3} %  {elapsed} so far, {eta} to go";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Bar { bar, stop }
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
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
