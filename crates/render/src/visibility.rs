//! How much of a light gets through to a point.

use crate::compile::{CLEAR, CompiledScene, OPAQUE};
use crate::media::Media;
use crate::shading::Shading;
use durer_geometry::Ray;
use durer_math::Rgb;

/// A light that lies in a surface to the last bits is not hidden by it: shadow rays end this much, relatively, before
/// the light. Forty bits are many times the rounding of a hit and far below anything visible.
const SHORT_OF_LIGHT: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;

/// What is left of light on the way along `ray` over `distance`: nothing behind something opaque; else the product of
/// the transparencies of all clear surfaces and of what media take away. `media` are those around the ray's origin.
///
/// The ray must be aimed at the light with the index `light`. It goes straight, also through what would bend it.
#[inline]
pub(crate) fn visibility(scene: &CompiledScene, media: &Media, ray: &Ray, distance: f64, light: usize) -> Rgb {
    let reach = distance * SHORT_OF_LIGHT;
    let met = scene.world.classes_met(ray, reach, OPAQUE, scene.light_vantages[light].as_ref());
    if met & OPAQUE != 0 {
        Rgb::BLACK
    } else if met & CLEAR != 0 || !media.is_empty() {
        through_clear(scene, media, *ray, reach)
    } else {
        Rgb::WHITE
    }
}

fn through_clear(scene: &CompiledScene, media: &Media, mut ray: Ray, mut reach: f64) -> Rgb {
    let mut left = Rgb::WHITE;
    let mut media = if scene.attenuates { media.clone() } else { Media::default() };
    while let Some(hit) = scene.world.closest_hit(&ray, reach, CLEAR, None) {
        let shading = Shading::at(scene, &ray, &hit);
        left *= shading.material.transparency;
        if scene.attenuates {
            left *= media.transmittance(scene, hit.crossing.t);
            if shading.material.is_medium() {
                let _ = media.cross(hit.primitive, shading.from_outside);
            }
        }
        if left.is_black() {
            return left;
        }
        reach -= hit.crossing.t;
        ray = shading.ray_on(ray.direction);
    }
    if scene.attenuates {
        left *= media.transmittance(scene, reach);
    }
    left
}
