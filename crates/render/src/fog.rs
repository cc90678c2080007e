//! Fog, compiled: what is left of light after a length of it.

use crate::lanes;
use durer_geometry::LANES;
use durer_math::{Rgb, functions::exp};
use durer_scene as scene;
use fearless_simd::{Level, dispatch, f64x8, prelude::*};

/// Fog, compiled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fog {
    color: Rgb,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// What is left after a length is e to the power `rate · length`.
    Exponential { rate: f64 },
    /// What is left after a length is `(end - length) · rate`, within 0..1.
    Linear { end: f64, rate: f64 },
}

/// What fog does along one straight segment of a ray's path: `visible · light + (1 - visible) · color`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Veil {
    /// The part of the light that gets through.
    pub(crate) visible: f32,
    /// The colour of the fog.
    pub(crate) color: Rgb,
}

impl Fog {
    pub(crate) fn compile(fog: &scene::Fog) -> Fog {
        match *fog {
            scene::Fog::Exponential { color, distance } => {
                Fog { color, kind: Kind::Exponential { rate: -1.0 / distance } }
            }
            scene::Fog::Linear { color, start, end } => {
                Fog { color, kind: Kind::Linear { end, rate: 1.0 / (end - start) } }
            }
        }
    }

    /// The fog on a segment of this length (which may be infinite).
    #[inline]
    pub(crate) fn veil(&self, length: f64) -> Veil {
        self.veil_of(match self.kind {
            Kind::Exponential { rate } => exponential(rate, length),
            Kind::Linear { end, rate } => linear(end, rate, length),
        })
    }

    /// The fog on a segment of this length which goes straight on from one that had come so far: where fog is linear, it is no
    /// longer that of its beginning.
    #[inline]
    pub(crate) fn veil_behind(&self, way: f64, length: f64) -> Veil {
        match self.kind {
            Kind::Exponential { .. } => self.veil(length),
            Kind::Linear { end, rate } => {
                let before = linear(end, rate, way);
                self.veil_of(if before > 0.0 { linear(end, rate, way + length) / before } else { 0.0 })
            }
        }
    }

    /// Its color.
    pub(crate) fn color(&self) -> Rgb {
        self.color
    }

    /// The fog of which it is known what it leaves.
    #[inline]
    pub(crate) fn veil_of(&self, visible: f32) -> Veil {
        Veil { visible, color: self.color }
    }

    /// What it leaves on each of eight segments: the same as for one alone.
    pub(crate) fn visible_each(&self, simd: Level, lengths: &[f64; LANES]) -> [f32; LANES] {
        match self.kind {
            Kind::Exponential { rate } => dispatch!(simd, simd => {
                lanes::exp(simd, lanes::single(f64x8::simd_from(simd, *lengths) * rate)).into()
            }),
            Kind::Linear { end, rate } => lengths.map(|length| linear(end, rate, length)),
        }
    }
}

#[inline(always)]
fn exponential(rate: f64, length: f64) -> f32 {
    exp((length * rate) as f32)
}

#[inline(always)]
fn linear(end: f64, rate: f64, length: f64) -> f32 {
    ((end - length) * rate).clamp(0.0, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_fog_leaves_one_part_in_e_at_its_distance() {
        let fog = Fog::compile(&scene::Fog::Exponential { color: Rgb::WHITE, distance: 400.0 });
        assert!((fog.veil(400.0).visible - 0.367_879_44).abs() < 1e-7);
        assert_eq!((fog.veil(0.0).visible, fog.veil(f64::INFINITY).visible), (1.0, 0.0));
    }

    #[test]
    fn linear_fog_is_linear_between_its_ends() {
        let fog = Fog::compile(&scene::Fog::Linear { color: Rgb::WHITE, start: 10.0, end: 30.0 });
        let visible = [0.0, 10.0, 15.0, 20.0, 30.0, f64::INFINITY].map(|d| fog.veil(d).visible);
        assert_eq!(visible, [1.0, 1.0, 0.75, 0.5, 0.0, 0.0]);
    }

    #[test]
    fn fog_in_parts_is_the_fog_of_the_whole() {
        let linear = scene::Fog::Linear { color: Rgb::WHITE, start: 10.0, end: 30.0 };
        let exponential = scene::Fog::Exponential { color: Rgb::WHITE, distance: 20.0 };
        for fog in [linear, exponential].iter().map(Fog::compile) {
            for parts in [[5.0, 15.0, 7.0], [12.0, 3.0, 1.0], [3.0, 4.0, 2.0], [25.0, 10.0, 10.0]] {
                let (mut way, mut visible) = (0.0, 1.0);
                for part in parts {
                    visible *= fog.veil_behind(way, part).visible;
                    way += part;
                }
                assert!((visible - fog.veil(way).visible).abs() < 1e-6, "{parts:?}: {visible}");
            }
        }
    }
}
