//! Shapes, groups, copies, and where they are.

use super::Maker;
use durer::math::DVec2;
use durer::math::DVec3;
use durer::scene::{Data, Import, Instances, Object, ObjectKind, Shape, Sizes, Transform, TransformStep};

/// How deep groups and the like nest.
const DEEPEST: usize = 3;

impl Maker<'_, '_> {
    pub(super) fn object(&mut self, depth: usize) -> Object {
        let deep = depth < DEEPEST;
        let kind = match self.dice.below(12) {
            6 => ObjectKind::Mesh(self.mesh()),
            7 => ObjectKind::Particles(self.particles()),
            8 => ObjectKind::Solid(self.solid(depth)),
            9 if deep => ObjectKind::Group(self.some(3, |maker| maker.object(depth + 1))),
            10 if deep => ObjectKind::Instances(self.instances(depth)),
            11 if deep => ObjectKind::Import(self.import(depth)),
            _ => ObjectKind::Shape(self.shape()),
        };
        self.placed(kind)
    }

    /// With a material and a place.
    pub(super) fn placed(&mut self, kind: ObjectKind) -> Object {
        let material = self.option(Maker::material_id);
        Object { name: None, material, transform: self.transform(), kind }
    }

    pub(super) fn transform(&mut self) -> Transform {
        let count = self.dice.below(3);
        Transform { steps: (0..count).map(|_| self.step()).collect() }
    }

    fn step(&mut self) -> TransformStep {
        match self.dice.below(4) {
            0 => TransformStep::Translate(self.point()),
            1 => {
                let (factors, sign) = ([self.factor(), self.factor(), self.factor()], self.dice.one_of(&[1.0, -1.0]));
                TransformStep::Scale(DVec3::from_array(factors) * sign)
            }
            2 => TransformStep::Rotate { axis: self.direction(), degrees: 100.0 * self.dice.within(-3.0, 3.0) },
            _ => {
                let shear = self.dice.within(-1.0, 1.0);
                let place = self.point();
                TransformStep::Matrix([
                    [1.0, shear, 0.0, place.x],
                    [0.0, self.factor(), 0.1, place.y],
                    [0.1, 0.0, 1.0, place.z],
                ])
            }
        }
    }

    fn factor(&mut self) -> f64 {
        match self.is_odd() {
            true => self.magnitude(-9, 8),
            false => self.dice.within(0.5, 2.0),
        }
    }

    pub(super) fn shape(&mut self) -> Shape {
        match self.dice.below(9) {
            0 => Shape::Sphere { center: self.point(), radius: self.size() },
            1 => Shape::Plane { point: self.point(), normal: self.direction() },
            2 => {
                let min = self.point();
                Shape::Box { min, max: min + DVec3::new(self.size(), self.size(), self.size()) }
            }
            3 => {
                let base = self.point();
                Shape::Cylinder { base, top: base + self.direction(), radius: self.size(), open: self.dice.one_in(2) }
            }
            4 => {
                let base = self.point();
                let top_radius = if self.dice.one_in(2) { 0.0 } else { self.size() };
                Shape::Cone {
                    base,
                    top: base + self.direction(),
                    base_radius: self.size(),
                    top_radius,
                    open: self.dice.one_in(2),
                }
            }
            5 => {
                let radius = self.size();
                let inner_radius = if self.dice.one_in(2) { 0.0 } else { radius * self.dice.unit() };
                Shape::Disc { center: self.point(), normal: self.direction(), radius, inner_radius }
            }
            6 => {
                let edges = [DVec3::new(self.size(), self.number(), 0.0), DVec3::new(0.0, self.number(), self.size())];
                Shape::Rectangle { corner: self.point(), edges }
            }
            7 => {
                let uvs = [DVec2::ZERO, DVec2::new(self.number(), 1.0), DVec2::new(0.5, self.number())];
                let uvs = uvs.map(|uv| uv.clamp(DVec2::splat(-1e6), DVec2::splat(1e6)));
                Shape::Triangle { vertices: [self.point(), self.point(), self.point()], uvs: self.option(|_| uvs) }
            }
            _ => {
                let radius = self.size();
                let tube_radius = radius * self.dice.within(0.01, 0.999);
                Shape::Torus { center: self.point(), axis: self.direction(), radius, tube_radius }
            }
        }
    }

    fn instances(&mut self, depth: usize) -> Instances {
        let positions = self.some(4, Maker::point);
        let count = positions.len();
        let turn =
            |maker: &mut Self| DVec3::new(maker.dice.within(-180.0, 180.0), maker.dice.within(-180.0, 180.0), 0.0);
        let rotations = self.option(|maker| Data::inline((0..count).map(|_| turn(maker)).collect::<Vec<_>>()));
        let scales = match self.dice.one_in(2) {
            true => Sizes::Same(self.factor()),
            false => Sizes::Each(Data::inline((0..count).map(|_| self.factor()).collect::<Vec<_>>())),
        };
        Instances {
            objects: self.some(2, |maker| maker.object(depth + 1)),
            positions: Data::inline(positions),
            rotations,
            scales,
            materials: if self.dice.one_in(2) { self.some(2, Maker::material_id) } else { Vec::new() },
        }
    }

    fn import(&mut self, depth: usize) -> Import {
        let file = "model.glb".to_owned();
        let objects = self.some(2, |maker| maker.object(depth + 1));
        Import { file, objects, lights: self.some(1, Maker::light), camera: self.camera() }
    }
}
