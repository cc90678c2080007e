//! A bounding volume hierarchy with eight children a node: what it is, how it is built, how a ray goes through it.

pub(crate) mod build;
pub(crate) mod traverse;

use crate::simd::boxes::Boxes;

/// A tree over numbered things. Nodes are in one array, the root first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    pub(crate) nodes: Vec<Node>,
}

/// Up to eight children: their boxes, and what is in them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) boxes: Boxes,
    pub(crate) children: [Child; 8],
}

/// What is in a box: another node or one thing, told apart by the highest bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

const LEAF: u32 = 1 << 31;

/// The tree is never deeper than this, so that traversal needs a bounded stack.
pub(crate) const MAX_DEPTH: usize = 40;

impl Child {
    pub(crate) fn node(index: usize) -> Child {
        Child(index as u32)
    }

    pub(crate) fn leaf(thing: u32) -> Child {
        Child(thing | LEAF)
    }

    /// The thing in it, if it is one.
    #[inline(always)]
    pub(crate) fn thing(self) -> Option<u32> {
        (self.0 & LEAF != 0).then_some(self.0 & !LEAF)
    }

    /// The index of the node, if it is one.
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
}
