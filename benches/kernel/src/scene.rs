//! What is measured: things, an eye and a lamp, by name.

use crate::meshes::{self, Mesh};
use crate::random::fnv;
use crate::rays::{INTO_CUBE, OVER_TERRAIN, Point, Ray, View, WITHIN_CAVE};
use crate::vector::Vector;

/// The things of a scene.
#[derive(Clone, Debug)]
pub enum Things {
    /// Triangles.
    Triangles(Mesh),
    /// Balls: center and radius.
    Spheres(Vec<[f32; 4]>),
}

/// Things, and where from they are looked at.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Its name on the command line.
    pub name: String,
    /// What rays meet.
    pub things: Things,
    /// Eye and lamp.
    pub view: View,
}

/// Rays across the picture.
pub const PICTURE: usize = 1024;

impl Scene {
    /// One of `terrain`, `cave`, `soup` and `spheres`.
    ///
    /// # Errors
    ///
    /// If it is none of them.
    pub fn named(name: &str) -> Result<Scene, String> {
        let (things, view) = match name {
            "terrain" => (Things::Triangles(meshes::terrain(708)), OVER_TERRAIN),
            "cave" => (Things::Triangles(meshes::cave(289)), WITHIN_CAVE),
            "soup" => (Things::Triangles(meshes::soup(1_000_000, 0.005)), INTO_CUBE),
            "spheres" => (Things::Spheres(meshes::spheres(1_000_000)), INTO_CUBE),
            _ => return Err(format!("unknown scene `{name}`: there are terrain, cave, soup and spheres")),
        };
        Ok(Scene { name: name.to_owned(), things, view })
    }

    /// How many things there are.
    pub fn count(&self) -> usize {
        match &self.things {
            Things::Triangles(mesh) => mesh.triangles.len(),
            Things::Spheres(spheres) => spheres.len(),
        }
    }

    /// Hashes of the lists of numbers.
    pub fn hashes(&self) -> Vec<u64> {
        match &self.things {
            Things::Triangles(mesh) => vec![
                fnv(mesh.positions.as_flattened().iter().flat_map(|x| x.to_le_bytes())),
                fnv(mesh.triangles.as_flattened().iter().flat_map(|x| x.to_le_bytes())),
            ],
            Things::Spheres(spheres) => vec![fnv(spheres.as_flattened().iter().flat_map(|x| x.to_le_bytes()))],
        }
    }

    /// Where a ray meets the thing that it is known to hit: computed anew, so that all programs go on from the same.
    pub fn point(&self, thing: u32, ray: &Ray) -> Point {
        let (point, normal) = match &self.things {
            Things::Triangles(mesh) => on_triangle(mesh, thing, ray),
            Things::Spheres(spheres) => on_sphere(spheres[thing as usize], ray),
        };
        let from_behind = normal.dot(Vector::wide(ray.direction)) > 0.0;
        (point, if from_behind { normal * -1.0 } else { normal })
    }
}

fn on_triangle(mesh: &Mesh, triangle: u32, ray: &Ray) -> Point {
    let corner = |vertex: u32| Vector::wide(mesh.positions[vertex as usize]);
    let [a, b, c] = mesh.triangles[triangle as usize].map(corner);
    let (origin, direction) = (Vector::wide(ray.origin), Vector::wide(ray.direction));
    let normal = (b - a).cross(c - a).normalized();
    let t = normal.dot(a - origin) / normal.dot(direction);
    (origin + direction * t, normal)
}

fn on_sphere([x, y, z, radius]: [f32; 4], ray: &Ray) -> Point {
    let (center, radius) = (Vector::wide([x, y, z]), f64::from(radius));
    let (origin, direction) = (Vector::wide(ray.origin), Vector::wide(ray.direction));
    let from_center = origin - center;
    let a = direction.dot(direction);
    let b = from_center.dot(direction);
    let c = from_center.dot(from_center) - radius * radius;
    let t = (-b - (b * b - a * c).max(0.0).sqrt()) / a;
    let point = origin + direction * t;
    (point, (point - center).normalized())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hashes that `benches/embree` prints.
    #[test]
    fn scenes_are_the_same_in_every_language() {
        let hashes = |name| Scene::named(name).unwrap().hashes();
        assert_eq!(hashes("terrain"), [0xC2D3_3537_8606_F8A5, 0x1AB6_E4DD_C67A_783B]);
        assert_eq!(hashes("cave"), [0x2E9C_FECE_C88A_98CB, 0xED10_FDE4_7551_B58E]);
        assert_eq!(hashes("soup"), [0x11E1_7541_541E_9B56, 0x009C_5E5A_EE99_25A5]);
        assert_eq!(hashes("spheres"), [0x51CD_7147_6DFC_06EE]);
    }

    #[test]
    fn rays_are_the_same_in_every_language() {
        let hash = |view: View| {
            let rays = view.primary(PICTURE);
            let numbers = rays.iter().flat_map(|ray| [ray.origin, ray.direction]).flatten();
            fnv(numbers.flat_map(f32::to_le_bytes))
        };
        assert_eq!(hash(OVER_TERRAIN), 0xAC3B_0F01_DE2A_88AD);
        assert_eq!(hash(WITHIN_CAVE), 0xA1D2_509A_F5E7_EB94);
        assert_eq!(hash(INTO_CUBE), 0xAA2B_A2C0_5372_9A55);
    }
}
