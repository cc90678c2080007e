//! Veins across the x axis, bent by noise.

use super::Shade;
use super::perlin::fractal_noise;
use durer_math::DVec3;
use durer_scene::Paint;

/// Size of the largest bends, in distances between veins. With bends as small as the distance, veins only quiver.
const WANDER: f64 = 3.0;

/// Veins stand at x = 0, ±`size`, ±2 `size` … before they are bent, and are a quarter as thick as their distance.
#[derive(Debug)]
pub(super) struct Marble {
    colors: [Paint; 2],
    size: f64,
    turbulence: f64,
    octaves: u32,
}

impl Marble {
    pub(super) fn new(colors: [Paint; 2], size: f64, turbulence: f64, octaves: u32) -> Marble {
        Marble { colors, size, turbulence, octaves }
    }

    pub(super) fn shade(&self, point: DVec3) -> Shade {
        let p = point / self.size;
        let place = p.x + self.turbulence * fractal_noise(p / WANDER, self.octaves);
        Shade::Blend(self.colors, vein(place) as f32)
    }
}

/// 1 at whole numbers, 0 halfway between them, a smooth bump around each vein.
fn vein(place: f64) -> f64 {
    let from_vein = 2.0 * (place - (place + 0.5).floor()).abs();
    let near = (1.0 - from_vein * from_vein).max(0.0);
    let (near2, near4) = (near * near, near * near * near * near);
    near2 * near4 * near4
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::Rgb;

    const COLORS: [Paint; 2] = [Paint::Color(Rgb::WHITE), Paint::Color(Rgb::BLACK)];

    fn strength(marble: &Marble, point: DVec3) -> f32 {
        match marble.shade(point) {
            Shade::Blend(_, t) => t,
            other => panic!("not a blend: {other:?}"),
        }
    }

    #[test]
    fn straight_veins_stand_at_multiples_of_size() {
        let marble = Marble::new(COLORS, 3.0, 0.0, 4);
        for i in -5..5 {
            let x = 3.0 * f64::from(i);
            assert_eq!(strength(&marble, DVec3::new(x, 0.4, 9.0)), 1.0);
            assert_eq!(strength(&marble, DVec3::new(x + 1.5, -0.4, 9.0)), 0.0);
            let flank = strength(&marble, DVec3::new(x + 3.0 / 8.0, 2.0, 9.0));
            assert!((flank - 0.5).abs() < 0.05, "a quarter of the distance thick: {flank}");
        }
    }

    #[test]
    fn turbulence_bends_them_by_at_most_its_own_size() {
        let (straight, bent) = (Marble::new(COLORS, 1.0, 0.0, 3), Marble::new(COLORS, 1.0, 0.1, 3));
        let mut bends = 0;
        for i in 0..1000 {
            let point = DVec3::new(0.0, f64::from(i) * 0.137, f64::from(i) * 0.071);
            assert!(strength(&bent, point) >= vein(0.1) as f32);
            bends += i32::from(strength(&bent, point) < strength(&straight, point));
        }
        assert!(bends > 900, "{bends}");
    }

    #[test]
    fn no_number_breaks_it() {
        let marble = Marble::new(COLORS, 1.0, 2.0, 16);
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
            assert!((0.0..=1.0).contains(&strength(&marble, DVec3::new(x, 0.0, x))), "{x}");
        }
    }
}
