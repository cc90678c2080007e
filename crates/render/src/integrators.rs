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
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb;
}
