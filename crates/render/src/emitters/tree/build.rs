//! Building the tree from the top: halves are chosen so that emitters in one are near each other and face the same way.

use super::{Cone, Faces, Item, NONE, Node, UNIT};
use durer_math::DVec3;

/// Places along an axis at which a set may be divided.
const BINS: usize = 12;
/// Sets deeper than this are halved by count, so that no path is long.
const DEEPEST: u32 = 64;
/// Sets of fewer are not worth another thread.
const FEW: usize = 4096;

/// The nodes over some items, in the order of a walk; the items are put in the order of the leaves.
pub(super) fn build(items: &mut [Item]) -> Vec<Node> {
    let nowhere = Node {
        min: [0.0; 3],
        max: [0.0; 3],
        intensity: 0.0,
        axis: [0; 3],
        cosine: 0,
        spread: 0,
        link: NONE,
        parent: NONE,
        faces: Faces::Front,
        is_leaf: true,
    };
    let mut nodes = vec![nowhere; (2 * items.len()).saturating_sub(1)];
    if !items.is_empty() {
        fill(&mut nodes, items, Place { index: 0, parent: NONE, depth: 0 });
    }
    nodes
}

/// Where a subtree is.
#[derive(Clone, Copy)]
struct Place {
    index: u32,
    parent: u32,
    depth: u32,
}

/// Fills the nodes of a subtree; gives its cone.
fn fill(nodes: &mut [Node], items: &mut [Item], place: Place) -> Cone {
    let parent = place.parent;
    if let [Item { min, max, intensity, cone, id }] = *items {
        let (axis, [cosine, spread]) = narrowed(&cone);
        let faces = cone.faces;
        nodes[0] = Node { min, max, intensity, axis, cosine, spread, link: id, parent, faces, is_leaf: true };
        return cone;
    }
    let middle = divide(items, place.depth);
    let (first_items, second_items) = items.split_at_mut(middle);
    let (node, below) = nodes.split_at_mut(1);
    let (first_nodes, second_nodes) = below.split_at_mut(2 * middle - 1);
    let first = Place { index: place.index + 1, parent: place.index, depth: place.depth + 1 };
    let second = Place { index: place.index + 2 * middle as u32, ..first };
    let in_turn = first_items.len() + second_items.len() < FEW;
    let [first_cone, second_cone] = if in_turn {
        [fill(first_nodes, first_items, first), fill(second_nodes, second_items, second)]
    } else {
        let (a, b) = rayon::join(|| fill(first_nodes, first_items, first), || fill(second_nodes, second_items, second));
        [a, b]
    };
    let (a, b) = (&first_nodes[0], &second_nodes[0]);
    let cone = first_cone.union(second_cone);
    let (axis, [cosine, spread]) = narrowed(&cone);
    node[0] = Node {
        min: std::array::from_fn(|k| a.min[k].min(b.min[k])),
        max: std::array::from_fn(|k| a.max[k].max(b.max[k])),
        intensity: a.intensity + b.intensity,
        axis,
        cosine,
        spread,
        link: second.index,
        parent,
        faces: cone.faces,
        is_leaf: false,
    };
    cone
}

/// The cone in short, its axis and both cosines: no narrower than it is.
fn narrowed(cone: &Cone) -> ([i16; 3], [i16; 2]) {
    /// More than what rounding turns an axis by can take from a cosine.
    const SLACK: f64 = 1.5e-4;
    let axis = (cone.axis * UNIT).to_array().map(|x| x.round() as i16);
    let down = |cosine: f64| ((cosine - SLACK) * UNIT).floor();
    // No surface shines behind itself.
    let spread = down(cone.spread).max(0.0) as i16;
    if cone.cosine <= -1.0 {
        return (axis, [-(UNIT as i16), spread]);
    }
    (axis, [down(cone.cosine).max(-UNIT) as i16, spread])
}

/// Some items, summed up.
#[derive(Clone, Copy)]
struct Sum {
    count: usize,
    min: [f32; 3],
    max: [f32; 3],
    intensity: f64,
    /// Normals, weighed by intensity.
    facing: DVec3,
}

impl Sum {
    const NONE: Sum =
        Sum { count: 0, min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3], intensity: 0.0, facing: DVec3::ZERO };

    fn add(&mut self, other: &Sum) {
        self.count += other.count;
        self.min = std::array::from_fn(|k| self.min[k].min(other.min[k]));
        self.max = std::array::from_fn(|k| self.max[k].max(other.max[k]));
        self.intensity += other.intensity;
        self.facing += other.facing;
    }

    fn of(item: &Item) -> Sum {
        let Item { min, max, cone, .. } = *item;
        let intensity = f64::from(item.intensity);
        // What shines on both sides has no front: any rule that gives parallel ones the same will do.
        let largest = cone.axis.to_array().into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let turns = cone.faces == Faces::Both && largest < 0.0;
        let facing = if turns { -cone.axis } else { cone.axis };
        Sum { count: 1, min, max, intensity, facing: facing * intensity }
    }

    /// What it costs that these are one set: the more light there is from the more places in the more directions, the more.
    /// For the directions, a parabola near the measure of Conty Estevez and Kulla, where how long the sum of all normals is
    /// takes the part of their cone.
    fn cost(&self) -> f64 {
        if self.count == 0 {
            return 0.0;
        }
        let size: f64 = (0..3).map(|k| f64::from(self.max[k]) - f64::from(self.min[k])).map(|x| x * x).sum();
        let spread = 2.0 * (self.facing.length() / self.intensity).min(1.0) - 1.0;
        let directions = 11.2 - (4.7 + 3.4 * spread) * spread;
        self.intensity * size * directions
    }
}

fn middle(item: &Item, axis: usize) -> f64 {
    0.5 * (f64::from(item.min[axis]) + f64::from(item.max[axis]))
}

/// Puts the items in two sets, one before the other; gives how many are in the first: neither none nor all.
fn divide(items: &mut [Item], depth: u32) -> usize {
    let half = items.len() / 2;
    if items.len() == 2 {
        return 1;
    }
    let mut extents = [(f64::INFINITY, f64::NEG_INFINITY); 3];
    for item in items.iter() {
        for (axis, (low, high)) in extents.iter_mut().enumerate() {
            let at = middle(item, axis);
            (*low, *high) = (low.min(at), high.max(at));
        }
    }
    let longest = extents.iter().fold(0.0, |most: f64, (low, high)| most.max(high - low));
    if longest == 0.0 {
        return half;
    }
    let mut best = None;
    for (axis, &(low, high)) in extents.iter().enumerate().filter(|(_, (low, high))| high > low) {
        let mut bins = [Sum::NONE; BINS];
        for item in items.iter() {
            bins[bin(middle(item, axis), low, high)].add(&Sum::of(item));
        }
        // Long sets are divided across.
        let lean = longest / (high - low);
        let mut after = [Sum::NONE; BINS];
        let mut sum = Sum::NONE;
        for at in (0..BINS).rev() {
            sum.add(&bins[at]);
            after[at] = sum;
        }
        let mut before = Sum::NONE;
        for at in 1..BINS {
            before.add(&bins[at - 1]);
            let cost = lean * (before.cost() + after[at].cost());
            let is_better = best.is_none_or(|(least, _, _)| cost < least);
            if before.count > 0 && after[at].count > 0 && is_better {
                best = Some((cost, axis, at));
            }
        }
    }
    match best {
        Some((_, axis, at)) if depth < DEEPEST => {
            let (low, high) = extents[axis];
            partition(items, |item| bin(middle(item, axis), low, high) < at)
        }
        _ => {
            let axis = (0..3).find(|&axis| extents[axis].1 - extents[axis].0 == longest).unwrap_or(0);
            items
                .select_nth_unstable_by(half, |a, b| middle(a, axis).total_cmp(&middle(b, axis)).then(a.id.cmp(&b.id)));
            half
        }
    }
}

fn bin(at: f64, low: f64, high: f64) -> usize {
    (((at - low) / (high - low) * BINS as f64) as usize).min(BINS - 1)
}

/// Puts those first that are wanted there; gives their number.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut first = 0;
    for at in 0..items.len() {
        if is_first(&items[at]) {
            items.swap(at, first);
            first += 1;
        }
    }
    first
}
