//! The integrators that need no samples of their own: anti-aliasing says where they look.

use super::Integrator;
use super::cutout::{Cutout, Shown};
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

/// One of them, for all or a part of what there is.
pub(crate) struct Sharp {
    kind: Kind,
    shown: Shown,
}

/// Which one is asked once for each ray of the eye, which costs nothing beside what it does then.
enum Kind {
    Whitted(Whitted),
    Normals(Normals),
    Depth(Depth),
    Uv(Uv),
}

impl Sharp {
    /// That which the scene wants. For integrators that take samples it is the classic one, whose picture is at least of the
    /// same things.
    pub(crate) fn of(scene: &CompiledScene) -> Sharp {
        let kind = match scene.settings.integrator {
            durer_scene::Integrator::Whitted
            | durer_scene::Integrator::Path { .. }
            | durer_scene::Integrator::AmbientOcclusion { .. } => Kind::Whitted(Whitted),
            durer_scene::Integrator::Normals => Kind::Normals(Normals),
            durer_scene::Integrator::Depth => Kind::Depth(Depth::of(scene)),
            durer_scene::Integrator::Uv => Kind::Uv(Uv),
        };
        Sharp { kind, shown: scene.shown }
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
        match self.shown {
            Shown::Everything => self.kind.radiance(scene, ray, known, sampler, observer),
            shown @ (Shown::Things | Shown::Coverage) => {
                Cutout { integrator: &self.kind, shown }.radiance(scene, ray, known, sampler, observer)
            }
        }
    }
}

impl Integrator for Kind {
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
            Kind::Whitted(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Kind::Normals(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Kind::Depth(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
            Kind::Uv(integrator) => integrator.radiance(scene, ray, known, sampler, observer),
        }
    }
}
