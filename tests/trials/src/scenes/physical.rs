//! What path tracing needs, put onto a scene that is made already: physical materials and lights, relief, lenses, pictures of
//! the sky, other integrators. Without dice nothing changes.

use super::{Maker, TEXTURES};
use durer::math::Rgb;
use durer::scene::{
    Attenuation, Background, Bump, Conductor, Emission, Environment, Falloff, Focus, Glass, ImageId, Integrator, Lens,
    LightKind, Material, MaterialKind, Matte, Metal, MetalName, Mirror, NormalMap, Paint, PathSettings, Plastic,
    Principled, Relief, Scene, Sides, Strength,
};

impl Maker<'_, '_> {
    pub(super) fn make_physical(&mut self, scene: &mut Scene) {
        if self.dice.below(3) == 0 {
            return;
        }
        for material in &mut scene.materials {
            self.change_material(material);
        }
        for light in &mut scene.lights {
            let amount = light.strength.amount();
            light.strength = self.strength_of(light.kind, amount);
            if let LightKind::Point { radius, .. } | LightKind::Spot { radius, .. } = &mut light.kind
                && self.dice.below(3) == 2
            {
                *radius = 0.1 * self.size();
            }
        }
        if self.dice.below(4) == 3 {
            let rotation_degrees = self.dice.within(-180.0, 180.0);
            let strength = self.strength();
            scene.background = Background::Image(Environment { image: ImageId(0), rotation_degrees, strength });
        }
        if let Some(camera) = scene.camera.as_mut().filter(|_| self.dice.below(3) == 2) {
            camera.lens = Some(self.lens());
        }
        scene.render.integrator = self.integrator();
        scene.render.samples = Some(1 + self.dice.below(3) as u32);
        scene.render.light_samples = 1 + self.dice.below(3) as u32;
        scene.render.seed = self.dice.below(3) as u32;
    }

    fn change_material(&mut self, material: &mut Material) {
        if let Some(kind) = self.kind() {
            material.kind = kind;
        }
        if !material.emission.is_black() && self.dice.below(2) == 1 {
            let color = if self.dice.one_in(2) { self.paint(TEXTURES) } else { material.emission.color };
            let sides = self.dice.one_of(&[Sides::Both, Sides::Front]);
            material.emission = Emission { color, strength: self.strength(), sides };
        }
        material.relief = match self.dice.below(6) {
            4 => {
                let texture = self.paint(TEXTURES);
                Some(Relief::NormalMap(NormalMap { texture, strength: self.strength() }))
            }
            5 => Some(Relief::Bump(Bump { height: self.paint(TEXTURES), size: self.dice.within(-0.2, 0.2) })),
            _ => None,
        };
    }

    fn kind(&mut self) -> Option<MaterialKind> {
        Some(match self.dice.below(9) {
            3 => MaterialKind::Matte(Matte { color: self.paint(TEXTURES), roughness: self.amount() }),
            4 => {
                let conductor = match self.dice.below(3) {
                    0 => Conductor::Named(self.dice.one_of(&[MetalName::Gold, MetalName::Aluminum, MetalName::Iron])),
                    1 => Conductor::Reflectance(self.paint(TEXTURES)),
                    _ => Conductor::Index { eta: self.color() + Rgb::gray(0.01), k: self.color() * 9.0 },
                };
                let (roughness, anisotropy, rotation) = (self.amount(), self.amount(), self.amount());
                MaterialKind::Metal(Metal { conductor, roughness, anisotropy, rotation })
            }
            5 => MaterialKind::Glass(Glass {
                ior: self.ior(),
                roughness: self.amount(),
                color: self.paint(TEXTURES),
                attenuation: self.option(Self::attenuation),
                priority: self.dice.below(3) as i32,
                thin: self.dice.one_in(2),
            }),
            6 => {
                let color = self.paint(TEXTURES);
                MaterialKind::Plastic(Plastic { color, ior: self.ior().max(1.0), roughness: self.amount() })
            }
            7 => MaterialKind::Mirror(Mirror { color: self.paint(TEXTURES) }),
            8 => MaterialKind::Principled(Box::new(self.principled())),
            _ => return None,
        })
    }

    fn principled(&mut self) -> Principled {
        Principled {
            base_color: self.paint(TEXTURES),
            metallic: self.amount(),
            roughness: self.amount(),
            ior: self.ior().max(1.0),
            specular: self.amount(),
            specular_color: self.paint(TEXTURES),
            transmission: self.amount(),
            thin: self.dice.one_in(2),
            attenuation: self.option(Self::attenuation),
            clearcoat: self.amount(),
            clearcoat_roughness: self.amount(),
            sheen_color: self.paint(TEXTURES),
            sheen_roughness: self.amount(),
            anisotropy: self.amount(),
            anisotropy_rotation: self.amount(),
        }
    }

    /// A number from 0 to 1, or a texture.
    fn amount(&mut self) -> Paint {
        match self.dice.below(4) {
            3 => match self.paint(TEXTURES) {
                Paint::Color(color) => Paint::Color(Rgb::gray(color.g)),
                texture @ Paint::Texture(_) => texture,
            },
            _ => Paint::Color(Rgb::gray(self.fraction())),
        }
    }

    fn attenuation(&mut self) -> Attenuation {
        let color = Rgb::new(self.fraction(), self.fraction(), self.fraction()).map(|part| part.max(1e-6));
        Attenuation { color, distance: self.size() }
    }

    fn strength_of(&mut self, kind: LightKind, amount: f32) -> Strength {
        let physical = self.dice.below(2) == 1;
        match kind {
            LightKind::Directional { .. } if physical => Strength::Irradiance(amount),
            LightKind::Point { falloff: Falloff::InverseSquare, .. }
            | LightKind::Spot { falloff: Falloff::InverseSquare, .. }
                if physical =>
            {
                self.dice.one_of(&[Strength::Power(amount), Strength::RadiantIntensity(amount)])
            }
            LightKind::Directional { .. } | LightKind::Point { .. } | LightKind::Spot { .. } => {
                Strength::Classic(amount)
            }
        }
    }

    fn lens(&mut self) -> Lens {
        let focus = match self.dice.below(2) {
            0 => Focus::LookAt,
            _ => Focus::Distance(self.size()),
        };
        let (radius, blades) = (0.1 * self.size(), self.dice.one_of(&[0, 3, 6]));
        Lens { radius: radius.max(1e-9), focus, blades, rotation_degrees: self.dice.within(0.0, 360.0) }
    }

    fn integrator(&mut self) -> Integrator {
        match self.dice.below(8) {
            4 => Integrator::Path(PathSettings {
                max_depth: 1 + self.dice.below(6) as u32,
                clamp: None,
                split: 1 + self.dice.below(3) as u32,
                reuse: self.dice.one_of(&PathSettings::REUSES),
            }),
            5 => Integrator::AmbientOcclusion { distance: self.option(Self::size) },
            6 => Integrator::Normals,
            7 => self.dice.one_of(&[Integrator::Depth, Integrator::Uv]),
            _ => Integrator::Whitted,
        }
    }
}
