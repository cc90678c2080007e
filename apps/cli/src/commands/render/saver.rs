//! Writes checkpoints while a render goes on. Threads that trace rays wait no longer than it takes to put the film into bytes;
//! a thread of its own writes the file.

use crate::output;
use durer::{CheckedScene, Film, Origin, SceneHash, Sources, encode_checkpoint, write_whole};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// A render whose whole time is estimated to be longer gets checkpoints unasked.
const LONG_SECONDS: f64 = 60.0;

/// Between two checkpoints lies at least so many times the time that one takes.
const RARITY: u32 = 30;

/// When checkpoints are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum When {
    /// From the start.
    Always,
    /// If the render turns out to be long.
    IfLong,
    /// Not even if the picture cannot be written.
    Never,
}

/// What a render was begun with, and where its checkpoints go.
pub(super) struct Saver<'a> {
    path: PathBuf,
    origin: Origin,
    scene: (&'a CheckedScene, &'a Sources),
    hash: OnceLock<SceneHash>,
    every: Duration,
    /// Seconds that the film took in earlier runs, and when this one began to trace.
    clock: OnceLock<(f64, Instant)>,
    turn: Arc<Mutex<Turn>>,
    writer: Mutex<Option<Writer>>,
}

/// Whose turn it is.
struct Turn {
    when: When,
    /// A checkpoint is being written.
    is_busy: bool,
    /// The file at the path is that of this render.
    is_ours: bool,
    has_failed: bool,
    /// The film at the path has come so far in an earlier run; one that has not does not take its place.
    at_least: u64,
    next: Instant,
}

/// The thread that writes: bytes, and how long it took to gather them.
struct Writer {
    sender: SyncSender<(Vec<u8>, Duration)>,
    thread: JoinHandle<()>,
}

impl<'a> Saver<'a> {
    /// Checkpoints go to `path`, no more often than `every` says.
    pub(super) fn new(
        path: PathBuf,
        origin: Origin,
        scene: (&'a CheckedScene, &'a Sources),
        (when, every): (When, Duration),
    ) -> Saver<'a> {
        let next = Instant::now() + every;
        let turn = Turn { when, is_busy: false, is_ours: false, has_failed: false, at_least: 0, next };
        let (hash, clock) = (OnceLock::new(), OnceLock::new());
        let (turn, writer) = (Arc::new(Mutex::new(turn)), Mutex::new(None));
        Saver { path, origin, scene, hash, every, clock, turn, writer }
    }

    /// The file at the path holds this film, of this very render: it is to go when the picture is written, and is not
    /// replaced by less.
    pub(super) fn found(&self, film: &Film) {
        let mut turn = lock(&self.turn);
        turn.is_ours = true;
        turn.at_least = film.done();
    }

    /// Rays are traced from now on, for a film that took so many seconds before.
    pub(super) fn begins(&self, before: f64) {
        let _ = self.clock.set((before, Instant::now()));
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The scene's hash, made when it is first asked for.
    pub(super) fn hash(&self) -> &SceneHash {
        self.hash.get_or_init(|| SceneHash::of(self.scene.0.scene(), self.scene.1))
    }

    /// The film has come so far; the whole render is estimated to take so many seconds. Has a checkpoint written if it is
    /// time for one.
    pub(super) fn advanced(&self, film: &Film, whole: Option<f64>) {
        let mut turn = lock(&self.turn);
        if turn.when == When::IfLong && whole.is_some_and(|seconds| seconds > LONG_SECONDS) {
            turn.when = When::Always;
            turn.next = Instant::now();
        }
        let is_time = turn.when == When::Always && !turn.is_busy && Instant::now() >= turn.next;
        if !is_time || film.is_complete() || film.done() <= turn.at_least {
            return;
        }
        turn.is_busy = true;
        drop(turn);
        let start = Instant::now();
        let bytes = self.bytes(film);
        let mut writer = self.writer.lock().unwrap_or_else(PoisonError::into_inner);
        let writer = writer.get_or_insert_with(|| self.start_writer());
        // The writer waits for this; it ends only after the sender is gone.
        let _ = writer.sender.send((bytes, start.elapsed()));
    }

    fn start_writer(&self) -> Writer {
        let (sender, receiver) = sync_channel::<(Vec<u8>, Duration)>(1);
        let (path, every, turn) = (self.path.clone(), self.every, Arc::clone(&self.turn));
        let thread = std::thread::spawn(move || {
            for (bytes, gathering) in receiver {
                let start = Instant::now();
                let written = write_whole(&path, &bytes);
                let mut turn = lock(&turn);
                match written {
                    Ok(()) => turn.is_ours = true,
                    Err(error) => warn_once(&mut turn, &path, &error),
                }
                turn.is_busy = false;
                turn.next = Instant::now() + every.max(RARITY * (gathering + start.elapsed()));
            }
        });
        Writer { sender, thread }
    }

    /// True if there are to be no checkpoints.
    pub(super) fn is_off(&self) -> bool {
        lock(&self.turn).when == When::Never
    }

    /// The bytes of a file with this film.
    pub(super) fn bytes(&self, film: &Film) -> Vec<u8> {
        let seconds = self.clock.get().map_or(0.0, |(before, begun)| before + begun.elapsed().as_secs_f64());
        encode_checkpoint(&self.origin, self.hash(), film, seconds)
    }

    /// Waits until nothing is being written any more.
    pub(super) fn settle(&self) {
        if let Some(Writer { sender, thread }) = self.writer.lock().unwrap_or_else(PoisonError::into_inner).take() {
            drop(sender);
            // It prints and writes files, and leaves nothing else behind.
            let _ = thread.join();
        }
    }

    /// True if this render has checkpoints.
    pub(super) fn is_active(&self) -> bool {
        let turn = lock(&self.turn);
        turn.is_ours || turn.when == When::Always
    }

    /// Writes a last checkpoint, now, unless there is one with more on it.
    pub(super) fn save(&self, film: &Film) -> io::Result<()> {
        if film.done() > lock(&self.turn).at_least {
            write_whole(&self.path, &self.bytes(film))?;
        }
        Ok(())
    }

    /// Removes the checkpoint, for the picture is written.
    pub(super) fn remove(&self) {
        if lock(&self.turn).is_ours {
            remove_checkpoint(&self.path);
        }
    }
}

/// Removes a checkpoint whose picture is written.
pub(crate) fn remove_checkpoint(path: &Path) {
    if std::fs::remove_file(path).is_err() && path.exists() {
        output::warning(&format!("{} is of no more use, but cannot be removed", path.display()));
    }
}

/// A checkpoint that cannot be written is no reason to stop.
fn warn_once(turn: &mut Turn, path: &Path, error: &io::Error) {
    if !turn.has_failed {
        turn.has_failed = true;
        let path = path.display();
        output::warning(&format!("cannot write the checkpoint {path}: {error}; the render goes on, and tries again"));
    }
}

fn lock(turn: &Mutex<Turn>) -> MutexGuard<'_, Turn> {
    turn.lock().unwrap_or_else(PoisonError::into_inner)
}
