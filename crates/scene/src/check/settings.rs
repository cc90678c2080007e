//! Camera, picture, rendering, background, fog and lights.

use super::Step;
use super::values::Checker;
use crate::{
    Antialias, Background, Camera, Environment, Falloff, Focus, Fog, ImageId, Integrator, Lens, Light, LightKind,
    Material, MaterialKind, Paint, PathSettings, PixelFilter, Projection, RenderSettings, Scene, Strength,
};
use durer_math::Rgb;

/// The most rays that one ray of the eye may split into.
const MOST_RAYS: f64 = 1e8;
/// The most surfaces on a path.
const MOST_DEPTH: u32 = 1_000_000;
/// The most pixels of a picture.
const MOST_PIXELS: u64 = 400_000_000;

pub(super) fn check(c: &mut Checker<'_>) {
    let scene = c.scene;
    if let Some(eye) = &scene.camera {
        c.field("camera", |c| camera(c, eye));
    }
    c.field("picture", picture);
    c.field("render", render);
    match scene.background {
        Background::Color(color) => _ = c.light("background", color),
        Background::Gradient { bottom, top } => {
            c.field("background", |c| c.light("bottom", bottom) & c.light("top", top));
        }
        Background::Image(map) => c.field("background", |c| environment(c, map)),
    }
    c.light("ambient", scene.ambient);
    if let Some(mist) = scene.fog {
        c.field("fog", |c| fog(c, mist));
    }
    c.field("lights", |c| {
        for (at, one) in scene.lights.iter().enumerate() {
            c.at(Step::Index(at), |c| light(c, one));
        }
    });
}

pub(super) fn camera(c: &mut Checker<'_>, camera: &Camera) {
    let &Camera { position, look_at, up, projection, lens } = camera;
    let points = c.point("position", position) & c.point("look_at", look_at);
    let up_is_fine = c.direction("up", up);
    if points && c.apart(("look_at", look_at), ("position", position)) && up_is_fine {
        let view = (look_at - position).normalize();
        if view.cross(up.normalize()).length() < 1e-6 {
            let help = "for a view straight down or up, choose for example `up: [0, 0, -1]`";
            c.field("up", |c| c.problem_with_help("up must not be parallel to the view", help));
        }
    }
    match projection {
        Projection::FieldOfView { degrees } => {
            let fine = degrees > 1e-6 && degrees < 179.999_999;
            c.require(fine, "fov", format!("fov must be between 0 and 180 degrees, not {degrees}"));
        }
        Projection::ImagePlane { distance, half_height } => {
            c.field("image_plane", |c| {
                let sizes = c.size("distance", distance) & c.size("half_height", half_height);
                if sizes && !(1e-8..=1e8).contains(&(half_height / distance)) {
                    c.problem("half_height and distance differ too much");
                }
            });
        }
        Projection::Orthographic { height } => _ = c.field("orthographic", |c| c.size("height", height)),
    }
    if let Some(lens) = lens {
        c.field("lens", |c| self::lens(c, camera, lens));
    }
}

fn lens(c: &mut Checker<'_>, camera: &Camera, lens: Lens) {
    let Lens { radius, focus, blades, rotation_degrees } = lens;
    c.size("radius", radius);
    match focus {
        Focus::LookAt => {}
        Focus::Distance(distance) => _ = c.size("focus", distance),
        Focus::Target(point) => {
            if c.point("focus", point) && camera.focus_distance().is_some_and(|distance| distance < 1e-9) {
                let help = "it is a point that is to be sharp, in the space of the scene";
                c.field("focus", |c| c.problem_with_help("focus must be before the camera", help));
            }
        }
    }
    let message = format!("blades must be 0, for a round aperture, or from 3 to 64, not {blades}");
    c.require(blades == 0 || (3..=64).contains(&blades), "blades", message);
    angle(c, "rotation", rotation_degrees);
}

fn angle(c: &mut Checker<'_>, name: &'static str, degrees: f64) {
    c.require(degrees.abs() <= 1e6, name, format!("{name} must be at most 1e6 degrees"));
}

fn environment(c: &mut Checker<'_>, map: Environment) {
    let Environment { image: ImageId(id), rotation_degrees, strength } = map;
    c.require((id as usize) < c.scene.images.len(), "image", format!("there is no image {id}"));
    angle(c, "rotation", rotation_degrees);
    c.strength("strength", strength);
}

fn picture(c: &mut Checker<'_>) {
    let picture = c.scene.picture;
    let side = |c: &mut Checker<'_>, name, pixels: u32| {
        c.require((1..=65_535).contains(&pixels), name, format!("{name} must be from 1 to 65535 pixels, not {pixels}"))
    };
    let sides = side(c, "width", picture.width) & side(c, "height", picture.height);
    let pixels = u64::from(picture.width) * u64::from(picture.height);
    if sides && pixels > MOST_PIXELS {
        c.problem(format!("a picture may have at most {} million pixels, not {pixels}", MOST_PIXELS / 1_000_000));
    }
    c.within("exposure", picture.exposure.into(), -100.0, 100.0);
}

/// By how much the weights of the two rays, together, are greater than that of the ray that a surface splits; `None` if it
/// does not split any.
fn growth(material: &Material) -> Option<f64> {
    match &material.kind {
        MaterialKind::Classic(classic) => {
            let (mirrored, through) = (classic.reflection, classic.transparency);
            let splits = classic.fresnel || !(mirrored.is_black() || through.is_black());
            splits.then(|| (mirrored + through).max_component().into())
        }
        MaterialKind::Glass(_) => Some(1.0),
        // Part of the reflection, or all of it, is beside what goes through.
        MaterialKind::Principled(principled) => (principled.transmission != Paint::Color(Rgb::BLACK)).then_some(2.0),
        MaterialKind::Matte(_) | MaterialKind::Metal(_) | MaterialKind::Plastic(_) | MaterialKind::Mirror(_) => None,
    }
}

/// How many rays one ray of the eye may split into, at most: it may double at each surface; and a ray that counts less
/// than `min_weight` (in the color component where it counts most) ends, so that there are only so many on each level.
fn most_rays(scene: &Scene) -> f64 {
    let Some(growth) = scene.materials.iter().filter_map(growth).reduce(f64::max) else { return 1.0 };
    let (mut by_depth, mut by_weight) = (1.0_f64, 1.0 / f64::from(scene.render.min_weight));
    for _ in 0..scene.render.max_depth {
        (by_depth, by_weight) = (by_depth * 2.0, by_weight * growth.max(1.0));
    }
    by_depth.min(by_weight * 3.0 * f64::from(scene.render.max_depth))
}

fn render(c: &mut Checker<'_>) {
    let settings = c.scene.render;
    sampling(c, settings);
    let depth = c.within("max_depth", settings.max_depth.into(), 1.0, 100.0);
    if let (false, Integrator::Path(_)) = (depth, settings.integrator) {
        let meant = settings.max_depth.clamp(1, MOST_DEPTH);
        c.advise(format!("`path` has a `max_depth` of its own: `integrator: {{path: {{max_depth: {meant}}}}}`"));
    }
    let weight = c.within("min_weight", settings.min_weight.into(), 0.0, 1.0);
    if settings.integrator == Integrator::Whitted && depth && weight && most_rays(c.scene) > MOST_RAYS {
        let help = "lower `max_depth`, raise `min_weight`, or let `reflection` and `transparency` add up to less";
        c.field("max_depth", |c| c.problem_with_help("a ray may split into more than a hundred million rays", help));
    }
    c.field("antialias", |c| match settings.antialias {
        Antialias::None => {}
        Antialias::Grid { n } => {
            let message = format!("grid must be from 1 to 64, not {n}");
            let fine = (1..=64).contains(&n);
            c.field("grid", |c| c.require(fine, "n", message));
        }
        Antialias::Recursive { threshold, max_depth } => c.field("recursive", |c| {
            c.require((0.0..=1e6).contains(&threshold), "threshold", "threshold must be from 0 to 1e6");
            c.within("max_depth", max_depth.into(), 0.0, 10.0);
        }),
        Antialias::Adaptive { threshold, max_depth } => c.field("adaptive", |c| {
            c.within("threshold", threshold.into(), 0.0, 1.0);
            c.within("max_depth", max_depth.into(), 0.0, 7.0);
        }),
        Antialias::Pov1 { threshold, depth } => c.field("pov1", |c| pov(c, threshold, depth)),
        Antialias::Pov2 { threshold, depth } => c.field("pov2", |c| pov(c, threshold, depth)),
    });
    c.field("filter", |c| filter(c, settings.filter));
}

/// The integrator, and how much it samples.
fn sampling(c: &mut Checker<'_>, settings: RenderSettings) {
    c.field("integrator", |c| match settings.integrator {
        Integrator::Path(PathSettings { max_depth, clamp, split, reuse }) => c.field("path", |c| {
            c.within("split", split.into(), 1.0, 64.0);
            let message = format!("reuse must be 1, 4, 16 or 64, not {reuse}");
            c.require(PathSettings::REUSES.contains(&reuse), "reuse", message);
            c.within("max_depth", max_depth.into(), 1.0, MOST_DEPTH.into());
            if let Some(clamp) = clamp {
                let message = "clamp must be above 0 and at most 1e12; without it nothing is lowered";
                c.require(clamp > 0.0 && clamp <= 1e12, "clamp", message);
            }
        }),
        Integrator::AmbientOcclusion { distance: Some(distance) } => {
            c.field("ambient_occlusion", |c| _ = c.size("distance", distance));
        }
        Integrator::AmbientOcclusion { distance: None }
        | Integrator::Whitted
        | Integrator::Normals
        | Integrator::Depth
        | Integrator::Uv => {}
    });
    if let Some(samples) = settings.samples {
        c.within("samples", samples.into(), 1.0, RenderSettings::SAMPLES_LIMIT.into());
    }
    if let Some(noise) = settings.noise {
        c.within("noise", noise.into(), 1e-4, 1.0);
    }
    if let Some(time) = settings.time {
        c.within("time", time, 0.001, 1e7);
    }
    c.within("light_samples", settings.light_samples.into(), 0.0, 4096.0);
}

fn pov(c: &mut Checker<'_>, threshold: f32, depth: u32) {
    c.within("threshold", threshold.into(), 0.0, 10.0);
    c.within("depth", depth.into(), 1.0, 9.0);
}

fn filter(c: &mut Checker<'_>, filter: PixelFilter) {
    let radius = |c: &mut Checker<'_>, radius: f64| _ = c.within("radius", radius, 0.5, 8.0);
    match filter {
        PixelFilter::Box => {}
        PixelFilter::Tent { radius: r } => c.field("tent", |c| radius(c, r)),
        PixelFilter::Gaussian { radius: r, sigma } => c.field("gaussian", |c| {
            radius(c, r);
            c.within("sigma", sigma, 0.1, 8.0);
        }),
        PixelFilter::Mitchell { radius: r } => c.field("mitchell", |c| radius(c, r)),
        PixelFilter::BlackmanHarris { radius: r } => c.field("blackman_harris", |c| radius(c, r)),
    }
}

fn fog(c: &mut Checker<'_>, fog: Fog) {
    match fog {
        Fog::Exponential { color, distance } => {
            c.field("exponential", |c| c.light("color", color) & c.size("distance", distance));
        }
        Fog::Linear { color, start, end } => {
            c.field("linear", |c| {
                c.light("color", color);
                let sizes = c.size_or_zero("start", start) & c.size("end", end);
                if sizes {
                    c.require(end > start, "end", "end must be greater than start");
                }
            });
        }
    }
}

pub(super) fn light(c: &mut Checker<'_>, light: &Light) {
    let word = match light.kind {
        LightKind::Point { .. } => "point",
        LightKind::Spot { .. } => "spot",
        LightKind::Directional { .. } => "directional",
    };
    c.field(word, |c| {
        c.light("color", light.color);
        strength(c, light);
        match light.kind {
            LightKind::Point { position, falloff: _, radius } => {
                c.point("position", position);
                c.size_or_zero("radius", radius);
            }
            LightKind::Directional { direction } => _ = c.direction("direction", direction),
            LightKind::Spot {
                position,
                target,
                half_angle_degrees: edge,
                inner_half_angle_degrees: inner,
                falloff: _,
                radius,
            } => {
                c.size_or_zero("radius", radius);
                let points = c.point("position", position) & c.point("target", target);
                if points {
                    c.apart(("target", target), ("position", position));
                }
                let message = format!("half_angle must be above 0 and at most 180 degrees, not {edge}");
                if c.require(edge > 1e-6 && edge <= 180.0, "half_angle", message) {
                    let message = format!("inner_half_angle must be from 0 to half_angle, not {inner}");
                    c.require((0.0..=edge).contains(&inner), "inner_half_angle", message);
                }
            }
        }
    });
}

/// The strength of a light, in a unit that its kind can have.
fn strength(c: &mut Checker<'_>, light: &Light) {
    let falloff = match light.kind {
        LightKind::Point { falloff, .. } | LightKind::Spot { falloff, .. } => Some(falloff),
        LightKind::Directional { .. } => None,
    };
    let field = match light.strength {
        Strength::Classic(_) => "intensity",
        Strength::RadiantIntensity(_) => "radiant_intensity",
        Strength::Power(_) => "power",
        Strength::Irradiance(_) => "irradiance",
    };
    c.strength(field, light.strength.amount());
    match (light.strength, falloff) {
        (Strength::Classic(_), _)
        | (Strength::RadiantIntensity(_) | Strength::Power(_), Some(Falloff::InverseSquare))
        | (Strength::Irradiance(_), None) => {}
        (Strength::RadiantIntensity(_) | Strength::Power(_), Some(Falloff::None)) => {
            let help = "`falloff: none` goes with `intensity`";
            c.field("falloff", |c| {
                c.problem_with_help(format!("{field} weakens with the square of the distance"), help)
            });
        }
        (Strength::RadiantIntensity(_) | Strength::Power(_), None) => {
            let help = "a directional light has an `irradiance`, or a classic `intensity`";
            c.field(field, |c| c.problem_with_help(format!("a directional light has no {field}"), help));
        }
        (Strength::Irradiance(_), Some(_)) => {
            let help = "a point or spot has a `power`, a `radiant_intensity`, or a classic `intensity`";
            c.field(field, |c| c.problem_with_help("only directional lights have an irradiance", help));
        }
    }
}
