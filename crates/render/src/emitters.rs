//! All that gives light, to choose from: lamps, glowing shapes, the background.

use crate::compile::CompiledScene;
use durer_geometry::{Hit, Ray, Surface};
use durer_math::{DVec2, DVec3, Rgb};
use std::f32::consts::PI;

/// A point that light falls on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    /// Where shadow rays start on the side that the ray came from.
    pub(crate) point: DVec3,
    /// The unit normal of shading there.
    pub(crate) normal: DVec3,
}

/// Light from an emitter chosen at random, from a point on it chosen at random.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Where it comes from; unit length.
    pub(crate) direction: DVec3,
    /// How far away it is; infinite for the background and directional lights.
    pub(crate) distance: f64,
    /// Radiance; of lamps that are points, irradiance on a surface that faces it.
    pub(crate) light: Rgb,
    /// Density of the direction, per solid angle, times the probability of the emitter; of lamps that are points, the probability.
    pub(crate) pdf: f64,
    /// True if no direction found otherwise could meet it.
    pub(crate) is_point: bool,
    /// Its index in the scene's list of lights, if it is there.
    pub(crate) lamp: Option<usize>,
}

/// The emitters of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Emitters {}

impl Emitters {
    /// Chooses an emitter and a point on it.
    pub(crate) fn sample(
        &self,
        scene: &CompiledScene,
        receiver: &Receiver,
        choice: f64,
        _at: DVec2,
    ) -> Option<LightSample> {
        let count = scene.lights.len();
        let index = ((choice * count as f64) as usize).min(count.checked_sub(1)?);
        let arriving = scene.lights[index].arriving(receiver.point)?;
        Some(LightSample {
            direction: arriving.direction,
            distance: arriving.distance,
            light: arriving.light * PI,
            pdf: 1.0 / count as f64,
            is_point: true,
            lamp: Some(index),
        })
    }

    /// The density with which [`Emitters::sample`] aims from a receiver at what a ray from there has hit, at this distance.
    pub(crate) fn pdf_of_hit(
        &self,
        _scene: &CompiledScene,
        _receiver: &Receiver,
        _ray: &Ray,
        _hit: &Hit,
        _surface: &Surface,
        _distance: f64,
    ) -> f64 {
        0.0
    }

    /// The density with which [`Emitters::sample`] finds this direction of the background.
    pub(crate) fn pdf_of_background(&self, _scene: &CompiledScene, _receiver: &Receiver, _direction: DVec3) -> f64 {
        0.0
    }
}
