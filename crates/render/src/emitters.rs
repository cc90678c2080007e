//! All that gives light, to choose from: lamps, glowing shapes, the background.
//!
//! One of three kinds is chosen, about as often as it lights the receiver: what is in some place (lamps that weaken with
//! distance, glowing shapes; one of them by a tree), lamps that are as bright everywhere, and the background. How often each
//! choice is made is known for whatever is met, so that light found otherwise can be weighed against it.

mod shapes;
mod sky;
pub(crate) mod tree;

use crate::background::Look;
use crate::compile::CompiledScene;
use crate::lights::{Arriving, Light};
use durer_geometry::{Bounds, Hit, Ray, Surface};
use durer_math::{DVec2, DVec3, Rgb};
use shapes::Shapes;
use sky::Sky;
use std::f32::consts::PI;
use tree::{Cone, Item, LightTree};

/// A point that light falls on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    /// Where shadow rays start on the side that the ray came from.
    pub(crate) point: DVec3,
    /// The unit normal of shading there.
    pub(crate) normal: DVec3,
    /// True if light from behind counts, too.
    pub(crate) passes: bool,
}

/// Light from an emitter chosen at random, from a point on it chosen at random.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Where it comes from; unit length.
    pub(crate) direction: DVec3,
    /// How far away it is; infinite for the background and directional lights.
    pub(crate) distance: f64,
    /// Radiance; of lamps that are points, irradiance on a surface that faces it.
    pub(crate) light: Rgb,
    /// Density of the direction, per solid angle, times the probability of the emitter; of lamps that are points, the
    /// probability.
    pub(crate) pdf: f64,
    /// True if no direction found otherwise could meet it: of all lamps, those with a radius among them.
    pub(crate) is_point: bool,
    /// Its index in the scene's list of lights, if it is there.
    pub(crate) lamp: Option<usize>,
}

/// The emitters of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Emitters {
    shapes: Shapes,
    /// Indices of lamps that weaken with distance.
    near_lamps: Vec<u32>,
    /// Of the shapes, and after them the lamps that weaken with distance.
    tree: LightTree,
    /// Indices of the other lamps.
    far_lamps: Vec<u32>,
    /// The irradiance of each of them and those before it.
    far_irradiance: Vec<f64>,
    sky: Option<Sky>,
    /// True if there is but one emitter.
    is_one: bool,
}

/// The three kinds: what is in a place, lamps that are not, and the background.
type Chances = [f64; 3];
const NEAR: usize = 0;
const FAR: usize = 1;
const SKY: usize = 2;

/// The part of choices that goes by how much light there may be; the rest is for all kinds alike.
const INFORMED: f64 = 0.75;

impl Emitters {
    /// All that gives light in a scene that is complete but for this. `means` are the mean luminances that the emission of each
    /// material has all over its texture.
    pub(crate) fn of(scene: &CompiledScene, means: &[f64]) -> Emitters {
        let (shapes, mut items) = Shapes::of(scene, means);
        let (mut near_lamps, mut far_lamps, mut far_irradiance) = (Vec::new(), Vec::new(), Vec::new());
        let mut sum = 0.0;
        for (index, light) in (0_u32..).zip(&scene.lights) {
            let (brightness, id) = (light.luminance(), (shapes.len() + near_lamps.len()) as u32);
            if let Some((position, radius)) = light.place() {
                let bounds = Bounds { min: position, max: position }.widened(radius);
                let cone = light.cones().map_or(Cone::ALL, |(axis, [inner, outer])| Cone::of_spot(axis, inner, outer));
                if let Some(item) = Item::new(&bounds, brightness, cone, id) {
                    items.push(item);
                    near_lamps.push(index);
                    continue;
                }
            }
            if brightness > 0.0 {
                sum += brightness;
                far_lamps.push(index);
                far_irradiance.push(sum);
            }
        }
        let tree = LightTree::build(items, shapes.len() + near_lamps.len());
        let sky = Sky::new(&scene.background);
        let is_one = tree.len() + far_lamps.len() + usize::from(sky.is_some()) == 1;
        Emitters { shapes, near_lamps, tree, far_lamps, far_irradiance, sky, is_one }
    }

    /// True if there is nothing to choose from.
    pub(crate) fn is_one(&self) -> bool {
        self.is_one
    }

    /// Chooses an emitter and a point on it, by a number and two from 0 to less than 1.
    pub(crate) fn sample(
        &self,
        scene: &CompiledScene,
        receiver: &Receiver,
        choice: f64,
        at: DVec2,
    ) -> Option<LightSample> {
        let chances = self.chances(receiver);
        let mut choice = choice;
        let mut kind = NEAR;
        while kind < SKY && choice >= chances[kind] {
            choice -= chances[kind];
            kind += 1;
        }
        let chance = chances[kind];
        if chance <= 0.0 {
            return None;
        }
        let choice = (choice / chance).min(1.0_f64.next_down());
        let sample = match kind {
            NEAR => self.sample_near(scene, receiver, choice, at),
            FAR => self.sample_far(scene, receiver, choice, at),
            _ => self.sample_sky(scene, receiver, at),
        }?;
        Some(LightSample { pdf: sample.pdf * chance, ..sample })
    }

    fn sample_near(&self, scene: &CompiledScene, receiver: &Receiver, choice: f64, at: DVec2) -> Option<LightSample> {
        let (id, probability) = self.tree.sample(receiver, choice)?;
        let sample = match (id as usize).checked_sub(self.shapes.len()) {
            Some(lamp) => self.aim_at_lamp(scene, receiver.point, self.near_lamps[lamp] as usize, at)?,
            None => self.shapes.aim(scene, id as usize, receiver.point, at)?,
        };
        Some(LightSample { pdf: sample.pdf * probability, ..sample })
    }

    fn sample_far(&self, scene: &CompiledScene, receiver: &Receiver, choice: f64, at: DVec2) -> Option<LightSample> {
        let all = *self.far_irradiance.last()?;
        let index = self.far_irradiance.partition_point(|&sum| sum <= choice * all).min(self.far_lamps.len() - 1);
        let before = if index == 0 { 0.0 } else { self.far_irradiance[index - 1] };
        let sample = self.aim_at_lamp(scene, receiver.point, self.far_lamps[index] as usize, at)?;
        Some(LightSample { pdf: sample.pdf * (self.far_irradiance[index] - before) / all, ..sample })
    }

    fn sample_sky(&self, scene: &CompiledScene, receiver: &Receiver, at: DVec2) -> Option<LightSample> {
        let (look, pdf) = self.sky.as_ref()?.sample(&scene.background, receiver, at)?;
        let direction = look.direction;
        // From behind nothing comes but by way of casters, and there is no need to wait for a pixel from memory.
        let is_behind = !receiver.passes && direction.dot(receiver.normal) <= 0.0;
        let light = if is_behind { Rgb::BLACK } else { scene.background.light(&look) };
        Some(LightSample { direction, distance: f64::INFINITY, light, pdf, is_point: false, lamp: None })
    }

    /// A lamp. Those with a radius are balls that only this can find: no ray sees a lamp.
    pub(crate) fn aim_at_lamp(
        &self,
        scene: &CompiledScene,
        from: DVec3,
        index: usize,
        at: DVec2,
    ) -> Option<LightSample> {
        let light: &Light = &scene.lights[index];
        let arriving =
            if light.radius() == 0.0 { light.arriving(from)? } else { light.arriving_from_ball(from, at)? };
        let Arriving { direction, distance, light } = arriving;
        Some(LightSample { direction, distance, light: light * PI, pdf: 1.0, is_point: true, lamp: Some(index) })
    }

    /// The density with which [`Emitters::sample`] aims from a receiver at what a ray from there has hit.
    pub(crate) fn pdf_of_hit(
        &self,
        scene: &CompiledScene,
        receiver: &Receiver,
        _ray: &Ray,
        hit: &Hit,
        surface: &Surface,
        _distance: f64,
    ) -> f64 {
        let Some(id) = self.shapes.find(scene, hit) else { return 0.0 };
        let probability = self.chances(receiver)[NEAR] * self.tree.probability(receiver, id);
        if probability <= 0.0 {
            return 0.0;
        }
        probability * self.shapes.pdf(scene, id as usize, receiver.point, surface.point, hit.crossing.part)
    }

    /// The density with which [`Emitters::sample`] finds what is seen of the background.
    pub(crate) fn pdf_of_background(&self, scene: &CompiledScene, receiver: &Receiver, look: &Look) -> f64 {
        let Some(sky) = &self.sky else { return 0.0 };
        self.chances(receiver)[SKY] * sky.pdf(&scene.background, receiver, look)
    }

    /// How often each kind is chosen.
    fn chances(&self, receiver: &Receiver) -> Chances {
        let has = [!self.tree.is_empty(), !self.far_lamps.is_empty(), self.sky.is_some()];
        let kinds = has.iter().filter(|&&has| has).count();
        if kinds <= 1 {
            return has.map(|has| f64::from(u8::from(has)));
        }
        let far = self.far_irradiance.last().copied().unwrap_or(0.0);
        let light = [
            if has[NEAR] { self.tree.importance(receiver) } else { 0.0 },
            far,
            self.sky.as_ref().map_or(0.0, Sky::irradiance),
        ];
        let all: f64 = light.iter().sum();
        let alike = (1.0 - INFORMED) / kinds as f64;
        std::array::from_fn(|kind| match has[kind] {
            true if all > 0.0 && all.is_finite() => alike + INFORMED * light[kind] / all,
            true => 1.0 / kinds as f64,
            false => 0.0,
        })
    }

    /// A point on one of the glowing shapes.
    pub(crate) fn sample_shape(
        &self,
        scene: &CompiledScene,
        receiver: &Receiver,
        choice: f64,
        at: DVec2,
    ) -> Option<LightSample> {
        let (id, probability) = self.tree.sample(receiver, choice)?;
        if id as usize >= self.shapes.len() {
            return None;
        }
        let sample = self.shapes.aim(scene, id as usize, receiver.point, at)?;
        Some(LightSample { pdf: sample.pdf * probability, ..sample })
    }

    /// True if there are glowing shapes.
    #[inline]
    pub(crate) fn has_shapes(&self) -> bool {
        self.shapes.len() > 0
    }

    /// Glowing shapes.
    pub(crate) fn shapes(&self) -> &Shapes {
        &self.shapes
    }
}

#[cfg(test)]
mod tests;
