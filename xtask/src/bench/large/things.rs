//! The scene: balls and tubes at random in a cube, so many as are asked for, the more the smaller.

use durer::math::DVec3;
use durer::math::functions::cbrt;

/// A shape, in numbers that single precision holds, so that all programs read the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Thing {
    /// A ball.
    Ball { center: [f32; 3], radius: f32, color: usize },
    /// A cylinder without caps.
    Rod { base: [f32; 3], top: [f32; 3], radius: f32, color: usize },
}

/// The linear colors that shapes have in turn.
pub(super) const PALETTE: [[f64; 3]; 8] = [
    [0.9, 0.2, 0.2],
    [0.2, 0.8, 0.2],
    [0.2, 0.3, 0.9],
    [0.9, 0.8, 0.2],
    [0.8, 0.3, 0.8],
    [0.2, 0.8, 0.8],
    [0.9, 0.5, 0.1],
    [0.8, 0.8, 0.8],
];

/// Where the eye is. It looks at the origin.
pub(super) const EYE: DVec3 = DVec3::new(16.0, 10.0, -32.0);
/// Half the height of the picture at distance 1; it is square.
pub(super) const HALF_HEIGHT: f64 = 0.45;
pub(super) const LAMP: DVec3 = DVec3::new(30.0, 40.0, -30.0);
pub(super) const BACKGROUND: [f64; 3] = [0.1, 0.1, 0.15];
/// The height of the white plane.
pub(super) const FLOOR: f64 = -13.0;
/// Of all materials: how much ambient and how much other light they give back.
pub(super) const AMBIENT: f64 = 0.2;
pub(super) const DIFFUSE: f64 = 0.8;

/// The shapes of the scene of so many, one ball after one rod after one ball.
pub(super) fn things(count: usize) -> impl Iterator<Item = Thing> {
    let mut random = Random(7);
    let size = 20.0 / cbrt(count as f64);
    (0..count).map(move |index| random.thing(index, size))
}

/// Steele, Lea and Flood's SplitMix64 ("Fast splittable pseudorandom number generators", 2014), from a state.
struct Random(u64);

impl Random {
    /// A ball for even numbers, a rod for odd ones.
    fn thing(&mut self, index: usize, size: f64) -> Thing {
        let center = DVec3::from([(); 3].map(|()| 20.0 * self.unit() - 10.0));
        let color = index % PALETTE.len();
        if index.is_multiple_of(2) {
            return Thing::Ball { center: narrow(center), radius: (size * (0.15 + 0.25 * self.unit())) as f32, color };
        }
        let half_axis = self.direction() * (size * (0.3 + 0.5 * self.unit()));
        let radius = (size * (0.05 + 0.1 * self.unit())) as f32;
        Thing::Rod { base: narrow(center - half_axis), top: narrow(center + half_axis), radius, color }
    }

    /// From 0 to 1, in steps of 2⁻²⁴.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f64 / 16_777_216.0
    }

    /// Evenly distributed: a point in the ball, found by rejection.
    fn direction(&mut self) -> DVec3 {
        loop {
            let point = DVec3::from([(); 3].map(|()| 2.0 * self.unit() - 1.0));
            if (1e-9..=1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_lie_in_their_cube() {
        let all: Vec<Thing> = things(1000).collect();
        let balls = all.iter().filter(|thing| matches!(thing, Thing::Ball { .. })).count();
        assert_eq!((all.len(), balls), (1000, 500));
        for thing in all {
            match thing {
                Thing::Ball { center, radius, .. } => {
                    assert!(center.iter().all(|x| x.abs() <= 10.0) && (0.3..=0.8).contains(&radius));
                }
                Thing::Rod { base, top, radius, .. } => {
                    let length = DVec3::from(base.map(f64::from)).distance(DVec3::from(top.map(f64::from)));
                    assert!((1.199..=3.201).contains(&length) && (0.1..=0.3).contains(&radius), "{thing:?}");
                }
            }
        }
    }

    /// The first outputs from state 0 are 0xE220A8397B1DCDAF and 0x6E789E6AA1B965F4.
    #[test]
    fn random_numbers_are_splitmix() {
        let mut random = Random(0);
        assert_eq!(random.unit(), f64::from(0xE2_20A8_u32) / 16_777_216.0);
        assert_eq!(random.unit(), f64::from(0x6E_789E_u32) / 16_777_216.0);
    }
}
