//! Relief that is only shaded: normal maps and bump maps.
//!
//! Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978.

use super::{Shading, Textured, seen_by};
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

/// A map's vectors are along u, v and the normal.
fn of_map(map: &NormalMap, textured: &Textured<'_>, normal: DVec3) -> Option<DVec3> {
    let color = textured.scene.textures.color(map.texture, textured);
    let [x, y, z] = color.to_array().map(|c| f64::from(c) * 2.0 - 1.0);
    let strength = f64::from(map.strength);
    let [along_u, along_v] = tangents(textured, normal)?;
    let x_axis = (along_u - normal * normal.dot(along_u)).try_normalize()?;
    let across = normal.cross(x_axis);
    // Where a texture is mirrored, v runs the other way.
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
///
/// Taken numerically, so that every shape has tangents by having coordinates.
pub(crate) fn tangents(textured: &Textured<'_>, normal: DVec3) -> Option<[DVec3; 2]> {
    let step = step(textured);
    let (x, y) = any_orthonormal_pair(normal);
    let point = textured.surface.point;
    let slope = |along: DVec3| {
        let uv = |at: DVec3| textured.scene.world.uv(at, textured.hit);
        let rise = uv(point + along * step) - uv(point - along * step);
        // Where coordinates begin anew, as behind a sphere, they have gone on.
        let unwrapped = |rise: f64| if rise.abs() > 0.5 && rise.abs() < 1.0 { rise - rise.round() } else { rise };
        DVec2::new(unwrapped(rise.x), unwrapped(rise.y)) / (2.0 * step)
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
    use durer_math::Rgb;
    use durer_scene::{Material, MaterialId, Object, ObjectKind, Paint, Scene, Shape, Texture, TextureId};

    /// The normal that is seen at a point of the square from (-1, -1) to (1, 1), which faces up, from above or below.
    fn seen(relief: Relief, textures: Vec<Texture>, from_above: bool) -> DVec3 {
        let square = Shape::Rectangle { corner: DVec3::new(-1.0, 0.0, 1.0), edges: [DVec3::X * 2.0, DVec3::Z * -2.0] };
        let scene = Scene {
            materials: vec![Material { relief: Some(relief), ..Material::default() }],
            textures,
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
}
