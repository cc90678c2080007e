//! Eight vectors at once, one to a lane: the arithmetic of a single one, operation by operation, so that each lane has the
//! bits that it would have alone.

use crate::packet::LANES;
use durer_math::{DMat3, DVec3};
use fearless_simd::{Simd, f64x8, prelude::*};
use std::ops::{Add, Mul, Neg, Sub};

/// Eight vectors in memory, by components.
pub(crate) type Columns = [[f64; LANES]; 3];

/// One vector of eight.
#[inline(always)]
pub(crate) fn lane_of(columns: &Columns, lane: usize) -> DVec3 {
    DVec3::new(columns[0][lane], columns[1][lane], columns[2][lane])
}

/// Puts one vector among eight.
#[inline(always)]
pub(crate) fn set_lane(columns: &mut Columns, lane: usize, v: DVec3) {
    (columns[0][lane], columns[1][lane], columns[2][lane]) = (v.x, v.y, v.z);
}

/// Eight vectors.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    pub(crate) x: f64x8<S>,
    pub(crate) y: f64x8<S>,
    pub(crate) z: f64x8<S>,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn load(simd: S, columns: &Columns) -> Lanes<S> {
        let [x, y, z] = columns;
        Lanes { x: (*x).simd_into(simd), y: (*y).simd_into(simd), z: (*z).simd_into(simd) }
    }

    #[inline(always)]
    pub(crate) fn splat(simd: S, v: DVec3) -> Lanes<S> {
        Lanes { x: f64x8::splat(simd, v.x), y: f64x8::splat(simd, v.y), z: f64x8::splat(simd, v.z) }
    }

    #[inline(always)]
    pub(crate) fn store(self, columns: &mut Columns) {
        *columns = [self.x.into(), self.y.into(), self.z.into()];
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Lanes<S>) -> f64x8<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The greatest of the coordinates' amounts.
    #[inline(always)]
    pub(crate) fn largest(self) -> f64x8<S> {
        greater(self.x.abs(), greater(self.y.abs(), self.z.abs()))
    }

    /// One coordinate of what a matrix makes of the vectors.
    #[inline(always)]
    pub(crate) fn row(self, simd: S, map: &DMat3, axis: usize) -> f64x8<S> {
        let column = [map.x_axis[axis], map.y_axis[axis], map.z_axis[axis]];
        self.dot(Lanes::splat(simd, column.into()))
    }

    /// A matrix times the vectors.
    #[inline(always)]
    pub(crate) fn mapped(self, simd: S, map: &DMat3) -> Lanes<S> {
        let [x, y, z] = [map.x_axis, map.y_axis, map.z_axis];
        Lanes::splat(simd, x) * self.x + Lanes::splat(simd, y) * self.y + Lanes::splat(simd, z) * self.z
    }
}

/// The first number unless the second is as great.
#[inline(always)]
fn greater<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Lanes<S>;
    #[inline(always)]
    fn add(self, other: Lanes<S>) -> Lanes<S> {
        Lanes { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Lanes<S>;
    #[inline(always)]
    fn sub(self, other: Lanes<S>) -> Lanes<S> {
        Lanes { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Mul<f64x8<S>> for Lanes<S> {
    type Output = Lanes<S>;
    #[inline(always)]
    fn mul(self, scale: f64x8<S>) -> Lanes<S> {
        Lanes { x: self.x * scale, y: self.y * scale, z: self.z * scale }
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Lanes<S>;
    #[inline(always)]
    fn neg(self) -> Lanes<S> {
        Lanes { x: -self.x, y: -self.y, z: -self.z }
    }
}
