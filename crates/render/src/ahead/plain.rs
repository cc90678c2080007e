//! Eight plain points at once: all that arrives from surfaces that only give back light, in all directions alike.
//!
//! Most of what eyes see is such: no mirror, no highlight, nothing behind it, and every lamp is either surely seen or surely
//! hidden. The terms of the sum are those of the integrator for one point, operation by operation and in its order, so that
//! each lane has the bits that it would have alone; a test holds that.

use super::MOST_LIGHTS;
use crate::compile::CompiledScene;
use crate::lights::Light;
use crate::materials::Material;
use crate::shading::color_at;
use arrayvec::ArrayVec;
use durer_geometry::{LANES, Seen, Sights};
use durer_math::Rgb;
use fearless_simd::{Simd, dispatch, f32x8, f64x8, mask32x8, prelude::*};

/// What arrives from eight points that rays of the eye see, as far as they are plain.
#[derive(Clone, Debug, Default)]
#[repr(C, align(64))]
pub(crate) struct Plain {
    sum: Columns,
    /// Which of them are plain, one bit each.
    lanes: u32,
    /// For each light, from which points rays go there.
    shadow_rays: ArrayVec<u32, MOST_LIGHTS>,
}

/// All that arrives along a ray of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sum {
    pub(crate) color: Rgb,
    /// Rays to lights that it took.
    pub(crate) shadow_rays: u64,
}

/// A color in each of eight lanes, by components.
type Columns = [[f32; LANES]; 3];

/// What surfaces give back.
#[derive(Default)]
#[repr(C, align(64))]
struct Surfaces {
    color: Columns,
    ambient: [f32; LANES],
    diffuse: [f32; LANES],
}

/// A light as eight points see it.
struct Lit<'a> {
    sights: &'a Sights,
    light: Columns,
    /// Where it shines.
    lanes: u32,
}

/// Colors in lanes.
#[derive(Clone, Copy)]
struct Colors<S: Simd>([f32x8<S>; 3]);

impl<S: Simd> Colors<S> {
    #[inline(always)]
    fn load(simd: S, [r, g, b]: &Columns) -> Colors<S> {
        Colors([(*r).simd_into(simd), (*g).simd_into(simd), (*b).simd_into(simd)])
    }

    #[inline(always)]
    fn splat(simd: S, color: Rgb) -> Colors<S> {
        Colors([f32x8::splat(simd, color.r), f32x8::splat(simd, color.g), f32x8::splat(simd, color.b)])
    }

    #[inline(always)]
    fn times(self, other: Colors<S>) -> Colors<S> {
        let (Colors([r, g, b]), Colors([x, y, z])) = (self, other);
        Colors([r * x, g * y, b * z])
    }

    #[inline(always)]
    fn scaled(self, by: f32x8<S>) -> Colors<S> {
        let Colors([r, g, b]) = self;
        Colors([r * by, g * by, b * by])
    }

    /// The sum with other colors, in some of the lanes.
    #[inline(always)]
    fn plus(self, other: Colors<S>, lanes: mask32x8<S>) -> Colors<S> {
        let (Colors([r, g, b]), Colors([x, y, z])) = (self, other);
        Colors([lanes.select(r + x, r), lanes.select(g + y, g), lanes.select(b + z, b)])
    }
}

impl Plain {
    /// What arrives from one of the points, if it is plain.
    #[inline]
    pub(crate) fn sum(&self, lane: usize) -> Option<Sum> {
        let lane = lane % LANES;
        if self.lanes >> lane & 1 == 0 {
            return None;
        }
        let color = Rgb::new(self.sum[0][lane], self.sum[1][lane], self.sum[2][lane]);
        let shadow_rays = self.shadow_rays.iter().fold(0, |rays, lanes| rays + u64::from(lanes >> lane & 1));
        Some(Sum { color, shadow_rays })
    }

    /// Looks at what is seen. `visible` is what fog leaves of it.
    pub(super) fn find(
        &mut self,
        scene: &CompiledScene,
        seen: &Seen,
        sights: &[Option<Sights>],
        visible: &[f32; LANES],
    ) {
        self.shadow_rays.clear();
        let mut lanes = seen.lanes();
        for sights in sights {
            lanes &= sights.as_ref().map_or(0, |sights| !sights.unknown());
        }
        let mut surfaces = Surfaces::default();
        let all_is_known = sights.len() == scene.lights.len() && !scene.emitters.has_shapes();
        self.lanes = match lanes != 0 && all_is_known {
            true => surfaces.find(scene, seen, lanes),
            false => 0,
        };
        if self.lanes == 0 {
            return;
        }
        let mut lit: ArrayVec<Lit<'_>, MOST_LIGHTS> = ArrayVec::new();
        for (light, sights) in scene.lights.iter().zip(sights.iter().flatten()) {
            lit.push(Lit::find(light, sights, &mut self.shadow_rays));
        }
        dispatch!(scene.world.simd(), simd => self.add_up(simd, scene, (&surfaces, visible), &lit));
    }

    #[inline(always)]
    fn add_up<S: Simd>(
        &mut self,
        simd: S,
        scene: &CompiledScene,
        (surfaces, visible): (&Surfaces, &[f32; LANES]),
        lit: &[Lit<'_>],
    ) {
        let all = mask32x8::from_bitmask(simd, 0xff);
        let mut sum = Colors::splat(simd, Rgb::BLACK);
        let mut weight = f32x8::splat(simd, 1.0);
        if let Some(fog) = &scene.fog {
            let visible = (*visible).simd_into(simd);
            let veil = Colors::splat(simd, fog.color()).scaled(f32x8::splat(simd, 1.0) - visible);
            (sum, weight) = (sum.plus(veil, all), visible);
        }
        let given_back = Colors::load(simd, &surfaces.color).scaled(weight);
        let ambient = given_back.times(Colors::splat(simd, scene.ambient));
        sum = sum.plus(ambient.scaled(surfaces.ambient.simd_into(simd)), all);
        let diffuse: f32x8<S> = surfaces.diffuse.simd_into(simd);
        for Lit { sights, light, lanes } in lit {
            let cosine = f64x8::simd_from(simd, *sights.cosines());
            let (cosine, _) = cosine.narrow(cosine).split();
            let light = given_back.times(Colors::load(simd, light));
            sum = sum.plus(light.scaled(diffuse * cosine), mask32x8::from_bitmask(simd, u64::from(*lanes)));
        }
        // What nothing is seen of through fog is left to the integrator, which goes on only where something is.
        self.lanes &= !(weight.simd_eq(f32x8::splat(simd, 0.0)).to_bitmask() as u32);
        let Colors([r, g, b]) = sum;
        self.sum = [r.into(), g.into(), b.into()];
    }
}

impl Surfaces {
    /// Looks up the surfaces in some lanes; gives those that are plain.
    fn find(&mut self, scene: &CompiledScene, seen: &Seen, lanes: u32) -> u32 {
        let mut plain = 0;
        let mut last: Option<(u32, Option<&Material>)> = None;
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
            let Some(hit) = seen.hit(lane) else { continue };
            let material = match last {
                Some((primitive, material)) if primitive == hit.primitive => material,
                _ => plain_material(scene, hit.primitive),
            };
            last = Some((hit.primitive, material));
            let Some(material) = material else { continue };
            plain |= 1 << lane;
            let color = color_at(scene, &hit, || seen.surface(lane), material).to_array();
            for (column, component) in self.color.iter_mut().zip(color) {
                column[lane] = component;
            }
            (self.ambient[lane], self.diffuse[lane]) = (material.ambient, material.diffuse);
        }
        plain
    }
}

/// The material of a primitive that is plain all over.
fn plain_material(scene: &CompiledScene, primitive: u32) -> Option<&Material> {
    let looks = &scene.objects[primitive as usize].looks;
    let material = scene.material(primitive);
    let shines = [material.specular, material.reflection, material.transparency];
    let is_matte = material.emission.is_none() && shines.into_iter().all(Rgb::is_black);
    let is_plain = is_matte && !looks.has_details() && !material.needs_details();
    is_plain.then_some(material)
}

impl<'a> Lit<'a> {
    /// What arrives from a light where its way is open, and where rays go to it.
    fn find(light: &Light, sights: &'a Sights, shadow_rays: &mut ArrayVec<u32, MOST_LIGHTS>) -> Lit<'a> {
        let mut lit = Lit { sights, light: Columns::default(), lanes: sights.open() };
        let mut rays = sights.wanted();
        match light.everywhere() {
            Some(color) => lit.light = color.to_array().map(|component| [component; LANES]),
            None => {
                for lane in (0..LANES).filter(|lane| sights.wanted() >> lane & 1 == 1) {
                    let sight = sights.get(lane);
                    match light.arriving_along(sight.direction, sight.distance, sight.squared_distance) {
                        Some(arriving) => {
                            for (column, component) in lit.light.iter_mut().zip(arriving.light.to_array()) {
                                column[lane] = component;
                            }
                        }
                        None => (rays, lit.lanes) = (rays & !(1 << lane), lit.lanes & !(1 << lane)),
                    }
                }
            }
        }
        shadow_rays.push(rays);
        lit
    }
}
