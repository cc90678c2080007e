//! In WebAssembly, under Node: the module that a page would load.

use super::tools::{Unable, built, cargo_for, in_capitals, need};
use super::{Fingerprints, LONGER_SIDE, parse_list, scenes_folder};
use crate::shell;
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The films of the scenes. Without `simd128` the loops that need it take very long to compile, and all browsers have it.
pub(super) fn fingerprints(scenes: &[String]) -> Result<Vec<(&'static str, Fingerprints)>, Unable> {
    need("node", "install Node.js 18 or newer")?;
    let mut cargo = cargo_for(TARGET, "wasm-ld", "rustc-web, cargo-web, rust-web-src and lld")?;
    cargo.args(["--package", "durer-web"]);
    cargo.env(format!("CARGO_TARGET_{}_RUSTFLAGS", in_capitals(TARGET)), "-Ctarget-feature=+simd128");
    shell::run(&mut cargo)?;
    let mut node = Command::new("node");
    node.arg(shell::root().join("apps/web/reproduce.mjs")).arg(built(TARGET, "durer_web.wasm")?);
    node.arg(LONGER_SIDE.to_string()).arg(scenes_folder()).args(scenes);
    Ok(vec![("WebAssembly with simd128", parse_list(&shell::output(&mut node)?)?)])
}
