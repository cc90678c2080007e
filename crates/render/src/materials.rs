//! Materials, compiled for Whitted's algorithm: the numbers that shading reads, and the laws of reflection and refraction.

use crate::whitted_reading::{Means, parts_of_color, whitted};
use durer_math::{DVec3, Rgb, functions};
use durer_scene::{Classic, Integrator, MaterialKind, Paint, Relief, Sides};

/// A material, compiled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Material {
    pub(crate) color: Paint,
    pub(crate) ambient: f32,
    pub(crate) diffuse: f32,
    pub(crate) specular: Rgb,
    pub(crate) shininess: f32,
    pub(crate) reflection: Rgb,
    pub(crate) transparency: Rgb,
    /// The parts of the color where it is met that are mirrored, and that pass, if the color says what is: then the two above
    /// are what they are in the mean.
    pub(crate) of_color: [Option<f32>; 2],
    pub(crate) ior: Option<f64>,
    pub(crate) fresnel: bool,
    /// What light loses inside, per unit of length, as the exponent of e (Beer–Lambert), negative.
    pub(crate) attenuation: Option<Rgb>,
    /// Light that the surface gives off by itself, if any.
    pub(crate) emission: Option<durer_scene::Emission>,
    /// True if that is its own color under ambient light, and nothing else can be seen of it.
    pub(crate) is_unlit: bool,
    /// How much of the surface is there; `None` if all of it is, everywhere.
    pub(crate) opacity: Option<Paint>,
    /// What passes of light where no texture decides about that.
    pub(crate) passed_if_even: Rgb,
    /// How shadow rays get through.
    pub(crate) passage: Passage,
    /// Relief that is only shaded.
    pub(crate) relief: Option<Relief>,
    /// Where several media are in one place, that of the highest priority is there.
    pub(crate) priority: i32,
    /// True if some texture decides about anything.
    pub(crate) is_textured: bool,
}

/// How light gets straight through a surface, as shadow rays go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// All through, as the transparency says: [`Material::passed`].
    Even,
    /// Some through sheets, depending on the angle; none through what bounds a medium.
    Sheets,
    /// As through sheets, even where there is a medium.
    Thin,
    /// Evenly through sheets; none through what bounds a medium.
    EvenSheets,
    /// None.
    Closed,
}

impl Material {
    pub(crate) fn compile(material: &durer_scene::Material, means: &mut Means<'_>, integrator: Integrator) -> Material {
        let exponent =
            |a: &durer_scene::Attenuation| a.color.map(|c| (functions::ln(f64::from(c)) / a.distance) as f32);
        let classic = &whitted(&material.kind, means);
        let [mirrored, passed] = parts_of_color(&material.kind, means);
        let own_emission = Some(material.emission).filter(|emission| !emission.is_black());
        let unlit = unlit(&material.kind, integrator).filter(|_| own_emission.is_none());
        let mut compiled = Material {
            color: classic.color,
            ambient: classic.ambient,
            diffuse: classic.diffuse,
            specular: classic.specular,
            shininess: classic.shininess,
            reflection: classic.reflection,
            transparency: classic.transparency,
            // What is not worth a ray anywhere is worth none here.
            of_color: [mirrored.filter(|_| !classic.reflection.is_black()), passed],
            ior: classic.ior,
            fresnel: classic.fresnel,
            attenuation: classic.attenuation.as_ref().map(exponent),
            emission: own_emission.or(unlit),
            is_unlit: unlit.is_some(),
            opacity: Some(material.opacity).filter(|opacity| *opacity != Paint::Color(Rgb::WHITE)),
            passed_if_even: classic.transparency,
            passage: Passage::of(&material.kind, integrator),
            relief: material.relief,
            priority: match &material.kind {
                MaterialKind::Glass(glass) => glass.priority,
                MaterialKind::Classic(_)
                | MaterialKind::Matte(_)
                | MaterialKind::Metal(_)
                | MaterialKind::Plastic(_)
                | MaterialKind::Mirror(_)
                | MaterialKind::Principled(_) => 0,
            },
            is_textured: material.paints().iter().any(|paint| matches!(paint, Paint::Texture(_))),
        };
        if let Some(Paint::Color(opacity)) = compiled.opacity {
            compiled.passed_if_even = compiled.passed(opacity);
        }
        compiled
    }

    /// What is mirrored, and what passes, where the color is this.
    #[inline]
    pub(crate) fn parts_at(&self, color: Rgb) -> [Rgb; 2] {
        let of_color = |part: f32| color.map(|component| component.min(1.0)) * part;
        let [mirrored, passed] = self.of_color;
        [mirrored.map_or(self.reflection, of_color), passed.map_or(self.transparency, of_color)]
    }

    /// True if some light gets through.
    pub(crate) fn is_clear(&self) -> bool {
        !self.transparency.is_black()
    }

    /// True if shadow rays get past the surface: through it, or where it is not there.
    pub(crate) fn lets_light_pass(&self, is_medium: bool) -> bool {
        let through = match self.passage {
            Passage::Even => self.is_clear(),
            Passage::Sheets | Passage::EvenSheets => !is_medium,
            Passage::Thin => true,
            Passage::Closed => false,
        };
        through || self.opacity.is_some()
    }

    /// True if what passes is not the same everywhere and under every angle.
    pub(crate) fn passes_unevenly(&self, is_medium: bool) -> bool {
        let by_angle = match self.passage {
            Passage::Even | Passage::EvenSheets | Passage::Closed => false,
            Passage::Sheets => !is_medium,
            Passage::Thin => true,
        };
        // What refracts lets no light through straight; what is but partly there lets it past.
        let beside_glass = matches!(self.passage, Passage::Sheets | Passage::EvenSheets) && self.opacity.is_some();
        by_angle || beside_glass || matches!(self.opacity, Some(Paint::Texture(_)))
    }

    /// True if shading must look for holes or relief.
    pub(crate) fn needs_details(&self) -> bool {
        self.opacity.is_some() || self.relief.is_some()
    }

    /// What passes of light where so much of the surface is there: what goes through that, and what goes beside it.
    pub(crate) fn passed(&self, opacity: Rgb) -> Rgb {
        self.transparency * opacity + (Rgb::WHITE - opacity)
    }

    /// True if the side that a ray came from gives off light.
    pub(crate) fn glows(&self, from_outside: bool) -> bool {
        self.emission.is_some_and(|emission| match emission.sides {
            Sides::Both => true,
            Sides::Front => from_outside,
        })
    }

    /// True if what a closed shape of it encloses bends light or takes it away. What is nowhere there encloses nothing.
    pub(crate) fn fills_with_medium(&self) -> bool {
        let is_nowhere = self.opacity == Some(Paint::Color(Rgb::BLACK));
        !is_nowhere && self.is_clear() && (self.ior.is_some() || self.attenuation.is_some())
    }

    /// What is left of light after a length of the inside.
    pub(crate) fn transmittance(&self, length: f64) -> Rgb {
        match self.attenuation {
            // Where nothing is lost, infinite length must not make 0 · ∞ of it.
            Some(exponent) => exponent.map(|k| if k == 0.0 { 1.0 } else { functions::exp(k * length as f32) }),
            None => Rgb::WHITE,
        }
    }
}

impl Passage {
    fn of(kind: &MaterialKind, integrator: Integrator) -> Passage {
        match integrator {
            Integrator::Path { .. } => Passage::of_path(kind),
            // Classic shadows go straight through everything clear.
            Integrator::Whitted
            | Integrator::AmbientOcclusion { .. }
            | Integrator::Normals
            | Integrator::Depth
            | Integrator::Uv => Passage::Even,
        }
    }

    /// Under path tracing only that lets shadow rays through which scattering passes straight, too: the two ways to find a lamp must
    /// agree. What bends light hides lamps; glowing shapes are found through it.
    fn of_path(kind: &MaterialKind) -> Passage {
        match kind {
            MaterialKind::Classic(classic) if classic.transparency.is_black() => Passage::Closed,
            // What is scaled down is not the same everywhere.
            MaterialKind::Classic(classic) => match (classic.ior, may_exceed_one(classic)) {
                (None, false) => Passage::Even,
                (None, true) => Passage::Thin,
                (Some(_), false) if !classic.fresnel => Passage::EvenSheets,
                (Some(_), _) => Passage::Sheets,
            },
            MaterialKind::Glass(glass) if glass.thin => Passage::Thin,
            MaterialKind::Glass(_) => Passage::Sheets,
            MaterialKind::Principled(principled) if principled.transmission == Paint::Color(Rgb::BLACK) => {
                Passage::Closed
            }
            MaterialKind::Principled(principled) if principled.thin => Passage::Thin,
            MaterialKind::Principled(_) => Passage::Sheets,
            MaterialKind::Matte(_) | MaterialKind::Metal(_) | MaterialKind::Plastic(_) | MaterialKind::Mirror(_) => {
                Passage::Closed
            }
        }
    }
}

/// Classic surfaces that show nothing but ambient light are to look the same whatever lights them: signs, what other programs
/// have drawn with its light, KHR_materials_unlit of glTF. Path tracing has no ambient light, so there they glow as bright.
fn unlit(kind: &MaterialKind, integrator: Integrator) -> Option<durer_scene::Emission> {
    let (MaterialKind::Classic(classic), Integrator::Path { .. }) = (kind, integrator) else { return None };
    let gives_back = classic.diffuse > 0.0
        || [classic.specular, classic.reflection, classic.transparency].iter().any(|part| !part.is_black());
    let emission = durer_scene::Emission { color: classic.color, strength: classic.ambient, sides: Sides::Both };
    (!gives_back && !emission.is_black()).then_some(emission)
}

/// True if the parts of a classic surface may add up to more than it gets, whatever colors shapes bring.
fn may_exceed_one(classic: &Classic) -> bool {
    let color = match classic.color {
        Paint::Color(color) => color.map(|c| c.max(1.0)),
        Paint::Texture(_) => Rgb::WHITE,
    };
    let opaque = (Rgb::WHITE - classic.transparency) * (color * classic.diffuse + classic.specular);
    (opaque + classic.reflection + classic.transparency).max_component() > 1.0
}

/// The direction of a mirror image: `direction` reflected at a surface with unit normal `normal`.
pub(crate) fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - normal * (2.0 * direction.dot(normal))).normalize()
}

/// Where light goes on behind a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refracted {
    /// Unit direction.
    pub(crate) direction: DVec3,
    /// The part of unpolarised light that is reflected instead (Fresnel).
    pub(crate) reflectance: f64,
}

/// Snell's law and Fresnel's equations at a smooth boundary; `None` for total internal reflection.
///
/// `direction` has unit length and goes against the unit `normal`; `eta` is the index of refraction before the surface
/// divided by that behind it. Born and Wolf, Principles of Optics, §1.5.
pub(crate) fn refract(direction: DVec3, normal: DVec3, eta: f64) -> Option<Refracted> {
    // A shading normal that is edge-on may be so by a rounding on the other side.
    let cos_i = (-direction.dot(normal)).max(0.0);
    let sin2_t = eta * eta * (1.0 - cos_i * cos_i).max(0.0);
    if sin2_t >= 1.0 {
        return None;
    }
    if eta == 1.0 {
        return Some(Refracted { direction, reflectance: 0.0 });
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    Some(Refracted {
        direction: (direction * eta + normal * (eta * cos_i - cos_t)).normalize(),
        reflectance: 0.5 * (parallel * parallel + perpendicular * perpendicular),
    })
}

/// `direction` if it is on the side of `face` that `wanted` says, else its mirror image at the surface.
///
/// A shading normal that leans away from the true one may send light through a surface that reflects it, or back from one
/// that lets it pass. Folding it over changes nothing where the two sides meet, so there is no seam.
pub(crate) fn on_side(direction: DVec3, face: DVec3, wanted: Side) -> DVec3 {
    let height = direction.dot(face);
    let is_right = match wanted {
        Side::Front => height >= 0.0,
        Side::Back => height <= 0.0,
    };
    if is_right { direction } else { direction - face * (2.0 * height) }
}

/// A side of a surface, as seen from where a ray comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// That of the ray.
    Front,
    /// The other one.
    Back,
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::functions::{asin, cos, sin};
    use durer_scene::{Classic, MaterialKind};

    fn at_angle(degrees: f64) -> DVec3 {
        let a = degrees.to_radians();
        DVec3::new(sin(a), -cos(a), 0.0)
    }

    #[test]
    fn snell_holds_at_every_angle() {
        for degrees in 0..90 {
            let direction = at_angle(f64::from(degrees));
            let out = refract(direction, DVec3::Y, 1.0 / 1.5).unwrap().direction;
            assert!((out.x * 1.5 - direction.x).abs() < 1e-14);
            assert!(out.y < 0.0 && out.z == 0.0);
        }
    }

    /// Fresnel's own form, in sines and tangents of the two angles; and what tables give for glass (1.5) in air.
    #[test]
    fn fresnel_matches_its_other_form_and_the_table() {
        for degrees in 1..90 {
            let i = f64::from(degrees).to_radians();
            let t = asin(sin(i) / 1.5);
            let s = sin(i - t) / sin(i + t);
            let p = functions::tan(i - t) / functions::tan(i + t);
            let found = refract(at_angle(f64::from(degrees)), DVec3::Y, 1.0 / 1.5).unwrap().reflectance;
            assert!((found - 0.5 * (s * s + p * p)).abs() < 1e-12);
        }
        let table = [(0.0, 0.04), (30.0, 0.0415), (45.0, 0.0502), (60.0, 0.0892), (75.0, 0.2531)];
        for (degrees, expected) in table {
            let found = refract(at_angle(degrees), DVec3::Y, 1.0 / 1.5).unwrap().reflectance;
            assert!((found - expected).abs() < 6e-5, "{degrees}°: {found}, not {expected}");
        }
        let brewster = functions::atan2(1.5, 1.0).to_degrees();
        // At Brewster's angle only the perpendicular part is left: ½ ((n² - 1)/(n² + 1))².
        let found = refract(at_angle(brewster), DVec3::Y, 1.0 / 1.5).unwrap().reflectance;
        assert!((found - 0.5 * (1.25_f64 / 3.25) * (1.25 / 3.25)).abs() < 1e-12);
    }

    #[test]
    fn reflectance_is_the_same_from_both_sides() {
        for degrees in [5.0, 20.0, 40.0] {
            let inside = refract(at_angle(degrees), DVec3::Y, 1.5).unwrap();
            let back = refract(inside.direction, DVec3::Y, 1.0 / 1.5).unwrap();
            assert!((inside.reflectance - back.reflectance).abs() < 1e-12);
        }
    }

    #[test]
    fn no_more_than_all_is_reflected_by_normals_seen_from_behind() {
        for eta in [0.5, 1.0 / 1.5, 1.2] {
            let edge_on = refract(DVec3::X, DVec3::new(1e-15, 1.0, 0.0), eta);
            assert!(edge_on.is_none_or(|refracted| refracted.reflectance <= 1.0), "{eta}");
        }
    }

    #[test]
    fn the_critical_angle_divides_refraction_from_total_reflection() {
        let critical = asin(1.0 / 1.5).to_degrees(); // 41.81°
        assert!((critical - 41.810_314_895_778_6).abs() < 1e-9);
        assert!(refract(at_angle(critical - 1e-6), DVec3::Y, 1.5).is_some());
        assert!(refract(at_angle(critical + 1e-6), DVec3::Y, 1.5).is_none());
    }

    #[test]
    fn attenuation_gives_its_color_at_its_distance_and_the_square_at_twice_that() {
        let color = Rgb::new(0.5, 0.8, 1.0);
        let attenuation = Some(durer_scene::Attenuation { color, distance: 3.0 });
        let kind = MaterialKind::Classic(Classic { attenuation, ..Default::default() });
        let scene = durer_scene::Scene::default();
        let material = durer_scene::Material::of(kind);
        let material = Material::compile(&material, &mut Means::new(&scene), Integrator::Whitted);
        let near = |a: Rgb, b: Rgb| (a - b).map(f32::abs).max_component() < 1e-6;
        assert!(near(material.transmittance(3.0), color) && near(material.transmittance(6.0), color * color));
        assert_eq!(material.transmittance(f64::INFINITY), Rgb::new(0.0, 0.0, 1.0));
    }
}
