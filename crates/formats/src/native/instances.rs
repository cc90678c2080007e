//! Copies of objects, each in a place of its own.

use super::decode::Fields;
use super::lists::{List, SizeList};
use super::record::{FieldAbout, Record, fields, record};
use super::tables::Role;
use super::value::Item;
use super::write::FieldsOut;
use durer_math::DVec3;
use durer_scene::{Instances, MaterialId, Object};

/// Instances as a scene file says them.
pub(crate) struct Written {
    objects: Vec<Object>,
    positions: List<DVec3>,
    rotations: Option<List<DVec3>>,
    scale: SizeList,
    materials: Vec<MaterialId>,
}

record!(Written {
    objects: Vec<Object> => "What is copied. It is kept in memory once, however many copies there are.";
    positions: List<DVec3> => "Where the origin of the copied objects comes to lie, one for each copy.";
    rotations: Option<List<DVec3>> = None => "How each copy is turned: degrees about x, then about y, then about z.";
    scale: SizeList = SizeList::Same(1.0) => "How each copy is scaled, above 0; first of all, so that it moves nothing.";
    materials: Vec<MaterialId> = Vec::new() => "Materials of the copies, in turn; they override those of the objects.";
});

impl Item for MaterialId {
    const PLURAL: &'static str = "materials";
}

impl Written {
    /// The instances, with what files have.
    pub(crate) fn resolve(self, from: &mut Fields<'_, '_, '_>) -> Instances {
        let Written { objects, positions, rotations, scale, materials } = self;
        Instances {
            objects,
            positions: positions.resolve(Role::Positions, from),
            rotations: rotations.map(|rotations| rotations.resolve(Role::Rotations, from)),
            scales: scale.resolve(Role::Scale, from),
            materials,
        }
    }
}

impl From<&Instances> for Written {
    fn from(instances: &Instances) -> Written {
        let Instances { objects, positions, rotations, scales, materials } = instances;
        Written {
            objects: objects.clone(),
            positions: positions.into(),
            rotations: rotations.as_ref().map(List::from),
            scale: scales.into(),
            materials: materials.clone(),
        }
    }
}
