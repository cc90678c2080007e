//! Vectors in double precision. The programs measure kernels that use different crates for vectors; scenes use none.

use std::ops::{Add, Mul, Sub};

/// Three coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(pub [f64; 3]);

impl Vector {
    /// With the coordinate `of(axis)` along each axis.
    pub fn from_fn(of: impl FnMut(usize) -> f64) -> Vector {
        Vector(std::array::from_fn(of))
    }

    /// Widened from single precision.
    pub fn wide(narrow: [f32; 3]) -> Vector {
        Vector(narrow.map(f64::from))
    }

    /// Rounded to single precision.
    pub fn narrow(self) -> [f32; 3] {
        self.0.map(|x| x as f32)
    }

    /// Scalar product.
    pub fn dot(self, other: Vector) -> f64 {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// Vector product.
    pub fn cross(self, other: Vector) -> Vector {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Vector([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// The same direction at length 1.
    pub fn normalized(self) -> Vector {
        let length = self.dot(self).sqrt();
        Vector(self.0.map(|x| x / length))
    }
}

impl Add for Vector {
    type Output = Vector;
    fn add(self, other: Vector) -> Vector {
        Vector::from_fn(|axis| self.0[axis] + other.0[axis])
    }
}

impl Sub for Vector {
    type Output = Vector;
    fn sub(self, other: Vector) -> Vector {
        Vector::from_fn(|axis| self.0[axis] - other.0[axis])
    }
}

impl Mul<f64> for Vector {
    type Output = Vector;
    fn mul(self, scale: f64) -> Vector {
        Vector(self.0.map(|x| x * scale))
    }
}
