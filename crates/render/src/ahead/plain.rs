//! Eight plain points at once: all that arrives from surfaces that only give back light, evenly and as a highlight.
//!
//! Most of what eyes see is such: no mirror, nothing behind it, and every lamp is either surely seen or surely hidden. The
//! terms of the sum are those of the integrator for one point, operation by operation and in its order, so that each lane
//! has the bits that it would have alone; a test holds that.

use crate::compile::CompiledScene;
use crate::lanes::{pow_wide, single};
use crate::lights::Light;
use crate::materials::Material;
use crate::shading::color_at;
use durer_geometry::{LANES, Packet, Seen, Sights};
use durer_math::Rgb;
use durer_scene::Paint;
use fearless_simd::{Simd, dispatch, f32x8, f64x8, mask32x8, prelude::*};

/// What arrives from eight points that rays of the eye see, as far as they are plain.
#[derive(Clone, Debug, Default)]
#[repr(C, align(64))]
pub(crate) struct Plain {
    sum: Columns,
    surfaces: Surfaces,
    /// Which of them are plain, one bit each.
    lanes: u32,
    /// How many rays to lights each takes: a byte for each lane.
    shadow_rays: u64,
}

/// All that arrives along a ray of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sum {
    pub(crate) color: Rgb,
    /// Rays to lights that it took.
    pub(crate) shadow_rays: u64,
}

/// What is known ahead of eight rays of the eye.
pub(super) struct View<'a> {
    pub(super) rays: &'a Packet,
    pub(super) seen: &'a Seen,
    /// How that lies to the first lights.
    pub(super) sights: &'a [Option<Sights>],
    /// What fog leaves of it.
    pub(super) visible: &'a [f32; LANES],
}

/// A color in each of eight lanes, by components.
type Columns = [[f32; LANES]; 3];

/// All of them.
const ALL: u32 = (1 << LANES) - 1;

/// What surfaces give back.
#[derive(Clone, Debug, Default)]
#[repr(C, align(64))]
struct Surfaces {
    color: Columns,
    ambient: [f32; LANES],
    diffuse: [f32; LANES],
    specular: Columns,
    shininess: [f32; LANES],
    /// Those with a highlight.
    shiny: u32,
}

/// What arrives from a light at eight points.
struct Arriving {
    light: Columns,
    /// From where rays go to it.
    rays: u32,
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
    /// What arrives from one of the points, if it is plain; it is finite.
    #[inline(always)]
    pub(crate) fn sum(&self, lane: usize) -> Option<Sum> {
        let lane = lane % LANES;
        if self.lanes >> lane & 1 == 0 {
            return None;
        }
        let color = Rgb::new(self.sum[0][lane], self.sum[1][lane], self.sum[2][lane]);
        Some(Sum { color, shadow_rays: self.shadow_rays >> (8 * lane) & 0xff })
    }

    /// Looks at what is seen.
    pub(super) fn find(&mut self, scene: &CompiledScene, view: &View<'_>) {
        let mut lanes = view.seen.lanes();
        for sights in view.sights {
            lanes &= sights.as_ref().map_or(0, |sights| !sights.unknown());
        }
        let all_is_known = view.sights.len() == scene.lights.len() && !scene.emitters.has_shapes();
        self.lanes = match lanes != 0 && all_is_known {
            true => self.surfaces.find(scene, view.seen, lanes),
            false => 0,
        };
        if self.lanes != 0 {
            dispatch!(scene.world.simd(), simd => self.add_up(simd, scene, view));
        }
    }

    #[inline(always)]
    fn add_up<S: Simd>(&mut self, simd: S, scene: &CompiledScene, view: &View<'_>) {
        let all = mask32x8::from_bitmask(simd, u64::from(ALL));
        let mut sum = Colors::splat(simd, Rgb::BLACK);
        let mut weight = f32x8::splat(simd, 1.0);
        if let Some(fog) = &scene.fog {
            let visible = (*view.visible).simd_into(simd);
            let veil = Colors::splat(simd, fog.color()).scaled(f32x8::splat(simd, 1.0) - visible);
            (sum, weight) = (sum.plus(veil, all), visible);
        }
        let surfaces = &self.surfaces;
        let given_back = Colors::load(simd, &surfaces.color).scaled(weight);
        let ambient = given_back.times(Colors::splat(simd, scene.ambient));
        sum = sum.plus(ambient.scaled(surfaces.ambient.simd_into(simd)), all);
        let diffuse: f32x8<S> = surfaces.diffuse.simd_into(simd);
        self.shadow_rays = 0;
        for (light, sights) in scene.lights.iter().zip(view.sights.iter().flatten()) {
            if sights.wanted() & self.lanes == 0 {
                continue;
            }
            let (arriving, rays) = match light.everywhere() {
                Some(color) => (Colors::splat(simd, color), sights.wanted()),
                None => {
                    let Arriving { light, rays } = Arriving::find(light, sights);
                    (Colors::load(simd, &light), rays)
                }
            };
            self.shadow_rays += a_byte_each(rays);
            let lit = sights.open() & rays & self.lanes;
            if lit == 0 {
                continue;
            }
            let mask = mask32x8::from_bitmask(simd, u64::from(lit));
            let cosine = single(f64x8::simd_from(simd, *sights.cosines()));
            sum = sum.plus(given_back.times(arriving).scaled(diffuse * cosine), mask);
            if lit & surfaces.shiny != 0 {
                let mask = mask32x8::from_bitmask(simd, u64::from(lit & surfaces.shiny));
                let given_back = Colors::load(simd, &surfaces.specular).scaled(weight);
                let strength = highlight(simd, view, sights, surfaces.shininess.simd_into(simd));
                sum = sum.plus(given_back.times(arriving).scaled(strength), mask);
            }
        }
        // What nothing is seen of through fog is left to the integrator, which goes on only where something is.
        self.lanes &= !(weight.simd_eq(f32x8::splat(simd, 0.0)).to_bitmask() as u32);
        // So is what is not finite, which others count.
        let Colors([r, g, b]) = sum;
        let least = r * 0.0 + g * 0.0 + b * 0.0;
        self.lanes &= least.simd_eq(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
        self.sum = [r.into(), g.into(), b.into()];
    }
}

/// Phong's highlight, as [`crate::shading::highlight`] computes it.
#[inline(always)]
fn highlight<S: Simd>(simd: S, view: &View<'_>, sights: &Sights, shininess: f32x8<S>) -> f32x8<S> {
    let vectors = |columns: &[[f64; LANES]; 3]| columns.map(|column| f64x8::simd_from(simd, column));
    let [nx, ny, nz] = vectors(view.seen.faces());
    let [lx, ly, lz] = vectors(sights.directions());
    let [dx, dy, dz] = vectors(view.rays.directions());
    let twice = (nx * lx + ny * ly + nz * lz) * 2.0;
    let [mx, my, mz] = [nx * twice - lx, ny * twice - ly, nz * twice - lz];
    let cosine = -(mx * dx + my * dy + mz * dz);
    let shines = cosine.simd_gt(f64x8::splat(simd, 0.0));
    let base = shines.select(cosine, f64x8::splat(simd, 1.0));
    let shines = mask32x8::from_bitmask(simd, shines.to_bitmask());
    shines.select(pow_wide(simd, base, shininess), f32x8::splat(simd, 0.0))
}

/// A byte for each lane: 1 in those that are in a set.
#[inline(always)]
fn a_byte_each(lanes: u32) -> u64 {
    const EACH: u64 = 0x0101_0101_0101_0101;
    // Copies of the set, of which each byte keeps its own lane's bit; that is carried to the highest place, and down.
    let own = u64::from(lanes & ALL) * EACH & 0x8040_2010_0804_0201;
    (own + 0x7f * EACH) >> 7 & EACH
}

impl Surfaces {
    /// Looks up the surfaces in some lanes; gives those that are plain.
    fn find(&mut self, scene: &CompiledScene, seen: &Seen, lanes: u32) -> u32 {
        let mut plain = 0;
        self.shiny = 0;
        for &(primitive, group) in seen.groups() {
            let lanes = group & lanes;
            let Some(material) = plain_material(scene, primitive).filter(|_| lanes != 0) else { continue };
            plain |= lanes;
            put(&mut self.ambient, lanes, material.ambient);
            put(&mut self.diffuse, lanes, material.diffuse);
            match material.color {
                Paint::Color(color) => put_color(&mut self.color, lanes, color),
                Paint::Texture(_) => {
                    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
                        let Some(hit) = seen.hit(lane) else { continue };
                        let color = color_at(scene, &hit, || seen.surface(lane), material);
                        put_color(&mut self.color, 1 << lane, color);
                    }
                }
            }
            if !material.specular.is_black() {
                self.shiny |= lanes;
                put_color(&mut self.specular, lanes, material.specular);
                put(&mut self.shininess, lanes, material.shininess);
            }
        }
        plain
    }
}

/// Puts a number into some lanes.
#[inline(always)]
fn put(column: &mut [f32; LANES], lanes: u32, number: f32) {
    if lanes == ALL {
        *column = [number; LANES];
        return;
    }
    for (lane, slot) in column.iter_mut().enumerate() {
        if lanes >> lane & 1 == 1 {
            *slot = number;
        }
    }
}

#[inline(always)]
fn put_color(columns: &mut Columns, lanes: u32, color: Rgb) {
    for (column, component) in columns.iter_mut().zip(color.to_array()) {
        put(column, lanes, component);
    }
}

/// The material of a primitive that is plain all over.
fn plain_material(scene: &CompiledScene, primitive: u32) -> Option<&Material> {
    let looks = &scene.objects[primitive as usize].looks;
    let material = scene.material(primitive);
    let shines = [material.reflection, material.transparency];
    let is_closed = material.emission.is_none() && shines.into_iter().all(Rgb::is_black);
    let is_plain = is_closed && !looks.has_details() && !material.needs_details();
    is_plain.then_some(material)
}

impl Arriving {
    /// What arrives from a light if nothing is in the way.
    #[inline(never)]
    fn find(light: &Light, sights: &Sights) -> Arriving {
        let mut all = Arriving { light: Columns::default(), rays: sights.wanted() };
        for lane in (0..LANES).filter(|lane| sights.wanted() >> lane & 1 == 1) {
            let sight = sights.get(lane);
            match light.arriving_along(sight.direction, sight.distance, sight.squared_distance) {
                Some(arriving) => put_color(&mut all.light, 1 << lane, arriving.light),
                None => all.rays &= !(1 << lane),
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_of_lanes_is_a_byte_each() {
        for lanes in 0..256 {
            let bytes = (0..8).map(|lane| u8::from(lanes >> lane & 1 == 1)).collect::<Vec<_>>();
            assert_eq!(a_byte_each(lanes).to_le_bytes().to_vec(), bytes);
        }
    }
}
