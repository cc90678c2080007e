//! Path tracing: the light that really arrives along a ray, estimated.
//!
//! One path is followed from the eye. Where it meets a surface, light is looked for in two ways: by aiming at an emitter,
//! and by going on in a direction that the surface likes and meeting an emitter there. Each finds some light better than the
//! other; the power heuristic weighs them (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, §9).
//! Paths of little weight end by Russian roulette. Where a sample first meets a surface that spreads light, it may be split:
//! what comes by way of other things is most of the noise, and the way to there is traced once for several tries. And what it
//! finds there may be [reused](reuse) by the pixels around.
//!
//! As with the classic integrator, a sample is one sum of contributions that carry their full weight.

mod cast;
mod reuse;

use super::{Integrator, Together, one_by_one};
use crate::bsdf::{Bsdf, How};
use crate::compile::CompiledScene;
use crate::emitters::{LightSample, Receiver};
use crate::frame::Frame;
use crate::holes::{Known, meet};
use crate::media::Media;
use crate::observer::{LightSeen, NotTraced, Observer, RayKind, Scattering, Source, SurfaceSeen, Way, Weighing};
use crate::sampler::{Purpose, Sampler};
use crate::shading::Shading;
use crate::surfaces::Indices;
use crate::visibility::{MOST_SURFACES, visibility};
use cast::{Cast, MOST_CASTING};
use durer_geometry::Ray;
use durer_math::{DVec3, Rgb};
use durer_scene::PathSettings;

/// The path tracer.
pub(crate) struct PathTracer(pub(crate) PathSettings);

/// Russian roulette begins with segments of this number.
const FIRST_ROULETTE: u32 = 3;
/// Paths of more weight than this go on: what roulette saves on them is less than the noise that it brings, above all where
/// few of many paths find the light. Found by trial, with a box and a thousand things under a sky; to end all in proportion to
/// their weight took 1.1 and 1.6 times as long to the same error. (Veach 1997, §10.4.1, has the theory.)
const WORTHWHILE: f32 = 0.3;
/// So many segments of a path from the eye are taken for what is [seen](Bsdf::sample_seen) in glass: in stacks of panes all that
/// goes through would be the noisier.
const DEEPEST_SEEN: u32 = 3;
/// No path goes on with a greater chance than this that has lost nothing: between perfect mirrors it would not end.
const MOST_LIKELY: f32 = 0.99;

impl Integrator for PathTracer {
    fn together(&self) -> u32 {
        self.0.reuse
    }

    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        let mut path = Path::new(self, (scene, ray), sampler, observer);
        if self.0.split > 1 {
            path.pause = Pause::WhereSpread;
        }
        let segments = path.follow(known);
        if let Some(paused) = path.paused.take() {
            path.branch(&paused.vertex());
        }
        path.end_rays(segments);
        path.sum
    }

    fn radiances<O: Observer>(&self, scene: &CompiledScene, samples: &mut [&mut Together<'_, O>]) {
        match self.0.reuse {
            1 => one_by_one(self, scene, samples),
            _ => reuse::trace(self, scene, samples),
        }
    }
}

/// A path as far as it goes.
struct Path<'a, O> {
    tracer: &'a PathTracer,
    scene: &'a CompiledScene,
    sampler: Sampler,
    /// Where it is to be stopped …
    pause: Pause,
    /// … and where it was.
    paused: Option<Paused<'a>>,
    /// What it counts among those that a sample is split into.
    share: f32,
    /// True while what is added up is not what arrives at the eye.
    is_apart: bool,
    /// Around the origin of its last segment.
    media: Media,
    state: State,
    sum: Rgb,
    observer: &'a mut O,
}

/// Where a path is not to go on by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pause {
    Nowhere,
    /// At the first surface that spreads light, when light was aimed at from there.
    WhereSpread,
    /// At the surface that it meets after so many, if it may be [reused](reuse) there, before light is aimed at.
    AfterSurfaces(u32),
}

/// Where a path meets a surface.
#[derive(Clone, Copy)]
struct Vertex<'v, 'a> {
    shading: &'v Shading<'a>,
    frame: &'v Frame,
    /// Where the path came from, in the frame.
    out: DVec3,
    bsdf: &'v Bsdf,
    indices: Indices,
    receiver: &'v Receiver,
}

/// Where a path was paused: a copy of the vertex, which the many where none is do without.
struct Paused<'a> {
    shading: Shading<'a>,
    frame: Frame,
    out: DVec3,
    bsdf: Bsdf,
    indices: Indices,
    receiver: Receiver,
}

impl<'a> Paused<'a> {
    fn vertex(&self) -> Vertex<'_, 'a> {
        let Paused { shading, frame, out, bsdf, indices, receiver } = self;
        Vertex { shading, frame, out: *out, bsdf, indices: *indices, receiver }
    }
}

impl<'a> Vertex<'_, 'a> {
    fn paused(&self) -> Paused<'a> {
        let Vertex { shading, frame, out, bsdf, indices, receiver } = *self;
        Paused { shading: *shading, frame: *frame, out, bsdf: *bsdf, indices, receiver: *receiver }
    }
}

/// Light from an emitter that was aimed at.
struct Arriving {
    source: Source,
    /// In the frame of the surface.
    toward: DVec3,
    /// What of it is scattered back to where the path came from, times the cosine.
    scattered: Rgb,
    /// Radiance over the density, as far as it counts.
    light: Rgb,
}

/// The last segment of a path.
#[derive(Clone, Copy)]
struct State {
    kind: RayKind,
    ray: Ray,
    depth: u32,
    /// Surfaces met before it, those that it passed straight through, too.
    met: u32,
    /// What light at its start counts in the sample.
    weight: Rgb,
    /// The part of the weight that is due to radiance being another in another medium, and says nothing of how much light is left.
    scale: f32,
    /// How it was found, if light could have been aimed at instead.
    aimed: Option<Aimed>,
    /// How it came to its last segment by way of a caster, if light could have been aimed at through that.
    cast: Option<Cast>,
    /// How many surfaces have spread it; from the first ones that do, light is aimed at through casters.
    spreads: u32,
    /// How far it has come through fog since it was last bent or scattered.
    way: f64,
}

/// How a direction was found that aiming at lights might have found as well.
#[derive(Clone, Copy)]
struct Aimed {
    receiver: Receiver,
    /// Density of the direction, by the surface; of several, the sum.
    pdf: f64,
}

impl<'a, O: Observer> Path<'a, O> {
    /// One that begins with a ray of the eye.
    fn new(
        tracer: &'a PathTracer,
        (scene, ray): (&'a CompiledScene, &Ray),
        sampler: &Sampler,
        observer: &'a mut O,
    ) -> Path<'a, O> {
        let media = if scene.media_at_eye.is_empty() { Media::default() } else { Media::around(scene, ray) };
        let state = State {
            kind: RayKind::Eye,
            ray: *ray,
            depth: 1,
            met: 0,
            weight: Rgb::WHITE,
            scale: 1.0,
            aimed: None,
            cast: None,
            spreads: 0,
            way: 0.0,
        };
        Path {
            tracer,
            scene,
            sampler: *sampler,
            pause: Pause::Nowhere,
            paused: None,
            share: 1.0,
            is_apart: false,
            media,
            state,
            sum: Rgb::BLACK,
            observer,
        }
    }

    /// Goes on until it ends or is paused; gives the number of segments, which the observer takes for [open](Path::end_rays).
    fn follow(&mut self, known: Known<'_>) -> u32 {
        let mut known = known;
        let mut segments = 0;
        for _ in 0..MOST_SURFACES {
            segments += 1;
            let State { kind, depth, ray, weight, .. } = self.state;
            self.observer.ray_begins(kind, depth, &ray, weight);
            if !self.advance(known) {
                break;
            }
            known = Known::Nothing;
            self.state.met += 1;
        }
        segments
    }

    /// Nothing more comes of so many segments.
    fn end_rays(&mut self, segments: u32) {
        (0..segments).for_each(|_| self.observer.ray_ends());
    }

    /// Goes on to the end.
    fn follow_to_the_end(&mut self) {
        let segments = self.follow(Known::Nothing);
        self.end_rays(segments);
    }

    /// Goes on from the first surface that spreads light, as often as samples are split.
    fn branch(&mut self, vertex: &Vertex<'_, '_>) {
        let ways = self.tracer.0.split;
        let (sampler, state, media) = (self.sampler, self.state, self.media.clone());
        (self.pause, self.share) = (Pause::Nowhere, 1.0 / ways as f32);
        for number in 0..ways {
            self.observer.way_begins(Way { number: number + 1, of: ways });
            (self.sampler, self.media) = (sampler.split(number, ways), media.clone());
            self.state = State { weight: state.weight * self.share, ..state };
            if self.turn(vertex, ways) {
                self.state.met += 1;
                self.follow_to_the_end();
            }
        }
    }

    /// Goes to what the last segment meets, and finds the next segment; false if there is none.
    fn advance(&mut self, known: Known<'_>) -> bool {
        let scene = self.scene;
        let met = meet(scene, &self.state.ray, known, self.observer);
        self.along(met.length);
        let Some(hit) = met.hit else {
            let look = scene.background.look(met.ray.direction);
            let seen = scene.background.light(&look);
            if !seen.is_black() {
                let part = self.part_of_sky(&look);
                let source = if self.plan().is_some() { Source::Light(None) } else { Source::Background };
                self.add(source, seen * part);
            }
            return false;
        };
        if self.plan().is_some_and(|cast| !cast.fits(scene, &hit)) {
            return false;
        }
        let shading = Shading::at(scene, &met.ray, &hit);
        let Shading { surface, color, opacity, from_outside, .. } = shading;
        let (length, normal) = (met.length, shading.normal());
        self.observer.surface(&SurfaceSeen { hit, length, surface, normal, color, opacity, from_outside });
        if let Some(opacity) = opacity {
            // One of the two: the surface, or the way past it.
            let there = opacity.to_array().iter().sum::<f32>() / 3.0;
            if self.sampler.one(self.step(), Purpose::Opacity) >= f64::from(there) {
                self.state.weight *= (Rgb::WHITE - opacity) * (1.0 / (1.0 - there));
                // No medium begins where a surface is not, but one that the ray is in ends.
                let before = self.media.ior(scene);
                self.pass(&shading, shading.bounds_medium && !shading.from_outside);
                // Radiance is squeezed where it enters a denser medium, and spreads again where it leaves that, through a hole, too.
                let stretch = before / self.media.ior(scene);
                let stretch = (stretch * stretch) as f32;
                self.state.weight = self.state.weight * stretch;
                self.state.scale *= stretch;
                return true;
            }
            self.state.weight *= opacity * (1.0 / there);
        }
        let emission = shading.emission;
        // What another medium hides is not there and does not glow.
        if !emission.is_black() && self.plan().is_none() && (!shading.bounds_medium || self.indices(&shading).is_some())
        {
            let density =
                |receiver: &Receiver| scene.emitters.pdf_of_hit(scene, receiver, &met.ray, &hit, &surface, met.length);
            let part = self.part_of_found(density);
            self.add(Source::Emission, emission * part);
        }
        self.scatter(&shading)
    }

    /// Light that the surface gives back, and the next segment.
    fn scatter(&mut self, shading: &Shading<'a>) -> bool {
        let Some(indices) = self.indices(shading) else {
            // Shadow rays do not know that there is nothing.
            self.state.aimed = None;
            self.pass(shading, true);
            return true;
        };
        let (frame, bsdf) = shading.scattering(self.scene, indices);
        let out = shading.out_in(&frame);
        if self.state.depth >= self.tracer.0.max_depth {
            return self.end(shading, bsdf.straight(out));
        }
        let receiver =
            Receiver { point: shading.origin_back(), normal: shading.normal(), passes: bsdf.spreads_through() };
        let vertex = Vertex { shading, frame: &frame, out, bsdf: &bsdf, indices, receiver: &receiver };
        let is_specular = bsdf.is_specular();
        match self.pause {
            Pause::AfterSurfaces(met) if met == self.state.met && self.can_be_reused_from(&vertex) => {
                self.paused = Some(vertex.paused());
                return false;
            }
            Pause::WhereSpread if !is_specular => {
                self.aim(&vertex, self.tracer.0.split);
                self.paused = Some(vertex.paused());
                return false;
            }
            Pause::AfterSurfaces(_) => self.pause = Pause::Nowhere,
            Pause::Nowhere | Pause::WhereSpread => {}
        }
        if !is_specular {
            self.aim(&vertex, 1);
        }
        self.turn(&vertex, 1)
    }

    /// The next segment from a surface, in a direction that it likes; one of so many. False if there is none.
    #[inline]
    fn turn(&mut self, vertex: &Vertex<'_, '_>, ways: u32) -> bool {
        let Vertex { shading, frame, out, bsdf, indices, receiver } = vertex;
        let step = self.step();
        let scattered = match self.plan() {
            Some(cast) => bsdf.only(*out, cast.passes(shading.part())),
            None => {
                let lobe = if bsdf.has_one_lobe() { 0.0 } else { self.sampler.one(step, Purpose::Lobe) };
                let at = self.sampler.two(step, Purpose::Direction);
                let is_seen = self.state.spreads == 0 && self.state.depth <= DEEPEST_SEEN;
                if is_seen { bsdf.sample_seen(*out, lobe, at) } else { bsdf.sample(*out, lobe, at) }
            }
        };
        let Some(scattered) = scattered else { return false };
        let passes = scattered.direction.z < 0.0;
        let direction = frame.to_world(scattered.direction).normalize();
        let mut weight = scattered.weight;
        if let (How::Spread { .. }, false) = (scattered.how, passes) {
            weight = weight * shading.kept(direction) as f32;
        }
        self.state.weight *= weight;
        self.state.scale *= scattered.scale;
        let pdf = if let How::Spread { pdf } = scattered.how { Some(pdf) } else { None };
        let survival = self.survival();
        self.observer.scattering(&Scattering { direction, pdf, weight, survival });
        if !self.survives(survival) {
            return false;
        }
        match scattered.how {
            How::Straight => {
                self.pass(shading, shading.bounds_medium);
                return true;
            }
            How::Spread { pdf } => {
                if shading.is_on_far_side(direction) != passes {
                    return false;
                }
                let aimed = Aimed { receiver: **receiver, pdf: pdf * f64::from(ways) };
                let casts = !passes && self.may_aim_by_casters();
                self.state.aimed = Some(aimed);
                self.state.cast = casts.then(|| Cast::new(aimed, direction, self.state.met));
                self.state.spreads += 1;
            }
            How::Only => {
                self.state.aimed = None;
                let had_plan = self.plan().is_some();
                self.state.cast =
                    self.state.cast.and_then(|cast| cast.met(self.scene, shading, self.state.met, passes));
                if had_plan && self.state.cast.is_none() {
                    return false;
                }
            }
        }
        self.state.depth += 1;
        // Where nothing is bent, it is as if there were no surface.
        let is_straight = scattered.how == How::Only && passes && indices.bend_nothing();
        if !is_straight {
            self.state.way = 0.0;
        }
        if passes {
            if shading.bounds_medium {
                let _ = self.media.cross(shading.primitive, shading.from_outside);
            }
            self.go_on(RayKind::Transmitted, shading.ray_on(direction));
        } else {
            self.go_on(RayKind::Reflected, shading.ray_back(direction));
        }
        true
    }

    /// Where the longest path ends, its last segment goes on through what lets light pass straight, as shadow rays do.
    fn end(&mut self, shading: &Shading<'_>, straight: Rgb) -> bool {
        if straight.is_black() {
            self.observer.not_traced(RayKind::Reflected, self.state.weight, NotTraced::TooDeep);
            return false;
        }
        self.state.weight *= straight;
        self.pass(shading, shading.bounds_medium);
        true
    }

    /// The indices of refraction before and behind a surface; `None` if there is no surface, since the medium that rules here
    /// is the same on both sides.
    #[inline]
    fn indices(&mut self, shading: &Shading<'_>) -> Option<Indices> {
        let before = self.media.ior(self.scene);
        if shading.bounds_medium {
            return self.indices_of_boundary(shading, before);
        }
        Some(Indices { before, behind: None })
    }

    #[inline(never)]
    fn indices_of_boundary(&mut self, shading: &Shading<'_>, before: f64) -> Option<Indices> {
        let ruling = self.media.ruling(self.scene);
        let undo = self.media.cross(shading.primitive, shading.from_outside);
        let (behind, next) = (self.media.ior(self.scene), self.media.ruling(self.scene));
        self.media.undo(undo);
        let is_none = ruling.is_some() && ruling == next && shading.is_only_a_boundary(self.scene);
        (!is_none).then_some(Indices { before, behind: Some(behind) })
    }

    /// Light from an emitter that is aimed at, past what is round and through it, where so many ways go on.
    fn aim(&mut self, vertex: &Vertex<'_, '_>, ways: u32) {
        let Some(light) = self.choose_light(vertex) else { return };
        if let Some(Arriving { source, scattered, light, .. }) = self.arriving(vertex, &light, ways) {
            self.add(source, scattered * light);
        }
        if !light.is_point && light.distance.is_infinite() && self.may_aim_by_casters() {
            self.aim_by_caster(vertex, (light.direction, light.pdf), ways);
        }
    }

    /// Chooses light to aim at.
    fn choose_light(&self, vertex: &Vertex<'_, '_>) -> Option<LightSample> {
        let (emitters, step) = (&self.scene.emitters, self.step());
        let choice = if emitters.is_one() { 0.0 } else { self.sampler.one(step, Purpose::Light) };
        emitters.sample(self.scene, vertex.receiver, choice, self.sampler.two(step, Purpose::LightPoint))
    }

    /// What arrives of light that is aimed at, where so many ways go on.
    #[inline]
    fn arriving(&mut self, vertex: &Vertex<'_, '_>, light: &LightSample, ways: u32) -> Option<Arriving> {
        let Vertex { shading, frame, out, bsdf, receiver, .. } = vertex;
        let scene = self.scene;
        let toward = frame.to_local(light.direction);
        let (mut scattered, pdf) = bsdf.evaluate(*out, toward);
        let mut visible = Rgb::BLACK;
        let passes = toward.z < 0.0;
        if !passes {
            scattered = scattered * shading.kept(light.direction) as f32;
        }
        if !scattered.is_black() && shading.is_on_far_side(light.direction) == passes {
            self.observer.shadow_ray();
            let ray = if passes { shading.ray_on(light.direction) } else { shading.ray_back(light.direction) };
            // From the far side the way is not quite as long.
            let reach = light.distance - (ray.origin - receiver.point).dot(light.direction);
            let vantage = light.lamp.and_then(|index| scene.light_vantages[index].as_ref());
            visible = if passes && shading.bounds_medium {
                let mut media = self.media.clone();
                let _ = media.cross(shading.primitive, shading.from_outside);
                visibility(scene, &media, &ray, reach, vantage)
            } else {
                visibility(scene, &self.media, &ray, reach, vantage)
            };
        }
        if let Some(index) = light.lamp {
            let distance = Some(light.distance);
            self.observer.light(&LightSeen { index, distance, cosine: toward.z, visibility: visible });
        }
        if visible.is_black() {
            return None;
        }
        let pdf = pdf * f64::from(ways);
        let part = if light.is_point { 1.0 } else { power_heuristic(light.pdf, pdf) };
        let by_aiming = if light.is_point { f64::INFINITY } else { light.pdf };
        self.observer.weighing(&Weighing { by_surface: pdf, by_aiming, part });
        let mut arriving = light.light * visible * ((part / light.pdf) as f32);
        // As it is for those who find the same light otherwise. Lamps at infinity would not be seen through any fog, and
        // nobody means that.
        if let (Some(fog), true) = (&scene.fog, !light.is_point || light.distance.is_finite()) {
            arriving = arriving * fog.veil(light.distance).visible;
        }
        Some(Arriving { source: Source::Light(light.lamp), toward, scattered, light: arriving })
    }

    /// What light counts that the last segment has found, if by aiming it is found with this density from a receiver.
    fn part_of_found(&mut self, density: impl FnOnce(&Receiver) -> f64) -> f32 {
        let Some(Aimed { receiver, pdf }) = self.state.aimed else { return 1.0 };
        let by_aiming = density(&receiver);
        let part = power_heuristic(pdf, by_aiming);
        self.observer.weighing(&Weighing { by_surface: pdf, by_aiming, part });
        part as f32
    }

    /// Goes on straight, as if there were no surface. It stays the same segment of the path, for light that was aimed at
    /// comes through here, too.
    fn pass(&mut self, shading: &Shading<'_>, crosses: bool) {
        if crosses {
            let _ = self.media.cross(shading.primitive, shading.from_outside);
        }
        self.go_on(RayKind::Transmitted, shading.ray_on(shading.direction));
    }

    /// Begins the next segment.
    #[inline(always)]
    fn go_on(&mut self, kind: RayKind, ray: Ray) {
        self.state.kind = kind;
        // Number by number: processors wait where a copy reads in one piece what was written in several.
        let (from, to) = (&ray, &mut self.state.ray);
        (to.origin.x, to.origin.y, to.origin.z) = (from.origin.x, from.origin.y, from.origin.z);
        (to.direction.x, to.direction.y, to.direction.z) = (from.direction.x, from.direction.y, from.direction.z);
    }

    /// The chance of a path of this weight to go on.
    fn survival(&self) -> f32 {
        if matches!(self.pause, Pause::AfterSurfaces(_)) || self.plan().is_some() {
            // What others may use is as dense as it is said to be, and who has a plan does not give up.
            return 1.0;
        }
        let weight = self.state.weight.max_component() / (self.state.scale * self.share);
        match self.state.depth {
            depth if depth < FIRST_ROULETTE && weight > 0.0 => 1.0,
            _ if weight >= MOST_LIKELY => MOST_LIKELY,
            _ => (weight / WORTHWHILE).min(1.0),
        }
    }

    /// Russian roulette: paths that count little end, others count the more.
    fn survives(&mut self, chance: f32) -> bool {
        if chance == 1.0 {
            return true;
        }
        if self.sampler.one(self.step(), Purpose::Roulette) >= f64::from(chance) {
            self.observer.not_traced(RayKind::Reflected, self.state.weight, NotTraced::TooFaint);
            return false;
        }
        self.state.weight = self.state.weight * (1.0 / chance);
        true
    }

    /// What the segment does to the light that comes along it.
    fn along(&mut self, length: f64) {
        if let Some(fog) = &self.scene.fog {
            let veil = fog.veil_behind(self.state.way, length);
            self.state.way += length;
            self.add(Source::Fog, veil.color * (1.0 - veil.visible));
            self.state.weight = self.state.weight * veil.visible;
        }
        if self.scene.attenuates {
            self.state.weight *= self.media.transmittance(self.scene, length);
        }
    }

    /// Adds light that arrives at the start of the last segment.
    fn add(&mut self, source: Source, light: Rgb) {
        let mut amount = self.state.weight * light;
        if self.is_apart {
            self.sum += amount;
            self.observer.brings(source, amount);
            return;
        }
        if let (Some(most), false) = (self.tracer.0.clamp, source.is_direct(self.state.depth)) {
            let (largest, most) = (amount.max_component(), most * self.share);
            if largest > most {
                amount = amount * (most / largest);
            }
        }
        self.sum += amount;
        self.observer.contribution(source, amount);
    }

    /// The number under which the sampler knows what the last segment meets.
    fn step(&self) -> u32 {
        self.state.met + 1
    }
}

/// The part of light that the first of two ways counts, if they find it with these densities, each times the number of tries.
/// Veach 1997, eq. 9.13.
fn power_heuristic(first: f64, second: f64) -> f64 {
    if first.is_infinite() {
        return 1.0;
    }
    let ratio = second / first;
    1.0 / (1.0 + ratio * ratio)
}

#[cfg(test)]
mod tests;
