//! The integrators that need no samples of their own: anti-aliasing says where they look.

use super::Integrator;
use super::depth::Depth;
use super::normals::Normals;
use super::uv::Uv;
use super::whitted::Whitted;
use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::observer::Observer;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::Rgb;

/// One of them. Which one is asked once for each ray of the eye, which costs nothing beside what it does then.
pub(crate) enum Sharp {
    Whitted(Whitted),
    Normals(Normals),
    Depth(Depth),
    Uv(Uv),
}

impl Sharp {
    /// That which the scene wants. For integrators that take samples it is the classic one, whose picture is at least of the
    /// same things.
    pub(crate) fn of(scene: &CompiledScene) -> Sharp {
        match scene.settings.integrator {
            durer_scene::Integrator::Whitted
            | durer_scene::Integrator::Path { .. }
            | durer_scene::Integrator::AmbientOcclusion { .. } => Sharp::Whitted(Whitted),
            durer_scene::Integrator::Normals => Sharp::Normals(Normals),
            durer_scene::Integrator::Depth => Sharp::Depth(Depth::of(scene)),
            durer_scene::Integrator::Uv => Sharp::Uv(Uv),
        }
    }
}

impl Integrator for Sharp {
    #[inline]
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        match self {
            Sharp::Whitted(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Sharp::Normals(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Sharp::Depth(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Sharp::Uv(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
        }
    }
}
