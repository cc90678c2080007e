//! One sphere of many.

use super::{LARGE_LEAVES, Particle, wide};
use crate::Slender;
use crate::bvh::build::Leaves;
use crate::sample::{Piece, Shows};
use crate::shapes::Shape;
use crate::shapes::sphere::{Sphere, outward};
use crate::simd::blocks::{Block, Hits, WideRay};
use crate::simd::boxes::{Box32, round_down, round_up};
use crate::simd::spheres;
use durer_math::{DAffine3, DMat3, DVec2, DVec3};
use fearless_simd::Simd;

/// A sphere where it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

impl Ball {
    /// The smallest box around it in single precision, as least and greatest coordinates.
    pub(super) fn corners(&self) -> [[f32; 3]; 2] {
        let reach = DVec3::splat(self.radius);
        [(self.center - reach).to_array().map(round_down), (self.center + reach).to_array().map(round_up)]
    }

    /// From the center towards a point, of unit length.
    fn towards(&self, point: DVec3) -> DVec3 {
        outward(point - self.center)
    }
}

impl Particle<{ spheres::NUMBERS }> for Ball {
    const LEAVES: Leaves = LARGE_LEAVES;

    fn of([x, y, z, radius]: [f32; spheres::NUMBERS]) -> Ball {
        Ball { center: wide([x, y, z]), radius: f64::from(radius) }
    }

    #[inline(always)]
    fn hits<S: Simd>(simd: S, block: &Block<{ spheres::NUMBERS }>, ray: &WideRay<S>, t_max: f64) -> Hits {
        spheres::hits(simd, block, ray, t_max)
    }

    fn bounds(&self) -> Box32 {
        let [min, max] = self.corners();
        Box32::new(min, max)
    }

    fn slender(&self) -> Slender {
        Slender { ends: [self.center; 2], radius: self.radius, core: self.radius, is_part: false }
    }

    fn surface(&self, point: DVec3, _face: u32) -> (DVec3, DVec3) {
        let normal = self.towards(point);
        (self.center + normal * self.radius, normal)
    }

    fn uv(&self, point: DVec3, _face: u32) -> DVec2 {
        Sphere.uv(self.towards(point), 0)
    }

    fn contains(&self, point: DVec3) -> bool {
        (point - self.center).length_squared() < self.radius * self.radius
    }

    fn piece(&self, map: &DAffine3) -> Option<Piece> {
        let place = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(self.radius)), self.center);
        Some(Piece::ball(&(*map * place), Shows::OneSide))
    }

    /// As for the single sphere, and that the point is rounded where it is.
    fn rounding(&self) -> f64 {
        let reach = self.center.abs().max_element() + self.radius;
        (11.0 * self.radius + reach) * f64::EPSILON
    }
}
