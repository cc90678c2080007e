//! Meshes: what nodes show. A mesh of several nodes is read once, and so are primitives of the same data.

use super::super::ModelError;
use super::deform::Skin;
use super::images::matrix_step;
use super::materials::Materials;
use super::nodes::{Graph, is_reversible};
use super::primitives::Primitive;
use super::source::Source;
use super::value::Value;
use durer_math::DAffine3;
use durer_scene::{Mesh, MeshData, MeshNormals, Object, ObjectKind, Transform};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The meshes of a file, as they are asked for.
pub(super) struct Meshes<'s, 'a> {
    source: &'s Source<'a>,
    graph: &'s Graph,
    pub(super) materials: Materials,
    skins: HashMap<usize, Rc<Skin>>,
    /// The triangles of primitives, by their keys.
    data: HashMap<Vec<u64>, Option<Arc<MeshData>>>,
    /// The objects that a mesh is made of, in its own space, or if it has a skin in the world's.
    shown: HashMap<Shown, Rc<[Object]>>,
}

/// What the objects of a mesh depend on.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Shown {
    mesh: usize,
    skin: Option<usize>,
    /// The node, if it sets the weights of morph targets.
    weights_of: Option<usize>,
}

impl<'s, 'a> Meshes<'s, 'a> {
    pub(super) fn new(source: &'s Source<'a>, graph: &'s Graph) -> Meshes<'s, 'a> {
        let (materials, skins, data, shown) = Default::default();
        Meshes { source, graph, materials, skins, data, shown }
    }

    /// The object that a node shows; `None` if there is nothing to see.
    pub(super) fn of_node(&mut self, index: usize, node: &Value<'a>) -> Result<Option<Object>, ModelError> {
        let Some((mesh, value)) = self.source.referred(node, "mesh", "meshes")? else { return Ok(None) };
        let skin = self.source.referred(node, "skin", "skins")?;
        let weights_of = node.has("weights").then_some(index);
        let shown = Shown { mesh, skin: skin.map(|(skin, _)| skin), weights_of };
        let objects = match self.shown.get(&shown) {
            Some(objects) => Rc::clone(objects),
            None => {
                let skin = skin.map(|(index, value)| self.skin(index, &value)).transpose()?;
                let weights = weights(if weights_of.is_some() { node } else { &value })?;
                let objects: Rc<[Object]> = self.read(&value, &weights, skin.as_deref())?.into();
                self.shown.insert(shown, Rc::clone(&objects));
                objects
            }
        };
        let name = node.name().or_else(|| value.name());
        let cost = |name: &Option<String>| size_of::<Object>() + 128 + name.as_ref().map_or(0, String::len);
        let all = objects.iter().map(|object| cost(&object.name)).sum::<usize>();
        self.source.budget.spend(1, all + cost(&name), node.place)?;
        // Skins are bent to their places in the world.
        let in_place = shown.skin.is_some();
        let transform = if in_place { Some(Transform::default()) } else { self.transform(index, node)? };
        let Some(transform) = transform else { return Ok(None) };
        Ok(match &*objects {
            [] => None,
            [object] => Some(Object { name, transform, ..object.clone() }),
            objects => Some(Object { name, transform, ..Object::new(ObjectKind::Group(objects.to_vec())) }),
        })
    }

    /// Where a node's objects are; `None` if they are flattened to nothing.
    fn transform(&self, index: usize, node: &Value<'a>) -> Result<Option<Transform>, ModelError> {
        let world_from_node = self.graph.world_from_node(index, node.place)?;
        if !is_reversible(world_from_node.matrix3) {
            self.source.notes.add("nodes that are scaled to nothing, or flat, are left out", node.place);
            return Ok(None);
        }
        let is_identity = world_from_node == DAffine3::IDENTITY;
        let steps = if is_identity { Vec::new() } else { vec![matrix_step(&world_from_node)] };
        Ok(Some(Transform { steps }))
    }

    fn skin(&mut self, index: usize, value: &Value<'a>) -> Result<Rc<Skin>, ModelError> {
        if let Some(skin) = self.skins.get(&index) {
            return Ok(Rc::clone(skin));
        }
        let skin = Rc::new(Skin::of(self.source, self.graph, index, value)?);
        self.skins.insert(index, Rc::clone(&skin));
        Ok(skin)
    }

    /// The objects of a mesh, one for each primitive that has triangles.
    fn read(&mut self, mesh: &Value<'a>, weights: &[f64], skin: Option<&Skin>) -> Result<Vec<Object>, ModelError> {
        let primitives = mesh.list("primitives")?;
        self.source.budget.spend(primitives.len() + weights.len(), 64, mesh.place)?;
        let mut objects = Vec::new();
        for primitive in primitives.iter() {
            let finish = match self.source.referred(&primitive, "material", "materials")? {
                Some((index, material)) => Some(self.materials.get(self.source, index, &material)?),
                None => None,
            };
            let Some(open) = Primitive::open(self.source, &primitive, finish, weights, skin)? else { continue };
            let data = match self.data.get(&open.key) {
                Some(known) => known.clone(),
                None => {
                    let read = open.read(self.source, skin)?.map(Arc::new);
                    self.data.insert(open.key, read.clone());
                    read
                }
            };
            let Some(data) = data else { continue };
            let (name, material) = (mesh.name(), finish.map(|finish| finish.id));
            let kind = ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data });
            objects.push(Object { name, material, ..Object::new(kind) });
        }
        Ok(objects)
    }
}

/// The weights of morph targets that a mesh or a node sets.
fn weights(of: &Value<'_>) -> Result<Vec<f64>, ModelError> {
    of.list("weights")?.iter().map(|weight| weight.as_number()).collect()
}
