//! Slabs, in turn one of several paints.

use super::Shade;
use super::cells::{cell, pick, steps_along};
use durer_math::DVec3;
use durer_scene::Paint;

/// Slab number `floor(distance along the axis / width)` has the paint of that number, counted around.
#[derive(Debug)]
pub(super) struct Stripes {
    colors: Box<[Paint]>,
    slabs_along: DVec3,
}

impl Stripes {
    pub(super) fn new(colors: &[Paint], axis: DVec3, width: f64) -> Stripes {
        Stripes { colors: colors.into(), slabs_along: steps_along(axis, width) }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        Shade::Paint(pick(&self.colors, cell(point.dot(self.slabs_along))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    #[test]
    fn slabs_take_turns_across_the_axis() {
        let colors = [0.0, 0.5, 1.0].map(|v| Paint::Color(Rgb::gray(v)));
        let stripes = Stripes::new(&colors, DVec3::new(0.0, -5.0, 0.0), 2.0);
        let mut changes = 0;
        for i in -30..30 {
            let y = f64::from(i) + 0.5;
            let expected = colors[(-y / 2.0).floor().rem_euclid(3.0) as usize];
            assert_eq!(stripes.shade(DVec3::new(9.0, y, -4.0)), Shade::Paint(expected));
            changes += i32::from(stripes.shade(DVec3::Y * y) != stripes.shade(DVec3::Y * (y + 1.0)));
        }
        assert_eq!(changes, 30, "60 long, a change every 2");
    }

    #[test]
    fn a_surface_on_a_boundary_does_not_flicker() {
        let colors = [Paint::Color(Rgb::BLACK), Paint::Color(Rgb::WHITE)];
        let stripes = Stripes::new(&colors, DVec3::ONE, 0.1);
        let on_boundary = DVec3::ONE.normalize() * 0.7;
        for i in -10..=10 {
            let point = on_boundary + DVec3::splat(f64::from(i) * 1e-13);
            assert_eq!(stripes.shade(point), Shade::Paint(colors[1]));
        }
    }
}
