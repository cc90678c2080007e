//! Whole pictures against closed forms: what a scene file says must be seen, computed by hand and not by us.
//!
//! Every scene is written in its test. Most are seen along one ray ([`support::look`]), whose colour has a formula.

// The expected values must not come from the functions under test.
#![allow(clippy::disallowed_methods, reason = "expected values are computed by the platform's functions, on purpose")]

mod antialias;
mod cameras;
mod clear;
mod copies;
mod determinism;
mod emission;
mod fog;
mod imports;
mod lights;
mod looking_ahead;
mod menagerie;
mod meshes;
mod mirrors;
mod motions;
mod objects;
mod opacity;
mod particles;
mod refraction;
mod robustness;
mod room;
mod seed_tracer;
mod shading;
mod shadows;
mod shown;
mod silhouettes;
mod solids;
mod support;
mod textures;
mod transforms;
mod transparent_shadows;
mod vertex_normals;
