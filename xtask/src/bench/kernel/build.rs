//! Builds the programs that measure kernels.

use crate::shell;
use std::path::{Path, PathBuf};
use std::process::Command;

const PACKAGE: &str = "benches/kernel";
const EMBREE: &str = "benches/embree";

/// Where the programs are.
pub(crate) struct Programs {
    pub(crate) durer: PathBuf,
    pub(crate) crates: PathBuf,
    /// `None` if Embree is not there.
    pub(crate) embree: Option<PathBuf>,
}

/// Builds all of them.
pub(crate) fn programs() -> Result<Programs, String> {
    Ok(Programs { durer: durer()?, crates: crates()?, embree: embree()? })
}

/// The program that measures durer's kernel, built as durer is.
pub(crate) fn durer() -> Result<PathBuf, String> {
    build("durer", |_| {})
}

/// The program that measures other crates, built for this very processor, as their documents advise; durer finds out
/// when it runs what the processor can do.
fn crates() -> Result<PathBuf, String> {
    build("crates", |cargo| {
        cargo.env("RUSTFLAGS", "-C target-cpu=native");
    })
}

fn build(feature: &str, set: impl Fn(&mut Command)) -> Result<PathBuf, String> {
    // Other flags and features for each, so that in one folder they would drive each other out.
    let folder = target()?.join(feature);
    let name = format!("kernel-{feature}");
    let words = ["build", "--quiet", "--release", "--features", feature, "--bin", &name];
    let mut cargo = shell::cargo(&words);
    cargo.arg("--manifest-path").arg(shell::root().join(PACKAGE).join("Cargo.toml"));
    cargo.arg("--target-dir").arg(&folder);
    set(&mut cargo);
    shell::run(&mut cargo)?;
    Ok(folder.join("release").join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// The program that measures Embree, if Embree is there.
fn embree() -> Result<Option<PathBuf>, String> {
    let Some(flags) = embree_flags() else { return Ok(None) };
    let path = target()?.join("embree");
    std::fs::create_dir_all(target()?).map_err(|error| error.to_string())?;
    let mut compiler = Command::new("g++");
    compiler.args(["-O3", "-march=native", "-ffp-contract=off", "-std=c++17", "-pthread"]);
    compiler.arg(shell::root().join(EMBREE).join("bench.cpp")).arg("-o").arg(&path).args(flags);
    shell::run(&mut compiler)?;
    Ok(Some(path))
}

/// What the compiler has to be told of Embree: what the environment says, or pkg-config, or else where it usually is.
fn embree_flags() -> Option<Vec<String>> {
    let variable = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
    if let Some((include, library)) = variable("EMBREE_INC").zip(variable("EMBREE_LIB")) {
        return Some(flags(&include, &library));
    }
    let by_pkg_config = ["embree4", "embree"].into_iter().find_map(|name| {
        let words = ["--cflags", "--libs", "--atleast-version=4", name];
        let printed = shell::output(Command::new("pkg-config").args(words)).ok()?;
        Some(printed.split_whitespace().map(str::to_owned).collect())
    });
    by_pkg_config.or_else(|| {
        let mut prefixes = ["/usr", "/usr/local", "/opt/homebrew"].into_iter();
        let prefix = prefixes.find(|prefix| Path::new(prefix).join("include/embree4/rtcore.h").exists())?;
        Some(flags(&format!("{prefix}/include"), &format!("{prefix}/lib")))
    })
}

fn flags(include: &str, library: &str) -> Vec<String> {
    let library_flags = [format!("-L{library}"), "-lembree4".to_owned(), format!("-Wl,-rpath,{library}")];
    [format!("-I{include}")].into_iter().chain(library_flags).collect()
}

/// The version of a crate that the programs are built with.
pub(crate) fn version_of(name: &str) -> String {
    let lock = std::fs::read_to_string(shell::root().join(PACKAGE).join("Cargo.lock")).unwrap_or_default();
    let entry = format!("name = \"{name}\"\nversion = \"");
    let version = lock.split_once(&entry).and_then(|(_, rest)| rest.split_once('"'));
    version.map_or_else(|| "?".to_owned(), |(version, _)| version.to_owned())
}

/// The folder for what is built.
fn target() -> Result<PathBuf, String> {
    let ours = std::env::current_exe().map_err(|error| error.to_string())?;
    // We are TARGET/debug/xtask or TARGET/release/xtask.
    let target = ours.parent().and_then(Path::parent).ok_or("cannot find the target folder")?;
    Ok(target.join("bench"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_those_of_the_lock_file() {
        assert_eq!(version_of("obvhs"), "0.4.0");
        assert_eq!(version_of("no such crate"), "?");
    }

    #[test]
    fn embree_is_linked_where_it_is() {
        assert_eq!(flags("/a", "/b"), ["-I/a", "-L/b", "-lembree4", "-Wl,-rpath,/b"]);
    }
}
