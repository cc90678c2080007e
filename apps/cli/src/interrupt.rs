//! What ends a run early: Ctrl-C, SIGTERM and SIGHUP, and the time limit. Each first asks the rendering to stop, and ends the
//! program if that is not enough: the second Ctrl-C, or some more time.

use crate::exit::{self, Exit, Failure};
use crate::output;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Knows whether to stop, and the temporary files, so that none is left behind if the program must end at once.
///
/// It knows the names only: what it has is never dropped, for the system may call it until the end.
#[derive(Clone)]
pub(crate) struct Interrupt {
    stop: Arc<AtomicBool>,
    timed_out: Arc<AtomicBool>,
    temporary: Arc<Mutex<Vec<PathBuf>>>,
}

impl Interrupt {
    /// Stops after so long a time, if any; a tenth of it later, or a second, the program ends even if it is reading or
    /// building, which cannot be stopped.
    pub(crate) fn after(limit: Option<Duration>) -> Interrupt {
        let interrupt = Interrupt { stop: Arc::default(), timed_out: Arc::default(), temporary: Arc::default() };
        if let Some(limit) = limit {
            let watched = interrupt.clone();
            std::thread::spawn(move || watched.keep(limit));
        }
        interrupt
    }

    fn keep(&self, limit: Duration) {
        std::thread::sleep(limit);
        self.timed_out.store(true, Ordering::Relaxed);
        self.stop.store(true, Ordering::Relaxed);
        std::thread::sleep((limit / 10).max(Duration::from_secs(1)));
        self.remove_temporaries();
        output::error(&format!("the time limit of {} s is reached (see `--limits time`)", limit.as_secs()));
        exit::at_once();
    }

    /// Begins to watch for Ctrl-C and the like.
    pub(crate) fn watch(&self) {
        let watched = self.clone();
        let pressed = move || {
            if watched.stop.swap(true, Ordering::Relaxed) {
                watched.remove_temporaries();
                exit::at_once();
            }
        };
        if let Err(error) = ctrlc::set_handler(pressed) {
            output::warning(&format!("Ctrl-C will not save what is finished: {error}"));
        }
    }

    fn remove_temporaries(&self) {
        for temporary in &*self.temporary.lock().unwrap_or_else(PoisonError::into_inner) {
            // It may have got its name just now.
            let _ = std::fs::remove_file(temporary);
        }
    }

    /// A file that is removed if the program must end at once.
    pub(crate) fn removes(&self, temporary: &Path) {
        self.temporary.lock().unwrap_or_else(PoisonError::into_inner).push(temporary.to_owned());
    }

    /// True once the run is to stop.
    pub(crate) fn stop_flag(&self) -> &AtomicBool {
        &self.stop
    }

    /// # Errors
    /// If the run is to stop: for commands that have no use for half of what they make.
    pub(crate) fn stopped(&self) -> Result<(), Failure> {
        match self.stop.load(Ordering::Relaxed) {
            true => Err(Failure::Message(Exit::Interrupted, self.reason().to_owned())),
            false => Ok(()),
        }
    }

    /// What it was, for messages.
    pub(crate) fn reason(&self) -> &'static str {
        if self.timed_out.load(Ordering::Relaxed) { "stopped by the time limit" } else { "interrupted" }
    }
}
