//! Ways from a surface by a [caster](crate::casters) to the sky: found by aiming, on purpose, or by the surface, by chance. Either is
//! weighed against the other where it arrives.

use super::{Aimed, Path, Pause, State, Vertex, power_heuristic};
use crate::background::Look;
use crate::casters::Passage;
use crate::compile::CompiledScene;
use crate::media::Media;
use crate::observer::{Observer, RayKind, Weighing};
use crate::sampler::Purpose;
use crate::shading::Shading;
use durer_geometry::Hit;
use durer_math::DVec3;

/// From so many surfaces that spread a path light is aimed at through casters, too.
pub(super) const MOST_CASTING: u32 = 2;

/// A way from a surface that spreads light by a caster, as far as it fits.
#[derive(Clone, Copy)]
pub(super) struct Cast {
    start: Aimed,
    /// Where it started to.
    toward: DVec3,
    /// Surfaces met before that, its own among them.
    met: u32,
    /// By which it goes, and how: not known before it is there.
    caster: Option<(u32, Passage)>,
    /// How many surfaces of it were met.
    surfaces: u32,
    /// True if the caster is left behind.
    is_out: bool,
    /// True if it was found by aiming at light through the caster, not by the surface.
    is_planned: bool,
}

impl Cast {
    /// A way that starts from a surface which is met after so many.
    pub(super) fn new(start: Aimed, toward: DVec3, met: u32) -> Cast {
        Cast { start, toward, met: met + 1, caster: None, surfaces: 0, is_out: false, is_planned: false }
    }

    /// It goes on from a surface that is met after so many; `None` if it does not fit there.
    pub(super) fn met(mut self, scene: &CompiledScene, shading: &Shading<'_>, met: u32, passes: bool) -> Option<Cast> {
        let is_next = self.met + self.surfaces == met && !self.is_out;
        let found = scene.casters.find(shading.primitive).filter(|_| is_next)?;
        // Of cylinders, the others are caps.
        let is_side = shading.part() == 0;
        let (caster, passage) = match (self.surfaces, is_side, passes) {
            (0, true, true) => (found, Passage::Through),
            (0, true, false) => (found, Passage::Back),
            (0, false, true) => (found, Passage::Along),
            _ => self.caster?,
        };
        let goes_on = match (passage, self.surfaces) {
            (_, 0) => true,
            (Passage::Through, _) => is_side && passes,
            (Passage::Back, _) => false,
            (Passage::Along, _) => is_side != passes,
        };
        self.is_out = passage == Passage::Back || self.surfaces > 0 && passes;
        self.surfaces += 1;
        let is_same = found == caster && self.caster.is_none_or(|planned| planned == (caster, passage));
        self.caster = Some((caster, passage));
        (goes_on && is_same).then_some(self)
    }

    /// True if it comes out of the scene, when it has met so many surfaces.
    fn arrives(&self, met: u32) -> bool {
        self.is_out && self.met + self.surfaces == met
    }

    /// True if a planned way is to meet what it has hit.
    pub(super) fn fits(&self, scene: &CompiledScene, hit: &Hit) -> bool {
        self.caster.is_some_and(|(caster, _)| scene.casters.get(caster).primitive == hit.primitive) && !self.is_out
    }

    /// True if a planned way is to pass a part of its caster.
    pub(super) fn passes(&self, part: u32) -> bool {
        match self.caster {
            Some((_, Passage::Through)) => true,
            Some((_, Passage::Along)) => part != 0,
            Some((_, Passage::Back)) | None => false,
        }
    }
}

impl<O: Observer> Path<'_, O> {
    /// True if light is aimed at through casters from the surface that the last segment meets.
    pub(super) fn may_aim_by_casters(&self) -> bool {
        !self.scene.casters.is_empty() && self.state.spreads < MOST_CASTING && self.media.is_empty()
    }

    /// Adds what arrives by way of a caster of light of the sky in a direction that is found with this density, where so many ways
    /// go on.
    #[inline(never)]
    pub(super) fn aim_by_caster(&mut self, vertex: &Vertex<'_, '_>, light: (DVec3, f64), ways: u32) {
        let Vertex { shading, frame, out, bsdf, receiver, .. } = vertex;
        let casters = &self.scene.casters;
        let choice = self.sampler.two(self.step(), Purpose::Caster);
        let Some((caster, passage)) = casters.choose(receiver, light, choice) else { return };
        let (state, pause) = (self.state, std::mem::replace(&mut self.pause, Pause::Nowhere));
        for toward in casters.get(caster).rays(receiver.point, light.0, passage) {
            let (scattered, pdf) = bsdf.evaluate(*out, frame.to_local(toward));
            let scattered = scattered * shading.kept(toward) as f32;
            if scattered.is_black() || frame.to_local(toward).z <= 0.0 || shading.is_on_far_side(toward) {
                continue;
            }
            let start = Aimed { receiver: **receiver, pdf: pdf * f64::from(ways) };
            let plan = Cast::new(start, toward, state.met);
            let cast = Cast { caster: Some((caster, passage)), is_planned: true, ..plan };
            self.state = State {
                weight: state.weight * scattered,
                depth: state.depth + 1,
                met: state.met + 1,
                aimed: None,
                cast: Some(cast),
                ..state
            };
            self.go_on(RayKind::Cast, shading.ray_back(toward));
            self.follow_to_the_end();
            (self.state, self.media) = (state, Media::default());
        }
        self.pause = pause;
    }

    /// The way by a caster that it was sent on purpose.
    pub(super) fn plan(&self) -> Option<&Cast> {
        self.state.cast.as_ref().filter(|cast| cast.is_planned)
    }

    /// What light of the sky counts that the last segment has found.
    pub(super) fn part_of_sky(&mut self, look: &Look) -> f32 {
        let scene = self.scene;
        let arrives = self.state.cast.filter(|cast| cast.arrives(self.state.met));
        let Some(Cast { start: Aimed { receiver, pdf }, toward, caster: Some(caster), surfaces, is_planned, .. }) =
            arrives
        else {
            return match self.plan() {
                Some(_) => 0.0,
                None => self.part_of_found(|receiver| scene.emitters.pdf_of_background(scene, receiver, look)),
            };
        };
        let of_light = scene.emitters.pdf_of_background(scene, &receiver, look);
        let by_aiming = scene.casters.density(&receiver, toward, caster, surfaces, (look.direction, of_light));
        let (part, counts) = match is_planned {
            true if by_aiming > 0.0 => {
                let part = power_heuristic(by_aiming, pdf);
                (part, part / by_aiming)
            }
            true => return 0.0,
            false => {
                let part = power_heuristic(pdf, by_aiming);
                (part, part)
            }
        };
        self.observer.weighing(&Weighing { by_surface: pdf, by_aiming, part });
        counts as f32
    }
}
