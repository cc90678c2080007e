//! Makes nodes fuller, once a tree is built. Eight ways divided again and again, things end up in nodes with two or three
//! leaves, which take as much memory and time as full ones.
//!
//! Two nodes below the same one become one if their children fit, and a node with few children gives them to the one above.
//! No leaf gets deeper, and what is expected to be visited, the sum of all nodes' areas, gets less.

use super::build::Item;
use super::{Bvh, Child, Node};
use crate::simd::boxes::{Box32, Boxes};
use arrayvec::ArrayVec;

/// The children of a node while they move about.
type Children = ArrayVec<(Box32, Child), MOST>;

const MOST: usize = 8;

/// What can be done to the children of a node, and how much area it saves.
#[derive(Clone, Copy)]
struct Step {
    saved: f32,
    what: What,
}

#[derive(Clone, Copy)]
enum What {
    /// The second of two gives its children to the first.
    Join(usize, usize),
    /// One gives its children to the node above.
    Lift(usize),
}

/// Merges the nodes of a tree over items that are still in the order of its leaves.
pub(crate) fn merge(bvh: &mut Bvh, items: &[Item]) {
    if bvh.nodes.is_empty() {
        return;
    }
    let mut all: Vec<Children> = vec![Children::new(); bvh.nodes.len()];
    // Nodes come before what is below them.
    for (index, node) in bvh.nodes.iter().enumerate().rev() {
        let present = node.children.iter().filter(|&&child| child != Child::NONE);
        let mut children: Children = present.map(|&child| (bounds_of(child, &all, items), child)).collect();
        while let Some(step) = best(&children, &all) {
            take(step.what, &mut children, &mut all);
        }
        all[index] = children;
    }
    let mut nodes = Vec::new();
    lay_out(0, &all, &mut nodes);
    bvh.nodes = nodes;
}

fn bounds_of(child: Child, all: &[Children], items: &[Item]) -> Box32 {
    if child.is_leaf() {
        items[child.items()].iter().fold(Box32::EMPTY, |sum, item| sum.union(item.0))
    } else {
        all[child.index()].iter().fold(Box32::EMPTY, |sum, (bounds, _)| sum.union(*bounds))
    }
}

/// The step that saves most, if any can be taken.
fn best(children: &Children, all: &[Children]) -> Option<Step> {
    let mut best: Option<Step> = None;
    let mut offer = |saved: f32, what: What| {
        if saved >= 0.0 && best.is_none_or(|best| saved > best.saved) {
            best = Some(Step { saved, what });
        }
    };
    let nodes = || children.iter().enumerate().filter(|(_, (_, child))| !child.is_leaf());
    for (a, (bounds, child)) in nodes() {
        let (count, area) = (all[child.index()].len(), bounds.half_area());
        if count + children.len() <= MOST + 1 {
            offer(area, What::Lift(a));
        }
        for (b, (other, child)) in nodes().skip_while(|&(b, _)| b <= a) {
            if count + all[child.index()].len() <= MOST {
                offer(area + other.half_area() - bounds.union(*other).half_area(), What::Join(a, b));
            }
        }
    }
    best
}

fn take(what: What, children: &mut Children, all: &mut [Children]) {
    match what {
        What::Join(a, b) => {
            let (bounds, child) = children.remove(b);
            let given = std::mem::take(&mut all[child.index()]);
            let (joined, into) = &mut children[a];
            *joined = joined.union(bounds);
            all[into.index()].extend(given);
        }
        What::Lift(a) => {
            let (_, child) = children.remove(a);
            children.extend(std::mem::take(&mut all[child.index()]));
        }
    }
}

/// Writes the node with this index, and what is below it; gives its new index.
fn lay_out(index: usize, all: &[Children], nodes: &mut Vec<Node>) -> usize {
    let place = nodes.len();
    nodes.push(Node { boxes: Boxes::EMPTY, children: [Child::NONE; 8] });
    for (slot, (bounds, child)) in all[index].iter().enumerate() {
        let child = if child.is_leaf() { *child } else { Child::node(lay_out(child.index(), all, nodes)) };
        nodes[place].boxes.set(slot, bounds);
        nodes[place].children[slot] = child;
    }
    place
}
