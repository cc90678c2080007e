//! What was asked of `reproduce`.

use durer::SimdLevel;

/// Where scenes are rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Target {
    /// In this program.
    #[default]
    Native,
    /// In WebAssembly, under Node.
    Wasm,
    /// For AArch64, under QEMU.
    Aarch64,
}

/// The options.
#[derive(Debug, Default)]
pub(super) struct Options {
    pub(super) bless: bool,
    pub(super) list: bool,
    /// Say what is missing and go on.
    pub(super) where_possible: bool,
    pub(super) target: Target,
    pub(super) threads: Option<usize>,
    pub(super) simd: Option<SimdLevel>,
}

impl Options {
    /// What the words mean.
    pub(super) fn parse(words: &[&str]) -> Result<Options, String> {
        let mut options = Options::default();
        let mut words = words.iter().copied();
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
            match word {
                "--bless" => options.bless = true,
                "--list" => options.list = true,
                "--where-possible" => options.where_possible = true,
                "--threads" => options.threads = Some(number(value()?)?),
                "--simd" => options.simd = Some(level(value()?)?),
                "--target" => options.target = target(value()?)?,
                _ => return Err(format!("unknown option `{word}`")),
            }
        }
        Ok(options)
    }

    /// The number of threads and the instruction set, where only one of each is tried.
    pub(super) fn one_way(&self) -> (usize, SimdLevel) {
        (self.threads.unwrap_or(2), self.simd.unwrap_or_default())
    }
}

fn number(word: &str) -> Result<usize, String> {
    word.parse()
        .ok()
        .filter(|number| (1..=1024).contains(number))
        .ok_or_else(|| format!("no number of threads: {word}"))
}

fn level(name: &str) -> Result<SimdLevel, String> {
    let names = || SimdLevel::available().iter().map(|level| level.name()).collect::<Vec<_>>().join(", ");
    SimdLevel::named(name).ok_or_else(|| format!("no instruction set `{name}`: this machine has {}", names()))
}

fn target(name: &str) -> Result<Target, String> {
    match name {
        "native" => Ok(Target::Native),
        "wasm" => Ok(Target::Wasm),
        "aarch64" => Ok(Target::Aarch64),
        _ => Err(format!("unknown target `{name}`: native, wasm or aarch64")),
    }
}
