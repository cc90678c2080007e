//! Integrators: what light arrives along a ray. One file each.

pub(crate) mod ambient_occlusion;
pub(crate) mod cutout;
pub(crate) mod depth;
pub(crate) mod first_surface;
pub(crate) mod normals;
pub(crate) mod path;
pub(crate) mod sharp;
pub(crate) mod uv;
pub(crate) mod whitted;

#[cfg(test)]
mod tests;

use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::observer::Observer;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::Rgb;

/// Estimates the light arriving along one ray. Owns no loop over pixels, no thread and no film.
pub(crate) trait Integrator: Sync {
    /// How many neighboring pixels it looks at together: 1, 4, 16, 64 …
    fn together(&self) -> u32 {
        1
    }

    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb;

    /// The light of samples that are taken together: any ones of a pixel, or those with the same number of all pixels of a
    /// block.
    fn radiances<O: Observer>(&self, scene: &CompiledScene, samples: &mut [&mut Together<'_, O>]) {
        one_by_one(self, scene, samples);
    }
}

/// The light of samples of which each is taken by itself.
pub(crate) fn one_by_one<I: Integrator + ?Sized, O: Observer>(
    integrator: &I,
    scene: &CompiledScene,
    samples: &mut [&mut Together<'_, O>],
) {
    for sample in samples {
        let Together { ray, known, sampler, observer, light } = &mut **sample;
        *light = integrator.radiance(scene, ray, *known, sampler, observer);
    }
}

/// One of several samples that are taken together.
pub(crate) struct Together<'a, O> {
    pub(crate) ray: Ray,
    pub(crate) known: Known<'a>,
    pub(crate) sampler: Sampler,
    pub(crate) observer: O,
    /// What is found.
    pub(crate) light: Rgb,
}
