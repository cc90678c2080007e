//! The texture coordinates of what is seen first, as a color.

use super::Integrator;
use super::first_surface::look_at_first_surface;
use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::observer::Observer;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::Rgb;

/// Shows u as red and v as green; of those outside of 0 to 1 what lies behind the point. The background is black.
/// Of each pixel the middle is shown: means would be wrong where coordinates begin anew, of 0.99 and 0.01 in the middle between.
pub(crate) struct Uv;

impl Integrator for Uv {
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        _sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        look_at_first_surface(scene, ray, known, observer, |first, _| {
            first.map_or(Rgb::BLACK, |first| {
                let uv = scene.world.uv(first.shading.surface.point, &first.hit);
                let part = |x: f64| if (0.0..=1.0).contains(&x) { x } else { x - x.floor() };
                Rgb::new(part(uv.x) as f32, part(uv.y) as f32, 0.0)
            })
        })
    }
}
