//! Several paints blended into each other along an axis.

use super::Shade;
use super::cells::steps_along;
use super::wrap::wrap_place;
use durer_math::DVec3;
use durer_scene::{Paint, Wrap};

/// The first paint at 0, the last one at `length` along the axis, the others at equal steps between.
#[derive(Debug)]
pub(super) struct Gradient {
    colors: Box<[Paint]>,
    lengths_along: DVec3,
    wrap: Wrap,
}

impl Gradient {
    /// `colors` are two or more.
    pub(super) fn new(colors: &[Paint], axis: DVec3, length: f64, wrap: Wrap) -> Gradient {
        Gradient { colors: colors.into(), lengths_along: steps_along(axis, length), wrap }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let steps = self.colors.len() - 1;
        let place = wrap_place(self.wrap, point.dot(self.lengths_along)) * steps as f64;
        // The very end belongs to the last step, there being none after it.
        let step = (place as usize).min(steps - 1);
        Shade::Blend([self.colors[step], self.colors[step + 1]], (place - step as f64) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    const COLORS: [Paint; 3] =
        [Paint::Color(Rgb::BLACK), Paint::Color(Rgb::gray(0.5)), Paint::Color(Rgb::new(1.0, 0.0, 0.0))];

    fn shade(wrap: Wrap, x: f64) -> Shade {
        Gradient::new(&COLORS, DVec3::X * 3.0, 8.0, wrap).shade(DVec3::new(x, 5.0, -5.0))
    }

    #[test]
    fn the_paints_are_at_equal_steps() {
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            assert_eq!(shade(wrap, 0.0), Shade::Blend([COLORS[0], COLORS[1]], 0.0));
            assert_eq!(shade(wrap, 3.0), Shade::Blend([COLORS[0], COLORS[1]], 0.75));
            assert_eq!(shade(wrap, 4.0), Shade::Blend([COLORS[1], COLORS[2]], 0.0));
            assert_eq!(shade(wrap, 6.0), Shade::Blend([COLORS[1], COLORS[2]], 0.5));
        }
    }

    #[test]
    fn the_end_and_beyond() {
        let (first, last) = (Shade::Blend([COLORS[0], COLORS[1]], 0.0), Shade::Blend([COLORS[1], COLORS[2]], 1.0));
        assert_eq!((shade(Wrap::Clamp, 8.0), shade(Wrap::Clamp, 80.0), shade(Wrap::Clamp, -8.0)), (last, last, first));
        assert_eq!((shade(Wrap::Mirror, 8.0), shade(Wrap::Mirror, 10.0)), (last, shade(Wrap::Mirror, 6.0)));
        assert_eq!((shade(Wrap::Repeat, 8.0), shade(Wrap::Repeat, -1.0)), (first, shade(Wrap::Repeat, 7.0)));
    }
}
