//! Relief that is only shaded: normal maps and bump maps.
//!
//! Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978.

use super::{Shading, Textured, seen_by};
use crate::textures::{TexturePoint, going_on};
use durer_geometry::Surface;
use durer_math::{DMat3, DVec2, DVec3, any_orthonormal_pair};
use durer_scene::{Bump, NormalMap, Relief};

/// The step by which derivatives are taken, over the size of a shape.
const STEP: f64 = 1e-4;

/// The unit normal of the relief at a hit, on the side that the ray came from; `None` where there is none to be found.
pub(super) fn normal(relief: &Relief, textured: &Textured<'_>, shading: &Shading<'_>) -> Option<DVec3> {
    let normal = shading.normal();
    // Relief belongs to the surface: from behind, hills are hollows.
    let outward = if shading.from_outside { normal } else { -normal };
    let turned = match relief {
        Relief::NormalMap(map) => of_map(map, textured, outward)?,
        Relief::Bump(bump) => of_heights(bump, textured, outward)?,
    };
    seen_by(if shading.from_outside { turned } else { -turned }, shading.direction)
}

/// A map's vectors are along the image, up it, and along the normal, however the image lies on the surface: so it shows the same
/// relief as the heights that it is made from.
fn of_map(map: &NormalMap, textured: &Textured<'_>, normal: DVec3) -> Option<DVec3> {
    let color = textured.scene.textures.color(map.texture, textured);
    let [x, y, z] = color.to_array().map(|c| f64::from(c) * 2.0 - 1.0);
    let strength = f64::from(map.strength);
    let rise = |from: &Textured<'_>, to: &Textured<'_>| textured.scene.textures.rise(map.texture, from, to);
    let [along_u, along_v] = directions(textured, normal, rise).or_else(|| tangents(textured, normal))?;
    let x_axis = (along_u - normal * normal.dot(along_u)).try_normalize()?;
    let across = normal.cross(x_axis);
    // Where the image is mirrored, v runs the other way.
    let y_axis = if across.dot(along_v) < 0.0 { -across } else { across };
    (x_axis * (x * strength) + y_axis * (y * strength) + normal * z).try_normalize()
}

/// The normal of the surface moved by its heights, to first order: n - ∇h.
fn of_heights(bump: &Bump, textured: &Textured<'_>, normal: DVec3) -> Option<DVec3> {
    let step = step(textured);
    let height = |at: DVec3| {
        let surface = Surface { point: at, ..*textured.surface };
        let moved = Textured { surface: &surface, ..*textured };
        f64::from(textured.scene.textures.color(bump.height, &moved).luminance())
    };
    let point = textured.surface.point;
    let slope = |along: DVec3| (height(point + along * step) - height(point - along * step)) / (2.0 * step);
    let (x, y) = any_orthonormal_pair(normal);
    let stretch = match &textured.object.object_from_world {
        Some(map) => durer_math::functions::cbrt(map.matrix3.determinant().abs()),
        None => 1.0,
    };
    let gradient = (x * slope(x) + y * slope(y)) * (bump.size / stretch);
    (normal - gradient).try_normalize()
}

/// How the surface runs where u or v grows, in the world; `None` where its coordinates do not say.
pub(crate) fn tangents(textured: &Textured<'_>, normal: DVec3) -> Option<[DVec3; 2]> {
    directions(textured, normal, |from, to| going_on(to.uv() - from.uv()))
}

/// How the surface runs where one of two coordinates grows, in the world, if `rise` says how they do from point to point.
///
/// Taken numerically, so that every shape has tangents by having coordinates.
fn directions(
    textured: &Textured<'_>,
    normal: DVec3,
    rise: impl Fn(&Textured<'_>, &Textured<'_>) -> DVec2,
) -> Option<[DVec3; 2]> {
    let step = step(textured);
    let (x, y) = any_orthonormal_pair(normal);
    let point = textured.surface.point;
    let slope = |along: DVec3| {
        let [before, after] = [-step, step].map(|way| Surface { point: point + along * way, ..*textured.surface });
        let at = |surface| Textured { surface, ..*textured };
        rise(&at(&before), &at(&after)) / (2.0 * step)
    };
    let (along_x, along_y) = (slope(x), slope(y));
    let uv_from_plane = DMat3::from_cols(along_x.extend(0.0), along_y.extend(0.0), DVec3::Z);
    let determinant = uv_from_plane.determinant();
    let least = 1e-12 * along_x.length_squared().max(along_y.length_squared());
    if determinant.abs() <= least || !determinant.is_finite() {
        return None;
    }
    let plane_from_uv = uv_from_plane.inverse();
    let in_world = |along: DVec3| x * along.x + y * along.y;
    Some([in_world(plane_from_uv.x_axis), in_world(plane_from_uv.y_axis)])
}

/// A length that is small for the shape, and large for the rounding of its points.
fn step(textured: &Textured<'_>) -> f64 {
    let bounds = textured.scene.world.primitives()[textured.hit.primitive as usize].bounds();
    let size = (bounds.max - bounds.min).length();
    let size = if size.is_finite() { size } else { textured.surface.point.length().max(1.0) };
    (size * STEP).max(textured.surface.offset * 1e4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::compile;
    use durer_geometry::Ray;
    use durer_imaging::Bitmap;
    use durer_math::Rgb;
    use durer_scene::{
        ImageAsset, Mapping, Material, MaterialId, Object, ObjectKind, Paint, Scene, Shape, Texture, TextureId,
        TransformStep,
    };
    use std::sync::Arc;

    /// The normal that is seen at a point of the square from (-1, -1) to (1, 1), which faces up, from above or below.
    fn seen(relief: Relief, textures: Vec<Texture>, from_above: bool) -> DVec3 {
        seen_with(relief, textures, Vec::new(), from_above)
    }

    fn seen_with(relief: Relief, textures: Vec<Texture>, bitmaps: Vec<Arc<Bitmap>>, from_above: bool) -> DVec3 {
        let square = Shape::Rectangle { corner: DVec3::new(-1.0, 0.0, 1.0), edges: [DVec3::X * 2.0, DVec3::Z * -2.0] };
        let scene = Scene {
            materials: vec![Material { relief: Some(relief), ..Material::default() }],
            textures,
            images: bitmaps.into_iter().map(|bitmap| ImageAsset { file: "a.png".to_owned(), bitmap }).collect(),
            objects: vec![Object { material: Some(MaterialId(0)), ..Object::new(ObjectKind::Shape(square)) }],
            ..Scene::default()
        };
        let scene = compile(&scene.check().unwrap());
        let side = if from_above { 1.0 } else { -1.0 };
        let ray = Ray { origin: DVec3::new(0.2, side, 0.3), direction: DVec3::new(0.0, -side, 0.0) };
        let hit = scene.world.closest_hit(&ray, f64::INFINITY, u32::MAX, None).unwrap();
        Shading::at(&scene, &ray, &hit).normal()
    }

    fn map(color: [f32; 3], strength: f32) -> Relief {
        Relief::NormalMap(NormalMap { texture: Paint::Color(Rgb::from(color)), strength })
    }

    /// On the square u runs along x and v towards -z.
    #[test]
    fn maps_turn_normals_along_u_and_v() {
        let near = |found: DVec3, expected: DVec3| {
            assert!((found - expected.normalize()).length() < 1e-6, "{found} is not {}", expected.normalize());
        };
        near(seen(map([0.5, 0.5, 1.0], 1.0), Vec::new(), true), DVec3::Y);
        near(seen(map([0.8, 0.5, 0.9], 1.0), Vec::new(), true), DVec3::new(0.6, 0.8, 0.0));
        near(seen(map([0.5, 0.8, 0.9], 1.0), Vec::new(), true), DVec3::new(0.0, 0.8, -0.6));
        near(seen(map([0.8, 0.5, 0.9], 0.5), Vec::new(), true), DVec3::new(0.3, 0.8, 0.0));
        near(seen(map([0.8, 0.5, 0.9], 1.0), Vec::new(), false), DVec3::new(-0.6, -0.8, 0.0));
    }

    /// A height that grows from 0 to `size` between x = 0 and x = 1 is a slope of `size`.
    #[test]
    fn heights_slope() {
        let [black, white] = [0.0, 1.0].map(|gray| Paint::Color(Rgb::gray(gray)));
        let pattern = durer_scene::Pattern::Gradient {
            colors: vec![black, white],
            axis: DVec3::X,
            length: 1.0,
            wrap: durer_scene::Wrap::Clamp,
            space: durer_scene::Space::Object,
        };
        let texture = Texture { name: None, pattern, transform: Default::default() };
        let bump = Relief::Bump(Bump { height: Paint::Texture(TextureId(0)), size: 0.75 });
        let found = seen(bump, vec![texture.clone()], true);
        assert!((found - DVec3::new(-0.6, 0.8, 0.0)).length() < 1e-3, "{found}");
        // From below hills are hollows.
        let found = seen(bump, vec![texture], false);
        assert!((found - DVec3::new(0.6, -0.8, 0.0)).length() < 1e-3, "{found}");
    }

    /// A map on an image that is mirrored, turned or laid by a mapping leans where the heights do that it is made from.
    #[test]
    fn maps_lie_as_their_images_do() {
        let laid = |color: [f32; 3], mapping, transform: Vec<TransformStep>| {
            let texels = durer_imaging::Texels::F32(vec![color]);
            let bitmap = Arc::new(Bitmap { width: 1, height: 1, texels, alpha: None });
            let image = durer_scene::ImageTexture {
                image: durer_scene::ImageId(0),
                mapping,
                wrap: durer_scene::Wrap::Repeat,
                filter: durer_scene::Filter::Nearest,
                encoding: durer_scene::Encoding::Linear,
                channels: durer_scene::Channels::Color,
                tint: Rgb::WHITE,
            };
            let pattern = durer_scene::Pattern::Image(image);
            let texture = Texture { name: None, pattern, transform: durer_scene::Transform { steps: transform } };
            let map = NormalMap { texture: Paint::Texture(TextureId(0)), strength: 1.0 };
            seen_with(Relief::NormalMap(map), vec![texture], vec![bitmap], true)
        };
        let near = |found: DVec3, expected: DVec3| {
            assert!((found - expected).length() < 1e-6, "{found} is not {expected}");
        };
        let along_u = [0.8, 0.5, 0.9];
        let turn = |degrees| vec![TransformStep::Rotate { axis: DVec3::Z, degrees }];
        near(laid(along_u, Mapping::Uv, Vec::new()), DVec3::new(0.6, 0.8, 0.0));
        near(
            laid(along_u, Mapping::Uv, vec![TransformStep::Scale(DVec3::new(-1.0, 1.0, 1.0))]),
            DVec3::new(-0.6, 0.8, 0.0),
        );
        near(
            laid([0.5, 0.8, 0.9], Mapping::Uv, vec![TransformStep::Scale(DVec3::new(-3.0, 2.0, 1.0))]),
            DVec3::new(0.0, 0.8, -0.6),
        );
        near(laid(along_u, Mapping::Uv, turn(90.0)), DVec3::new(0.0, 0.8, -0.6));
        // Straight down y: the image's own x runs along x, and its y along z.
        let lying = vec![TransformStep::Rotate { axis: DVec3::X, degrees: 90.0 }];
        near(laid([0.5, 0.8, 0.9], Mapping::Planar, lying), DVec3::new(0.0, 0.8, 0.6));
    }
}
