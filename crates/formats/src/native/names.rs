//! How a written scene refers to its textures and materials: by name, or by writing them where they are used.

use super::write::Out;
use durer_scene::{Material, MaterialId, Mesh, Object, ObjectKind, Paint, Scene, TextureId};
use std::collections::BTreeSet;

/// For each texture and each material its name, or `None` if it is to be written where it is used (or nowhere, as what
/// models bring).
///
/// Those with a name keep it (unless it was given out before); those without are written where they are used if that
/// is one place, and otherwise get a name.
pub(super) fn choose(scene: &Scene) -> (Vec<Option<String>>, Vec<Option<String>>) {
    let mut material_uses = vec![0; scene.materials.len()];
    count_materials(&scene.objects, &mut material_uses);
    let texture_uses = count_textures(scene, &material_uses);
    let textures = names(scene.textures.iter().map(|texture| &texture.name), &texture_uses, "texture");
    let materials = names(scene.materials.iter().map(|material| &material.name), &material_uses, "material");
    (textures, materials)
}

/// How often each material is written or referred to.
fn count_materials(objects: &[Object], uses: &mut [usize]) {
    let mut count = |material: Option<MaterialId>| {
        if let Some(uses) = material.and_then(|MaterialId(id)| uses.get_mut(id as usize)) {
            *uses += 1;
        }
    };
    for object in objects {
        count(object.material);
        match &object.kind {
            ObjectKind::Mesh(Mesh { file: None, data, .. }) => data.parts.iter().for_each(|part| count(part.material)),
            ObjectKind::Instances(copies) => copies.materials.iter().for_each(|id| count(Some(*id))),
            _ => {}
        }
    }
    for object in objects {
        match &object.kind {
            ObjectKind::Group(members) => count_materials(members, uses),
            ObjectKind::Solid(solid) => count_materials(&solid.operands, uses),
            ObjectKind::Instances(copies) => count_materials(&copies.objects, uses),
            // What is in a file is not written.
            ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) | ObjectKind::Import(_) => {}
        }
    }
}

/// How often each texture is written or referred to, by the materials that are used, and by textures that are.
fn count_textures(scene: &Scene, material_uses: &[usize]) -> Vec<usize> {
    let mut uses = vec![0; scene.textures.len()];
    let is_written = |(material, uses): &(&Material, &usize)| material.name.is_some() || **uses > 0;
    let materials = scene.materials.iter().zip(material_uses).filter(is_written);
    let mut paints: Vec<Paint> = materials.flat_map(|(material, _)| material.paints()).collect();
    let named = scene.textures.iter().filter(|texture| texture.name.is_some());
    paints.extend(named.flat_map(|texture| texture.pattern.colors()));
    while let Some(paint) = paints.pop() {
        let Paint::Texture(TextureId(id)) = paint else { continue };
        let (Some(texture), Some(uses)) = (scene.textures.get(id as usize), uses.get_mut(id as usize)) else {
            continue;
        };
        *uses += 1;
        // One without a name is written for the sake of its first use, and with it what it is made of.
        if texture.name.is_none() && *uses == 1 {
            paints.extend(texture.pattern.colors());
        }
    }
    uses
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
