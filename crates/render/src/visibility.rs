//! How much of a light gets through to a point.

use crate::compile::{CLEAR, CompiledScene, OPAQUE};
use crate::media::Media;
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
    let mut left = Rgb::WHITE;
    let mut clear = false;
    let dark = scene.world.any_hit(ray, reach, scene.light_vantages[light].as_ref(), |id, primitive| {
        if primitive.mask & OPAQUE != 0 {
            return true;
        }
        clear = true;
        left *= through(scene.material(id).transparency, primitive.count_crossings(ray, reach));
        left.is_black()
    });
    if dark {
        Rgb::BLACK
    } else if scene.attenuates && (clear || !media.is_empty()) {
        left * through_media(scene, media, *ray, reach)
    } else {
        left
    }
}

/// What is left after so many surfaces of the same transparency.
fn through(transparency: Rgb, surfaces: u32) -> Rgb {
    (0..surfaces).fold(Rgb::WHITE, |left, _| left * transparency)
}

/// What media leave of light: goes from surface to surface, for the innermost medium decides.
fn through_media(scene: &CompiledScene, media: &Media, mut ray: Ray, mut reach: f64) -> Rgb {
    let mut left = Rgb::WHITE;
    let mut media = media.clone();
    // No shape has more than four surfaces one behind the other.
    for _ in 0..4 * scene.objects.len() {
        let Some(hit) = scene.world.closest_hit(&ray, reach, CLEAR, None) else { break };
        left *= media.transmittance(scene, hit.crossing.t);
        let surface = scene.world.surface(&ray, &hit);
        let side = ray.direction.dot(surface.normal);
        if scene.objects[hit.primitive as usize].is_medium {
            let _ = media.cross(hit.primitive, side < 0.0);
        }
        reach -= hit.crossing.t;
        ray.origin = surface.point + surface.normal * surface.offset.copysign(side);
    }
    left * media.transmittance(scene, reach)
}
