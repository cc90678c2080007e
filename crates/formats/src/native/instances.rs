//! Copies of objects, each in a place of its own.

use super::decode::Fields;
use super::lists::{List, SizeList};
use super::record::{FieldAbout, Record, fields, record};
use super::tables::Role;
use super::value::Item;
use super::write::FieldsOut;
use crate::diagnostics::Complaint;
use durer_math::DVec3;
use durer_scene::{Instances, MaterialId, Object, ObjectKind};

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
        let lights: usize = objects.iter().map(lights_in).sum();
        if lights > 0 {
            let lights = if lights == 1 { "a light".to_owned() } else { format!("{lights} lights") };
            let message = format!("what is imported here brings {lights}, which will not shine: instances have none");
            let complaint = Complaint::warning(from.span_of("objects"), message);
            let _: Option<()> = from.cx.complain(complaint.help("add lights to the scene's own `lights`"));
        }
        Instances {
            objects,
            positions: positions.resolve(Role::Positions, from),
            rotations: rotations.map(|rotations| rotations.resolve(Role::Rotations, from)),
            scales: scale.resolve(Role::Scale, from),
            materials,
        }
    }
}

/// How many lights the files among an object bring.
fn lights_in(object: &Object) -> usize {
    let in_all = |objects: &[Object]| objects.iter().map(lights_in).sum();
    match &object.kind {
        ObjectKind::Import(import) => import.lights.len(),
        ObjectKind::Group(members) => in_all(members),
        // Of instances inside of instances that has been said already, and solids have no imports.
        ObjectKind::Instances(_) | ObjectKind::Solid(_) => 0,
        ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => 0,
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
