//! The things that rays are sent at: three meshes of a million triangles, and a million balls.

use crate::random::{GOLDEN, Random, mix, unit};
use crate::vector::Vector;

/// Triangles with shared corners.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The corners.
    pub positions: Vec<[f32; 3]>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds the triangles of a square grid of `side` × `side` vertices, the first of which has the number `first`.
    fn add_grid(&mut self, side: usize, first: usize) {
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let a = (first + row * side + column) as u32;
                let b = a + side as u32;
                self.triangles.extend([[a, b, a + 1], [a + 1, b, b + 1]]);
            }
        }
    }
}

/// Hills over the unit square, as `side` × `side` vertices.
pub fn terrain(side: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let steps = (side - 1) as f64;
    for row in 0..side {
        for column in 0..side {
            let (x, z) = (column as f64 / steps, row as f64 / steps);
            let y = octaves(0.0, 0.08, 4.0, |frequency, octave| noise2([x * frequency, z * frequency], octave));
            mesh.positions.push(Vector([x, y, z]).narrow());
        }
    }
    mesh.add_grid(side, 0);
    mesh
}

/// A bumpy ball about the origin, as the six faces of a cube of `cells` × `cells` squares each. From within, a cave.
pub fn cave(cells: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let along = |step: usize| -1.0 + 2.0 * step as f64 / cells as f64;
    for face in 0..6 {
        let first = mesh.positions.len();
        for row in 0..=cells {
            for column in 0..=cells {
                let direction = on_cube(face, along(column), along(row)).normalized();
                let radius = octaves(0.75, 0.25, 2.0, |frequency, octave| noise3(direction * frequency, octave));
                mesh.positions.push((direction * radius).narrow());
            }
        }
        mesh.add_grid(cells + 1, first);
    }
    mesh
}

/// A point of one of the faces of the cube from -1 to 1.
fn on_cube(face: usize, u: f64, v: f64) -> Vector {
    let axis = face / 2;
    let mut point = [0.0; 3];
    point[axis] = if face % 2 == 1 { -1.0 } else { 1.0 };
    point[(axis + 1) % 3] = u;
    point[(axis + 2) % 3] = v;
    Vector(point)
}

/// `count` triangles at random in the unit cube; each corner is at most `reach` from a middle, along each axis.
pub fn soup(count: usize, reach: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let mut random = Random(42);
    for first in (0..3 * count as u32).step_by(3) {
        let middle = random.in_cube();
        for _ in 0..3 {
            let corner = Vector::from_fn(|axis| middle.0[axis] + (2.0 * random.unit() - 1.0) * reach);
            mesh.positions.push(corner.narrow());
        }
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// `count` balls at random in the unit cube: center and radius.
pub fn spheres(count: usize) -> Vec<[f32; 4]> {
    let mut random = Random(43);
    let sphere = |_| {
        let [x, y, z] = random.in_cube().narrow();
        [x, y, z, (0.001 + 0.003 * random.unit()) as f32]
    };
    (0..count).map(sphere).collect()
}

/// Six octaves of a noise, added to `sum`: each has half the amplitude and twice the frequency of the one before.
fn octaves(mut sum: f64, mut amplitude: f64, mut frequency: f64, noise: impl Fn(f64, u64) -> f64) -> f64 {
    for octave in 0..6 {
        sum += amplitude * noise(frequency, octave);
        amplitude *= 0.5;
        frequency *= 2.0;
    }
    sum
}

/// Value noise in the plane: random numbers at the points with whole coordinates, and smooth steps between.
fn noise2(point: [f64; 2], octave: u64) -> f64 {
    let [(x, across), (z, along)] = point.map(cell);
    let at = |dx, dz| random_at([(x + dx, GOLDEN), (z + dz, 0xC2B2_AE3D_27D4_EB4F)], octave);
    let near = between(at(0, 0), at(1, 0), across);
    let far = between(at(0, 1), at(1, 1), across);
    between(near, far, along)
}

/// The same in space.
fn noise3(point: Vector, octave: u64) -> f64 {
    let [(x, across), (y, up), (z, along)] = point.0.map(cell);
    let layer = |dz| {
        let hashed = |dx, dy| [(x + dx, GOLDEN), (y + dy, 0xD6E8_FEB8_6659_FD93), (z + dz, 0xC2B2_AE3D_27D4_EB4F)];
        let at = |dx, dy| random_at(hashed(dx, dy), octave);
        between(between(at(0, 0), at(1, 0), across), between(at(0, 1), at(1, 1), across), up)
    };
    between(layer(0), layer(1), along)
}

/// The whole number below a coordinate, and how far it is on its smooth way to the next.
fn cell(coordinate: f64) -> (i64, f64) {
    let floor = coordinate.floor();
    let t = coordinate - floor;
    (floor as i64, t * t * (3.0 - 2.0 * t))
}

fn between(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// A number from 0 to 1 for a point with whole coordinates, each of which comes with its factor.
fn random_at<const N: usize>(coordinates: [(i64, u64); N], octave: u64) -> f64 {
    let sum =
        coordinates.iter().fold(0, |sum: u64, &(whole, factor)| sum.wrapping_add((whole as u64).wrapping_mul(factor)));
    unit(mix(sum.wrapping_add((octave + 1).wrapping_mul(0x1656_67B1_9E37_79F9))))
}
