//! The check of things by the million: meshes, particles, instances, imports and solids.

use durer_math::{DVec3, Rgb};
use durer_scene::*;
use std::sync::Arc;

fn sphere(radius: f64) -> Object {
    shape(Shape::Sphere { center: DVec3::ZERO, radius })
}

fn shape(shape: Shape) -> Object {
    Object::new(ObjectKind::Shape(shape))
}

fn group(objects: Vec<Object>) -> Object {
    Object::new(ObjectKind::Group(objects))
}

fn spheres(centers: Vec<DVec3>, radii: Sizes, colors: Option<Vec<Rgb>>) -> Object {
    let kind = ParticleKind::Spheres { centers: Data::inline(centers), radii };
    Object::new(ObjectKind::Particles(Particles { file: None, kind, colors: colors.map(Data::inline) }))
}

fn each(sizes: Vec<f64>) -> Sizes {
    Sizes::Each(Data::inline(sizes))
}

fn instances(objects: Vec<Object>, positions: Vec<DVec3>, scales: Sizes) -> Instances {
    Instances { objects, positions: Data::inline(positions), rotations: None, scales, materials: Vec::new() }
}

fn copies(objects: Vec<Object>, count: usize, scale: f64) -> Object {
    Object::new(ObjectKind::Instances(instances(objects, vec![DVec3::ONE; count], Sizes::Same(scale))))
}

fn mesh(data: MeshData) -> Object {
    Object::new(ObjectKind::Mesh(Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) }))
}

fn triangle() -> MeshData {
    MeshData {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        ..MeshData::default()
    }
}

/// The triangle with another on its back.
fn pillow() -> MeshData {
    MeshData { triangles: vec![[0, 1, 2], [0, 2, 1]], ..triangle() }
}

fn solid(operation: Operation, operands: Vec<Object>) -> Object {
    Object::new(ObjectKind::Solid(Solid { operation, operands }))
}

/// The problems of a scene of one object, as text.
fn problems(object: Object) -> Vec<String> {
    let scene = Scene { objects: vec![object], ..Scene::default() };
    scene.check().err().unwrap_or_default().iter().map(Problem::to_string).collect()
}

#[track_caller]
fn assert_problems(object: Object, expected: &[&str]) {
    assert_eq!(problems(object), expected);
}

#[test]
fn of_a_list_the_first_wrong_entry_is_told() {
    let mut centers = vec![DVec3::ZERO; 1000];
    centers[7].y = f64::NAN;
    centers[8].x = f64::INFINITY;
    let mut radii = vec![1.0; 1000];
    radii[0] = -1.0;
    radii[1] = f64::NAN;
    let colors = Some(vec![Rgb::gray(1.5); 1000]);
    assert_problems(
        spheres(centers, each(radii), colors),
        &[
            "objects[0].spheres.centers[7]: centers must be finite (entry 8 of 1000)",
            "objects[0].spheres.radius[0]: radius must be above 0 (entry 1 of 1000)",
            "objects[0].spheres.colors[0]: colors must not be above 1 (entry 1 of 1000)",
        ],
    );
    assert_problems(spheres(vec![DVec3::splat(1e12)], Sizes::Same(1e-9), None), &[]);
    assert_problems(
        spheres(vec![DVec3::splat(-1e13)], Sizes::Same(0.0), None),
        &[
            "objects[0].spheres.centers[0]: the coordinates of centers must be at most 1e12 in size (entry 1 of 1)",
            "objects[0].spheres.radius: radius must be above 0",
        ],
    );
}

#[test]
fn lists_have_one_length() {
    assert_problems(
        spheres(vec![DVec3::ZERO; 4], each(vec![1.0; 3]), Some(vec![Rgb::WHITE])),
        &[
            "objects[0].spheres.radius: radius has 3 entries, but there are 4 centers",
            "objects[0].spheres.colors: colors has 1 entry, but there are 4 centers",
        ],
    );
    let points = |count: usize| Data::inline(vec![DVec3::ONE; count]);
    let kind = ParticleKind::Capsules { bases: points(2), tops: points(0), radii: each(vec![1.0]) };
    let capsules = Particles { file: None, kind, colors: None };
    assert_problems(
        Object::new(ObjectKind::Particles(capsules)),
        &[
            "objects[0].capsules.tops: tops has 0 entries, but there are 2 bases",
            "objects[0].capsules.radius: radius has 1 entry, but there are 2 bases",
        ],
    );
}

#[test]
fn ends_do_not_coincide() {
    let bases = Data::inline(vec![DVec3::ZERO, DVec3::ONE]);
    let tops = Data::inline(vec![DVec3::X, DVec3::ONE]);
    let (radii, top_radii) = (Sizes::Same(1.0), each(vec![0.0, -0.1]));
    let kind = ParticleKind::Cones { bases, tops, radii, top_radii, open: true };
    assert_problems(
        Object::new(ObjectKind::Particles(Particles { file: None, kind, colors: None })),
        &[
            "objects[0].cones.tops[1]: a top must not be the same point as its base (entry 2 of 2)",
            "objects[0].cones.top_radius[1]: top_radius must not be negative (entry 2 of 2)",
        ],
    );
}

#[test]
fn meshes_have_the_vertices_that_they_name() {
    assert_problems(mesh(triangle()), &[]);
    let data = MeshData {
        triangles: vec![[0, 1, 2], [0, 3, 1]],
        normals: vec![[0.0; 3]; 3],
        uvs: vec![[0.0, f32::NAN]; 2],
        colors: vec![Rgb::gray(-1.0); 3],
        origin: DVec3::splat(1e13),
        ..triangle()
    };
    assert_problems(
        mesh(data),
        &[
            "objects[0].mesh.origin: the coordinates of origin must be at most 1e12 in size",
            "objects[0].mesh.triangles[1]: there is no vertex 3: vertices are counted from 0, and there are 3 (entry 2 of 2)",
            "objects[0].mesh.vertex_normals[0]: a normal must not be zero: it has no direction (entry 1 of 3)",
            "objects[0].mesh.uvs: uvs has 2 entries, but there are 3 vertices",
            "objects[0].mesh.uvs[0]: texture coordinates must be at most 1e6 in size (entry 1 of 2)",
            "objects[0].mesh.colors[0]: colors must not be negative (entry 1 of 3)",
        ],
    );
}

#[test]
fn parts_of_meshes_follow_one_another() {
    let part = |first, count, material| MeshPart { name: None, first, count, material };
    let parts = |parts| mesh(MeshData { triangles: vec![[0, 1, 2]; 4], parts, ..triangle() });
    assert_problems(parts(vec![part(0, 1, None), part(2, 2, None)]), &[]);
    assert_problems(
        parts(vec![part(0, 2, Some(MaterialId(3))), part(1, 1, None)]),
        &[
            "objects[0].mesh.parts[0].material: there is no material 3",
            "objects[0].mesh.parts[1]: parts must not overlap, and follow one another (entry 2 of 2)",
        ],
    );
    assert_problems(
        parts(vec![part(u32::MAX, u32::MAX, None)]),
        &["objects[0].mesh.parts[0]: triangles 4294967295 to 8589934590 of a part are not all there: there are 4 \
           (entry 1 of 1)"],
    );
}

#[test]
fn a_shared_mesh_is_checked_once() {
    let data = Arc::new(MeshData { triangles: vec![[9, 9, 9]], ..triangle() });
    let file = || Some("a.ply".to_owned());
    let one = || Object::new(ObjectKind::Mesh(Mesh { file: file(), normals: MeshNormals::Flat, data: data.clone() }));
    let found = problems(group(vec![one(), one()]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("objects[0].group.objects[0].mesh.file.triangles[0]"), "{found:?}");
}

#[test]
fn solids_are_made_of_what_has_an_inside() {
    let cylinder = |open| shape(Shape::Cylinder { base: DVec3::ZERO, top: DVec3::Y, radius: 1.0, open });
    let plane = shape(Shape::Plane { point: DVec3::ZERO, normal: DVec3::Y });
    let inner = solid(Operation::Union, vec![sphere(1.0)]);
    let all = vec![sphere(2.0), plane, group(vec![cylinder(false), inner]), mesh(pillow())];
    assert_problems(solid(Operation::Intersection, all), &[]);
    let disc = shape(Shape::Disc { center: DVec3::ZERO, normal: DVec3::Y, radius: 1.0, inner_radius: 0.0 });
    let many = spheres(vec![DVec3::ZERO], Sizes::Same(1.0), None);
    let bad =
        vec![cylinder(true), group(vec![disc]), many, copies(vec![sphere(1.0)], 1, 1.0), sphere(0.0), mesh(triangle())];
    assert_problems(
        solid(Operation::Difference, bad),
        &[
            "objects[0].difference.objects[4].sphere.radius: radius must be above 0",
            "objects[0].difference.objects[0].cylinder.open: this cylinder has no inside, so it cannot be part of a solid",
            "objects[0].difference.objects[1].group.objects[0].disc: this disc has no inside, so it cannot be part of a solid",
            "objects[0].difference.objects[2].spheres: `spheres` cannot be part of a solid",
            "objects[0].difference.objects[3].instances: `instances` cannot be part of a solid",
            "objects[0].difference.objects[5].mesh: this mesh is not closed: 3 edges do not join two triangles that face \
             the same way, so it cannot be part of a solid",
        ],
    );
    assert_problems(
        solid(Operation::Union, Vec::new()),
        &["objects[0].union.objects: `union` needs at least one object"],
    );
}

#[test]
fn instances_stay_within_what_is_usable() {
    let of = |scales| instances(vec![sphere(1.0)], vec![DVec3::ZERO; 2], scales);
    let object = |instances| Object::new(ObjectKind::Instances(instances));
    assert_problems(object(of(each(vec![1e-9, 1e9]))), &[]);
    assert_problems(
        object(Instances {
            rotations: Some(Data::inline(vec![DVec3::splat(f64::NAN)])),
            materials: vec![MaterialId(0)],
            ..of(each(vec![1.0, 0.0]))
        }),
        &[
            "objects[0].instances.rotations: rotations has 1 entry, but there are 2 positions",
            "objects[0].instances.rotations[0]: the angles of rotations must be at most 1e6 degrees (entry 1 of 1)",
            "objects[0].instances.scale[1]: scale must be above 0 (entry 2 of 2)",
            "objects[0].instances.materials[0]: there is no material 0",
        ],
    );
    // Each factor alone is fine.
    let nested = copies(vec![copies(vec![sphere(1.0)], 1, 1e6)], 1, 1e6);
    assert_eq!(problems(nested).len(), 1);
    let steps = vec![TransformStep::Scale(DVec3::splat(1e-6))];
    let small = Object { transform: Transform { steps }, ..sphere(1.0) };
    assert_problems(copies(vec![small.clone()], 1, 1e6), &[]);
    assert_eq!(problems(copies(vec![small], 1, 1e-6)).len(), 1);
    let far = Object {
        transform: Transform { steps: vec![TransformStep::Scale(DVec3::splat(1e6))] },
        ..object(instances(Vec::new(), vec![DVec3::ZERO, DVec3::splat(1e9)], Sizes::Same(1.0)))
    };
    assert_problems(
        far,
        &["objects[0].instances.positions[1]: positions, with the transforms around, are too far away (entry 2 of 2)"],
    );
}

#[test]
fn instances_of_instances_are_counted() {
    let thousands = |of| copies(of, 4000, 1.0);
    let pair = || vec![sphere(1.0), sphere(2.0)];
    assert_problems(thousands(vec![thousands(vec![sphere(1.0)])]), &[]);
    let message = "instances would place more than 20 million things";
    assert_problems(thousands(vec![thousands(pair())]), &[&format!("objects[0].instances: {message}")]);
    let bomb = (0..60).fold(sphere(1.0), |of, _| thousands(vec![of]));
    assert_problems(group(vec![bomb]), &[&format!("objects[0].group: {message}")]);
    let deep = (0..100).fold(sphere(1.0), |of, _| copies(vec![of], 1, 1.0));
    assert_eq!(problems(deep).len(), 1, "too deep");
}

#[test]
fn what_is_imported_is_checked() {
    let light = Light {
        name: None,
        color: Rgb::gray(f32::NAN),
        strength: Strength::Classic(1.0),
        kind: LightKind::Directional { direction: DVec3::X },
    };
    let camera = Some(Camera { up: DVec3::ZERO, ..Camera::default() });
    let import = Import { file: "a.glb".to_owned(), objects: vec![sphere(-1.0)], lights: vec![light], camera };
    assert_problems(
        Object::new(ObjectKind::Import(import)),
        &[
            "objects[0].import.file.objects[0].sphere.radius: radius must be above 0",
            "objects[0].import.file.lights[0].directional.color: color must be finite",
            "objects[0].import.file.camera.up: up must not be zero: it has no direction",
        ],
    );
}

#[test]
fn materials_and_images_have_usable_numbers() {
    let material = Material {
        emission: Emission::of(Rgb::gray(-1.0)),
        opacity: Paint::Color(Rgb::gray(2.0)),
        ..Material::default()
    };
    let image = ImageTexture {
        image: ImageId(0),
        mapping: Mapping::Uv,
        wrap: Wrap::Repeat,
        filter: Filter::Nearest,
        encoding: Encoding::Srgb,
        channels: Channels::Alpha,
        tint: Rgb::gray(f32::INFINITY),
    };
    let alpha = Some(durer_imaging::Alpha::F32(vec![1.0, f32::NAN]));
    let texels = durer_imaging::Texels::U8(vec![[0; 3]; 2]);
    let bitmap = durer_imaging::Bitmap { width: 1, height: 2, texels, alpha };
    let scene = Scene {
        materials: vec![material],
        textures: vec![Texture { name: None, transform: Transform::default(), pattern: Pattern::Image(image) }],
        images: vec![ImageAsset { file: "a.png".to_owned(), bitmap: Arc::new(bitmap) }],
        ..Scene::default()
    };
    let found: Vec<String> = scene.check().unwrap_err().iter().map(Problem::to_string).collect();
    assert_eq!(
        found,
        [
            "image 0: the image's pixel 0,1 is infinite or not a number",
            "texture 0.image.tint: tint must be finite",
            "material 0.emission.color: emission must not be negative",
            "material 0.opacity: opacity must not be above 1",
        ]
    );
}
