//! Classic materials: Whitted 1980 with Phong's highlights.

use crate::texture::Paint;
use durer_math::Rgb;

/// A surface of the classic kind.
///
/// With C the colour at the point, A the scene's ambient light, and for each light its visibility V, its colour times
/// intensity I, its direction l, and r the reflection of l about the normal n, the surface shows
///
/// `shade = ambient·A·C + Σ V·I·(diffuse·C·max(0, n·l) + specular·max(0, r·v)^shininess)`
/// `color = emission + (1 - transparency)·shade + transparency·behind + reflection·reflected`
///
/// with the highlight only where n·l > 0, and n turned to the side that the ray comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the scene file; `None` for one written inline.
    pub name: Option<String>,
    /// Colour of ambient and diffuse light given back.
    pub color: Paint,
    /// Part of the scene's ambient light that is given back, usually 0 to 1.
    pub ambient: f32,
    /// Part of the light from lights that is given back in all directions (Lambert), usually 0 to 1.
    pub diffuse: f32,
    /// Strength of the highlight (Phong).
    pub specular: Rgb,
    /// Exponent of the highlight: the higher, the smaller and sharper.
    pub shininess: f32,
    /// Part of the light from the mirrored direction that is added, 0 to 1.
    pub reflection: Rgb,
    /// Part of what lies behind that shows through, 0 to 1; the rest is the surface's own shade.
    pub transparency: Rgb,
    /// Index of refraction of the inside of closed shapes; `None`, and shapes that have no inside, let light go straight
    /// through.
    pub ior: Option<f64>,
    /// Divides the light that shows through between refraction and reflection by Fresnel's equations; without it all
    /// is refracted, save at total internal reflection.
    pub fresnel: bool,
    /// Colour taken on inside of closed shapes, by distance (Beer–Lambert).
    pub attenuation: Option<Attenuation>,
    /// Light that the surface gives off by itself.
    pub emission: Rgb,
    /// How much of the surface is there: white where it is whole, black where it has a hole.
    pub opacity: Paint,
}

/// White light that went `distance` through the inside has `color`: transmittance is `color^(d / distance)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation {
    /// What is left of white, each component above 0 and at most 1.
    pub color: Rgb,
    /// After this distance.
    pub distance: f64,
}

impl Default for Material {
    /// Light gray, matte, opaque.
    fn default() -> Material {
        Material {
            name: None,
            color: Paint::Color(Rgb::gray(0.8)),
            ambient: 0.2,
            diffuse: 0.8,
            specular: Rgb::BLACK,
            shininess: 40.0,
            reflection: Rgb::BLACK,
            transparency: Rgb::BLACK,
            ior: None,
            fresnel: false,
            attenuation: None,
            emission: Rgb::BLACK,
            opacity: Paint::Color(Rgb::WHITE),
        }
    }
}
