//! How much memory a picture will take, told before any of it is taken.

use crate::compile::PlacedObject;
use durer_geometry::Primitive;
use durer_scene::{Data, Instances, MeshData, Object, ObjectKind, ParticleKind, Particles, Scene, Sizes};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Of a pixel: its color on the film, what is known of it while it is rendered, and the bytes of the file.
const PIXEL: u64 = 80;
/// Of something placed: itself, its box and its place in the tree, and both once more while the tree is built.
const PLACED: u64 = (size_of::<Primitive>() + 2 * size_of::<PlacedObject>()) as u64 + 384;
/// Of a triangle beside its mesh: its part of a block and of the tree, and its box while the tree is built.
const TRIANGLE: u64 = 192;
/// Of a particle beside its numbers.
const PARTICLE: u64 = 192;

/// Bytes that [`compile`](crate::compile) and [`render`](crate::render) will hold at the same time, at most, together with
/// the lists and images that the scene holds itself. An estimate from above, but for small change.
pub fn memory_needed(scene: &Scene) -> u64 {
    let images: u64 = scene.images.iter().map(|image| image.bitmap.memory()).sum();
    let primitives = scene.primitives();
    let built = [
        scene.picture.pixels().saturating_mul(PIXEL),
        primitives.placed.saturating_add(primitives.operands).saturating_mul(PLACED),
        primitives.triangles.saturating_mul(TRIANGLE),
        primitives.particles.saturating_mul(PARTICLE),
    ];
    let mut lists = Lists::default();
    lists.objects(&scene.objects);
    built.into_iter().chain([images, lists.bytes]).fold(0, u64::saturating_add)
}

/// Bytes of lists, those that several objects share once.
#[derive(Default)]
struct Lists {
    bytes: u64,
    seen: BTreeSet<usize>,
}

impl Lists {
    fn add<T>(&mut self, list: &Arc<[T]>) {
        if self.seen.insert(list.as_ptr() as usize) {
            self.bytes += size_of_val::<[T]>(list) as u64;
        }
    }

    fn data<T>(&mut self, data: &Data<T>) {
        self.add(&data.values);
    }

    fn sizes(&mut self, sizes: &Sizes) {
        match sizes {
            Sizes::Same(_) => {}
            Sizes::Each(data) => self.data(data),
        }
    }

    fn objects(&mut self, objects: &[Object]) {
        for object in objects {
            self.bytes += size_of::<Object>() as u64;
            match &object.kind {
                ObjectKind::Shape(_) => {}
                ObjectKind::Group(members) => self.objects(members),
                ObjectKind::Import(import) => self.objects(&import.objects),
                ObjectKind::Solid(solid) => self.objects(&solid.operands),
                ObjectKind::Mesh(mesh) => self.mesh(&mesh.data),
                ObjectKind::Particles(particles) => self.particles(particles),
                ObjectKind::Instances(copies) => self.instances(copies),
            }
        }
    }

    fn instances(&mut self, copies: &Instances) {
        self.data(&copies.positions);
        self.sizes(&copies.scales);
        copies.rotations.iter().for_each(|data| self.data(data));
        self.objects(&copies.objects);
    }

    fn mesh(&mut self, mesh: &Arc<MeshData>) {
        if self.seen.insert(Arc::as_ptr(mesh) as usize) {
            let MeshData { origin: _, positions, triangles, normals, uvs, colors, parts } = &**mesh;
            let lists = size_of_val(&positions[..]) + size_of_val(&triangles[..]) + size_of_val(&normals[..]);
            self.bytes += (lists + size_of_val(&uvs[..]) + size_of_val(&colors[..]) + size_of_val(&parts[..])) as u64;
        }
    }

    fn particles(&mut self, particles: &Particles) {
        particles.colors.iter().for_each(|data| self.data(data));
        match &particles.kind {
            ParticleKind::Spheres { centers, radii } => {
                self.data(centers);
                self.sizes(radii);
            }
            ParticleKind::Cylinders { bases, tops, radii, open: _ } | ParticleKind::Capsules { bases, tops, radii } => {
                self.data(bases);
                self.data(tops);
                self.sizes(radii);
            }
            ParticleKind::Cones { bases, tops, radii, top_radii, open: _ } => {
                self.data(bases);
                self.data(tops);
                self.sizes(radii);
                self.sizes(top_radii);
            }
        }
    }
}
