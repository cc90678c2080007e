//! Materials: what a surface does with light. One kind for each of the classic and the physical models, and what all of
//! them have beside it.

use crate::metals::MetalName;
use crate::texture::Paint;
use durer_math::Rgb;

/// A surface: one of several kinds, and what all kinds may have.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the scene file; `None` for one written inline.
    pub name: Option<String>,
    /// What it does with light that falls on it.
    pub kind: MaterialKind,
    /// Light that it gives off by itself.
    pub emission: Emission,
    /// How much of the surface is there: white where it is whole, black where it has a hole.
    pub opacity: Paint,
    /// Relief that is only shaded, not there.
    pub relief: Option<Relief>,
}

/// The kinds of material. What a number may be, a texture may say from point to point: of those that are no color, the
/// texture's gray.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialKind {
    /// Whitted 1980 with Phong's highlights.
    Classic(Classic),
    /// Paper, plaster, unglazed clay.
    Matte(Matte),
    /// A conductor.
    Metal(Metal),
    /// A clear dielectric, smooth or rough.
    Glass(Glass),
    /// A clear coat over a colored base.
    Plastic(Plastic),
    /// A perfect mirror.
    Mirror(Mirror),
    /// glTF's metallic-roughness model with its extensions.
    Principled(Box<Principled>),
}

impl MaterialKind {
    /// The word for it in scene files and messages; `None` for classic ones, which have none.
    pub fn word(&self) -> Option<&'static str> {
        match self {
            MaterialKind::Classic(_) => None,
            MaterialKind::Matte(_) => Some("matte"),
            MaterialKind::Metal(_) => Some("metal"),
            MaterialKind::Glass(_) => Some("glass"),
            MaterialKind::Plastic(_) => Some("plastic"),
            MaterialKind::Mirror(_) => Some("mirror"),
            MaterialKind::Principled(_) => Some("principled"),
        }
    }
}

/// Light that a surface gives off by itself: a radiance, the same in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Its color, which may be above 1.
    pub color: Paint,
    /// Multiplies the color.
    pub strength: f32,
    /// Which side of the surface gives it off.
    pub sides: Sides,
}

impl Emission {
    /// None.
    pub const NONE: Emission = Emission::of(Rgb::BLACK);

    /// This radiance on both sides.
    pub const fn of(color: Rgb) -> Emission {
        Emission { color: Paint::Color(color), strength: 1.0, sides: Sides::Both }
    }

    /// True if there is none, whatever its sides.
    pub fn is_black(&self) -> bool {
        self.strength == 0.0 || matches!(self.color, Paint::Color(color) if color.is_black())
    }
}

impl Default for Emission {
    /// [`Emission::NONE`].
    fn default() -> Emission {
        Emission::NONE
    }
}

/// Sides of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// Both.
    #[default]
    Both,
    /// That to which the surface's own normal points: of closed shapes the outside, of triangles that from which their
    /// vertices go counterclockwise.
    Front,
}

/// Relief that is only shaded: it turns the normal by which light falls, and leaves the surface where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relief {
    /// A texture of normals.
    NormalMap(NormalMap),
    /// A texture of heights.
    Bump(Bump),
}

/// A tangent-space normal map, as glTF has it: red is along u, green along v and blue along the normal, each from -1 (0) to 1
/// (1). Its image is to be read with a linear encoding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// The texture.
    pub texture: Paint,
    /// Multiplies what is along u and v; 0 leaves the surface smooth.
    pub strength: f32,
}

/// A height above the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// The height, from black to white.
    pub height: Paint,
    /// How far white is above black, in the units of the object's own space; below 0 turns hills into hollows.
    pub size: f64,
}

/// A surface of the classic kind.
///
/// With C the color at the point, A the scene's ambient light, and for each light its visibility V, its color times
/// intensity I, its direction l, and r the reflection of l about the normal n, the surface shows
///
/// `shade = ambient·A·C + Σ V·I·(diffuse·C·max(0, n·l) + specular·max(0, r·v)^shininess)`
/// `color = emission + (1 - transparency)·shade + transparency·behind + reflection·reflected`
///
/// with the highlight only where n·l > 0, and n turned to the side that the ray comes from. These parts may add up to more
/// than 1, and give back more light than came; path tracing scales them down to what a surface can give back.
#[derive(Clone, Debug, PartialEq)]
pub struct Classic {
    /// Color of ambient and diffuse light given back.
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
    /// Color taken on inside of closed shapes, by distance (Beer–Lambert).
    pub attenuation: Option<Attenuation>,
}

/// White light that went `distance` through the inside has `color`: transmittance is `color^(d / distance)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation {
    /// What is left of white, each component above 0 and at most 1.
    pub color: Rgb,
    /// After this distance.
    pub distance: f64,
}

/// Gives light back in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matte {
    /// Part of the light that is given back.
    pub color: Paint,
    /// 0 is Lambert's law; up to 1, facets that are turned more and more, as Oren and Nayar 1994 describe them (σ in radians).
    pub roughness: Paint,
}

/// A conductor: what it reflects follows from its complex index of refraction by Fresnel's equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Which metal.
    pub conductor: Conductor,
    /// 0 is a mirror, 1 dull; the square is the α of GGX.
    pub roughness: Paint,
    /// How much longer than wide highlights are: 0 is round, 1 stretches most along the tangent, -1 across it.
    pub anisotropy: Paint,
    /// Turns the tangent about the normal, in whole turns: 0.25 is a right angle.
    pub rotation: Paint,
}

/// What a metal is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conductor {
    /// One of those that have been measured.
    Named(MetalName),
    /// Its complex index of refraction η + ik, for red, green and blue.
    Index {
        /// η.
        eta: Rgb,
        /// k.
        k: Rgb,
    },
    /// What it reflects at normal incidence.
    Reflectance(Paint),
}

/// A clear dielectric: exact Fresnel reflection and refraction. Shapes with an inside are filled with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass {
    /// Index of refraction of the inside.
    pub ior: f64,
    /// 0 is clear, 1 frosted; the square is the α of GGX.
    pub roughness: Paint,
    /// Multiplies light that goes through the surface, each time.
    pub color: Paint,
    /// Color taken on inside, by distance.
    pub attenuation: Option<Attenuation>,
    /// Where several glasses are in one place, that of the highest priority is there, and among equals the one entered last.
    pub priority: i32,
    /// A thin sheet: light goes straight through both of its boundaries at once, and shapes have no inside.
    pub thin: bool,
}

/// A smooth or rough dielectric coat over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Part of the light that the base gives back.
    pub color: Paint,
    /// Index of refraction of the coat.
    pub ior: f64,
    /// 0 is polished, 1 dull; the square is the α of GGX.
    pub roughness: Paint,
}

/// A perfect mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Part of the light that is given back.
    pub color: Paint,
}

/// The material model of glTF 2.0 with its extensions (Khronos): KHR_materials_ior, specular, transmission, volume,
/// clearcoat, sheen and anisotropy. Names, meanings and defaults are those of glTF, save that roughness is 0.5 and metallic 0
/// unless something is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    /// Of what is no metal, the diffuse color; of metals, the reflectance at normal incidence.
    pub base_color: Paint,
    /// From 0 for dielectrics to 1 for metals.
    pub metallic: Paint,
    /// 0 is polished, 1 dull; the square is the α of GGX.
    pub roughness: Paint,
    /// Index of refraction of what is no metal.
    pub ior: f64,
    /// Strength of the reflection of what is no metal.
    pub specular: Paint,
    /// Color of that reflection at normal incidence.
    pub specular_color: Paint,
    /// Part of the light that goes through instead of being given back diffusely.
    pub transmission: Paint,
    /// True if light that goes through is not bent and there is no inside, as of a sheet. (glTF: no volume.)
    pub thin: bool,
    /// Color taken on inside, by distance, unless it is thin.
    pub attenuation: Option<Attenuation>,
    /// Strength of a clear coat (ior 1.5) above all the rest.
    pub clearcoat: Paint,
    /// Roughness of the coat.
    pub clearcoat_roughness: Paint,
    /// Color of a sheen as of cloth; black for none.
    pub sheen_color: Paint,
    /// Roughness of the sheen.
    pub sheen_roughness: Paint,
    /// How much longer than wide highlights are, along the tangent, 0 to 1.
    pub anisotropy: Paint,
    /// Turns the tangent about the normal, in whole turns.
    pub anisotropy_rotation: Paint,
}

impl Default for Material {
    /// Light gray, matte, opaque: the classic one.
    fn default() -> Material {
        Material::of(MaterialKind::Classic(Classic::default()))
    }
}

impl Material {
    /// Nothing but this.
    pub fn of(kind: MaterialKind) -> Material {
        Material { name: None, kind, emission: Emission::NONE, opacity: Paint::Color(Rgb::WHITE), relief: None }
    }

    /// Its fields, if it is a classic one.
    pub fn as_classic(&self) -> Option<&Classic> {
        match &self.kind {
            MaterialKind::Classic(classic) => Some(classic),
            MaterialKind::Matte(_)
            | MaterialKind::Metal(_)
            | MaterialKind::Glass(_)
            | MaterialKind::Plastic(_)
            | MaterialKind::Mirror(_)
            | MaterialKind::Principled(_) => None,
        }
    }

    /// What takes light away inside of it, if anything does.
    pub fn attenuation_mut(&mut self) -> Option<&mut Attenuation> {
        match &mut self.kind {
            MaterialKind::Classic(Classic { attenuation, .. }) | MaterialKind::Glass(Glass { attenuation, .. }) => {
                attenuation.as_mut()
            }
            MaterialKind::Principled(principled) => principled.attenuation.as_mut(),
            MaterialKind::Matte(_) | MaterialKind::Metal(_) | MaterialKind::Plastic(_) | MaterialKind::Mirror(_) => {
                None
            }
        }
    }

    /// All paints that it is made of.
    pub fn paints(&self) -> Vec<Paint> {
        self.clone().paints_mut().into_iter().map(|paint| *paint).collect()
    }

    /// All paints that it is made of, to be changed.
    pub fn paints_mut(&mut self) -> Vec<&mut Paint> {
        let mut paints = match &mut self.kind {
            MaterialKind::Classic(Classic { color, .. }) | MaterialKind::Mirror(Mirror { color }) => vec![color],
            MaterialKind::Matte(Matte { color, roughness })
            | MaterialKind::Glass(Glass { color, roughness, .. })
            | MaterialKind::Plastic(Plastic { color, roughness, .. }) => vec![color, roughness],
            MaterialKind::Metal(Metal { conductor, roughness, anisotropy, rotation }) => {
                let color = match conductor {
                    Conductor::Named(_) | Conductor::Index { .. } => None,
                    Conductor::Reflectance(color) => Some(color),
                };
                color.into_iter().chain([roughness, anisotropy, rotation]).collect()
            }
            MaterialKind::Principled(principled) => principled.paints_mut().into(),
        };
        paints.extend([&mut self.emission.color, &mut self.opacity]);
        paints.extend(self.relief.as_mut().map(|relief| match relief {
            Relief::NormalMap(map) => &mut map.texture,
            Relief::Bump(bump) => &mut bump.height,
        }));
        paints
    }
}

impl Principled {
    fn paints_mut(&mut self) -> [&mut Paint; 12] {
        let Principled {
            base_color,
            metallic,
            roughness,
            ior: _,
            specular,
            specular_color,
            transmission,
            thin: _,
            attenuation: _,
            clearcoat,
            clearcoat_roughness,
            sheen_color,
            sheen_roughness,
            anisotropy,
            anisotropy_rotation,
        } = self;
        [
            base_color,
            metallic,
            roughness,
            specular,
            specular_color,
            transmission,
            clearcoat,
            clearcoat_roughness,
            sheen_color,
            sheen_roughness,
            anisotropy,
            anisotropy_rotation,
        ]
    }
}

const fn gray(amount: f32) -> Paint {
    Paint::Color(Rgb::gray(amount))
}

impl Default for Classic {
    /// Light gray, matte, opaque.
    fn default() -> Classic {
        Classic {
            color: gray(0.8),
            ambient: 0.2,
            diffuse: 0.8,
            specular: Rgb::BLACK,
            shininess: 40.0,
            reflection: Rgb::BLACK,
            transparency: Rgb::BLACK,
            ior: None,
            fresnel: false,
            attenuation: None,
        }
    }
}

impl Default for Matte {
    /// Light gray, by Lambert's law.
    fn default() -> Matte {
        Matte { color: gray(0.8), roughness: gray(0.0) }
    }
}

impl Default for Metal {
    /// Aluminum, polished but not quite.
    fn default() -> Metal {
        Metal {
            conductor: Conductor::Named(MetalName::Aluminum),
            roughness: gray(0.1),
            anisotropy: gray(0.0),
            rotation: gray(0.0),
        }
    }
}

impl Default for Glass {
    /// Clear window glass.
    fn default() -> Glass {
        Glass { ior: 1.5, roughness: gray(0.0), color: gray(1.0), attenuation: None, priority: 0, thin: false }
    }
}

impl Default for Plastic {
    /// Light gray and shiny.
    fn default() -> Plastic {
        Plastic { color: gray(0.8), ior: 1.5, roughness: gray(0.1) }
    }
}

impl Default for Mirror {
    /// As good as bathroom mirrors are.
    fn default() -> Mirror {
        Mirror { color: gray(0.95) }
    }
}

impl Default for Principled {
    /// Light gray, half dull.
    fn default() -> Principled {
        Principled {
            base_color: gray(0.8),
            metallic: gray(0.0),
            roughness: gray(0.5),
            ior: 1.5,
            specular: gray(1.0),
            specular_color: gray(1.0),
            transmission: gray(0.0),
            thin: false,
            attenuation: None,
            clearcoat: gray(0.0),
            clearcoat_roughness: gray(0.0),
            sheen_color: gray(0.0),
            sheen_roughness: gray(0.0),
            anisotropy: gray(0.0),
            anisotropy_rotation: gray(0.0),
        }
    }
}
