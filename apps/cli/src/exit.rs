//! The one place that decides exit codes.

use crate::output;
use durer::{ReadError, RenderError, WriteError};
use std::process::ExitCode;

/// The table of exit codes, for `--help`.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
    0  everything went well
    1  `compare` found a difference beyond the threshold
    2  the command line is wrong
    3  the scene is wrong, or a file that it names, or it asks for more than its limits
    4  a file cannot be read or written
    5  the system refused something else, such as starting threads
  130  interrupted by Ctrl-C, SIGTERM, SIGHUP or the time limit; `render` has saved what
       was finished";

/// How the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Exit {
    /// Everything went well.
    Fine = 0,
    /// Two pictures differ.
    Different = 1,
    /// The command line is wrong.
    Usage = 2,
    /// The scene is wrong.
    Scene = 3,
    /// A file cannot be read or written.
    File = 4,
    /// The system refused.
    System = 5,
    /// Ctrl-C.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit as u8)
    }
}

/// Why the program ends early.
#[derive(Debug)]
pub(crate) enum Failure {
    /// To be told as an error.
    Message(Exit, String),
    /// Told already, in a form of its own.
    Told(Exit),
    /// Clap's: a wrong command line, or a call for help.
    Arguments(clap::Error),
}

impl Failure {
    /// The command line is wrong.
    pub(crate) fn usage(message: impl Into<String>) -> Failure {
        Failure::Message(Exit::Usage, message.into())
    }

    /// A file cannot be read or written.
    pub(crate) fn file(message: impl Into<String>) -> Failure {
        Failure::Message(Exit::File, message.into())
    }

    /// Says what is wrong, and gives the exit code.
    pub(crate) fn tell(&self) -> ExitCode {
        match self {
            Failure::Message(exit, message) => {
                output::error(message);
                (*exit).into()
            }
            Failure::Told(exit) => (*exit).into(),
            Failure::Arguments(error) => {
                // If nobody reads it, nobody misses it.
                let _ = error.print();
                if error.use_stderr() { Exit::Usage.into() } else { Exit::Fine.into() }
            }
        }
    }
}

impl From<clap::Error> for Failure {
    fn from(error: clap::Error) -> Failure {
        Failure::Arguments(error)
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Failure {
        Failure::file(error.to_string())
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Failure {
        Failure::file(error.to_string())
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Failure {
        match error {
            RenderError::RegionOutside { .. } => Failure::usage(format!("--crop: {error}")),
            // `RenderError` may grow; whatever comes is no fault of the command line.
            _ => Failure::Message(Exit::System, error.to_string()),
        }
    }
}

/// Ends the program at once, without any cleaning up: for the second Ctrl-C.
#[allow(clippy::exit, reason = "the one place that ends the program")]
pub(crate) fn at_once() -> ! {
    std::process::exit(i32::from(Exit::Interrupted as u8))
}
