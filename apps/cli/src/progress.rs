//! What the program is doing: on a terminal a line while it reads or builds and a bar while it renders, or a JSON object a
//! line for programs.

use crate::output;
use crate::pace::Pace;
use clap::ValueEnum;
use durer::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use serde_json::json;
use std::fmt::Write;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How often a line moves.
const BEAT: Duration = Duration::from_millis(100);

/// Between two JSON objects about the same thing.
const JSON_BEAT: Duration = Duration::from_millis(250);

/// Whether progress is shown, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Show {
    /// On standard error, if that is a terminal.
    Progress,
    /// One JSON object a line on standard error; the time is that of the program's start.
    Json(Instant),
    /// Nothing is.
    Nothing,
}

/// How progress is shown, as options say it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressFormat {
    /// A bar, if standard error is a terminal
    #[default]
    Bar,
    /// A JSON object a line, on standard error
    Json,
}

/// A line that shows that something goes on; it vanishes when this is dropped.
pub(crate) struct Phase(ProgressBar);

impl Phase {
    /// Shows what goes on: `reading`, `room.yaml`.
    pub(crate) fn begin(doing: &str, what: &str, show: Show) -> Phase {
        let line = ProgressBar::with_draw_target(None, show.target());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  {elapsed}") {
            line.set_style(style);
        }
        if !line.is_hidden() {
            line.set_message(format!("{doing} {what}"));
            line.enable_steady_tick(BEAT);
        }
        show.tell(doing, None);
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
    show: Show,
    began: Instant,
    pace: Arc<Mutex<Pace>>,
    /// When the last JSON object was printed.
    told: Mutex<Option<Instant>>,
    stop: &'a AtomicBool,
}

/// How far rendering has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reached {
    /// Finished pixels, or samples.
    pub(crate) finished: u64,
    /// How many there will be in all.
    pub(crate) total: u64,
    /// Seconds to go; `None` before there is something to go by.
    pub(crate) remaining: Option<f64>,
}

impl Bar<'_> {
    /// A bar, with so many pixels finished or samples taken already.
    pub(crate) fn new(stop: &AtomicBool, already: u64, show: Show) -> Bar<'_> {
        let bar = ProgressBar::with_draw_target(None, show.target());
        let pace = Arc::new(Mutex::new(Pace::new(already)));
        let template = "{wide_bar} {percent:>3} %  {elapsed} so far{left}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            let pace = Arc::clone(&pace);
            bar.set_style(style.with_key("left", move |state: &ProgressState, out: &mut dyn Write| {
                let pace = pace.lock().unwrap_or_else(PoisonError::into_inner);
                let remaining = pace.remaining(state.elapsed().as_secs_f64(), state.len().unwrap_or(0));
                // A line that cannot be drawn is missed by nobody.
                let _ = remaining.map_or(Ok(()), |seconds| write!(out, ", {} to go", in_words(seconds)));
            }));
        }
        if !bar.is_hidden() {
            bar.enable_steady_tick(5 * BEAT);
        }
        Bar { bar, show, began: Instant::now(), pace, told: Mutex::new(None), stop }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Seconds since the bar was made, and seconds to go until `of` is done.
    pub(crate) fn times(&self, of: u64) -> (f64, Option<f64>) {
        let elapsed = self.began.elapsed().as_secs_f64();
        (elapsed, self.pace.lock().unwrap_or_else(PoisonError::into_inner).remaining(elapsed, of))
    }
}

impl Progress for Bar<'_> {
    fn finished(&self, done: u64, of: u64) {
        let elapsed = self.began.elapsed().as_secs_f64();
        self.pace.lock().unwrap_or_else(PoisonError::into_inner).note(elapsed, done);
        if !self.bar.is_hidden() {
            self.bar.set_length(of);
            self.bar.set_position(done);
        }
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        if told.is_none_or(|told| told.elapsed() >= JSON_BEAT) {
            *told = Some(Instant::now());
            let remaining = self.times(of).1;
            self.show.tell("rendering", Some(Reached { finished: done, total: of, remaining }));
        }
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn elapsed(&self) -> Option<f64> {
        Some(self.began.elapsed().as_secs_f64())
    }
}

impl Show {
    /// Nothing, if the user wants quiet.
    pub(crate) fn unless(quiet: bool) -> Show {
        if quiet { Show::Nothing } else { Show::Progress }
    }

    /// Prints the JSON object of a phase, if that is how progress is shown.
    pub(crate) fn tell(self, phase: &str, reached: Option<Reached>) {
        let Show::Json(start) = self else { return };
        // Thousandths are enough.
        let seconds = |seconds: f64| (seconds * 1000.0).round() / 1000.0;
        let line = json!({
            "phase": phase,
            "finished": reached.map(|reached| reached.finished),
            "total": reached.map(|reached| reached.total),
            "elapsed": seconds(start.elapsed().as_secs_f64()),
            "remaining": reached.and_then(|reached| reached.remaining).map(seconds),
        });
        output::note(&line.to_string());
    }

    fn target(self) -> ProgressDrawTarget {
        match self {
            Show::Progress if std::io::stderr().is_terminal() => ProgressDrawTarget::stderr(),
            Show::Progress | Show::Json(_) | Show::Nothing => ProgressDrawTarget::hidden(),
        }
    }
}

/// A time that is not better known than that.
fn in_words(seconds: f64) -> String {
    match seconds {
        s if s < 60.0 => format!("{s:.0} s"),
        s if s < 3600.0 => format!("{:.0} min", s / 60.0),
        s if s < 48.0 * 3600.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rough() {
        let cases = [(3.4, "3 s"), (125.0, "2 min"), (5400.0, "1.5 h"), (3.6e5, "4.2 days")];
        cases.iter().for_each(|(seconds, words)| assert_eq!(in_words(*seconds), *words));
    }
}
