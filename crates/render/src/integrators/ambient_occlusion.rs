//! Ambient occlusion: how much of a white sky each point sees. One ray toward it for each sample.

use super::Integrator;
use super::first_surface::look_at_first_surface;
use crate::camera::concentric_disc;
use crate::compile::CompiledScene;
use crate::frame::Frame;
use crate::holes::Known;
use crate::media::Media;
use crate::observer::Observer;
use crate::sampler::{Purpose, Sampler};
use crate::visibility::visibility;
use durer_geometry::Ray;
use durer_math::{DVec3, Rgb};

/// Shows the share of the sky that is not hidden from a point, directions weighed by their cosine, as light from it falls:
/// (1/π) ∫ V cos θ dω. What is clear lets it through, straight; of what is colored the
/// luminance counts, for this is a share. The background is white, for nothing hides the sky there.
pub(crate) struct AmbientOcclusion {
    /// What is further away hides nothing; may be infinite.
    pub(crate) distance: f64,
}

impl Integrator for AmbientOcclusion {
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        let media = if scene.media_at_eye.is_empty() { Media::default() } else { Media::around(scene, ray) };
        look_at_first_surface(scene, ray, known, observer, |first, observer| {
            first.map_or(Rgb::WHITE, |first| {
                let shading = &first.shading;
                let direction = Frame::around(shading.normal()).to_world(cosine_hemisphere(sampler));
                observer.shadow_ray();
                share(visibility(scene, &media, &shading.ray_back(direction.normalize()), self.distance, None))
            })
        })
    }
}

/// The gray of what is left of white light. (A gray itself would lose its last digit as luminance.)
fn share(left: Rgb) -> Rgb {
    if left.r == left.g && left.g == left.b { left } else { Rgb::gray(left.luminance()) }
}

/// A direction about the z axis with density cos θ / π (Malley's method: points of a disc, raised to the hemisphere).
fn cosine_hemisphere(sampler: &Sampler) -> DVec3 {
    let disc = concentric_disc(sampler.two(1, Purpose::Direction));
    DVec3::new(disc.x, disc.y, (1.0 - disc.length_squared()).max(0.0).sqrt())
}
