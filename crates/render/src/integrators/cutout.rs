//! Pictures of things without what is behind them: where the eye's rays meet nothing, nothing is shown, and how often that is
//! so is a picture of its own. What is but partly there counts as there, with what is seen through it; only holes do not.

use super::{Integrator, Together, one_by_one};
use crate::compile::CompiledScene;
use crate::holes::{Known, meet};
use crate::observer::{Observer, RayKind, SurfaceSeen};
use crate::sampler::Sampler;
use crate::shading::Shading;
use durer_geometry::Ray;
use durer_math::Rgb;

/// What the eye is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Shown {
    /// All that there is.
    #[default]
    Everything,
    /// The background is black where the eye sees it at first hand. What it lights and what mirrors show of it stays.
    Things,
    /// White where there is anything, black where there is only the background.
    Coverage,
}

/// An integrator that shows only so much.
pub(crate) struct Cutout<'i, I> {
    pub(crate) integrator: &'i I,
    pub(crate) shown: Shown,
}

impl<I: Integrator> Integrator for Cutout<'_, I> {
    fn together(&self) -> u32 {
        self.integrator.together()
    }

    #[inline]
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        match self.shown {
            Shown::Everything => self.integrator.radiance(scene, ray, known, sampler, observer),
            Shown::Things if meets_something(scene, ray, known) => {
                self.integrator.radiance(scene, ray, known, sampler, observer)
            }
            Shown::Things => {
                observer.ray_begins(RayKind::Eye, 1, ray, Rgb::WHITE);
                observer.ray_ends();
                Rgb::BLACK
            }
            Shown::Coverage => coverage(scene, ray, known, observer),
        }
    }

    fn radiances<O: Observer>(&self, scene: &CompiledScene, samples: &mut [&mut Together<'_, O>]) {
        // What sees nothing has no part in what the others do together.
        let (mut to_show, mut alone): (Vec<&mut Together<'_, O>>, Vec<&mut Together<'_, O>>) =
            samples.iter_mut().map(|sample| &mut **sample).partition(|sample| match self.shown {
                Shown::Everything => true,
                Shown::Things => meets_something(scene, &sample.ray, sample.known),
                Shown::Coverage => false,
            });
        self.integrator.radiances(scene, &mut to_show);
        one_by_one(self, scene, &mut alone);
    }
}

/// Nobody watches.
struct Silent;

impl Observer for Silent {}

fn meets_something(scene: &CompiledScene, ray: &Ray, known: Known<'_>) -> bool {
    meet(scene, ray, known, &mut Silent).hit.is_some()
}

#[inline(never)]
fn coverage<O: Observer>(scene: &CompiledScene, ray: &Ray, known: Known<'_>, observer: &mut O) -> Rgb {
    observer.ray_begins(RayKind::Eye, 1, ray, Rgb::WHITE);
    let met = meet(scene, ray, known, observer);
    if let Some(hit) = met.hit {
        let shading = Shading::at(scene, &met.ray, &hit);
        let Shading { surface, color, opacity, from_outside, .. } = shading;
        let (length, normal) = (met.length, shading.normal());
        observer.surface(&SurfaceSeen { hit, length, surface, normal, color, opacity, from_outside });
    }
    observer.ray_ends();
    if met.hit.is_some() { Rgb::WHITE } else { Rgb::BLACK }
}
