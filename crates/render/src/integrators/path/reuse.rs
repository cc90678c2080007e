//! Paths that serve several pixels: Bekaert, Sbert and Halton, "Accelerating Path Tracing by Re-Using Paths", EGWR 2002.
//!
//! The samples with the same number of a block of pixels are taken together. Each path goes from its vertex, the first surface
//! that spreads light, to the next surface, its junction, and what arrives there is found out once. Then every vertex that sees
//! a junction takes light from it. Junctions are found from all vertices, each with its own density, so the balance heuristic
//! weighs them (Veach 1997, §9.2): with n vertices x and densities p, light from a junction y counts f(x, y) / Σ p(xₖ → y), where
//! the sum is over all that see y. That is never more than what x, had it found y itself, would make of the same light: what is
//! near to one pixel makes no others bright. But a junction scatters light in another way to each vertex, and looked for light as
//! the one liked that found it; so only surfaces that look [much the same](Bsdf::is_broad) from everywhere may be junctions.
//!
//! The sum is right only if all who see a junction would have found it as they are taken to, so whoever may not have, has no part:
//! who sees it from behind a hole, or so flatly that it is shaded by another normal. Its own path then goes on by itself.
//!
//! Where samples are split, the first way is a path like this, and the others only look for what cannot be shared: emitters, and
//! what lies in glass, mirrors and polished metal. Where they end at a surface that could be a junction, nothing is added: the
//! block has junctions enough.
//!
//! A picture is as true as without, and has far less noise where most light comes by way of other things; for a path costs much
//! more than a ray that asks whether two points see each other. What is left of the noise is alike in the pixels of a block.

use super::{Arriving, MOST_CASTING, Path, PathTracer, Pause, Paused, State, Vertex};
use crate::bsdf::Bsdf;
use crate::compile::CompiledScene;
use crate::frame::Frame;
use crate::integrators::Together;
use crate::observer::{ArrivalSeen, Observer, RayKind, ReuseSeen, Sharing, Source, SurfaceSeen, Way};
use crate::shading::Shading;
use arrayvec::ArrayVec;
use durer_geometry::{LANES, Packet, Ray};
use durer_math::{DVec3, Rgb};

/// Others may make more of light than a path's own vertex does, if that is darker than this.
const DARK: f32 = 0.25;

/// Takes samples that belong together.
pub(super) fn trace<O: Observer>(tracer: &PathTracer, scene: &CompiledScene, samples: &mut [&mut Together<'_, O>]) {
    let mut lights = Vec::with_capacity(samples.len());
    let begun = samples.iter_mut().map(|sample| {
        let Together { ray, known, sampler, observer, light } = &mut **sample;
        lights.push(light);
        let mut path = Path::new(tracer, (scene, ray), sampler, observer);
        path.pause = Pause::WhereSpread;
        let segments = path.follow(*known);
        let paused = path.paused.take();
        Member { path, paused, segments }
    });
    let mut members: Vec<Member<'_, O>> = begun.collect();
    let mut junctions = Vec::with_capacity(members.len());
    for (index, member) in members.iter_mut().enumerate() {
        member.go_on(index, &mut junctions);
    }
    let views = members.iter_mut().enumerate().filter_map(|(index, member)| member.view(index));
    let views: Vec<View<'_>> = views.collect();
    let mut seen = Vec::with_capacity(views.len());
    for junction in &junctions {
        if junction.lights.iter().all(|(_, light)| light.is_black()) {
            continue;
        }
        let is_shared = junction.look(scene, &views, &mut seen);
        seen.iter().for_each(|seen| members[seen.member].path.observer.shadow_ray());
        if !is_shared {
            let from = views.iter().find(|view| view.member == junction.member);
            from.into_iter().for_each(|view| members[view.member].path.add_own(junction, view));
            continue;
        }
        let sum: f64 = seen.iter().filter(|seen| !seen.is_dark).map(|seen| seen.density).sum();
        let views = seen.iter().filter(|seen| !seen.is_dark).count();
        for seen in seen.iter().filter(|seen| seen.brings_light()) {
            members[seen.member].path.add_shared(junction, seen, (sum, views));
        }
    }
    for (mut member, light) in members.into_iter().zip(lights) {
        member.path.end_rays(member.segments);
        *light = member.path.sum;
    }
}

/// One of the samples.
struct Member<'a, O> {
    path: Path<'a, O>,
    /// Where it first met a surface that spreads light, if others may take light there from its path.
    paused: Option<Paused<'a>>,
    /// Up to there.
    segments: u32,
}

/// A vertex that looks for junctions.
struct View<'a> {
    /// Its number among the samples.
    member: usize,
    depth: u32,
    paused: Paused<'a>,
}

/// A surface that a path has met, and the light that arrives there.
struct Junction<'a> {
    /// The number of the sample whose path it was, …
    member: usize,
    /// … and of the segment that led here.
    depth: u32,
    /// What light from here counts there by that path alone.
    weight: Rgb,
    shading: Shading<'a>,
    frame: Frame,
    /// Where the path came from, in the frame.
    out: DVec3,
    bsdf: Bsdf,
    /// Where it comes from, in the frame, and radiance over density.
    lights: ArrayVec<(DVec3, Rgb), 2>,
}

/// A junction, seen from a vertex.
#[derive(Clone, Copy)]
struct Seen {
    member: usize,
    way: Ray,
    /// What is scattered of light from there, times the cosine.
    scattered: Rgb,
    /// Solid angle over area.
    area: f64,
    /// With which the vertex finds such points, per area.
    density: f64,
    /// Something is between.
    is_dark: bool,
}

impl Seen {
    fn brings_light(&self) -> bool {
        !self.is_dark && !self.scattered.is_black()
    }
}

impl<'a, O: Observer> Member<'a, O> {
    /// Goes on from the vertex, if there is one.
    fn go_on(&mut self, index: usize, junctions: &mut Vec<Junction<'a>>) {
        let path = &mut self.path;
        if let Some(alone) = self.paused.take_if(|paused| !path.can_reuse_at(&paused.vertex())) {
            path.branch(&alone.vertex());
        }
        let Some(paused) = &self.paused else { return };
        let vertex = paused.vertex();
        let ways = path.tracer.0.split;
        let (sampler, state) = (path.sampler, path.state);
        for number in 0..ways {
            path.observer.way_begins(Way { number: number + 1, of: ways });
            path.sampler = if number == 0 { sampler } else { sampler.another().split(number, ways) };
            path.share = 1.0 / ways as f32;
            path.state = State { weight: state.weight * path.share, ..state };
            path.media = Default::default();
            path.pause = Pause::AfterSurfaces(state.met + 1);
            if !path.turn(&vertex, ways) {
                continue;
            }
            if !path.has_spread_since(state.depth) {
                path.pause = Pause::Nowhere;
            }
            path.state.met += 1;
            let segments = path.follow(crate::holes::Known::Nothing);
            // Junctions are those of the first way, with its density alone.
            match path.paused.take() {
                Some(found) if number == 0 => {
                    (path.share, path.state.weight) = (1.0, path.state.weight * ways as f32);
                    junctions.push(path.junction(index, &found.vertex()));
                }
                Some(_) => path.observer.junction_left(),
                None => {}
            }
            path.end_rays(segments);
        }
        (path.state, path.sampler, path.share, path.media) = (state, sampler, 1.0, Default::default());
    }

    fn view(&mut self, index: usize) -> Option<View<'a>> {
        Some(View { member: index, depth: self.path.state.depth, paused: self.paused.take()? })
    }
}

impl<'a, O: Observer> Path<'a, O> {
    /// True if light from other paths' junctions may be taken here.
    pub(super) fn can_reuse_at(&self, vertex: &Vertex<'_, '_>) -> bool {
        self.can_reuse()
            && !vertex.shading.bounds_medium
            && !vertex.bsdf.is_specular()
            && !vertex.bsdf.spreads_through()
    }

    /// True if light that arrives here may be seen by others.
    pub(super) fn can_be_reused_from(&self, vertex: &Vertex<'_, '_>) -> bool {
        // All find what is but partly there as often, but what a colored part of it gives is known to the path alone.
        let is_evenly_there = vertex.shading.opacity.is_none_or(|Rgb { r, g, b }| r == g && g == b);
        self.can_reuse() && !vertex.shading.bounds_medium && vertex.bsdf.is_broad() && is_evenly_there
    }

    /// True if the surface from which the last segment comes, the end of one of this depth, might have sent it anywhere: not as
    /// mirrors do, nor straight on.
    fn has_spread_since(&self, depth: u32) -> bool {
        self.state.depth > depth && self.state.aimed.is_some()
    }

    /// True in empty space.
    fn can_reuse(&self) -> bool {
        self.scene.fog.is_none() && self.media.is_empty()
    }

    /// Finds out what light arrives at a surface, by aiming and by going on. What may not be seen by others is added up.
    fn junction(&mut self, member: usize, found: &Vertex<'_, 'a>) -> Junction<'a> {
        let mut lights = ArrayVec::new();
        self.observer.junction();
        let light = self.choose_light(found);
        if let Some(Arriving { source, toward, light, .. }) = light.and_then(|light| self.arriving(found, &light, 1)) {
            let direction = found.frame.to_world(toward);
            let light = light * found.shading.kept(direction) as f32;
            self.observer.arrives(&ArrivalSeen { source: Some(source), direction, light });
            lights.push((toward, light));
        }
        let State { depth, weight, .. } = self.state;
        // What others make of light by way of casters is not known.
        self.state.spreads = MOST_CASTING;
        self.state.weight = Rgb::WHITE;
        if self.turn(found, 1) {
            self.pause = Pause::Nowhere;
            self.state.met += 1;
            match self.state.aimed.filter(|_| self.has_spread_since(depth)) {
                Some(aimed) => {
                    let direction = self.state.ray.direction;
                    let counts = found.shading.kept(direction) / aimed.pdf;
                    // Roulette goes by what it counts for a vertex that is about as bright as the path's own, if not too dark.
                    let brightness = (weight.max_component() / self.share).clamp(DARK, 1.0);
                    self.state.scale = 1.0 / (self.state.weight.max_component() * brightness * self.share);
                    self.observer.arriving_begins();
                    let light = self.arriving_from_there() * counts as f32;
                    self.observer.arrives(&ArrivalSeen { source: None, direction, light });
                    lights.push((found.frame.to_local(direction), light));
                }
                None => {
                    self.state.weight *= weight;
                    self.follow_to_the_end();
                }
            }
        }
        Junction {
            member,
            depth,
            weight,
            shading: *found.shading,
            frame: *found.frame,
            out: found.out,
            bsdf: *found.bsdf,
            lights,
        }
    }

    /// The light that arrives along the last segment: it is not added up.
    fn arriving_from_there(&mut self) -> Rgb {
        self.state.weight = Rgb::WHITE;
        let sum = std::mem::replace(&mut self.sum, Rgb::BLACK);
        self.is_apart = true;
        self.follow_to_the_end();
        self.is_apart = false;
        std::mem::replace(&mut self.sum, sum)
    }

    /// Adds light from a junction, which so many see; with the sum of their densities.
    fn add_shared(&mut self, junction: &Junction<'_>, seen: &Seen, (sum, views): (f64, usize)) {
        let &Seen { way, scattered, area, density, .. } = seen;
        let light = junction.toward(junction.frame.to_local(-way.direction));
        let sharing = Some(Sharing { density, sum, views, part: density / sum });
        let weight = self.state.weight * scattered * ((area / density) as f32);
        let reuse = ReuseSeen { found_by: junction.member, light, sharing };
        self.add_reused(light * scattered * ((area / sum) as f32), (junction, way), (weight, reuse));
    }

    /// Adds light from a junction that nobody else makes use of.
    fn add_own(&mut self, junction: &Junction<'_>, view: &View<'_>) {
        let weight = std::mem::replace(&mut self.state.weight, junction.weight);
        let way = Ray { origin: view.paused.receiver.point, direction: junction.shading.direction };
        let light = junction.toward(junction.out);
        let reuse = ReuseSeen { found_by: junction.member, light, sharing: None };
        self.add_reused(light, (junction, way), (junction.weight, reuse));
        self.state.weight = weight;
    }

    /// Adds light that comes this way from a junction. The observer is told what light from there would count if it were this
    /// path's own.
    fn add_reused(&mut self, light: Rgb, (junction, way): (&Junction<'_>, Ray), (weight, reuse): (Rgb, ReuseSeen)) {
        self.observer.ray_begins(RayKind::Connected, self.state.depth + 1, &way, weight);
        self.observer.surface(&junction.seen_from(way.origin));
        self.observer.reuse(&reuse);
        self.add(Source::Reused, light);
        self.observer.ray_ends();
    }
}

impl Junction<'_> {
    /// Finds from which vertices it is seen; false if not from that of its own path, or if its light is no number, which shall
    /// spoil but one sample.
    fn look(&self, scene: &CompiledScene, views: &[View<'_>], seen: &mut Vec<Seen>) -> bool {
        seen.clear();
        if !self.lights.iter().all(|(_, light)| light.is_finite()) {
            return false;
        }
        seen.extend(views.iter().filter_map(|view| self.from(view)));
        let Shading { surface, .. } = self.shading;
        let before = surface.point + self.shading.face() * surface.offset;
        for chunk in seen.chunks_mut(LANES) {
            let mut reach = [0.0; LANES];
            let rays: ArrayVec<Ray, LANES> = chunk
                .iter()
                .zip(&mut reach)
                .map(|(seen, reach)| {
                    let Ray { origin, .. } = seen.way;
                    *reach = (before - origin).length();
                    Ray { origin, direction: (before - origin) * (1.0 / *reach) }
                })
                .collect();
            let dark = scene.world.any_hits(&Packet::new(&rays), &reach, u32::MAX);
            for (lane, seen) in chunk.iter_mut().enumerate() {
                seen.is_dark = dark >> lane & 1 == 1;
            }
        }
        seen.iter().any(|seen| seen.member == self.member && !seen.is_dark)
    }

    /// How a vertex sees it, if nothing is between.
    fn from(&self, view: &View<'_>) -> Option<Seen> {
        let Paused { shading, frame, out, bsdf, receiver, .. } = &view.paused;
        let way = self.shading.surface.point - receiver.point;
        let squared = way.length_squared();
        let direction = way * (1.0 / squared.sqrt());
        let area = -direction.dot(self.shading.face()) / squared;
        let toward = frame.to_local(direction);
        // (Not if it is not a number, either.)
        if !(area > 0.0 && area.is_finite() && toward.z > 0.0)
            || view.depth + 1 != self.depth
            || shading.is_on_far_side(direction)
            || !self.shading.is_same_along(direction)
        {
            return None;
        }
        let (scattered, pdf) = bsdf.evaluate(*out, toward);
        let scattered = scattered * shading.kept(direction) as f32;
        (pdf > 0.0).then_some(Seen {
            member: view.member,
            way: Ray { origin: receiver.point, direction },
            scattered,
            area,
            density: pdf * area,
            is_dark: false,
        })
    }

    /// The surface, as the observer is told of it.
    fn seen_from(&self, origin: DVec3) -> SurfaceSeen {
        let Shading { hit, surface, color, opacity, from_outside, .. } = self.shading;
        let (length, normal) = ((surface.point - origin).length(), self.shading.normal());
        SurfaceSeen { hit, length, surface, normal, color, opacity, from_outside }
    }

    /// Radiance in this direction, in the frame.
    fn toward(&self, out: DVec3) -> Rgb {
        let lights = self.lights.iter().map(|(toward, light)| self.bsdf.evaluate(out, *toward).0 * *light);
        lights.fold(Rgb::BLACK, |sum, light| sum + light)
    }
}
