//! Ctrl-C, SIGTERM and SIGHUP: the first one asks the rendering to stop, the second one ends the program.

use crate::{exit, output};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Watches for Ctrl-C, and knows the temporary files, so that none is left behind if the program must end at once.
///
/// It knows the names only: what it has is never dropped, for the system may call it until the end.
pub(super) struct Interrupt {
    stop: Arc<AtomicBool>,
    temporary: Arc<Mutex<Vec<PathBuf>>>,
}

impl Interrupt {
    /// Begins to watch.
    pub(super) fn new() -> Interrupt {
        let interrupt = Interrupt { stop: Arc::default(), temporary: Arc::default() };
        let (stop, temporary) = (Arc::clone(&interrupt.stop), Arc::clone(&interrupt.temporary));
        let pressed = move || {
            if stop.swap(true, Ordering::Relaxed) {
                for temporary in &*temporary.lock().unwrap_or_else(PoisonError::into_inner) {
                    // It may have got its name just now.
                    let _ = std::fs::remove_file(temporary);
                }
                exit::at_once();
            }
        };
        if let Err(error) = ctrlc::set_handler(pressed) {
            output::warning(&format!("Ctrl-C will not save what is finished: {error}"));
        }
        interrupt
    }

    /// A file that the second Ctrl-C removes.
    pub(super) fn removes(&self, temporary: &Path) {
        self.temporary.lock().unwrap_or_else(PoisonError::into_inner).push(temporary.to_owned());
    }

    /// True from the first Ctrl-C on.
    pub(super) fn stop_flag(&self) -> &AtomicBool {
        &self.stop
    }
}
