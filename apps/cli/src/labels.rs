//! What shapes and lights are called: by their names, or by their places in the scene file.

use durer::Scene;
use durer::scene::{Light, Object, ObjectKind};

/// A shape, as messages name it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ShapeLabel<'s> {
    /// Its place in the file: `objects[3].objects[0]`. Copies of instances are counted between the two.
    pub(crate) place: String,
    /// Its name, if it has one.
    pub(crate) name: Option<&'s str>,
    /// The kind of shape: `sphere`.
    pub(crate) kind: &'static str,
    /// Which copy it is, if it is in instances; for copies of copies the outer one first.
    pub(crate) copies: Vec<usize>,
}

impl std::fmt::Display for ShapeLabel<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Some(name) = self.name else { return write!(f, "{} {}", self.kind, self.place) };
        write!(f, "{} \"{}\"", self.kind, cut(name))?;
        self.copies.iter().try_for_each(|copy| write!(f, ", copy {copy}"))
    }
}

/// The shapes of a scene in the order in which renderers count them: that of the file, depth first, copy by copy. No
/// text is made of one before it is asked for; there may be millions.
#[derive(Debug)]
pub(crate) struct Shapes<'s> {
    members: Members<'s>,
}

/// Objects side by side; each with the number of shapes in it and in those before it.
#[derive(Debug)]
struct Members<'s>(Vec<(usize, Member<'s>)>);

#[derive(Debug)]
struct Member<'s> {
    object: &'s Object,
    /// What is in it; one shape, if it is itself one.
    members: Members<'s>,
    is_shape: bool,
    copies: usize,
}

impl<'s> Shapes<'s> {
    /// Those of a scene.
    pub(crate) fn of(scene: &'s Scene) -> Shapes<'s> {
        Shapes { members: Members::of(&scene.objects) }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.members.len()
    }

    /// What the one with this index is called.
    pub(crate) fn label(&self, index: usize) -> Option<ShapeLabel<'s>> {
        let (mut members, mut index) = (&self.members, index);
        let (mut place, mut copies) = (String::new(), Vec::new());
        loop {
            let (at, member, within) = members.find(index)?;
            place += &format!("objects[{at}]");
            if member.is_shape {
                let (name, kind) = (member.object.name.as_deref(), member.object.kind.word());
                return Some(ShapeLabel { place, name, kind, copies });
            }
            members = &member.members;
            index = within % members.len();
            if let ObjectKind::Instances(_) = member.object.kind {
                copies.push(within / members.len());
                place += &format!(".copies[{}]", within / members.len());
            }
            place.push('.');
        }
    }
}

impl<'s> Members<'s> {
    fn of(objects: &'s [Object]) -> Members<'s> {
        let mut end = 0;
        let count = |object: &'s Object| {
            let member = Member::of(object);
            end += member.len();
            (end, member)
        };
        Members(objects.iter().map(count).collect())
    }

    fn len(&self) -> usize {
        self.0.last().map_or(0, |(end, _)| *end)
    }

    /// The object that has the shape with this index, its place in the list, and the shape's index in there.
    fn find(&self, index: usize) -> Option<(usize, &Member<'s>, usize)> {
        let at = self.0.partition_point(|(end, _)| *end <= index);
        let start = if at == 0 { 0 } else { self.0[at - 1].0 };
        Some((at, &self.0.get(at)?.1, index - start))
    }
}

impl<'s> Member<'s> {
    fn of(object: &'s Object) -> Member<'s> {
        let (members, is_shape, copies): (&[Object], bool, usize) = match &object.kind {
            ObjectKind::Shape(_) | ObjectKind::Solid(_) => (&[], true, 1),
            // What has nothing in it is no shape.
            ObjectKind::Mesh(mesh) => (&[], !mesh.data.triangles.is_empty(), 1),
            ObjectKind::Particles(particles) => (&[], !particles.kind.is_empty(), 1),
            ObjectKind::Group(members) => (members, false, 1),
            ObjectKind::Import(import) => (&import.objects, false, 1),
            ObjectKind::Instances(instances) => (&instances.objects, false, instances.positions.values.len()),
        };
        Member { object, members: Members::of(members), is_shape, copies }
    }

    fn len(&self) -> usize {
        if self.is_shape { 1 } else { self.copies * self.members.len() }
    }
}

/// A light: its name in quotes, or `lights[2]`. Those of imported files are counted after the scene's own.
pub(crate) fn light(scene: &Scene, index: usize) -> String {
    let (place, light) = match scene.lights.get(index) {
        Some(light) => (format!("lights[{index}]"), Some(light)),
        None => imported_light(&scene.objects, "", &mut (index - scene.lights.len()))
            .map_or((format!("lights[{index}]"), None), |(place, light)| (place, Some(light))),
    };
    match light.and_then(|light| light.name.as_deref()) {
        Some(name) => format!("light \"{}\"", cut(name)),
        None => place,
    }
}

/// The place of an imported light, and itself. Files that are copied bring none.
fn imported_light<'s>(objects: &'s [Object], around: &str, index: &mut usize) -> Option<(String, &'s Light)> {
    for (at, object) in objects.iter().enumerate() {
        let place = || format!("{around}objects[{at}].");
        let found = match &object.kind {
            ObjectKind::Group(members) => imported_light(members, &place(), index),
            ObjectKind::Import(import) => match import.lights.get(*index) {
                Some(light) => Some((format!("{}lights[{index}]", place()), light)),
                None => {
                    *index -= import.lights.len();
                    imported_light(&import.objects, &place(), index)
                }
            },
            ObjectKind::Shape(_)
            | ObjectKind::Mesh(_)
            | ObjectKind::Particles(_)
            | ObjectKind::Instances(_)
            | ObjectKind::Solid(_) => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Long names lose their ends, and no name breaks a line.
pub(crate) fn cut(name: &str) -> String {
    const LONGEST: usize = 30;
    let visible = |c: char| if c.is_control() { ' ' } else { c };
    match name.chars().count() {
        0..=LONGEST => name.chars().map(visible).collect(),
        _ => name.chars().take(LONGEST - 1).map(visible).chain(['…']).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer::math::DVec3;
    use durer::scene::{Data, Import, Instances, Mesh, MeshData, MeshNormals, Shape, Sizes};

    fn ball(name: Option<&str>) -> Object {
        let shape = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
        Object { name: name.map(str::to_owned), ..Object::new(ObjectKind::Shape(shape)) }
    }

    fn copies(count: usize, objects: Vec<Object>) -> Object {
        let positions = Data::inline(vec![DVec3::ZERO; count]);
        let instances = Instances { objects, positions, rotations: None, scales: Sizes::Same(1.0), materials: vec![] };
        Object::new(ObjectKind::Instances(instances))
    }

    fn texts(scene: &Scene) -> Vec<String> {
        let shapes = Shapes::of(scene);
        assert_eq!(shapes.label(shapes.len()), None);
        (0..shapes.len()).map(|index| shapes.label(index).unwrap().to_string()).collect()
    }

    #[test]
    fn shapes_are_counted_depth_first() {
        let inner = Object::new(ObjectKind::Group(vec![ball(None), ball(Some("moon"))]));
        let group = Object::new(ObjectKind::Group(vec![inner, ball(None)]));
        let scene = Scene { objects: vec![ball(None), group], ..Scene::default() };
        let expected = [
            "sphere objects[0]",
            "sphere objects[1].objects[0].objects[0]",
            "sphere \"moon\"",
            "sphere objects[1].objects[1]",
        ];
        assert_eq!(texts(&scene), expected);
        assert_eq!(light(&scene, 0), "light \"key\"");
        assert_eq!(cut(&"x".repeat(50)).chars().count(), 30);
    }

    #[test]
    fn copies_are_counted_one_after_the_other_and_what_is_empty_not_at_all() {
        let empty = Mesh { file: None, normals: MeshNormals::Flat, data: MeshData::default().into() };
        let empty = Object::new(ObjectKind::Mesh(empty));
        let inner = copies(2, vec![ball(None), empty.clone(), ball(Some("moon"))]);
        let objects = vec![empty.clone(), copies(3, vec![empty]), copies(2, vec![inner]), ball(None)];
        let expected = [
            "sphere objects[2].copies[0].objects[0].copies[0].objects[0]",
            "sphere \"moon\", copy 0, copy 0",
            "sphere objects[2].copies[0].objects[0].copies[1].objects[0]",
            "sphere \"moon\", copy 0, copy 1",
            "sphere objects[2].copies[1].objects[0].copies[0].objects[0]",
            "sphere \"moon\", copy 1, copy 0",
            "sphere objects[2].copies[1].objects[0].copies[1].objects[0]",
            "sphere \"moon\", copy 1, copy 1",
            "sphere objects[3]",
        ];
        assert_eq!(texts(&Scene { objects, ..Scene::default() }), expected);
    }

    #[test]
    fn lights_of_files_come_after_those_of_the_scene() {
        let lights = Light::default_lights();
        let nameless = Light { name: None, ..lights[0].clone() };
        let import = |lights: Vec<Light>, objects| {
            Object::new(ObjectKind::Import(Import { file: "a.glb".to_owned(), objects, lights, camera: None }))
        };
        let inner = import(vec![nameless.clone()], vec![]);
        let outer = import(vec![lights[0].clone(), nameless.clone()], vec![inner]);
        let group = Object::new(ObjectKind::Group(vec![outer]));
        let objects = vec![copies(5, vec![import(lights.clone(), vec![])]), group];
        let scene = Scene { objects, lights: vec![nameless], ..Scene::default() };
        let found: Vec<String> = (0..4).map(|index| light(&scene, index)).collect();
        let of_file = "objects[1].objects[0].";
        let expected = [
            "lights[0]".to_owned(),
            "light \"key\"".to_owned(),
            format!("{of_file}lights[1]"),
            format!("{of_file}objects[0].lights[0]"),
        ];
        assert_eq!(found, expected);
    }
}
