//! A model becomes part of a scene: what it refers to by number moves to the ends of the scene's lists.

use durer_scene::{
    ImageId, ImageTexture, Import, Instances, Material, MaterialId, MeshData, Object, ObjectKind, Paint, Pattern,
    Scene, Solid, Texture, TextureId,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Moves the model's materials, textures and images to the scene's lists; gives its objects, which refer to them there.
pub(crate) fn adopt(model: Scene, scene: &mut Scene) -> Vec<Object> {
    let shift = Shift {
        materials: scene.materials.len() as u32,
        textures: scene.textures.len() as u32,
        images: scene.images.len() as u32,
    };
    let Scene { images, mut textures, mut materials, mut objects, .. } = model;
    textures.iter_mut().for_each(|texture| shift.texture(texture));
    materials.iter_mut().for_each(|material| shift.material(material));
    shift.meshes(&mut objects);
    objects.iter_mut().for_each(|object| shift.object(object));
    scene.images.extend(images);
    scene.textures.extend(textures);
    scene.materials.extend(materials);
    objects
}

/// By how much numbers grow.
struct Shift {
    materials: u32,
    textures: u32,
    images: u32,
}

impl Shift {
    fn id(&self, id: &mut MaterialId) {
        id.0 += self.materials;
    }

    fn paint(&self, paint: &mut Paint) {
        match paint {
            Paint::Color(_) => {}
            Paint::Texture(TextureId(id)) => *id += self.textures,
        }
    }

    fn texture(&self, texture: &mut Texture) {
        match &mut texture.pattern {
            Pattern::Checker { colors, size: _, space: _ }
            | Pattern::Noise { colors, size: _, octaves: _ }
            | Pattern::Marble { colors, size: _, turbulence: _, octaves: _ }
            | Pattern::Wood { colors, size: _, turbulence: _, octaves: _ } => {
                colors.iter_mut().for_each(|paint| self.paint(paint));
            }
            Pattern::Stripes { colors, axis: _, width: _, space: _ }
            | Pattern::Rings { colors, width: _, space: _ }
            | Pattern::Gradient { colors, axis: _, length: _, wrap: _, space: _ } => {
                colors.iter_mut().for_each(|paint| self.paint(paint));
            }
            Pattern::Image(ImageTexture { image: ImageId(id), .. }) => *id += self.images,
        }
    }

    fn material(&self, material: &mut Material) {
        material.paints_mut().into_iter().for_each(|paint| self.paint(paint));
    }

    /// Objects, but for the meshes in them.
    fn object(&self, object: &mut Object) {
        object.material.iter_mut().for_each(|id| self.id(id));
        let all = |objects: &mut [Object]| objects.iter_mut().for_each(|object| self.object(object));
        match &mut object.kind {
            ObjectKind::Shape(_) | ObjectKind::Particles(_) | ObjectKind::Mesh(_) => {}
            ObjectKind::Group(objects)
            | ObjectKind::Import(Import { objects, .. })
            | ObjectKind::Solid(Solid { operands: objects, .. }) => all(objects),
            ObjectKind::Instances(Instances { objects, materials, .. }) => {
                materials.iter_mut().for_each(|id| self.id(id));
                all(objects);
            }
        }
    }

    /// The parts of meshes. Several objects may share a mesh, which must move once and stay shared: so each is taken out
    /// of all objects, is changed while nobody else has it, and is put back.
    fn meshes(&self, objects: &mut [Object]) {
        let empty = Arc::new(MeshData::default());
        let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
        let mut taken: Vec<Arc<MeshData>> = Vec::new();
        let mut uses: Vec<usize> = Vec::new();
        for_each_mesh(objects, &mut |data| {
            let mesh = std::mem::replace(data, Arc::clone(&empty));
            // All are kept alive, so an address stands for one mesh.
            let number = *numbers.entry(Arc::as_ptr(&mesh).addr()).or_insert(taken.len());
            if number == taken.len() {
                taken.push(mesh);
            }
            uses.push(number);
        });
        for mesh in &mut taken {
            if mesh.parts.iter().any(|part| part.material.is_some()) {
                let parts = Arc::make_mut(mesh).parts.iter_mut();
                parts.filter_map(|part| part.material.as_mut()).for_each(|id| self.id(id));
            }
        }
        let mut uses = uses.into_iter();
        for_each_mesh(objects, &mut |data| {
            if let Some(number) = uses.next() {
                *data = Arc::clone(&taken[number]);
            }
        });
    }
}

/// Calls `each` for the meshes in some objects, always in the same order.
fn for_each_mesh(objects: &mut [Object], each: &mut impl FnMut(&mut Arc<MeshData>)) {
    for object in objects {
        match &mut object.kind {
            ObjectKind::Shape(_) | ObjectKind::Particles(_) => {}
            ObjectKind::Mesh(mesh) => each(&mut mesh.data),
            ObjectKind::Group(objects)
            | ObjectKind::Import(Import { objects, .. })
            | ObjectKind::Instances(Instances { objects, .. })
            | ObjectKind::Solid(Solid { operands: objects, .. }) => for_each_mesh(objects, each),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_imaging::{Bitmap, Texels};
    use durer_math::{DVec3, Rgb};
    use durer_scene::*;

    fn image(file: &str) -> ImageAsset {
        let texels = Texels::U8(vec![[1, 2, 3]]);
        let bitmap = Bitmap { width: 1, height: 1, texels, alpha: None };
        ImageAsset { file: file.to_owned(), bitmap: Arc::new(bitmap) }
    }

    fn texture(pattern: Pattern) -> Texture {
        Texture { name: None, transform: Transform::default(), pattern }
    }

    fn part(material: Option<u32>) -> MeshPart {
        MeshPart { name: None, first: 0, count: 1, material: material.map(MaterialId) }
    }

    fn mesh(data: &Arc<MeshData>) -> ObjectKind {
        ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data: Arc::clone(data) })
    }

    /// All texture numbers that the patterns of some textures refer to.
    fn paints(textures: &[Texture]) -> Vec<Paint> {
        let of_one = |texture: &Texture| match &texture.pattern {
            Pattern::Checker { colors, .. }
            | Pattern::Noise { colors, .. }
            | Pattern::Marble { colors, .. }
            | Pattern::Wood { colors, .. } => colors.to_vec(),
            Pattern::Stripes { colors, .. } | Pattern::Rings { colors, .. } | Pattern::Gradient { colors, .. } => {
                colors.clone()
            }
            Pattern::Image(_) => Vec::new(),
        };
        textures.iter().flat_map(of_one).collect()
    }

    fn every_pattern(image: u32) -> Vec<Texture> {
        let two = [Paint::Texture(TextureId(0)), Paint::Color(Rgb::WHITE)];
        let (many, space, wrap, axis) = (two.to_vec(), Space::Uv, Wrap::Repeat, DVec3::X);
        [
            Pattern::Image(ImageTexture {
                image: ImageId(image),
                mapping: Mapping::Uv,
                wrap,
                filter: Filter::Nearest,
                encoding: Encoding::Srgb,
                channels: Channels::Color,
                tint: Rgb::WHITE,
            }),
            Pattern::Checker { colors: two, size: 1.0, space },
            Pattern::Noise { colors: two, size: 1.0, octaves: 1 },
            Pattern::Marble { colors: two, size: 1.0, turbulence: 1.0, octaves: 1 },
            Pattern::Wood { colors: two, size: 1.0, turbulence: 1.0, octaves: 1 },
            Pattern::Stripes { colors: many.clone(), axis, width: 1.0, space },
            Pattern::Rings { colors: many.clone(), width: 1.0, space },
            Pattern::Gradient { colors: many, axis, length: 1.0, wrap, space },
        ]
        .map(texture)
        .to_vec()
    }

    #[test]
    fn numbers_follow_what_they_stand_for() {
        let mut scene = Scene {
            images: vec![image("a")],
            textures: every_pattern(0),
            materials: vec![Material::default(); 3],
            ..Scene::default()
        };
        let before = scene.clone();
        let color = Paint::Texture(TextureId(0));
        let kind = MaterialKind::Classic(Classic { color, ..Classic::default() });
        let material = Material { opacity: Paint::Texture(TextureId(1)), ..Material::of(kind) };
        let model = Scene {
            images: vec![image("b"), image("c")],
            textures: every_pattern(1),
            materials: vec![material],
            ..Scene::default()
        };
        assert!(adopt(model, &mut scene).is_empty());
        assert_eq!((scene.images.len(), scene.textures.len(), scene.materials.len()), (3, 16, 4));
        assert_eq!((&scene.textures[..8], &scene.materials[..3]), (&before.textures[..], &before.materials[..]));
        let textures = paints(&scene.textures[8..]).into_iter().filter(|paint| *paint != Paint::Color(Rgb::WHITE));
        assert!(textures.eq([Paint::Texture(TextureId(8)); 7]));
        assert!(matches!(&scene.textures[8].pattern, Pattern::Image(texture) if texture.image == ImageId(2)));
        let adopted = &scene.materials[3];
        let black = Paint::Color(Rgb::BLACK);
        assert_eq!(adopted.paints(), [Paint::Texture(TextureId(8)), black, Paint::Texture(TextureId(9))]);
    }

    #[test]
    fn nested_objects_and_shared_meshes_move_once() {
        let parted = Arc::new(MeshData { parts: vec![part(Some(0)), part(None)], ..MeshData::default() });
        let plain = Arc::new(MeshData { positions: vec![[1.0; 3]], ..MeshData::default() });
        let instances = Instances {
            objects: vec![Object::new(mesh(&parted))],
            positions: Data::inline(vec![DVec3::ZERO]),
            rotations: None,
            scales: Sizes::Same(1.0),
            materials: vec![MaterialId(0), MaterialId(1)],
        };
        let solid = Solid { operation: Operation::Union, operands: vec![Object::new(mesh(&plain))] };
        let objects = vec![
            Object { material: Some(MaterialId(1)), ..Object::new(mesh(&parted)) },
            Object::new(ObjectKind::Group(vec![
                Object::new(ObjectKind::Instances(instances)),
                Object { material: Some(MaterialId(0)), ..Object::new(ObjectKind::Solid(solid)) },
            ])),
        ];
        let model = Scene { materials: vec![Material::default(); 2], objects, ..Scene::default() };
        drop((parted, plain));
        let mut scene = Scene { materials: vec![Material::default(); 10], ..Scene::default() };
        let mut objects = adopt(model, &mut scene);
        assert_eq!((objects[0].material, scene.materials.len()), (Some(MaterialId(11)), 12));
        let ObjectKind::Group(members) = &objects[1].kind else { panic!("a group") };
        let ObjectKind::Instances(instances) = &members[0].kind else { panic!("instances") };
        assert_eq!(instances.materials, [MaterialId(10), MaterialId(11)]);
        assert_eq!(members[1].material, Some(MaterialId(10)));
        let mut all = Vec::new();
        for_each_mesh(&mut objects, &mut |data| all.push(Arc::clone(data)));
        assert!(all.len() == 3 && Arc::ptr_eq(&all[0], &all[1]), "still shared");
        assert_eq!(all[0].parts, [part(Some(10)), part(None)]);
        assert_eq!(all[2].positions, [[1.0; 3]]);
    }
}
