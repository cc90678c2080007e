//! Where does a ray meet a shape? Answers with numbers; knows no colour, material or file.
//!
//! A [`Primitive`] is an exact shape placed by an affine map. A [`World`] holds all of them and finds the first that a
//! ray meets; a [`Surface`] is a point on one, from which new rays start without meeting it again.

mod bounds;
mod bvh;
mod packet;
mod primitive;
mod ray;
mod sample;
mod seen;
mod shapes;
mod simd;
mod slender;
mod vantage;
mod world;

pub use bounds::Bounds;
pub use bvh::build::{BuildFor, Plan};
pub use bvh::traverse::Work;
pub use packet::{LANES, Packet, PacketHits};
pub use primitive::{Aimable, Primitive, Round, Surface};
pub use ray::{Crossing, Ray};
pub use sample::{Aim, Extent};
pub use seen::{Goal, Pinhole, Seen, Sight, Sights, Way};
pub use shapes::mesh::{Mesh, MeshSource};
pub use shapes::particles::Particles;
pub use shapes::solid::{Operand, Operation};
pub use simd::level::SimdLevel;
pub use slender::Slender;
pub use vantage::Vantage;
pub use world::{Hit, World};
