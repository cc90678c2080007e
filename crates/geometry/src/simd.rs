//! One ray against many boxes or planes at once, with whatever instruction set the machine has.
//!
//! Every function here is written once, over `fearless_simd`'s vectors; the instruction set is chosen once per query.
//! Fused multiply-add is never used, so all sets give the same bits.

pub(crate) mod bins;
pub(crate) mod blocks;
pub(crate) mod boxes;
pub(crate) mod capsules;
pub(crate) mod frusta;
pub(crate) mod lanes;
pub(crate) mod level;
pub(crate) mod memory;
pub(crate) mod planes;
pub(crate) mod spheres;
pub(crate) mod triangles;
