//! Holes in surfaces, where opacity is 0: rays go on through them as if there were no surface, and cost no depth.
//!
//! Those in what is filled with a medium are left to shading, which knows how to leave a medium.

use crate::ahead::SeenAhead;
use crate::compile::CompiledScene;
use crate::observer::Observer;
use crate::shading::opacity_at;
use crate::visibility::MOST_SURFACES;
use durer_geometry::{Hit, Ray, Vantage};

/// What a ray meets first.
pub(crate) struct Met {
    /// The ray, or what goes on of it behind the last hole: the hit is one of this ray.
    pub(crate) ray: Ray,
    pub(crate) hit: Option<Hit>,
    /// From where the ray began to the hit; infinite if there is none.
    pub(crate) length: f64,
}

/// The same without a copy of the ray, for what is mostly without holes.
pub(crate) struct Found {
    /// What goes on of the ray behind the last hole, if there are any: the hit is one of this.
    pub(crate) onward: Option<Ray>,
    pub(crate) hit: Option<Hit>,
    /// From where the ray began to the hit; infinite if there is none.
    pub(crate) length: f64,
}

/// What is known of a ray before it is traced. It changes nothing but the speed.
#[derive(Clone, Copy)]
pub(crate) enum Known<'a> {
    /// Nothing.
    Nothing,
    /// What can be seen from where it begins.
    Vantage(&'a Vantage),
    /// What it hits.
    Hit(Option<Hit>),
    /// What it hits, and how that lies to the lights.
    Seen(SeenAhead<'a>),
}

impl<'a> Known<'a> {
    /// What was seen ahead.
    #[inline]
    pub(crate) fn seen(self) -> Option<SeenAhead<'a>> {
        match self {
            Known::Seen(seen) => Some(seen),
            Known::Nothing | Known::Vantage(_) | Known::Hit(_) => None,
        }
    }
}

/// What a ray meets first but holes.
#[inline(always)]
pub(crate) fn meet(scene: &CompiledScene, ray: &Ray, known: Known<'_>, observer: &mut impl Observer) -> Met {
    let Found { onward, hit, length } = find(scene, ray, known, observer);
    Met { ray: onward.unwrap_or(*ray), hit, length }
}

/// What a ray meets first but holes.
#[inline(always)]
pub(crate) fn find(scene: &CompiledScene, ray: &Ray, known: Known<'_>, observer: &mut impl Observer) -> Found {
    let hit = match known {
        Known::Hit(hit) => hit,
        Known::Seen(seen) => seen.hit(),
        Known::Vantage(vantage) => scene.world.closest_hit(ray, f64::INFINITY, u32::MAX, Some(vantage)),
        Known::Nothing => scene.world.closest_hit(ray, f64::INFINITY, u32::MAX, None),
    };
    match hit {
        Some(hit) if scene.has_holes => behind_holes(scene, ray, hit, observer),
        Some(hit) => Found { onward: None, hit: Some(hit), length: hit.crossing.t },
        None => Found { onward: None, hit: None, length: f64::INFINITY },
    }
}

/// Goes on as long as what is hit is a hole.
#[inline(never)]
fn behind_holes(scene: &CompiledScene, ray: &Ray, first: Hit, observer: &mut impl Observer) -> Found {
    let (mut ray, mut hit, mut length) = (*ray, first, first.crossing.t);
    for _ in 0..MOST_SURFACES {
        let looks = &scene.objects[hit.primitive as usize].looks;
        let surface = scene.world.surface(&ray, &hit);
        if !looks.has_holes || looks.is_medium || !opacity_at(scene, &hit, &surface).is_black() {
            return Found { onward: Some(ray), hit: Some(hit), length };
        }
        observer.hole(&hit, &surface, length);
        let onward = surface.offset.copysign(ray.direction.dot(surface.normal));
        ray.origin = surface.point + surface.normal * onward;
        match scene.world.closest_hit(&ray, f64::INFINITY, u32::MAX, None) {
            Some(next) => (hit, length) = (next, length + next.crossing.t),
            None => break,
        }
    }
    Found { onward: Some(ray), hit: None, length: f64::INFINITY }
}
