//! Which operands a place is in, and what that makes of the nodes above them.

use super::{Leaf, Node, Solid};
use crate::Bounds;
use arrayvec::ArrayVec;
use std::ops::{Deref, DerefMut};

/// A tree of 64 leaves has at most 127 nodes. Of a larger one few are met.
const NODES: usize = 128;

/// A list that needs no heap until it gets long.
pub(super) struct Few<T, const N: usize> {
    few: ArrayVec<T, N>,
    /// All of them, once they are more than N.
    many: Vec<T>,
}

impl<T: Copy, const N: usize> Few<T, N> {
    pub(super) fn new() -> Few<T, N> {
        Few { few: ArrayVec::new(), many: Vec::new() }
    }

    pub(super) fn push(&mut self, item: T) {
        if self.many.is_empty() && self.few.try_push(item).is_ok() {
            return;
        }
        if self.many.is_empty() {
            self.many.extend_from_slice(&self.few);
        }
        self.many.push(item);
    }
}

impl<T, const N: usize> Deref for Few<T, N> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        if self.many.is_empty() { &self.few } else { &self.many }
    }
}

impl<T, const N: usize> DerefMut for Few<T, N> {
    fn deref_mut(&mut self) -> &mut [T] {
        if self.many.is_empty() { &mut self.few } else { &mut self.many }
    }
}

/// The states of those nodes whose boxes a ray or a point is in; the others are false.
pub(super) struct States<'a> {
    solid: &'a Solid,
    /// In the order of the nodes.
    slots: Few<Slot, NODES>,
}

/// A node and its state.
#[derive(Clone, Copy)]
struct Slot {
    node: u32,
    /// The slot of the node above; itself for the root.
    above: u32,
    state: u32,
}

impl<'a> States<'a> {
    pub(super) fn new(solid: &'a Solid) -> States<'a> {
        States { solid, slots: Few::new() }
    }

    /// Finds the nodes whose boxes `meets` says yes to, as those of all nodes above them. Of each leaf among them asks
    /// whether it is true, by `is_in(leaf, slot, met)`.
    pub(super) fn survey<T>(
        &mut self,
        meets: impl Fn(&Bounds) -> Option<T>,
        mut is_in: impl FnMut(&'a Leaf, u32, T) -> bool,
    ) {
        let solid = self.solid;
        let (mut next, mut above) = (0, 0);
        while let Some(node) = solid.nodes.get(next as usize) {
            let Some(met) = meets(&node.bounds) else {
                next = node.end;
                continue;
            };
            while next > 0 && self.node(above).end <= next {
                above = self.slots[above as usize].above;
            }
            let slot = self.slots.len() as u32;
            self.slots.push(Slot { node: next, above, state: node.outside });
            match node.leaf {
                None => above = slot,
                Some(leaf) => {
                    if is_in(&solid.leaves[leaf as usize], slot, met) {
                        self.flip(slot);
                    }
                }
            }
            next += 1;
        }
    }

    fn node(&self, slot: u32) -> &'a Node {
        &self.solid.nodes[self.slots[slot as usize].node as usize]
    }

    fn value(&self, slot: u32) -> bool {
        self.slots[slot as usize].state >= self.node(slot).needed
    }

    /// Turns a leaf on or off; gives whether that turned the root.
    pub(super) fn flip(&mut self, mut slot: u32) -> bool {
        self.slots[slot as usize].state ^= 1;
        while slot != 0 {
            let speaks = self.value(slot) != self.node(slot).subtracted;
            slot = self.slots[slot as usize].above;
            let before = self.value(slot);
            let state = &mut self.slots[slot as usize].state;
            *state = if speaks { *state + 1 } else { *state - 1 };
            if self.value(slot) == before {
                return false;
            }
        }
        true
    }

    /// Whether the root is true.
    pub(super) fn is_inside(&self) -> bool {
        !self.slots.is_empty() && self.value(0)
    }

    /// True if every node from a leaf upwards speaks for the root to be `value`.
    pub(super) fn agree(&self, mut slot: u32, leaf: &Leaf, value: bool) -> bool {
        let mut wanted = value != leaf.flipped;
        while self.value(slot) == wanted {
            if slot == 0 {
                return true;
            }
            wanted = wanted != self.node(slot).subtracted;
            slot = self.slots[slot as usize].above;
        }
        false
    }
}
