//! A ray's way through the tree: nearest first for the closest hit, in any order for any hit.

use super::{Bvh, Child, MAX_DEPTH};
use crate::simd::boxes::{BoxPacket, BoxRay, Boxes, FAR_SLACK, round_up};
use crate::simd::memory::prefetch;
use arrayvec::ArrayVec;
use fearless_simd::Simd;
use std::ops::Range;

/// Boxes still to be visited: at most seven wait on each level.
type Stack = ArrayVec<Entry, { 7 * MAX_DEPTH + 8 }>;

/// A box still to be visited, and where the ray enters it.
#[derive(Clone, Copy)]
struct Entry {
    child: Child,
    enter: f32,
}

/// Is told what a search does. The usual one is `()`, which costs nothing.
pub(crate) trait Watch {
    /// A node's boxes are tested.
    fn node(&mut self);
    /// So many things are tested together.
    fn things(&mut self, count: usize);
}

impl Watch for () {
    #[inline(always)]
    fn node(&mut self) {}
    #[inline(always)]
    fn things(&mut self, _count: usize) {}
}

/// How much work a search was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Nodes whose eight boxes were tested.
    pub nodes: u64,
    /// Primitives that were tested.
    pub primitives: u64,
}

impl Watch for Work {
    fn node(&mut self) {
        self.nodes += 1;
    }
    fn things(&mut self, count: usize) {
        self.primitives += count as u64;
    }
}

impl Bvh {
    /// Calls `test(items)` for the leaves that a ray, or some ray of a packet, may meet before `t_max`, roughly from near to
    /// far; `test` gives the new `t_max`, smaller if something was hit. False if it was given up on the way.
    #[inline(always)]
    pub(crate) fn nearest<S: Simd, W: Watch, B: BoxTest<S>, T>(
        &self,
        simd: S,
        rays: &B,
        things: &[T],
        t_max: f64,
        watch: &mut W,
        mut test: impl FnMut(Range<usize>, &mut W) -> f64,
    ) -> bool {
        if self.nodes.is_empty() {
            return true;
        }
        let mut patience = Patience { left: rays.most().map(|most| most.nearest) };
        let mut t_max = round_up(t_max);
        let mut stack = Stack::new();
        let mut at = Child::node(0);
        loop {
            // Down to a leaf, nearest child first.
            while !at.is_leaf() {
                let node = &self.nodes[at.index()];
                watch.node();
                // Which child is next will be known late: its number should be at hand by then.
                prefetch(&node.children, 0);
                let (mut hits, enter) = rays.hits(simd, &node.boxes, t_max);
                if patience.ends(hits) {
                    return false;
                }
                if hits == 0 {
                    at = Child::NONE;
                    break;
                }
                let slot = next(&mut hits);
                let mut nearest = Entry { child: node.children[slot], enter: enter[slot] };
                let bottom = stack.len();
                while hits != 0 {
                    let slot = next(&mut hits);
                    let mut farther = Entry { child: node.children[slot], enter: enter[slot] };
                    self.fetch(farther.child, things);
                    if farther.enter < nearest.enter {
                        std::mem::swap(&mut nearest, &mut farther);
                    }
                    push_by_distance(&mut stack, bottom, farther);
                }
                at = nearest.child;
            }
            if at != Child::NONE {
                t_max = round_up(test(at.items(), watch));
            }
            at = loop {
                let Some(entry) = stack.pop() else { return true };
                // `enter` is rounded like the test of the box, and gets the same allowance.
                if entry.enter <= t_max * FAR_SLACK {
                    break entry.child;
                }
            };
        }
    }

    /// Whether `test(items)` is true for some leaf that a ray, or some ray of a packet, may meet before `t_max`; `None` if
    /// the search was given up.
    #[inline(always)]
    pub(crate) fn any<S: Simd, B: BoxTest<S>, T>(
        &self,
        simd: S,
        rays: &B,
        things: &[T],
        t_max: f64,
        mut test: impl FnMut(Range<usize>) -> bool,
    ) -> Option<bool> {
        if self.nodes.is_empty() {
            return Some(false);
        }
        let mut patience = Patience { left: rays.most().map(|most| most.any) };
        let t_max = round_up(t_max);
        let mut stack = ArrayVec::<Child, { 7 * MAX_DEPTH + 8 }>::new();
        let mut index = 0;
        loop {
            let node = &self.nodes[index];
            let (mut hits, _) = rays.hits(simd, &node.boxes, t_max);
            if patience.ends(hits) {
                return None;
            }
            while hits != 0 {
                let child = node.children[next(&mut hits)];
                self.fetch(child, things);
                stack.push(child);
            }
            index = loop {
                match stack.pop() {
                    None => return Some(false),
                    Some(child) if !child.is_leaf() => break child.index(),
                    // Rays of numbers beyond single precision may seem to meet the boxes of no child.
                    Some(Child::NONE) => {}
                    Some(leaf) if test(leaf.items()) => return Some(true),
                    Some(_) => {}
                }
            };
        }
    }
}

impl Bvh {
    /// Has memory fetch what a child holds, while something else is visited.
    #[inline(always)]
    fn fetch<T>(&self, child: Child, things: &[T]) {
        if child.is_leaf() {
            prefetch(things, child.items().start);
        } else {
            prefetch(&self.nodes, child.index());
        }
    }
}

/// What the traversal asks of a ray, or of a packet of rays.
pub(crate) trait BoxTest<S: Simd>: Copy {
    /// After so many boxes that are met a search is given up; `None` for never.
    fn most(&self) -> Option<Most>;

    /// Which of the boxes may be met between 0 and `t_max`, one bit each, and where each may be entered.
    fn hits(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]);
}

impl<S: Simd> BoxTest<S> for BoxRay {
    #[inline(always)]
    fn most(&self) -> Option<Most> {
        None
    }

    #[inline(always)]
    fn hits(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]) {
        self.hits(simd, boxes, t_max)
    }
}

impl<S: Simd> BoxTest<S> for BoxPacket {
    #[inline(always)]
    fn most(&self) -> Option<Most> {
        Some(self.most)
    }

    #[inline(always)]
    fn hits(&self, simd: S, boxes: &Boxes, t_max: f32) -> (u64, [f32; 8]) {
        self.hits(simd, boxes, t_max)
    }
}

/// How many boxes a packet may meet in a search for the nearest hit, and in one for any.
///
/// Rays that belong together meet some twenty to sixty boxes among a million triangles. Those that do not would meet all
/// that lies between them; and where anything will do and nothing is in order, they gain least.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Most {
    nearest: u32,
    any: u32,
}

impl Most {
    /// Where rays of neighboring pixels mostly hit the same things.
    pub(crate) const USUAL: Most = Most { nearest: 400, any: 40 };
    /// Where each of them may well hit another thing, with a tree of its own.
    pub(crate) const AMONG_VERY_MANY: Most = Most { nearest: 14, any: 10 };
}

/// Counts the boxes that are met in a search, if there is a limit.
struct Patience {
    left: Option<u32>,
}

impl Patience {
    /// True if these children of a node are too many.
    #[inline(always)]
    fn ends(&mut self, hits: u64) -> bool {
        let Some(left) = &mut self.left else { return false };
        let met = hits.count_ones();
        let ends = met > *left;
        *left = left.saturating_sub(met);
        ends
    }
}

/// Takes the lowest bit.
#[inline(always)]
fn next(bits: &mut u64) -> usize {
    let slot = bits.trailing_zeros() as usize;
    *bits &= *bits - 1;
    slot & 7
}

/// Pushes above `bottom` so that what is entered first lies on top.
#[inline(always)]
fn push_by_distance(stack: &mut Stack, bottom: usize, entry: Entry) {
    let mut at = stack.len();
    stack.push(entry);
    while at > bottom && stack[at - 1].enter < entry.enter {
        stack.swap(at - 1, at);
        at -= 1;
    }
}
