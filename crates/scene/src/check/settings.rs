//! Camera, picture, rendering, background, fog and lights.

use super::Step;
use super::values::Checker;
use crate::{Antialias, Background, Camera, Fog, Light, LightKind, Material, PixelFilter, Projection, Scene};

/// The most rays that one ray of the eye may split into.
const MOST_RAYS: f64 = 1e8;
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
    let &Camera { position, look_at, up, projection } = camera;
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
}

/// How many rays one ray of the eye may split into, at most: it may double at each surface; and a ray that counts less
/// than `min_weight` (in the color component where it counts most) ends, so that there are only so many on each level.
fn most_rays(scene: &Scene) -> f64 {
    let splits = |m: &&Material| m.fresnel || !(m.reflection.is_black() || m.transparency.is_black());
    let sum = |m: &Material| (m.reflection + m.transparency).max_component().into();
    let Some(growth) = scene.materials.iter().filter(splits).map(sum).reduce(f64::max) else { return 1.0 };
    let (mut by_depth, mut by_weight) = (1.0_f64, 1.0 / f64::from(scene.render.min_weight));
    for _ in 0..scene.render.max_depth {
        (by_depth, by_weight) = (by_depth * 2.0, by_weight * growth.max(1.0));
    }
    by_depth.min(by_weight * 3.0 * f64::from(scene.render.max_depth))
}

fn render(c: &mut Checker<'_>) {
    let settings = c.scene.render;
    let depth = c.within("max_depth", settings.max_depth.into(), 1.0, 100.0);
    let weight = c.within("min_weight", settings.min_weight.into(), 0.0, 1.0);
    if depth && weight && most_rays(c.scene) > MOST_RAYS {
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
        c.strength("intensity", light.intensity);
        match light.kind {
            LightKind::Point { position, falloff: _ } => _ = c.point("position", position),
            LightKind::Directional { direction } => _ = c.direction("direction", direction),
            LightKind::Spot {
                position,
                target,
                half_angle_degrees: edge,
                inner_half_angle_degrees: inner,
                falloff: _,
            } => {
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
