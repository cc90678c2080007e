//! What eight rays of the eye see, and how that lies to the lamps, found together before the rays are traced.
//!
//! It changes nothing but the speed: for a ray that nobody looked ahead for, the integrator finds the same by itself.

mod plain;

use crate::compile::{CompiledScene, OPAQUE};
use crate::visibility::SHORT_OF_LIGHT;
use durer_geometry::{Goal, Hit, LANES, Packet, Ray, Seen, Sight, Sights, Surface};
use durer_math::DVec2;
pub(crate) use plain::Sum;
use plain::{Plain, View};

/// With more lights than this, most are looked at one by one.
const MOST_LIGHTS: usize = 16;

/// What eight rays see.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ahead {
    rays: Option<Packet>,
    seen: Seen,
    /// What fog leaves of them, if there is any.
    visible: [f32; LANES],
    plain: Plain,
    /// For the first lights; of those without a vantage nothing is known.
    sights: Vec<Option<Sights>>,
}

impl Ahead {
    /// True if there is anything to be gained.
    pub(crate) fn pays(scene: &CompiledScene) -> bool {
        // Around the eye there may be media, and what is seen first may be a hole.
        let is_classic = matches!(scene.settings.integrator, durer_scene::Integrator::Whitted);
        is_classic && scene.eye_vantage.is_some() && scene.media_at_eye.is_empty() && !scene.has_holes
    }

    /// Looks through at most eight points of the picture, in pixels, where that [pays](Ahead::pays).
    pub(crate) fn look(&mut self, scene: &CompiledScene, points: &[DVec2]) {
        let Some(eye) = scene.eye_vantage.as_ref() else { return };
        let Some(pinhole) = scene.camera.pinhole() else { return };
        let rays = self.rays.get_or_insert_default();
        scene.world.rays_of(&pinhole, &scene.camera.on_screen(points), points.len(), rays);
        scene.world.see(eye, rays, &mut self.seen);
        if let Some(fog) = &scene.fog {
            self.visible = fog.visible_each(scene.world.simd(), self.seen.distances());
        }
        self.sights.resize_with(scene.lights.len().min(MOST_LIGHTS), || None);
        let lights = scene.lights.iter().zip(&scene.light_vantages);
        for (sights, (light, vantage)) in self.sights.iter_mut().zip(lights) {
            match vantage {
                Some(to) => {
                    let goal = Goal { to, reach: SHORT_OF_LIGHT, mask: OPAQUE, cone: light.cone() };
                    scene.world.sights(&self.seen, &goal, sights.get_or_insert_default());
                }
                None => *sights = None,
            }
        }
        let (seen, sights, visible) = (&self.seen, &self.sights, &self.visible);
        self.plain.find(scene, &View { rays, seen, sights, visible });
    }

    /// All that arrives along one of the rays, if that is known already; it is finite.
    #[inline(always)]
    pub(crate) fn sum(&self, lane: usize) -> Option<Sum> {
        self.plain.sum(lane)
    }

    /// What one of the rays sees.
    pub(crate) fn of(&self, lane: usize) -> SeenAhead<'_> {
        SeenAhead { ahead: self, lane }
    }
}

/// What one ray sees.
#[derive(Clone, Copy)]
pub(crate) struct SeenAhead<'a> {
    ahead: &'a Ahead,
    lane: usize,
}

impl SeenAhead<'_> {
    /// The ray, through this point of the picture.
    #[inline]
    pub(crate) fn ray(&self, scene: &CompiledScene, at: DVec2) -> Ray {
        match &self.ahead.rays {
            Some(rays) => rays.ray(self.lane),
            None => scene.camera.ray(at),
        }
    }

    /// What it hits first.
    #[inline]
    pub(crate) fn hit(&self) -> Option<Hit> {
        self.ahead.seen.hit(self.lane)
    }

    /// The part of the light from there that gets through the fog.
    #[inline]
    pub(crate) fn visible_through_fog(&self) -> f32 {
        self.ahead.visible[self.lane % LANES]
    }

    /// The surface there.
    #[inline]
    pub(crate) fn surface(&self) -> Surface {
        self.ahead.seen.surface(self.lane)
    }

    /// How that lies to the first lights, one after the other, as far as it is known.
    #[inline]
    pub(crate) fn sights(&self) -> impl Iterator<Item = Option<Sight>> {
        self.ahead.sights.iter().map(|sights| Some(sights.as_ref()?.get(self.lane)))
    }
}
