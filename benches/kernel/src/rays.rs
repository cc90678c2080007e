//! The rays: from an eye, bounced at random off what they hit, and from there to a lamp.

use crate::random::{GOLDEN, Random};
use crate::vector::Vector;

/// A ray in single precision, as all programs get it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Where it goes; its length is the unit of distance.
    pub direction: [f32; 3],
}

/// An eye and a lamp.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: [f64; 3],
    target: [f64; 3],
    /// Half the width of the square picture at distance 1.
    half_width: f64,
    lamp: [f64; 3],
}

/// Over the hills.
pub const OVER_TERRAIN: View =
    View { eye: [0.5, 0.45, 0.0], target: [0.5, 0.05, 0.5], half_width: 0.4, lamp: [0.9, 0.3, 0.9] };
/// From outside into the unit cube.
pub const INTO_CUBE: View =
    View { eye: [0.5, 0.5, -0.9], target: [0.5, 0.5, 0.5], half_width: 0.5, lamp: [0.5, 1.5, -0.5] };
/// From the middle of the cave.
pub const WITHIN_CAVE: View =
    View { eye: [0.0, 0.0, 0.0], target: [0.3, 0.1, 1.0], half_width: 0.8, lamp: [0.3, 0.4, 0.2] };

/// How far secondary rays start from the surface.
const OFFSET: f64 = 1e-5;

/// A point that was hit, and the unit normal towards where the ray came from.
pub type Point = (Vector, Vector);

impl View {
    /// The eye's rays through the middles of `size` × `size` pixels, a multiple of 8. Any eight that follow one another
    /// are a block of four by two.
    pub fn primary(&self, size: usize) -> Vec<Ray> {
        let (eye, target) = (Vector(self.eye), Vector(self.target));
        let forward = (target - eye).normalized();
        let right = forward.cross(Vector([0.0, 1.0, 0.0])).normalized();
        let up = right.cross(forward);
        let ray = |(column, row): (usize, usize)| {
            let x = (2.0 * (column as f64 + 0.5) / size as f64 - 1.0) * self.half_width;
            let y = (1.0 - 2.0 * (row as f64 + 0.5) / size as f64) * self.half_width;
            Ray { origin: eye.narrow(), direction: (forward + right * x + up * y).normalized().narrow() }
        };
        let blocks = squares(0, 0, [size, size], [8, 8]).flat_map(|(x, y)| squares(x, y, [8, 8], [4, 2]));
        blocks.flat_map(|(x, y)| squares(x, y, [4, 2], [1, 1])).map(ray).collect()
    }

    /// The ray to the lamp, which is at distance 1.
    pub fn shadow(&self, (point, normal): Point) -> Ray {
        let origin = point + normal * OFFSET;
        Ray { origin: origin.narrow(), direction: (Vector(self.lamp) - origin).narrow() }
    }
}

/// The corners of the steps by which a rectangle of this size is divided, row by row.
fn squares(left: usize, top: usize, size: [usize; 2], step: [usize; 2]) -> impl Iterator<Item = (usize, usize)> {
    let rows = (top..top + size[1]).step_by(step[1]);
    rows.flat_map(move |y| (left..left + size[0]).step_by(step[0]).map(move |x| (x, y)))
}

/// A ray into a random direction, with the density of the cosine to the normal; `index` tells rays apart.
pub fn bounce(index: usize, (point, normal): Point) -> Ray {
    let mut random = Random(0xD1B5_4A32_D192_ED03 ^ (index as u64).wrapping_mul(GOLDEN));
    let mut direction = normal + random.direction();
    if direction.dot(direction) < 1e-9 {
        direction = normal;
    }
    Ray { origin: (point + normal * OFFSET).narrow(), direction: direction.normalized().narrow() }
}
