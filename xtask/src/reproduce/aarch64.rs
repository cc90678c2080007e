//! For AArch64, under QEMU: this program, built for that machine, lists its films.

use super::tools::{Unable, built, cargo_for, in_capitals, need};
use super::{Fingerprints, parse_list};
use crate::shell;
use std::process::Command;

const TARGET: &str = "aarch64-unknown-linux-gnu";
const LINKER: &str = "aarch64-linux-gnu-gcc";
/// Where Debian puts the libraries of that machine.
const LIBRARIES: &str = "/usr/aarch64-linux-gnu";

/// The films of the scenes.
pub(super) fn fingerprints() -> Result<Vec<(&'static str, Fingerprints)>, Unable> {
    if cfg!(target_arch = "aarch64") {
        return Err(Unable::Missing(
            "this is an AArch64 machine: run `cargo xtask reproduce` without a target".to_owned(),
        ));
    }
    need(LINKER, "on Debian, install gcc-aarch64-linux-gnu and libc6-dev-arm64-cross")?;
    need("qemu-aarch64", "on Debian, install qemu-user")?;
    let mut cargo = cargo_for(TARGET, LINKER, "rustc-web, cargo-web and rust-web-src")?;
    cargo.args(["--package", "xtask"]).env(format!("CARGO_TARGET_{}_LINKER", in_capitals(TARGET)), LINKER);
    shell::run(&mut cargo)?;
    let mut qemu = Command::new("qemu-aarch64");
    qemu.args(["-L", LIBRARIES]).arg(built(TARGET, "xtask")?).args(["reproduce", "--list"]);
    let films = parse_list(&shell::output(&mut qemu)?)?;
    Ok(vec![("AArch64 under QEMU", films)])
}
