//! One frustum of many: a cylinder if its radii are equal, a cone if one of them is 0.

use super::axial::Axis;
use super::{Particle, SMALL_LEAVES, wide};
use crate::Slender;
use crate::bvh::build::Leaves;
use crate::sample::{Piece, Shows};
use crate::shapes::sphere::longitude;
use crate::simd::blocks::{Block, Hits, WideRay};
use crate::simd::boxes::{Box32, round_down, round_up};
use crate::simd::frusta;
use durer_math::{DAffine3, DVec2, DVec3};
use fearless_simd::Simd;

/// A frustum where it is. Face 0 is the side, 1 the base, 2 the top; open ones have a side only, which rays meet from both
/// sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frustum<const OPEN: bool> {
    axis: Axis,
    /// At base and top.
    radii: [f64; 2],
}

impl<const OPEN: bool> Frustum<OPEN> {
    fn widest(&self) -> f64 {
        self.radii[0].max(self.radii[1])
    }

    /// How fast the radius grows with the height.
    fn slope(&self) -> f64 {
        (self.radii[1] - self.radii[0]) / self.axis.length()
    }

    /// The nearest point of the side, and the normal there; at a tip the normal is the axis.
    fn side_at(&self, point: DVec3) -> (DVec3, DVec3) {
        let (length, up, slope) = (self.axis.length(), self.axis.up(), self.slope());
        let (height, away) = self.axis.split(point);
        let distance = away.length();
        if distance == 0.0 && self.radii[0] * self.radii[1] == 0.0 {
            return if slope < 0.0 { (self.axis.top, up) } else { (self.axis.base, -up) };
        }
        let outward = if distance > 0.0 { away / distance } else { up.any_orthonormal_vector() };
        let beyond = (distance - self.radii[0] - slope * height) / (1.0 + slope * slope);
        // A point exactly on a rim, moved inwards along one of the two normals there, would still be on the other surface.
        let inset = self.rounding().min(length * 0.5);
        let height = (height + slope * beyond).clamp(inset, length - inset);
        let radius = self.radii[0] + slope * height;
        let normal = (outward - up * slope).normalize();
        (self.axis.base + up * height + outward * radius, normal)
    }

    /// The nearest point of a cap.
    fn cap_at(&self, point: DVec3, middle: DVec3, radius: f64) -> DVec3 {
        let (_, away) = self.axis.split(point);
        let (distance, inside) = (away.length(), (radius - self.rounding()).max(0.0));
        middle + if distance > inside { away * (inside / distance) } else { away }
    }
}

impl<const OPEN: bool> Particle<{ frusta::NUMBERS }> for Frustum<OPEN> {
    const LEAVES: Leaves = SMALL_LEAVES;

    fn of(numbers: [f32; frusta::NUMBERS]) -> Self {
        let [base_x, base_y, base_z, top_x, top_y, top_z, base_radius, top_radius] = numbers;
        let axis = Axis { base: wide([base_x, base_y, base_z]), top: wide([top_x, top_y, top_z]) };
        Frustum { axis, radii: [base_radius, top_radius].map(f64::from) }
    }

    #[inline(always)]
    fn hits<S: Simd>(simd: S, block: &Block<{ frusta::NUMBERS }>, ray: &WideRay<S>, t_max: f64) -> Hits {
        frusta::hits::<S, OPEN>(simd, block, ray, t_max)
    }

    /// A disc reaches along an axis as far as the sine of the angle to its normal says.
    fn bounds(&self) -> Box32 {
        let up = self.axis.up();
        let sine = |a: f64, b: f64| (a * a + b * b).sqrt() * (1.0 + 8.0 * f64::EPSILON);
        let sines = DVec3::new(sine(up.y, up.z), sine(up.z, up.x), sine(up.x, up.y));
        let (base, top) = (sines * self.radii[0], sines * self.radii[1]);
        let min = (self.axis.base - base).min(self.axis.top - top);
        let max = (self.axis.base + base).max(self.axis.top + top);
        Box32::new(min.to_array().map(round_down), max.to_array().map(round_up))
    }

    fn slender(&self) -> Slender {
        let core = (self.radii[0] + self.radii[1]) * 0.5;
        Slender { ends: [self.axis.base, self.axis.top], radius: self.widest(), core, is_part: false }
    }

    fn surface(&self, point: DVec3, face: u32) -> (DVec3, DVec3) {
        match face {
            0 => self.side_at(point),
            1 => (self.cap_at(point, self.axis.base, self.radii[0]), -self.axis.up()),
            _ => (self.cap_at(point, self.axis.top, self.radii[1]), self.axis.up()),
        }
    }

    /// As for single cones: on the side longitude, and height from 0 to 1; on the caps the square around the larger of
    /// both.
    fn uv(&self, point: DVec3, face: u32) -> DVec2 {
        let point = self.axis.upright(point);
        match face {
            0 => DVec2::new(longitude(point), point.y / self.axis.length()),
            _ => (DVec2::new(point.x, point.z) / self.widest() + 1.0) * 0.5,
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let (height, away) = self.axis.split(point);
        let radius = self.radii[0] + self.slope() * height;
        !OPEN && height > 0.0 && height < self.axis.length() && away.length_squared() < radius * radius
    }

    fn piece(&self, map: &DAffine3) -> Option<Piece> {
        let (length, widest) = (self.axis.length(), self.widest());
        let place = self.axis.frame(DVec3::new(widest, length, widest));
        let radii = self.radii.map(|radius| radius / widest);
        (length > 0.0 && widest > 0.0).then(|| Piece::frustum(&(*map * place), radii, OPEN, Shows::OneSide))
    }

    /// With u = 2⁻⁵³: putting a point on the surface leaves it within 10 u of the size and 3.5 u of the coordinates; a ray's
    /// origin is split along the axis to 3 u of the size, and its distance from the surface is computed to 6 u of the radius.
    /// Nearly twice their sum.
    fn rounding(&self) -> f64 {
        let size = self.axis.length() + self.widest();
        (16.0 * size + 2.0 * self.axis.largest()) * f64::EPSILON
    }
}
