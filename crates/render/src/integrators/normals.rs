//! The normal of what is seen first, as a color.

use super::Integrator;
use super::first_surface::look_at_first_surface;
use crate::compile::CompiledScene;
use crate::holes::Known;
use crate::observer::Observer;
use crate::sampler::Sampler;
use durer_geometry::Ray;
use durer_math::Rgb;

/// Shows the unit normal by which light falls, in world space and on the side that is seen: x, y and z from -1 to 1 are red,
/// green and blue from 0 to 1. The background is black.
pub(crate) struct Normals;

impl Integrator for Normals {
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
                let shown = first.shading.normal() * 0.5 + 0.5;
                Rgb::from(shown.to_array().map(|c| c as f32))
            })
        })
    }
}
