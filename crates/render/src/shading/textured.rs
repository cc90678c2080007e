//! What textures say at a hit.

use crate::compile::{Colors, CompiledScene, Origin, PlacedObject};
use crate::materials::Material;
use crate::textures::TexturePoint;
use durer_geometry::{Hit, Surface};
use durer_math::{DVec2, DVec3, Rgb};
use durer_scene::Paint;

/// A hit as textures see it.
pub(crate) struct Textured<'a> {
    pub(crate) scene: &'a CompiledScene,
    pub(crate) object: &'a PlacedObject,
    pub(crate) surface: &'a Surface,
    pub(crate) hit: &'a Hit,
}

impl Textured<'_> {
    /// What the part that was hit comes from, if there is more to say of it.
    fn origin(&self) -> Option<&Origin> {
        Some(self.scene.details(self.hit.primitive)?.origin(self.hit.crossing.part).1)
    }

    /// Colours of the surface's own take the place of a plain colour, and multiply a texture's.
    pub(super) fn color(&self, paint: Paint) -> Rgb {
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

    /// What the surface gives off, on a side that does. Colors of the surface's own have no part in it, unless it is unlit.
    pub(crate) fn emission(&self, material: &Material) -> Rgb {
        if material.is_unlit {
            return self.color(material.color) * self.scene.ambient * material.ambient;
        }
        material.emission.map_or(Rgb::BLACK, |glow| self.scene.textures.color(glow.color, self) * glow.strength)
    }

    /// A number that a paint says: its gray, from 0 to 1 whatever an image may hold.
    pub(crate) fn amount(&self, paint: Paint) -> f64 {
        let gray = self.scene.textures.color(paint, self).luminance();
        if gray > 0.0 { f64::from(gray.min(1.0)) } else { 0.0 }
    }

    /// A number that a paint says, of either sign; 0 for what is no number.
    pub(crate) fn signed(&self, paint: Paint) -> f64 {
        let gray = self.scene.textures.color(paint, self).luminance();
        if gray.is_finite() { f64::from(gray) } else { 0.0 }
    }

    /// The color that a paint says. Colors of the surface's own have no part in it.
    pub(crate) fn color_of(&self, paint: Paint) -> Rgb {
        self.scene.textures.color(paint, self)
    }

    /// The part of light that is given back, from 0 to 1 in each component, that a paint says. Colors of the surface's own
    /// have no part in it.
    pub(crate) fn part(&self, paint: Paint) -> Rgb {
        within_one(self.scene.textures.color(paint, self))
    }

    /// From 0 to 1, whatever an image may hold.
    pub(crate) fn opacity(&self, paint: Paint) -> Rgb {
        self.part(paint)
    }
}

/// Each component brought to 0..1; what is no number, to 0.
pub(crate) fn within_one(color: Rgb) -> Rgb {
    color.map(|c| if c > 0.0 { c.min(1.0) } else { 0.0 })
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
