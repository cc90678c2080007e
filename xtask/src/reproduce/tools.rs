//! Compilers for other targets: rustup's, or else Debian's, which builds the standard library itself.

use crate::shell;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Why a target was not tried.
#[derive(Debug)]
pub(super) enum Unable {
    /// A tool is not there; what, and how to get it.
    Missing(String),
    /// It should have worked.
    Failed(String),
}

impl From<String> for Unable {
    fn from(message: String) -> Unable {
        Unable::Failed(message)
    }
}

/// Fails if a program cannot be run.
pub(super) fn need(program: &str, how: &str) -> Result<(), Unable> {
    match Command::new(program).arg("--version").output() {
        Ok(output) if output.status.success() => Ok(()),
        Ok(_) | Err(_) => Err(Unable::Missing(format!("{program} is missing: {how}"))),
    }
}

/// A cargo that can build a target, with the options that it needs. `linker` is for the case that the target's standard
/// library must be built; `packages` are Debian's that make this possible.
pub(super) fn cargo_for(target: &str, linker: &str, packages: &str) -> Result<Command, Unable> {
    let target_folder = target_folder()?.join("reproduce");
    let mut cargo = if has_standard_library(target) {
        shell::cargo(&["build"])
    } else if Path::new("/usr/lib/rustlib/src/rust/library").exists() && Path::new("/usr/bin/rustc").exists() {
        let mut debian = Command::new("/usr/bin/cargo");
        debian.args(["build", "-Zbuild-std=std,panic_abort"]).current_dir(shell::root());
        // What rustup tells its own cargo would have the wrong compiler called. The option is not stable.
        debian.env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO").env("RUSTC", "/usr/bin/rustc");
        debian.env("RUSTDOC", "/usr/bin/rustdoc").env("RUSTC_BOOTSTRAP", "1");
        debian.env(format!("CARGO_TARGET_{}_LINKER", in_capitals(target)), linker);
        debian
    } else {
        let how = format!("run `rustup target add {target}` or, on Debian, install {packages}");
        return Err(Unable::Missing(format!("there is no standard library for {target}: {how}")));
    };
    // As in a release, but that linking does not take minutes.
    cargo.args(["--quiet", "--release", "--target", target, "--target-dir"]).arg(target_folder);
    cargo.args(["--config", "profile.release.lto=\"off\"", "--config", "profile.release.codegen-units=16"]);
    Ok(cargo)
}

/// Where [`cargo_for`] puts a file.
pub(super) fn built(target: &str, name: &str) -> Result<PathBuf, String> {
    Ok(target_folder()?.join("reproduce").join(target).join("release").join(name))
}

/// A target's name as cargo has it in variables.
pub(super) fn in_capitals(target: &str) -> String {
    target.replace('-', "_").to_uppercase()
}

fn has_standard_library(target: &str) -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let asked = shell::output(Command::new(rustc).args(["--print", "target-libdir", "--target", target]));
    asked.is_ok_and(|folder| Path::new(folder.trim()).exists())
}

/// The folder that cargo builds in; we are in TARGET/debug or TARGET/release.
fn target_folder() -> Result<PathBuf, String> {
    let ours = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = ours.parent().and_then(Path::parent).ok_or("cannot find the target folder")?;
    Ok(folder.to_owned())
}
