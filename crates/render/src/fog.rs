//! Fog, compiled: what is left of light after a length of it.

use durer_math::{Rgb, functions::exp};
use durer_scene as scene;

/// What fog does along one straight segment of a ray's path: `visible · light + (1 - visible) · color`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Veil {
    /// The part of the light that gets through.
    pub(crate) visible: f32,
    /// The colour of the fog.
    pub(crate) color: Rgb,
}

/// The fog on a segment of this length (which may be infinite).
#[inline]
pub(crate) fn veil(fog: &scene::Fog, length: f64) -> Veil {
    match *fog {
        scene::Fog::Exponential { color, distance } => Veil { visible: exp((-length / distance) as f32), color },
        scene::Fog::Linear { color, start, end } => {
            Veil { visible: ((end - length) / (end - start)).clamp(0.0, 1.0) as f32, color }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_fog_leaves_one_part_in_e_at_its_distance() {
        let fog = scene::Fog::Exponential { color: Rgb::WHITE, distance: 400.0 };
        assert!((veil(&fog, 400.0).visible - 0.367_879_44).abs() < 1e-7);
        assert_eq!((veil(&fog, 0.0).visible, veil(&fog, f64::INFINITY).visible), (1.0, 0.0));
    }

    #[test]
    fn linear_fog_is_linear_between_its_ends() {
        let fog = scene::Fog::Linear { color: Rgb::WHITE, start: 10.0, end: 30.0 };
        let visible = [0.0, 10.0, 15.0, 20.0, 30.0, f64::INFINITY].map(|d| veil(&fog, d).visible);
        assert_eq!(visible, [1.0, 1.0, 0.75, 0.5, 0.0, 0.0]);
    }
}
