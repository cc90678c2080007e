//! Cubes of two alternating paints.

use super::Shade;
use super::cells::cell;
use durer_math::DVec3;
use durer_scene::Paint;

/// The first paint where `floor(x/size) + floor(y/size) + floor(z/size)` is even.
#[derive(Debug)]
pub(super) struct Checker {
    colors: [Paint; 2],
    size: f64,
}

impl Checker {
    pub(super) fn new(colors: [Paint; 2], size: f64) -> Checker {
        Checker { colors, size }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let p = point / self.size;
        // The lowest bit of a sum is the lowest bits' exclusive or, which cannot overflow.
        let odd = (cell(p.x) ^ cell(p.y) ^ cell(p.z)) & 1;
        Shade::Paint(self.colors[odd as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    const LIGHT: Paint = Paint::Color(Rgb::gray(0.95));
    const DARK: Paint = Paint::Color(Rgb::gray(0.05));

    /// The table of the seed scene: y = -15, squares of 4, light where `floor(x/4) + floor(z/4)` is even.
    #[test]
    fn the_seed_s_table() {
        let checker = Checker::new([LIGHT, DARK], 4.0);
        for i in -20..20 {
            for j in -56..-28 {
                let (x, z) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
                let even = ((x / 4.0).floor() + (z / 4.0).floor()) % 2.0 == 0.0;
                let expected = if even { LIGHT } else { DARK };
                assert_eq!(checker.shade(DVec3::new(x, -15.0, z)), Shade::Paint(expected), "({x}, {z})");
            }
        }
    }

    #[test]
    fn neighbours_across_every_face_differ() {
        let checker = Checker::new([LIGHT, DARK], 0.5);
        assert_eq!(checker.shade(DVec3::splat(0.25)), Shade::Paint(LIGHT));
        for step in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z] {
            assert_eq!(checker.shade(DVec3::splat(0.25) + step * 0.5), Shade::Paint(DARK));
        }
    }

    #[test]
    fn a_surface_on_a_boundary_does_not_flicker() {
        let checker = Checker::new([LIGHT, DARK], 4.0);
        for i in 0..1000 {
            let noise = f64::from(i % 21 - 10) * 1e-13;
            for y in [-16.0, -4.0, 0.0, 12.0] {
                let point = DVec3::new(1.0, y + noise, 1.0);
                assert_eq!(checker.shade(point), checker.shade(DVec3::new(1.0, y, 1.0)));
            }
        }
    }
}
