//! What the observer of `explain` writes down.

use super::{
    ArrivalExplanation, Contribution, Element, HitExplanation, HoleExplanation, JunctionExplanation, LightExplanation,
    RayExplanation, RelativeTo, ReuseExplanation, Turn,
};
use crate::compile::CompiledScene;
use crate::observer::{
    ArrivalSeen, LightSeen, NotTraced, Observer, RayKind, ReuseSeen, Scattering, Source, SurfaceSeen, Way, Weighing,
};
use durer_geometry::{Hit, Ray, Surface};
use durer_math::Rgb;
use durer_scene::MaterialId;

/// Writes down what it is told.
pub(super) struct Recorder<'s> {
    scene: &'s CompiledScene,
    /// The number of the sample.
    sample: usize,
    /// The pixels whose samples are taken together.
    together: &'s [(u32, u32)],
    /// The eye's ray, when it has ended.
    pub(super) ray: Option<RayExplanation>,
    /// The ray being traced, and those that led to it.
    open: Vec<RayExplanation>,
    /// Of the contribution that comes next.
    weighing: Option<Weighing>,
    /// Of a split sample: the way on which it is.
    way: Option<Way>,
    /// Of rays that begin.
    relative_to: RelativeTo,
}

impl Observer for Recorder<'_> {
    fn ray_begins(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb) {
        let Ray { origin, direction } = *ray;
        // It is the first ray of its way, unless that ended before it began.
        let way = self.way.take().filter(|_| kind != RayKind::Connected);
        self.open.push(RayExplanation {
            kind,
            depth,
            origin,
            direction,
            weight,
            relative_to: self.relative_to,
            way,
            holes: Vec::new(),
            hit: None,
            lights: Vec::new(),
            turns: Vec::new(),
            junction: None,
            reuse: None,
            contributions: Vec::new(),
            brought: Vec::new(),
            not_traced: Vec::new(),
            children: Vec::new(),
        });
    }

    fn hole(&mut self, hit: &Hit, surface: &Surface, length: f64) {
        let element = self.element(hit, surface);
        let hole = HoleExplanation { shape: hit.primitive as usize, element, distance: length };
        self.with_ray(|ray| ray.holes.push(hole));
    }

    fn surface(&mut self, seen: &SurfaceSeen) {
        let hit = HitExplanation {
            shape: seen.hit.primitive as usize,
            element: self.element(&seen.hit, &seen.surface),
            distance: seen.length,
            point: seen.surface.point,
            normal: seen.surface.normal,
            shading_normal: seen.normal,
            from_outside: seen.from_outside,
            material: self.material(&seen.hit),
            color: seen.color,
            opacity: seen.opacity.unwrap_or(Rgb::WHITE),
        };
        self.with_ray(|ray| ray.hit = Some(hit));
    }

    fn light(&mut self, seen: &LightSeen) {
        let LightSeen { index, distance, cosine, visibility } = *seen;
        self.with_ray(|ray| ray.lights.push(LightExplanation { light: index, distance, cosine, visibility }));
    }

    fn contribution(&mut self, source: Source, amount: Rgb) {
        let weighing = self.weighing.take();
        self.with_ray(|ray| ray.contributions.push(Contribution { source, amount, weighing }));
    }

    fn weighing(&mut self, weighing: &Weighing) {
        self.weighing = Some(*weighing);
    }

    fn scattering(&mut self, scattering: &Scattering) {
        let turn = Turn { way: self.way, scattering: *scattering };
        self.with_ray(|ray| ray.turns.push(turn));
    }

    fn way_begins(&mut self, way: Way) {
        self.way = Some(way).filter(|way| way.of > 1);
    }

    fn junction(&mut self) {
        self.with_ray(|ray| ray.junction = Some(JunctionExplanation::Found(Vec::new())));
    }

    fn junction_left(&mut self) {
        self.with_ray(|ray| ray.junction = Some(JunctionExplanation::Left));
    }

    fn arriving_begins(&mut self) {
        self.relative_to = RelativeTo::Junction;
    }

    fn brings(&mut self, source: Source, amount: Rgb) {
        let weighing = self.weighing.take();
        self.with_ray(|ray| ray.brought.push(Contribution { source, amount, weighing }));
    }

    fn arrives(&mut self, arrival: &ArrivalSeen) {
        self.relative_to = RelativeTo::Sample;
        let ArrivalSeen { source, direction, light } = *arrival;
        let arrival = ArrivalExplanation { source, direction, light, weighing: self.weighing.take() };
        self.with_ray(|ray| {
            if let Some(JunctionExplanation::Found(arrivals)) = &mut ray.junction {
                arrivals.push(arrival);
            }
        });
    }

    fn reuse(&mut self, reuse: &ReuseSeen) {
        let ReuseSeen { found_by, light, sharing } = *reuse;
        let Some(&pixel) = self.together.get(found_by) else { return };
        let reuse = ReuseExplanation { pixel, sample: self.sample, light, sharing };
        self.with_ray(|ray| ray.reuse = Some(reuse));
    }

    fn not_traced(&mut self, kind: RayKind, weight: Rgb, why: NotTraced) {
        self.with_ray(|ray| ray.not_traced.push((kind, weight, why)));
    }

    fn ray_ends(&mut self) {
        let Some(ray) = self.open.pop() else { return };
        match self.open.last_mut() {
            Some(parent) => parent.children.push(ray),
            None => self.ray = Some(ray),
        }
    }
}

impl<'s> Recorder<'s> {
    /// Of a sample with this number of one of the pixels that are taken together.
    pub(super) fn new(scene: &'s CompiledScene, sample: usize, together: &'s [(u32, u32)]) -> Recorder<'s> {
        Recorder {
            scene,
            sample,
            together,
            ray: None,
            open: Vec::new(),
            weighing: None,
            way: None,
            relative_to: RelativeTo::Sample,
        }
    }

    /// What was hit of a shape.
    fn element(&self, hit: &Hit, surface: &Surface) -> Element {
        let (world, part) = (&self.scene.world, hit.crossing.part);
        if let Some(details) = self.scene.details(hit.primitive).filter(|details| details.is_solid()) {
            Element::Operand { index: details.origin(part).0 }
        } else if let Some(weights) = world.vertex_weights(surface.point, hit) {
            Element::Triangle { index: part, weights }
        } else if let Some(index) = world.particle_of(hit) {
            Element::Particle { index }
        } else {
            Element::Face(part)
        }
    }

    fn material(&self, hit: &Hit) -> Option<MaterialId> {
        let id = self.scene.material_at(hit);
        // The last one is not the scene's.
        (id as usize + 1 < self.scene.materials.len()).then_some(MaterialId(id))
    }

    fn with_ray(&mut self, write: impl FnOnce(&mut RayExplanation)) {
        if let Some(ray) = self.open.last_mut() {
            write(ray);
        }
    }
}
