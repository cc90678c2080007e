//! Triangle meshes: a tree of their own over blocks of four triangles.

use super::Shape;
use super::triangle::Triangle;
use crate::bvh::build::{BuildFor, Item, Leaves, Plan, build};
use crate::bvh::traverse::{Watch, Work};
use crate::bvh::{Bvh, Child, MAX_ITEMS};
use crate::packet::{LANES, Packet, PacketHits};
use crate::simd::boxes::{Box32, BoxPacket, BoxRay};
use crate::simd::triangles::{BestLanes, TrianglePacket, TriangleRay, Triangles};
use crate::world::Best;
use crate::{Bounds, Crossing, Ray};
use durer_math::{DVec2, DVec3};
use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use rayon::prelude::*;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The lists that a mesh is made of. They stay where they are: a mesh keeps what its tree needs, and looks up the rest of
/// the one triangle that was hit.
pub trait MeshSource: Debug + Send + Sync {
    /// The vertices, finite.
    fn positions(&self) -> &[[f32; 3]];
    /// Three vertices each, all of which exist; counter-clockwise seen from the front.
    fn triangles(&self) -> &[[u32; 3]];
    /// Shading normals, one for each vertex or none; of any length but zero.
    fn normals(&self) -> &[[f32; 3]];
    /// Texture coordinates, one for each vertex or none.
    fn uvs(&self) -> &[[f32; 2]];
    /// True if the mesh has an inside: each edge joins two triangles that run along it in opposite directions. Asked once, if
    /// anyone needs to know.
    fn is_closed(&self) -> bool;
}

/// A triangle mesh, ready for rays.
#[derive(Debug)]
pub struct Mesh {
    source: Arc<dyn MeshSource>,
    bvh: Bvh,
    blocks: Vec<Triangles>,
    bounds: Bounds,
    /// Whether it has an inside; found out when first asked.
    closed: OnceLock<bool>,
    level: Level,
}

/// With two blocks in a leaf, rays tested a third more blocks and hardly fewer nodes. Fuller nodes take a sixth more time to
/// build, and make searches for any hit 5 % faster.
const LEAVES: Leaves = Leaves { block: Triangles::COUNT, most: 1, fuller_for: BuildFor::ManyRays };

impl Mesh {
    /// The most triangles that one mesh can have.
    pub const MOST_TRIANGLES: usize = MAX_ITEMS;

    /// Builds the tree, with as many threads as the current pool has.
    pub fn build(source: Arc<dyn MeshSource>, purpose: BuildFor) -> Mesh {
        Mesh::build_as(source, Plan::new(purpose))
    }

    fn build_as(source: Arc<dyn MeshSource>, plan: Plan) -> Mesh {
        let (positions, triangles) = (source.positions(), source.triangles());
        let corners = |id: usize| triangles[id].map(|vertex| positions[vertex as usize]);
        let item = |id: usize| Item::new(id as u32, bounds_of(corners(id)));
        let mut items: Vec<Item> = (0..triangles.len()).into_par_iter().map(item).collect();
        let bounds = items.iter().fold(Box32::EMPTY, |all, item| all.union(item.0));
        let mut bvh = build(&mut items, LEAVES, plan);
        let mut of_leaves = Vec::with_capacity(items.len() / 3);
        for leaf in bvh.leaves_mut() {
            of_leaves.push(leaf.items());
            *leaf = Child::leaf(of_leaves.len() - 1, 1);
        }
        let numbered = |id: u32| (id, corners(id as usize));
        let block = |leaf: Range<usize>| Triangles::new(items[leaf].iter().map(|item| numbered(item.number())));
        let blocks = of_leaves.into_par_iter().map(block).collect();
        Mesh { bounds: Bounds::from(bounds), bvh, blocks, closed: OnceLock::new(), level: plan.level, source }
    }

    /// Bytes held beside the source.
    pub fn memory(&self) -> usize {
        self.bvh.memory() + size_of_val(self.blocks.as_slice())
    }

    /// The lists it is made of.
    pub fn source(&self) -> &dyn MeshSource {
        &*self.source
    }

    /// True if it has an inside, as its source says.
    pub fn is_closed(&self) -> bool {
        *self.closed.get_or_init(|| self.source.is_closed())
    }

    /// The shading normal at a point of a triangle, of any length but zero, if the mesh has such normals.
    pub(crate) fn shading_normal(&self, point: DVec3, part: u32) -> Option<DVec3> {
        let normals = self.source.normals();
        if normals.is_empty() {
            return None;
        }
        let corners = self.source.triangles()[part as usize].map(|vertex| wide(normals[vertex as usize]));
        let [a, b, c] = self.weights(point, part);
        Some(corners[0] * a + corners[1] * b + corners[2] * c)
    }

    /// The weights of a triangle's corners at a point of it.
    pub(crate) fn weights(&self, point: DVec3, part: u32) -> [f64; 3] {
        let (b, c) = self.triangle(part).weights(point);
        [1.0 - b - c, b, c]
    }

    fn triangle(&self, part: u32) -> Triangle {
        let corners = self.source.triangles()[part as usize];
        let vertices = corners.map(|vertex| wide(self.source.positions()[vertex as usize]));
        let uvs = match self.source.uvs() {
            [] => [DVec2::ZERO, DVec2::X, DVec2::Y],
            uvs => corners.map(|vertex| DVec2::from(uvs[vertex as usize].map(f64::from))),
        };
        Triangle { vertices, uvs }
    }

    #[inline(always)]
    fn nearest<S: Simd, W: Watch>(&self, simd: S, ray: &Ray, t_max: f64, watch: &mut W) -> Option<Crossing> {
        let triangle_ray = TriangleRay::new(simd, ray);
        let mut best = Best::below(t_max);
        self.bvh.nearest(
            simd,
            &BoxRay::new(ray),
            &self.blocks,
            t_max,
            watch,
            #[inline(always)]
            |blocks, watch| {
                for block in &self.blocks[blocks] {
                    watch.things(Triangles::COUNT);
                    let (mut hits, t) = triangle_ray.hits(simd, block, best.reach());
                    while hits != 0 {
                        let slot = hits.trailing_zeros() as usize & 3;
                        hits &= hits - 1;
                        best.offer(block.ids[slot], Crossing { t: t[slot], part: block.ids[slot] });
                    }
                }
                best.reach()
            },
        );
        best.hit().map(|hit| hit.crossing)
    }

    /// All triangles that the ray meets, in any order.
    #[inline(always)]
    fn all<S: Simd>(&self, simd: S, ray: &Ray, met: &mut Vec<Crossing>) {
        let triangle_ray = TriangleRay::new(simd, ray);
        self.bvh.any(
            simd,
            &BoxRay::new(ray),
            &self.blocks,
            f64::INFINITY,
            #[inline(always)]
            |blocks| {
                for block in &self.blocks[blocks] {
                    let (mut hits, t) = triangle_ray.hits(simd, block, f64::INFINITY);
                    while hits != 0 {
                        let slot = hits.trailing_zeros() as usize & 3;
                        hits &= hits - 1;
                        let crossing = Crossing { t: t[slot], part: block.ids[slot] };
                        // Unused slots repeat the first.
                        if slot < block.count() {
                            met.push(crossing);
                        }
                    }
                }
                false
            },
        );
    }

    #[inline(always)]
    fn any<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64) -> bool {
        let triangle_ray = TriangleRay::new(simd, ray);
        self.bvh.any(
            simd,
            &BoxRay::new(ray),
            &self.blocks,
            t_max,
            #[inline(always)]
            |blocks| {
                for block in &self.blocks[blocks] {
                    if triangle_ray.hits(simd, block, t_max).0 != 0 {
                        return true;
                    }
                }
                false
            },
        ) == Some(true)
    }
}

/// Rays that go different ways gain nothing from going together.
enum Together<S: Simd> {
    Yes(BoxPacket, TrianglePacket<S>),
    No,
}

impl Mesh {
    #[inline(always)]
    fn together<S: Simd>(simd: S, packet: &Packet) -> Together<S> {
        match (BoxPacket::new(packet), TrianglePacket::new(simd, packet)) {
            (Some(boxes), Some(triangles)) => Together::Yes(boxes, triangles),
            _ => Together::No,
        }
    }

    #[inline(always)]
    fn nearest_of_packet<S: Simd>(&self, simd: S, packet: &Packet, hits: &mut PacketHits) {
        let mut done = false;
        if let Together::Yes(boxes, triangles) = Mesh::together(simd, packet) {
            let mut best = BestLanes { t: f64x8::simd_from(simd, hits.t), part: f64x8::simd_from(simd, hits.part) };
            done = self.bvh.nearest(
                simd,
                &boxes,
                &self.blocks,
                best.t.reduce_max(),
                &mut (),
                #[inline(always)]
                |blocks, ()| {
                    for block in &self.blocks[blocks] {
                        for slot in 0..block.count() {
                            triangles.offer(simd, block, slot, &mut best);
                        }
                    }
                    best.t.reduce_max()
                },
            );
            (hits.t, hits.part) = (best.t.into(), best.part.into());
        }
        if !done {
            for lane in 0..packet.count() {
                // What was found together may be found again; then nothing changes.
                let reach = if hits.part[lane] < 0.0 { hits.t[lane] } else { hits.t[lane].next_up() };
                if let Some(crossing) = self.nearest(simd, &packet.ray(lane), reach, &mut ()) {
                    (hits.t[lane], hits.part[lane]) = (crossing.t, f64::from(crossing.part));
                }
            }
        }
    }

    #[inline(always)]
    fn any_of_packet<S: Simd>(&self, simd: S, packet: &Packet, t_max: &[f64; LANES]) -> u32 {
        let mut met = 0;
        let mut done = false;
        if let Together::Yes(boxes, triangles) = Mesh::together(simd, packet) {
            let reach = f64x8::simd_from(simd, *t_max);
            let found = self.bvh.any(
                simd,
                &boxes,
                &self.blocks,
                reach.reduce_max(),
                #[inline(always)]
                |blocks| {
                    for block in &self.blocks[blocks] {
                        for slot in 0..block.count() {
                            met |= triangles.hits(simd, block, slot, reach);
                        }
                    }
                    met & packet.all() == packet.all()
                },
            );
            done = found.is_some();
        }
        if !done {
            let missing = packet.all() & !met;
            for lane in (0..packet.count()).filter(|lane| missing >> lane & 1 == 1) {
                met |= u32::from(self.any(simd, &packet.ray(lane), t_max[lane])) << lane;
            }
        }
        met & packet.all()
    }

    /// As [`Shape::intersect`] for the rays of a packet: hits nearer than those in `hits` take their places.
    pub(crate) fn intersect_packet(&self, packet: &Packet, hits: &mut PacketHits) {
        dispatch!(self.level, simd => self.nearest_of_packet(simd, packet, hits));
    }

    /// As [`Shape::meets`] for the rays of a packet, one bit each.
    pub(crate) fn meets_packet(&self, packet: &Packet, t_max: &[f64; LANES]) -> u32 {
        dispatch!(self.level, simd => self.any_of_packet(simd, packet, t_max))
    }
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

fn bounds_of(corners: [[f32; 3]; 3]) -> Box32 {
    let [a, b, c] = corners;
    let least = |axis: usize| a[axis].min(b[axis]).min(c[axis]);
    let greatest = |axis: usize| a[axis].max(b[axis]).max(c[axis]);
    Box32::new(std::array::from_fn(least), std::array::from_fn(greatest))
}

impl Shape for Mesh {
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
        self.triangle(part).surface(point, 0)
    }

    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        self.triangle(part).uv(point, 0)
    }

    /// Inside is where the first triangle in some direction is seen from behind.
    fn contains(&self, point: DVec3) -> bool {
        // A direction that no edge of a mesh made by people is likely to lie in.
        let ray = Ray { origin: point, direction: DVec3::new(0.371_931, 0.612_147, 0.697_877) };
        let inside = |crossing: Crossing| {
            let (_, normal) = self.surface(ray.at(crossing.t), crossing.part);
            normal.dot(ray.direction) > 0.0
        };
        self.is_closed() && self.intersect(&ray, f64::INFINITY).is_some_and(inside)
    }

    fn rounding(&self, part: u32) -> f64 {
        self.triangle(part).rounding(0)
    }

    fn part_count(&self) -> u32 {
        self.source.triangles().len() as u32
    }

    /// On an edge a ray meets two triangles in the same place; only what changes sides is a crossing.
    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        let mut met = Vec::new();
        if self.is_closed() {
            dispatch!(self.level, simd => self.all(simd, ray, &mut met));
        }
        met.sort_by(|a: &Crossing, b: &Crossing| a.t.total_cmp(&b.t).then(a.part.cmp(&b.part)));
        let leaves = |crossing: &Crossing| {
            self.triangle(crossing.part).surface(ray.at(crossing.t), 0).1.dot(ray.direction) > 0.0
        };
        let starts_inside = met.first().is_some_and(leaves);
        let mut inside = starts_inside;
        for crossing in met {
            if leaves(&crossing) == inside {
                visit(crossing);
                inside = !inside;
            }
        }
        starts_inside
    }
}

#[cfg(test)]
mod tests;
