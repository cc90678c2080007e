//! A bounding volume hierarchy with eight children a node: what it is, how it is built, how a ray goes through it.
//!
//! The tree knows nothing of what it holds: leaves are ranges of items in an order that the builder chose.

pub(crate) mod build;
pub(crate) mod merge;
pub(crate) mod traverse;

use crate::simd::boxes::Boxes;

/// A tree over numbered things. Nodes are in one array, the root first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Bvh {
    pub(crate) nodes: Vec<Node>,
}

/// Up to eight children: their boxes, and what is in them. Four lines of the cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    pub(crate) boxes: Boxes,
    pub(crate) children: [Child; 8],
}

/// What is in a box: another node, or a leaf with a range of items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

const LEAF: u32 = 1 << 31;
const COUNT_SHIFT: u32 = 28;
const INDEX: u32 = (1 << COUNT_SHIFT) - 1;

/// The tree is never deeper than this, so that traversal needs a bounded stack.
pub(crate) const MAX_DEPTH: usize = 40;
/// A leaf has at most this many items.
pub(crate) const MAX_LEAF: usize = 8;
/// A tree has at most this many nodes, and as many items.
pub(crate) const MAX_ITEMS: usize = 1 << COUNT_SHIFT;

impl Child {
    /// What slots without a child have: never visited, for nothing hits their boxes.
    pub(crate) const NONE: Child = Child(u32::MAX);

    pub(crate) fn node(index: usize) -> Child {
        debug_assert!(index < MAX_ITEMS);
        Child(index as u32)
    }

    pub(crate) fn leaf(first: usize, count: usize) -> Child {
        debug_assert!(first + count <= MAX_ITEMS && (1..=MAX_LEAF).contains(&count));
        Child(LEAF | ((count as u32 - 1) << COUNT_SHIFT) | first as u32)
    }

    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }

    /// The items of a leaf.
    #[inline(always)]
    pub(crate) fn items(self) -> std::ops::Range<usize> {
        let first = (self.0 & INDEX) as usize;
        first..first + ((self.0 >> COUNT_SHIFT) & 7) as usize + 1
    }

    /// The index of a node.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

impl Bvh {
    /// Bytes held.
    pub(crate) fn memory(&self) -> usize {
        size_of_val(self.nodes.as_slice())
    }

    /// All leaves, to be given new ranges: where several items are packed into one.
    pub(crate) fn leaves_mut(&mut self) -> impl Iterator<Item = &mut Child> {
        self.nodes
            .iter_mut()
            .flat_map(|node| node.children.iter_mut())
            .filter(|child| **child != Child::NONE && child.is_leaf())
    }
}
