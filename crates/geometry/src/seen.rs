//! What eight rays from one point see, and how the points that they see lie to another point, found together.
//!
//! The rays of neighboring pixels mostly see the same walls, through the same cells of a [`Vantage`], and what they see is
//! mostly seen through the same cells from each lamp. So eight rays look up one list, meet flat things by lanes, and what
//! is not flat one by one. What each ray sees is the same, to the bit, as if it were alone.

use crate::packet::{LANES, Packet};
use crate::simd::lanes::{Columns, Lanes, lane_of, set_lane};
use crate::vantage::{ROUND, Vantage, cells_of};
use crate::world::Best;
use crate::{Crossing, Hit, Ray, Surface, World};
use arrayvec::ArrayVec;
use durer_math::DVec3;
use fearless_simd::{Simd, dispatch, f64x8, prelude::*};

/// What eight rays see.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Seen {
    t: [f64; LANES],
    point: Columns,
    normal: Columns,
    offset: [f64; LANES],
    /// The normal on the side that the ray came from.
    face: Columns,
    /// From where rays start on that side.
    start: Columns,
    /// Which of them see something, one bit each.
    hit: u32,
    /// Which of them came from the side that the normal points to.
    outside: u32,
    /// The numbers of what they see, as sums with [`ROUND`].
    numbers: [f64; LANES],
    parts: [u32; LANES],
    /// Each primitive that is seen, and the rays that see it.
    groups: ArrayVec<(u32, u32), LANES>,
}

/// How eight points lie to another one.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Sights {
    direction: Columns,
    squared_distance: [f64; LANES],
    distance: [f64; LANES],
    cosine: [f64; LANES],
    open: u32,
    shut: u32,
    wanted: u32,
}

/// How a point on a surface lies to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// From where rays start on the seen side of the surface to the point; unit length.
    pub direction: DVec3,
    /// The square of the distance.
    pub squared_distance: f64,
    /// The distance.
    pub distance: f64,
    /// Between the normal on the seen side and the direction.
    pub cosine: f64,
    /// What lies between them.
    pub way: Way,
}

/// To where it is asked how points lie.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'a> {
    /// The point.
    pub to: &'a Vantage,
    /// Only what lies nearer than this times the distance counts.
    pub reach: f64,
    /// What shares a bit with this shuts the way.
    pub mask: u32,
    /// Only points within a cone count: its axis, from its tip at the point, and the cosine of its half-angle.
    pub cone: Option<(DVec3, f64)>,
}

/// What lies between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Nothing.
    Open,
    /// Something that shuts it.
    Shut,
    /// Perhaps something.
    Unknown,
}

/// Rays with a smaller cosine to the normal of what they start from might meet it by rounding. It is far above that of any map
/// that is not all but flat.
const TOUCHING: f64 = 1e-6;

/// The number of no primitive.
const NOTHING: u32 = u32::MAX;

/// A list that could not be used up by all lanes at once: a primitive, and the lanes that may meet it.
#[derive(Default)]
struct Curved(ArrayVec<(u32, u32), 96>);

impl Curved {
    #[inline(always)]
    fn add(&mut self, id: u32, lanes: u32) {
        if lanes != 0 {
            self.0.push((id, lanes));
        }
    }
}

impl Default for Seen {
    /// Nothing.
    fn default() -> Seen {
        Seen {
            t: [f64::INFINITY; LANES],
            point: Columns::default(),
            normal: Columns::default(),
            offset: [0.0; LANES],
            face: Columns::default(),
            start: Columns::default(),
            hit: 0,
            outside: 0,
            numbers: [ROUND + f64::from(NOTHING); LANES],
            parts: [0; LANES],
            groups: ArrayVec::new(),
        }
    }
}

impl Default for Sights {
    fn default() -> Sights {
        Sights {
            direction: Columns::default(),
            squared_distance: [0.0; LANES],
            distance: [0.0; LANES],
            cosine: [0.0; LANES],
            open: 0,
            shut: 0,
            wanted: 0,
        }
    }
}

impl Seen {
    /// What a ray hits first.
    #[inline]
    pub fn hit(&self, lane: usize) -> Option<Hit> {
        let lane = lane % LANES;
        let crossing = Crossing { t: self.t[lane], part: self.parts[lane] };
        (self.hit >> lane & 1 == 1).then(|| Hit { crossing, primitive: whole(self.numbers[lane]) as u32 })
    }

    /// Which rays hit something, one bit each.
    pub fn lanes(&self) -> u32 {
        self.hit
    }

    /// Each primitive that is hit, and which rays hit it.
    pub fn groups(&self) -> &[(u32, u32)] {
        &self.groups
    }

    /// The normals on the sides that the rays came from, by components.
    pub fn faces(&self) -> &[[f64; LANES]; 3] {
        &self.face
    }

    /// Which rays hit this primitive.
    #[inline(always)]
    fn lanes_on(&self, primitive: u32) -> u32 {
        self.groups.iter().fold(0, |lanes, group| if group.0 == primitive { group.1 } else { lanes })
    }

    /// How far away that is, for all rays; infinite where there is nothing.
    pub fn distances(&self) -> &[f64; LANES] {
        &self.t
    }

    /// The surface there.
    #[inline]
    pub fn surface(&self, lane: usize) -> Surface {
        let lane = lane % LANES;
        Surface { point: lane_of(&self.point, lane), normal: lane_of(&self.normal, lane), offset: self.offset[lane] }
    }
}

impl Sights {
    /// From which points it was asked what lies between, one bit each: of surfaces on the side of the other point, within the
    /// cone if there is one.
    pub fn wanted(&self) -> u32 {
        self.wanted
    }

    /// Those from which the way is open.
    pub fn open(&self) -> u32 {
        self.open
    }

    /// Those of which it is not known whether it is.
    pub fn unknown(&self) -> u32 {
        self.wanted & !(self.open | self.shut)
    }

    /// The directions for all points, by components.
    pub fn directions(&self) -> &[[f64; LANES]; 3] {
        &self.direction
    }

    /// The cosines for all points.
    pub fn cosines(&self) -> &[f64; LANES] {
        &self.cosine
    }

    /// How one of the points lies.
    #[inline]
    pub fn get(&self, lane: usize) -> Sight {
        let lane = lane % LANES;
        let way = match (self.open >> lane & 1, self.shut >> lane & 1) {
            (1, _) => Way::Open,
            (_, 1) => Way::Shut,
            (_, _) => Way::Unknown,
        };
        Sight {
            direction: lane_of(&self.direction, lane),
            squared_distance: self.squared_distance[lane],
            distance: self.distance[lane],
            cosine: self.cosine[lane],
            way,
        }
    }
}

/// Lanes, sorted by a number that they have in common, of a cell or of a primitive; numbers are sums with [`ROUND`].
struct ByNumber<S: Simd> {
    numbers: f64x8<S>,
    each: [f64; LANES],
    left: u32,
}

impl<S: Simd> ByNumber<S> {
    #[inline(always)]
    fn new(numbers: f64x8<S>, lanes: u32) -> ByNumber<S> {
        ByNumber { numbers, each: numbers.into(), left: lanes }
    }

    /// The next number, and the lanes that have it.
    #[inline(always)]
    fn next(&mut self, simd: S) -> Option<(usize, u32)> {
        if self.left == 0 {
            return None;
        }
        let number = self.each[self.left.trailing_zeros() as usize % LANES];
        let same = self.numbers.simd_eq(f64x8::splat(simd, number)).to_bitmask() as u32 & self.left;
        self.left &= !same;
        Some((whole(number), same))
    }
}

/// A number that was added to [`ROUND`].
#[inline(always)]
fn whole(number: f64) -> usize {
    number.to_bits() as u32 as usize
}

/// Which lanes are in a set.
#[inline(always)]
fn lanes_of(set: u32) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |lane| set >> lane & 1 == 1)
}

/// The rays of a pinhole camera.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    /// Where they start.
    pub eye: DVec3,
    /// To the middle of the picture.
    pub forward: DVec3,
    /// From there to where `across` is 1.
    pub right: DVec3,
    /// ... and to where `up` is 1.
    pub up: DVec3,
}

impl World {
    /// Makes a packet of eight rays in the directions `forward + right · across + up · up`, of which the first `count` are
    /// wanted.
    pub fn rays_of(&self, pinhole: &Pinhole, [across, up]: &[[f64; LANES]; 2], count: usize, packet: &mut Packet) {
        dispatch!(self.simd(), simd => {
            let right = Lanes::splat(simd, pinhole.right) * f64x8::simd_from(simd, *across);
            let up = Lanes::splat(simd, pinhole.up) * f64x8::simd_from(simd, *up);
            let towards = Lanes::splat(simd, pinhole.forward) + (right + up);
            let length = towards.dot(towards).sqrt();
            (towards * (f64x8::splat(simd, 1.0) / length)).store(&mut packet.direction);
            Lanes::splat(simd, pinhole.eye).store(&mut packet.origin);
        });
        packet.set_count(count);
    }

    /// What the rays of a packet see, which all start at a vantage.
    pub fn see(&self, from: &Vantage, packet: &Packet, seen: &mut Seen) {
        dispatch!(self.simd(), simd => self.see_with(simd, from, packet, seen));
    }

    #[inline(always)]
    fn see_with<S: Simd>(&self, simd: S, from: &Vantage, packet: &Packet, seen: &mut Seen) {
        let rays = (Lanes::load(simd, &packet.origin), Lanes::load(simd, &packet.direction));
        let far = f64x8::splat(simd, f64::INFINITY);
        let (mut nearest, mut ids) = (far, f64x8::splat(simd, ROUND + f64::from(NOTHING)));
        let (mut curved, mut lost) = (Curved::default(), 0);
        let mut cells = ByNumber::new(cells_of(simd, rays.1), packet.all());
        while let Some((cell, lanes)) = cells.next(simd) {
            let Some(list) = from.listed(cell) else {
                lost |= lanes;
                continue;
            };
            for id in list.iter().copied().map(u32::from) {
                let primitive = &self.primitives()[id as usize];
                if primitive.mask == 0 {
                    continue;
                }
                if !primitive.is_flat() {
                    curved.add(id, lanes & primitive.lanes_near(simd, rays));
                    continue;
                }
                let number = f64x8::splat(simd, ROUND + f64::from(id));
                let (t, met) = primitive.meet_lanes(simd, rays, far);
                let wins = met & (t.simd_lt(nearest) | (t.simd_eq(nearest) & number.simd_lt(ids)));
                (nearest, ids) = (wins.select(t, nearest), wins.select(number, ids));
            }
        }
        (seen.t, seen.numbers, seen.parts) = (nearest.into(), ids.into(), [0; LANES]);
        seen.hit = nearest.simd_lt(far).to_bitmask() as u32 & packet.all();
        if !curved.0.is_empty() || lost != 0 {
            self.see_curved(packet, &curved, lost, seen);
            ids = seen.numbers.simd_into(simd);
        }
        self.surfaces(simd, rays, (packet, ids), seen);
    }

    /// Goes on with what is not flat, and with lanes for which there is no list.
    #[inline(never)]
    fn see_curved(&self, packet: &Packet, curved: &Curved, lost: u32, seen: &mut Seen) {
        let lanes = curved.0.iter().fold(lost, |all, (_, lanes)| all | lanes);
        for lane in lanes_of(lanes) {
            let ray = packet.ray(lane);
            let mut best = Best::below(f64::INFINITY);
            if let Some(hit) = seen.hit(lane) {
                best.offer(hit.primitive, hit.crossing);
            }
            for &(id, _) in curved.0.iter().filter(|(_, lanes)| lanes >> lane & 1 == 1) {
                if let Some(crossing) = self.primitives()[id as usize].intersect(&ray, best.reach()) {
                    best.offer(id, crossing);
                }
            }
            let hit = match lost >> lane & 1 {
                1 => self.closest_hit(&ray, f64::INFINITY, u32::MAX, None),
                _ => best.hit(),
            };
            seen.hit = seen.hit & !(1 << lane) | u32::from(hit.is_some()) << lane;
            seen.t[lane] = hit.map_or(f64::INFINITY, |hit| hit.crossing.t);
            if let Some(hit) = hit {
                (seen.numbers[lane], seen.parts[lane]) = (ROUND + f64::from(hit.primitive), hit.crossing.part);
            }
        }
    }

    /// Finds the surfaces where the rays hit.
    #[inline(always)]
    fn surfaces<S: Simd>(
        &self,
        simd: S,
        rays: (Lanes<S>, Lanes<S>),
        (packet, ids): (&Packet, f64x8<S>),
        seen: &mut Seen,
    ) {
        let near = rays.0 + rays.1 * f64x8::simd_from(simd, seen.t);
        let mut primitives = ByNumber::new(ids, seen.hit);
        seen.groups.clear();
        while let Some((id, lanes)) = primitives.next(simd) {
            seen.groups.push((id as u32, lanes));
            let primitive = &self.primitives()[id];
            match primitive.flat_normal() {
                Some(normal) if lanes.count_ones() > 1 => {
                    let (mut points, mut offsets) = (Columns::default(), [0.0; LANES]);
                    let (point, offset) = primitive.surface_lanes(simd, near);
                    point.store(&mut points);
                    offsets.copy_from_slice(&*offset);
                    if lanes == seen.hit {
                        (seen.point, seen.offset) = (points, offsets);
                        Lanes::splat(simd, normal).store(&mut seen.normal);
                        continue;
                    }
                    for lane in lanes_of(lanes) {
                        set_lane(&mut seen.point, lane, lane_of(&points, lane));
                        set_lane(&mut seen.normal, lane, normal);
                        seen.offset[lane] = offsets[lane];
                    }
                }
                Some(_) | None => {
                    for lane in lanes_of(lanes) {
                        let Some(Hit { crossing, .. }) = seen.hit(lane) else { continue };
                        let surface = primitive.surface(&packet.ray(lane), &crossing);
                        set_lane(&mut seen.point, lane, surface.point);
                        set_lane(&mut seen.normal, lane, surface.normal);
                        seen.offset[lane] = surface.offset;
                    }
                }
            }
        }
        let (point, normal) = (Lanes::load(simd, &seen.point), Lanes::load(simd, &seen.normal));
        let outside = rays.1.dot(normal).simd_lt(f64x8::splat(simd, 0.0));
        seen.outside = outside.to_bitmask() as u32;
        let inward = -normal;
        let face = Lanes {
            x: outside.select(normal.x, inward.x),
            y: outside.select(normal.y, inward.y),
            z: outside.select(normal.z, inward.z),
        };
        face.store(&mut seen.face);
        (point + face * f64x8::simd_from(simd, seen.offset)).store(&mut seen.start);
    }

    /// How the points that are seen lie to a vantage. What lies between is looked up only where the cosine is positive.
    pub fn sights(&self, seen: &Seen, goal: &Goal<'_>, sights: &mut Sights) {
        dispatch!(self.simd(), simd => self.sights_with(simd, seen, goal, sights));
    }

    #[inline(always)]
    fn sights_with<S: Simd>(&self, simd: S, seen: &Seen, goal: &Goal<'_>, sights: &mut Sights) {
        let Goal { to, reach, mask, cone } = *goal;
        let start = Lanes::load(simd, &seen.start);
        let away = Lanes::splat(simd, to.point()) - start;
        let squared = away.dot(away);
        let distance = squared.sqrt();
        let direction = away * (f64x8::splat(simd, 1.0) / distance);
        let cosine = Lanes::load(simd, &seen.face).dot(direction);
        direction.store(&mut sights.direction);
        (sights.squared_distance, sights.distance, sights.cosine) = (squared.into(), distance.into(), cosine.into());
        let mut wanted = seen.hit & cosine.simd_gt(f64x8::splat(simd, 0.0)).to_bitmask() as u32;
        if let Some((axis, least)) = cone {
            let outside = (-direction.dot(Lanes::splat(simd, axis))).simd_lt(f64x8::splat(simd, least));
            wanted &= !outside.to_bitmask() as u32;
        }
        // What is flat cannot stand in its own way, nor can what is convex, seen from outside: rays start off it on the side of
        // the other point, and lead away. Only those that all but touch it might be told otherwise by rounding.
        let leaving = cosine.simd_gt(f64x8::splat(simd, TOUCHING)).to_bitmask() as u32;
        let (mut shut, mut unknown) = (0, 0);
        if wanted != 0 {
            let t_max = distance * f64x8::splat(simd, reach);
            let mut curved = Curved::default();
            let mut cells = ByNumber::new(cells_of(simd, -away), wanted);
            while let Some((cell, lanes)) = cells.next(simd) {
                let Some(list) = to.listed(cell) else {
                    unknown |= lanes;
                    continue;
                };
                for id in list.iter().copied().map(u32::from) {
                    let primitive = &self.primitives()[id as usize];
                    let off_itself = match primitive.is_flat() {
                        true => leaving,
                        false if primitive.is_convex() => leaving & seen.outside,
                        false => 0,
                    };
                    let lanes = lanes & !(seen.lanes_on(id) & off_itself);
                    if lanes == 0 {
                        continue;
                    }
                    if !primitive.is_flat() {
                        curved.add(id, lanes & primitive.lanes_near(simd, (start, direction)));
                        continue;
                    }
                    let (_, met) = primitive.meet_lanes(simd, (start, direction), t_max);
                    let met = met.to_bitmask() as u32 & lanes;
                    if primitive.mask & mask != 0 { shut |= met } else { unknown |= met }
                }
            }
            if !curved.0.is_empty() {
                let met = self.curved_on_way(&curved, (seen, sights), &t_max.into(), mask);
                (shut, unknown) = (shut | met[0], unknown | met[1]);
            }
        }
        sights.open = wanted & !(shut | unknown);
        (sights.shut, sights.wanted) = (shut, wanted);
    }

    /// Which lanes something that is not flat shuts, and where something else is in the way.
    #[inline(never)]
    fn curved_on_way(
        &self,
        curved: &Curved,
        (seen, sights): (&Seen, &Sights),
        t_max: &[f64; LANES],
        mask: u32,
    ) -> [u32; 2] {
        let [mut shut, mut other] = [0, 0];
        for &(id, lanes) in &curved.0 {
            let primitive = &self.primitives()[id as usize];
            for lane in lanes_of(lanes & !shut) {
                let ray = Ray { origin: lane_of(&seen.start, lane), direction: lane_of(&sights.direction, lane) };
                if primitive.meets(&ray, t_max[lane]) {
                    *(if primitive.mask & mask != 0 { &mut shut } else { &mut other }) |= 1 << lane;
                }
            }
        }
        [shut, other]
    }
}
