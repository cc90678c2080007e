//! How far away what is seen first is, as a gray.

use super::Integrator;
use super::first_surface::look_at_first_surface;
use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::observer::Observer;
use crate::sampler::Sampler;
use durer_geometry::{Bounds, Ray};
use durer_math::{DVec3, Rgb};

/// Shows the depth along the view: white where the box around the scene begins, and [`FARTHEST`] where it ends; from there on,
/// where infinite planes lie, less and less. The background is black. (The numbers themselves are in the layer `depth`.)
pub(crate) struct Depth {
    /// Where the box around the scene begins and ends.
    near: f64,
    far: f64,
}

/// The gray of what is farthest away in the box around the scene.
const FARTHEST: f64 = 0.1;

impl Depth {
    /// One for a scene as its camera sees it.
    pub(crate) fn of(scene: &CompiledScene) -> Depth {
        let Bounds { min, max } = scene.world.bounds();
        let corners = (0..8).map(|bits| {
            let pick = |bit: i32, min: f64, max: f64| if bits >> bit & 1 == 0 { min } else { max };
            DVec3::new(pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z))
        });
        let depths = corners.map(|corner| scene.camera.depth_of(corner));
        let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(near, far), depth| (near.min(depth), far.max(depth)));
        let (near, far) = (near.max(0.0), far);
        match near.is_finite() && far.is_finite() && far > near {
            true => Depth { near, far },
            // Infinite planes alone, or nothing that is before the eye.
            false => Depth { near: 0.0, far: 10.0 },
        }
    }

    /// The gray of a depth.
    fn gray(&self, depth: f64) -> f64 {
        let share = (depth - self.near) / (self.far - self.near);
        if share <= 1.0 { 1.0 - (1.0 - FARTHEST) * share.max(0.0) } else { FARTHEST / share }
    }
}

impl Integrator for Depth {
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        _sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        look_at_first_surface(scene, ray, known, observer, |first, _| {
            let depth = first.map(|first| scene.camera.depth_of(first.shading.surface.point));
            depth.map_or(Rgb::BLACK, |depth| Rgb::gray(self.gray(depth) as f32))
        })
    }
}
