//! Light as it is: path tracing compared with closed forms, and with what others found.
//!
//! Whole scenes go through the public interface, as users' scenes do.

mod area_lights;
mod cornell;
mod furnaces;
mod many_ways;
mod support;
