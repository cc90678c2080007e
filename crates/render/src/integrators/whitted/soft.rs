//! Light from what has an area: glowing shapes, and lamps with a radius. Their shadows are soft.
//!
//! `light_samples` shadow rays go to each, spread evenly over it. Those for a mesh are divided among its triangles by how much
//! they matter for the point that is lit, and with more than [`MANY`] glowing objects so are the rays that so many would get.

use super::Path;
use crate::emitters::{LightSample, Receiver};
use crate::observer::{LightSeen, Observer, Source};
use crate::sampler::Purpose;
use crate::shading::{Shading, highlight};
use crate::visibility::visibility;
use durer_geometry::Ray;
use durer_math::Rgb;
use std::f64::consts::PI;

/// With more objects than this, rays are divided among them.
const MANY: usize = 16;

/// What arrived by some rays: on a matte surface, and in the highlight.
#[derive(Default)]
struct Arrived {
    diffuse: Rgb,
    specular: Rgb,
    visible: Rgb,
}

impl<O: Observer> Path<'_, O> {
    /// Light of a lamp with a radius.
    #[inline(never)]
    pub(super) fn shade_by_ball(&mut self, shading: &Shading<'_>, weight: Rgb, index: usize) {
        let (scene, place) = (self.scene, self.next_place());
        let count = scene.settings.light_samples;
        let point = shading.origin_back();
        let mut arrived = Arrived::default();
        for number in 0..count {
            let at = self.sampler.split(number, count).two(place, Purpose::LightPoint);
            let sample = scene.emitters.aim_at_lamp(scene, point, index, at);
            self.receive(shading, sample, &mut arrived);
        }
        let (distance, cosine) = match scene.lights[index].arriving(point) {
            Some(arriving) => (Some(arriving.distance), shading.cosine(arriving.direction)),
            None => (None, 0.0),
        };
        let visibility = arrived.visible * (1.0 / count as f32);
        self.observer.light(&LightSeen { index, distance, cosine, visibility });
        self.count_in(shading, weight, &arrived, count, [Source::Diffuse(index), Source::Specular(index)]);
    }

    /// Light of glowing shapes.
    #[inline(never)]
    pub(super) fn shade_by_shapes(&mut self, shading: &Shading<'_>, weight: Rgb) {
        let (scene, per_light) = (self.scene, self.scene.settings.light_samples);
        let (shapes, point) = (scene.emitters.shapes(), shading.origin_back());
        let sources = [Source::Light(None); 2];
        if shapes.len() == shapes.objects() && shapes.objects() <= MANY {
            for index in 0..shapes.len() {
                let (mut arrived, place) = (Arrived::default(), self.next_place());
                for number in 0..per_light {
                    let at = self.sampler.split(number, per_light).two(place, Purpose::LightPoint);
                    let sample = shapes.aim(scene, index, point, at);
                    self.receive(shading, sample, &mut arrived);
                }
                self.count_in(shading, weight, &arrived, per_light, sources);
            }
            return;
        }
        let (mut arrived, place) = (Arrived::default(), self.next_place());
        let count = per_light.saturating_mul(shapes.objects().min(MANY) as u32);
        let receiver = Receiver { point, normal: shading.normal(), passes: false };
        for number in 0..count {
            let sampler = self.sampler.split(number, count);
            let (choice, at) = (sampler.one(place, Purpose::Light), sampler.two(place, Purpose::LightPoint));
            let sample = scene.emitters.sample_shape(scene, &receiver, choice, at);
            self.receive(shading, sample, &mut arrived);
        }
        self.count_in(shading, weight, &arrived, count, sources);
    }

    /// What one ray brings.
    fn receive(&mut self, shading: &Shading<'_>, sample: Option<LightSample>, arrived: &mut Arrived) {
        let Some(sample) = sample else { return };
        let cosine = shading.cosine(sample.direction);
        if cosine <= 0.0 {
            return;
        }
        self.observer.shadow_ray();
        let ray = Ray { origin: shading.origin_back(), direction: sample.direction };
        let visible = visibility(self.scene, &self.media, &ray, sample.distance, None);
        if visible.is_black() {
            return;
        }
        // As for lamps: what a white matte surface shows that faces it.
        let light = visible * sample.light * ((1.0 / (PI * sample.pdf)) as f32);
        arrived.visible += visible;
        arrived.diffuse += light * cosine as f32;
        if !shading.material.specular.is_black() {
            arrived.specular += light * highlight(shading, sample.direction);
        }
    }

    /// The means of so many rays.
    fn count_in(&mut self, shading: &Shading<'_>, weight: Rgb, arrived: &Arrived, count: u32, sources: [Source; 2]) {
        let (material, share) = (shading.material, 1.0 / count as f32);
        if !arrived.diffuse.is_black() {
            self.add(sources[0], weight * shading.color * arrived.diffuse * (material.diffuse * share));
        }
        if !arrived.specular.is_black() {
            self.add(sources[1], weight * material.specular * arrived.specular * share);
        }
    }

    /// A number for random numbers that no other light of this sample has.
    fn next_place(&mut self) -> u32 {
        self.lit += 1;
        self.lit
    }
}

#[cfg(test)]
mod tests;
