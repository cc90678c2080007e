//! The scene graph, laid flat: every node's place in the world, and the order in which the scene has them.
//!
//! Objects of durer nest too, but only so deep, and with transforms that can be reversed one by one; what counts for a
//! node is all of its transforms together. Nothing here is recursive: a file may nest a million deep.

use super::super::ModelError;
use super::source::Source;
use super::value::{Place, Value};
use durer_math::{DAffine3, DMat3, DVec3};

/// The nodes of a file.
pub(super) struct Graph {
    /// The map from each node's space to the world.
    world: Vec<DAffine3>,
    /// The nodes of the scene: parents before children, children in order.
    pub(super) scene: Vec<u32>,
}

const NO_PARENT: u32 = u32::MAX;
/// The largest factor by which a transform may change a length, and the farthest that it may move, in scenes.
const LARGEST_FACTOR: f64 = 1e9;
const FARTHEST: f64 = 1e12;

/// A bound for what a map does to lengths (Frobenius).
fn norm(m: DMat3) -> f64 {
    m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// True for a map that can be reversed without stretching lengths too much.
pub(super) fn is_reversible(m: DMat3) -> bool {
    let inverse = m.inverse();
    m.determinant() != 0.0 && inverse.is_finite() && norm(inverse) <= LARGEST_FACTOR
}

impl Graph {
    pub(super) fn of(source: &Source<'_>) -> Result<Graph, ModelError> {
        let nodes = source.root.list("nodes")?;
        // Maps, parents and orders, and what grows on the way.
        source.budget.spend(nodes.len(), 2 * (size_of::<DAffine3>() + 16), nodes.place)?;
        let parents = parents(source, nodes.len())?;
        let roots: Vec<u32> =
            (0..).zip(&parents).filter(|(_, parent)| **parent == NO_PARENT).map(|(at, _)| at).collect();
        let order = descend(source, &roots)?;
        if order.len() < nodes.len() {
            let mut missing = vec![true; nodes.len()];
            order.iter().for_each(|node| missing[*node as usize] = false);
            let first = missing.iter().position(|missing| *missing).unwrap_or(0);
            return Err(nodes.place.index(first).fault("this node is its own ancestor, or below one that is"));
        }
        let mut world = vec![DAffine3::IDENTITY; nodes.len()];
        for node in order {
            let local = local_transform(&source.item("nodes", node as usize, nodes.place)?)?;
            world[node as usize] = match parents[node as usize] {
                NO_PARENT => local,
                parent => world[parent as usize] * local,
            };
        }
        let scene = descend(source, &scene_roots(source, roots)?)?;
        Ok(Graph { world, scene })
    }

    /// The map from a node's space to the world, unless its numbers have grown beyond what scenes allow.
    pub(super) fn world_from_node(&self, node: usize, from: Place) -> Result<DAffine3, ModelError> {
        let Some(world) = self.world.get(node) else {
            return Err(from.fault(format!("there is no nodes[{node}]")));
        };
        let is_near = world.is_finite() && world.translation.abs().max_element() <= FARTHEST;
        if is_near && norm(world.matrix3) <= LARGEST_FACTOR {
            return Ok(*world);
        }
        let place = Place::default().field("nodes").index(node);
        Err(place.fault("its transform, with those above it, stretches or moves too much"))
    }
}

/// The parent of each node.
fn parents(source: &Source<'_>, count: usize) -> Result<Vec<u32>, ModelError> {
    let mut parents = vec![NO_PARENT; count];
    for index in 0..count {
        let node = source.item("nodes", index, Place::default())?;
        for child in node.list("children")?.iter() {
            let which = child.as_whole()?;
            let Some(parent) = parents.get_mut(which) else {
                return Err(child.fault(format!("there is no nodes[{which}]")));
            };
            if *parent != NO_PARENT {
                return Err(child.fault(format!("nodes[{which}] is already a child of nodes[{parent}]")));
            }
            *parent = index as u32;
        }
    }
    Ok(parents)
}

/// The nodes where the scene begins: those of the default scene, or of the first one, or all that have no parent.
fn scene_roots(source: &Source<'_>, roots: Vec<u32>) -> Result<Vec<u32>, ModelError> {
    let scenes = source.root.list("scenes")?;
    let scene = match source.referred(&source.root, "scene", "scenes")? {
        Some((_, scene)) => scene,
        None => match scenes.object(0)? {
            Some(scene) => scene,
            None => return Ok(roots),
        },
    };
    if scenes.len() > 1 {
        source.notes.add("only one of the file's scenes is shown", scene.place);
    }
    let index = |node: Value<'_>| -> Result<u32, ModelError> {
        let index = node.as_whole()?;
        source.item("nodes", index, node.place)?;
        Ok(index as u32)
    };
    scene.list("nodes")?.iter().map(index).collect()
}

/// The nodes below these and they themselves, parents before children, each once.
fn descend(source: &Source<'_>, roots: &[u32]) -> Result<Vec<u32>, ModelError> {
    let nodes = source.root.list("nodes")?;
    let mut seen = vec![false; nodes.len()];
    let mut order = Vec::new();
    let mut open: Vec<u32> = roots.iter().rev().copied().collect();
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut seen[node as usize], true) {
            continue;
        }
        order.push(node);
        let value = source.item("nodes", node as usize, nodes.place)?;
        let first = open.len();
        for child in value.list("children")?.iter() {
            open.push(child.as_whole()? as u32);
        }
        open[first..].reverse();
    }
    Ok(order)
}

/// The map from a node's space to its parent's.
fn local_transform(node: &Value<'_>) -> Result<DAffine3, ModelError> {
    if let Some(m) = node.numbers::<16>("matrix")? {
        return Ok(affine(&m));
    }
    let [x, y, z] = node.numbers("translation")?.unwrap_or([0.0; 3]);
    let [a, b, c] = node.numbers("scale")?.unwrap_or([1.0; 3]);
    let mut linear = DMat3::from_diagonal(DVec3::new(a, b, c));
    if let Some(quaternion) = node.numbers::<4>("rotation")? {
        linear = rotation(quaternion, node.place)? * linear;
    }
    Ok(DAffine3 { matrix3: linear, translation: DVec3::new(x, y, z) })
}

/// The map of a matrix given column by column; its last row is taken for (0, 0, 0, 1).
pub(super) fn affine(m: &[f64; 16]) -> DAffine3 {
    let column = |at: usize| DVec3::new(m[at], m[at + 1], m[at + 2]);
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(4), column(8)), translation: column(12) }
}

/// The rotation of a quaternion (x, y, z, w) of any usable length.
fn rotation(quaternion: [f64; 4], place: Place) -> Result<DMat3, ModelError> {
    let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !(1e-6..=1e6).contains(&length) {
        return Err(place.field("rotation").fault("a rotation must be a quaternion of length 1"));
    }
    let [x, y, z, w] = quaternion.map(|component| component / length);
    Ok(DMat3::from_cols(
        DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
        DVec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
        DVec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
    ))
}
