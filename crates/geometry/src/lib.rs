//! Where does a ray meet a shape? Answers with numbers; knows no colour, material or file.

mod bounds;
mod ray;
mod shapes;

pub use bounds::Bounds;
pub use ray::{Crossing, Ray};
