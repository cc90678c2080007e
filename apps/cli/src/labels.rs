//! What shapes and lights are called: by their names, or by their places in the scene file.

use durer::Scene;
use durer::scene::{Object, ObjectKind};

/// A shape, as messages name it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ShapeLabel {
    /// Its place in the file: `objects[3].objects[0]`.
    pub(crate) place: String,
    /// Its name, if it has one.
    pub(crate) name: Option<String>,
    /// The kind of shape: `sphere`.
    pub(crate) kind: &'static str,
}

impl std::fmt::Display for ShapeLabel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.name {
            Some(name) => write!(f, "{} \"{}\"", self.kind, cut(name)),
            None => write!(f, "{} {}", self.kind, self.place),
        }
    }
}

/// The labels of all shapes, in the order in which renderers count them: that of the file, depth first.
pub(crate) fn shapes(scene: &Scene) -> Vec<ShapeLabel> {
    let mut labels = Vec::new();
    add(&scene.objects, "", &mut labels);
    labels
}

fn add(objects: &[Object], within: &str, labels: &mut Vec<ShapeLabel>) {
    for (index, object) in objects.iter().enumerate() {
        let place = format!("{within}objects[{index}]");
        match &object.kind {
            ObjectKind::Shape(shape) => {
                labels.push(ShapeLabel { place, name: object.name.clone(), kind: shape.word() });
            }
            ObjectKind::Group(children) => add(children, &format!("{place}."), labels),
            ObjectKind::Mesh(_)
            | ObjectKind::Particles(_)
            | ObjectKind::Instances(_)
            | ObjectKind::Import(_)
            | ObjectKind::Solid(_) => todo!(),
        }
    }
}

/// A light: its name in quotes, or `lights[2]`.
pub(crate) fn light(scene: &Scene, index: usize) -> String {
    match scene.lights.get(index).and_then(|light| light.name.as_deref()) {
        Some(name) => format!("light \"{}\"", cut(name)),
        None => format!("lights[{index}]"),
    }
}

/// Long names lose their ends, and no name breaks a line.
fn cut(name: &str) -> String {
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
    use durer::scene::Shape;

    #[test]
    fn shapes_are_counted_depth_first() {
        let ball = |name: Option<&str>| {
            let shape = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
            Object { name: name.map(str::to_owned), ..Object::new(ObjectKind::Shape(shape)) }
        };
        let inner = Object::new(ObjectKind::Group(vec![ball(None), ball(Some("moon"))]));
        let group = Object::new(ObjectKind::Group(vec![inner, ball(None)]));
        let scene = Scene { objects: vec![ball(None), group], ..Scene::default() };
        let texts: Vec<String> = shapes(&scene).iter().map(ShapeLabel::to_string).collect();
        let expected = [
            "sphere objects[0]",
            "sphere objects[1].objects[0].objects[0]",
            "sphere \"moon\"",
            "sphere objects[1].objects[1]",
        ];
        assert_eq!(texts, expected);
        assert_eq!(light(&scene, 0), "light \"key\"");
        assert_eq!(cut(&"x".repeat(50)).chars().count(), 30);
    }
}
