//! A picture of all directions.

use super::texels::{Tables, Texels};
use durer_math::{DVec3, Rgb, functions};
use durer_scene::{Channels, Encoding, ImageId, Scene};
use std::f64::consts::{PI, TAU};

/// An environment map, as [`durer_scene::Environment`] describes it. Between the middles of pixels it is bilinear, around the
/// seam, too; beyond the topmost and lowest of them it stays as it is there.
#[derive(Debug)]
pub(crate) struct Environment {
    texels: Texels,
    /// Sine and cosine of the rotation.
    rotation: (f64, f64),
    strength: f32,
}

impl Environment {
    /// That of a scene that passed its check.
    pub(crate) fn compile(map: &durer_scene::Environment, scene: &Scene) -> Environment {
        let ImageId(id) = map.image;
        let bitmap = &scene.images[id as usize].bitmap;
        let texels = Texels::new(bitmap, Channels::Color, Encoding::Srgb, &mut Tables::default());
        let angle = map.rotation_degrees.to_radians();
        Environment { texels, rotation: (functions::sin(angle), functions::cos(angle)), strength: map.strength }
    }

    /// Pixels across and up.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.texels.size()
    }

    /// What is seen in the middle of a pixel; rows count from below.
    pub(crate) fn pixel(&self, column: u32, row: u32) -> Rgb {
        self.texels.get(column, row) * self.strength
    }

    /// Where a direction of unit length is in the picture, in parts of its width and height, from the left and from below.
    pub(crate) fn place(&self, direction: DVec3) -> [f64; 2] {
        let (sin, cos) = self.rotation;
        let (x, z) = (direction.x * cos - direction.z * sin, direction.x * sin + direction.z * cos);
        [(functions::atan2(z, x) + PI) / TAU, functions::asin(direction.y.clamp(-1.0, 1.0)) / PI + 0.5]
    }

    /// The direction of unit length that is at a place of the picture, and the length of its part across the vertical.
    pub(crate) fn direction(&self, [from_left, from_below]: [f64; 2]) -> (DVec3, f64) {
        let (sin, cos) = self.rotation;
        let (across, y) = functions::cos_sin_of_turns(0.5 * (from_below - 0.5));
        let (x, z) = functions::cos_sin_of_turns(from_left - 0.5);
        let (x, z) = (across * x, across * z);
        (DVec3::new(x * cos + z * sin, y, z * cos - x * sin), across)
    }

    /// The y of directions at the lower end of a row of pixels, of so many rows.
    pub(crate) fn height_of(row: u32, rows: u32) -> f64 {
        functions::sin((f64::from(row) / f64::from(rows) - 0.5) * PI)
    }

    /// What is seen in a direction of unit length.
    pub(crate) fn seen(&self, direction: DVec3) -> Rgb {
        self.seen_at(self.place(direction))
    }

    /// What is seen at a place of the picture.
    pub(crate) fn seen_at(&self, [from_left, from_below]: [f64; 2]) -> Rgb {
        let [width, height] = self.texels.size();
        let (s, t) = (from_left * f64::from(width) - 0.5, from_below * f64::from(height) - 0.5);
        // Half a pixel beyond the ends, at most.
        let (left, below) = (s.floor(), t.floor());
        let (across, up) = ((s - left) as f32, (t - below) as f32);
        let left = if left < 0.0 { width - 1 } else { (left as u32).min(width - 1) };
        let right = if left + 1 == width { 0 } else { left + 1 };
        let [below, above] = [below, below + 1.0].map(|row| (row as u32).min(height - 1));
        let row = |row: u32| self.texels.get(left, row).lerp(self.texels.get(right, row), across);
        row(below).lerp(row(above), up) * self.strength
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_imaging::{Bitmap, Texels as Stored};
    use durer_scene::{Background, ImageAsset};
    use std::sync::Arc;

    /// Columns count from 0 in red, rows from the top in green.
    fn map(rotation_degrees: f64) -> Environment {
        let texels = Stored::F32((0..32).map(|at| [(at % 8) as f32, (at / 8) as f32, 0.0]).collect());
        let bitmap = Arc::new(Bitmap { width: 8, height: 4, texels, alpha: None });
        let images = vec![ImageAsset { file: "sky.hdr".to_owned(), bitmap }];
        let map = durer_scene::Environment { image: ImageId(0), rotation_degrees, strength: 2.0 };
        Environment::compile(&map, &Scene { images, background: Background::Image(map), ..Scene::default() })
    }

    #[test]
    fn directions_are_where_they_are_said_to_be() {
        let near = |found: Rgb, [r, g]: [f32; 2]| {
            assert!((found.r - 2.0 * r).abs() < 1e-5 && (found.g - 2.0 * g).abs() < 1e-5, "{found:?}, not {r} {g}");
        };
        // The middle of the picture, half way between two pixels, is +x; -z is a quarter of it to the left.
        near(map(0.0).seen(DVec3::X), [3.5, 1.5]);
        near(map(0.0).seen(DVec3::NEG_Z), [1.5, 1.5]);
        near(map(0.0).seen(DVec3::Z), [5.5, 1.5]);
        near(map(90.0).seen(DVec3::NEG_Z), [3.5, 1.5]);
        near(map(90.0).seen(DVec3::NEG_X), [1.5, 1.5]);
        // At -x the last column goes over into the first, and at the poles all is as in the last row.
        near(map(0.0).seen(DVec3::NEG_X), [3.5, 1.5]);
        near(map(0.0).seen(DVec3::new(-1e-9, 1.0, -1e-9).normalize()), [0.5, 0.0]);
        assert_eq!(map(0.0).seen(DVec3::NEG_Y).g, 6.0);
    }
}
