//! Blotches of fractal gradient noise, blended between two paints.

use super::Shade;
use super::perlin::fractal_noise;
use durer_math::DVec3;
use durer_scene::Paint;

/// The first paint at the least values of the noise, the second at the greatest; half of each on average.
#[derive(Debug)]
pub(super) struct Noise {
    colors: [Paint; 2],
    size: f64,
    octaves: u32,
}

impl Noise {
    pub(super) fn new(colors: [Paint; 2], size: f64, octaves: u32) -> Noise {
        Noise { colors, size, octaves }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let t = 0.5 + 0.5 * fractal_noise(point / self.size, self.octaves);
        Shade::Blend(self.colors, t as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    #[test]
    fn lattice_points_have_the_middle_of_both_paints() {
        let colors = [Paint::Color(Rgb::BLACK), Paint::Color(Rgb::WHITE)];
        let noise = Noise::new(colors, 2.5, 1);
        for i in -10..10 {
            let point = DVec3::new(2.5 * f64::from(i), 5.0, -7.5);
            assert_eq!(noise.shade(point), Shade::Blend(colors, 0.5));
        }
    }
}
