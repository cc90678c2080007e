//! The check finds every problem, and says where it is.

use durer_math::{DVec3, Rgb};
use durer_scene::*;

fn sphere(radius: f64) -> Object {
    Object::new(ObjectKind::Shape(Shape::Sphere { center: DVec3::ZERO, radius }))
}

fn group(objects: Vec<Object>) -> Object {
    Object::new(ObjectKind::Group(objects))
}

/// The problems of a scene, as text.
fn problems(scene: Scene) -> Vec<String> {
    scene.check().err().unwrap_or_default().iter().map(Problem::to_string).collect()
}

#[test]
fn a_good_scene_passes() {
    let scene = Scene { camera: Some(Camera::default()), objects: vec![sphere(1.0)], ..Scene::default() };
    assert_eq!(scene.clone().check().unwrap().scene(), &scene);
}

#[test]
fn all_problems_are_found_with_their_places() {
    let scene = Scene {
        objects: vec![sphere(-1.0), group(vec![sphere(1.0), sphere(f64::NAN)])],
        materials: vec![Material::of(MaterialKind::Classic(Classic {
            ior: Some(f64::INFINITY),
            shininess: f32::NAN,
            ..Classic::default()
        }))],
        picture: Picture { width: 0, ..Picture::default() },
        ..Scene::default()
    };
    let found = problems(scene);
    let starts = [
        "picture.width: width must be",
        "material 0.shininess: shininess must be",
        "material 0.ior: ior must be",
        "objects[0].sphere.radius: radius must be above 0",
        "objects[1].group.objects[1].sphere.radius: radius must be above 0",
    ];
    assert_eq!(found.len(), starts.len(), "{found:#?}");
    for (found, start) in found.iter().zip(starts) {
        assert!(found.starts_with(start), "{found}");
    }
}

#[test]
fn ids_must_be_in_range() {
    let texture = Paint::Texture(TextureId(3));
    let pattern = Pattern::Checker { colors: [texture, Paint::Color(Rgb::WHITE)], size: 1.0, space: Space::Object };
    let image = ImageTexture {
        image: ImageId(0),
        mapping: Mapping::Uv,
        wrap: Wrap::Repeat,
        filter: Filter::Nearest,
        encoding: Encoding::Srgb,
        channels: Channels::Color,
        tint: Rgb::WHITE,
    };
    let textures = [pattern, Pattern::Image(image)];
    let texture_of = |pattern| Texture { name: None, transform: Transform::default(), pattern };
    let scene = Scene {
        objects: vec![Object { material: Some(MaterialId(2)), ..sphere(1.0) }],
        materials: vec![Material::of(MaterialKind::Mirror(Mirror { color: Paint::Texture(TextureId(9)) }))],
        textures: textures.into_iter().map(texture_of).collect(),
        ..Scene::default()
    };
    let found = problems(scene);
    assert_eq!(found.len(), 4, "{found:#?}");
}

#[test]
fn textures_must_not_be_made_of_themselves_nor_too_deep() {
    let made_of = |id: u32| Texture {
        name: None,
        transform: Transform::default(),
        pattern: Pattern::Rings {
            colors: vec![Paint::Color(Rgb::BLACK), Paint::Texture(TextureId(id))],
            width: 1.0,
            space: Space::Object,
        },
    };
    let scene = |textures| Scene { textures, ..Scene::default() };
    assert_eq!(problems(scene(vec![made_of(1), made_of(2), made_of(0)])).len(), 1);
    let stone = || Texture {
        pattern: Pattern::Noise { colors: [Paint::Color(Rgb::BLACK); 2], size: 1.0, octaves: 1 },
        ..made_of(0)
    };
    let chain = |length: u32| std::iter::once(stone()).chain((0..length - 1).map(made_of)).collect::<Vec<_>>();
    assert!(problems(scene(chain(32))).is_empty());
    assert_eq!(problems(scene(chain(100_000))).len(), 1, "one problem, and no deep recursion");
}

#[test]
fn groups_nest_64_deep() {
    let nested = |depth: usize| (1..depth).fold(sphere(1.0), |inner, _| group(vec![inner]));
    let scene = |depth| Scene { objects: vec![nested(depth)], ..Scene::default() };
    assert!(problems(scene(64)).is_empty());
    assert_eq!(problems(scene(65)).len(), 1);
}

#[test]
fn transforms_must_be_reversible() {
    let with = |steps: Vec<TransformStep>| Scene {
        objects: vec![Object { transform: Transform { steps }, ..sphere(1.0) }],
        ..Scene::default()
    };
    let scale = |x| TransformStep::Scale(DVec3::new(x, 1.0, 1.0));
    assert!(problems(with(vec![scale(-2.0), scale(1e-6), scale(1e3)])).is_empty());
    for bad in [0.0, 1e-200, 1e200, f64::NAN, f64::INFINITY] {
        assert_eq!(problems(with(vec![scale(bad)])).len(), 1, "{bad}");
    }
    assert_eq!(problems(with(vec![scale(1e-6), scale(1e-6)])).len(), 1, "together");
    let turn = |axis| TransformStep::Rotate { axis, degrees: 10.0 };
    assert_eq!(problems(with(vec![turn(DVec3::ZERO)])).len(), 1);
    assert!(problems(with(vec![turn(DVec3::splat(1e12))])).is_empty());
}

#[test]
fn what_is_not_finite_is_refused_everywhere() {
    let bad = DVec3::new(0.0, f64::NAN, 0.0);
    let shapes = [
        Shape::Plane { point: bad, normal: DVec3::Y },
        Shape::Plane { point: DVec3::ZERO, normal: bad },
        Shape::Sphere { center: bad, radius: 1.0 },
        Shape::Sphere { center: DVec3::ZERO, radius: f64::INFINITY },
        Shape::Box { min: bad, max: DVec3::ONE },
        Shape::Box { min: DVec3::ZERO, max: bad },
        Shape::Cylinder { base: bad, top: DVec3::Y, radius: 1.0, open: false },
        Shape::Cylinder { base: DVec3::ZERO, top: DVec3::Y, radius: f64::NAN, open: false },
        Shape::Cone { base: DVec3::ZERO, top: bad, base_radius: 1.0, top_radius: 0.0, open: false },
        Shape::Cone { base: DVec3::ZERO, top: DVec3::Y, base_radius: 1.0, top_radius: f64::NAN, open: false },
        Shape::Disc { center: bad, normal: DVec3::Y, radius: 1.0, inner_radius: 0.0 },
        Shape::Disc { center: DVec3::ZERO, normal: DVec3::Y, radius: 1.0, inner_radius: f64::NAN },
        Shape::Rectangle { corner: bad, edges: [DVec3::X, DVec3::Y] },
        Shape::Rectangle { corner: DVec3::ZERO, edges: [DVec3::X, bad] },
        Shape::Triangle { vertices: [DVec3::ZERO, DVec3::X, bad], uvs: None },
        Shape::Triangle { vertices: [DVec3::ZERO, DVec3::X, DVec3::Y], uvs: Some([bad.truncate(); 3]) },
        Shape::Torus { center: bad, axis: DVec3::Y, radius: 1.0, tube_radius: 0.1 },
        Shape::Torus { center: DVec3::ZERO, axis: DVec3::Y, radius: 1.0, tube_radius: f64::NAN },
    ];
    for shape in shapes {
        let scene = Scene { objects: vec![Object::new(ObjectKind::Shape(shape))], ..Scene::default() };
        assert_eq!(problems(scene).len(), 1, "{shape:?}");
    }
    let nan = Rgb::gray(f32::NAN);
    assert_eq!(problems(Scene { ambient: nan, background: Background::Color(nan), ..Scene::default() }).len(), 2);
}
