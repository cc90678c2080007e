//! One of many emitters, chosen by how much light it may give to a receiver.
//!
//! A binary tree: each node knows a box around its emitters, a cone around their normals, and their intensity. Who goes down
//! chooses at each node by what both children may give: by intensity, distance, and where both sides face. Conty Estevez and
//! Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; Pharr, Jakob and Humphreys, "Physically
//! Based Rendering", 4th ed., §12.6.3.
//!
//! Nodes stand in the order of a walk that goes left first, so that a subtree of n leaves is 2n - 1 neighbors: subtrees are
//! built beside each other by several threads, and the result does not depend on their number.

mod build;
mod cone;

pub(crate) use cone::{Cone, Faces};

use super::Receiver;
use durer_geometry::Bounds;
use durer_math::DVec3;

/// Something that gives light, as the tree sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    min: [f32; 3],
    max: [f32; 3],
    /// In the direction in which it is brightest: radiance times area.
    intensity: f32,
    cone: Cone,
    /// What it is called.
    id: u32,
}

impl Item {
    /// `None` for what gives no light, or is not in a place that single precision can tell.
    pub(crate) fn new(bounds: &Bounds, intensity: f64, cone: Cone, id: u32) -> Option<Item> {
        let min = bounds.min.to_array().map(|x| (x as f32).next_down());
        let max = bounds.max.to_array().map(|x| (x as f32).next_up());
        let is_somewhere = min.iter().chain(&max).all(|x| x.abs() < 1e18);
        // Orders of magnitude between which ratios can be formed.
        let is_bright = intensity > 1e-30;
        (is_somewhere && is_bright).then(|| Item { min, max, intensity: intensity.min(1e30) as f32, cone, id })
    }
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightTree {
    nodes: Vec<Node>,
    /// The leaf of each emitter, or [`NONE`].
    leaves: Vec<u32>,
}

const NONE: u32 = u32::MAX;

/// Some of the emitters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    min: [f32; 3],
    max: [f32; 3],
    intensity: f32,
    /// The axis of the cone, in parts of [`UNIT`].
    axis: [i16; 3],
    /// The cosine of its half-angle, rounded down.
    cosine: i16,
    /// That of how far light spreads around normals, rounded down.
    spread: i16,
    /// The second child; the first is the next node. Of a leaf, the emitter.
    link: u32,
    parent: u32,
    faces: Faces,
    is_leaf: bool,
}

const UNIT: f64 = 32_767.0;

impl Node {
    pub(crate) fn cone(&self) -> Cone {
        let axis = DVec3::from(self.axis.map(f64::from)).normalize_or_zero();
        let [cosine, spread] = [self.cosine, self.spread].map(|cosine| f64::from(cosine) / UNIT);
        Cone { axis, cosine, spread, faces: self.faces }
    }

    /// The way from a point to its middle, and the square of the radius of a ball around it.
    #[inline]
    pub(crate) fn way_from(&self, point: DVec3) -> (DVec3, f64) {
        let (min, max) = (DVec3::from(self.min.map(f64::from)), DVec3::from(self.max.map(f64::from)));
        ((min + max) * 0.5 - point, 0.25 * (max - min).length_squared())
    }

    pub(crate) fn intensity(&self) -> f64 {
        f64::from(self.intensity)
    }

    /// About the irradiance, over whatever is in the way, that its emitters give to a receiver: never 0 where they give any.
    fn importance(&self, receiver: &Receiver) -> f64 {
        let (way, radius2) = self.way_from(receiver.point);
        let squared = way.length_squared();
        let near = self.intensity() / squared.max(radius2).max(1e-60);
        if squared <= radius2 {
            return near;
        }
        let way = way / squared.sqrt();
        // The angle that a ball around the box fills.
        let blur = (1.0 - radius2 / squared).sqrt();
        let mut facing = way.dot(receiver.normal);
        if receiver.passes {
            facing = facing.abs();
        }
        near * self.cone().brightness(-way, blur) * widened(facing, blur).max(0.0)
    }
}

/// The cosine of an angle less another, or 1 if that is larger.
fn widened(cosine: f64, by: f64) -> f64 {
    if cosine >= by {
        return 1.0;
    }
    let sines = (1.0 - cosine * cosine).max(0.0) * (1.0 - by * by).max(0.0);
    (cosine * by + sines.sqrt()).min(1.0)
}

impl LightTree {
    /// Of these items, whose ids are all below `count`.
    pub(crate) fn build(mut items: Vec<Item>, count: usize) -> LightTree {
        let nodes = build::build(&mut items);
        let mut leaves = vec![NONE; count];
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_leaf) {
            leaves[node.link as usize] = index as u32;
        }
        LightTree { nodes, leaves }
    }

    /// How many emitters it is of.
    pub(crate) fn len(&self) -> usize {
        self.nodes.len().div_ceil(2)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// About the irradiance of all.
    pub(crate) fn importance(&self, receiver: &Receiver) -> f64 {
        self.most(|node| node.importance(receiver))
    }

    /// Chooses an emitter by a number from 0 to 1: gives which, and with what probability. `None` if none gives light to the
    /// receiver.
    pub(crate) fn sample(&self, receiver: &Receiver, choice: f64) -> Option<(u32, f64)> {
        self.choose(|node| node.importance(receiver), choice)
    }

    /// The probability with which [`LightTree::sample`] chooses an emitter.
    pub(crate) fn probability(&self, receiver: &Receiver, id: u32) -> f64 {
        self.chance(|node| node.importance(receiver), id)
    }

    /// What is said of all.
    pub(crate) fn most(&self, importance: impl Fn(&Node) -> f64) -> f64 {
        self.nodes.first().map_or(0.0, importance)
    }

    /// Chooses one by a number from 0 to 1, going down by what is said of nodes: gives which, and with what probability. `None`
    /// if nothing is said for any.
    #[inline]
    pub(crate) fn choose(&self, importance: impl Fn(&Node) -> f64, choice: f64) -> Option<(u32, f64)> {
        let (mut at, mut probability, mut choice) = (0, 1.0, choice);
        let mut node = self.nodes.first()?;
        while !node.is_leaf {
            let second = node.link as usize;
            let first_part = self.first_part(at + 1, second, &importance)?;
            if choice < first_part {
                (at, probability, choice) = (at + 1, probability * first_part, choice / first_part);
            } else {
                let part = 1.0 - first_part;
                (at, probability, choice) = (second, probability * part, (choice - first_part) / part);
            }
            choice = choice.min(1.0_f64.next_down());
            node = &self.nodes[at];
        }
        Some((node.link, probability))
    }

    /// The probability with which [`LightTree::choose`] chooses one.
    #[inline]
    pub(crate) fn chance(&self, importance: impl Fn(&Node) -> f64, id: u32) -> f64 {
        let Some(&leaf) = self.leaves.get(id as usize).filter(|&&leaf| leaf != NONE) else { return 0.0 };
        let mut at = leaf as usize;
        let mut probability = 1.0;
        while at != 0 {
            let parent = self.nodes[at].parent as usize;
            let second = self.nodes[parent].link as usize;
            let Some(first_part) = self.first_part(parent + 1, second, &importance) else { return 0.0 };
            probability *= if at == second { 1.0 - first_part } else { first_part };
            at = parent;
        }
        probability
    }

    /// The chance of the first of two nodes; `None` if neither gives light.
    #[inline]
    fn first_part(&self, first: usize, second: usize, importance: &impl Fn(&Node) -> f64) -> Option<f64> {
        let [first, second] = [first, second].map(|node| importance(&self.nodes[node]));
        let both = first + second;
        (both > 0.0).then(|| first / both)
    }
}

#[cfg(test)]
mod tests;
