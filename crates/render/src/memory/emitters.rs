//! Memory of what is known of glowing shapes and of environment maps, so that they can be aimed at.

use crate::surfaces::Scattering;
use durer_scene::{Background, Material, MaterialId, Object, ObjectKind, Scene};

/// Of something that glows: itself, its box while the tree over all of them is built, and its two nodes there.
const EMITTER: u64 = 320;
/// No more of them are aimed at.
const MOST_EMITTERS: u64 = 1 << 23;
/// Of a cell of an environment map, while the cells are summed.
const CELL: u64 = 16;

/// Of a ball or cylinder through which light of a map is aimed at: itself, and as an emitter its place in the tree.
const CASTER: u64 = 400;

/// For all that gives light in a scene, and what throws that of an environment map.
pub(super) fn of_emitters(scene: &Scene) -> u64 {
    let glows = |material: &Material| !material.emission.is_black();
    let casts = |material: &Material| Scattering::compile(&material.kind).smooth_ior().is_some();
    let count = |what: Counted| what.among(scene, &scene.objects, None);
    let shapes = count(Counted::new(scene, glows, false)).min(MOST_EMITTERS);
    let (map, casters) = match scene.background {
        Background::Image(map) => {
            let cells = scene.images.get(map.image.0 as usize).map_or(0, |image| {
                // Larger ones are put together from pixels, up to half of these along a side; of small ones, each tile takes a
                // whole cache line for a row.
                u64::from(image.bitmap.width.clamp(512, 4096)) * u64::from(image.bitmap.height.min(2048))
            });
            (cells, count(Counted::new(scene, casts, true)))
        }
        Background::Color(_) | Background::Gradient { .. } => (0, 0),
    };
    let lamps = scene.lights.len() as u64;
    let emitters = shapes.saturating_add(lamps).saturating_mul(EMITTER);
    emitters.saturating_add(casters.saturating_mul(CASTER)).saturating_add(map.saturating_mul(CELL))
}

/// What is counted among objects.
struct Counted {
    /// Whether things of a material are.
    materials: Vec<bool>,
    /// Not particles, meshes and solids.
    only_shapes: bool,
}

impl Counted {
    fn new(scene: &Scene, counts: impl Fn(&Material) -> bool, only_shapes: bool) -> Counted {
        Counted { materials: scene.materials.iter().map(counts).collect(), only_shapes }
    }

    /// Things with an element that counts, every copy counted, among objects in a group with this material.
    fn among(&self, scene: &Scene, objects: &[Object], around: Option<MaterialId>) -> u64 {
        let count = objects.iter().map(|object| self.of_object(scene, object, around));
        count.fold(0, u64::saturating_add)
    }

    fn of_object(&self, scene: &Scene, object: &Object, around: Option<MaterialId>) -> u64 {
        let counts = |material: Option<MaterialId>| {
            material.and_then(|id| self.materials.get(id.0 as usize)).copied().unwrap_or(false)
        };
        let material = object.material.or(around);
        let all_if_it_counts = |number: u64| if counts(material) { number } else { 0 };
        match &object.kind {
            ObjectKind::Shape(_) => all_if_it_counts(1),
            ObjectKind::Group(members) => self.among(scene, members, material),
            ObjectKind::Import(import) => self.among(scene, &import.objects, material),
            ObjectKind::Particles(_) | ObjectKind::Solid(_) | ObjectKind::Mesh(_) if self.only_shapes => 0,
            ObjectKind::Particles(particles) => all_if_it_counts(particles.kind.len() as u64),
            ObjectKind::Solid(solid) => self.among(scene, &solid.operands, material),
            ObjectKind::Mesh(mesh) => {
                let parts = mesh.data.parts.iter().filter(|part| object.material.is_none() && part.material.is_some());
                let (own, others) = parts.fold((0, mesh.data.triangles.len() as u64), |(own, others), part| {
                    let number = u64::from(part.count);
                    (own + if counts(part.material) { number } else { 0 }, others.saturating_sub(number))
                });
                own + all_if_it_counts(others)
            }
            ObjectKind::Instances(copies) => {
                let number = copies.positions.values.len() as u64;
                let [first, rest @ ..] = &copies.materials[..] else {
                    return self.among(scene, &copies.objects, material).saturating_mul(number);
                };
                // In turn, and in place of the objects' own: as if all were of the one with the most.
                let each = |id: &MaterialId| self.of_all(scene, &copies.objects, *id);
                rest.iter().map(each).fold(each(first), u64::max).saturating_mul(number)
            }
        }
    }

    /// The same if all of them had this material.
    fn of_all(&self, scene: &Scene, objects: &[Object], material: MaterialId) -> u64 {
        let of = |object: &Object| match &object.kind {
            ObjectKind::Group(members) => self.of_all(scene, members, material),
            ObjectKind::Import(import) => self.of_all(scene, &import.objects, material),
            ObjectKind::Solid(solid) if !self.only_shapes => self.of_all(scene, &solid.operands, material),
            ObjectKind::Instances(copies) => {
                self.of_all(scene, &copies.objects, material).saturating_mul(copies.positions.values.len() as u64)
            }
            ObjectKind::Shape(_) | ObjectKind::Particles(_) | ObjectKind::Mesh(_) | ObjectKind::Solid(_) => {
                self.of_object(scene, &Object { material: Some(material), ..object.clone() }, None)
            }
        };
        objects.iter().map(of).fold(0, u64::saturating_add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::{DVec3, Rgb};
    use durer_scene::{Data, Emission, Instances, Mesh, MeshData, MeshNormals, MeshPart, Shape, Sizes};
    use std::sync::Arc;

    fn scene(objects: Vec<Object>) -> Scene {
        let glowing = Material { emission: Emission::of(Rgb::WHITE), ..Material::default() };
        Scene { materials: vec![Material::default(), glowing], objects, ..Scene::default() }
    }

    fn of(kind: ObjectKind, material: Option<u32>) -> Object {
        Object { material: material.map(MaterialId), ..Object::new(kind) }
    }

    fn ball(material: Option<u32>) -> Object {
        of(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }), material)
    }

    fn mesh(material: Option<u32>) -> Object {
        let part = MeshPart { name: None, first: 0, count: 3, material: Some(MaterialId(1)) };
        let data = MeshData { triangles: vec![[0, 1, 2]; 10], parts: vec![part], ..MeshData::default() };
        of(ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) }), material)
    }

    #[test]
    fn what_glows_is_counted_with_every_copy() {
        let glows = Counted::new(&scene(vec![]), |material| !material.emission.is_black(), false);
        let count = |object: Object| glows.among(&scene(vec![]), &[object], None);
        assert_eq!((count(ball(None)), count(ball(Some(0))), count(ball(Some(1)))), (0, 0, 1));
        assert_eq!((count(mesh(None)), count(mesh(Some(0))), count(mesh(Some(1)))), (3, 0, 10));
        let group = |material| of(ObjectKind::Group(vec![ball(None), ball(Some(0)), mesh(None)]), material);
        assert_eq!((count(group(None)), count(group(Some(1)))), (3, 1 + 10));
        let copies = |materials: Vec<MaterialId>| {
            let positions = Data::inline(vec![DVec3::ZERO; 5]);
            let kind = Instances {
                objects: vec![ball(Some(1)), ball(Some(0)), mesh(None)],
                positions,
                rotations: None,
                scales: Sizes::Same(1.0),
                materials,
            };
            count(of(ObjectKind::Instances(kind), None))
        };
        assert_eq!(copies(vec![]), 5 * (1 + 3));
        assert_eq!(copies(vec![MaterialId(0)]), 0);
        assert_eq!(copies(vec![MaterialId(0), MaterialId(1)]), 5 * (2 + 10));
    }

    #[test]
    fn a_million_lamps_take_memory() {
        let lamps = |material| crate::memory_needed(&scene(vec![ball(Some(material)); 1000]));
        assert!(lamps(1) >= lamps(0) + 1000 * 200);
    }
}
