//! A hit, with all that shading needs to know about it.

use crate::compile::{Colors, CompiledScene, Origin, PlacedObject};
use crate::materials::{Material, Side, on_side, reflect};
use crate::textures::TexturePoint;
use durer_geometry::{Hit, Ray, Surface};
use durer_math::{DVec2, DVec3, Rgb, functions::pow_wide};
use durer_scene::Paint;

/// A point on a surface, seen from one side.
pub(crate) struct Shading<'a> {
    pub(crate) primitive: u32,
    pub(crate) surface: Surface,
    pub(crate) material: &'a Material,
    /// The colour there.
    pub(crate) color: Rgb,
    /// How much of the surface is there; `None` if all of it.
    pub(crate) opacity: Option<Rgb>,
    /// The direction of the ray that came here.
    pub(crate) direction: DVec3,
    /// The surface's unit normal on the side that the ray came from: rays start on either side of the surface by it.
    face: DVec3,
    /// The normal that a mesh wants, if it is another. The ray came against it, too.
    smooth: Option<DVec3>,
    /// True if the ray came from the side that the surface's own normal points to.
    pub(crate) from_outside: bool,
    /// True if the surface bounds a medium.
    pub(crate) bounds_medium: bool,
}

impl<'a> Shading<'a> {
    /// Looks up all about a hit of `ray`.
    #[inline]
    pub(crate) fn at(scene: &'a CompiledScene, ray: &Ray, hit: &Hit) -> Shading<'a> {
        Shading::of_surface(scene, ray, hit, scene.world.surface(ray, hit))
    }

    /// The same where the surface is known.
    #[inline(always)]
    pub(crate) fn of_surface(scene: &'a CompiledScene, ray: &Ray, hit: &Hit, surface: Surface) -> Shading<'a> {
        let object = &scene.objects[hit.primitive as usize];
        if object.looks.has_details() {
            return Shading::in_detail(scene, ray, hit, &surface);
        }
        let material = &scene.materials[object.looks.material as usize];
        let color = scene.textures.color(material.color, &Textured { scene, object, surface: &surface, hit });
        Shading::of(object, ray, hit, &surface, material, color)
    }

    /// The same for surfaces of which the parts differ, or that are shaded by other normals than their own, or have holes.
    #[inline(never)]
    fn in_detail(scene: &'a CompiledScene, ray: &Ray, hit: &Hit, surface: &Surface) -> Shading<'a> {
        let object = &scene.objects[hit.primitive as usize];
        let material = &scene.materials[scene.material_at(hit) as usize];
        let textured = Textured { scene, object, surface, hit };
        let mut shading = Shading::of(object, ray, hit, surface, material, textured.color(material.color));
        shading.opacity = material.opacity.map(|paint| textured.opacity(paint));
        shading.smooth = smooth_normal(scene, surface, hit, shading.face, ray.direction);
        shading
    }

    /// A whole surface, shaded as it is.
    #[inline(always)]
    fn of(
        object: &PlacedObject,
        ray: &Ray,
        hit: &Hit,
        surface: &Surface,
        material: &'a Material,
        color: Rgb,
    ) -> Shading<'a> {
        let from_outside = ray.direction.dot(surface.normal) < 0.0;
        Shading {
            primitive: hit.primitive,
            surface: *surface,
            material,
            color,
            opacity: None,
            direction: ray.direction,
            face: if from_outside { surface.normal } else { -surface.normal },
            smooth: None,
            from_outside,
            bounds_medium: object.looks.is_medium,
        }
    }

    /// True if shading goes by another normal than the surface's.
    #[inline]
    pub(crate) fn is_smooth(&self) -> bool {
        self.smooth.is_some()
    }

    /// The unit normal by which light falls and is reflected and refracted, on the side that the ray came from.
    #[inline]
    pub(crate) fn normal(&self) -> DVec3 {
        self.smooth.unwrap_or(self.face)
    }

    /// The point from which rays start on the side that the ray came from.
    pub(crate) fn origin_back(&self) -> DVec3 {
        self.surface.point + self.face * self.surface.offset
    }

    /// The ray from here in the mirrored direction, which stays on the side that the ray came from.
    pub(crate) fn mirrored(&self) -> Ray {
        self.ray_back(reflect(self.direction, self.normal()))
    }

    /// A ray from here on the side that the ray came from, in this direction or, where that would come out behind, its
    /// mirror image.
    pub(crate) fn ray_back(&self, direction: DVec3) -> Ray {
        Ray { origin: self.origin_back(), direction: self.kept_on(Side::Front, direction) }
    }

    /// True if a direction leads to the side of the surface that the ray did not come from.
    pub(crate) fn is_on_far_side(&self, direction: DVec3) -> bool {
        direction.dot(self.face) < 0.0
    }

    /// A ray from here on the far side, in this direction or, where that would come back, its mirror image.
    pub(crate) fn ray_on(&self, direction: DVec3) -> Ray {
        let direction = self.kept_on(Side::Back, direction);
        Ray { origin: self.surface.point - self.face * self.surface.offset, direction }
    }

    /// A direction found by the normal, on the side of the face that it must be on.
    fn kept_on(&self, side: Side, direction: DVec3) -> DVec3 {
        if self.smooth.is_some() { on_side(direction, self.face, side) } else { direction }
    }

    /// Between the normal and the direction to a light; not positive for a light behind the surface, whatever normal
    /// shading has.
    pub(crate) fn cosine(&self, to_light: DVec3) -> f64 {
        let above = self.face.dot(to_light);
        match self.smooth {
            Some(normal) if above > 0.0 => normal.dot(to_light),
            Some(_) | None => above,
        }
    }
}

/// Phong's highlight: how much of a light in direction `to_light` is mirrored to where the ray came from.
#[inline]
pub(crate) fn highlight(shading: &Shading<'_>, to_light: DVec3) -> f32 {
    let normal = shading.normal();
    let mirrored = normal * (2.0 * normal.dot(to_light)) - to_light;
    let cosine = -mirrored.dot(shading.direction);
    if cosine > 0.0 { pow_wide(cosine, shading.material.shininess) } else { 0.0 }
}

/// A mesh's normal at a hit, on the side of `face`, if it has one.
///
/// Near its silhouette a mesh shows triangles whose interpolated normals point away from the viewer, which no surface can
/// have that he sees. They are turned just so far that he sees them edge-on.
fn smooth_normal(scene: &CompiledScene, surface: &Surface, hit: &Hit, face: DVec3, direction: DVec3) -> Option<DVec3> {
    let normal = scene.world.shading_normal(surface.point, hit)?;
    let normal = if normal.dot(face) < 0.0 { -normal } else { normal };
    let away = normal.dot(direction);
    if away < 0.0 { Some(normal) } else { (normal - direction * away).try_normalize() }
}

/// The color at a hit of a primitive that has no details, of this material.
#[inline]
pub(crate) fn color_at(
    scene: &CompiledScene,
    hit: &Hit,
    surface: impl FnOnce() -> Surface,
    material: &Material,
) -> Rgb {
    match material.color {
        Paint::Color(color) => color,
        Paint::Texture(_) => {
            let object = &scene.objects[hit.primitive as usize];
            scene.textures.color(material.color, &Textured { scene, object, surface: &surface(), hit })
        }
    }
}

/// How much of the surface is there at a hit.
pub(crate) fn opacity_at(scene: &CompiledScene, hit: &Hit, surface: &Surface) -> Rgb {
    let object = &scene.objects[hit.primitive as usize];
    let material = &scene.materials[scene.material_at(hit) as usize];
    material.opacity.map_or(Rgb::WHITE, |paint| Textured { scene, object, surface, hit }.opacity(paint))
}

/// A hit as textures see it.
struct Textured<'a> {
    scene: &'a CompiledScene,
    object: &'a PlacedObject,
    surface: &'a Surface,
    hit: &'a Hit,
}

impl Textured<'_> {
    /// What the part that was hit comes from, if there is more to say of it.
    fn origin(&self) -> Option<&Origin> {
        Some(self.scene.details(self.hit.primitive)?.origin(self.hit.crossing.part).1)
    }

    /// Colours of the surface's own take the place of a plain colour, and multiply a texture's.
    fn color(&self, paint: Paint) -> Rgb {
        match (self.own_color(), paint) {
            (None, _) => self.scene.textures.color(paint, self),
            (Some(own), Paint::Color(_)) => own,
            (Some(own), Paint::Texture(_)) => own * self.scene.textures.color(paint, self),
        }
    }

    fn own_color(&self) -> Option<Rgb> {
        let origin = self.origin()?;
        match &origin.colors {
            Colors::None => None,
            Colors::Vertices(data) => {
                let weights = self.scene.world.vertex_weights(self.surface.point, self.hit)?;
                let corners = data.triangles[(self.hit.crossing.part - origin.first_part) as usize]
                    .map(|vertex| data.colors[vertex as usize]);
                // In triangles as thin as the rounding of a point, weights may be anything.
                let weights = weights.map(|weight| weight.clamp(0.0, 1.0) as f32);
                let weighed = corners.into_iter().zip(weights).map(|(color, weight)| color * weight);
                Some(weighed.fold(Rgb::BLACK, |sum, color| sum + color))
            }
            Colors::Particles(colors) => colors.get(self.scene.world.particle_of(self.hit)? as usize).copied(),
        }
    }

    /// From 0 to 1, whatever an image may hold.
    fn opacity(&self, paint: Paint) -> Rgb {
        self.scene.textures.color(paint, self).map(|c| if c > 0.0 { c.min(1.0) } else { 0.0 })
    }
}

impl TexturePoint for Textured<'_> {
    fn point(&self) -> DVec3 {
        let point = match &self.object.object_from_world {
            Some(map) => map.transform_point3(self.surface.point),
            None => self.surface.point,
        };
        match self.origin().and_then(|operand| operand.operand_from_solid.as_ref()) {
            Some(map) => map.transform_point3(point),
            None => point,
        }
    }

    fn uv(&self) -> DVec2 {
        self.scene.world.uv(self.surface.point, self.hit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_folded_over_to_the_side_wanted() {
        let (up, down) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.6, -0.8, 0.0));
        assert_eq!([on_side(up, DVec3::Y, Side::Front), on_side(down, DVec3::Y, Side::Front)], [up, up]);
        assert_eq!([on_side(up, DVec3::Y, Side::Back), on_side(down, DVec3::Y, Side::Back)], [down, down]);
    }
}
