//! Textures: which colour is where. Compiled once from the scene's, then asked once a hit.
//!
//! A folder of small patterns, one to a file: each knows its own numbers and answers, for a point in its own space, with
//! a [`Shade`]: a colour, one of its paints, or two of them blended. Only this file knows that paints can be textures
//! again, so no pattern recurses.

mod cells;
mod checker;
mod environment;
mod gradient;
mod image;
mod marble;
mod noise;
mod perlin;
mod rings;
mod stripes;
mod texels;
mod wood;
mod wrap;

pub(crate) use environment::Environment;

use checker::Checker;
use durer_math::{DAffine3, DVec2, DVec3, Rgb};
use durer_scene::{Mapping, Paint, Scene, Space, TextureId, Transform};
use gradient::Gradient;
use image::Image;
use marble::Marble;
use noise::Noise;
use rings::Rings;
use stripes::Stripes;
use texels::Tables;
use wood::Wood;

/// A point on a surface, as textures see it.
pub(crate) trait TexturePoint {
    /// Where it is, in the object's own space, before the object's transforms.
    fn point(&self) -> DVec3;

    /// The surface's uv there. Asked only by textures that lie on uv, so it may take its time; a texture made of
    /// several such textures asks again for each.
    fn uv(&self) -> DVec2;
}

/// All textures of a scene, ready to be asked. The scene's [`TextureId`]s stay valid.
#[derive(Debug)]
pub(crate) struct Textures {
    textures: Vec<Texture>,
}

/// A pattern, placed.
#[derive(Debug)]
struct Texture {
    space: Space,
    /// From `space` to the pattern's own; `None` where they are the same.
    texture_from_space: Option<DAffine3>,
    pattern: Pattern,
}

/// The patterns of [`durer_scene::Pattern`], compiled.
#[derive(Debug)]
enum Pattern {
    Checker(Checker),
    Stripes(Stripes),
    Rings(Rings),
    Gradient(Gradient),
    Image(Image),
    Noise(Noise),
    Marble(Marble),
    Wood(Wood),
}

/// What a pattern answers.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shade {
    /// This colour.
    Color(Rgb),
    /// Whatever this paint is.
    Paint(Paint),
    /// The linear blend `(1 - t) * first + t * second`, with t in 0..=1.
    Blend([Paint; 2], f32),
}

impl Textures {
    /// The textures of a scene that passed its check.
    pub(crate) fn compile(scene: &Scene) -> Textures {
        let mut tables = Tables::default();
        let textures = scene.textures.iter().map(|texture| Texture::compile(texture, scene, &mut tables)).collect();
        Textures { textures }
    }

    /// The linear-light colour of `paint` at a point.
    #[inline]
    pub(crate) fn color(&self, paint: Paint, at: &impl TexturePoint) -> Rgb {
        match paint {
            Paint::Color(color) => color,
            Paint::Texture(texture) => self.textured(texture, at),
        }
    }

    /// How coordinates grow from one point of a surface to another, close by: those of the image if the paint is one, with its
    /// mapping and its transform, else the surface's own.
    pub(crate) fn rise(&self, paint: Paint, from: &impl TexturePoint, to: &impl TexturePoint) -> DVec2 {
        match paint {
            Paint::Color(_) => going_on(to.uv() - from.uv()),
            Paint::Texture(texture) => self.textures[texture.0 as usize].rise(from, to),
        }
    }

    /// Follows paints from texture to texture; only blends recurse, as deep as the scene nests them.
    fn textured(&self, mut id: TextureId, at: &impl TexturePoint) -> Rgb {
        loop {
            match self.textures[id.0 as usize].shade(at) {
                Shade::Color(color) | Shade::Paint(Paint::Color(color)) => return color,
                Shade::Paint(Paint::Texture(next)) => id = next,
                Shade::Blend([first, second], t) => return self.blend(first, second, t, at),
            }
        }
    }

    /// A paint that does not show is not asked: where one end of the blend is reached, its textures cost nothing.
    fn blend(&self, first: Paint, second: Paint, t: f32, at: &impl TexturePoint) -> Rgb {
        if t <= 0.0 {
            self.color(first, at)
        } else if t >= 1.0 {
            self.color(second, at)
        } else {
            self.color(first, at).lerp(self.color(second, at), t)
        }
    }
}

impl Texture {
    fn compile(texture: &durer_scene::Texture, scene: &Scene, tables: &mut Tables) -> Texture {
        let (space, pattern) = Pattern::compile(&texture.pattern, scene, tables);
        Texture { space, texture_from_space: inverse_of(&texture.transform), pattern }
    }

    /// A point of the texture's own space.
    fn place(&self, point: DVec3) -> DVec3 {
        match &self.texture_from_space {
            Some(texture_from_space) => texture_from_space.transform_point3(point),
            None => point,
        }
    }

    /// Coordinates of the surface begin anew somewhere, and are transformed after that; those of mappings the other way around.
    fn rise(&self, from: &impl TexturePoint, to: &impl TexturePoint) -> DVec2 {
        let rise_of_uv = || going_on(to.uv() - from.uv());
        match (&self.pattern, self.space) {
            (Pattern::Image(image), Space::Object) => {
                let place = |at: DVec3| image.place(self.place(at));
                going_on(place(to.point()) - place(from.point()))
            }
            (Pattern::Image(_), Space::Uv) => {
                let rise = rise_of_uv();
                self.texture_from_space.map_or(rise, |map| map.transform_vector3(rise.extend(0.0)).truncate())
            }
            _ => rise_of_uv(),
        }
    }

    fn shade(&self, at: &impl TexturePoint) -> Shade {
        let point = self.place(match self.space {
            Space::Object => at.point(),
            Space::Uv => at.uv().extend(0.0),
        });
        match &self.pattern {
            Pattern::Checker(checker) => checker.shade(point),
            Pattern::Stripes(stripes) => stripes.shade(point),
            Pattern::Rings(rings) => rings.shade(point),
            Pattern::Gradient(gradient) => gradient.shade(point),
            Pattern::Image(image) => Shade::Color(image.color(point)),
            Pattern::Noise(noise) => noise.shade(point),
            Pattern::Marble(marble) => marble.shade(point),
            Pattern::Wood(wood) => wood.shade(point),
        }
    }
}

impl Pattern {
    /// The pattern and the coordinates that it reads.
    fn compile(pattern: &durer_scene::Pattern, scene: &Scene, tables: &mut Tables) -> (Space, Pattern) {
        use durer_scene::Pattern as From;
        match pattern {
            From::Checker { colors, size, space } => (*space, Pattern::Checker(Checker::new(*colors, *size))),
            From::Stripes { colors, axis, width, space } => {
                (*space, Pattern::Stripes(Stripes::new(colors, *axis, *width)))
            }
            From::Rings { colors, width, space } => (*space, Pattern::Rings(Rings::new(colors, *width, *space))),
            From::Gradient { colors, axis, length, wrap, space } => {
                (*space, Pattern::Gradient(Gradient::new(colors, *axis, *length, *wrap)))
            }
            From::Image(texture) => {
                let space = match texture.mapping {
                    Mapping::Uv => Space::Uv,
                    Mapping::Planar | Mapping::Spherical | Mapping::Cylindrical { .. } => Space::Object,
                };
                let bitmap = &scene.images[texture.image.0 as usize].bitmap;
                (space, Pattern::Image(Image::new(texture, bitmap, tables)))
            }
            From::Noise { colors, size, octaves } => {
                (Space::Object, Pattern::Noise(Noise::new(*colors, *size, *octaves)))
            }
            From::Marble { colors, size, turbulence, octaves } => {
                (Space::Object, Pattern::Marble(Marble::new(*colors, *size, *turbulence, *octaves)))
            }
            From::Wood { colors, size, turbulence, octaves } => {
                (Space::Object, Pattern::Wood(Wood::new(*colors, *size, *turbulence, *octaves)))
            }
        }
    }
}

/// How coordinates grow over a short way. Where they begin anew, as behind a sphere, they have gone on.
pub(crate) fn going_on(rise: DVec2) -> DVec2 {
    let each = |rise: f64| if rise.abs() > 0.5 && rise.abs() < 1.0 { rise - rise.round() } else { rise };
    DVec2::new(each(rise.x), each(rise.y))
}

/// The way back; `None` where there is nothing to undo.
fn inverse_of(transform: &Transform) -> Option<DAffine3> {
    let outer_from_inner = transform.to_affine();
    (outer_from_inner != DAffine3::IDENTITY).then(|| outer_from_inner.inverse())
}

#[cfg(test)]
mod tests;
