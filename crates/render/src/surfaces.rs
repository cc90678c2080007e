//! Materials, compiled for path tracing: what can be looked up once is, and textures are asked at each hit.

mod principled;

use crate::bsdf::{Bsdf, Classic, Conductor, Dielectric, Ggx, OrenNayar, Parts, Plastic, Reflectance, Sheet, Through};
use crate::frame::Frame;
use crate::shading::{Shading, Textured, tangents, within_one};
use durer_math::Rgb;
use durer_scene::{MaterialKind, Paint};

/// How a material scatters light.
#[derive(Clone, Debug)]
pub(crate) enum Scattering {
    /// By Lambert's law.
    Matte,
    RoughMatte {
        roughness: Paint,
    },
    Metal {
        color: MetalColor,
        roughness: Paint,
        /// Where highlights are not round: how much, and by how many turns they are turned.
        anisotropy: Option<[Paint; 2]>,
    },
    Glass(Glass),
    Plastic {
        ior: f64,
        roughness: Paint,
    },
    Mirror,
    Classic(durer_scene::Classic),
    Principled(Box<durer_scene::Principled>),
}

/// What a metal reflects.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MetalColor {
    /// What follows from its index of refraction; with the mean over all directions.
    Measured(Reflectance, Rgb),
    /// Its own color at normal incidence.
    Own,
}

/// Glass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Glass {
    ior: f64,
    roughness: Paint,
    is_thin: bool,
}

/// The indices of refraction on both sides of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Indices {
    /// On the side that the ray came from.
    pub(crate) before: f64,
    /// On the other side, if the surface bounds a medium; sheets are in the midst of one.
    pub(crate) behind: Option<f64>,
}

impl Indices {
    /// The index behind over that before.
    fn relative(self) -> Option<f64> {
        self.behind.map(|behind| behind / self.before)
    }

    /// True at the boundary of a medium that bends light as what is before it does.
    pub(crate) fn bend_nothing(self) -> bool {
        self.relative().is_some_and(is_one)
    }
}

/// Indices of refraction that differ by no more than this bend nothing.
const EQUAL: f64 = 1e-6;

/// Colors of classic surfaces may be above 1, for they are scaled down, but are numbers.
const BRIGHTEST: f32 = 1e6;

impl Scattering {
    pub(crate) fn compile(kind: &MaterialKind) -> Scattering {
        match kind {
            MaterialKind::Classic(classic) => Scattering::Classic(classic.clone()),
            MaterialKind::Matte(matte) if is_zero(matte.roughness) => Scattering::Matte,
            MaterialKind::Matte(matte) => Scattering::RoughMatte { roughness: matte.roughness },
            MaterialKind::Metal(metal) => Scattering::Metal {
                color: MetalColor::compile(&metal.conductor),
                roughness: metal.roughness,
                anisotropy: Some([metal.anisotropy, metal.rotation]).filter(|[amount, _]| !is_zero(*amount)),
            },
            MaterialKind::Glass(glass) => {
                Scattering::Glass(Glass { ior: glass.ior, roughness: glass.roughness, is_thin: glass.thin })
            }
            MaterialKind::Plastic(plastic) => Scattering::Plastic { ior: plastic.ior, roughness: plastic.roughness },
            MaterialKind::Mirror(_) => Scattering::Mirror,
            MaterialKind::Principled(principled) => Scattering::Principled(principled.clone()),
        }
    }

    /// Makes those tables now that hits next to empty space will look up, so that rendering does not wait for them.
    pub(crate) fn prepare(&self) {
        let any = || Ggx::of_roughness(0.5, 0.0);
        let rough_glass = |ior: f64, roughness: Paint| {
            if !is_zero(roughness) && !is_one(ior) {
                let _ = Dielectric::new(ior, Rgb::WHITE, any());
            }
        };
        let metal = || {
            let white = Reflectance::Schlick { f0: Rgb::WHITE, f90: Rgb::WHITE };
            let _ = Conductor::new(white, Rgb::WHITE, any());
        };
        match self {
            Scattering::Metal { .. } => metal(),
            Scattering::Glass(glass) => {
                rough_glass(glass.ior, glass.roughness);
                metal();
            }
            Scattering::Plastic { ior, roughness } if !is_zero(*roughness) => {
                let _ = Plastic::new(ior.max(1.0 + EQUAL), Rgb::WHITE, any());
            }
            Scattering::Principled(layers) => {
                metal();
                if !is_zero(layers.sheen_color) {
                    let _ = crate::bsdf::Sheen::new(Rgb::WHITE, 0.5).taken(0.5);
                }
                if !is_zero(layers.transmission) && !layers.thin {
                    rough_glass(layers.ior, layers.roughness);
                }
            }
            Scattering::Matte
            | Scattering::RoughMatte { .. }
            | Scattering::Plastic { .. }
            | Scattering::Mirror
            | Scattering::Classic(_) => {}
        }
    }

    /// What scatters light at a hit, between media of these indices, and the frame in which it does.
    #[inline]
    pub(crate) fn at(&self, shading: &Shading<'_>, textured: &Textured<'_>, indices: Indices) -> (Frame, Bsdf) {
        match self {
            Scattering::Matte => (Frame::around(shading.normal()), Bsdf::Diffuse(within_one(shading.color))),
            other => other.in_detail(shading, textured, indices),
        }
    }

    #[inline(never)]
    fn in_detail(&self, shading: &Shading<'_>, textured: &Textured<'_>, indices: Indices) -> (Frame, Bsdf) {
        let color = within_one(shading.color);
        let around = || Frame::around(shading.normal());
        match self {
            Scattering::Matte => (around(), Bsdf::Diffuse(color)),
            Scattering::RoughMatte { roughness } => {
                (around(), Bsdf::OrenNayar(OrenNayar::new(color, textured.amount(*roughness))))
            }
            Scattering::Metal { color: metal, roughness, anisotropy } => {
                let (frame, amount) = match anisotropy {
                    None => (around(), 0.0),
                    Some([amount, turns]) => (brushed(shading, textured, *turns), textured.signed(*amount)),
                };
                let ggx = Ggx::of_roughness(textured.amount(*roughness), amount);
                let (reflectance, average) = metal.at(color, indices.before);
                (frame, Bsdf::Conductor(Conductor::new(reflectance, average, ggx)))
            }
            Scattering::Glass(glass) => (around(), glass.at(color, textured, indices)),
            Scattering::Plastic { ior, roughness } => {
                let ggx = Ggx::of_roughness(textured.amount(*roughness), 0.0);
                let eta = ior / indices.before;
                (around(), Bsdf::Plastic(Plastic::new(eta.max(1.0 + EQUAL), color, ggx)))
            }
            Scattering::Mirror => (around(), Bsdf::Mirror(color)),
            Scattering::Classic(classic) => (around(), self::classic(classic, shading.color, indices)),
            Scattering::Principled(layers) => principled::at(layers, shading, textured, indices),
        }
    }

    /// Of smooth glass its index of refraction, `None` of what is a mirror; of all else, that scatters light otherwise or from
    /// place to place, nothing.
    pub(crate) fn smooth_ior(&self) -> Option<Option<f64>> {
        match self {
            Scattering::Glass(Glass { ior, roughness, is_thin: false }) if is_zero(*roughness) => Some(Some(*ior)),
            Scattering::Metal { roughness, .. } if is_zero(*roughness) => Some(None),
            Scattering::Mirror => Some(None),
            Scattering::Glass(_)
            | Scattering::Metal { .. }
            | Scattering::Matte
            | Scattering::RoughMatte { .. }
            | Scattering::Plastic { .. }
            | Scattering::Principled(_)
            | Scattering::Classic(_) => None,
        }
    }

    /// True if it has no opaque part that would be seen even where what it is filled with makes no difference.
    pub(crate) fn is_only_a_boundary(&self) -> bool {
        match self {
            Scattering::Glass(_) => true,
            Scattering::Matte
            | Scattering::RoughMatte { .. }
            | Scattering::Metal { .. }
            | Scattering::Plastic { .. }
            | Scattering::Mirror
            | Scattering::Classic(_) => false,
            Scattering::Principled(layers) => principled::is_clear_body(layers),
        }
    }
}

impl MetalColor {
    fn compile(conductor: &durer_scene::Conductor) -> MetalColor {
        let measured = |eta, k| {
            let reflectance = Reflectance::Complex { eta, k };
            MetalColor::Measured(reflectance, reflectance.average())
        };
        match conductor {
            durer_scene::Conductor::Named(name) => {
                let [eta, k] = name.index();
                measured(eta, k)
            }
            durer_scene::Conductor::Index { eta, k } => measured(*eta, *k),
            durer_scene::Conductor::Reflectance(_) => MetalColor::Own,
        }
    }

    /// The reflectance, and its mean, next to a medium of this index.
    fn at(&self, own: Rgb, before: f64) -> (Reflectance, Rgb) {
        let reflectance = match self {
            MetalColor::Measured(reflectance, average) if before == 1.0 => return (*reflectance, *average),
            MetalColor::Measured(Reflectance::Complex { eta, k }, _) => {
                let per = (1.0 / before) as f32;
                Reflectance::Complex { eta: *eta * per, k: *k * per }
            }
            MetalColor::Measured(same @ Reflectance::Schlick { .. }, _) => *same,
            MetalColor::Own => Reflectance::Schlick { f0: own, f90: Rgb::WHITE },
        };
        (reflectance, reflectance.average())
    }
}

impl Glass {
    fn at(&self, tint: Rgb, textured: &Textured<'_>, indices: Indices) -> Bsdf {
        let ggx = Ggx::of_roughness(textured.amount(self.roughness), 0.0);
        match indices.relative() {
            Some(eta) if !self.is_thin => boundary(eta, tint, ggx),
            _ => Bsdf::Sheet(Sheet::new(self.ior / indices.before, tint, ggx)),
        }
    }
}

/// True for a relative index of refraction that bends nothing.
fn is_one(eta: f64) -> bool {
    (eta - 1.0).abs() < EQUAL
}

/// A boundary between dielectrics; where both are the same, light goes straight on.
fn boundary(eta: f64, tint: Rgb, ggx: Option<Ggx>) -> Bsdf {
    match is_one(eta) {
        true => Bsdf::Clear(tint),
        false => Bsdf::Dielectric(Dielectric::new(eta, tint, ggx)),
    }
}

fn classic(classic: &durer_scene::Classic, color: Rgb, indices: Indices) -> Bsdf {
    // What light passes gives back no more than was reckoned with for shadow rays.
    let most = match classic.color {
        _ if classic.transparency.is_black() => Rgb::gray(BRIGHTEST),
        Paint::Color(color) => color.map(|c| c.max(1.0)),
        Paint::Texture(_) => Rgb::WHITE,
    };
    let least = |c: f32, most: f32| if c > 0.0 { c.min(most) } else { 0.0 };
    let color = Rgb::new(least(color.r, most.r), least(color.g, most.g), least(color.b, most.b));
    let parts = Parts {
        diffuse: color * classic.diffuse,
        specular: classic.specular,
        shininess: classic.shininess,
        reflection: classic.reflection,
        transparency: classic.transparency,
    };
    let is_matte = [parts.specular, parts.reflection, parts.transparency].iter().all(|part| part.is_black());
    if is_matte {
        return Bsdf::Diffuse(scaled_down(parts.diffuse));
    }
    let through = match (classic.ior, indices.relative()) {
        (Some(_), Some(eta)) if is_one(eta) => Through::Clear,
        (Some(_), Some(eta)) if classic.fresnel => Through::Bent(Dielectric::new(eta, Rgb::WHITE, None)),
        (Some(_), Some(eta)) => Through::Bent(Dielectric::without_reflection(eta, Rgb::WHITE)),
        (Some(ior), None) if classic.fresnel => Through::Sheet(Sheet::new(ior / indices.before, Rgb::WHITE, None)),
        (Some(_), None) | (None, _) => Through::Straight,
    };
    Bsdf::Classic(Classic::new(parts, through))
}

/// All components alike, so that none is above 1.
fn scaled_down(color: Rgb) -> Rgb {
    let most = color.max_component();
    if most > 1.0 { color * (1.0 / most) } else { color }
}

/// The frame of a brushed surface: its x axis runs with the texture's u, turned.
fn brushed(shading: &Shading<'_>, textured: &Textured<'_>, turns: Paint) -> Frame {
    let normal = shading.normal();
    match tangents(textured, normal) {
        Some([along_u, _]) => {
            // Counterclockwise seen from outside.
            let turns = textured.signed(turns);
            Frame::along(normal, along_u).turned(if shading.from_outside { turns } else { -turns })
        }
        None => Frame::around(normal),
    }
}

/// True if a number is 0 everywhere.
fn is_zero(paint: Paint) -> bool {
    match paint {
        Paint::Color(color) => color.luminance() == 0.0,
        Paint::Texture(_) => false,
    }
}
