//! A point of the picture becomes what is seen there.

use crate::compile::CompiledScene;
use crate::film::Account;
use crate::holes::Known;
use crate::integrators::{Integrator, sharp::Sharp};
use crate::observer::{NotTraced, Observer, RayCounts, RayKind, SurfaceSeen};
use crate::sampler::{Purpose, Sampler};
use durer_geometry::{LANES, Packet, Ray};
use durer_imaging::Transfer;
use durer_math::{DVec2, Rgb};

/// What is seen through a point of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// In linear light; black if it was not finite.
    pub(crate) color: Rgb,
    /// As it looks on a screen, from 0 to 1.
    pub(crate) seen: [f32; 3],
    /// What is hit first: a number for each thing, of which particles are one each.
    pub(crate) thing: u32,
    /// ... and one for each smooth piece of it.
    pub(crate) piece: u32,
    /// True if nothing behind it can be seen.
    pub(crate) hides: bool,
    /// How far away it is, infinite for the background.
    pub(crate) depth: f32,
    /// The normal of shading there, 0 for the background.
    pub(crate) normal: [f32; 3],
    pub(crate) is_finite: bool,
}

impl Look {
    /// What is seen where nothing is looked at.
    const NOTHING: Look = Look {
        color: Rgb::BLACK,
        seen: [0.0; 3],
        thing: u32::MAX,
        piece: u32::MAX,
        hides: false,
        depth: f32::INFINITY,
        normal: [0.0; 3],
        is_finite: true,
    };
}

/// Looks at points of a picture.
pub(crate) trait Eye: Sync {
    /// Adds what is seen through each of these points, in pixels.
    fn looks(&self, points: &[DVec2], looks: &mut Vec<Look>, account: &mut Account);

    /// What is seen through one point.
    fn look(&self, point: DVec2, account: &mut Account) -> Look {
        let mut looks = Vec::with_capacity(1);
        self.looks(&[point], &mut looks, account);
        looks[0]
    }
}

/// Looks at a scene, with the integrator.
pub(crate) struct SceneEye<'s> {
    pub(crate) scene: &'s CompiledScene,
    pub(crate) integrator: Sharp,
    /// Once it says so nothing is traced any more: what is seen then is black, and whoever asked has to throw it away.
    pub(crate) stop: &'s (dyn Fn() -> bool + Sync),
}

impl<'s> SceneEye<'s> {
    /// One that never stops.
    pub(crate) fn new(scene: &'s CompiledScene) -> SceneEye<'s> {
        SceneEye::until(scene, &|| false)
    }

    /// One that stops once this says so.
    pub(crate) fn until(scene: &'s CompiledScene, stop: &'s (dyn Fn() -> bool + Sync)) -> SceneEye<'s> {
        SceneEye { scene, integrator: Sharp::of(scene), stop }
    }
}

/// The ray of the eye through a point of the picture that belongs to no pixel alone, and the random numbers for it. Through a
/// lens it goes at a point that chance chooses, the same whoever asks.
#[inline]
pub(crate) fn begin(scene: &CompiledScene, at: DVec2) -> (Ray, Sampler) {
    let sampler = Sampler::of_place(scene.settings.seed, at);
    let ray = match scene.camera.has_lens() {
        true => scene.camera.ray_through_lens(at, sampler.two(0, Purpose::Lens)),
        false => scene.camera.ray(at),
    };
    (ray, sampler)
}

impl Eye for SceneEye<'_> {
    fn looks(&self, points: &[DVec2], looks: &mut Vec<Look>, account: &mut Account) {
        if (self.stop)() {
            looks.extend(points.iter().map(|_| Look::NOTHING));
            return;
        }
        if let Some(vantage) = &self.scene.eye_vantage {
            looks.extend(points.iter().map(|&at| self.look_at(at, Known::Vantage(vantage), account)));
            return;
        }
        for points in points.chunks(LANES) {
            let [point] = points else {
                let rays: arrayvec::ArrayVec<Ray, LANES> = points.iter().map(|&at| begin(self.scene, at).0).collect();
                let hits = self.scene.world.closest_hits(&Packet::new(&rays), f64::INFINITY, u32::MAX);
                let known = points.iter().zip(hits);
                looks.extend(known.map(|(&at, hit)| self.look_at(at, Known::Hit(hit), account)));
                continue;
            };
            looks.push(self.look_at(*point, Known::Nothing, account));
        }
    }
}

impl SceneEye<'_> {
    fn look_at(&self, at: DVec2, known: Known<'_>, account: &mut Account) -> Look {
        let mut watch = Watch { scene: self.scene, rays: &mut account.rays, first: None };
        let (ray, sampler) = begin(self.scene, at);
        let color = self.integrator.radiance(self.scene, &ray, known, &sampler, &mut watch);
        let First { thing, piece, hides, depth, normal } = watch.first.unwrap_or(First::BACKGROUND);
        let is_finite = color.is_finite();
        if !is_finite {
            account.bad_sample(at);
        }
        let color = if is_finite { color } else { Rgb::BLACK };
        let seen = seen(color, self.scene.picture.transfer);
        Look { color, seen, thing, piece, hides, depth, normal, is_finite }
    }
}

/// About what a screen shows. The root is close to the curve of sRGB, and much quicker.
fn seen(color: Rgb, transfer: Transfer) -> [f32; 3] {
    let curve = |c: f32| match transfer {
        Transfer::Srgb => c.sqrt(),
        Transfer::Linear => c,
    };
    color.to_array().map(|c| if c > 0.0 { curve(c.min(1.0)) } else { 0.0 })
}

/// A number for one of the things that a primitive is. Those of things that lie side by side in a picture differ, which is
/// all that matters of them.
pub(crate) fn thing(primitive: u32, number: u32) -> u32 {
    primitive.wrapping_mul(0x9e37_79b1) ^ number
}

/// What is hit first.
#[derive(Clone, Copy)]
struct First {
    thing: u32,
    piece: u32,
    hides: bool,
    depth: f32,
    normal: [f32; 3],
}

impl First {
    const BACKGROUND: First =
        First { thing: u32::MAX, piece: u32::MAX, hides: false, depth: f32::INFINITY, normal: [0.0; 3] };
}

/// Counts rays, and notes the first surface.
struct Watch<'a> {
    scene: &'a CompiledScene,
    rays: &'a mut RayCounts,
    first: Option<First>,
}

impl Observer for Watch<'_> {
    fn ray_begins(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb) {
        self.rays.ray_begins(kind, depth, ray, weight);
    }

    fn surface(&mut self, seen: &SurfaceSeen) {
        if self.first.is_none() {
            let number = self.scene.world.particle_of(&seen.hit).unwrap_or(0);
            let material = &self.scene.materials[self.scene.material_at(&seen.hit) as usize];
            self.first = Some(First {
                thing: thing(seen.hit.primitive, number),
                piece: thing(seen.hit.primitive, self.scene.piece_of(&seen.hit)),
                hides: seen.opacity.is_none() && !material.is_clear(),
                depth: seen.length as f32,
                normal: seen.normal.to_array().map(|c| c as f32),
            });
        }
    }

    fn shadow_ray(&mut self) {
        self.rays.shadow_ray();
    }

    fn not_traced(&mut self, kind: RayKind, weight: Rgb, why: NotTraced) {
        self.rays.not_traced(kind, weight, why);
    }

    fn ray_ends(&mut self) {
        // The eye's ray met nothing: what its children meet does not exist.
        self.first = self.first.or(Some(First::BACKGROUND));
    }
}
