//! Builds the tree: binned splits by the surface area heuristic (Wald 2007), two by two, gathered into nodes of eight.

use super::{Bvh, Child, MAX_DEPTH, Node};
use crate::Bounds;
use crate::simd::boxes::Boxes;

const BINS: usize = 16;

/// Things that share a box, as a range of the order array.
#[derive(Clone, Copy)]
struct Part {
    start: usize,
    end: usize,
    bounds: Bounds,
}

/// Builds a tree over things with these boxes; leaves name them by index.
pub(crate) fn build(boxes: &[Bounds]) -> Bvh {
    let mut builder = Builder { boxes, order: (0..boxes.len() as u32).collect(), nodes: Vec::new() };
    if !boxes.is_empty() {
        let all = builder.part(0, boxes.len());
        builder.node(all, 1);
    }
    Bvh { nodes: builder.nodes }
}

struct Builder<'a> {
    boxes: &'a [Bounds],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl Builder<'_> {
    /// Makes the node over a part and everything below it; gives its index.
    fn node(&mut self, part: Part, depth: usize) -> usize {
        debug_assert!(depth <= MAX_DEPTH, "traversal has room for so many levels");
        let index = self.nodes.len();
        self.nodes.push(Node { boxes: Boxes::EMPTY, children: [Child::leaf(0); 8] });
        for (slot, child) in self.split_into_eight(part, depth).into_iter().enumerate() {
            let content = match child.end - child.start {
                1 => Child::leaf(self.order[child.start]),
                _ => Child::node(self.node(child, depth + 1)),
            };
            self.nodes[index].boxes.set(slot, &child.bounds);
            self.nodes[index].children[slot] = content;
        }
        index
    }

    /// Splits the largest part in two until there are eight or nothing is left to split.
    fn split_into_eight(&mut self, part: Part, depth: usize) -> Vec<Part> {
        let mut parts = vec![part];
        while parts.len() < 8 {
            let splittable = (0..parts.len()).filter(|&i| parts[i].end - parts[i].start > 1);
            let by_area = |&a: &usize, &b: &usize| parts[a].bounds.half_area().total_cmp(&parts[b].bounds.half_area());
            let largest = match must_halve(depth) {
                true => splittable.max_by_key(|&i| parts[i].end - parts[i].start),
                false => splittable.max_by(by_area),
            };
            let Some(largest) = largest else { break };
            let whole = parts.swap_remove(largest);
            let middle = self.split(whole, depth);
            parts.push(self.part(whole.start, middle));
            parts.push(self.part(middle, whole.end));
        }
        parts
    }

    /// Orders a part of two or more things so that those of one side come first; gives the place of the cut.
    fn split(&mut self, part: Part, depth: usize) -> usize {
        let centers = Bounds::of_points(self.things(part).iter().map(|&i| self.boxes[i as usize].center()));
        let cut = if must_halve(depth) { None } else { self.best_cut(part, &centers) };
        let Some((axis, bin)) = cut else {
            let axis = longest_axis(&centers);
            let boxes = self.boxes;
            let middle = (part.end - part.start) / 2;
            self.order[part.start..part.end].select_nth_unstable_by(middle, |&a, &b| {
                let (ca, cb) = (boxes[a as usize].center()[axis], boxes[b as usize].center()[axis]);
                ca.total_cmp(&cb).then(a.cmp(&b))
            });
            return part.start + middle;
        };
        let in_left = |i: u32| bin_of(&self.boxes[i as usize], &centers, axis) < bin;
        let (left, right): (Vec<u32>, Vec<u32>) = self.things(part).iter().partition(|&&i| in_left(i));
        self.order[part.start..part.start + left.len()].copy_from_slice(&left);
        self.order[part.start + left.len()..part.end].copy_from_slice(&right);
        part.start + left.len()
    }

    /// The axis and first bin of the right side that make the least expected cost, if any cut divides the part.
    fn best_cut(&self, part: Part, centers: &Bounds) -> Option<(usize, usize)> {
        let mut best = None;
        let mut least = f64::INFINITY;
        for axis in (0..3).filter(|&axis| centers.size()[axis] > 0.0) {
            let mut bins = [(Bounds::EMPTY, 0usize); BINS];
            for &i in self.things(part) {
                let b = &self.boxes[i as usize];
                let bin = &mut bins[bin_of(b, centers, axis)];
                *bin = (bin.0.union(*b), bin.1 + 1);
            }
            for cut in 1..BINS {
                let cost = side_cost(&bins[..cut]) + side_cost(&bins[cut..]);
                if cost < least {
                    (least, best) = (cost, Some((axis, cut)));
                }
            }
        }
        best
    }

    fn part(&self, start: usize, end: usize) -> Part {
        let things = &self.order[start..end];
        let bounds = things.iter().fold(Bounds::EMPTY, |b, &i| b.union(self.boxes[i as usize]));
        Part { start, end, bounds }
    }

    fn things(&self, part: Part) -> &[u32] {
        &self.order[part.start..part.end]
    }
}

/// Near the greatest depth the largest parts are cut in halves, where the heuristic might peel off one thing at a time:
/// each level then has an eighth of the things of the one above, and twelve are enough for 2³¹.
fn must_halve(depth: usize) -> bool {
    depth + 12 >= MAX_DEPTH
}

/// Area times number of things; infinite for an empty side, which would divide nothing.
fn side_cost(bins: &[(Bounds, usize)]) -> f64 {
    let (bounds, count) = bins.iter().fold((Bounds::EMPTY, 0), |(b, n), bin| (b.union(bin.0), n + bin.1));
    if count == 0 { f64::INFINITY } else { bounds.half_area() * count as f64 }
}

fn bin_of(bounds: &Bounds, centers: &Bounds, axis: usize) -> usize {
    let along = (bounds.center()[axis] - centers.min[axis]) / centers.size()[axis];
    ((along * BINS as f64) as usize).min(BINS - 1)
}

fn longest_axis(bounds: &Bounds) -> usize {
    let size = bounds.size();
    (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0)
}
