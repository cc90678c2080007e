//! Scenes that must look the same: scaled, turned, renamed.

use durer::math::{DAffine3, DMat3, DVec3, Rgb, rotation};
use durer::scene::{
    Background, Camera, Falloff, Focus, Fog, Lens, Light, LightKind, Object, ObjectKind, Projection, Scene, Transform,
    TransformStep,
};

/// The scene with every length multiplied: places, sizes, distances of fog and media; and lamps that weaken with the square
/// of the distance are brighter by the square.
pub fn scaled(mut scene: Scene, factor: f64) -> Scene {
    let map = DAffine3::from_scale(DVec3::splat(factor));
    scene.objects = vec![around(scene.objects, TransformStep::Scale(DVec3::splat(factor)))];
    scene.camera = scene.camera.map(|camera| Camera {
        projection: bigger(camera.projection, factor),
        lens: camera.lens.map(|lens| larger(lens, factor)),
        ..seen(&camera, &map)
    });
    scene.lights = scene.lights.into_iter().map(|light| brighter(lit(light, &map), factor)).collect();
    scene.fog = scene.fog.map(|fog| match fog {
        Fog::Exponential { color, distance } => Fog::Exponential { color, distance: distance * factor },
        Fog::Linear { color, start, end } => Fog::Linear { color, start: start * factor, end: end * factor },
    });
    for attenuation in scene.materials.iter_mut().filter_map(|material| material.attenuation_mut()) {
        attenuation.distance *= factor;
    }
    scene
}

/// The scene turned about an axis through the origin, as it looks before a background of one color.
pub fn turned(mut scene: Scene, axis: DVec3, degrees: f64) -> Scene {
    let map = DAffine3::from_mat3(rotation(axis.normalize(), degrees.to_radians()));
    scene.objects = vec![around(scene.objects, TransformStep::Rotate { axis, degrees })];
    scene.camera = scene.camera.map(|camera| seen(&camera, &map));
    scene.lights = scene.lights.into_iter().map(|light| lit(light, &map)).collect();
    scene
}

/// With a background that looks the same in all directions.
pub fn with_plain_background(mut scene: Scene) -> Scene {
    scene.background = Background::Color(match scene.background {
        Background::Color(color) | Background::Gradient { bottom: color, .. } => color,
        Background::Image(map) => Rgb::gray(map.strength.min(1.0)),
    });
    scene
}

/// Everything that may have a name has another one.
pub fn renamed(mut scene: Scene, name: &str) -> Scene {
    fn all(objects: &mut [Object], name: &str) {
        for (at, object) in objects.iter_mut().enumerate() {
            object.name = Some(format!("{name} {at}"));
            match &mut object.kind {
                ObjectKind::Group(members) => all(members, name),
                ObjectKind::Instances(copies) => all(&mut copies.objects, name),
                ObjectKind::Import(import) => all(&mut import.objects, name),
                ObjectKind::Solid(solid) => all(&mut solid.operands, name),
                ObjectKind::Shape(_) | ObjectKind::Mesh(_) | ObjectKind::Particles(_) => {}
            }
        }
    }
    all(&mut scene.objects, name);
    let label = |at: usize| Some(format!("{name} {at}"));
    scene.materials.iter_mut().enumerate().for_each(|(at, material)| material.name = label(at));
    scene.textures.iter_mut().enumerate().for_each(|(at, texture)| texture.name = label(at));
    scene.lights.iter_mut().enumerate().for_each(|(at, light)| light.name = label(at));
    scene
}

/// The scene, its picture moved by a part of a pixel: what lies just beside each place that was looked at.
pub fn nudged(mut scene: Scene, right: f64, down: f64) -> Scene {
    if let Some(camera) = &mut scene.camera {
        let height = f64::from(scene.picture.height);
        let forward = (camera.look_at - camera.position).normalize();
        let to_right = forward.cross(camera.up).normalize();
        let to_top = to_right.cross(forward);
        let (half_height, is_parallel) = match camera.projection {
            Projection::FieldOfView { degrees } => (durer::math::functions::tan((degrees * 0.5).to_radians()), false),
            Projection::ImagePlane { distance, half_height } => (half_height / distance, false),
            Projection::Orthographic { height } => (height * 0.5, true),
        };
        let pixel = 2.0 * half_height / height;
        let by = (to_right * right - to_top * down) * pixel;
        if is_parallel {
            camera.position += by;
            camera.look_at += by;
        } else {
            camera.look_at += by * (camera.look_at - camera.position).length();
        }
    }
    scene
}

fn around(objects: Vec<Object>, step: TransformStep) -> Object {
    Object { transform: Transform { steps: vec![step] }, ..Object::new(ObjectKind::Group(objects)) }
}

/// Distances in the world; angles stay.
fn bigger(projection: Projection, factor: f64) -> Projection {
    match projection {
        Projection::FieldOfView { degrees } => Projection::FieldOfView { degrees },
        Projection::ImagePlane { distance, half_height } => {
            Projection::ImagePlane { distance: distance * factor, half_height: half_height * factor }
        }
        Projection::Orthographic { height } => Projection::Orthographic { height: height * factor },
    }
}

fn larger(lens: Lens, factor: f64) -> Lens {
    let focus = match lens.focus {
        Focus::LookAt => Focus::LookAt,
        Focus::Distance(distance) => Focus::Distance(distance * factor),
        Focus::Target(point) => Focus::Target(point * factor),
    };
    Lens { radius: lens.radius * factor, focus, ..lens }
}

fn seen(camera: &Camera, map: &DAffine3) -> Camera {
    Camera {
        position: map.transform_point3(camera.position),
        look_at: map.transform_point3(camera.look_at),
        up: direction(&map.matrix3, camera.up),
        projection: camera.projection,
        lens: camera.lens.map(|lens| match lens.focus {
            Focus::Target(point) => Lens { focus: Focus::Target(map.transform_point3(point)), ..lens },
            Focus::LookAt | Focus::Distance(_) => lens,
        }),
    }
}

fn lit(light: Light, map: &DAffine3) -> Light {
    let kind = match light.kind {
        LightKind::Point { position, falloff, radius } => {
            LightKind::Point { position: map.transform_point3(position), falloff, radius }
        }
        LightKind::Spot { position, target, half_angle_degrees, inner_half_angle_degrees, falloff, radius } => {
            LightKind::Spot {
                position: map.transform_point3(position),
                target: map.transform_point3(target),
                half_angle_degrees,
                inner_half_angle_degrees,
                falloff,
                radius,
            }
        }
        LightKind::Directional { direction: towards } => {
            LightKind::Directional { direction: direction(&map.matrix3, towards) }
        }
    };
    Light { kind, ..light }
}

/// A direction of the same length.
fn direction(map: &DMat3, direction: DVec3) -> DVec3 {
    (*map * direction).normalize() * direction.length()
}

fn brighter(light: Light, factor: f64) -> Light {
    let weakens = match light.kind {
        LightKind::Point { falloff, .. } | LightKind::Spot { falloff, .. } => falloff == Falloff::InverseSquare,
        LightKind::Directional { .. } => false,
    };
    let more = if weakens { (factor * factor) as f32 } else { 1.0 };
    let mut light = light;
    if let LightKind::Point { radius, .. } | LightKind::Spot { radius, .. } = &mut light.kind {
        *radius *= factor;
    }
    Light { strength: light.strength.with_amount(light.strength.amount() * more), ..light }
}
