//! Triangle meshes: a tree of their own over blocks of four triangles.

use super::Shape;
use super::triangle::Triangle;
use crate::bvh::build::{BuildFor, Item, Leaves, Plan, build};
use crate::bvh::traverse::{Most, Watch, Work};
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
use winding::Line;

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
    /// The volume inside, if the mesh has an inside: if each edge joins two triangles that run along it in opposite
    /// directions. Negative if the triangles face inward. Asked once, if anyone needs to know.
    fn enclosed_volume(&self) -> Option<f64>;
}

/// A triangle mesh, ready for rays.
#[derive(Debug)]
pub struct Mesh {
    source: Arc<dyn MeshSource>,
    bvh: Bvh,
    blocks: Vec<Triangles>,
    bounds: Bounds,
    /// The volume inside, if it has an inside; found out when first asked.
    enclosed: OnceLock<Option<f64>>,
    level: Level,
}

/// With two blocks in a leaf, rays tested a third more blocks and hardly fewer nodes. Fuller nodes take a sixth more time to
/// build, and make searches for any hit 5 % faster.
const LEAVES: Leaves = Leaves { block: Triangles::COUNT, most: 1, fuller_for: BuildFor::ManyRays };

impl Mesh {
    /// The most triangles that one mesh can have.
    pub const MOST_TRIANGLES: usize = MAX_ITEMS;

    /// Calls `visit` with the corners of each triangle, in the mesh's own space.
    pub(crate) fn each_triangle(&self, mut visit: impl FnMut([DVec3; 3])) {
        let positions = self.source.positions();
        for triangle in self.source.triangles() {
            visit(triangle.map(|vertex| wide(positions[vertex as usize])));
        }
    }

    /// The corners of a triangle, in the mesh's own space.
    pub(crate) fn corners(&self, part: u32) -> [DVec3; 3] {
        self.source.triangles()[part as usize].map(|vertex| wide(self.source.positions()[vertex as usize]))
    }

    pub(crate) fn triangle_count(&self) -> usize {
        self.source.triangles().len()
    }

    /// Builds the tree, with as many threads as the current pool has.
    pub fn build(source: Arc<dyn MeshSource>, plan: Plan) -> Mesh {
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
        Mesh { bounds: Bounds::from(bounds), bvh, blocks, enclosed: OnceLock::new(), level: plan.simd.level(), source }
    }

    /// Bytes held beside the source.
    pub fn memory(&self) -> usize {
        self.bvh.memory() + size_of_val(self.blocks.as_slice())
    }

    /// The lists it is made of.
    pub fn source(&self) -> &dyn MeshSource {
        &*self.source
    }

    /// True if it has an inside, as its source says. Who needs the inside, or normals that point out of it, asks this before
    /// any ray is sent.
    pub fn is_closed(&self) -> bool {
        self.enclosed.get_or_init(|| self.source.enclosed_volume()).is_some()
    }

    /// True if it is known to be closed, with triangles that face inward.
    fn is_inside_out(&self) -> bool {
        matches!(self.enclosed.get(), Some(Some(volume)) if *volume < 0.0)
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

    /// From a point of a triangle to the rounder surface that the normals of its corners tell of: the mean of its images on the
    /// planes across those normals, by the weights of the corners (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II,
    /// 2021, §4). `None` where that is not before the triangle, as seen from the side that the normals point to or, if
    /// `is_behind`, from the other: where the corners do not all bend away.
    pub(crate) fn lift(&self, point: DVec3, part: u32, is_behind: bool) -> Option<DVec3> {
        /// What rounding may make of an edge along which the surface does not bend.
        const FLAT: f64 = 1e-3;
        let normals = self.source.normals();
        if normals.is_empty() {
            return None;
        }
        let Triangle { vertices, .. } = self.triangle(part);
        let sign = if is_behind { -1.0 } else { 1.0 };
        let (weights, corners) = (self.weights(point, part), self.source.triangles()[part as usize]);
        let mut lift = DVec3::ZERO;
        for (index, (weight, vertex)) in weights.into_iter().zip(corners).enumerate() {
            let normal = (wide(normals[vertex as usize]) * sign).try_normalize()?;
            let here = vertices[index];
            let bends_away = |there: &DVec3| (*there - here).dot(normal) <= FLAT * (*there - here).length();
            if !vertices.iter().all(bends_away) {
                return None;
            }
            lift -= normal * (weight * (point - here).dot(normal).min(0.0));
        }
        Some(lift)
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

    /// Where the ray passes through triangles, each passage once, and whether it does so from behind; in any order.
    #[inline(always)]
    fn passages<S: Simd>(&self, simd: S, ray: &Ray) -> Vec<(Crossing, bool)> {
        let (line, mut passages) = (Line::new(ray), Vec::new());
        self.bvh.any(simd, &BoxRay::new(ray), &self.blocks, f64::INFINITY, |blocks| {
            for block in &self.blocks[blocks] {
                for &part in &block.ids[..block.count()] {
                    if let Some((t, from_behind)) = line.passage(self.triangle(part).vertices)
                        && t > 0.0
                    {
                        passages.push((Crossing { t, part }, from_behind));
                    }
                }
            }
            false
        });
        passages
    }

    /// The passages along a ray, if there is an inside, and the winding number around its origin.
    fn wound(&self, ray: &Ray) -> (Vec<(Crossing, bool)>, i32) {
        if !self.is_closed() {
            return (Vec::new(), 0);
        }
        let passages = dispatch!(self.level, simd => self.passages(simd, ray));
        let winding = passages.iter().map(|&(_, from_behind)| if from_behind { 1 } else { -1 }).sum();
        (passages, winding)
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
        match (BoxPacket::new(packet, Most::USUAL), TrianglePacket::new(simd, packet)) {
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

    /// The normal of a closed mesh points outward, whichever way its triangles face.
    fn surface(&self, point: DVec3, part: u32) -> (DVec3, DVec3) {
        let (point, normal) = self.triangle(part).surface(point, 0);
        (point, if self.is_inside_out() { -normal } else { normal })
    }

    fn uv(&self, point: DVec3, part: u32) -> DVec2 {
        self.triangle(part).uv(point, 0)
    }

    /// Inside is what the mesh winds around, as often as it may.
    fn contains(&self, point: DVec3) -> bool {
        let within = self.bounds.min.cmple(point).all() && point.cmple(self.bounds.max).all();
        within && self.wound(&Ray { origin: point, direction: DVec3::Z }).1 != 0
    }

    fn rounding(&self, part: u32) -> f64 {
        self.triangle(part).rounding(0)
    }

    fn part_count(&self) -> u32 {
        self.source.triangles().len() as u32
    }

    /// Where what the ray is in changes from nothing to something or back: what lies within several bodies of one mesh is
    /// inside of them all.
    fn crossings(&self, ray: &Ray, visit: &mut dyn FnMut(Crossing)) -> bool {
        let (mut passages, starts_in) = self.wound(ray);
        // Ways in come first, so that bodies that touch are one.
        passages.sort_by(|(a, a_out), (b, b_out)| a.t.total_cmp(&b.t).then(a_out.cmp(b_out)).then(a.part.cmp(&b.part)));
        let mut winding = starts_in;
        for (crossing, from_behind) in passages {
            let before = winding;
            winding += if from_behind { -1 } else { 1 };
            if (before == 0) != (winding == 0) {
                visit(crossing);
            }
        }
        starts_in != 0
    }
}

mod winding;

#[cfg(test)]
mod tests;
