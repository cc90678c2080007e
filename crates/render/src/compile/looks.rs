//! What the surfaces of a primitive look like: one material for all of it, or one for each of its parts, and colours of
//! their own.
//!
//! A primitive holds no more than a few words of it. What differs from part to part is in a list of [`Details`], which
//! all instances of a thing share.

use crate::materials::Material;
use durer_math::{DAffine3, Rgb};
use durer_scene::MeshData;
use std::sync::Arc;

/// Seen by all rays that look for something opaque.
pub(crate) const OPAQUE: u32 = 1;
/// Seen by all rays that look for something that light may pass.
pub(crate) const CLEAR: u32 = 2;

/// What shading needs to know of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct PlacedObject {
    pub(crate) looks: Looks,
    /// From the world to the space in which the user described the shape; `None` where they are the same, and where no
    /// texture asks.
    pub(crate) object_from_world: Option<Box<DAffine3>>,
}

/// What a primitive looks like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Looks {
    /// Its material; if its parts have several, that of what it is filled with.
    pub(crate) material: u32,
    /// Index of its [`Details`], if it has any.
    details: u32,
    /// True if it is filled with a medium: it has an inside, and what is there bends light or takes it away.
    pub(crate) is_medium: bool,
    /// True if light may pass where it is, by its material or through holes.
    pub(crate) is_clear: bool,
    /// True if how much light passes is not the same everywhere.
    pub(crate) is_uneven: bool,
    /// True if it may have holes.
    pub(crate) has_holes: bool,
    /// True if some texture wants to know places in its object's space.
    is_textured: bool,
    /// True if shading cannot but look at the details, or for holes.
    has_details: bool,
}

/// What differs from part to part of a primitive, or from point to point of a part.
#[derive(Clone, Debug)]
pub(crate) struct Details {
    /// The first part of each run of parts with the same material, and that; the first run starts at part 0. Empty if
    /// there is but one material.
    runs: Vec<(u32, u32)>,
    /// What it is made of: the one thing that it is, or the operands of a solid in the order of their parts.
    origins: Vec<Origin>,
}

/// What some of the parts of a primitive come from.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    /// The first of these parts.
    pub(crate) first_part: u32,
    pub(crate) colors: Colors,
    /// From the solid's space to that in which the user described the operand; `None` where they are the same.
    pub(crate) operand_from_solid: Option<DAffine3>,
}

/// Colours of a primitive's own. They take the place of a material's plain colour, and multiply its texture.
#[derive(Clone, Debug)]
pub(crate) enum Colors {
    /// There are none.
    None,
    /// A mesh's, interpolated between vertices.
    Vertices(Arc<MeshData>),
    /// One for each particle.
    Particles(Arc<[Rgb]>),
}

const NONE: u32 = u32::MAX;

impl Looks {
    /// With one material.
    pub(super) fn plain(material: u32, materials: &[Material], is_closed: impl FnOnce() -> bool) -> Looks {
        let compiled = &materials[material as usize];
        let is_medium = compiled.fills_with_medium() && is_closed();
        Looks {
            material,
            details: NONE,
            is_medium,
            is_clear: compiled.lets_light_pass(is_medium),
            is_uneven: compiled.passes_unevenly(is_medium),
            has_holes: compiled.opacity.is_some(),
            is_textured: compiled.is_textured,
            has_details: compiled.needs_details(),
        }
    }

    /// With a material for each run of parts. What it is filled with is the first that fills anything.
    pub(super) fn of_runs(runs: &[(u32, u32)], materials: &[Material], is_closed: impl FnOnce() -> bool) -> Looks {
        let filling = runs.iter().find(|&&(_, id)| materials[id as usize].fills_with_medium());
        let material = filling.or(runs.first()).map_or(materials.len() as u32 - 1, |&(_, id)| id);
        Looks::filled(material, filling.is_some() && is_closed(), runs, materials)
    }

    /// With a material for each run of parts, and one that it is filled with.
    pub(super) fn of_solid(inside: u32, runs: &[(u32, u32)], materials: &[Material]) -> Looks {
        Looks::filled(inside, materials[inside as usize].fills_with_medium(), runs, materials)
    }

    fn filled(material: u32, is_medium: bool, runs: &[(u32, u32)], materials: &[Material]) -> Looks {
        let any = |is: &dyn Fn(&Material) -> bool| runs.iter().any(|&(_, id)| is(&materials[id as usize]));
        let is_clear = any(&|material| material.lets_light_pass(is_medium));
        Looks {
            material,
            details: NONE,
            is_medium,
            is_clear,
            is_uneven: is_clear,
            has_holes: any(&|material| material.opacity.is_some()),
            is_textured: any(&|material| material.is_textured),
            has_details: any(&|material| material.needs_details()),
        }
    }

    /// The index of its details, if it has any.
    #[inline]
    pub(crate) fn details(&self) -> Option<u32> {
        (self.details != NONE).then_some(self.details)
    }

    /// True if there is more to say of it than its one material says.
    #[inline]
    pub(crate) fn has_details(&self) -> bool {
        self.has_details
    }

    /// The same, with details.
    pub(super) fn with_details(self, details: Option<u32>) -> Looks {
        Looks { details: details.unwrap_or(NONE), has_details: self.has_details || details.is_some(), ..self }
    }

    /// The class of rays that look for it.
    pub(super) fn mask(&self) -> u32 {
        if self.is_clear { CLEAR } else { OPAQUE }
    }

    /// A primitive that looks like this, in its place.
    pub(super) fn placed(self, world_from_object: &DAffine3) -> PlacedObject {
        let is_asked = self.is_textured && *world_from_object != DAffine3::IDENTITY;
        PlacedObject { looks: self, object_from_world: is_asked.then(|| Box::new(world_from_object.inverse())) }
    }
}

impl Origin {
    /// All of a primitive comes from one thing.
    pub(super) fn whole(colors: Colors) -> Origin {
        Origin { first_part: 0, colors, operand_from_solid: None }
    }
}

impl Details {
    /// `runs` are empty, or start at part 0, as `origins` do.
    pub(super) fn new(runs: &[(u32, u32)], origins: Vec<Origin>) -> Details {
        Details { runs: runs.to_vec(), origins }
    }

    /// The same without materials.
    pub(super) fn without_materials(&self) -> Details {
        Details { runs: Vec::new(), ..self.clone() }
    }

    /// What a part comes from, and the index of that.
    #[inline]
    pub(crate) fn origin(&self, part: u32) -> (usize, &Origin) {
        let after = self.origins.partition_point(|origin| origin.first_part <= part);
        let index = after.saturating_sub(1);
        (index, &self.origins[index])
    }

    /// True for a solid of several things.
    pub(crate) fn is_solid(&self) -> bool {
        self.origins.len() > 1
    }

    /// The material of a part, if parts have materials of their own.
    #[inline]
    pub(crate) fn material(&self, part: u32) -> Option<u32> {
        let after = self.runs.partition_point(|&(first, _)| first <= part);
        Some(self.runs.get(after.checked_sub(1)?)?.1)
    }
}

/// The runs of a mesh's triangles with the same material. `own` is the object's, which overrides all; `around` is what
/// parts without a material have.
pub(super) fn runs(mesh: &MeshData, own: Option<u32>, around: u32) -> Vec<(u32, u32)> {
    if let Some(own) = own {
        return vec![(0, own)];
    }
    let mut runs: Vec<(u32, u32)> = Vec::new();
    let mut run = |first: u32, material: u32| {
        // What begins where the one before has not gone on takes its place.
        if runs.last().is_some_and(|&(last, _)| last == first) {
            runs.pop();
        }
        if runs.last().is_none_or(|&(_, last)| last != material) {
            runs.push((first, material));
        }
    };
    run(0, around);
    for part in mesh.parts.iter().filter(|part| part.count > 0) {
        run(part.first, part.material.map_or(around, |id| id.0));
        if ((part.first + part.count) as usize) < mesh.triangles.len() {
            run(part.first + part.count, around);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_scene::{MaterialId, MeshPart};

    fn mesh(triangles: usize, parts: &[(u32, u32, Option<u32>)]) -> MeshData {
        let part = |&(first, count, material): &(u32, u32, Option<u32>)| MeshPart {
            name: None,
            first,
            count,
            material: material.map(MaterialId),
        };
        let triangles = vec![[0, 1, 2]; triangles];
        MeshData { triangles, parts: parts.iter().map(part).collect(), ..MeshData::default() }
    }

    #[test]
    fn every_triangle_has_the_material_of_its_part() {
        let mesh = mesh(20, &[(2, 3, Some(1)), (5, 0, Some(8)), (5, 4, Some(1)), (9, 2, None), (12, 8, Some(2))]);
        let runs = runs(&mesh, None, 7);
        assert_eq!(runs, [(0, 7), (2, 1), (9, 7), (12, 2)]);
        let details = Details::new(&runs, vec![Origin::whole(Colors::None)]);
        for triangle in 0..20 {
            let part = mesh.parts.iter().find(|part| (part.first..part.first + part.count).contains(&triangle));
            let expected = part.and_then(|part| part.material).map_or(7, |id| id.0);
            assert_eq!(details.material(triangle), Some(expected), "{triangle}");
        }
    }

    #[test]
    fn one_material_needs_no_runs() {
        let parts = [(0, 3, Some(1)), (3, 3, None)];
        assert_eq!(runs(&mesh(6, &parts), Some(4), 7), [(0, 4)]);
        assert_eq!(runs(&mesh(6, &parts[..1]), None, 1), [(0, 1)]);
        assert_eq!(runs(&mesh(3, &parts[..1]), None, 7), [(0, 1)], "nothing is left of what is around");
        assert_eq!(Details::new(&[], vec![Origin::whole(Colors::None)]).material(2), None);
    }
}
