//! How bright what glows by a texture is on the whole: by looks at points spread evenly over it.
//!
//! Looks may all miss what glows, such as a small lit window in a dark wall. So what could glow is never taken to be dark: it counts
//! at least a part of what the whole texture gives in the mean. It is black, and not aimed at, only where all of the texture is.

use super::{Element, given_off};
use crate::compile::CompiledScene;
use durer_geometry::Extent;
use durer_math::{DVec2, DVec3};

/// The looks at one element, no more and, if there are few elements, no fewer.
const LOOKS: u32 = 256;
const LEAST_LOOKS: u32 = 8;
/// No more at all of them together, as long as each has the least.
const LOOKS_AT_ALL: usize = 1 << 22;
/// The part of the texture's mean that an element has at least. Where the texture is dark there indeed, no more than this part
/// of the choices is lost; where something was missed, it is chosen this many times too seldom at worst, if it shows all of the
/// texture.
const LEAST: f64 = 1.0 / 8.0;

/// How often to look at each element, if there are so many.
pub(super) fn looks(elements: usize) -> u32 {
    (LOOKS_AT_ALL / elements.max(1)).min(LOOKS as usize).max(LEAST_LOOKS as usize) as u32
}

/// The mean luminance that an element gives off, from outside; `mean` is that of the whole texture.
pub(super) fn luminance(scene: &CompiledScene, element: &Element, extent: &Extent, mean: f64, looks: u32) -> f64 {
    /// Far enough to see what faces there, all of it about alike.
    const AWAY: f64 = 4.0;
    let (middle, size) = (extent.bounds.center(), extent.bounds.size().length().max(f64::MIN_POSITIVE));
    let flat = extent.normal.map(|normal| [normal]);
    let round = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let ways: &[DVec3] = flat.as_ref().map_or(&round, |flat| flat);
    let each = looks.div_ceil(ways.len() as u32);
    let shape = &scene.world.primitives()[element.primitive as usize];
    let Some(aimable) = shape.aimable(element.element) else { return 0.0 };
    let (mut sum, mut count) = (0.0, 0.0);
    for &way in ways {
        let from = middle + way * (AWAY * size);
        for look in 0..each {
            // Points of Hammersley's.
            let across = (f64::from(look) + 0.5) / f64::from(each);
            let up = (f64::from(look.reverse_bits()) + 0.5) / 4_294_967_296.0;
            if let Some(aim) = shape.aim(&aimable, from, DVec2::new(across, up)) {
                sum += f64::from(given_off(scene, element.primitive, &aim).luminance());
                count += 1.0;
            }
        }
    }
    let seen = if count > 0.0 { sum / count } else { 0.0 };
    if seen.is_finite() { seen.max(LEAST * mean) } else { LEAST * mean }
}
