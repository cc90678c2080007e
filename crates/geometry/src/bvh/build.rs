//! Builds the tree: binned splits by the surface area heuristic (Wald, "On fast construction of SAH-based bounding volume
//! hierarchies", 2007), two by two, gathered into nodes of eight.
//!
//! Items are sorted in place. Large parts are built side by side by several threads; each part is built alike whoever
//! does it, so the tree is the same for any number of threads.

use super::merge::merge;
use super::{Bvh, Child, MAX_DEPTH, MAX_LEAF, Node};
use crate::simd::bins::{Bins, Centers, Cut, best_cut, fill, measure, partition};
use crate::simd::boxes::{Box32, Boxes};
use crate::simd::level::SimdLevel;
use arrayvec::ArrayVec;
use rayon::prelude::*;

/// Something with a box, and its number, which is kept in the bits of the box's first spare number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item(pub(crate) Box32);

/// Keeps the bits clear of subnormal numbers, which are slow on some machines.
const NUMBERS: u32 = 1 << 30;

impl Item {
    pub(crate) fn new(number: u32, bounds: Box32) -> Item {
        let mut bounds = bounds;
        bounds.0[3] = f32::from_bits(NUMBERS + number);
        Item(bounds)
    }

    #[inline(always)]
    pub(crate) fn number(&self) -> u32 {
        self.0.0[3].to_bits() - NUMBERS
    }
}

/// What leaves are like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaves {
    /// Items that are tested at once: a test of fewer takes as long.
    pub(crate) block: usize,
    /// The most blocks in a leaf.
    pub(crate) most: usize,
    /// The least purpose for which it pays to make nodes fuller in the end.
    pub(crate) fuller_for: BuildFor,
}

/// What trees are built for. It changes how long building and tracing take, and never what a ray finds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum BuildFor {
    /// A first look, with few rays: built in the least time.
    Preview,
    /// A picture with some rays a pixel.
    #[default]
    Picture,
    /// Very many rays: built for the fastest search.
    ManyRays,
}

/// How trees are built and searched. It changes how long that takes, and never what a ray finds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plan {
    /// What they are built for.
    pub purpose: BuildFor,
    /// The instruction set that building and searching use.
    pub simd: SimdLevel,
}

/// With the best instruction set of this machine.
impl From<BuildFor> for Plan {
    fn from(purpose: BuildFor) -> Plan {
        Plan { purpose, simd: SimdLevel::best() }
    }
}

/// For a picture.
impl From<SimdLevel> for Plan {
    fn from(simd: SimdLevel) -> Plan {
        Plan { purpose: BuildFor::default(), simd }
    }
}

/// Parts with fewer items are not worth a thread.
const SIDE_BY_SIDE: usize = 16_384;

/// Items that share a box: a range of all.
#[derive(Clone, Copy)]
struct Part {
    start: usize,
    end: usize,
    bounds: Box32,
    centers: Centers,
    /// True if it is better not divided.
    whole: bool,
}

/// Builds a tree over items, which are brought into the order of the leaves.
pub(crate) fn build(items: &mut [Item], leaves: Leaves, plan: Plan) -> Bvh {
    debug_assert!(leaves.most <= MAX_LEAF);
    let mut builder = Builder::new(leaves, plan, items.len());
    if !items.is_empty() {
        let (bounds, centers) = measure(plan.simd.level(), items);
        let all = Part { start: 0, end: items.len(), bounds, centers, whole: false };
        builder.node(items, 0, all, 1);
    }
    let mut bvh = Bvh { nodes: builder.nodes };
    if plan.purpose >= leaves.fuller_for {
        merge(&mut bvh, items);
    }
    bvh
}

/// Builds a tree, or a part of one for which there is a thread.
struct Builder {
    leaves: Leaves,
    plan: Plan,
    nodes: Vec<Node>,
    bins: Box<Bins>,
}

impl Builder {
    /// For about so many items.
    fn new(leaves: Leaves, plan: Plan, items: usize) -> Builder {
        Builder { leaves, plan, nodes: Vec::with_capacity(items / 16), bins: Bins::new() }
    }

    /// Makes the node over a part and everything below it. `items` are all from the item with the index `first`.
    fn node(&mut self, items: &mut [Item], first: usize, part: Part, depth: usize) {
        debug_assert!(depth <= MAX_DEPTH, "traversal has room for so many levels");
        let mut parts = self.split_into_eight(items, first, part, depth);
        parts.sort_unstable_by_key(|part| part.start);
        let index = self.nodes.len();
        self.nodes.push(Node { boxes: Boxes::EMPTY, children: [Child::NONE; 8] });
        let side_by_side = part.end - part.start > SIDE_BY_SIDE;
        let mut subtrees = if side_by_side { self.subtrees(items, first, &parts, depth) } else { ArrayVec::new() };
        for (slot, child) in parts.iter().enumerate() {
            self.nodes[index].boxes.set(slot, &child.bounds);
            self.nodes[index].children[slot] = if self.is_leaf(child) {
                Child::leaf(child.start, child.end - child.start)
            } else {
                let below = Child::node(self.nodes.len());
                match subtrees.get_mut(slot) {
                    Some(subtree) => append(&mut self.nodes, subtree),
                    None => self.node(items, first, *child, depth + 1),
                }
                below
            };
        }
    }

    /// Builds what is below each part, by several threads.
    fn subtrees(&self, items: &mut [Item], first: usize, parts: &[Part], depth: usize) -> ArrayVec<Vec<Node>, 8> {
        let mut rest = items;
        let mut at = first;
        let mut tasks = ArrayVec::<(&mut [Item], Part), 8>::new();
        for part in parts {
            let (_, from_start) = rest.split_at_mut(part.start - at);
            let (own, after) = from_start.split_at_mut(part.end - part.start);
            (rest, at) = (after, part.end);
            tasks.push((own, *part));
        }
        let build = |(own, part): (&mut [Item], Part)| {
            let mut builder = Builder::new(self.leaves, self.plan, own.len());
            if !self.is_leaf(&part) {
                builder.node(own, part.start, part, depth + 1);
            }
            builder.nodes
        };
        let built: Vec<Vec<Node>> = tasks.into_iter().collect::<Vec<_>>().into_par_iter().map(build).collect();
        built.into_iter().collect()
    }

    fn is_leaf(&self, part: &Part) -> bool {
        part.whole || part.end - part.start <= self.leaves.block
    }

    /// Splits the part with the largest area in two until there are eight or nothing is left to split.
    fn split_into_eight(&mut self, items: &mut [Item], first: usize, part: Part, depth: usize) -> ArrayVec<Part, 8> {
        let mut parts = ArrayVec::from_iter([part]);
        while !parts.is_full() {
            let splittable = (0..parts.len()).filter(|&i| !self.is_leaf(&parts[i]));
            let by_area = |&a: &usize, &b: &usize| parts[a].bounds.half_area().total_cmp(&parts[b].bounds.half_area());
            let largest = match must_halve(depth) {
                true => splittable.max_by_key(|&i| parts[i].end - parts[i].start),
                false => splittable.max_by(by_area),
            };
            let Some(largest) = largest else { break };
            let whole = &mut parts[largest];
            let own = &mut items[whole.start - first..whole.end - first];
            match self.split(own, whole, depth) {
                Some([left, right]) => {
                    parts[largest] = left;
                    parts.push(right);
                }
                None => whole.whole = true,
            }
        }
        parts
    }

    /// Orders the items of a part so that those of one side come first; `None` if the part is better left whole.
    fn split(&mut self, items: &mut [Item], part: &Part, depth: usize) -> Option<[Part; 2]> {
        let count = items.len();
        let cut = if must_halve(depth) { None } else { self.best_cut(items, part) };
        let blocks = self.blocks(count);
        let divided = |middle: usize, sides: [(Box32, Centers); 2]| {
            let [(bounds, centers), (right_bounds, right_centers)] = sides;
            let cut = part.start + middle;
            Some([
                Part { start: part.start, end: cut, bounds, centers, whole: false },
                Part { start: cut, end: part.end, bounds: right_bounds, centers: right_centers, whole: false },
            ])
        };
        match cut {
            Some(cut) if blocks <= self.leaves.most && blocks as f32 * part.bounds.half_area() <= cut.cost => None,
            Some(cut) => {
                let (middle, sides) = partition(self.plan.simd.level(), items, &cut);
                divided(middle, sides)
            }
            None if blocks <= self.leaves.most && !must_halve(depth) => None,
            None => {
                let middle = halve(items, &part.centers);
                let (left, right) = items.split_at(middle);
                divided(middle, [measure(self.plan.simd.level(), left), measure(self.plan.simd.level(), right)])
            }
        }
    }

    /// The cut with the least expected cost, if any divides the items.
    fn best_cut(&mut self, items: &[Item], part: &Part) -> Option<Cut> {
        self.bins.prepare(items.len(), &part.centers, self.plan.purpose);
        fill(self.plan.simd.level(), &mut self.bins, items);
        best_cut(self.plan.simd.level(), &self.bins, self.leaves.block, part.bounds.half_area())
    }

    fn blocks(&self, count: usize) -> usize {
        count.div_ceil(self.leaves.block)
    }
}

/// Puts a subtree behind the nodes that are there.
fn append(nodes: &mut Vec<Node>, subtree: &mut Vec<Node>) {
    let base = nodes.len();
    let shifted = |child: Child| if child.is_leaf() { child } else { Child::node(child.index() + base) };
    nodes.extend(subtree.drain(..).map(|node| Node { children: node.children.map(shifted), ..node }));
}

/// Orders items by the longest extent of their centers so that half of them come first.
fn halve(items: &mut [Item], centers: &Centers) -> usize {
    let axis = longest_axis(centers);
    let middle = items.len() / 2;
    let center = |item: &Item| item.0.0[axis] - item.0.0[axis + 4];
    items.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)).then(a.number().cmp(&b.number())));
    middle
}

/// Near the greatest depth the largest parts are cut in halves, where the heuristic might peel off one thing at a time:
/// each level then has an eighth of the things of the one above, and twelve are enough for 2³¹.
fn must_halve(depth: usize) -> bool {
    depth + 12 >= MAX_DEPTH
}

pub(crate) fn longest_axis(centers: &Centers) -> usize {
    let extent = |axis: usize| -centers.0[axis + 4] - centers.0[axis];
    (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0)
}
