//! How much memory a picture will take, told before any of it is taken.

mod emitters;

use crate::antialias::adaptive::small::{MOST_THINGS, SMALL_THING};
use crate::compile::PlacedObject;
use crate::film::TILE;
use crate::passes::CELL;
use durer_geometry::Primitive;
use durer_scene::{
    Antialias, Data, Instances, MeshData, Object, ObjectKind, ParticleKind, Particles, PixelFilter, RenderSettings,
    Scene, Sizes,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Of a pixel: its color on the film, what is known of it while it is rendered, and the bytes of the file.
const PIXEL: u64 = 80;
/// Of the sums of a pixel's samples with direct light apart, and of what is to be done in a pass: on the film, and the bytes
/// of a checkpoint.
const SUMS: u64 = 2 * 124 + 16;
/// Of a pixel beside a part of the picture that aims at noise: sums of its samples, and what is to be done in a pass.
const BESIDE: u64 = 96;
/// Of a sample that pixels share: what is seen there, by its place, and its share in the pixel.
const SHARED_SAMPLE: u64 = 160;
/// Of a sample that is kept for a filter, twice.
const KEPT_SAMPLE: u64 = 96;
/// Rows are sampled together as long as that takes no more than this, if every pixel takes all samples that it may.
const SAMPLED_TOGETHER: u64 = 512 << 20;
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
        scene.picture.pixels().saturating_mul(if scene.render.integrator.takes_samples() {
            PIXEL + SUMS
        } else {
            PIXEL
        }),
        beside(scene),
        primitives.placed.saturating_add(primitives.operands).saturating_mul(PLACED),
        primitives.triangles.saturating_mul(TRIANGLE),
        primitives.particles.saturating_mul(PARTICLE),
        samples_together(&scene.render, scene.picture.width, scene.picture.height),
        small_things(scene, primitives.total()),
        emitters::of_emitters(scene),
    ];
    let mut lists = Lists::default();
    lists.objects(&scene.objects);
    built.into_iter().chain([images, lists.bytes]).fold(0, u64::saturating_add)
}

/// Of the cells that the edges of a part of the picture cut, and of those around them, if it aims at noise: at most two rows of
/// cells along each edge, and no cell twice.
fn beside(scene: &Scene) -> u64 {
    if scene.render.noise.is_none() || !scene.render.integrator.takes_samples() {
        return 0;
    }
    let (across, down) = (scene.picture.width.div_ceil(CELL), scene.picture.height.div_ceil(CELL));
    let (across, down) = (u64::from(across), u64::from(down));
    let cells = (4 * (across + down)).min(across * down);
    cells * u64::from(CELL) * u64::from(CELL) * BESIDE
}

/// How many rows of a picture so wide are sampled together, where pixels share samples: as many as a row of tiles has, or
/// fewer where that may take much memory. No pixel depends on it.
pub(crate) fn rows_at_a_time(settings: &RenderSettings, width: u32) -> u32 {
    let row = u64::from(width).saturating_mul(bytes_of_samples(settings)).max(1);
    (SAMPLED_TOGETHER / row).clamp(1, TILE.into()) as u32
}

fn samples_together(settings: &RenderSettings, width: u32, height: u32) -> u64 {
    let rows = u64::from(rows_at_a_time(settings, width).min(height));
    rows.saturating_mul(width.into()).saturating_mul(bytes_of_samples(settings))
}

/// Of a pixel that takes all samples that it may, until it is finished.
fn bytes_of_samples(settings: &RenderSettings) -> u64 {
    if settings.integrator.takes_samples() {
        return 0;
    }
    let kept = |samples: u64| if settings.filter == PixelFilter::Box { 0 } else { samples.saturating_mul(KEPT_SAMPLE) };
    let four_to_the = |power: u32| 4_u64.saturating_pow(power);
    match settings.antialias {
        Antialias::None => kept(1),
        Antialias::Grid { n } => kept(u64::from(n) * u64::from(n)),
        Antialias::Recursive { max_depth, .. } => kept(four_to_the(max_depth.saturating_add(1))),
        Antialias::Adaptive { max_depth, .. } => {
            let samples = four_to_the(max_depth).saturating_mul(2);
            kept(samples).saturating_add(samples.saturating_mul(SHARED_SAMPLE))
        }
        Antialias::Pov1 { depth, .. } => (1 + u64::from(depth) * u64::from(depth)) * KEPT_SAMPLE * 2,
        Antialias::Pov2 { depth, .. } => four_to_the(depth).saturating_add(4).saturating_mul(SHARED_SAMPLE),
    }
}

/// Of what is known of things that may be small in the picture.
fn small_things(scene: &Scene, things: u64) -> u64 {
    match scene.render.antialias {
        _ if scene.render.integrator.takes_samples() => 0,
        Antialias::Adaptive { .. } => things.min(MOST_THINGS).saturating_mul(SMALL_THING),
        Antialias::None
        | Antialias::Grid { .. }
        | Antialias::Recursive { .. }
        | Antialias::Pov1 { .. }
        | Antialias::Pov2 { .. } => 0,
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What lies beside a crop is along its edges; of a picture no larger than that, no more than all of it.
    #[test]
    fn what_lies_beside_a_crop_is_counted() {
        let of = |width, height, noise| {
            let mut scene = Scene::default();
            (scene.picture.width, scene.picture.height) = (width, height);
            (scene.render.integrator, scene.render.noise) = (durer_scene::Integrator::PATH, noise);
            memory_needed(&scene)
        };
        let more = |width, height| of(width, height, Some(0.02)) - of(width, height, None);
        assert_eq!(more(16, 16), 16 * 16 * BESIDE);
        assert_eq!(more(800, 400), 4 * (100 + 50) * 64 * BESIDE);
        let mut scene = Scene::default();
        let without = memory_needed(&scene);
        scene.render.noise = Some(0.02);
        assert_eq!(memory_needed(&scene), without, "`whitted` aims at no noise");
    }
}
