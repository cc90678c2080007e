//! Running other programs, and where things are.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The root of the repository.
pub(crate) fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}

/// `cargo` with these words, in the root.
pub(crate) fn cargo(words: &[&str]) -> Command {
    // Cargo says which one of several it is.
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(words).current_dir(root());
    command
}

/// Runs a command; its output goes where ours goes.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{}: {status}", shown(command))),
        Err(error) => Err(format!("{}: {error}", shown(command))),
    }
}

/// Runs a command and gives what it printed to standard output.
pub(crate) fn output(command: &mut Command) -> Result<String, String> {
    match command.output() {
        Ok(output) if output.status.success() => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        Ok(output) => Err(format!("{}: {}", shown(command), String::from_utf8_lossy(&output.stderr).trim_end())),
        Err(error) => Err(format!("{}: {error}", shown(command))),
    }
}

/// Builds `durer` in release and gives its path.
pub(crate) fn build_durer() -> Result<PathBuf, String> {
    run(&mut cargo(&["build", "--quiet", "--release", "--package", "durer-cli"]))?;
    let ours = std::env::current_exe().map_err(|error| error.to_string())?;
    // We are TARGET/debug/xtask or TARGET/release/xtask.
    let target = ours.parent().and_then(Path::parent).ok_or("cannot find the target folder")?;
    let name = format!("durer{}", std::env::consts::EXE_SUFFIX);
    Ok(target.join("release").join(name))
}

/// Writes a file and the folder that it is in.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    let written = path.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| std::fs::write(path, bytes));
    written.map_err(|error| format!("{}: {error}", path.display()))
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
