//! A stage for a model that is shown alone: a view of all of it, a ground that it stands on, and light.

mod bounds;

use super::adopt;
use bounds::{Bounds, bounds_of};
use durer_math::functions::{cos, sin, tan};
use durer_math::{DVec3, Rgb, any_orthonormal_pair};
use durer_scene::{
    Background, Camera, Classic, Fog, Light, LightKind, Material, MaterialId, MaterialKind, Object, ObjectKind, Paint,
    Picture, Projection, RenderSettings, Scene, Shape, Strength, Transform, TransformStep,
};

const WIDTH: u32 = 960;
const HEIGHT: u32 = 720;
/// The vertical angle of view, in degrees: long enough a lens that nothing looks bent.
const FIELD_OF_VIEW: f64 = 30.0;
/// Where the camera is, seen from the model: degrees to the right of its front, and above.
const VIEW: [f64; 2] = [30.0, 20.0];
/// Where the light comes from, in the same way: over the viewer's left shoulder, and weaker from the right.
const KEY: [f64; 2] = [-15.0, 52.0];
const FILL: [f64; 2] = [62.0, 40.0];
/// How much of the picture the model fills at most.
const FILLED: f64 = 0.86;
/// The key light is a cluster, so that shadows have soft edges; this many in a cone of this half-angle, in degrees.
const KEY_LIGHTS: u32 = 16;
const KEY_HALF_ANGLE: f64 = 7.0;

/// A scene that shows a model; `file` is its name. A camera and lights of its own are kept, and a model with a camera
/// is taken for a whole scene, which brings its own ground.
pub(super) fn stage(model: Scene, file: &str) -> Scene {
    let mut scene = Scene {
        camera: model.camera.clone(),
        picture: Picture { width: WIDTH, height: HEIGHT, ..Picture::default() },
        // Sixteen lights to a sample are work enough.
        render: RenderSettings { max_depth: 8, ..RenderSettings::default() },
        background: Background::Gradient { bottom: Rgb::new(0.62, 0.62, 0.63), top: Rgb::new(0.80, 0.87, 0.97) },
        lights: if model.lights.is_empty() { lights() } else { model.lights.clone() },
        ..Scene::default()
    };
    let objects = adopt(model, &mut scene);
    let bounds = bounds_of(&objects);
    let transform = if scene.camera.is_some() { Transform::default() } else { within_reach(bounds) };
    let bounds = bounds.moved(&transform.to_affine());
    let material = Some(add(&mut scene, matte(Rgb::new(0.68, 0.61, 0.54))));
    // Materials of a group stand back behind those of what is in it.
    scene.objects.push(Object { name: Some(file.to_owned()), material, transform, kind: ObjectKind::Group(objects) });
    if scene.camera.is_none() {
        let (camera, distance) = camera(bounds);
        scene.camera = Some(camera);
        scene.objects.push(ground(bounds, &mut scene.materials));
        // The ground goes over into the distance without a horizon, as in a photographer's studio.
        let (color, radius) = (Rgb::new(0.80, 0.84, 0.90), reach(bounds));
        scene.fog = Some(Fog::Linear { color, start: distance + radius, end: distance + 16.0 * radius });
    }
    scene
}

fn add(scene: &mut Scene, material: Material) -> MaterialId {
    scene.materials.push(material);
    MaterialId(scene.materials.len() as u32 - 1)
}

fn matte(color: Rgb) -> Material {
    Material::of(MaterialKind::Classic(Classic { color: Paint::Color(color), ..Classic::default() }))
}

/// What brings a model to where rays are precise and a scene may be: models tiny, huge or far from the origin move to the
/// origin and become one unit large, all others stay as they are.
fn within_reach(bounds: Bounds) -> Transform {
    let size = 2.0 * bounds.radius();
    if size == 0.0 {
        return Transform { steps: vec![TransformStep::Translate(-bounds.center())] };
    }
    let is_far = bounds.center().length() > 1e3 * size;
    let is_odd = !(1e-3..=1e6).contains(&size);
    let mut steps = Vec::new();
    if is_far || is_odd {
        steps.push(TransformStep::Translate(-bounds.center()));
    }
    if is_odd {
        // No transform may stretch more than this.
        steps.push(TransformStep::Scale(DVec3::splat((1.0 / size).clamp(1e-9, 1e9))));
    }
    Transform { steps }
}

/// The radius of what is to be seen. Of a model that is a point even when enlarged, it is the nearest that a camera may be.
fn reach(bounds: Bounds) -> f64 {
    bounds.radius().max(1e-6)
}

/// A direction by degrees to the right of +z, and above.
fn towards([azimuth, elevation]: [f64; 2]) -> DVec3 {
    let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
    DVec3::new(sin(azimuth) * cos(elevation), sin(elevation), cos(azimuth) * cos(elevation))
}

/// A camera that sees all of the bounds, and how far away it is.
fn camera(bounds: Bounds) -> (Camera, f64) {
    let back = towards(VIEW);
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let half_height = FILLED * tan((FIELD_OF_VIEW * 0.5).to_radians());
    let half_width = half_height * f64::from(WIDTH) / f64::from(HEIGHT);
    let center = bounds.center();
    // A corner is in the picture if its distance from the axis is small enough for its depth.
    let needed = |corner: DVec3| {
        let from_center = corner - center;
        let across = (from_center.dot(right).abs() / half_width).max(from_center.dot(up).abs() / half_height);
        across + from_center.dot(back)
    };
    let distance = bounds.corners().map(needed).into_iter().fold(reach(bounds), f64::max);
    let projection = Projection::FieldOfView { degrees: FIELD_OF_VIEW };
    (Camera { position: center + back * distance, look_at: center, up: DVec3::Y, projection, lens: None }, distance)
}

/// A plane just below the model: what lies flat on it should not be half in it.
fn ground(bounds: Bounds, materials: &mut Vec<Material>) -> Object {
    materials.push(matte(Rgb::gray(0.78)));
    let center = bounds.center();
    let point = DVec3::new(center.x, bounds.low.y - 2e-4 * reach(bounds), center.z);
    Object {
        name: Some("ground".to_owned()),
        material: Some(MaterialId(materials.len() as u32 - 1)),
        ..Object::new(ObjectKind::Shape(Shape::Plane { point, normal: DVec3::Y }))
    }
}

/// A key light with soft shadows, and a weak one to open them.
fn lights() -> Vec<Light> {
    let directional = |name: String, intensity, towards: DVec3| Light {
        name: Some(name),
        color: Rgb::WHITE,
        strength: Strength::Classic(intensity),
        kind: LightKind::Directional { direction: -towards },
    };
    let key = towards(KEY);
    let (a, b) = any_orthonormal_pair(key);
    // Spread evenly over a disc, along a spiral whose turns never line up (H. Vogel, 1979).
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let spread = tan(KEY_HALF_ANGLE.to_radians());
    let one_of_key = |i: u32| {
        let radius = spread * ((f64::from(i) + 0.5) / f64::from(KEY_LIGHTS)).sqrt();
        let angle = f64::from(i) * golden_angle;
        let towards = key + a * (radius * cos(angle)) + b * (radius * sin(angle));
        directional(format!("key {}", i + 1), 0.85 / KEY_LIGHTS as f32, towards)
    };
    let mut lights: Vec<Light> = (0..KEY_LIGHTS).map(one_of_key).collect();
    lights.push(directional("fill".to_owned(), 0.1, towards(FILL)));
    lights
}

#[cfg(test)]
mod tests;
