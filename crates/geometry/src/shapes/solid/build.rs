//! From operands to the flat tree: boxes, cut to where a node matters, and long unions divided by place.

use super::walk::finite_reach;
use super::{Leaf, Node, Solid};
use crate::primitive::operand::Noise;
use crate::{Bounds, Primitive};
use durer_math::DVec3;

/// How the operands of a solid are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in any of the operands.
    Union,
    /// What is in all of the operands.
    Intersection,
    /// What is in the first operand but in none of the others.
    Difference,
}

/// What a solid is made of. Without operands nothing is inside.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "built once, mostly of shapes; a box for each would only cost words")]
pub enum Operand {
    /// A closed shape; others count as empty.
    Shape(Primitive),
    /// Operands combined.
    Combined(Operation, Vec<Operand>),
}

/// A union of more than this is divided.
pub(super) const MOST_TOGETHER: usize = 8;

/// How much larger than what they bound boxes are made: far more than rounding, and next to nothing.
const MARGIN: f64 = 1e-9;

const EVERYWHERE: Bounds = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

/// An expression with the box of what is inside.
struct Tree {
    bounds: Bounds,
    form: Form,
}

enum Form {
    Leaf(u32),
    Any(Vec<Tree>),
    /// All of the first and none of the second.
    All(Vec<Tree>, Vec<Tree>),
}

impl Operand {
    fn each_shape(&mut self, visit: &mut impl FnMut(&mut Primitive)) {
        match self {
            Operand::Shape(primitive) => visit(primitive),
            Operand::Combined(_, operands) => operands.iter_mut().for_each(|operand| operand.each_shape(visit)),
        }
    }
}

impl Solid {
    /// Gives also what place among the operands is the origin of the solid's space.
    pub(crate) fn build(mut operand: Operand) -> (Solid, DVec3) {
        let mut shapes = Vec::new();
        operand.each_shape(&mut |shape| shapes.push(shape.clone()));
        let middle = middle(&expression(&operand, &shapes, &mut 0).bounds, &shapes);
        let (shapes, noises): (Vec<Primitive>, Vec<Noise>) =
            shapes.into_iter().map(|shape| shape.moved(-middle)).unzip();
        let tree = expression(&operand, &shapes, &mut 0);
        let mut first_part = 0;
        let leaf = |(shape, noise): (Primitive, Noise)| {
            let leaf = Leaf { first_part, flipped: false, noise, shape };
            first_part += leaf.shape.part_count();
            leaf
        };
        let leaves = shapes.into_iter().zip(noises).map(leaf).collect();
        let bounds = if tree.bounds.is_empty() { Bounds::of_points([DVec3::ZERO]) } else { tree.bounds };
        let mut solid = Solid { leaves, nodes: Vec::new(), bounds };
        solid.plant(&tree, &Place { clip: EVERYWHERE, subtracted: false, flipped: false });
        (solid, middle)
    }

    /// Appends a tree to the nodes, cut to where it matters; gives false, and appends nothing, if it is empty there.
    fn plant(&mut self, tree: &Tree, place: &Place) -> bool {
        let bounds = tree.bounds.intersection(place.clip);
        if bounds.is_empty() {
            return false;
        }
        let index = self.nodes.len();
        let bounds = bounds.widened(MARGIN * finite_reach(&bounds));
        let Place { subtracted, flipped, .. } = *place;
        self.nodes.push(Node { bounds, end: 0, needed: 1, outside: 0, subtracted, leaf: None });
        let below = |subtracted| Place { clip: bounds, subtracted, flipped: flipped != subtracted };
        let planted = match &tree.form {
            Form::Leaf(leaf) => {
                self.nodes[index].leaf = Some(*leaf);
                self.leaves[*leaf as usize].flipped = flipped;
                true
            }
            Form::Any(trees) => trees.iter().filter(|tree| self.plant(tree, &below(false))).count() > 0,
            Form::All(wanted, unwanted) => {
                let all = wanted.iter().all(|tree| self.plant(tree, &below(false)));
                let without = unwanted.iter().filter(|tree| all && self.plant(tree, &below(true))).count();
                self.nodes[index].needed = (wanted.len() + without) as u32;
                self.nodes[index].outside = without as u32;
                all
            }
        };
        if planted {
            self.nodes[index].end = self.nodes.len() as u32;
        } else {
            self.nodes.truncate(index);
        }
        planted
    }
}

/// Where a tree is planted.
struct Place {
    /// Outside of this it does not matter.
    clip: Bounds,
    subtracted: bool,
    /// Subtracted an odd number of times on the way from the root.
    flipped: bool,
}

/// The middle of the smallest shape of those that reach into `bounds`: where coordinates have to be finest.
fn middle(bounds: &Bounds, shapes: &[Primitive]) -> DVec3 {
    let boxes = shapes.iter().map(Primitive::bounds);
    let matters = |shape: &Bounds| shape.size().is_finite() && !shape.intersection(*bounds).is_empty();
    let by_size = |a: &Bounds, b: &Bounds| a.size().length().total_cmp(&b.size().length());
    boxes.filter(matters).min_by(by_size).map_or(DVec3::ZERO, |smallest| smallest.center())
}

/// The expression of an operand whose shapes begin at `next`.
fn expression(operand: &Operand, shapes: &[Primitive], next: &mut usize) -> Tree {
    let (operation, operands) = match operand {
        Operand::Shape(_) => {
            let leaf = *next;
            *next += 1;
            return Tree { bounds: shapes[leaf].bounds_of_inside(), form: Form::Leaf(leaf as u32) };
        }
        Operand::Combined(operation, operands) => (operation, operands),
    };
    let mut trees: Vec<Tree> = operands.iter().map(|operand| expression(operand, shapes, next)).collect();
    match operation {
        _ if trees.is_empty() => any(trees),
        _ if trees.len() == 1 => trees.remove(0),
        Operation::Union => any(trees),
        Operation::Intersection => {
            let bounds = trees.iter().fold(EVERYWHERE, |all, tree| all.intersection(tree.bounds));
            Tree { bounds, form: Form::All(trees, Vec::new()) }
        }
        Operation::Difference => {
            let unwanted = divided(trees.split_off(1));
            Tree { bounds: trees[0].bounds, form: Form::All(trees, unwanted) }
        }
    }
}

fn any(trees: Vec<Tree>) -> Tree {
    let bounds = trees.iter().fold(Bounds::EMPTY, |all, tree| all.union(tree.bounds));
    Tree { bounds, form: Form::Any(divided(trees)) }
}

/// Trees of which any may hold, as few enough: halves of them by place, and halves of these. Unbounded ones stay apart.
fn divided(trees: Vec<Tree>) -> Vec<Tree> {
    if trees.len() <= MOST_TOGETHER {
        return trees;
    }
    let (mut bounded, mut few): (Vec<Tree>, Vec<Tree>) =
        trees.into_iter().partition(|tree| tree.bounds.center().is_finite() && tree.bounds.size().is_finite());
    if bounded.len() > MOST_TOGETHER {
        let size = Bounds::of_points(bounded.iter().map(|tree| tree.bounds.center())).size();
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
        bounded.sort_by(|a, b| a.bounds.center()[axis].total_cmp(&b.bounds.center()[axis]));
        let upper = bounded.split_off(bounded.len() / 2);
        few.extend([any(bounded), any(upper)]);
    } else {
        few.extend(bounded);
    }
    few
}
