//! Eight rays that go through the tree together.
//!
//! Rays of neighboring pixels, and shadow rays from neighboring points, visit the same nodes and test the same shapes. A
//! packet asks once for all eight: a node's boxes are tested against the range that the rays span (Boulos et al., "Packet-
//! based Whitted and distribution ray tracing", 2007), and a triangle against the eight rays by lanes. What each ray hits
//! is the same, to the bit, as if it went alone.

use crate::Ray;
use durer_math::DVec3;

/// Rays in a packet.
pub const LANES: usize = 8;

/// Up to eight rays, by components. Unused lanes repeat a used one.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Packet {
    pub(crate) origin: [[f64; LANES]; 3],
    pub(crate) direction: [[f64; LANES]; 3],
    count: usize,
}

impl Packet {
    /// The rays, of which there must be one to eight.
    pub fn new(rays: &[Ray]) -> Packet {
        debug_assert!((1..=LANES).contains(&rays.len()));
        let mut packet = Packet { origin: [[0.0; LANES]; 3], direction: [[0.0; LANES]; 3], count: rays.len() };
        for lane in 0..LANES {
            packet.set(lane, &rays[lane.min(rays.len() - 1)]);
        }
        packet
    }

    /// The first so many rays are wanted, of eight that are there.
    #[inline]
    pub(crate) fn set_count(&mut self, count: usize) {
        debug_assert!((1..=LANES).contains(&count));
        self.count = count;
    }

    /// The packet of other rays, one for each.
    #[inline(always)]
    pub(crate) fn map(&self, of: impl Fn(Ray) -> Ray) -> Packet {
        let mut mapped = *self;
        for lane in 0..LANES {
            mapped.set(lane, &of(self.ray(lane)));
        }
        mapped
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, ray: &Ray) {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        for axis in 0..3 {
            self.origin[axis][lane] = origin[axis];
            self.direction[axis][lane] = direction[axis];
        }
    }

    /// Number of rays.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Where they go, by components.
    pub fn directions(&self) -> &[[f64; LANES]; 3] {
        &self.direction
    }

    /// One bit for each ray.
    pub(crate) fn all(&self) -> u32 {
        (1 << self.count) - 1
    }

    /// One of the rays.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        let of =
            |components: &[[f64; LANES]; 3]| DVec3::new(components[0][lane], components[1][lane], components[2][lane]);
        Ray { origin: of(&self.origin), direction: of(&self.direction) }
    }
}

/// What the rays of a packet hit.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct PacketHits {
    /// Where; for rays that hit nothing, where they end.
    pub t: [f64; LANES],
    /// Which part of a shape, or -1: a whole number.
    pub part: [f64; LANES],
}

impl PacketHits {
    /// Nothing yet; only hits before `t_max` count.
    pub fn before(t_max: f64) -> PacketHits {
        PacketHits { t: [t_max; LANES], part: [-1.0; LANES] }
    }
}
