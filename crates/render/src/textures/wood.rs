//! Year rings around the y axis, bent by noise.

use super::Shade;
use super::cells::fraction;
use super::perlin::fractal_noise;
use durer_math::DVec3;
use durer_scene::Paint;

/// How much slower the rings wander than they follow each other: across the trunk and along it. Trunks grow so, and a
/// board cut along one shows long grain.
const WANDER: DVec3 = DVec3::new(4.0, 16.0, 4.0);

/// Part of a ring's width after which the late wood, having darkened all year, ends.
const END_OF_YEAR: f64 = 0.85;

/// From early wood each ring darkens to late wood, then turns back quickly to the next year's early wood.
#[derive(Debug)]
pub(super) struct Wood {
    colors: [Paint; 2],
    size: f64,
    turbulence: f64,
    octaves: u32,
}

impl Wood {
    pub(super) fn new(colors: [Paint; 2], size: f64, turbulence: f64, octaves: u32) -> Wood {
        Wood { colors, size, turbulence, octaves }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let p = point / self.size;
        let radius = (p.x * p.x + p.z * p.z).sqrt();
        let age = radius + self.turbulence * fractal_noise(p / WANDER, self.octaves);
        Shade::Blend(self.colors, lateness(fraction(age)) as f32)
    }
}

/// From 0 at the start of a year to 1 at [`END_OF_YEAR`] and back to 0 at its very end.
fn lateness(year: f64) -> f64 {
    let grown = year / END_OF_YEAR;
    let turned = (1.0 - year) / (1.0 - END_OF_YEAR);
    (grown * grown).min(turned).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    const COLORS: [Paint; 2] = [Paint::Color(Rgb::WHITE), Paint::Color(Rgb::BLACK)];

    fn late(wood: &Wood, point: DVec3) -> f32 {
        match wood.shade(point) {
            Shade::Blend(_, t) => t,
            other => panic!("not a blend: {other:?}"),
        }
    }

    #[test]
    fn unbent_rings_are_circles_at_multiples_of_size() {
        let wood = Wood::new(COLORS, 2.0, 0.0, 4);
        for ring in 0..20 {
            for (x, z) in [(1.0, 0.0), (0.6, 0.8), (-0.8, 0.6), (0.0, -1.0)] {
                let at = |part: f64| late(&wood, DVec3::new(x, 0.0, z) * (2.0 * (f64::from(ring) + part)));
                assert!(at(1e-6) < 1e-5 && at(0.25) < 0.1, "early wood");
                assert!((at(END_OF_YEAR) - 1.0).abs() < 1e-5, "late wood");
                assert!(at(1.0 - 1e-6) < 1e-4, "the year is over");
            }
        }
    }

    #[test]
    fn rings_wander_slower_along_the_trunk_than_across() {
        let wood = Wood::new(COLORS, 1.0, 0.5, 1);
        let base = DVec3::new(5.0, 3.0, 2.0);
        let change = |step: DVec3| {
            let moved = |i: i32| late(&wood, base + step * f64::from(i));
            (0..100).map(|i| (moved(i + 1) - moved(i)).abs()).sum::<f32>()
        };
        assert!(change(DVec3::Y * 0.05) < 0.5 * change(DVec3::X * 0.05));
    }

    #[test]
    fn no_number_breaks_it() {
        let wood = Wood::new(COLORS, 1.0, 2.0, 16);
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
            assert!((0.0..=1.0).contains(&late(&wood, DVec3::new(x, 0.0, x))), "{x}");
        }
    }
}
