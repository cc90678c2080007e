//! A hit, with all that shading needs to know about it.

mod relief;
mod textured;

use crate::bsdf::Bsdf;
use crate::compile::{CompiledScene, OPAQUE, PlacedObject};
use crate::frame::Frame;
use crate::materials::{Material, Side, on_side, reflect};
use crate::surfaces::Indices;
use durer_geometry::{Hit, Ray, Surface};
use durer_math::{DVec3, Rgb, functions::pow_wide};
use durer_scene::Paint;

pub(crate) use relief::tangents;
pub(crate) use textured::{Textured, within_one};

/// The sine of the flattest angle under which normals that are not the surface's own are seen.
const FLAT: f64 = 1e-3;

/// A point on a surface, seen from one side.
#[derive(Clone, Copy)]
pub(crate) struct Shading<'a> {
    pub(crate) hit: Hit,
    pub(crate) primitive: u32,
    pub(crate) surface: Surface,
    pub(crate) material: &'a Material,
    /// Its index in the scene.
    pub(crate) material_id: u32,
    /// The colour there.
    pub(crate) color: Rgb,
    /// How much of the surface is there; `None` if all of it.
    pub(crate) opacity: Option<Rgb>,
    /// Light that it gives off by itself to where the ray came from.
    pub(crate) emission: Rgb,
    /// The direction of the ray that came here.
    pub(crate) direction: DVec3,
    /// The surface's unit normal on the side that the ray came from: rays start on either side of the surface by it.
    face: DVec3,
    /// What a mesh or relief wants, if its normal is another.
    smooth: Option<Smooth>,
    /// True if the ray came from the side that the surface's own normal points to.
    pub(crate) from_outside: bool,
    /// True if the surface bounds a medium.
    pub(crate) bounds_medium: bool,
}

/// A surface that is shaded as if it were another.
#[derive(Clone, Copy)]
struct Smooth {
    /// The unit normal by which it is shaded. The ray came against it.
    normal: DVec3,
    /// The same without relief.
    ground: DVec3,
    /// The normal of the plane from behind which no light comes: the ground's, or the face's.
    horizon: DVec3,
    /// From the surface to where rays start that come back from it.
    lift: DVec3,
}

impl Smooth {
    /// As it is where nothing can be said but the normal.
    fn flat(normal: DVec3, face: DVec3) -> Smooth {
        Smooth { normal, ground: normal, horizon: face, lift: DVec3::ZERO }
    }
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
        let id = object.looks.material;
        let material = &scene.materials[id as usize];
        let textured = Textured { scene, object, surface: &surface, hit };
        let color = scene.textures.color(material.color, &textured);
        let mut shading = Shading::of(object, ray, hit, &surface, (id, material), color);
        if material.glows(shading.from_outside) {
            shading.emission = textured.emission(material);
        }
        shading
    }

    /// The same for surfaces of which the parts differ, or that are shaded by other normals than their own, or have holes.
    #[inline(never)]
    fn in_detail(scene: &'a CompiledScene, ray: &Ray, hit: &Hit, surface: &Surface) -> Shading<'a> {
        let object = &scene.objects[hit.primitive as usize];
        let id = scene.material_at(hit);
        let material = &scene.materials[id as usize];
        let textured = Textured { scene, object, surface, hit };
        let mut shading = Shading::of(object, ray, hit, surface, (id, material), textured.color(material.color));
        shading.opacity = material.opacity.map(|paint| textured.opacity(paint));
        if material.glows(shading.from_outside) {
            shading.emission = textured.emission(material);
        }
        shading.smooth = smooth_normal(scene, surface, hit, shading.face, ray.direction)
            .map(|normal| rounded(scene, &shading, normal).unwrap_or(Smooth::flat(normal, shading.face)));
        if let Some(relief) = &material.relief
            && let Some(normal) = relief::normal(relief, &textured, &shading)
        {
            let ground = shading.smooth.unwrap_or(Smooth::flat(shading.face, shading.face));
            shading.smooth = Some(Smooth { normal, ..ground });
        }
        shading
    }

    /// A whole surface, shaded as it is.
    #[inline(always)]
    fn of(
        object: &PlacedObject,
        ray: &Ray,
        hit: &Hit,
        surface: &Surface,
        (material_id, material): (u32, &'a Material),
        color: Rgb,
    ) -> Shading<'a> {
        let from_outside = ray.direction.dot(surface.normal) < 0.0;
        Shading {
            hit: *hit,
            primitive: hit.primitive,
            surface: *surface,
            material,
            material_id,
            color,
            opacity: None,
            emission: Rgb::BLACK,
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
        match &self.smooth {
            Some(smooth) => smooth.normal,
            None => self.face,
        }
    }

    /// Which part of the primitive was hit.
    pub(crate) fn part(&self) -> u32 {
        self.hit.crossing.part
    }

    /// The surface's unit normal on the side that the ray came from.
    pub(crate) fn face(&self) -> DVec3 {
        self.face
    }

    /// True if who looks along this direction, to the same side, sees it shaded by the same normal: where normals that are not the
    /// surface's own are seen edge-on or from behind, they are [turned](seen_by).
    pub(crate) fn is_same_along(&self, direction: DVec3) -> bool {
        let Some(Smooth { normal, ground, .. }) = &self.smooth else { return true };
        normal.dot(direction) < -FLAT && ground.dot(direction) < -FLAT
    }

    /// The normal of the plane from behind which no light comes to the side that the ray came from.
    #[inline]
    fn horizon(&self) -> DVec3 {
        match &self.smooth {
            Some(smooth) => smooth.horizon,
            None => self.face,
        }
    }

    /// The point from which rays start on the side that the ray came from.
    pub(crate) fn origin_back(&self) -> DVec3 {
        let point = self.surface.point + self.face * self.surface.offset;
        match &self.smooth {
            Some(smooth) => point + smooth.lift,
            None => point,
        }
    }

    /// The ray from here in the mirrored direction, which stays on the side that the ray came from.
    pub(crate) fn mirrored(&self) -> Ray {
        self.ray_back(reflect(self.direction, self.normal()))
    }

    /// A ray from here on the side that the ray came from, in this direction or, where that would come out behind, its
    /// mirror image.
    pub(crate) fn ray_back(&self, direction: DVec3) -> Ray {
        Ray { origin: self.origin_back(), direction: self.kept_on(Side::Front, self.horizon(), direction) }
    }

    /// True if a direction leads to the side of the surface that the ray did not come from.
    pub(crate) fn is_on_far_side(&self, direction: DVec3) -> bool {
        direction.dot(self.horizon()) < 0.0
    }

    /// A ray from here on the far side, in this direction or, where that would come back, its mirror image.
    pub(crate) fn ray_on(&self, direction: DVec3) -> Ray {
        let direction = self.kept_on(Side::Back, self.face, direction);
        Ray { origin: self.surface.point - self.face * self.surface.offset, direction }
    }

    /// A direction found by the normal, on the side of a plane that it must be on.
    fn kept_on(&self, side: Side, plane: DVec3, direction: DVec3) -> DVec3 {
        if self.smooth.is_some() { on_side(direction, plane, side) } else { direction }
    }

    /// How light is scattered here, between media of these indices of refraction, and the frame in which it is.
    pub(crate) fn scattering(&self, scene: &CompiledScene, indices: Indices) -> (Frame, Bsdf) {
        let object = &scene.objects[self.primitive as usize];
        let textured = Textured { scene, object, surface: &self.surface, hit: &self.hit };
        scene.scatterings[self.material_id as usize].at(self, &textured, indices)
    }

    /// The part of white light from everywhere that the surface gives back or lets through, about, as if nothing were before it.
    pub(crate) fn albedo(&self, scene: &CompiledScene) -> Rgb {
        let behind = self.bounds_medium.then(|| scene.material(self.primitive).ior.unwrap_or(1.0));
        let (frame, bsdf) = self.scattering(scene, Indices { before: 1.0, behind });
        within_one(bsdf.albedo(self.out_in(&frame)))
    }

    /// True if there is nothing to see where what it is filled with makes no difference.
    pub(crate) fn is_only_a_boundary(&self, scene: &CompiledScene) -> bool {
        scene.scatterings[self.material_id as usize].is_only_a_boundary()
    }

    /// What goes straight through a sheet in the midst of a medium of this index of refraction.
    pub(crate) fn straight(&self, scene: &CompiledScene, around: f64) -> Rgb {
        let (frame, bsdf) = self.scattering(scene, Indices { before: around, behind: None });
        bsdf.straight(self.out_in(&frame))
    }

    /// The direction to where the ray came from, in a frame around the normal. Normals that are not the surface's own may be
    /// seen edge-on or from behind, by a hair: there the surface is taken to be seen at a flat angle.
    pub(crate) fn out_in(&self, frame: &Frame) -> DVec3 {
        let out = frame.to_local(-self.direction);
        if self.smooth.is_some() && out.z < FLAT { DVec3::new(out.x, out.y, FLAT).normalize() } else { out }
    }

    /// Between the normal and the direction to a light; not positive for a light behind the surface, whatever normal
    /// shading has. Where that ends before the normal's own half of space does, it goes to 0 [smoothly](Shading::kept).
    pub(crate) fn cosine(&self, to_light: DVec3) -> f64 {
        let above = self.horizon().dot(to_light);
        match &self.smooth {
            Some(smooth) if above > 0.0 => smooth.normal.dot(to_light) * self.kept(to_light),
            Some(_) | None => above,
        }
    }

    /// What is kept of light from a direction before the surface where there is relief that is only shaded; 1 where there is
    /// none, and in most directions where there is.
    ///
    /// Relief that leans to a light still turns black where the light sinks behind the surface, along hard lines. So light is
    /// taken away little by little before that, as from relief that shadows itself: Chiang, Li and Burley, "Taming the Shadow
    /// Terminator", SIGGRAPH 2019 Talks. Nothing gives back more than it gets, and both ways to find light take the same away.
    /// (For meshes, whose true planes change from triangle to triangle, it would make all of these visible; those are
    /// [rounded].)
    #[inline]
    pub(crate) fn kept(&self, direction: DVec3) -> f64 {
        let Some(Smooth { normal, ground, .. }) = &self.smooth else { return 1.0 };
        if normal == ground {
            return 1.0;
        }
        let above = ground.dot(direction);
        let most = normal.dot(direction) * normal.dot(*ground);
        if above <= 0.0 {
            return 0.0;
        }
        if above >= most {
            return 1.0;
        }
        // The paper's ratio of cosines, and its curve, which is flat where the ratio gets to 1.
        let open = above / most;
        open * (1.0 + open * (1.0 - open))
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

/// A hit of a mesh whose corners bend away, shaded with this normal: light that still comes over the rounder surface that its
/// normals tell of is not cut off by the triangle's plane, and rays start from there so that no other triangle of it is in their
/// way (Hanika 2021, see [`durer_geometry::Primitive::lift`]). What something opaque would be between, as where two touch,
/// stays as it is, and so does what light passes.
fn rounded(scene: &CompiledScene, shading: &Shading<'_>, normal: DVec3) -> Option<Smooth> {
    let looks = &scene.objects[shading.primitive as usize].looks;
    if looks.is_medium || looks.is_clear {
        return None;
    }
    let Surface { point, offset, .. } = shading.surface;
    let primitive = &scene.world.primitives()[shading.primitive as usize];
    let lift = primitive.lift(point, shading.hit.crossing.part, normal)?;
    let length = lift.length();
    if length <= offset || lift.dot(shading.face) <= 0.0 {
        return None;
    }
    let way = Ray { origin: point + shading.face * offset, direction: lift / length };
    let is_free = !scene.world.any_hit(&way, length, None, |_, primitive| primitive.mask & OPAQUE != 0);
    is_free.then_some(Smooth { normal, ground: normal, horizon: normal, lift })
}

/// A mesh's normal at a hit, on the side of `face`, if it has one.
///
/// Near its silhouette a mesh shows triangles whose interpolated normals point away from the viewer, which no surface can
/// have that he sees. They are turned just so far that he sees them edge-on.
fn smooth_normal(scene: &CompiledScene, surface: &Surface, hit: &Hit, face: DVec3, direction: DVec3) -> Option<DVec3> {
    let normal = scene.world.shading_normal(surface.point, hit)?;
    let normal = if normal.dot(face) < 0.0 { -normal } else { normal };
    seen_by(normal, direction)
}

/// A unit normal, turned just so far that it is not seen from behind by who looks along `direction`.
fn seen_by(normal: DVec3, direction: DVec3) -> Option<DVec3> {
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

#[cfg(test)]
mod terminator;

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
