//! Memory of what is known of glowing shapes and of environment maps, so that they can be aimed at.

use durer_scene::{Background, MaterialId, Object, ObjectKind, Scene};

/// Of something that glows: itself, its box while the tree over all of them is built, and its two nodes there.
const EMITTER: u64 = 320;
/// No more of them are aimed at.
const MOST_EMITTERS: u64 = 1 << 23;
/// Of a cell of an environment map, while the cells are summed.
const CELL: u64 = 16;

/// For all that gives light in a scene.
pub(super) fn of_emitters(scene: &Scene) -> u64 {
    let shapes = glowing(scene, &scene.objects, None).min(MOST_EMITTERS);
    let map = match scene.background {
        Background::Image(map) => scene.images.get(map.image.0 as usize).map_or(0, |image| {
            // Larger ones are put together from pixels, up to half of these along a side.
            u64::from(image.bitmap.width.min(4096)) * u64::from(image.bitmap.height.min(2048))
        }),
        Background::Color(_) | Background::Gradient { .. } => 0,
    };
    let lamps = scene.lights.len() as u64;
    shapes.saturating_add(lamps).saturating_mul(EMITTER).saturating_add(map.saturating_mul(CELL))
}

/// Things with an element that glows, every copy counted, among objects in a group with this material.
fn glowing(scene: &Scene, objects: &[Object], around: Option<MaterialId>) -> u64 {
    let count = objects.iter().map(|object| of_object(scene, object, around));
    count.fold(0, u64::saturating_add)
}

fn of_object(scene: &Scene, object: &Object, around: Option<MaterialId>) -> u64 {
    let glows = |material: Option<MaterialId>| {
        material.and_then(|id| scene.materials.get(id.0 as usize)).is_some_and(|material| !material.emission.is_black())
    };
    let material = object.material.or(around);
    let all_if_it_glows = |number: u64| if glows(material) { number } else { 0 };
    match &object.kind {
        ObjectKind::Shape(_) => all_if_it_glows(1),
        ObjectKind::Particles(particles) => all_if_it_glows(particles.kind.len() as u64),
        ObjectKind::Group(members) => glowing(scene, members, material),
        ObjectKind::Import(import) => glowing(scene, &import.objects, material),
        ObjectKind::Solid(solid) => glowing(scene, &solid.operands, material),
        ObjectKind::Mesh(mesh) => {
            let parts = mesh.data.parts.iter().filter(|part| object.material.is_none() && part.material.is_some());
            let (own, others) = parts.fold((0, mesh.data.triangles.len() as u64), |(own, others), part| {
                let number = u64::from(part.count);
                (own + if glows(part.material) { number } else { 0 }, others.saturating_sub(number))
            });
            own + all_if_it_glows(others)
        }
        ObjectKind::Instances(copies) => {
            let number = copies.positions.values.len() as u64;
            let [first, rest @ ..] = &copies.materials[..] else {
                return glowing(scene, &copies.objects, material).saturating_mul(number);
            };
            // In turn, and in place of the objects' own: as if all were of the one with the most.
            let each = |id: &MaterialId| of_all(scene, &copies.objects, *id);
            rest.iter().map(each).fold(each(first), u64::max).saturating_mul(number)
        }
    }
}

/// The same if all of them had this material.
fn of_all(scene: &Scene, objects: &[Object], material: MaterialId) -> u64 {
    let of = |object: &Object| match &object.kind {
        ObjectKind::Group(members) => of_all(scene, members, material),
        ObjectKind::Import(import) => of_all(scene, &import.objects, material),
        ObjectKind::Solid(solid) => of_all(scene, &solid.operands, material),
        ObjectKind::Instances(copies) => {
            of_all(scene, &copies.objects, material).saturating_mul(copies.positions.values.len() as u64)
        }
        ObjectKind::Shape(_) | ObjectKind::Particles(_) | ObjectKind::Mesh(_) => {
            of_object(scene, &Object { material: Some(material), ..object.clone() }, None)
        }
    };
    objects.iter().map(of).fold(0, u64::saturating_add)
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::{DVec3, Rgb};
    use durer_scene::{Data, Emission, Instances, Material, Mesh, MeshData, MeshNormals, MeshPart, Shape, Sizes};
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
        let count = |object: Object| glowing(&scene(vec![]), &[object], None);
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
