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
