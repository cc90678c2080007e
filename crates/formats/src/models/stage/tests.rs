use super::*;
use durer_scene::{Mesh, MeshData, MeshNormals};
use std::sync::Arc;

fn model(origin: DVec3, positions: &[[f32; 3]]) -> Scene {
    let data = MeshData {
        origin,
        positions: positions.to_vec(),
        triangles: (2..positions.len() as u32).map(|i| [0, i - 1, i]).collect(),
        ..MeshData::default()
    };
    let mesh = Mesh { file: None, normals: MeshNormals::File, data: Arc::new(data) };
    let objects = vec![Object::new(ObjectKind::Mesh(mesh))];
    Scene { objects, lights: Vec::new(), ..Scene::default() }
}

/// How far out in the picture the outermost vertex is, 1 being the edge; all must be in front of the camera.
fn outermost(scene: &Scene) -> f64 {
    let camera = scene.camera.as_ref().unwrap();
    let Projection::FieldOfView { degrees } = camera.projection else { panic!("perspective") };
    let forward = (camera.look_at - camera.position).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let tangent = tan((degrees * 0.5).to_radians());
    let aspect = f64::from(scene.picture.width) / f64::from(scene.picture.height);
    let ObjectKind::Group(members) = &scene.objects[0].kind else { panic!("a group") };
    let ObjectKind::Mesh(mesh) = &members[0].kind else { panic!("a mesh") };
    let world = scene.objects[0].transform.to_affine();
    let places = mesh.data.positions.iter().map(|p| mesh.data.origin + DVec3::from_array(p.map(f64::from)));
    let out = places.map(|place| {
        let to = world.transform_point3(place) - camera.position;
        let depth = to.dot(forward);
        assert!(depth > 0.0);
        (to.dot(right).abs() / (depth * tangent * aspect)).max(to.dot(up).abs() / (depth * tangent))
    });
    out.fold(0.0, f64::max)
}

#[test]
fn models_of_all_sizes_are_framed() {
    let slab = [[-3.0, 0.0, -1.0], [3.0, 0.0, -1.0], [3.0, 0.5, 1.0], [-3.0, 0.5, 1.0]];
    let flat = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.0, 9.0], [0.0, 0.0, 9.0]];
    let needle = [[0.0, -5.0, 0.0], [1e-3, 0.0, 0.0], [0.0, 5.0, 0.0]];
    let cube = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    for shape in [&slab[..], &flat, &needle, &cube] {
        for scale in [1e-12, 1e-8, 1e-3, 1.0, 1e5, 1e10] {
            for distance in [0.0, 1.0, 1e6] {
                let origin = DVec3::new(distance * scale, -distance * scale, 0.5 * distance * scale);
                let positions: Vec<[f32; 3]> = shape.iter().map(|p| p.map(|x: f64| (x * scale) as f32)).collect();
                let staged = stage(model(origin, &positions), "x.ply");
                let out = outermost(&staged);
                assert!((0.2..=FILLED + 1e-6).contains(&out), "{out} at {scale}, {distance}");
            }
        }
    }
}

#[test]
fn usual_models_stay_where_they_are_and_stand_on_the_ground() {
    let staged = stage(model(DVec3::ZERO, &[[0.0, -2.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 1.0]]), "x.ply");
    assert!(staged.objects[0].transform.steps.is_empty());
    assert_eq!(staged.objects[0].name.as_deref(), Some("x.ply"));
    let ObjectKind::Shape(Shape::Plane { point, normal }) = staged.objects[1].kind else { panic!("a plane") };
    assert!(normal == DVec3::Y && point.y < -2.0 && point.y > -2.01);
    let camera = staged.camera.unwrap();
    let back = camera.position - camera.look_at;
    assert!((back.normalize().y - sin(20_f64.to_radians())).abs() < 1e-12);
    assert!((back.x / back.z - tan(30_f64.to_radians())).abs() < 1e-12 && back.z > 0.0);
}

#[test]
fn light_comes_from_above_and_is_not_too_much() {
    let lights = lights();
    assert_eq!(lights.len(), KEY_LIGHTS as usize + 1);
    let mut upwards = 0.0;
    for light in &lights {
        let LightKind::Directional { direction } = light.kind else { panic!("directional") };
        assert!(direction.y < 0.0);
        let towards_key = (-direction).normalize().dot(towards(KEY));
        let is_key = light.name.as_ref().unwrap().starts_with("key");
        assert_eq!(is_key, towards_key >= cos(KEY_HALF_ANGLE.to_radians()) - 1e-12);
        upwards -= f64::from(light.classic_intensity()) * direction.normalize().y;
    }
    // With the ambient light, the ground is bright, but not white.
    assert!((0.5..1.0).contains(&upwards), "{upwards}");
}

#[test]
fn what_the_model_brings_is_kept() {
    let mut with_camera = model(DVec3::ZERO, &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let mut lamp = lights().remove(3);
    lamp.name = None;
    with_camera.camera = Some(Camera::default());
    with_camera.lights = vec![lamp.clone()];
    with_camera.materials = vec![matte(Rgb::BLACK)];
    with_camera.objects[0].material = Some(MaterialId(0));
    let staged = stage(with_camera, "x.glb");
    assert_eq!((staged.camera, staged.lights), (Some(Camera::default()), vec![lamp]));
    assert_eq!((staged.objects.len(), staged.fog), (1, None));
    let ObjectKind::Group(members) = &staged.objects[0].kind else { panic!("a group") };
    assert_eq!(members[0].material, Some(MaterialId(0)));
    assert_eq!(staged.materials[0], matte(Rgb::BLACK));
}
