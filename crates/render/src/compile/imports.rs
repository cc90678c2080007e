//! Lights and cameras of imported files, in the world.
//!
//! Those of files that `instances` copy are left out: a thousand copies of a lamp post would be a thousand lights, and no
//! file that is copied means its camera.

use durer_math::{DAffine3, DVec3};
use durer_scene::{Camera, Focus, Lens, Light, LightKind, Object, ObjectKind, Projection};

/// What files bring to the scene beside objects.
#[derive(Default)]
pub(super) struct Brought {
    /// All lights, in the order of the objects that bring them.
    pub(super) lights: Vec<Light>,
    /// The first camera.
    pub(super) camera: Option<Camera>,
}

impl Brought {
    /// What the files among these objects bring.
    pub(super) fn by(objects: &[Object]) -> Brought {
        let mut brought = Brought::default();
        brought.add(objects, &DAffine3::IDENTITY);
        brought
    }

    fn add(&mut self, objects: &[Object], world_from_parent: &DAffine3) {
        for object in objects {
            let world = || *world_from_parent * object.transform.to_affine();
            match &object.kind {
                ObjectKind::Group(members) => self.add(members, &world()),
                ObjectKind::Import(import) => {
                    let world = world();
                    self.lights.extend(import.lights.iter().map(|light| light_in_world(light, &world)));
                    if self.camera.is_none() {
                        self.camera = import.camera.as_ref().map(|camera| camera_in_world(camera, &world));
                    }
                    self.add(&import.objects, &world);
                }
                ObjectKind::Shape(_)
                | ObjectKind::Mesh(_)
                | ObjectKind::Particles(_)
                | ObjectKind::Instances(_)
                | ObjectKind::Solid(_) => {}
            }
        }
    }
}

/// Scaling moves a light and changes neither its strength nor its angles, nor how large it is.
fn light_in_world(light: &Light, world: &DAffine3) -> Light {
    let point = |p: DVec3| world.transform_point3(p);
    let kind = match light.kind {
        LightKind::Point { position, falloff, radius } => {
            LightKind::Point { position: point(position), falloff, radius }
        }
        LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius } => {
            let (position, target) = (point(position), point(target));
            LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius }
        }
        LightKind::Directional { direction } => {
            LightKind::Directional { direction: world.transform_vector3(direction) }
        }
    };
    Light { kind, ..light.clone() }
}

/// Scaling moves a camera; what is seen by angles keeps them, what is seen in parallel grows along.
fn camera_in_world(camera: &Camera, world: &DAffine3) -> Camera {
    let (position, look_at) = (world.transform_point3(camera.position), world.transform_point3(camera.look_at));
    let up = world.transform_vector3(camera.up);
    let projection = match camera.projection {
        Projection::Orthographic { height } => {
            Projection::Orthographic { height: height * stretch_upwards(camera, world) }
        }
        same @ (Projection::FieldOfView { .. } | Projection::ImagePlane { .. }) => same,
    };
    let lens = camera.lens.map(|lens| {
        let focus = match lens.focus {
            Focus::Target(at) => Focus::Target(world.transform_point3(at)),
            same @ (Focus::LookAt | Focus::Distance(_)) => same,
        };
        Lens { focus, ..lens }
    });
    Camera { position, look_at, up, projection, lens }
}

/// By how much a map stretches what stands upright in the picture.
fn stretch_upwards(camera: &Camera, world: &DAffine3) -> f64 {
    let across = |v: DVec3, forward: DVec3| v - forward * v.dot(forward);
    let forward = camera.look_at - camera.position;
    let up = across(camera.up, forward.normalize()).normalize();
    across(world.transform_vector3(up), world.transform_vector3(forward).normalize()).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_scene::{Falloff, Import, Strength, Transform, TransformStep};

    fn import(lights: Vec<Light>, camera: Camera) -> Object {
        let import = Import { file: "a.glb".to_owned(), objects: Vec::new(), lights, camera: Some(camera) };
        let steps = vec![TransformStep::Scale(DVec3::splat(2.0)), TransformStep::Translate(DVec3::X)];
        Object { transform: Transform { steps }, ..Object::new(ObjectKind::Import(import)) }
    }

    #[test]
    fn what_is_in_a_file_moves_with_it() {
        let kind = LightKind::Point { position: DVec3::Y, falloff: Falloff::InverseSquare, radius: 0.0 };
        let kinds = [kind, LightKind::Directional { direction: DVec3::NEG_Y }];
        let light = |kind| Light { name: None, color: durer_math::Rgb::WHITE, strength: Strength::Classic(3.0), kind };
        let camera = Camera {
            position: DVec3::Z,
            up: DVec3::new(0.0, 1.0, 5.0),
            projection: Projection::Orthographic { height: 3.0 },
            ..Camera::default()
        };
        let inner = import(kinds.map(light).to_vec(), camera);
        let group = Object::new(ObjectKind::Group(vec![inner.clone(), inner]));
        let Brought { lights, camera } = Brought::by(&[group]);
        assert_eq!(lights.len(), 4);
        let position = DVec3::new(1.0, 2.0, 0.0);
        assert_eq!(lights[0].kind, LightKind::Point { position, falloff: Falloff::InverseSquare, radius: 0.0 });
        assert_eq!(lights[0].strength, Strength::Classic(3.0));
        assert_eq!(lights[1].kind, LightKind::Directional { direction: DVec3::NEG_Y * 2.0 });
        let camera = camera.expect("the first of two");
        assert_eq!((camera.position, camera.look_at), (DVec3::new(1.0, 0.0, 2.0), DVec3::new(1.0, 0.0, -2.0)));
        assert_eq!(camera.projection, Projection::Orthographic { height: 6.0 });
    }
}
