//! A ray's way through the tree: nearest first for the closest hit, in any order for any hit.

use super::{Bvh, MAX_DEPTH};
use crate::Ray;
use crate::simd::boxes::{BoxRay, FAR_SLACK, round_up};
use arrayvec::ArrayVec;
use fearless_simd::Simd;

/// Boxes still to be visited: at most seven wait on each level.
type Stack = ArrayVec<(u32, f32), { 7 * MAX_DEPTH + 8 }>;

impl Bvh {
    /// Calls `test(thing)` for the things whose boxes the ray may meet before `t_max`, roughly from near to far; `test`
    /// gives the new `t_max`, smaller if the thing was hit.
    #[inline(always)]
    pub(crate) fn nearest<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, mut test: impl FnMut(u32) -> f64) {
        if self.nodes.is_empty() {
            return;
        }
        let box_ray = BoxRay::new(ray);
        let mut t_max = round_up(t_max);
        let mut stack = Stack::new();
        let mut index = 0;
        loop {
            let node = &self.nodes[index];
            let (mut hits, enter) = box_ray.hits(simd, &node.boxes, t_max);
            let waiting = stack.len();
            while hits != 0 {
                let slot = hits.trailing_zeros() as usize;
                hits &= hits - 1;
                push_by_distance(&mut stack, waiting, (node.children[slot & 7].0, enter[slot & 7]));
            }
            index = loop {
                let Some((child, enter)) = stack.pop() else { return };
                // `enter` is rounded like the test of the box, and gets the same allowance.
                if enter > t_max * FAR_SLACK {
                    continue;
                }
                match super::Child(child).thing() {
                    None => break super::Child(child).index(),
                    Some(thing) => t_max = round_up(test(thing)),
                }
            };
        }
    }

    /// True if `test(thing)` is, for some thing whose box the ray may meet before `t_max`.
    #[inline(always)]
    pub(crate) fn any<S: Simd>(&self, simd: S, ray: &Ray, t_max: f64, mut test: impl FnMut(u32) -> bool) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let box_ray = BoxRay::new(ray);
        let t_max = round_up(t_max);
        let mut stack = Stack::new();
        let mut index = 0;
        loop {
            let node = &self.nodes[index];
            let (mut hits, _) = box_ray.hits(simd, &node.boxes, t_max);
            while hits != 0 {
                let child = node.children[hits.trailing_zeros() as usize & 7];
                hits &= hits - 1;
                match child.thing() {
                    Some(thing) if test(thing) => return true,
                    Some(_) => {}
                    None => stack.push((child.0, 0.0)),
                }
            }
            match stack.pop() {
                Some((child, _)) => index = super::Child(child).index(),
                None => return false,
            }
        }
    }
}

/// Pushes above `bottom` so that what is entered first lies on top.
#[inline(always)]
fn push_by_distance(stack: &mut Stack, bottom: usize, entry: (u32, f32)) {
    let mut at = stack.len();
    stack.push(entry);
    while at > bottom && stack[at - 1].1 < entry.1 {
        stack.swap(at - 1, at);
        at -= 1;
    }
}
