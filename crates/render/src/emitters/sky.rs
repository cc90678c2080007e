//! Aiming at the background.

mod map;

use super::Receiver;
use crate::background::{Background, Look};
use durer_math::functions::cos_sin_of_turns;
use durer_math::{DVec2, DVec3, any_orthonormal_pair};
use map::Map;
use std::f64::consts::PI;

/// The background as an emitter: how to choose a direction.
#[derive(Clone, Debug)]
pub(super) struct Sky {
    kind: Kind,
    /// The mean luminance of all directions.
    mean: f64,
}

#[derive(Clone, Debug)]
enum Kind {
    /// The same everywhere: directions are weighed by the cosine to the receiver's normal.
    Even,
    /// Luminance linear in y, in parts of the mean 1 - `slope` straight down and 1 + `slope` straight up. Half of the
    /// directions are chosen by that, half as for [`Kind::Even`].
    Gradient { slope: f64 },
    /// By what is in a picture.
    Map(Map),
}

impl Sky {
    /// `None` if it is black.
    pub(super) fn new(background: &Background) -> Option<Sky> {
        let (kind, mean) = match background {
            Background::Color(color) => (Kind::Even, f64::from(color.luminance())),
            Background::Gradient { bottom, top } => {
                let [bottom, top] = [bottom, top].map(|color| f64::from(color.luminance()).max(0.0));
                (Kind::Gradient { slope: (top - bottom) / (top + bottom) }, 0.5 * (top + bottom))
            }
            Background::Image(environment) => {
                let map = Map::new(environment)?;
                let mean = map.mean();
                (Kind::Map(map), mean)
            }
        };
        (mean > 0.0 && mean.is_finite()).then_some(Sky { kind, mean })
    }

    /// About the irradiance that it gives to a surface that sees half of it.
    pub(super) fn irradiance(&self) -> f64 {
        PI * self.mean
    }

    /// A direction chosen at random, and its density per solid angle.
    pub(super) fn sample(&self, background: &Background, receiver: &Receiver, at: DVec2) -> Option<(Look, f64)> {
        let direction = match &self.kind {
            Kind::Even => by_cosine(receiver, at),
            Kind::Gradient { slope } if at.x < 0.5 => by_height(*slope, DVec2::new(2.0 * at.x, at.y)),
            Kind::Gradient { .. } => by_cosine(receiver, DVec2::new(2.0 * at.x - 1.0, at.y)),
            Kind::Map(map) => {
                let Background::Image(environment) = background else { return None };
                let (place, direction, pdf) = map.sample(environment, receiver, at)?;
                return Some((Look { direction, place }, pdf));
            }
        };
        let look = background.look(direction);
        let pdf = self.pdf(background, receiver, &look);
        (pdf > 0.0).then_some((look, pdf))
    }

    /// The density with which [`Sky::sample`] finds a direction.
    pub(super) fn pdf(&self, background: &Background, receiver: &Receiver, look: &Look) -> f64 {
        let Look { direction, place } = *look;
        match &self.kind {
            Kind::Even => pdf_by_cosine(receiver, direction),
            Kind::Gradient { slope } => {
                let by_height = (1.0 + slope * direction.y).max(0.0) / (4.0 * PI);
                0.5 * (by_height + pdf_by_cosine(receiver, direction))
            }
            Kind::Map(map) => match background {
                Background::Image(environment) => map.pdf(environment, receiver, place, direction),
                Background::Color(_) | Background::Gradient { .. } => 0.0,
            },
        }
    }
}

/// Density like the cosine to the normal, on the receiver's side or, if light passes there, on both.
fn by_cosine(receiver: &Receiver, at: DVec2) -> DVec3 {
    let (x, side) = match receiver.passes {
        false => (at.x, 1.0),
        true if at.x < 0.5 => (2.0 * at.x, 1.0),
        true => (2.0 * at.x - 1.0, -1.0),
    };
    let (radius, (cos, sin)) = (x.sqrt(), cos_sin_of_turns(at.y));
    let (u, v) = any_orthonormal_pair(receiver.normal);
    let across = u * (radius * cos) + v * (radius * sin);
    (across + receiver.normal * (side * (1.0 - x).sqrt())).normalize()
}

fn pdf_by_cosine(receiver: &Receiver, direction: DVec3) -> f64 {
    let cosine = receiver.normal.dot(direction);
    if receiver.passes { cosine.abs() / (2.0 * PI) } else { cosine.max(0.0) / PI }
}

/// Density like 1 + `slope` · y. Its distribution in y, (y + 1)/2 + slope (y² - 1)/4, is inverted by the root that loses no
/// digits.
fn by_height(slope: f64, at: DVec2) -> DVec3 {
    let c = 2.0 - slope - 4.0 * at.x;
    let y = (-c / (1.0 + (1.0 - slope * c).max(0.0).sqrt())).clamp(-1.0, 1.0);
    let (across, (cos, sin)) = ((1.0 - y * y).sqrt(), cos_sin_of_turns(at.y));
    DVec3::new(across * cos, y, across * sin)
}

#[cfg(test)]
mod tests;
