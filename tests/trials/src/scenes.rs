//! Scenes at random: of every kind of thing that there is, with numbers that the check lets pass, mostly.

mod looks;
mod many;
pub mod maps;
mod objects;
mod physical;

use crate::Dice;
use durer::math::{DVec3, Rgb};
use durer::scene::{
    Antialias, Background, Camera, Falloff, Fog, Light, LightKind, Picture, PixelFilter, Projection, RenderSettings,
    Scene, Strength, Trees,
};

/// Which numbers scenes are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Temper {
    /// Things about as large as a hand, not far from each other, no two in exactly the same place.
    Everyday,
    /// All that the check allows: the tiny, the huge and the far, and things that touch or coincide.
    Extreme,
}

/// Makes a scene, one choice after the other.
struct Maker<'d, 'b> {
    dice: &'d mut Dice<'b>,
    temper: Temper,
}

/// Number of the materials of a scene.
const MATERIALS: usize = 3;
/// Number of its textures.
const TEXTURES: usize = 3;
/// Edges of its picture.
const PIXELS: u32 = 8;

/// A scene of a few objects with a picture of 8 × 8 pixels. Few do not pass the check.
pub fn scene(dice: &mut Dice<'_>, temper: Temper) -> Scene {
    let mut maker = Maker { dice, temper };
    let mut scene = maker.classic_scene();
    maker.make_physical(&mut scene);
    scene
}

/// The same scene before anything physical was put onto it, for Whitted's algorithm.
pub fn classic_scene(dice: &mut Dice<'_>, temper: Temper) -> Scene {
    Maker { dice, temper }.classic_scene()
}

impl Maker<'_, '_> {
    fn classic_scene(&mut self) -> Scene {
        let maker = self;
        let camera = maker.camera();
        Scene {
            camera,
            picture: Picture { width: PIXELS, height: PIXELS, ..Picture::default() },
            render: maker.settings(),
            background: maker.background(),
            ambient: maker.light_color(),
            fog: maker.fog(),
            lights: maker.some(3, Maker::light),
            images: vec![maker.image()],
            textures: (0..TEXTURES).map(|before| maker.texture(before)).collect(),
            materials: (0..MATERIALS).map(|_| maker.material()).collect(),
            objects: maker.some(5, |maker| maker.object(0)),
        }
    }

    fn some<T>(&mut self, most: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = 1 + self.dice.below(most);
        (0..count).map(|_| make(self)).collect()
    }

    fn option<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.dice.one_in(2).then(|| make(self))
    }

    /// True if numbers may be extreme here.
    fn is_odd(&mut self) -> bool {
        self.temper == Temper::Extreme && self.dice.one_in(4)
    }

    /// Any power of ten between the smallest and the largest size, and what is between them.
    fn magnitude(&mut self, least: i32, most: i32) -> f64 {
        let exponent = least + self.dice.below((most - least) as usize) as i32;
        // Powers by the platform's own functions are not the same on every machine; numbers that are read are.
        let power = format!("1e{exponent}").parse().unwrap_or(1.0);
        self.dice.within(1.0, 10.0) * power
    }

    /// A coordinate.
    fn number(&mut self) -> f64 {
        if !self.is_odd() {
            return self.dice.within(-3.0, 3.0);
        }
        match self.dice.below(4) {
            0 => 0.0,
            1 => self.dice.below(9) as f64 - 4.0,
            2 => self.magnitude(-20, 12),
            _ => -self.magnitude(-20, 12),
        }
    }

    /// A radius, width or distance.
    fn size(&mut self) -> f64 {
        if !self.is_odd() {
            return self.dice.within(0.2, 2.0);
        }
        match self.dice.below(4) {
            0 => 1.0,
            1 => 1.0 + self.dice.below(4) as f64,
            _ => self.magnitude(-9, 12),
        }
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// A direction of any length but zero.
    fn direction(&mut self) -> DVec3 {
        match self.is_odd() {
            true => self.dice.one_of(&[DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_Y, DVec3::ONE]),
            false => DVec3::new(self.dice.within(0.1, 2.0), self.number(), self.number()),
        }
    }

    /// From 0 to 1, and often just that.
    fn fraction(&mut self) -> f32 {
        match self.dice.below(4) {
            0 => 0.0,
            1 => 1.0,
            _ => self.dice.unit() as f32,
        }
    }

    fn color(&mut self) -> Rgb {
        match self.dice.one_in(2) {
            true => Rgb::gray(self.fraction()),
            false => Rgb::new(self.fraction(), self.fraction(), self.fraction()),
        }
    }

    /// Colors that may be brighter than white.
    fn light_color(&mut self) -> Rgb {
        match self.is_odd() {
            true => Rgb::gray(self.dice.one_of(&[0.0, 1e-30, 1e3, 1e6])),
            false => self.color(),
        }
    }

    fn strength(&mut self) -> f32 {
        match self.is_odd() {
            true => self.dice.one_of(&[0.0, 1e-30, 10.0, 1e6]),
            false => self.dice.unit() as f32,
        }
    }

    fn camera(&mut self) -> Option<Camera> {
        if self.is_odd() && self.dice.one_in(2) {
            return None;
        }
        let projection = match self.dice.below(3) {
            0 => {
                Projection::FieldOfView { degrees: if self.is_odd() { 179.9999 } else { self.dice.within(20.0, 90.0) } }
            }
            1 => Projection::ImagePlane { distance: self.size(), half_height: self.size() },
            _ => Projection::Orthographic { height: 4.0 * self.size() },
        };
        // Mostly from outside, so that there is something to be seen.
        let position = match self.is_odd() {
            true => self.point(),
            false => DVec3::new(self.dice.within(-2.0, 2.0), self.dice.within(-2.0, 2.0), self.dice.within(5.0, 8.0)),
        };
        let look_at = DVec3::new(self.dice.within(-1.0, 1.0), self.dice.within(-1.0, 1.0), 0.0);
        Some(Camera { position, look_at, up: DVec3::new(0.1, 1.0, 0.0), projection, lens: None })
    }

    fn settings(&mut self) -> RenderSettings {
        let antialias = match self.dice.below(8) {
            0..=2 => Antialias::None,
            3 => Antialias::Grid { n: 2 },
            4 => Antialias::Recursive { threshold: self.fraction(), max_depth: 1 },
            5 => Antialias::Pov1 { threshold: self.fraction(), depth: 2 },
            6 => Antialias::Pov2 { threshold: self.fraction(), depth: 2 },
            _ => Antialias::Adaptive { threshold: self.fraction(), max_depth: 2 },
        };
        // None that is below 0 anywhere, so that no pixel is.
        let filter = match self.dice.below(8) {
            0 => PixelFilter::Tent { radius: 1.5 },
            1 => PixelFilter::Gaussian { radius: 2.0, sigma: 0.7 },
            2 => PixelFilter::BlackmanHarris { radius: 1.5 },
            _ => PixelFilter::Box,
        };
        RenderSettings {
            max_depth: 1 + self.dice.below(4) as u32,
            min_weight: if self.dice.one_in(4) { self.fraction() } else { 0.0 },
            antialias,
            filter,
            trees: self.dice.one_of(&[Trees::Preview, Trees::Picture, Trees::ManyRays]),
            ..RenderSettings::default()
        }
    }

    fn background(&mut self) -> Background {
        match self.dice.one_in(2) {
            true => Background::Color(self.light_color()),
            false => Background::Gradient { bottom: self.light_color(), top: self.light_color() },
        }
    }

    fn fog(&mut self) -> Option<Fog> {
        let color = self.light_color();
        match self.dice.below(4) {
            2 => Some(Fog::Exponential { color, distance: 5.0 * self.size() }),
            3 => {
                let start = self.size();
                Some(Fog::Linear { color, start, end: start + 5.0 * self.size() })
            }
            _ => None,
        }
    }

    fn light(&mut self) -> Light {
        let falloff = self.dice.one_of(&[Falloff::None, Falloff::InverseSquare]);
        let kind = match self.dice.below(3) {
            0 => LightKind::Point { position: self.lamp(), falloff, radius: 0.0 },
            1 => {
                let edge =
                    if self.is_odd() { self.dice.one_of(&[1e-5, 90.0, 180.0]) } else { self.dice.within(20.0, 80.0) };
                let inner = edge * f64::from(self.fraction());
                LightKind::Spot {
                    position: self.lamp(),
                    target: self.point(),
                    half_angle_degrees: edge,
                    inner_half_angle_degrees: inner,
                    falloff,
                    radius: 0.0,
                }
            }
            _ => LightKind::Directional { direction: self.direction() },
        };
        Light { name: None, color: self.light_color(), strength: Strength::Classic(self.strength()), kind }
    }

    /// Where a light is: mostly above.
    fn lamp(&mut self) -> DVec3 {
        match self.is_odd() {
            true => self.point(),
            false => self.point() + DVec3::Y * 5.0,
        }
    }
}
