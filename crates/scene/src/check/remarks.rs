//! What is worth saying of a scene that can be rendered: what will not look as it was meant.

use super::bounds::BRIGHTEST;
use super::values::Checker;
use super::{Step, emptiness};
use crate::{
    Background, Bump, Channels, Classic, Encoding, Import, Instances, Integrator, Material, MaterialId, MaterialKind,
    NormalMap, Object, ObjectKind, Paint, PathSettings, Pattern, Relief, Shape, TextureId,
};
use durer_imaging::{Bitmap, Texels};

pub(super) fn remark(c: &mut Checker<'_>) {
    background(c);
    reuse(c);
    for (id, one) in (0..).zip(&c.scene.materials) {
        c.at(Step::Material(MaterialId(id)), |c| material(c, one));
    }
    let objects = &c.scene.objects;
    c.field("objects", |c| planes(c, objects, None));
    emptiness::remark(c);
    darkness(c);
}

fn background(c: &mut Checker<'_>) {
    let Background::Image(map) = c.scene.background else { return };
    let Some(image) = c.scene.images.get(map.image.0 as usize) else { return };
    c.field("background", |c| {
        if map.strength == 0.0 || is_black(&image.bitmap) {
            let at = if map.strength == 0.0 { "strength" } else { "image" };
            c.field(at, |c| c.problem_with_help("this environment is black, and gives no light", "is that meant?"));
            return;
        }
        if has_negative(&image.bitmap) {
            c.field("image", |c| c.problem("this image has negative numbers, which are taken for 0"));
        }
        if has_above(&image.bitmap, BRIGHTEST) {
            let help = "divide the image by some number, and give that as `strength`";
            let message = "this image has numbers above a million, which are taken for a million";
            c.field("image", |c| c.problem_with_help(message, help));
        }
    });
}

/// Paths are shared where nothing but empty space is between surfaces, from the second surface on.
fn reuse(c: &mut Checker<'_>) {
    let Integrator::Path(PathSettings { reuse: 2.., max_depth, .. }) = c.scene.render.integrator else { return };
    let help = "leave it out: each pixel has paths of its own";
    let message = match c.scene.fog {
        Some(_) => "`reuse` does nothing in fog".to_owned(),
        None if max_depth <= 2 => format!("`reuse` does nothing with a `max_depth` of {max_depth}, but from 3 on"),
        None => return,
    };
    c.field("render", |c| {
        c.field("integrator", |c| {
            c.field("path", |c| c.field("reuse", |c| c.problem_with_help(message, help)));
        });
    });
}

fn is_black(bitmap: &Bitmap) -> bool {
    match &bitmap.texels {
        Texels::U8(texels) => texels.iter().flatten().all(|number| *number == 0),
        Texels::U16(texels) => texels.iter().flatten().all(|number| *number == 0),
        Texels::F32(texels) => texels.iter().flatten().all(|number| *number <= 0.0),
    }
}

fn has_above(bitmap: &Bitmap, most: f32) -> bool {
    match &bitmap.texels {
        Texels::U8(_) | Texels::U16(_) => false,
        Texels::F32(texels) => texels.iter().flatten().any(|number| *number > most),
    }
}

fn has_negative(bitmap: &Bitmap) -> bool {
    match &bitmap.texels {
        Texels::U8(_) | Texels::U16(_) => false,
        Texels::F32(texels) => texels.iter().flatten().any(|number| *number < 0.0),
    }
}

fn material(c: &mut Checker<'_>, material: &Material) {
    match material.kind.word() {
        None => parts(c, material),
        Some(word) => c.field(word, |c| parts(c, material)),
    }
}

fn parts(c: &mut Checker<'_>, material: &Material) {
    for (field, paint) in numbers(material) {
        if is_encoded(c, paint) {
            let message = format!("the numbers in this image are taken for colors, though {field} is none");
            c.field(field, |c| c.problem_with_help(message, "add `encoding: linear` to the image"));
        }
    }
    match material.relief {
        Some(Relief::NormalMap(NormalMap { texture: Paint::Color(_), .. })) => c.field("normal_map", |c| {
            let help = "give a texture, such as `normal_map: {image: {file: normals.png, encoding: linear}}`";
            let message = "this normal map is a plain color: it leans all normals the same way, and shows no relief";
            c.field("texture", |c| c.problem_with_help(message, help));
        }),
        Some(Relief::Bump(Bump { height: Paint::Color(_), .. })) => c.field("bump", |c| {
            let help = "give a texture, such as `height: {noise: {size: 0.1}}`";
            let message = "this height is the same everywhere, and shows no relief";
            c.field("height", |c| c.problem_with_help(message, help));
        }),
        Some(Relief::NormalMap(_) | Relief::Bump(_)) | None => {}
    }
    let path = matches!(c.scene.render.integrator, Integrator::Path { .. });
    if let (true, MaterialKind::Classic(classic)) = (path, &material.kind)
        && has_nothing_but_ambient(classic)
        && material.emission.is_black()
    {
        let help = "there, give it an `emission`";
        c.field("ambient", |c| c.problem_with_help("`path` knows no ambient light: this material is black", help));
    }
}

/// The paints that stand for numbers or directions, not for colors, and are often taken from images.
fn numbers(material: &Material) -> Vec<(&'static str, Paint)> {
    let mut numbers = match &material.kind {
        MaterialKind::Classic(_) | MaterialKind::Mirror(_) => Vec::new(),
        MaterialKind::Matte(matte) => vec![("roughness", matte.roughness)],
        MaterialKind::Metal(metal) => {
            vec![("roughness", metal.roughness), ("anisotropy", metal.anisotropy), ("rotation", metal.rotation)]
        }
        MaterialKind::Glass(glass) => vec![("roughness", glass.roughness)],
        MaterialKind::Plastic(plastic) => vec![("roughness", plastic.roughness)],
        MaterialKind::Principled(principled) => vec![
            ("metallic", principled.metallic),
            ("roughness", principled.roughness),
            ("specular", principled.specular),
            ("transmission", principled.transmission),
            ("clearcoat", principled.clearcoat),
            ("clearcoat_roughness", principled.clearcoat_roughness),
            ("sheen_roughness", principled.sheen_roughness),
            ("anisotropy", principled.anisotropy),
            ("anisotropy_rotation", principled.anisotropy_rotation),
        ],
    };
    numbers.extend(material.relief.map(|relief| match relief {
        Relief::NormalMap(map) => ("normal_map", map.texture),
        Relief::Bump(bump) => ("bump", bump.height),
    }));
    numbers
}

/// True for an image whose numbers are made linear, as those of photographs are.
fn is_encoded(c: &Checker<'_>, paint: Paint) -> bool {
    let Paint::Texture(TextureId(id)) = paint else { return false };
    let Some(Pattern::Image(shown)) = c.scene.textures.get(id as usize).map(|texture| &texture.pattern) else {
        return false;
    };
    let image = c.scene.images.get(shown.image.0 as usize);
    let is_float = image.is_none_or(|image| matches!(image.bitmap.texels, Texels::F32(_)));
    shown.encoding == Encoding::Srgb && shown.channels != Channels::Alpha && !is_float
}

fn has_nothing_but_ambient(classic: &Classic) -> bool {
    let Classic { ambient, diffuse, specular, reflection, transparency, .. } = classic;
    *ambient > 0.0 && *diffuse == 0.0 && specular.is_black() && reflection.is_black() && transparency.is_black()
}

/// Infinite planes that glow, with the material of what is around them unless they have their own.
fn planes(c: &mut Checker<'_>, objects: &[Object], around: Option<MaterialId>) {
    for (at, object) in objects.iter().enumerate() {
        let material = object.material.or(around);
        c.at(Step::Index(at), |c| {
            c.field(object.kind.word(), |c| match &object.kind {
                ObjectKind::Shape(Shape::Plane { .. }) => plane(c, material),
                ObjectKind::Group(members) => c.field("objects", |c| planes(c, members, material)),
                ObjectKind::Instances(Instances { objects, .. }) => {
                    c.field("objects", |c| planes(c, objects, material));
                }
                ObjectKind::Import(Import { .. })
                | ObjectKind::Shape(_)
                | ObjectKind::Mesh(_)
                | ObjectKind::Particles(_)
                | ObjectKind::Solid(_) => {}
            });
        });
    }
}

fn plane(c: &mut Checker<'_>, material: Option<MaterialId>) {
    let material = material.and_then(|MaterialId(id)| c.scene.materials.get(id as usize));
    if material.is_some_and(|material| !material.emission.is_black()) {
        let message =
            "this plane glows, but it is infinite, and no light can be aimed at: what it lights is left to chance";
        c.field("material", |c| c.problem_with_help(message, "use a large rectangle or disc"));
    }
}

/// Nothing that gives light, where ambient light does not count.
fn darkness(c: &mut Checker<'_>) {
    let scene = c.scene;
    if !matches!(scene.render.integrator, Integrator::Path { .. }) {
        return;
    }
    let lamps = scene.lights.iter().any(|light| light.strength.amount() > 0.0 && !light.color.is_black());
    let sky = match scene.background {
        Background::Color(color) => !color.is_black(),
        Background::Gradient { bottom, top } => !(bottom.is_black() && top.is_black()),
        // If it is black, there is a remark already.
        Background::Image(_) => true,
    };
    let glows = scene.materials.iter().any(|material| !material.emission.is_black());
    if !(lamps || sky || glows || brings_lights(&scene.objects)) {
        let help = "add lights, give a material `emission`, or choose a `background`";
        c.problem_with_help("nothing in this scene gives light: the picture will be black", help);
    }
}

fn brings_lights(objects: &[Object]) -> bool {
    objects.iter().any(|object| match &object.kind {
        ObjectKind::Import(import) => !import.lights.is_empty() || brings_lights(&import.objects),
        ObjectKind::Group(members) => brings_lights(members),
        ObjectKind::Shape(_)
        | ObjectKind::Mesh(_)
        | ObjectKind::Particles(_)
        | ObjectKind::Instances(_)
        | ObjectKind::Solid(_) => false,
    })
}
