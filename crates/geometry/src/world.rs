//! All primitives of a scene, ready for rays.

use crate::bvh::Bvh;
use crate::bvh::build::{BuildFor, Item, Leaves, Plan, build};
use crate::bvh::traverse::{Most, Watch};
use crate::packet::{LANES, Packet, PacketHits};
use crate::simd::boxes::{Box32, BoxPacket, BoxRay};
use crate::simd::planes::Planes;
use crate::vantage::{Boxed, Flat, MOST_BOUNDED, MOST_PLANES, Vantage};
use crate::{Bounds, Crossing, Primitive, Ray, Surface, Work};
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

/// Primitives are tested one by one.
const LEAVES: Leaves = Leaves { block: 1, most: 1, fuller_for: BuildFor::ManyRays };

/// Where a ray meets the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where on which part of the primitive.
    pub crossing: Crossing,
    /// Index of the primitive.
    pub primitive: u32,
}

impl World {
    /// Builds the search structures.
    pub fn build(primitives: Vec<Primitive>, plan: Plan) -> World {
        let ids = 0..primitives.len() as u32;
        let is_plane = |&id: &u32| primitives[id as usize].as_plane().is_some();
        let (plane_ids, bounded_ids): (Vec<u32>, Vec<u32>) = ids.partition(is_plane);
        let boxes: Vec<Bounds> = bounded_ids.iter().map(|&id| primitives[id as usize].bounds()).collect();
        let numbered = bounded_ids.iter().zip(&boxes);
        let mut items: Vec<Item> = numbered.map(|(&id, bounds)| Item::new(id, Box32::around(bounds))).collect();
        let bvh = build(&mut items, LEAVES, plan);
        let bounded_ids = items.iter().map(Item::number).collect();
        let mut planes = vec![Planes::EMPTY; plane_ids.len().div_ceil(4)];
        for (i, &id) in plane_ids.iter().enumerate() {
            if let Some([normal, point]) = primitives[id as usize].as_plane() {
                planes[i / 4].set(i % 4, id, normal, point);
            }
        }
        // Solids with half-spaces may have no end.
        let bounds = boxes.iter().copied().filter(|one| one.size().is_finite()).fold(Bounds::EMPTY, Bounds::union);
        World { bvh, planes, bounded_ids, bounds, level: plan.simd.level(), primitives }
    }

    /// The instruction set of its searches.
    #[inline(always)]
    pub fn simd(&self) -> Level {
        self.level
    }

    /// The primitives, in the order they were given.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// A box around all primitives but those without end: planes, and solids of half-spaces.
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

    /// Prepares for many rays through one point; `None` if that would not pay. Behind planes that share a bit with `hiding`,
    /// planes of the same mask will be left out: all may hide where only the first hit counts.
    pub fn vantage(&self, point: DVec3, hiding: u32) -> Option<Vantage> {
        let plane_count = self.primitives.len() - self.bounded_ids.len();
        if self.bounded_ids.len() > MOST_BOUNDED || plane_count > MOST_PLANES {
            return None;
        }
        let bounded = self.bounded_ids.iter().map(|&id| (id, &self.primitives[id as usize]));
        let boxed: Vec<Boxed> = bounded.map(|(id, primitive)| Boxed { id, bounds: primitive.bounds() }).collect();
        let flat = |(id, primitive): (usize, &Primitive)| {
            let [normal, point] = primitive.as_plane()?;
            Some(Flat { id: id as u32, mask: primitive.mask, hides: primitive.mask & hiding != 0, normal, point })
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
                for id in ids.iter().copied().map(u32::from) {
                    self.offer(&mut best, id, ray, mask, &mut ());
                }
                best.hit
            }
            None => self.closest_hit_in_tree(ray, t_max, mask),
        }
    }

    #[inline(never)]
    fn closest_hit_in_tree(&self, ray: &Ray, t_max: f64, mask: u32) -> Option<Hit> {
        dispatch!(self.level, simd => self.closest_hit_with(simd, ray, t_max, mask, &mut ()))
    }

    /// As [`World::closest_hit`] without a vantage, adding what it took.
    pub fn closest_hit_watched(&self, ray: &Ray, t_max: f64, mask: u32, work: &mut Work) -> Option<Hit> {
        dispatch!(self.level, simd => self.closest_hit_with(simd, ray, t_max, mask, work))
    }

    /// Tests one primitive; keeps what is best.
    #[inline(always)]
    fn offer(&self, best: &mut Best, id: u32, ray: &Ray, mask: u32, watch: &mut impl Tester) {
        let primitive = &self.primitives[id as usize];
        if primitive.mask & mask != 0
            && let Some(crossing) = watch.intersect(primitive, ray, best.reach)
        {
            best.offer(id, crossing);
        }
    }

    #[inline(always)]
    fn closest_hit_with<S: Simd, W: Tester>(
        &self,
        simd: S,
        ray: &Ray,
        t_max: f64,
        mask: u32,
        watch: &mut W,
    ) -> Option<Hit> {
        let mut best = Best::below(t_max);
        self.offer_planes(simd, &mut best, ray, mask, watch);
        self.offer_bounded(simd, &mut best, ray, mask, watch);
        best.hit
    }

    #[inline(always)]
    fn offer_planes<S: Simd>(&self, simd: S, best: &mut Best, ray: &Ray, mask: u32, watch: &mut impl Tester) {
        for planes in &self.planes {
            watch.things(planes.ids.len());
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
    }

    #[inline(always)]
    fn offer_bounded<S: Simd>(&self, simd: S, best: &mut Best, ray: &Ray, mask: u32, watch: &mut impl Tester) {
        if let [id] = self.bounded_ids[..] {
            self.offer(best, id, ray, mask, watch);
            return;
        }
        let reach = best.reach;
        self.bvh.nearest(
            simd,
            &BoxRay::new(ray),
            &self.bounded_ids,
            reach,
            watch,
            #[inline(always)]
            |things, watch| {
                for &id in &self.bounded_ids[things] {
                    self.offer(best, id, ray, mask, watch);
                }
                best.reach
            },
        );
    }

    /// As [`World::closest_hit`] for each ray of a packet: the same hits, found together.
    pub fn closest_hits(&self, packet: &Packet, t_max: f64, mask: u32) -> [Option<Hit>; LANES] {
        dispatch!(self.level, simd => self.closest_hits_with(simd, packet, t_max, mask))
    }

    #[inline(always)]
    fn closest_hits_with<S: Simd>(&self, simd: S, packet: &Packet, t_max: f64, mask: u32) -> [Option<Hit>; LANES] {
        let mut best = [Best::below(t_max); LANES];
        for (lane, best) in best.iter_mut().enumerate() {
            self.offer_planes(simd, best, &packet.ray(lane), mask, &mut ());
        }
        if let [id] = self.bounded_ids[..] {
            self.offer_to_packet(&mut best, id, packet, mask);
        } else if !self.offer_together(simd, &mut best, packet, mask) {
            for (lane, best) in best.iter_mut().enumerate().take(packet.count()) {
                self.offer_bounded(simd, best, &packet.ray(lane), mask, &mut ());
            }
        }
        best.map(|best| best.hit)
    }

    /// When packets give up: with as many things as pixels, each ray hits its own.
    fn most_met(&self) -> Most {
        const VERY_MANY: usize = 300_000;
        if self.bounded_ids.len() > VERY_MANY { Most::AMONG_VERY_MANY } else { Most::USUAL }
    }

    /// False if the rays are not alike enough to go through the tree together to the end.
    #[inline(always)]
    fn offer_together<S: Simd>(&self, simd: S, best: &mut [Best; LANES], packet: &Packet, mask: u32) -> bool {
        let Some(boxes) = BoxPacket::new(packet, self.most_met()) else { return false };
        self.bvh.nearest(
            simd,
            &boxes,
            &self.bounded_ids,
            farthest(best),
            &mut (),
            #[inline(always)]
            |things, ()| {
                for &id in &self.bounded_ids[things] {
                    self.offer_to_packet(best, id, packet, mask);
                }
                farthest(best)
            },
        )
    }

    /// Tests one primitive with all rays; keeps what is best for each.
    fn offer_to_packet(&self, best: &mut [Best; LANES], id: u32, packet: &Packet, mask: u32) {
        let primitive = &self.primitives[id as usize];
        if primitive.mask & mask == 0 {
            return;
        }
        let mut hits = PacketHits { t: best.each_ref().map(|best| best.reach), part: [-1.0; LANES] };
        primitive.intersect_packet(packet, &mut hits);
        for (lane, best) in best.iter_mut().enumerate() {
            if hits.part[lane] >= 0.0 {
                best.offer(id, Crossing { t: hits.t[lane], part: hits.part[lane] as u32 });
            }
        }
    }

    /// Which rays of a packet meet a primitive that shares a bit with `mask` at 0 < t < `t_max`, one bit each.
    pub fn any_hits(&self, packet: &Packet, t_max: &[f64; LANES], mask: u32) -> u32 {
        dispatch!(self.level, simd => self.any_hits_with(simd, packet, t_max, mask))
    }

    #[inline(always)]
    fn any_hits_with<S: Simd>(&self, simd: S, packet: &Packet, t_max: &[f64; LANES], mask: u32) -> u32 {
        let mut met = 0;
        for (lane, &t_max) in t_max.iter().enumerate().take(packet.count()) {
            met |= u32::from(self.meets_plane(simd, &packet.ray(lane), t_max, mask)) << lane;
        }
        if met != packet.all() && !self.any_together(simd, packet, t_max, mask, &mut met) {
            let missing = packet.all() & !met;
            for lane in (0..packet.count()).filter(|lane| missing >> lane & 1 == 1) {
                let (ray, t_max) = (packet.ray(lane), t_max[lane]);
                let mut meets = |id: u32| {
                    let primitive = &self.primitives[id as usize];
                    primitive.mask & mask != 0 && primitive.meets(&ray, t_max)
                };
                met |= u32::from(self.any_bounded(simd, &ray, t_max, &mut meets)) << lane;
            }
        }
        met
    }

    /// False if the rays are not alike enough to go through the tree together to the end.
    #[inline(always)]
    fn any_together<S: Simd>(&self, simd: S, packet: &Packet, t_max: &[f64; LANES], mask: u32, met: &mut u32) -> bool {
        let mut test = |id: u32| {
            let primitive = &self.primitives[id as usize];
            if primitive.mask & mask != 0 {
                *met |= primitive.meets_packet(packet, t_max);
            }
            *met == packet.all()
        };
        if let [id] = self.bounded_ids[..] {
            test(id);
            return true;
        }
        let Some(boxes) = BoxPacket::new(packet, self.most_met()) else { return false };
        let reach = t_max.iter().fold(0.0, |most, &t| if t > most { t } else { most });
        let found = self.bvh.any(
            simd,
            &boxes,
            &self.bounded_ids,
            reach,
            #[inline(always)]
            |things| self.bounded_ids[things].iter().any(|&id| test(id)),
        );
        found.is_some()
    }

    #[inline(always)]
    fn meets_plane<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, mask: u32) -> bool {
        let mut meets = |id: u32| self.primitives[id as usize].mask & mask != 0;
        self.any_plane(simd, ray, t_max, &mut meets)
    }

    /// Calls `visit` for primitives that the ray meets with 0 < t < `t_max`, in an order that has nothing to do with t,
    /// until it returns true; gives whether it did.
    ///
    /// `end` is a vantage at the point that the ray is aimed at, if there is one: with it, planes behind another plane
    /// that hides them may be left out.
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
                for id in ids.iter().copied().map(u32::from) {
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
        self.any_plane(simd, ray, t_max, test) || self.any_bounded(simd, ray, t_max, test)
    }

    #[inline(always)]
    fn any_plane<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, test: &mut impl FnMut(u32) -> bool) -> bool {
        for planes in &self.planes {
            let (mut hits, _) = planes.hits(simd, ray, t_max);
            while hits != 0 {
                if test(planes.ids[hits.trailing_zeros() as usize & 3]) {
                    return true;
                }
                hits &= hits - 1;
            }
        }
        false
    }

    #[inline(always)]
    fn any_bounded<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, test: &mut impl FnMut(u32) -> bool) -> bool {
        if let [id] = self.bounded_ids[..] {
            return test(id);
        }
        self.bvh.any(
            simd,
            &BoxRay::new(ray),
            &self.bounded_ids,
            t_max,
            #[inline(always)]
            |things| {
                for &id in &self.bounded_ids[things] {
                    if test(id) {
                        return true;
                    }
                }
                false
            },
        ) == Some(true)
    }

    /// The surface at a hit of `ray`.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        self.primitives[hit.primitive as usize].surface(ray, &hit.crossing)
    }

    /// The unit normal that shading is to use at a point on the surface that was hit, if it is not the surface's own. It may
    /// point to either side.
    pub fn shading_normal(&self, point: DVec3, hit: &Hit) -> Option<DVec3> {
        self.primitives[hit.primitive as usize].shading_normal(point, hit.crossing.part)
    }

    /// The weights of a triangle's three vertices at a point on the surface that was hit, if that is a mesh.
    pub fn vertex_weights(&self, point: DVec3, hit: &Hit) -> Option<[f64; 3]> {
        self.primitives[hit.primitive as usize].vertex_weights(point, hit.crossing.part)
    }

    /// The number of the particle that was hit, if these are particles.
    pub fn particle_of(&self, hit: &Hit) -> Option<u32> {
        self.primitives[hit.primitive as usize].particle_of(hit.crossing.part)
    }

    /// Which piece of its primitive was hit: a face of a shape, one of particles, or all of a mesh.
    pub fn piece_of(&self, hit: &Hit) -> u32 {
        self.primitives[hit.primitive as usize].piece_of(hit.crossing.part)
    }

    /// Texture coordinates at a point on the surface that was hit.
    pub fn uv(&self, point: DVec3, hit: &Hit) -> DVec2 {
        self.primitives[hit.primitive as usize].uv(point, hit.crossing.part)
    }
}

/// Tests primitives for a search, and may count what it takes.
trait Tester: Watch {
    fn intersect(&mut self, primitive: &Primitive, ray: &Ray, t_max: f64) -> Option<Crossing>;
}

impl Tester for () {
    #[inline(always)]
    fn intersect(&mut self, primitive: &Primitive, ray: &Ray, t_max: f64) -> Option<Crossing> {
        primitive.intersect(ray, t_max)
    }
}

impl Tester for Work {
    fn intersect(&mut self, primitive: &Primitive, ray: &Ray, t_max: f64) -> Option<Crossing> {
        primitive.intersect_watched(ray, t_max, self)
    }
}

/// How far a packet still has to look.
fn farthest(best: &[Best; LANES]) -> f64 {
    best.iter().fold(0.0, |most, best| if best.reach > most { best.reach } else { most })
}

/// The best hit so far.
#[derive(Clone, Copy, Debug)]
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
