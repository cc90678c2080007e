//! How much there is in a scene.

use crate::{Antialias, Instances, Object, ObjectKind, Scene, Solid};
use std::collections::BTreeSet;
use std::sync::Arc;

/// How many things a scene is made of, without building any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Primitives {
    /// Shapes, meshes, sets of particles and solids, each counted as often as it is placed: copies count.
    pub placed: u64,
    /// Operands of solids, each copied or not.
    pub operands: u64,
    /// Triangles of meshes; those of meshes that objects share count once.
    pub triangles: u64,
    /// Particles; those in copies count once.
    pub particles: u64,
}

impl Primitives {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.placed.saturating_add(self.operands).saturating_add(self.triangles).saturating_add(self.particles)
    }
}

impl Scene {
    /// How many things there are in it.
    pub fn primitives(&self) -> Primitives {
        let mut count = Count { all: Primitives::default(), meshes: BTreeSet::new() };
        count.objects(&self.objects, 1);
        count.all
    }

    /// Rays of the eye in the whole picture, as many as anti-aliasing can ask for.
    pub fn most_samples(&self) -> u64 {
        let in_a_pixel = match self.render.antialias {
            _ if self.render.integrator.takes_samples() => self.render.samples_a_pixel().into(),
            Antialias::None => 1,
            Antialias::Grid { n } => u64::from(n).saturating_mul(n.into()),
            // Four in each part of a pixel, which may be divided by four again and again.
            Antialias::Recursive { max_depth, .. } => squares(max_depth).saturating_mul(4),
            // In each part four sides are searched, an edge in its middle is, and eight places are looked at if it is divided.
            // Small things are looked for more closely.
            Antialias::Adaptive { max_depth, .. } => squares(max_depth.max(6)).saturating_mul(4 * 7 + 8 + 8),
            Antialias::Pov1 { depth, .. } => u64::from(depth).saturating_mul(depth.into()).saturating_add(1),
            Antialias::Pov2 { depth, .. } => {
                let along = 2_u64.saturating_pow(depth.saturating_sub(1)).saturating_add(1);
                along.saturating_mul(along)
            }
        };
        self.picture.pixels().saturating_mul(in_a_pixel)
    }
}

/// A pixel, and what it is divided into by four again and again, so often.
fn squares(depth: u32) -> u64 {
    (0..=depth.min(30)).fold(0, |sum: u64, depth| sum.saturating_add(4_u64.saturating_pow(depth)))
}

struct Count {
    all: Primitives,
    /// Addresses of the meshes that have been counted.
    meshes: BTreeSet<usize>,
}

impl Count {
    fn objects(&mut self, objects: &[Object], copies: u64) {
        for object in objects {
            self.kind(&object.kind, copies);
        }
    }

    fn kind(&mut self, kind: &ObjectKind, copies: u64) {
        match kind {
            ObjectKind::Group(members) => self.objects(members, copies),
            ObjectKind::Import(import) => self.objects(&import.objects, copies),
            ObjectKind::Instances(Instances { objects, positions, .. }) => {
                self.objects(objects, copies.saturating_mul(positions.values.len() as u64));
            }
            ObjectKind::Shape(_) => self.place(copies),
            ObjectKind::Particles(particles) => {
                self.place(copies);
                self.all.particles = self.all.particles.saturating_add(particles.kind.len() as u64);
            }
            ObjectKind::Mesh(mesh) => {
                self.place(copies);
                if self.meshes.insert(Arc::as_ptr(&mesh.data) as usize) {
                    self.all.triangles = self.all.triangles.saturating_add(mesh.data.triangles.len() as u64);
                }
            }
            ObjectKind::Solid(solid) => {
                self.place(copies);
                self.operands(solid);
            }
        }
    }

    fn place(&mut self, copies: u64) {
        self.all.placed = self.all.placed.saturating_add(copies);
    }

    /// What a solid is made of: each counts as one, however often the solid is copied.
    fn operands(&mut self, solid: &Solid) {
        let before = self.all.placed;
        self.all.placed = 0;
        self.objects(&solid.operands, 1);
        self.all.operands = self.all.operands.saturating_add(self.all.placed);
        self.all.placed = before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Data, Operation, Shape, Sizes};
    use durer_math::DVec3;

    fn ball() -> Object {
        Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius: 1.0 }))
    }

    #[test]
    fn copies_count_and_what_they_share_does_not() {
        let solid = Solid { operation: Operation::Union, operands: vec![ball(), ball(), ball()] };
        let objects = vec![ball(), Object::new(ObjectKind::Solid(solid))];
        let copies = Instances {
            objects,
            positions: Data::inline(vec![DVec3::ZERO; 10]),
            rotations: None,
            scales: Sizes::Same(1.0),
            materials: Vec::new(),
        };
        let group = ObjectKind::Group(vec![ball(), Object::new(ObjectKind::Instances(copies))]);
        let scene = Scene { objects: vec![Object::new(group)], ..Scene::default() };
        assert_eq!(scene.primitives(), Primitives { placed: 21, operands: 3, triangles: 0, particles: 0 });
        assert_eq!(scene.primitives().total(), 24);
    }

    #[test]
    fn samples_are_counted_for_every_way_of_anti_aliasing() {
        let samples = |antialias| {
            let mut scene = Scene::default();
            (scene.picture.width, scene.picture.height) = (10, 5);
            scene.render.antialias = antialias;
            scene.most_samples()
        };
        assert_eq!(samples(Antialias::None), 50);
        assert_eq!(samples(Antialias::Grid { n: 3 }), 450);
        assert_eq!(samples(Antialias::Recursive { threshold: 0.1, max_depth: 0 }), 200);
        assert_eq!(samples(Antialias::Recursive { threshold: 0.1, max_depth: 1 }), 1000);
    }
}
