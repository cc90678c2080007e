//! All primitives of a scene, ready for rays.

use crate::bvh::{Bvh, build::build};
use crate::simd::planes::Planes;
use crate::vantage::{MOST_PRIMITIVES, Vantage};
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
    plane_ids: Vec<u32>,
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
        let mut planes = vec![Planes::EMPTY; plane_ids.len().div_ceil(4)];
        for (i, &id) in plane_ids.iter().enumerate() {
            if let Some([normal, point]) = primitives[id as usize].as_plane() {
                planes[i / 4].set(i % 4, normal, point);
            }
        }
        let bounds = boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
        World { bvh: build(&boxes), planes, plane_ids, bounded_ids, bounds, level, primitives }
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
            + size_of_val(self.plane_ids.as_slice())
            + size_of_val(self.bounded_ids.as_slice())
            + self.bvh.memory()
    }

    /// Prepares for many rays through one point; `None` if that would not pay.
    pub fn vantage(&self, point: DVec3) -> Option<Vantage> {
        let boxes = || self.bounded_ids.iter().map(|&id| (id, self.primitives[id as usize].bounds())).collect::<Vec<_>>();
        (self.bounded_ids.len() <= MOST_PRIMITIVES).then(|| Vantage::new(point, &boxes()))
    }

    /// The nearest hit with 0 < t < `t_max` on a primitive that shares a bit with `mask`.
    ///
    /// `origin` is a vantage at the ray's origin, if there is one; it changes nothing but the speed.
    pub fn closest_hit(&self, ray: &Ray, t_max: f64, mask: u32, origin: Option<&Vantage>) -> Option<Hit> {
        let listed = origin.and_then(|vantage| vantage.candidates(ray.direction));
        dispatch!(self.level, simd => self.closest_hit_with(simd, ray, t_max, mask, listed))
    }

    #[inline(always)]
    fn closest_hit_with<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        t_max: f64,
        mask: u32,
        listed: Option<&[u32]>,
    ) -> Option<Hit> {
        let mut best = Best { hit: None, t_max };
        for (planes, ids) in self.planes.iter().zip(self.plane_ids.chunks(4)) {
            let (hits, t) = planes.hits(simd, ray, best.reach());
            for slot in slots(hits).filter(|&slot| self.primitives[ids[slot] as usize].mask & mask != 0) {
                best.offer(ids[slot], Crossing { t: t[slot], part: 0 });
            }
        }
        let reach = best.reach();
        let mut test = |id: u32| {
            let primitive = &self.primitives[id as usize];
            if primitive.mask & mask != 0
                && let Some(crossing) = primitive.intersect(ray, best.reach())
            {
                best.offer(id, crossing);
            }
            best.reach()
        };
        match listed {
            Some(ids) => ids.iter().for_each(|&id| _ = test(id)),
            None => self.bvh.nearest(simd, ray, reach, |thing| test(self.bounded_ids[thing as usize])),
        }
        best.hit
    }

    /// True if some primitive that shares a bit with `mask` is met with 0 < t < `t_max`.
    ///
    /// `end` is a vantage at the point that the ray is aimed at, if there is one; it changes nothing but the speed.
    pub fn any_hit(&self, ray: &Ray, t_max: f64, mask: u32, end: Option<&Vantage>) -> bool {
        let listed = end.and_then(|vantage| vantage.candidates(-ray.direction));
        dispatch!(self.level, simd => self.any_hit_with(simd, ray, t_max, mask, listed))
    }

    #[inline(always)]
    fn any_hit_with<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, mask: u32, listed: Option<&[u32]>) -> bool {
        for (planes, ids) in self.planes.iter().zip(self.plane_ids.chunks(4)) {
            let (hits, _) = planes.hits(simd, ray, t_max);
            if slots(hits).any(|slot| self.primitives[ids[slot] as usize].mask & mask != 0) {
                return true;
            }
        }
        let test = |id: u32| {
            let primitive = &self.primitives[id as usize];
            primitive.mask & mask != 0 && primitive.intersect(ray, t_max).is_some()
        };
        match listed {
            Some(ids) => ids.iter().any(|&id| test(id)),
            None => self.bvh.any(simd, ray, t_max, |thing| test(self.bounded_ids[thing as usize])),
        }
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

/// The bits that are set, lowest first, of the four that a group of planes has.
#[inline(always)]
fn slots(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let slot = (bits != 0).then(|| bits.trailing_zeros() as usize & 3)?;
        bits &= bits - 1;
        Some(slot)
    })
}

/// The best hit so far.
struct Best {
    hit: Option<Hit>,
    t_max: f64,
}

impl Best {
    /// Hits below this may win; a hit at the same distance as the best still may, by its index.
    #[inline(always)]
    fn reach(&self) -> f64 {
        match self.hit {
            Some(hit) => hit.crossing.t.next_up(),
            None => self.t_max,
        }
    }

    #[inline(always)]
    fn offer(&mut self, primitive: u32, crossing: Crossing) {
        let wins = match self.hit {
            None => crossing.t < self.t_max,
            Some(best) => {
                crossing.t < best.crossing.t || (crossing.t == best.crossing.t && primitive < best.primitive)
            }
        };
        if wins {
            self.hit = Some(Hit { crossing, primitive });
        }
    }
}
