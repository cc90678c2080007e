//! Flat primitives, met by eight rays at once: the arithmetic of `Shape::intersect` and `Primitive::surface`, operation by
//! operation.

use super::{Kind, Primitive};
use crate::simd::lanes::Lanes;
use durer_math::DVec3;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};

impl Primitive {
    /// True if eight rays can meet it at once.
    #[inline(always)]
    pub(crate) fn is_flat(&self) -> bool {
        self.flat.is_some()
    }

    /// Its normal, if it is flat.
    #[inline(always)]
    pub(crate) fn flat_normal(&self) -> Option<DVec3> {
        self.flat.map(|(normal, _)| normal)
    }

    /// Where rays meet it, if it is flat, and which of them do with 0 < t < `t_max`. Its part is 0.
    #[inline(always)]
    pub(crate) fn meet_lanes<S: Simd>(
        &self,
        simd: S,
        (origin, direction): (Lanes<S>, Lanes<S>),
        t_max: f64x8<S>,
    ) -> (f64x8<S>, mask64x8<S>) {
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let map = &self.shape_from_world;
        let from_middle = origin - Lanes::splat(simd, self.origin);
        let t = -from_middle.row(simd, map, 1) / direction.row(simd, map, 1);
        let met = t.simd_gt(zero) & t.simd_lt(t_max);
        let within = match &self.kind {
            Kind::Plane(_) => return (t, met),
            Kind::Rectangle(_) => {
                let x = from_middle.row(simd, map, 0) + t * direction.row(simd, map, 0);
                let z = from_middle.row(simd, map, 2) + t * direction.row(simd, map, 2);
                x.simd_ge(zero) & x.simd_le(one) & z.simd_ge(zero) & z.simd_le(one)
            }
            Kind::Disc(disc) => {
                let x = from_middle.row(simd, map, 0) + t * direction.row(simd, map, 0);
                let z = from_middle.row(simd, map, 2) + t * direction.row(simd, map, 2);
                let r2 = x * x + z * z;
                r2.simd_le(one) & r2.simd_ge(f64x8::splat(simd, disc.inner_radius * disc.inner_radius))
            }
            Kind::Sphere(_)
            | Kind::Cuboid(_)
            | Kind::Cylinder(_)
            | Kind::Cone(_)
            | Kind::Triangle(_)
            | Kind::Torus(_)
            | Kind::Mesh(_)
            | Kind::Particles(_)
            | Kind::Solid(_) => return (t, t.simd_lt(t) & met),
        };
        (t, met & within)
    }

    /// The points of a flat primitive nearest to points that are near it, and how far from them along the normal one is
    /// surely on that side.
    #[inline(always)]
    pub(crate) fn surface_lanes<S: Simd>(&self, simd: S, near: Lanes<S>) -> (Lanes<S>, f64x8<S>) {
        let in_shape = (near - Lanes::splat(simd, self.origin)).mapped(simd, &self.shape_from_world);
        let snapped = Lanes { y: f64x8::splat(simd, 0.0), ..in_shape };
        let point = Lanes::splat(simd, self.origin) + snapped.mapped(simd, &self.world_from_shape);
        let per_stretch = self.flat.map_or(0.0, |(_, per_stretch)| per_stretch);
        let [world_norm, shape_norm] = self.norms;
        let reach = snapped.largest() * world_norm + point.largest() + super::largest(self.origin);
        // Points with y = 0 are on the shape without rounding.
        let doubt = snapped.largest() * self.residual + reach * (16.0 * f64::EPSILON * shape_norm);
        (point, doubt * 4.0 * per_stretch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::packet::{LANES, Packet};
    use crate::simd::lanes::{Columns, lane_of};
    use crate::{Ray, SimdLevel};
    use durer_math::DAffine3;
    use fearless_simd::dispatch;

    fn flats() -> Vec<Primitive> {
        let tilted = DAffine3::from_scale(DVec3::new(2.0, 0.7, -1.3)) * DAffine3::from_rotation_x(0.4);
        let up = DVec3::new(0.2, 1.0, -0.3);
        vec![
            Primitive::plane(DVec3::new(0.1, -0.5, 0.0), DVec3::Y, &DAffine3::IDENTITY),
            Primitive::plane(DVec3::new(0.1, -0.5, 0.0), up, &tilted),
            Primitive::rectangle(DVec3::NEG_ONE, [DVec3::X * 3.0, DVec3::Z * 2.0], &tilted),
            Primitive::disc(DVec3::ZERO, up, [0.0, 2.0], &tilted),
            Primitive::disc(DVec3::new(0.0, 0.5, 0.0), up, [0.5, 2.0], &DAffine3::IDENTITY),
        ]
    }

    /// Eight rays each, towards the middle, from all around.
    fn packets() -> impl Iterator<Item = Packet> {
        let mut state = 1_u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        std::iter::repeat_with(move || {
            let mut place = |size: f64| DVec3::new(random(), random(), random()) * size;
            let rays: [Ray; LANES] = std::array::from_fn(|_| {
                let origin = place(3.0);
                Ray { origin, direction: (place(1.5) - origin).normalize() }
            });
            Packet::new(&rays)
        })
    }

    #[test]
    fn each_of_eight_rays_meets_what_it_meets_alone() {
        let t_max = 4.0;
        let mut met = 0;
        for level in SimdLevel::available() {
            for (primitive, packet) in flats().iter().flat_map(|flat| packets().take(100).map(move |rays| (flat, rays)))
            {
                let (mut ts, mut points, mut offsets) = ([0.0; LANES], Columns::default(), [0.0; LANES]);
                let which = dispatch!(level.level(), simd => {
                    let rays = (Lanes::load(simd, &packet.origin), Lanes::load(simd, &packet.direction));
                    let (t, met) = primitive.meet_lanes(simd, rays, f64x8::splat(simd, t_max));
                    let (point, offset) = primitive.surface_lanes(simd, rays.0 + rays.1 * t);
                    point.store(&mut points);
                    (ts, offsets) = (t.into(), offset.into());
                    met.to_bitmask()
                });
                for lane in 0..LANES {
                    let alone = primitive.intersect(&packet.ray(lane), t_max);
                    assert_eq!(alone.is_some(), which >> lane & 1 == 1);
                    let Some(crossing) = alone else { continue };
                    let surface = primitive.surface(&packet.ray(lane), &crossing);
                    assert_eq!((ts[lane], 0), (crossing.t, crossing.part));
                    assert_eq!((lane_of(&points, lane), offsets[lane]), (surface.point, surface.offset));
                    met += 1;
                }
            }
        }
        assert!(met > 1000, "{met}");
    }
}
