//! Thin sheets of a dielectric, such as panes: two boundaries in one place, between which light goes to and fro.

use super::fresnel;
use super::{How, Scattered};
use durer_math::{DVec3, Rgb};

/// A smooth thin sheet. It mirrors some light and lets the rest go straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sheet {
    /// Index of refraction in it, over that around it.
    eta: f64,
    /// What color light takes on that is let through.
    tint: Rgb,
}

impl Sheet {
    pub(crate) fn new(eta: f64, tint: Rgb) -> Sheet {
        Sheet { eta, tint }
    }

    /// The part that is reflected: with R at each boundary, R + (1-R)² R (1 + R² + R⁴ + …) = 2R / (1 + R).
    pub(crate) fn reflectance(&self, cos: f64) -> f64 {
        let once = fresnel::dielectric(cos, self.eta).reflectance;
        2.0 * once / (1.0 + once)
    }

    /// What goes straight on.
    pub(crate) fn straight(&self, out: DVec3) -> Rgb {
        self.tint * ((1.0 - self.reflectance(out.z)) as f32)
    }

    pub(crate) fn sample(&self, out: DVec3, lobe: f64) -> Scattered {
        if lobe < self.reflectance(out.z) {
            return Scattered::mirrored(out, Rgb::WHITE);
        }
        Scattered { direction: -out, weight: self.tint, how: How::Straight, scale: 1.0 }
    }

    /// What goes on of white light, to either side.
    pub(crate) fn albedo(&self, out: DVec3) -> Rgb {
        self.straight(out) + Rgb::gray(self.reflectance(out.z) as f32)
    }
}
