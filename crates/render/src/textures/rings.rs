//! Tubes around an axis, in turn one of several paints.

use super::Shade;
use super::cells::{cell, pick};
use durer_math::DVec3;
use durer_scene::{Paint, Space};

/// Tube number `floor(distance from the axis / width)` has the paint of that number, counted around. The axis is y in
/// the object's space and z on uv, where it stands on the uv plane at (0, 0).
#[derive(Debug)]
pub(super) struct Rings {
    colors: Box<[Paint]>,
    width: f64,
    space: Space,
}

impl Rings {
    pub(super) fn new(colors: &[Paint], width: f64, space: Space) -> Rings {
        Rings { colors: colors.into(), width, space }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let across = match self.space {
            Space::Object => point.z,
            Space::Uv => point.y,
        };
        let radius = (point.x * point.x + across * across).sqrt();
        Shade::Paint(pick(&self.colors, cell(radius / self.width)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    #[test]
    fn rings_lie_around_y_or_around_uv_zero() {
        let colors = [0.0, 0.3, 0.6, 0.9].map(|v| Paint::Color(Rgb::gray(v)));
        let around_y = Rings::new(&colors, 0.5, Space::Object);
        let around_uv = Rings::new(&colors, 0.5, Space::Uv);
        for i in 0..40 {
            let radius = f64::from(i) * 0.25 + 0.1;
            let expected = Shade::Paint(colors[(radius / 0.5) as usize % 4]);
            assert_eq!(around_y.shade(DVec3::new(0.6 * radius, 100.0, -0.8 * radius)), expected);
            assert_eq!(around_uv.shade(DVec3::new(-0.6 * radius, 0.8 * radius, 0.0)), expected);
        }
    }

    #[test]
    fn the_wall_of_a_cylinder_does_not_flicker() {
        let colors = [Paint::Color(Rgb::BLACK), Paint::Color(Rgb::WHITE)];
        let rings = Rings::new(&colors, 0.1, Space::Object);
        for i in 0..1000 {
            let t = f64::from(i) * 0.002 - 1.0;
            let radius = 0.3 + f64::from(i % 7 - 3) * 1e-14;
            let point = DVec3::new(t * radius, 0.0, (1.0 - t * t).sqrt() * radius);
            assert_eq!(rings.shade(point), Shade::Paint(colors[1]));
        }
    }
}
