//! Light as it is: path tracing compared with closed forms, and with what others found.
//!
//! Whole scenes go through the public interface, as users' scenes do.

#![allow(clippy::disallowed_methods, reason = "expected values come from the platform, not from what is tested")]

mod area_lights;
mod casters;
mod closed_scenes;
mod cornell;
mod explained;
mod furnaces;
mod many_ways;
mod reuse;
mod support;
