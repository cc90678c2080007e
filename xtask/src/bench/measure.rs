//! One run of a program, as the kernel accounts for it: processor time and peak memory of that process and the threads
//! and children that it waited for.

use std::path::Path;
#[cfg(unix)]
use std::{
    fs::File,
    process::{Command, Stdio},
    time::Instant,
};

/// What a run took, and what it printed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Run {
    /// From start to end, in seconds.
    pub(crate) wall: f64,
    /// Processor time of all threads, in seconds: in the program itself and in the system for it.
    pub(crate) cpu: f64,
    /// Most memory held at a time, in MiB.
    pub(crate) peak: f64,
    /// Standard output and error together.
    pub(crate) printed: String,
}

/// Runs a program in `folder`, where a file `printed.txt` catches what it prints.
#[cfg(unix)]
pub(crate) fn run(argv: &[String], folder: &Path) -> Result<Run, String> {
    let (program, arguments) = argv.split_first().ok_or("nothing to run")?;
    let at = |error: std::io::Error| format!("{program}: {error}");
    let catch = folder.join("printed.txt");
    let file = File::create(&catch).map_err(at)?;
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.stdout(file.try_clone().map_err(at)?).stderr(file);
    let start = Instant::now();
    let child = command.spawn().map_err(at)?;
    let (status, usage) = wait(child.id()).map_err(at)?;
    let wall = start.elapsed().as_secs_f64();
    let printed = String::from_utf8_lossy(&std::fs::read(&catch).map_err(at)?).into_owned();
    if !(libc::WIFEXITED(status) && libc::WEXITSTATUS(status) == 0) {
        return Err(format!("{} failed:\n{printed}", argv.join(" ")));
    }
    let seconds = |time: libc::timeval| time.tv_sec as f64 + time.tv_usec as f64 * 1e-6;
    let cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    // Linux counts in KiB, macOS in bytes.
    let unit = if cfg!(target_os = "macos") { 1.0 } else { 1024.0 };
    Ok(Run { wall, cpu, peak: usage.ru_maxrss as f64 * unit / f64::from(1 << 20), printed })
}

#[cfg(not(unix))]
pub(crate) fn run(_: &[String], _: &Path) -> Result<Run, String> {
    Err("measuring needs `wait4`, which only Unix has".to_owned())
}

/// Waits for a child of ours; gives its status and what it used.
#[cfg(unix)]
#[allow(unsafe_code, reason = "the standard library does not give the resource usage of a child")]
fn wait(child: u32) -> Result<(libc::c_int, libc::rusage), std::io::Error> {
    let mut status = 0;
    // SAFETY: `rusage` is a struct of integers, for which all zeros are a value.
    let mut usage: libc::rusage = unsafe { std::mem::zeroed() };
    loop {
        // SAFETY: both pointers are to variables of the right types, which live through the call.
        let waited = unsafe { libc::wait4(child as libc::pid_t, &raw mut status, 0, &raw mut usage) };
        if waited >= 0 {
            return Ok((status, usage));
        }
        let error = std::io::Error::last_os_error();
        if error.kind() != std::io::ErrorKind::Interrupted {
            return Err(error);
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_accounted_for() {
        let words = |text: &str| vec!["sh".to_owned(), "-c".to_owned(), text.to_owned()];
        let folder = std::env::temp_dir().join(format!("durer-xtask-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let ran = run(&words("i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done; echo done"), &folder).unwrap();
        assert!(ran.cpu > 0.0 && ran.peak > 0.1 && ran.printed == "done\n", "{ran:?}");
        assert!(run(&words("echo no; exit 3"), &folder).unwrap_err().contains("no"));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
