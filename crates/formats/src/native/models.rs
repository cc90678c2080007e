//! Model files: each is read once, through [`Assets`](crate::Assets), and what it brings goes to the scene's lists.

use super::decode::{Decoder, Fields};
use super::record::{Choice, FieldAbout, Record, fields, record};
use super::tree::{Node, NodeKind, Span, shorten};
use super::write::FieldsOut;
use crate::Limits;
use crate::diagnostics::Complaint;
use crate::models::{self, Model, shade};
use durer_scene::{Import, MaterialId, MeshData, MeshNormals, MeshPart, Object, ObjectKind};
use std::rc::Rc;
use std::sync::Arc;

/// An import as a scene file says it.
pub(crate) struct Written {
    pub(crate) file: String,
}

record!(Written {
    file: String => "The model file: .gltf, .glb, .obj, .ply or .stl.";
});

impl Written {
    /// The import, with what the file has.
    pub(crate) fn resolve(self, from: &mut Fields<'_, '_, '_>) -> Import {
        let nothing = |file| Import { file, objects: Vec::new(), lights: Vec::new(), camera: None };
        if !from.has("file") {
            return nothing(self.file);
        }
        let span = from.span_of("file");
        let import = load(&self.file, span, from.cx).filter(|import| count(import, span, from.cx));
        import.map_or_else(
            || {
                from.doubt();
                nothing(self.file)
            },
            |import| Import::clone(&import),
        )
    }
}

/// Adds the objects of an import to those of all so far: a file that is imported again and again, as by aliases, must not
/// unfold without end. False after complaining.
fn count(import: &Import, span: Span, cx: &mut Decoder<'_>) -> bool {
    let most = usize::try_from(cx.limits.max_values).unwrap_or(usize::MAX);
    let before = cx.imported;
    cx.imported = before.saturating_add(count_all(&import.objects));
    if cx.imported > most && before <= most {
        let complaint = Complaint::error(span, format!("imports bring more than {most} objects"));
        let _: Option<()> = cx.complain(complaint.help("to show a model many times, put one import in `instances`"));
    }
    cx.imported <= most
}

fn count_all(objects: &[Object]) -> usize {
    let inside = |object: &Object| match &object.kind {
        ObjectKind::Group(members) => count_all(members),
        ObjectKind::Solid(solid) => count_all(&solid.operands),
        ObjectKind::Instances(copies) => count_all(&copies.objects),
        ObjectKind::Import(import) => count_all(&import.objects),
        ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => 0,
    };
    objects.iter().map(|object| 1 + inside(object)).sum()
}

/// What is in a model file, or `None` after complaining (at its first use only).
fn load(file: &str, span: Span, cx: &mut Decoder<'_>) -> Option<Rc<Import>> {
    if let Some(known) = cx.models.get(file) {
        return known.clone();
    }
    let model = read(file, span, cx).map(|model| Rc::new(enter(file, model, span, cx)));
    cx.models.insert(file.to_owned(), model.clone());
    model
}

fn read(file: &str, span: Span, cx: &mut Decoder<'_>) -> Option<Model> {
    let bytes = match cx.assets.read(file, cx.limits.max_file_bytes) {
        Ok(bytes) => bytes,
        Err(error) => {
            let complaint = Complaint::error(span, format!("cannot read the model `{}`", shorten(file)));
            return cx.complain(complaint.label(error.to_string()).maybe_help(error.help()));
        }
    };
    let left = cx.limits.max_texture_bytes.saturating_sub(cx.texture_bytes);
    let limits = Limits { max_texture_bytes: left, ..cx.limits.clone() };
    match models::read(file, &bytes, cx.assets, &limits) {
        Ok(model) => Some(model),
        Err(error) => {
            let complaint = Complaint::error(span, format!("cannot use the model `{}`", shorten(file)));
            cx.complain(complaint.label(error.to_string()).maybe_help(error.help))
        }
    }
}

/// Moves what the model brings to the scene's lists. Problems with it have no place but the name of the file.
fn enter(file: &str, model: Model, span: Span, cx: &mut Decoder<'_>) -> Import {
    let Model { mut scene, warnings } = model;
    for warning in warnings {
        let _: Option<()> = cx.complain(Complaint::warning(span, format!("`{}`: {warning}", shorten(file))));
    }
    let (lights, camera) = (std::mem::take(&mut scene.lights), scene.camera.take());
    cx.texture_bytes += scene.images.iter().map(|image| image.bitmap.memory()).sum::<u64>();
    let objects = models::adopt(scene, &mut cx.scene);
    let node = Rc::new(Node { span, kind: NodeKind::Scalar { text: file.to_owned(), plain: true } });
    cx.material_nodes.resize(cx.scene.materials.len(), Rc::clone(&node));
    cx.texture_nodes.resize(cx.scene.textures.len(), Rc::clone(&node));
    cx.image_nodes.resize(cx.scene.images.len(), node);
    Import { file: file.to_owned(), objects, lights, camera }
}

/// The one mesh in a model file, with the normals that are asked for.
pub(crate) fn mesh(file: &str, normals: MeshNormals, span: Span, cx: &mut Decoder<'_>) -> Option<Arc<MeshData>> {
    let model = load(file, span, cx)?;
    let key = (file.to_owned(), normals.word());
    if let Some(known) = cx.meshes.get(&key) {
        return Some(Arc::clone(known));
    }
    match single(&model) {
        Ok((data, material)) => {
            let data = shaded(with_material(data, material), normals);
            cx.meshes.insert(key, Arc::clone(&data));
            Some(data)
        }
        Err(why) => {
            let complaint = Complaint::error(span, format!("the model `{}` is not a single mesh", shorten(file)));
            let help = format!("take all of it: `import: {{file: {}}}`", shorten(file));
            cx.complain(complaint.label(why).help(help))
        }
    }
}

/// The only object of a model, if it is a mesh that stays in its place; and its material.
fn single(model: &Import) -> Result<(&Arc<MeshData>, Option<MaterialId>), String> {
    let [Object { material, transform, kind, name: _ }] = &model.objects[..] else {
        return Err(format!("it has {} objects", model.objects.len()));
    };
    match kind {
        ObjectKind::Mesh(mesh) if transform.steps.is_empty() => Ok((&mesh.data, *material)),
        ObjectKind::Mesh(_) => Err("its mesh is moved by a transform".to_owned()),
        other => Err(format!("it has a {}", other.word())),
    }
}

/// The mesh with its material in its parts, where the material of an object that uses it goes before.
fn with_material(data: &Arc<MeshData>, material: Option<MaterialId>) -> Arc<MeshData> {
    if material.is_none() {
        return Arc::clone(data);
    }
    let count = data.triangles.len() as u32;
    let parts = vec![MeshPart { name: None, first: 0, count, material }];
    Arc::new(MeshData { parts, ..MeshData::clone(data) })
}

/// The mesh itself if it needs no other normals, so that all objects share it.
fn shaded(data: Arc<MeshData>, normals: MeshNormals) -> Arc<MeshData> {
    let changes = match normals {
        MeshNormals::File => false,
        MeshNormals::Smooth => data.normals.is_empty(),
        MeshNormals::Flat => !data.normals.is_empty(),
    };
    if !changes {
        return data;
    }
    let mut data = Arc::unwrap_or_clone(data);
    shade(&mut data, normals);
    Arc::new(data)
}
