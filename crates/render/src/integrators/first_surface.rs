//! What most simple integrators share: the first surface that an eye's ray meets is all that they look at.

use crate::compile::CompiledScene;
use crate::holes::{Known, meet};
use crate::observer::{Observer, RayKind, Source, SurfaceSeen};
use crate::shading::Shading;
use crate::visibility::MOST_SURFACES;
use durer_geometry::{Hit, Ray};
use durer_math::Rgb;

/// The first surface that a ray meets.
pub(crate) struct FirstSurface<'s> {
    pub(crate) hit: Hit,
    pub(crate) shading: Shading<'s>,
}

/// Follows a ray straight to the first surface that is there for half or more, and adds what is made of it: `None` stands for
/// the background.
pub(crate) fn look_at_first_surface<O: Observer>(
    scene: &CompiledScene,
    ray: &Ray,
    known: Known<'_>,
    observer: &mut O,
    make: impl FnOnce(Option<&FirstSurface<'_>>, &mut O) -> Rgb,
) -> Rgb {
    let (mut ray, mut known, mut kind) = (*ray, known, RayKind::Eye);
    let mut segments = 0;
    let mut first = None;
    while segments < MOST_SURFACES {
        segments += 1;
        observer.ray_begins(kind, 1, &ray, Rgb::WHITE);
        let met = meet(scene, &ray, known, observer);
        let Some(hit) = met.hit else { break };
        let shading = Shading::at(scene, &met.ray, &hit);
        let Shading { surface, color, opacity, from_outside, .. } = shading;
        let (length, normal) = (met.length, shading.normal());
        observer.surface(&SurfaceSeen { hit, length, surface, normal, color, opacity, from_outside });
        if opacity.is_none_or(|opacity| opacity.luminance() >= 0.5) {
            first = Some(FirstSurface { hit, shading });
            break;
        }
        (ray, known, kind) = (shading.ray_on(shading.direction), Known::Nothing, RayKind::Transmitted);
    }
    let color = make(first.as_ref(), observer);
    observer.contribution(if first.is_some() { Source::Shown } else { Source::Background }, color);
    (0..segments).for_each(|_| observer.ray_ends());
    color
}
