//! How much of a light gets through to a point.

use crate::compile::{CLEAR, CompiledScene, OPAQUE};
use crate::materials::Passage;
use crate::media::Media;
use crate::shading::{Shading, opacity_at};
use durer_geometry::{Hit, Primitive, Ray, Surface, Vantage};
use durer_math::Rgb;

/// A light that lies in a surface to the last bits is not hidden by it: shadow rays end this much, relatively, before
/// the light. Forty bits are many times the rounding of a hit and far below anything visible.
pub(crate) const SHORT_OF_LIGHT: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;

/// More surfaces on one straight way than this are not looked at.
pub(crate) const MOST_SURFACES: u32 = 100_000;

/// What is left of light on the way along `ray` over `distance`: nothing behind something opaque; else the product of
/// what all clear surfaces let pass and of what media take away; under path tracing also of the square of how much denser
/// what is left through holes is than what is around it, since radiance there is so many times as great. `media` are those
/// around the ray's origin.
///
/// If there is a vantage, the ray must be aimed at its point. It goes straight, also through what would bend it.
#[inline]
pub(crate) fn visibility(
    scene: &CompiledScene,
    media: &Media,
    ray: &Ray,
    distance: f64,
    light: Option<&Vantage>,
) -> Rgb {
    let reach = distance * SHORT_OF_LIGHT;
    let mut left = Rgb::WHITE;
    let mut clear = false;
    // Only through holes does light leave what bends it without being bent: then the index around is not the same on all of the
    // way, and surfaces must be met in their order.
    let changes = scene.stretches && !media.is_empty();
    let dark = scene.world.any_hit(ray, reach, light, |id, primitive| {
        if primitive.mask & OPAQUE != 0 {
            return true;
        }
        clear = true;
        if changes {
            return false;
        }
        left *= match scene.objects[id as usize].looks.is_uneven {
            false => through(scene.material(id).passed_if_even, primitive.count_crossings(ray, reach)),
            true => through_each(scene, id, primitive, media.ior(scene), ray, reach),
        };
        left.is_black()
    });
    if dark {
        Rgb::BLACK
    } else if scene.attenuates && (clear || !media.is_empty()) || changes && clear {
        left * through_media(scene, media, *ray, reach, changes)
    } else {
        left
    }
}

/// What is left after so many surfaces that let the same pass.
fn through(passed: Rgb, surfaces: u32) -> Rgb {
    (0..surfaces).fold(Rgb::WHITE, |left, _| left * passed)
}

/// What is left behind all surfaces of a primitive, each of which may let something else pass. What lets light go straight
/// does not change the index of refraction around it: that is the same on all of the way, unless that leads out of a hole.
fn through_each(scene: &CompiledScene, id: u32, primitive: &Primitive, around: f64, ray: &Ray, reach: f64) -> Rgb {
    let mut left = Rgb::WHITE;
    let _ = primitive.each_crossing(ray, reach, |ray, crossing, surface| {
        let hit = Hit { crossing: *crossing, primitive: id };
        left *= passed(scene, ray, &hit, surface, around);
        left.is_black()
    });
    left
}

/// What passes of light at a surface: what goes through where it is, and what goes past it where it is not.
fn passed(scene: &CompiledScene, ray: &Ray, hit: &Hit, surface: &Surface, around: f64) -> Rgb {
    let material = &scene.materials[scene.material_at(hit) as usize];
    let opacity = opacity_at(scene, hit, surface);
    let is_medium = scene.objects[hit.primitive as usize].looks.is_medium;
    let straight = match material.passage {
        Passage::Even => return material.passed(opacity),
        Passage::EvenSheets | Passage::Sheets if is_medium => Rgb::BLACK,
        Passage::EvenSheets => return material.passed(opacity),
        Passage::Sheets | Passage::Thin => Shading::at(scene, ray, hit).straight(scene, around),
        Passage::Closed => Rgb::BLACK,
    };
    straight * opacity + (Rgb::WHITE - opacity)
}

/// What media leave of light, and how radiance changes between them: goes from surface to surface, for the innermost medium
/// decides. Light that goes past a surface which is but partly there enters nothing, and what goes through it does: both are
/// followed. If asked for, it is also what surfaces let pass.
fn through_media(scene: &CompiledScene, media: &Media, ray: Ray, reach: f64, with_surfaces: bool) -> Rgb {
    Way { media: media.clone(), ray, reach, with_surfaces, surfaces: MOST_SURFACES, forks: MOST_FORKS }.left(scene)
}

/// Light is divided no more often than this on one way, so that time has a bound; from there on all of it enters.
const MOST_FORKS: u32 = 6;

/// The rest of a way of light through media.
#[derive(Clone)]
struct Way {
    media: Media,
    ray: Ray,
    reach: f64,
    /// What surfaces let pass is counted, too.
    with_surfaces: bool,
    /// No more than so many surfaces are looked at.
    surfaces: u32,
    forks: u32,
}

impl Way {
    /// What is left at its end of light at its beginning.
    fn left(mut self, scene: &CompiledScene) -> Rgb {
        let mut left = Rgb::WHITE;
        while self.surfaces > 0 {
            self.surfaces -= 1;
            let Some(hit) = scene.world.closest_hit(&self.ray, self.reach, CLEAR, None) else { break };
            left *= self.media.transmittance(scene, hit.crossing.t);
            let surface = scene.world.surface(&self.ray, &hit);
            if self.with_surfaces {
                left *= passed(scene, &self.ray, &hit, &surface, self.media.ior(scene));
                if left.is_black() {
                    return left;
                }
            }
            let side = self.ray.direction.dot(surface.normal);
            let inside = match scene.objects[hit.primitive as usize].looks.is_medium {
                true if side < 0.0 => self.part_entering(scene, &hit, &surface),
                _ => Rgb::WHITE,
            };
            self.reach -= hit.crossing.t;
            self.ray.origin = surface.point + surface.normal * surface.offset.copysign(side);
            if !scene.objects[hit.primitive as usize].looks.is_medium || inside.is_black() {
                continue;
            }
            if inside != Rgb::WHITE && self.forks > 0 {
                self.forks -= 1;
                left *=
                    (Rgb::WHITE - inside) * self.clone().left(scene) + inside * self.entering(&hit, true).left(scene);
                return left;
            }
            let before = if scene.stretches { self.media.ior(scene) } else { 1.0 };
            self = self.entering(&hit, side < 0.0);
            if scene.stretches {
                let stretch = before / self.media.ior(scene);
                left = left * (stretch * stretch) as f32;
            }
        }
        left * self.media.transmittance(scene, self.reach)
    }

    /// The same behind a boundary.
    fn entering(mut self, hit: &Hit, entering: bool) -> Way {
        let _ = self.media.cross(hit.primitive, entering);
        self
    }

    /// Of what passes the boundary of a medium from outside, the part that goes through and not past it.
    fn part_entering(&self, scene: &CompiledScene, hit: &Hit, surface: &Surface) -> Rgb {
        if !scene.objects[hit.primitive as usize].looks.has_holes {
            return Rgb::WHITE;
        }
        let past = Rgb::WHITE - opacity_at(scene, hit, surface);
        let all = passed(scene, &self.ray, hit, surface, self.media.ior(scene));
        let part = |past: f32, all: f32| if all > 0.0 { ((all - past) / all).clamp(0.0, 1.0) } else { 0.0 };
        Rgb::new(part(past.r, all.r), part(past.g, all.g), part(past.b, all.b))
    }
}
