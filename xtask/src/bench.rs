//! `cargo xtask bench`: timings that are worth keeping, with all that is needed to judge them.

mod machine;
mod measure;
pub(crate) mod peers;
mod report;
mod tachyon;
