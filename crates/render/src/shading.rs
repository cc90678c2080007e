//! A hit, with all that shading needs to know about it.

use crate::compile::{CompiledScene, PlacedObject};
use crate::materials::Material;
use crate::textures::TexturePoint;
use durer_geometry::{Hit, Ray, Surface};
use durer_math::{DVec2, DVec3, Rgb, functions::pow_wide};

/// A point on a surface, seen from one side.
pub(crate) struct Shading<'a> {
    pub(crate) primitive: u32,
    pub(crate) surface: Surface,
    pub(crate) material: &'a Material,
    /// The texture's colour.
    pub(crate) color: Rgb,
    /// The direction of the ray that came here.
    pub(crate) direction: DVec3,
    /// The unit normal on the side that the ray came from.
    pub(crate) normal: DVec3,
    /// True if that is the side that the surface's own normal points to.
    pub(crate) from_outside: bool,
    /// True if the surface bounds a medium.
    pub(crate) bounds_medium: bool,
}

impl<'a> Shading<'a> {
    /// Looks up all about a hit of `ray`.
    #[inline]
    pub(crate) fn at(scene: &'a CompiledScene, ray: &Ray, hit: &Hit) -> Shading<'a> {
        let surface = scene.world.surface(ray, hit);
        let object = &scene.objects[hit.primitive as usize];
        let material = &scene.materials[object.material as usize];
        let color = scene.textures.color(material.color, &Textured { scene, object, surface: &surface, hit });
        let from_outside = ray.direction.dot(surface.normal) < 0.0;
        let normal = if from_outside { surface.normal } else { -surface.normal };
        let (primitive, direction, bounds_medium) = (hit.primitive, ray.direction, object.is_medium);
        Shading { primitive, surface, material, color, direction, normal, from_outside, bounds_medium }
    }

    /// The point from which rays start on the side that the ray came from.
    pub(crate) fn origin_back(&self) -> DVec3 {
        self.surface.point + self.normal * self.surface.offset
    }

    /// A ray from here on the side that the ray came from.
    pub(crate) fn ray_back(&self, direction: DVec3) -> Ray {
        Ray { origin: self.origin_back(), direction }
    }

    /// A ray from here on the far side.
    pub(crate) fn ray_on(&self, direction: DVec3) -> Ray {
        Ray { origin: self.surface.point - self.normal * self.surface.offset, direction }
    }
}

/// Phong's highlight: how much of a light in direction `to_light` is mirrored to where the ray came from.
#[inline]
pub(crate) fn highlight(shading: &Shading<'_>, to_light: DVec3) -> f32 {
    let mirrored = shading.normal * (2.0 * shading.normal.dot(to_light)) - to_light;
    let cosine = -mirrored.dot(shading.direction);
    if cosine > 0.0 { pow_wide(cosine, shading.material.shininess) } else { 0.0 }
}

/// A hit as textures see it.
struct Textured<'a> {
    scene: &'a CompiledScene,
    object: &'a PlacedObject,
    surface: &'a Surface,
    hit: &'a Hit,
}

impl TexturePoint for Textured<'_> {
    fn point(&self) -> DVec3 {
        match &self.object.object_from_world {
            Some(map) => map.transform_point3(self.surface.point),
            None => self.surface.point,
        }
    }

    fn uv(&self) -> DVec2 {
        self.scene.world.uv(self.surface.point, self.hit)
    }
}
