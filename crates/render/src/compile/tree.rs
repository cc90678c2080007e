//! The scene's objects as a tree in which everything that copies share is found out once; any of its shapes can be placed
//! in the world without the others.
//!
//! So a million instances are placed by all threads at once, each in its slot of one array, and nothing is kept for a copy
//! but its primitive. Maps are multiplied from the world inwards, copy by copy: an instance is, to the bit, the object
//! that stands in its place.

use super::GeometryMemory;
use super::contents::{Content, Contents};
use super::looks::{Colors, Details, Looks, Origin, PlacedObject, runs};
use super::solids;
use crate::materials::Material;
use durer_geometry::Primitive;
use durer_math::{DAffine3, DVec3};
use durer_scene::{Instances, MaterialId, Object, ObjectKind, TransformStep};

/// All shapes of a scene.
pub(super) struct Tree<'s> {
    objects: List<'s>,
    pub(super) details: Vec<Details>,
    materials: &'s [Material],
}

/// Objects side by side.
struct List<'s> {
    nodes: Vec<Node<'s>>,
    /// For each node, how many shapes there are in it and in those before it.
    ends: Vec<u32>,
}

/// An object.
struct Node<'s> {
    parent_from_object: DAffine3,
    kind: Kind<'s>,
}

enum Kind<'s> {
    One(Box<Leaf<'s>>),
    Many(List<'s>),
    Copies(&'s Instances, List<'s>),
}

/// A shape, and what it looks like.
struct Leaf<'s> {
    content: Content<'s>,
    looks: Looks,
    /// The details that stay if an instance brings a material of its own.
    details_without_materials: Option<u32>,
}

/// What an object gets from those around it.
#[derive(Clone, Copy)]
struct Around {
    material: u32,
    /// True if an instance may bring a material of its own.
    copies_have_materials: bool,
}

impl<'s> Tree<'s> {
    /// The tree of these objects. `materials` are the scene's, and after them the default.
    pub(super) fn new(objects: &'s [Object], contents: &Contents, materials: &'s [Material]) -> Tree<'s> {
        let empty = List { nodes: Vec::new(), ends: Vec::new() };
        let mut tree = Tree { objects: empty, details: Vec::new(), materials };
        let around = Around { material: materials.len() as u32 - 1, copies_have_materials: false };
        tree.objects = tree.list(objects, contents, around);
        tree
    }

    /// How many shapes there are.
    pub(super) fn len(&self) -> u32 {
        self.objects.len()
    }

    /// Adds the bytes of particles and solids.
    pub(super) fn add_memory(&self, memory: &mut GeometryMemory) {
        self.objects.add_memory(memory);
    }

    /// The shape with this index, depth first, in the world.
    pub(super) fn place(&self, index: u32) -> (Primitive, PlacedObject) {
        let (mut world, mut list, mut index) = (DAffine3::IDENTITY, &self.objects, index);
        let mut brought: Option<u32> = None;
        loop {
            let (node, within) = list.find(index);
            let world_from_object = world * node.parent_from_object;
            match &node.kind {
                Kind::One(leaf) => return self.place_leaf(leaf, &world_from_object, brought),
                Kind::Many(members) => (world, list, index) = (world_from_object, members, within),
                Kind::Copies(instances, members) => {
                    let copy = (within / members.len()) as usize;
                    world = world_from_object * place_of_copy(instances, copy);
                    (list, index) = (members, within % members.len());
                    // Copies of copies: the outermost material wins, as it overrides what is in the copied objects.
                    brought = brought.or_else(|| material_of_copy(instances, copy));
                }
            }
        }
    }

    fn place_leaf(&self, leaf: &Leaf<'_>, world: &DAffine3, brought: Option<u32>) -> (Primitive, PlacedObject) {
        let looks = match brought {
            None => leaf.looks,
            Some(material) => Looks::plain(material, self.materials, || leaf.content.is_closed())
                .with_details(leaf.details_without_materials),
        };
        let mut primitive = leaf.content.place(world);
        primitive.mask = looks.mask();
        (primitive, looks.placed(world))
    }

    fn list(&mut self, objects: &'s [Object], contents: &Contents, around: Around) -> List<'s> {
        let nodes: Vec<Node<'s>> = objects.iter().map(|object| self.node(object, contents, around)).collect();
        let mut end = 0;
        let ends = nodes.iter().map(|node| {
            end += node.len();
            end
        });
        List { ends: ends.collect(), nodes }
    }

    fn node(&mut self, object: &'s Object, contents: &Contents, around: Around) -> Node<'s> {
        let own = object.material.map(|id| id.0);
        let inside = Around { material: own.unwrap_or(around.material), ..around };
        let kind = match &object.kind {
            ObjectKind::Group(members) => Kind::Many(self.list(members, contents, inside)),
            ObjectKind::Import(import) => Kind::Many(self.list(&import.objects, contents, inside)),
            ObjectKind::Instances(instances) => {
                let copies_have_materials = inside.copies_have_materials || !instances.materials.is_empty();
                let inside = Around { copies_have_materials, ..inside };
                Kind::Copies(instances, self.list(&instances.objects, contents, inside))
            }
            ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) | ObjectKind::Solid(_) => {
                match contents.get(&object.kind) {
                    Some(content) => Kind::One(Box::new(self.leaf(content, contents, own, around))),
                    None => Kind::Many(List { nodes: Vec::new(), ends: Vec::new() }),
                }
            }
        };
        Node { parent_from_object: object.transform.to_affine(), kind }
    }

    fn leaf(&mut self, content: Content<'s>, contents: &Contents, own: Option<u32>, around: Around) -> Leaf<'s> {
        let material = own.unwrap_or(around.material);
        let mut origins = vec![Origin::whole(content.colors())];
        let runs = match (&content, content.mesh_data()) {
            (Content::Solid(placed, solid), _) => solids::details(solid, placed, contents, material, &mut origins),
            (_, Some(data)) => runs(data, own, around.material),
            (_, None) => vec![(0, material)],
        };
        let looks = match (&content, &runs[..]) {
            // What is inside is the solid's own, if that is said.
            (Content::Solid(..), runs) => Looks::of_solid(own.unwrap_or(runs[0].1), runs, self.materials),
            (_, &[(_, material)]) => Looks::plain(material, self.materials, || content.is_closed()),
            (_, runs) => Looks::of_runs(runs, self.materials, || content.is_closed()),
        };
        let several = runs.len() > 1 || runs[0].1 != looks.material;
        let is_plain = matches!(origins[..], [Origin { colors: Colors::None, operand_from_solid: None, .. }]);
        let has_details = several || content.is_smooth() || !is_plain;
        let details = Details::new(if several { &runs } else { &[] }, origins);
        let details_without_materials =
            (has_details && several && around.copies_have_materials).then(|| self.add(details.without_materials()));
        let details = has_details.then(|| self.add(details));
        let details_without_materials = if several { details_without_materials } else { details };
        Leaf { content, looks: looks.with_details(details), details_without_materials }
    }

    fn add(&mut self, details: Details) -> u32 {
        self.details.push(details);
        self.details.len() as u32 - 1
    }
}

impl<'s> List<'s> {
    fn len(&self) -> u32 {
        self.ends.last().copied().unwrap_or(0)
    }

    fn add_memory(&self, memory: &mut GeometryMemory) {
        for node in &self.nodes {
            match &node.kind {
                Kind::One(leaf) => leaf.content.add_memory(memory),
                Kind::Many(members) | Kind::Copies(_, members) => members.add_memory(memory),
            }
        }
    }

    /// The node that has the shape with this index, and its index in there.
    fn find(&self, index: u32) -> (&Node<'s>, u32) {
        let at = self.ends.partition_point(|&end| end <= index);
        let start = if at == 0 { 0 } else { self.ends[at - 1] };
        (&self.nodes[at], index - start)
    }
}

impl Node<'_> {
    fn len(&self) -> u32 {
        match &self.kind {
            Kind::One(_) => 1,
            Kind::Many(members) => members.len(),
            Kind::Copies(instances, members) => instances.positions.values.len() as u32 * members.len(),
        }
    }
}

/// From the copied objects' space to that of the instances.
fn place_of_copy(instances: &Instances, copy: usize) -> DAffine3 {
    let scale = TransformStep::Scale(DVec3::splat(instances.scales.get(copy)));
    let turn = instances.rotations.as_ref().map(|rotations| {
        let degrees = rotations.values[copy];
        let about = |axis, degrees| TransformStep::Rotate { axis, degrees };
        [about(DVec3::X, degrees.x), about(DVec3::Y, degrees.y), about(DVec3::Z, degrees.z)]
    });
    let step = |all: DAffine3, step: &TransformStep| step.to_affine() * all;
    let turned = turn.iter().flatten().fold(scale.to_affine(), step);
    step(turned, &TransformStep::Translate(instances.positions.values[copy]))
}

fn material_of_copy(instances: &Instances, copy: usize) -> Option<u32> {
    let MaterialId(id) = *instances.materials.get(copy % instances.materials.len().max(1))?;
    Some(id)
}
