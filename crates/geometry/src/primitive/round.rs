//! Shapes that are round in the world, too: of which more can be said than of any.

use super::{Kind, Primitive};
use crate::shapes::{cylinder::Cylinder, sphere::Sphere};
use durer_math::DVec3;

/// A shape that is round in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Round {
    /// A ball.
    Ball {
        /// Its middle.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// A cylinder with caps; part 0 is its side.
    Cylinder {
        /// Its middle.
        center: DVec3,
        /// Of unit length.
        axis: DVec3,
        /// From the middle to either end.
        half_length: f64,
        /// Of its side.
        radius: f64,
    },
}

/// Directions and lengths that differ by less than this, relatively, are equal: a few roundings of a map.
const EQUAL: f64 = 1e-12;

impl Primitive {
    /// What it is if it is a ball or a closed cylinder that its map has not made something else of.
    pub fn round(&self) -> Option<Round> {
        let center = self.origin;
        let [x, y, z] = [self.world_from_shape.x_axis, self.world_from_shape.y_axis, self.world_from_shape.z_axis];
        let radius = x.length();
        let is_equal = |a: DVec3| (a.length() - radius).abs() <= EQUAL * radius;
        let are_square = |a: DVec3, b: DVec3| a.dot(b).abs() <= EQUAL * a.length() * b.length();
        if !(are_square(x, y) && are_square(y, z) && are_square(z, x) && is_equal(z)) {
            return None;
        }
        match &self.kind {
            Kind::Sphere(Sphere {}) if is_equal(y) => Some(Round::Ball { center, radius }),
            Kind::Cylinder(Cylinder { open: false }) => {
                let half_length = y.length();
                Some(Round::Cylinder { center, axis: y / half_length, half_length, radius })
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::{DAffine3, DMat3, rotation};

    #[test]
    fn balls_and_cylinders_stay_round_when_turned_and_scaled_and_not_when_stretched() {
        let turn = rotation(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
        let map = |scale: DVec3| DAffine3 {
            matrix3: turn * DMat3::from_diagonal(scale),
            translation: DVec3::new(3.0, -2.0, 1.0),
        };
        let ball = |scale| Primitive::sphere(DVec3::X, 0.3, &map(scale)).round();
        let Some(Round::Ball { center, radius }) = ball(DVec3::splat(2.0)) else { panic!("a ball") };
        let expected = turn * DVec3::new(2.0, 0.0, 0.0) + DVec3::new(3.0, -2.0, 1.0);
        assert!((center - expected).length() < 1e-14 && (radius - 0.6).abs() < 1e-15, "{center} {radius}");
        assert_eq!(ball(DVec3::new(2.0, 2.0, 2.0 + 1e-9)), None);
        assert_eq!(Primitive::cylinder(DVec3::ZERO, DVec3::Y, 0.2, true, &DAffine3::IDENTITY).round(), None);
        // Along its axis a cylinder may be stretched.
        let tube = |scale| Primitive::cylinder(DVec3::ZERO, DVec3::new(0.0, 3.0, 0.0), 0.2, false, &map(scale)).round();
        let Some(Round::Cylinder { center, axis, half_length, radius }) = tube(DVec3::new(2.0, 5.0, 2.0)) else {
            panic!("a cylinder")
        };
        let middle = turn * DVec3::new(0.0, 7.5, 0.0) + DVec3::new(3.0, -2.0, 1.0);
        assert!((center - middle).length() < 1e-13 && (axis - turn * DVec3::Y).length() < 1e-14);
        assert!((half_length - 7.5).abs() < 1e-13 && (radius - 0.4).abs() < 1e-14);
        assert_eq!(tube(DVec3::new(2.0, 1.0, 3.0)), None);
        assert_eq!(Primitive::cuboid(DVec3::ZERO, DVec3::ONE, &DAffine3::IDENTITY).round(), None);
    }
}
