//! Classic ray tracing: ambient and direct light, and rays in the mirrored and the refracted direction only.
//!
//! Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980. The colour of a pixel is kept as one
//! sum: every term is added with the product of all weights on its way from the eye, so the terms can be listed and
//! their sum, in the order of the list, is the pixel to the last bit.

mod soft;

use super::Integrator;
use crate::ahead::SeenAhead;
use crate::compile::CompiledScene;
use crate::holes::{Known, find};
use crate::materials::refract;
use crate::media::{Media, Undo};
use crate::observer::{LightSeen, NotTraced, Observer, RayKind, Source, SurfaceSeen};
use crate::sampler::Sampler;
use crate::shading::{Shading, highlight};
use crate::visibility::visibility;
use durer_geometry::{Ray, Way};
use durer_math::{DVec3, Rgb};

/// The classic integrator.
pub(crate) struct Whitted;

impl Integrator for Whitted {
    fn radiance<O: Observer>(
        &self,
        scene: &CompiledScene,
        ray: &Ray,
        known: Known<'_>,
        sampler: &Sampler,
        observer: &mut O,
    ) -> Rgb {
        let media = if scene.media_at_eye.is_empty() { Media::default() } else { Media::around(scene, ray) };
        let mut path = Path { scene, sampler, lit: 0, media, way: 0.0, sum: Rgb::BLACK, observer };
        path.trace(RayKind::Eye, 1, ray, Rgb::WHITE, known);
        path.sum
    }
}

/// All rays from one ray of the eye.
struct Path<'a, O> {
    scene: &'a CompiledScene,
    sampler: &'a Sampler,
    /// How often light was looked for on something that has an area.
    lit: u32,
    /// Around the origin of the ray being traced.
    media: Media,
    /// How far the light of the ray being traced has gone straight on through fog before, past what is not there.
    way: f64,
    sum: Rgb,
    observer: &'a mut O,
}

/// How light gets through a surface.
struct Boundary {
    /// The direction behind it; `None` for total internal reflection.
    onward: Option<DVec3>,
    /// The part of it that gets through and is not reflected.
    passed: f32,
    /// True if light goes on as if there were nothing: what is on both sides bends it alike.
    is_none: bool,
}

/// Fog begins anew behind a surface.
const ANEW: f64 = 0.0;

impl<O: Observer> Path<'_, O> {
    /// Adds what arrives along a ray, times its weight.
    fn trace(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb, known: Known<'_>) {
        self.observer.ray_begins(kind, depth, ray, weight);
        let met = find(self.scene, ray, known, self.observer);
        let way = self.way;
        let weight = self.along(way, met.length, weight, known.seen());
        match met.hit {
            None => self.add(Source::Background, weight * self.scene.background.seen(ray.direction)),
            Some(hit) => {
                let seen = known.seen();
                let ray = met.onward.as_ref().unwrap_or(ray);
                let surface = match &seen {
                    Some(seen) => seen.surface(),
                    None => self.scene.world.surface(ray, &hit),
                };
                let shading = Shading::of_surface(self.scene, ray, &hit, surface);
                let Shading { surface, color, opacity, from_outside, .. } = shading;
                let (length, normal) = (met.length, shading.normal());
                self.observer.surface(&SurfaceSeen { hit, length, surface, normal, color, opacity, from_outside });
                let there = opacity.map_or(weight, |opacity| weight * opacity);
                if opacity.is_none_or(|opacity| !opacity.is_black()) {
                    self.shade(&shading, there, seen.filter(|_| !shading.is_smooth()));
                    self.go_on(&shading, depth, there, way + length);
                }
                if let Some(opacity) = opacity {
                    self.go_past(&shading, depth, weight, opacity, way + length);
                }
            }
        }
        self.observer.ray_ends();
    }

    /// What a segment that goes straight on after such a way does to the light that comes along it; gives the weight of what is
    /// at its far end.
    fn along(&mut self, way: f64, length: f64, weight: Rgb, seen: Option<SeenAhead<'_>>) -> Rgb {
        let mut weight = weight;
        if let Some(fog) = &self.scene.fog {
            let veil = match seen {
                Some(seen) => fog.veil_of(seen.visible_through_fog()),
                None if way == ANEW => fog.veil(length),
                None => fog.veil_behind(way, length),
            };
            self.add(Source::Fog, weight * veil.color * (1.0 - veil.visible));
            weight = weight * veil.visible;
        }
        if self.scene.attenuates {
            weight *= self.media.transmittance(self.scene, length);
        }
        weight
    }

    /// What the surface gives off, and ambient and direct light that it gives back.
    #[inline(always)]
    fn shade(&mut self, shading: &Shading<'_>, weight: Rgb, seen: Option<SeenAhead<'_>>) {
        let material = shading.material;
        if !shading.emission.is_black() {
            self.add(Source::Emission, weight * shading.emission);
        }
        let weight = weight * (Rgb::WHITE - material.transparency);
        if weight.is_black() {
            return;
        }
        let given_back = weight * shading.color;
        self.add(Source::Ambient, given_back * self.scene.ambient * material.ambient);
        // Lit points lie off the surface like the origins of all rays, so that shadow rays end exactly in the light.
        let point = shading.origin_back();
        let mut sights = seen.iter().flat_map(SeenAhead::sights);
        for (index, light) in self.scene.lights.iter().enumerate() {
            let sight = sights.next().flatten();
            if light.radius() > 0.0 && self.scene.settings.light_samples > 0 {
                self.shade_by_ball(shading, weight, index);
                continue;
            }
            let arriving = match &sight {
                Some(sight) => light.arriving_along(sight.direction, sight.distance, sight.squared_distance),
                None => light.arriving(point),
            };
            let Some(arriving) = arriving else {
                let (cosine, visibility) = (0.0, Rgb::BLACK);
                self.observer.light(&LightSeen { index, distance: None, cosine, visibility });
                continue;
            };
            let (cosine, way) = match &sight {
                Some(sight) => (sight.cosine, sight.way),
                None => (shading.cosine(arriving.direction), Way::Unknown),
            };
            let mut visible = Rgb::BLACK;
            if cosine > 0.0 {
                self.observer.shadow_ray();
                visible = match way {
                    Way::Open => Rgb::WHITE,
                    Way::Shut => Rgb::BLACK,
                    Way::Unknown => {
                        let ray = Ray { origin: point, direction: arriving.direction };
                        let vantage = self.scene.light_vantages[index].as_ref();
                        visibility(self.scene, &self.media, &ray, arriving.distance, vantage)
                    }
                };
            }
            let distance = Some(arriving.distance);
            self.observer.light(&LightSeen { index, distance, cosine, visibility: visible });
            if visible.is_black() {
                continue;
            }
            let light = visible * arriving.light;
            self.add(Source::Diffuse(index), given_back * light * (material.diffuse * cosine as f32));
            if !material.specular.is_black() {
                let strength = highlight(shading, arriving.direction);
                self.add(Source::Specular(index), weight * material.specular * light * strength);
            }
        }
        if self.scene.emitters.has_shapes() {
            self.shade_by_shapes(shading, weight);
        }
    }

    /// The mirror image, and what lies behind; `way` is how far light has gone straight through fog from here to the eye, or to
    /// where it was bent last.
    #[inline(always)]
    fn go_on(&mut self, shading: &Shading<'_>, depth: u32, weight: Rgb, way: f64) {
        let material = shading.material;
        if material.reflection.is_black() && !material.is_clear() {
            return;
        }
        let [reflection, transparency] = material.parts_at(shading.color);
        let behind = weight * transparency;
        let boundary = self.boundary(shading);
        // What cannot get through comes from the mirrored direction, like what a mirror adds: one ray serves both.
        let mirrored = weight * reflection + behind * (1.0 - boundary.passed);
        if !mirrored.is_black() {
            self.follow(RayKind::Reflected, depth, &shading.mirrored(), mirrored, ANEW);
        }
        if material.is_clear()
            && let Some(direction) = boundary.onward
        {
            let undo = match shading.bounds_medium {
                true => self.media.cross(shading.primitive, shading.from_outside),
                false => Undo::Nothing,
            };
            let ray = shading.ray_on(direction);
            let way = if boundary.is_none { way } else { ANEW };
            self.follow(RayKind::Transmitted, depth, &ray, behind * boundary.passed, way);
            self.media.undo(undo);
        }
    }

    /// What lies behind where the surface is not there, of which so much is. No medium begins there, but one that the ray is in
    /// ends; fog goes on as over the `way` before.
    #[inline(never)]
    fn go_past(&mut self, shading: &Shading<'_>, depth: u32, weight: Rgb, opacity: Rgb, way: f64) {
        let weight = weight * (Rgb::WHITE - opacity);
        if weight.is_black() {
            return;
        }
        let undo = match shading.bounds_medium && !shading.from_outside {
            true => self.media.cross(shading.primitive, shading.from_outside),
            false => Undo::Nothing,
        };
        self.follow(RayKind::Transmitted, depth, &shading.ray_on(shading.direction), weight, way);
        self.media.undo(undo);
    }

    /// How light gets through a surface that it may get through. Only the boundaries of media bend it; a clear sheet has
    /// two such boundaries in the same place.
    fn boundary(&mut self, shading: &Shading<'_>) -> Boundary {
        let (direction, normal, material) = (shading.direction, shading.normal(), shading.material);
        let straight = Boundary { onward: Some(direction), passed: 1.0, is_none: false };
        let Some(ior) = material.ior.filter(|_| material.is_clear()) else { return straight };
        let before = self.media.ior(self.scene);
        let part_passed = |reflectance: f64| if material.fresnel { (1.0 - reflectance) as f32 } else { 1.0 };
        if !shading.bounds_medium {
            let reflectance = refract(direction, normal, before / ior).map_or(1.0, |refracted| refracted.reflectance);
            return Boundary { passed: part_passed(reflectance), is_none: before == ior, ..straight };
        }
        let undo = self.media.cross(shading.primitive, shading.from_outside);
        let after = self.media.ior(self.scene);
        self.media.undo(undo);
        match refract(direction, normal, before / after) {
            Some(refracted) => {
                let passed = part_passed(refracted.reflectance);
                Boundary { onward: Some(refracted.direction), passed, is_none: before == after }
            }
            None => Boundary { onward: None, passed: 0.0, is_none: false },
        }
    }

    /// Traces a ray from a surface unless it is too deep or too faint.
    fn follow(&mut self, kind: RayKind, depth: u32, ray: &Ray, weight: Rgb, way: f64) {
        let settings = &self.scene.settings;
        if depth >= settings.max_depth {
            self.observer.not_traced(kind, weight, NotTraced::TooDeep);
        } else if weight.max_component() < settings.min_weight || weight.is_black() {
            self.observer.not_traced(kind, weight, NotTraced::TooFaint);
        } else {
            self.way = way;
            self.trace(kind, depth + 1, ray, weight, Known::Nothing);
        }
    }

    fn add(&mut self, source: Source, amount: Rgb) {
        self.sum += amount;
        self.observer.contribution(source, amount);
    }
}
