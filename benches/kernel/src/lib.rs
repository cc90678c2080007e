//! What the programs of `cargo xtask bench kernel` share: scenes, rays, clocks, and the lines that they print.
//!
//! Scenes and rays are made here and, bit for bit the same, in `benches/embree/scenes.h`: of numbers nothing but
//! additions, multiplications, divisions and square roots in double precision, and one rounding to single.

pub mod measure;
pub mod meshes;
pub mod print;
pub mod random;
pub mod rays;
pub mod scene;
pub mod vector;
