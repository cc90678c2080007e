//! One capsule of many: a cylinder with a half ball at each end.

use super::axial::Axis;
use super::ball::Ball;
use super::{Particle, SMALL_LEAVES, wide};
use crate::Slender;
use crate::bvh::build::Leaves;
use crate::sample::Piece;
use crate::shapes::sphere::longitude;
use crate::simd::blocks::{Block, Hits, WideRay};
use crate::simd::boxes::Box32;
use crate::simd::capsules;
use durer_math::functions::asin;
use durer_math::{DAffine3, DVec2, DVec3};
use fearless_simd::Simd;
use std::f64::consts::{FRAC_PI_2, PI};

/// A capsule where it is: all points no further than a radius from its axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    axis: Axis,
    radius: f64,
}

impl Capsule {
    /// The point of the axis that is nearest to a point.
    fn nearest(&self, point: DVec3) -> DVec3 {
        let (height, _) = self.axis.split(point);
        self.axis.base + self.axis.up() * height.clamp(0.0, self.axis.length())
    }
}

impl Particle<{ capsules::NUMBERS }> for Capsule {
    const LEAVES: Leaves = SMALL_LEAVES;

    fn of(numbers: [f32; capsules::NUMBERS]) -> Self {
        let [base_x, base_y, base_z, top_x, top_y, top_z, radius] = numbers;
        let axis = Axis { base: wide([base_x, base_y, base_z]), top: wide([top_x, top_y, top_z]) };
        Capsule { axis, radius: f64::from(radius) }
    }

    #[inline(always)]
    fn hits<S: Simd>(simd: S, block: &Block<{ capsules::NUMBERS }>, ray: &WideRay<S>, t_max: f64) -> Hits {
        capsules::hits(simd, block, ray, t_max)
    }

    fn bounds(&self) -> Box32 {
        let ends = [self.axis.base, self.axis.top];
        let [base, top] = ends.map(|center| Ball { center, radius: self.radius }.bounds());
        base.union(top)
    }

    fn slender(&self) -> Slender {
        Slender { ends: [self.axis.base, self.axis.top], radius: self.radius, core: self.radius, is_part: false }
    }

    fn surface(&self, point: DVec3, _face: u32) -> (DVec3, DVec3) {
        let center = self.nearest(point);
        Ball { center, radius: self.radius }.surface(point, 0)
    }

    /// Longitude, and the way along the surface from pole to pole, from 0 to 1: an image is stretched alike on side and
    /// half balls.
    fn uv(&self, point: DVec3, _face: u32) -> DVec2 {
        let (length, radius) = (self.axis.length(), self.radius);
        let point = self.axis.upright(point);
        let on_axis = point.y.clamp(0.0, length);
        let latitude = asin(((point.y - on_axis) / radius).clamp(-1.0, 1.0));
        let way = on_axis + radius * (latitude + FRAC_PI_2);
        DVec2::new(longitude(point), way / (length + radius * PI))
    }

    fn contains(&self, point: DVec3) -> bool {
        (point - self.nearest(point)).length_squared() < self.radius * self.radius
    }

    fn piece(&self, map: &DAffine3) -> Option<Piece> {
        let place = self.axis.frame(DVec3::splat(self.radius));
        Some(Piece::capsule(&(*map * place), self.axis.length() / self.radius))
    }

    /// As for frusta, whose reasoning holds here.
    fn rounding(&self) -> f64 {
        let size = self.axis.length() + self.radius;
        (16.0 * size + 2.0 * self.axis.largest()) * f64::EPSILON
    }
}
