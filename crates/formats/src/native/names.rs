//! How a written scene refers to its textures and materials: by name, or by writing them where they are used.

use super::write::Out;
use durer_scene::{MaterialId, Object, ObjectKind, Paint, Scene, TextureId};
use std::collections::BTreeSet;

/// For each texture and each material its name, or `None` if it is to be written where it is used (or nowhere).
///
/// Those with a name keep it (unless it was given out before); those without are written where they are used if that
/// is one place, and otherwise get a name.
pub(super) fn choose(scene: &Scene) -> (Vec<Option<String>>, Vec<Option<String>>) {
    let mut material_uses = vec![0; scene.materials.len()];
    count_materials(&scene.objects, &mut material_uses);
    let mut texture_uses = vec![0; scene.textures.len()];
    let count = |paint: &Paint, uses: &mut Vec<usize>| {
        if let Paint::Texture(TextureId(id)) = paint
            && let Some(uses) = uses.get_mut(*id as usize)
        {
            *uses += 1;
        }
    };
    scene.materials.iter().for_each(|material| count(&material.color, &mut texture_uses));
    for texture in &scene.textures {
        texture.pattern.colors().iter().for_each(|paint| count(paint, &mut texture_uses));
    }
    let textures = names(scene.textures.iter().map(|texture| &texture.name), &texture_uses, "texture");
    let materials = names(scene.materials.iter().map(|material| &material.name), &material_uses, "material");
    (textures, materials)
}

fn count_materials(objects: &[Object], uses: &mut [usize]) {
    for object in objects {
        if let Some(MaterialId(id)) = object.material
            && let Some(uses) = uses.get_mut(id as usize)
        {
            *uses += 1;
        }
        if let ObjectKind::Group(members) = &object.kind {
            count_materials(members, uses);
        }
    }
}

fn names<'a>(
    given: impl Iterator<Item = &'a Option<String>> + Clone,
    uses: &[usize],
    word: &str,
) -> Vec<Option<String>> {
    let all: BTreeSet<&String> = given.clone().flatten().collect();
    let mut used: BTreeSet<String> = BTreeSet::new();
    let mut next = 1;
    let mut fresh = |used: &BTreeSet<String>, stem: &str| {
        loop {
            let name = format!("{stem} {next}");
            next += 1;
            if !all.contains(&name) && !used.contains(&name) {
                return name;
            }
        }
    };
    given
        .zip(uses)
        .map(|(name, uses)| {
            let name = match name {
                Some(name) if can_be_key(name) && !used.contains(name) => name.clone(),
                Some(_) => fresh(&used, word),
                None if *uses > 1 => fresh(&used, word),
                None => return None,
            };
            used.insert(name.clone());
            Some(name)
        })
        .collect()
}

/// `<<` would be read as a merge key, and YAML allows keys of at most 1024 characters.
fn can_be_key(name: &str) -> bool {
    name != "<<" && Out::Text(name.to_owned()).to_flow().chars().count() < 1000
}
