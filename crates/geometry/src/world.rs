//! All primitives of a scene, ready for rays.

use crate::bvh::Bvh;
use crate::bvh::build::{Item, Leaves, build};
use crate::simd::boxes::Box32;
use crate::simd::planes::Planes;
use crate::vantage::{Boxed, Flat, MOST_BOUNDED, MOST_PLANES, Vantage};
use crate::{Bounds, Crossing, Primitive, Ray, Surface};
use durer_math::{DVec2, DVec3};
use fearless_simd::{Level, Simd, dispatch};

/// All primitives of a scene, and the structures that find the one a ray meets first. Immutable.
///
/// Of surfaces that meet a ray at the same distance the primitive with the lower index wins, so results depend neither
/// on the tree nor on the instruction set.
#[derive(Debug)]
pub struct World {
    primitives: Vec<Primitive>,
    /// Infinite planes have no box; each ray is tested against all of them, four at a time.
    planes: Vec<Planes>,
    bounded_ids: Vec<u32>,
    bvh: Bvh,
    bounds: Bounds,
    level: Level,
}

/// Where a ray meets the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where on which part of the primitive.
    pub crossing: Crossing,
    /// Index of the primitive.
    pub primitive: u32,
}

impl World {
    /// Builds the search structures, for the best instruction set of this machine.
    pub fn build(primitives: Vec<Primitive>) -> World {
        World::build_for(primitives, Level::new())
    }

    fn build_for(primitives: Vec<Primitive>, level: Level) -> World {
        let ids = 0..primitives.len() as u32;
        let is_plane = |&id: &u32| primitives[id as usize].as_plane().is_some();
        let (plane_ids, bounded_ids): (Vec<u32>, Vec<u32>) = ids.partition(is_plane);
        let boxes: Vec<Bounds> = bounded_ids.iter().map(|&id| primitives[id as usize].bounds()).collect();
        let numbered = bounded_ids.iter().zip(&boxes);
        let mut items: Vec<Item> = numbered.map(|(&id, bounds)| Item::new(id, Box32::around(bounds))).collect();
        let bvh = build(&mut items, Leaves { block: 1, most: 1 }, level);
        let bounded_ids = items.iter().map(Item::number).collect();
        let mut planes = vec![Planes::EMPTY; plane_ids.len().div_ceil(4)];
        for (i, &id) in plane_ids.iter().enumerate() {
            if let Some([normal, point]) = primitives[id as usize].as_plane() {
                planes[i / 4].set(i % 4, id, normal, point);
            }
        }
        let bounds = boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
        World { bvh, planes, bounded_ids, bounds, level, primitives }
    }

    /// The primitives, in the order they were given.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// A box around all primitives but the infinite planes.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of_val(self.primitives.as_slice())
            + size_of_val(self.planes.as_slice())
            + size_of_val(self.bounded_ids.as_slice())
            + self.bvh.memory()
    }

    /// Prepares for many rays through one point; `None` if that would not pay.
    pub fn vantage(&self, point: DVec3) -> Option<Vantage> {
        let plane_count = self.primitives.len() - self.bounded_ids.len();
        if self.bounded_ids.len() > MOST_BOUNDED || plane_count > MOST_PLANES {
            return None;
        }
        let bounded = self.bounded_ids.iter().map(|&id| (id, &self.primitives[id as usize]));
        let boxed: Vec<Boxed> = bounded.map(|(id, primitive)| Boxed { id, bounds: primitive.bounds() }).collect();
        let flat = |(id, primitive): (usize, &Primitive)| {
            let [normal, point] = primitive.as_plane()?;
            Some(Flat { id: id as u32, mask: primitive.mask, normal, point })
        };
        let planes: Vec<Flat> = self.primitives.iter().enumerate().filter_map(flat).collect();
        Some(Vantage::new(point, &boxed, &planes))
    }

    /// The nearest hit with 0 < t < `t_max` on a primitive that shares a bit with `mask`.
    ///
    /// `origin` is a vantage at the ray's origin, if there is one; it changes nothing but the speed.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray, t_max: f64, mask: u32, origin: Option<&Vantage>) -> Option<Hit> {
        match origin.and_then(|vantage| vantage.candidates(ray.direction)) {
            Some(ids) => {
                let mut best = Best::below(t_max);
                for &id in ids {
                    self.offer(&mut best, id, ray, mask);
                }
                best.hit
            }
            None => self.closest_hit_in_tree(ray, t_max, mask),
        }
    }

    #[inline(never)]
    fn closest_hit_in_tree(&self, ray: &Ray, t_max: f64, mask: u32) -> Option<Hit> {
        dispatch!(self.level, simd => self.closest_hit_with(simd, ray, t_max, mask))
    }

    /// Tests one primitive; keeps what is best.
    #[inline(always)]
    fn offer(&self, best: &mut Best, id: u32, ray: &Ray, mask: u32) {
        let primitive = &self.primitives[id as usize];
        if primitive.mask & mask != 0
            && let Some(crossing) = primitive.intersect(ray, best.reach)
        {
            best.offer(id, crossing);
        }
    }

    #[inline(always)]
    fn closest_hit_with<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, mask: u32) -> Option<Hit> {
        let mut best = Best::below(t_max);
        for planes in &self.planes {
            let (mut hits, t) = planes.hits(simd, ray, best.reach);
            while hits != 0 {
                let slot = hits.trailing_zeros() as usize & 3;
                hits &= hits - 1;
                let id = planes.ids[slot];
                if self.primitives[id as usize].mask & mask != 0 {
                    best.offer(id, Crossing { t: t[slot], part: 0 });
                }
            }
        }
        if let [id] = self.bounded_ids[..] {
            self.offer(&mut best, id, ray, mask);
            return best.hit;
        }
        let reach = best.reach;
        self.bvh.nearest(simd, ray, reach, &mut (), |things, ()| {
            for &id in &self.bounded_ids[things] {
                self.offer(&mut best, id, ray, mask);
            }
            best.reach
        });
        best.hit
    }

    /// Calls `visit` for primitives that the ray meets with 0 < t < `t_max`, in an order that has nothing to do with t,
    /// until it returns true; gives whether it did.
    ///
    /// `end` is a vantage at the point that the ray is aimed at, if there is one: with it, planes behind another plane
    /// that was met may be left out.
    #[inline]
    pub fn any_hit(
        &self,
        ray: &Ray,
        t_max: f64,
        end: Option<&Vantage>,
        mut visit: impl FnMut(u32, &Primitive) -> bool,
    ) -> bool {
        match end.and_then(|vantage| vantage.candidates_towards(ray.origin)) {
            Some(ids) => {
                for &id in ids {
                    let primitive = &self.primitives[id as usize];
                    if primitive.meets(ray, t_max) && visit(id, primitive) {
                        return true;
                    }
                }
                false
            }
            None => self.any_hit_in_tree(ray, t_max, &mut visit),
        }
    }

    #[inline(never)]
    fn any_hit_in_tree(&self, ray: &Ray, t_max: f64, visit: &mut dyn FnMut(u32, &Primitive) -> bool) -> bool {
        let mut test = |id: u32| {
            let primitive = &self.primitives[id as usize];
            primitive.meets(ray, t_max) && visit(id, primitive)
        };
        dispatch!(self.level, simd => self.any_hit_with(simd, ray, t_max, &mut test))
    }

    #[inline(always)]
    fn any_hit_with<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, test: &mut impl FnMut(u32) -> bool) -> bool {
        for planes in &self.planes {
            let (mut hits, _) = planes.hits(simd, ray, t_max);
            while hits != 0 {
                if test(planes.ids[hits.trailing_zeros() as usize & 3]) {
                    return true;
                }
                hits &= hits - 1;
            }
        }
        if let [id] = self.bounded_ids[..] {
            return test(id);
        }
        self.bvh.any(simd, ray, t_max, |things| self.bounded_ids[things].iter().any(|&id| test(id)))
    }

    /// The surface at a hit of `ray`.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        self.primitives[hit.primitive as usize].surface(ray, &hit.crossing)
    }

    /// Texture coordinates at a point on the surface that was hit.
    pub fn uv(&self, point: DVec3, hit: &Hit) -> DVec2 {
        self.primitives[hit.primitive as usize].uv(point, hit.crossing.part)
    }
}

/// The best hit so far.
pub(crate) struct Best {
    hit: Option<Hit>,
    /// Hits below this may win; one at the same distance as the best still may, by its index.
    reach: f64,
}

impl Best {
    /// Nothing yet; only hits below `t_max` count.
    #[inline(always)]
    pub(crate) fn below(t_max: f64) -> Best {
        Best { hit: None, reach: t_max }
    }

    /// The best hit.
    #[inline(always)]
    pub(crate) fn hit(&self) -> Option<Hit> {
        self.hit
    }

    /// Hits at or beyond this cannot win.
    #[inline(always)]
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    #[inline(always)]
    pub(crate) fn offer(&mut self, primitive: u32, crossing: Crossing) {
        let wins = match self.hit {
            None => crossing.t < self.reach,
            Some(best) => crossing.t < best.crossing.t || (crossing.t == best.crossing.t && primitive < best.primitive),
        };
        if wins {
            self.hit = Some(Hit { crossing, primitive });
            self.reach = crossing.t.next_up();
        }
    }
}

#[cfg(test)]
mod tests;
