//! A ray's way through a solid: all crossings of its leaves in order, and what of them is a crossing of the solid.
//!
//! Two faces that should coincide are met at parameters that differ in their last bits, in either order. Between them
//! the ray sees a slice of solid, or of nothing, that is thinner than what the two leaves' arithmetic can tell, and that
//! no ray could start in: a crossing's surface has an offset, and the slice is not as thick as the two offsets. Such
//! slices are left out, two crossings at a time, so that inside and outside still alternate. What the thickness of a
//! slice is, is measured across the faces, not along the ray; a shallow ray is no excuse.
//!
//! A ray that lies in a face, in all its length, meets no crossing there at all, and whether it is inside is a matter of
//! the last bits: it could pass between two boxes that stand face to face. It is moved aside by a little less than what
//! rays start off surfaces by.

use super::states::{Few, States};
use super::{Leaf, Solid};
use crate::{Bounds, Crossing, Ray};
use durer_math::DVec3;

/// Crossings that need no heap.
const EVENTS: usize = 256;

/// A ray that starts nearer to a face than this many times what its leaf may misplace it by is taken to start in it.
pub(super) const DOUBT: f64 = 2.0;

/// A slice within this many times that of a face is thin. Rays start off surfaces by as much: four times the doubt.
const THIN: f64 = 4.0 * DOUBT;

/// Slices longer than this, relative to the largest coordinate, are not looked at: it would take a ray shallower than any
/// to make them thin.
const LONGEST_SLICE: f64 = 1e-4;

/// A crossing of a leaf.
#[derive(Clone, Copy)]
struct Event<'a> {
    t: f64,
    leaf: &'a Leaf,
    slot: u32,
    /// The leaf's own part.
    part: u32,
}

/// A leaf's face where a ray crosses it.
struct Face {
    /// Out of the solid.
    normal: DVec3,
    /// How far from where it seems to be it may be.
    noise: f64,
}

/// A ray on its way.
pub(super) struct Walk<'a> {
    solid: &'a Solid,
    ray: Ray,
    unit: DVec3,
    speed: f64,
    /// All crossings of leaves ahead of the origin, in the order of t.
    events: Few<Event<'a>, EVENTS>,
    /// How many of them have been passed.
    passed: usize,
    /// The nodes' states there.
    states: States<'a>,
    /// A change of the root that was passed but not answered yet.
    waiting: Option<usize>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(solid: &'a Solid, ray: Ray) -> Walk<'a> {
        let speed = ray.direction.length();
        let unit = ray.direction / speed;
        Walk { solid, ray, unit, speed, events: Few::new(), passed: 0, states: States::new(solid), waiting: None }
    }

    /// Finds all crossings of leaves; gives whether the ray starts inside the solid.
    pub(super) fn start(&mut self) -> bool {
        if let Some(aside) = self.survey() {
            self.ray.origin += aside;
            self.events = Few::new();
            self.states = States::new(self.solid);
            self.survey();
        }
        // Of two at the same place the leaf that was given first comes first, and of its parts the first, whatever way of
        // sorting this is: that may depend on the machine.
        let part = |event: &Event<'_>| event.leaf.first_part + event.part;
        self.events.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(part(a).cmp(&part(b))));
        let inside = self.states.is_inside();
        match self.pass_change() {
            Some(first) if self.starts_at(first) => inside != self.pass_thin(first),
            first => {
                self.waiting = first;
                inside
            }
        }
    }

    /// The next crossing of the solid.
    pub(super) fn next(&mut self) -> Option<Crossing> {
        loop {
            let first = self.waiting.take().or_else(|| self.pass_change())?;
            if self.pass_thin(first) {
                let foremost = self.foremost(first);
                let Event { t, leaf, part, .. } = self.events[foremost];
                return Some(Crossing { t, part: leaf.first_part + part });
            }
        }
    }

    /// Passes the changes that thin slices part from this one; gives whether they are an odd number with it.
    fn pass_thin(&mut self, first: usize) -> bool {
        let (mut last, mut odd) = (first, true);
        while let Some(next) = self.pass_change() {
            if !self.is_thin(last, next) {
                self.waiting = Some(next);
                break;
            }
            (last, odd) = (next, !odd);
        }
        odd
    }

    /// Lists the crossings of all leaves that the ray may meet, and sets their states at its origin. If the ray lies in a
    /// face, gives the way aside.
    fn survey(&mut self) -> Option<DVec3> {
        let Walk { solid, ray, events, states, .. } = self;
        let slabs = Slabs::new(ray);
        let reach = largest(ray.origin).max(finite_reach(&solid.bounds));
        let (mut face, mut width) = (None, 0.0_f64);
        let starts_in = |leaf: &'a Leaf, slot, range| {
            if let Some(normal) = leaf.shape.face_along(ray, range, &leaf.noise, reach) {
                width = width.max(leaf.noise.along(&leaf.shape, normal, reach));
                face.get_or_insert(if leaf.flipped { -normal } else { normal });
            }
            leaf.shape.crossings(ray, &mut |Crossing { t, part }| events.push(Event { t, leaf, slot, part }))
        };
        states.survey(|bounds| slabs.range(bounds), starts_in);
        // Not straight away from the face: the ray may run along an edge, in a second one.
        face.map(|normal| (normal * 0.94 + normal.cross(self.unit) * 0.34) * (2.0 * width))
    }

    /// Passes events up to one that turns the root.
    fn pass_change(&mut self) -> Option<usize> {
        while self.passed < self.events.len() {
            self.passed += 1;
            if self.flip(self.passed - 1) {
                return Some(self.passed - 1);
            }
        }
        None
    }

    /// Turns the leaf of an event on or off; gives whether that turned the root.
    fn flip(&mut self, event: usize) -> bool {
        self.states.flip(self.events[event].slot)
    }

    fn face(&self, event: usize) -> Face {
        let Event { t, leaf, part, .. } = self.events[event];
        let point = self.ray.at(t);
        let surface = leaf.shape.surface_near(point, part);
        let reach = largest(self.ray.origin).max(largest(point));
        let noise = leaf.noise.along(&leaf.shape, surface.normal, reach).max(0.25 * surface.offset);
        Face { normal: if leaf.flipped { -surface.normal } else { surface.normal }, noise }
    }

    /// True if the ray between two parameters, of which the first is the lesser, is nowhere farther from the face met at an
    /// event than so many times its noise. A face may be curved, so the middle is looked at too.
    fn lies_in_face(&self, event: usize, (from, to): (f64, f64), noises: f64) -> bool {
        let [middle, end] = [0.5 * (from + to), to].map(|t| self.ray.at(t));
        let reach = largest(self.ray.origin).max(largest(end));
        if (to - from) * self.speed > LONGEST_SLICE * reach {
            return false;
        }
        let face = self.face(event);
        let Event { leaf, part, .. } = self.events[event];
        let off = |point: DVec3| leaf.shape.surface_near(point, part).point.distance(point);
        [self.ray.at(from), middle, end].into_iter().all(|point| off(point) <= noises * face.noise)
    }

    /// True if what lies between two events, the first of which comes first, is too thin to be there.
    fn is_thin(&self, first: usize, second: usize) -> bool {
        let between = (self.events[first].t, self.events[second].t);
        [first, second].into_iter().any(|event| self.lies_in_face(event, between, THIN))
    }

    /// True if the ray starts in a face: nearer to it than any ray does that left it. Then it is taken to start on the side
    /// that it goes to.
    fn starts_at(&self, event: usize) -> bool {
        self.lies_in_face(event, (0.0, self.events[event].t), DOUBT)
    }

    /// Where several leaves make the same face of the solid, the event of that which was given first: so its material and
    /// texture are seen, and not now the one's and now the other's.
    fn foremost(&mut self, event: usize) -> usize {
        let (mut low, mut high) = (event, event + 1);
        while low > 0 && self.is_thin(low - 1, event) {
            low -= 1;
        }
        while high < self.events.len() && self.is_thin(event, high) {
            high += 1;
        }
        if high - low == 1 {
            return event;
        }
        let back = self.passed;
        let normal = self.face(event).normal;
        let mut best = event;
        for other in low..high {
            let earlier = self.events[other].leaf.first_part < self.events[best].leaf.first_part;
            if earlier && self.face(other).normal.dot(normal) > 0.999_999 && self.turns_with_root(other, low, high) {
                best = other;
            }
        }
        self.seek(back);
        best
    }

    /// True if the events from `low` to `high` turn the root, and with it every node from the leaf of this event upwards.
    fn turns_with_root(&mut self, event: usize, low: usize, high: usize) -> bool {
        let Event { leaf, slot, .. } = self.events[event];
        self.seek(low);
        let before = self.states.is_inside();
        let turns = self.states.agree(slot, leaf, before);
        self.seek(high);
        turns && self.states.is_inside() != before && self.states.agree(slot, leaf, !before)
    }

    /// Goes on or back until so many events have been passed.
    fn seek(&mut self, passed: usize) {
        while self.passed < passed {
            self.flip(self.passed);
            self.passed += 1;
        }
        while self.passed > passed {
            self.passed -= 1;
            self.flip(self.passed);
        }
    }
}

/// A ray, prepared for boxes.
struct Slabs {
    origin: DVec3,
    inverse: DVec3,
}

impl Slabs {
    fn new(ray: &Ray) -> Slabs {
        // Finite stand-ins for 1/0 keep 0 · ∞ out.
        let inverse = (1.0 / ray.direction).clamp(DVec3::MIN, DVec3::MAX);
        Slabs { origin: ray.origin, inverse }
    }

    /// Where the ray is in a box, from 0 on; `None` if nowhere. Boxes have margins, so rounding needs none here, but for
    /// origins far from an unbounded solid.
    #[inline]
    fn range(&self, bounds: &Bounds) -> Option<(f64, f64)> {
        let to_min = (bounds.min - self.origin) * self.inverse;
        let to_max = (bounds.max - self.origin) * self.inverse;
        let enter = to_min.min(to_max).max_element().max(0.0);
        let leave = to_min.max(to_max).min_element() * (1.0 + 8.0 * f64::EPSILON);
        (enter <= leave).then_some((enter, leave.min(f64::MAX)))
    }
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

/// The largest coordinate of a box that is not infinite.
pub(super) fn finite_reach(bounds: &Bounds) -> f64 {
    let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
    largest(bounds.min.map(finite)).max(largest(bounds.max.map(finite)))
}
