//! What the tests of four particles at once have in common: how particles are packed, and vectors of four.
//!
//! Numbers are stored in single precision and widened when they are tested: memory is what millions of particles are short
//! of, and arithmetic in single precision would put a sphere's surface off by many times its rounding.

use crate::Ray;
use durer_math::DVec3;
use fearless_simd::{Simd, f32x4, f64x4, mask64x4, prelude::*};
use std::ops::{Add, Mul, Sub};

/// How many particles are in a block.
pub(crate) const SLOTS: usize = 4;

/// Four particles, number by number.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct Block<const N: usize> {
    numbers: [[f32; SLOTS]; N],
    /// What the user calls them.
    pub(crate) ids: [u32; SLOTS],
}

impl<const N: usize> Block<N> {
    /// Four particles, the same one several times if there are fewer.
    pub(crate) fn new(ids: [u32; SLOTS], particles: [[f32; N]; SLOTS]) -> Block<N> {
        let column = |index: usize| particles.map(|numbers| numbers[index]);
        Block { numbers: std::array::from_fn(column), ids }
    }

    /// The numbers of one particle.
    pub(crate) fn numbers(&self, slot: usize) -> [f32; N] {
        self.numbers.map(|column| column[slot % SLOTS])
    }

    /// One number of all four.
    #[inline(always)]
    pub(crate) fn column<S: Simd>(&self, simd: S, index: usize) -> f64x4<S> {
        let narrow = f32x4::simd_from(simd, self.numbers[index]);
        // Widening eight and dropping half of them is one instruction; widening four is several.
        simd.widen_f32x8(narrow.combine(narrow)).0
    }

    /// Three numbers of all four, one after the other.
    #[inline(always)]
    pub(crate) fn vectors<S: Simd>(&self, simd: S, first: usize) -> Vectors<S> {
        Vectors { x: self.column(simd, first), y: self.column(simd, first + 1), z: self.column(simd, first + 2) }
    }
}

/// Which of four particles a ray meets, one bit each, where, and on which face: 0 unless a bit says 1 or 2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hits {
    pub(crate) which: u32,
    pub(crate) t: [f64; SLOTS],
    pub(crate) faces: [u32; 2],
}

impl Hits {
    pub(crate) const NONE: Hits = Hits { which: 0, t: [0.0; SLOTS], faces: [0; 2] };

    /// The face that is met in a slot.
    #[inline(always)]
    pub(crate) fn face(&self, slot: usize) -> u32 {
        (self.faces[0] >> slot & 1) + 2 * (self.faces[1] >> slot & 1)
    }
}

/// One ray, for four particles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideRay<S: Simd> {
    pub(crate) origin: Vectors<S>,
    pub(crate) direction: Vectors<S>,
    /// The square of the direction's length.
    pub(crate) square: f64x4<S>,
    /// One over it.
    pub(crate) per_square: f64x4<S>,
}

impl<S: Simd> WideRay<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &Ray) -> WideRay<S> {
        let square = ray.direction.length_squared();
        WideRay {
            origin: Vectors::splat(simd, ray.origin),
            direction: Vectors::splat(simd, ray.direction),
            square: f64x4::splat(simd, square),
            per_square: f64x4::splat(simd, 1.0 / square),
        }
    }
}

/// Four vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors<S: Simd> {
    x: f64x4<S>,
    y: f64x4<S>,
    z: f64x4<S>,
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    fn splat(simd: S, v: DVec3) -> Vectors<S> {
        Vectors { x: f64x4::splat(simd, v.x), y: f64x4::splat(simd, v.y), z: f64x4::splat(simd, v.z) }
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Vectors<S>) -> f64x4<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn square(self) -> f64x4<S> {
        self.dot(self)
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Vectors<S>) -> Vectors<S> {
        Vectors {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
}

impl<S: Simd> Add for Vectors<S> {
    type Output = Vectors<S>;
    #[inline(always)]
    fn add(self, other: Vectors<S>) -> Vectors<S> {
        Vectors { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Vectors<S> {
    type Output = Vectors<S>;
    #[inline(always)]
    fn sub(self, other: Vectors<S>) -> Vectors<S> {
        Vectors { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Mul<f64x4<S>> for Vectors<S> {
    type Output = Vectors<S>;
    #[inline(always)]
    fn mul(self, factor: f64x4<S>) -> Vectors<S> {
        Vectors { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

/// The pieces of a ray inside four convex sets; see `shapes/span.rs`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spans<S: Simd> {
    /// Which sets are met at all, ahead of the origin; what the others have means nothing.
    pub(crate) met: mask64x4<S>,
    /// Not positive where the ray starts inside.
    pub(crate) enter: f64x4<S>,
    pub(crate) exit: f64x4<S>,
}
