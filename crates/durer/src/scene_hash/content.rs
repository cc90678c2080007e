//! Takes the long lists out of a scene and hashes them, each under the name of the file that it came from.

use durer_formats::to_yaml;
use durer_imaging::{Alpha, Bitmap, Texels};
use durer_math::{DVec3, Rgb};
use durer_scene::{Data, Import, Instances, Mesh, MeshData, Object, ObjectKind, ParticleKind, Particles, Scene, Sizes};
use std::collections::BTreeMap;
use std::sync::Arc;
use twox_hash::xxhash3_128::Hasher;

/// The hashes of the parts, by their names.
#[derive(Default)]
pub(super) struct Content {
    parts: BTreeMap<String, Hasher>,
}

/// Bytes of numbers, one list after the other.
struct Bytes<'a>(&'a mut Hasher);

impl Bytes<'_> {
    /// A list: its length, then its numbers.
    fn list<const N: usize>(&mut self, length: usize, numbers: impl Iterator<Item = [u8; N]>) {
        self.0.write(&(length as u64).to_le_bytes());
        let mut block = Vec::with_capacity(1 << 14);
        for number in numbers {
            block.extend_from_slice(&number);
            if block.len() >= (1 << 14) - N {
                self.0.write(&block);
                block.clear();
            }
        }
        self.0.write(&block);
    }

    fn singles<const N: usize>(&mut self, rows: &[[f32; N]]) {
        self.list(rows.len(), rows.iter().flatten().map(|x| x.to_bits().to_le_bytes()));
    }

    fn colors(&mut self, colors: &[Rgb]) {
        self.list(colors.len(), colors.iter().flat_map(|color| color.to_array()).map(|x| x.to_bits().to_le_bytes()));
    }

    fn points(&mut self, points: &[DVec3]) {
        self.list(points.len(), points.iter().flat_map(|point| point.to_array()).map(|x| x.to_bits().to_le_bytes()));
    }

    fn doubles(&mut self, numbers: &[f64]) {
        self.list(numbers.len(), numbers.iter().map(|x| x.to_bits().to_le_bytes()));
    }

    fn text(&mut self, text: &str) {
        self.list(text.len(), text.bytes().map(|byte| [byte]));
    }
}

impl Content {
    /// Adds a text to a part.
    pub(super) fn text(&mut self, part: &str, text: &str) {
        self.part(part).text(text);
    }

    /// Takes all lists out of a scene.
    pub(super) fn take_from(&mut self, scene: &mut Scene) {
        for image in &scene.images {
            bitmap(&mut self.part(&image.file), &image.bitmap);
        }
        for object in &mut scene.objects {
            self.take_from_object(object, "");
        }
    }

    /// Names and hashes, sorted by name.
    pub(super) fn finish(self) -> Vec<(String, u128)> {
        self.parts.into_iter().map(|(name, hasher)| (name, hasher.finish_128())).collect()
    }

    fn part(&mut self, name: &str) -> Bytes<'_> {
        Bytes(self.parts.entry(name.to_owned()).or_default())
    }

    /// `within` is the name of the file that the object is in, unless that is the scene file.
    fn take_from_object(&mut self, object: &mut Object, within: &str) {
        match &mut object.kind {
            ObjectKind::Shape(_) => {}
            ObjectKind::Group(members) => members.iter_mut().for_each(|member| self.take_from_object(member, within)),
            ObjectKind::Solid(solid) => {
                solid.operands.iter_mut().for_each(|operand| self.take_from_object(operand, within));
            }
            ObjectKind::Mesh(mesh) => self.take_mesh(mesh, within),
            ObjectKind::Particles(particles) => self.take_particles(particles, within),
            ObjectKind::Instances(copies) => self.take_instances(copies, within),
            ObjectKind::Import(import) => {
                // A group in its place has its objects written, too.
                let group = self.take_import(import);
                object.kind = ObjectKind::Group(group);
            }
        }
    }

    fn take_import(&mut self, import: &mut Import) -> Vec<Object> {
        let mut objects = std::mem::take(&mut import.objects);
        objects.iter_mut().for_each(|object| self.take_from_object(object, &import.file));
        let lights = std::mem::take(&mut import.lights);
        let beside = Scene { camera: import.camera.take(), lights, ..Scene::default() };
        self.text(&import.file, &to_yaml(&beside));
        objects
    }

    fn take_mesh(&mut self, mesh: &mut Mesh, within: &str) {
        let data = std::mem::take(&mut mesh.data);
        let MeshData { origin, positions, triangles, normals, uvs, colors, parts } = &*data;
        let mut bytes = self.part(mesh.file.as_deref().unwrap_or(within));
        bytes.points(&[*origin]);
        bytes.singles(positions);
        bytes.list(triangles.len(), triangles.iter().flatten().map(|vertex| vertex.to_le_bytes()));
        bytes.singles(normals);
        bytes.singles(uvs);
        bytes.colors(colors);
        for part in parts {
            let material = part.material.map_or(u64::MAX, |id| u64::from(id.0));
            bytes.text(part.name.as_deref().unwrap_or_default());
            let numbers = [u64::from(part.first), u64::from(part.count), material];
            bytes.list(3, numbers.into_iter().map(u64::to_le_bytes));
        }
    }

    fn take_particles(&mut self, particles: &mut Particles, within: &str) {
        let file = particles.file.clone().unwrap_or_else(|| within.to_owned());
        match &mut particles.kind {
            ParticleKind::Spheres { centers, radii } => {
                self.take_points(centers, &file);
                self.take_sizes(radii, &file);
            }
            ParticleKind::Cylinders { bases, tops, radii, open: _ } | ParticleKind::Capsules { bases, tops, radii } => {
                self.take_points(bases, &file);
                self.take_points(tops, &file);
                self.take_sizes(radii, &file);
            }
            ParticleKind::Cones { bases, tops, radii, top_radii, open: _ } => {
                self.take_points(bases, &file);
                self.take_points(tops, &file);
                self.take_sizes(radii, &file);
                self.take_sizes(top_radii, &file);
            }
        }
        if let Some(colors) = &mut particles.colors {
            let values = taken(colors);
            self.part(name(colors, &file)).colors(&values);
        }
    }

    fn take_instances(&mut self, copies: &mut Instances, within: &str) {
        copies.objects.iter_mut().for_each(|object| self.take_from_object(object, within));
        self.take_points(&mut copies.positions, within);
        if let Some(rotations) = &mut copies.rotations {
            self.take_points(rotations, within);
        }
        self.take_sizes(&mut copies.scales, within);
    }

    fn take_points(&mut self, data: &mut Data<DVec3>, within: &str) {
        let values = taken(data);
        self.part(name(data, within)).points(&values);
    }

    fn take_sizes(&mut self, sizes: &mut Sizes, within: &str) {
        match sizes {
            Sizes::Same(size) => self.part(within).doubles(&[*size]),
            Sizes::Each(data) => {
                let values = taken(data);
                self.part(name(data, within)).doubles(&values);
            }
        }
    }
}

/// The values, of which none are left.
fn taken<T>(data: &mut Data<T>) -> Arc<[T]> {
    std::mem::replace(&mut data.values, Arc::new([]))
}

/// The file that it came from.
fn name<'a, T>(data: &'a Data<T>, within: &'a str) -> &'a str {
    data.file.as_ref().map_or(within, |source| &source.file)
}

fn bitmap(bytes: &mut Bytes<'_>, bitmap: &Bitmap) {
    let Bitmap { width, height, texels, alpha } = bitmap;
    bytes.list(2, [width, height].into_iter().map(|length| length.to_le_bytes()));
    match texels {
        Texels::U8(texels) => bytes.list(texels.len(), texels.iter().copied()),
        Texels::U16(texels) => bytes.list(texels.len(), texels.iter().flatten().map(|x| x.to_le_bytes())),
        Texels::F32(texels) => bytes.singles(texels),
    }
    match alpha {
        None => bytes.text("no alpha"),
        Some(Alpha::U8(numbers)) => bytes.list(numbers.len(), numbers.iter().map(|x| [*x])),
        Some(Alpha::U16(numbers)) => bytes.list(numbers.len(), numbers.iter().map(|x| x.to_le_bytes())),
        Some(Alpha::F32(numbers)) => bytes.list(numbers.len(), numbers.iter().map(|x| x.to_bits().to_le_bytes())),
    }
}
