//! Which instruction set the loops over several numbers use.

use fearless_simd::Level;
use std::fmt;

/// An instruction set that this machine has. All give the same bits; better ones are faster.
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel(Level);

impl SimdLevel {
    /// The best of this machine.
    pub fn best() -> SimdLevel {
        SimdLevel(Level::new())
    }

    /// Those of this machine, from the least to the best. The portable one, without vector instructions, is among them
    /// where there is no other, and with the feature `portable` everywhere.
    pub fn available() -> Vec<SimdLevel> {
        let best = Level::new();
        let mut levels = Vec::new();
        #[cfg(feature = "portable")]
        levels.push(Level::fallback());
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            levels.extend(best.as_sse2().map(Level::Sse2));
            levels.extend(best.as_sse4_2().map(Level::Sse4_2));
            levels.extend(best.as_avx2().map(Level::Avx2));
            levels.extend(best.as_avx512().map(Level::Avx512));
        }
        if levels.iter().all(|&level| name(level) != name(best)) {
            levels.push(best);
        }
        levels.into_iter().map(SimdLevel).collect()
    }

    /// The one with a [name](SimdLevel::name), if this machine has it.
    pub fn named(name: &str) -> Option<SimdLevel> {
        SimdLevel::available().into_iter().find(|level| level.name() == name)
    }

    /// `portable`, `sse2`, `sse4.2`, `avx2`, `avx512`, `neon` or `simd128`.
    pub fn name(self) -> &'static str {
        name(self.0)
    }

    #[inline(always)]
    pub(crate) fn level(self) -> Level {
        self.0
    }
}

/// The best of this machine.
impl Default for SimdLevel {
    fn default() -> SimdLevel {
        SimdLevel::best()
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

fn name(level: Level) -> &'static str {
    match level {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Sse2(_) => "sse2",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Sse4_2(_) => "sse4.2",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx2(_) => "avx2",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx512(_) => "avx512",
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => "neon",
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        Level::WasmSimd128(_) => "simd128",
        // Only where there is nothing else, or with the feature `portable`.
        #[allow(unreachable_patterns, reason = "whether it can be depends on the target")]
        _ => "portable",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_have_names_of_their_own_and_the_best_comes_last() {
        let levels = SimdLevel::available();
        let mut names: Vec<&str> = levels.iter().map(|level| level.name()).collect();
        assert_eq!(names.last(), Some(&SimdLevel::best().name()));
        assert_eq!(names.contains(&"portable"), cfg!(feature = "portable") || SimdLevel::best().name() == "portable");
        for &name in &names {
            assert_eq!(SimdLevel::named(name).map(SimdLevel::name), Some(name));
        }
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(SimdLevel::named("avx3").is_none());
    }
}
