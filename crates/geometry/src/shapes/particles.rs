//! Particles by the million: a tree of their own over blocks of four.
//!
//! Spheres, frusta and capsules are stored as the few numbers that define them, in single precision, relative to an origin
//! that is chosen so that little is lost, and met as exactly as single shapes are. Nothing is kept beside the blocks: what
//! a part is, is found where its number says.

mod axial;
mod ball;
mod capsule;
mod frustum;

use super::Shape;
use crate::bvh::build::{BuildFor, Item, Leaves, Plan, build};
use crate::bvh::traverse::{Watch, Work};
use crate::bvh::{Bvh, Child, MAX_ITEMS};
use crate::sample::Piece;
use crate::simd::blocks::{Block, Hits, SLOTS, WideRay};
use crate::simd::boxes::{Box32, BoxRay};
use crate::simd::{capsules, frusta, spheres};
use crate::world::Best;
use crate::{Bounds, Crossing, Ray, Slender};
use ball::Ball;
use capsule::Capsule;
use durer_math::{DAffine3, DVec2, DVec3};
use fearless_simd::{Level, Simd, dispatch};
use frustum::Frustum;
use rayon::prelude::*;

/// One of many, widened to double precision; it is defined by `N` numbers.
trait Particle<const N: usize>: Copy {
    /// What leaves are best like.
    const LEAVES: Leaves;
    /// The one that these numbers define.
    fn of(numbers: [f32; N]) -> Self;
    /// Which of four a ray meets with 0 < t < `t_max`.
    fn hits<S: Simd>(simd: S, block: &Block<N>, ray: &WideRay<S>, t_max: f64) -> Hits;
    /// A box around it.
    fn bounds(&self) -> Box32;
    /// Its axis, if it is long, or its center, with its greatest radius.
    fn slender(&self) -> Slender;
    /// As [`Shape::surface`].
    fn surface(&self, point: DVec3, face: u32) -> (DVec3, DVec3);
    /// As [`Shape::uv`].
    fn uv(&self, point: DVec3, face: u32) -> DVec2;
    /// As [`Shape::contains`].
    fn contains(&self, point: DVec3) -> bool;
    /// As [`Shape::rounding`].
    fn rounding(&self) -> f64;
    /// What is aimed at, placed by a map; `None` if it is not there.
    fn piece(&self, map: &DAffine3) -> Option<Piece>;
}

/// The blocks of one kind, in the order of the leaves.
#[derive(Debug)]
enum Blocks {
    Spheres(Vec<Block<{ spheres::NUMBERS }>>),
    Frusta(Vec<Block<{ frusta::NUMBERS }>>),
    OpenFrusta(Vec<Block<{ frusta::NUMBERS }>>),
    Capsules(Vec<Block<{ capsules::NUMBERS }>>),
}

/// Evaluates an expression for whatever the kind is: with the type of its particles, and their blocks.
macro_rules! each_kind {
    ($of:expr, $Kind:ident, $blocks:ident => $value:expr) => {
        match $of {
            Blocks::Spheres($blocks) => {
                type $Kind = Ball;
                $value
            }
            Blocks::Frusta($blocks) => {
                type $Kind = Frustum<false>;
                $value
            }
            Blocks::OpenFrusta($blocks) => {
                type $Kind = Frustum<true>;
                $value
            }
            Blocks::Capsules($blocks) => {
                type $Kind = Capsule;
                $value
            }
        }
    };
}

/// Many shapes of one kind, ready for rays.
///
/// Of those that meet a ray at the same distance the one with the lower number wins. A part says block, slot and face;
/// [`Particles::particle_of`] gives the number.
#[derive(Debug)]
pub struct Particles {
    origin: DVec3,
    bvh: Bvh,
    blocks: Blocks,
    bounds: Bounds,
    level: Level,
}

/// Where a test takes longer than that of a box, a leaf has one block if it can.
const SMALL_LEAVES: Leaves = Leaves { block: SLOTS, most: 2, fuller_for: BuildFor::Picture };
/// Where it does not, fewer nodes are better.
const LARGE_LEAVES: Leaves = Leaves { block: 2 * SLOTS, most: 1, fuller_for: BuildFor::Picture };

/// The constructors ask for each particle by its number, some of them several times, and build the tree with as many
/// threads as the current pool has. Numbers are rounded to single precision, places relative to [`Particles::origin`].
impl Particles {
    /// The most particles that one set can have.
    pub const MOST: usize = MAX_ITEMS;

    /// Balls, each with its center and radius.
    pub fn spheres(count: usize, plan: Plan, sphere: impl Fn(usize) -> (DVec3, f64) + Sync) -> Particles {
        let origin = origin_for((0..count).map(|index| sphere(index).0));
        let numbers = |index: usize| {
            let (center, radius) = sphere(index);
            let [x, y, z] = narrow(center - origin);
            [x, y, z, radius as f32]
        };
        let (bvh, blocks, bounds) = plant::<Ball, _>(count, numbers, plan);
        Particles { origin, bvh, blocks: Blocks::Spheres(blocks), bounds, level: plan.simd.level() }
    }

    /// Frusta, each between the middles of its base and its top, with the radii there, of which one may be 0. Those whose
    /// ends are the same point in single precision are not there.
    pub fn frusta(
        count: usize,
        open: bool,
        plan: Plan,
        frustum: impl Fn(usize) -> ([DVec3; 2], [f64; 2]) + Sync,
    ) -> Particles {
        let origin = origin_for((0..count).flat_map(|index| frustum(index).0));
        let numbers = |index: usize| {
            let (ends, [base_radius, top_radius]) = frustum(index);
            let [[a, b, c], [d, e, f]] = ends.map(|end| narrow(end - origin));
            [a, b, c, d, e, f, base_radius as f32, top_radius as f32]
        };
        let (bvh, blocks, bounds) = plant::<Frustum<false>, _>(count, numbers, plan);
        let blocks = if open { Blocks::OpenFrusta(blocks) } else { Blocks::Frusta(blocks) };
        Particles { origin, bvh, blocks, bounds, level: plan.simd.level() }
    }

    /// Capsules, each with the centers of its half balls and their radius.
    pub fn capsules(count: usize, plan: Plan, capsule: impl Fn(usize) -> ([DVec3; 2], f64) + Sync) -> Particles {
        let origin = origin_for((0..count).flat_map(|index| capsule(index).0));
        let numbers = |index: usize| {
            let (ends, radius) = capsule(index);
            let [[a, b, c], [d, e, f]] = ends.map(|end| narrow(end - origin));
            [a, b, c, d, e, f, radius as f32]
        };
        let (bvh, blocks, bounds) = plant::<Capsule, _>(count, numbers, plan);
        Particles { origin, bvh, blocks: Blocks::Capsules(blocks), bounds, level: plan.simd.level() }
    }
}

/// A tree over particles, their blocks, and a box around all.
fn plant<P: Particle<N>, const N: usize>(
    count: usize,
    numbers: impl Fn(usize) -> [f32; N] + Sync,
    plan: Plan,
) -> (Bvh, Vec<Block<N>>, Bounds) {
    debug_assert!(count <= MAX_ITEMS);
    let item = |index: usize| Item::new(index as u32, P::of(numbers(index)).bounds());
    let mut items: Vec<Item> = (0..count).into_par_iter().map(item).collect();
    let bounds = items.iter().fold(Box32::EMPTY, |all, item| all.union(item.0));
    let mut bvh = build(&mut items, P::LEAVES, plan);
    let block = |ids: [u32; SLOTS]| Block::new(ids, ids.map(|id| numbers(id as usize)));
    let blocks = pack(&mut bvh, &items).into_par_iter().map(block).collect();
    (bvh, blocks, Bounds::from(bounds))
}

/// The numbers of the particles in each block; leaves become ranges of blocks.
///
/// A leaf begins in the last block of the leaf before if it then takes no more blocks: to test a neighbor with the own
/// particles costs nothing, and less memory stays unused.
fn pack(bvh: &mut Bvh, items: &[Item]) -> Vec<[u32; SLOTS]> {
    let mut blocks: Vec<[u32; SLOTS]> = Vec::with_capacity(items.len() / 3);
    // Free slots of the last block.
    let mut room = 0;
    for leaf in bvh.leaves_mut() {
        let own = &items[leaf.items()];
        if (own.len() - 1) % SLOTS >= room {
            room = 0;
        }
        let first = blocks.len() - usize::from(room > 0);
        for id in own.iter().map(Item::number) {
            match blocks.last_mut() {
                // Into all free slots: the last particle is there as often as slots are left.
                Some(block) if room > 0 => block[SLOTS - room..].fill(id),
                _ => {
                    blocks.push([id; SLOTS]);
                    room = SLOTS;
                }
            }
            room -= 1;
        }
        *leaf = Child::leaf(first, blocks.len() - first);
    }
    blocks
}

/// The point that coordinates are best relative to: 0 if that loses nothing, or the middle.
fn origin_for(points: impl Iterator<Item = DVec3>) -> DVec3 {
    let (mut exact, mut bounds) = (true, Bounds::EMPTY);
    for point in points {
        exact &= wide(narrow(point)) == point;
        bounds = Bounds { min: bounds.min.min(point), max: bounds.max.max(point) };
    }
    if exact { DVec3::ZERO } else { bounds.center() }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

const FACES: u32 = 4;

/// The part that is a face of what a slot of a block holds.
#[inline(always)]
fn part_of(block: usize, slot: usize, face: u32) -> u32 {
    (block as u32 * SLOTS as u32 + slot as u32) * FACES + face
}

/// The block, the slot and the face of a part.
fn place_of(part: u32) -> (usize, usize, u32) {
    let (place, face) = ((part / FACES) as usize, part % FACES);
    (place / SLOTS, place % SLOTS, face)
}

/// Evaluates an expression for the particle and the face that a part is.
macro_rules! of_part {
    ($particles:expr, $part:expr, $particle:ident, $face:ident => $value:expr) => {{
        let (block, slot, $face) = place_of($part);
        each_kind!(&$particles.blocks, Kind, blocks => {
            let $particle = Kind::of(blocks[block].numbers(slot));
            $value
        })
    }};
}

impl Particles {
    /// What all places are relative to.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.bvh.memory() + each_kind!(&self.blocks, _Kind, blocks => size_of_val(blocks.as_slice()))
    }

    /// The number of the particle that a part belongs to.
    pub fn particle_of(&self, part: u32) -> u32 {
        let (block, slot, _) = place_of(part);
        each_kind!(&self.blocks, _Kind, blocks => blocks[block].ids[slot])
    }

    /// An upper bound on their number, and close to it.
    pub(crate) fn count(&self) -> usize {
        each_kind!(&self.blocks, _Kind, blocks => blocks.len() * SLOTS)
    }

    /// Calls `visit` with each particle, in the particles' space, and its number; with some of them more than once.
    pub(crate) fn each_slender(&self, visit: &mut dyn FnMut(Slender, u32)) {
        each_kind!(&self.blocks, Kind, blocks => {
            for block in blocks {
                // The slots that are left over repeat the last one.
                for slot in (0..SLOTS).filter(|&slot| slot == 0 || block.ids[slot] != block.ids[slot - 1]) {
                    visit(Kind::of(block.numbers(slot)).slender(), block.ids[slot]);
                }
            }
        });
    }

    /// Calls `visit` with the first part of each particle.
    pub(crate) fn each_element(&self, visit: &mut dyn FnMut(u32)) {
        each_kind!(&self.blocks, _Kind, blocks => {
            for (index, block) in blocks.iter().enumerate() {
                // The slots that are left over repeat the last one.
                for slot in (0..SLOTS).filter(|&slot| slot == 0 || block.ids[slot] != block.ids[slot - 1]) {
                    visit(part_of(index, slot, 0));
                }
            }
        });
    }

    /// The first part of the particle that a part belongs to.
    pub(crate) fn element_of(&self, part: u32) -> u32 {
        part - part % FACES
    }

    /// What is aimed at of a particle.
    pub(crate) fn piece(&self, element: u32, map: &DAffine3) -> Option<Piece> {
        of_part!(self, element, particle, _face => particle.piece(map))
    }

    /// True if they have an inside.
    pub(crate) fn are_closed(&self) -> bool {
        match self.blocks {
            Blocks::Spheres(_) | Blocks::Frusta(_) | Blocks::Capsules(_) => true,
            Blocks::OpenFrusta(_) => false,
        }
    }

    #[inline(always)]
    fn nearest<S: Simd, W: Watch>(&self, simd: S, ray: &Ray, t_max: f64, watch: &mut W) -> Option<Crossing> {
        each_kind!(&self.blocks, Kind, blocks => {
            nearest::<S, W, Kind, _>(simd, &self.bvh, blocks, ray, t_max, watch)
        })
    }

    #[inline(always)]
    fn any<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64) -> bool {
        each_kind!(&self.blocks, Kind, blocks => any::<S, Kind, _>(simd, &self.bvh, blocks, ray, t_max))
    }
}

#[inline(always)]
fn nearest<S: Simd, W: Watch, P: Particle<N>, const N: usize>(
    simd: S,
    bvh: &Bvh,
    blocks: &[Block<N>],
    ray: &Ray,
    t_max: f64,
    watch: &mut W,
) -> Option<Crossing> {
    let wide_ray = WideRay::new(simd, ray);
    let mut best = Best::below(t_max);
    // Left to itself the compiler may call the test for a leaf, with everything it needs in memory.
    bvh.nearest(
        simd,
        &BoxRay::new(ray),
        blocks,
        t_max,
        watch,
        #[inline(always)]
        |leaf, watch| {
            for (block, index) in blocks[leaf.clone()].iter().zip(leaf) {
                watch.things(SLOTS);
                let hits = P::hits(simd, block, &wide_ray, best.reach());
                let mut which = hits.which;
                while which != 0 {
                    let slot = which.trailing_zeros() as usize % SLOTS;
                    which &= which - 1;
                    let part = part_of(index, slot, hits.face(slot));
                    best.offer(block.ids[slot], Crossing { t: hits.t[slot], part });
                }
            }
            best.reach()
        },
    );
    best.hit().map(|hit| hit.crossing)
}

#[inline(always)]
fn any<S: Simd, P: Particle<N>, const N: usize>(
    simd: S,
    bvh: &Bvh,
    blocks: &[Block<N>],
    ray: &Ray,
    t_max: f64,
) -> bool {
    let wide_ray = WideRay::new(simd, ray);
    bvh.any(
        simd,
        &BoxRay::new(ray),
        blocks,
        t_max,
        #[inline(always)]
        |leaf| {
            for block in &blocks[leaf] {
                if P::hits(simd, block, &wide_ray, t_max).which != 0 {
                    return true;
                }
            }
            false
        },
    ) == Some(true)
}

/// True if some particle contains a point.
fn contain<P: Particle<N>, const N: usize>(level: Level, bvh: &Bvh, blocks: &[Block<N>], point: DVec3) -> bool {
    // A ray without a length meets the boxes around its origin.
    let here = Ray { origin: point, direction: DVec3::ONE };
    let in_block = |block: &Block<N>| (0..SLOTS).any(|slot| P::of(block.numbers(slot)).contains(point));
    dispatch!(level, simd => bvh.any(simd, &BoxRay::new(&here), blocks, 0.0, |leaf| blocks[leaf].iter().any(in_block)))
        == Some(true)
}

impl Shape for Particles {
    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        dispatch!(self.level, simd => self.nearest(simd, ray, t_max, &mut ()))
    }

    fn intersect_watched(&self, ray: &Ray, t_max: f64, work: &mut Work) -> Option<Crossing> {
        dispatch!(self.level, simd => self.nearest(simd, ray, t_max, work))
    }

    fn meets(&self, ray: &Ray, t_max: f64) -> bool {
        dispatch!(self.level, simd => self.any(simd, ray, t_max))
    }

    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        of_part!(self, part, particle, face => particle.surface(point, face))
    }

    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        of_part!(self, part, particle, face => particle.uv(point, face))
    }

    fn contains(&self, point: DVec3) -> bool {
        each_kind!(&self.blocks, Kind, blocks => contain::<Kind, _>(self.level, &self.bvh, blocks, point))
    }

    fn rounding(&self, part: u32) -> f64 {
        of_part!(self, part, particle, _face => particle.rounding())
    }
}

#[cfg(test)]
mod tests;
