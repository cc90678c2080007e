//! Ctrl-C: the first one asks the rendering to stop, the second one ends the program.

use crate::{exit, output};
use durer::PictureFile;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Watches for Ctrl-C, and keeps the file that is to be written, so that none is left behind if the program must end.
pub(super) struct Interrupt {
    stop: Arc<AtomicBool>,
    file: Arc<Mutex<Option<PictureFile>>>,
}

impl Interrupt {
    /// Begins to watch.
    pub(super) fn new(file: PictureFile) -> Interrupt {
        let interrupt = Interrupt { stop: Arc::default(), file: Arc::new(Mutex::new(Some(file))) };
        let (stop, file) = (Arc::clone(&interrupt.stop), Arc::clone(&interrupt.file));
        let pressed = move || {
            if stop.swap(true, Ordering::Relaxed) {
                drop(take(&file));
                exit::at_once();
            }
        };
        if let Err(error) = ctrlc::set_handler(pressed) {
            output::warning(&format!("Ctrl-C will not save what is finished: {error}"));
        }
        interrupt
    }

    /// True from the first Ctrl-C on.
    pub(super) fn stop_flag(&self) -> &AtomicBool {
        &self.stop
    }

    /// Gives the file, the first time.
    pub(super) fn take_file(&self) -> Option<PictureFile> {
        take(&self.file)
    }
}

fn take(file: &Mutex<Option<PictureFile>>) -> Option<PictureFile> {
    file.lock().unwrap_or_else(PoisonError::into_inner).take()
}
