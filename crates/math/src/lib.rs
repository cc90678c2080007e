//! Vectors, transforms, frames, colour triples, and functions with the same bits on every machine.
//!
//! Vectors and matrices are glam's double-precision scalar types, re-exported: their operations are written lane by
//! lane, so they give the same bits everywhere. Everything transcendental comes from [`functions`].

mod fingerprint;
pub mod functions;
mod rgb;
mod transform;

pub use fingerprint::Fingerprint;
pub use glam::{DAffine3, DMat3, DVec2, DVec3};
pub use rgb::Rgb;
pub use transform::{any_orthonormal_pair, rotation, rotation_between};
