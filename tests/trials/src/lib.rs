//! What is tried with input at random: by fuzzing (`fuzz/`) for hours, and by ordinary tests for seconds.
//!
//! A target is a function of bytes that panics if something is wrong. The fuzzer calls it with bytes that it makes up; the
//! tests here call it with what the fuzzer once found, which lies in `fuzz/regressions/`, a folder for each target.

mod dice;
pub mod scenes;
mod targets;

pub use dice::Dice;
pub use targets::{TARGETS, Target, checkpoint, gltf, image, obj, picture, ply, render, scene, stl, table};
