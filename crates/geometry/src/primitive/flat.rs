//! Primitives and eight rays at once: which come near them, and where they meet flat ones. The latter is the arithmetic of
//! `Shape::intersect` and `Primitive::surface`, operation by operation.

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

    /// True if no straight line meets it again that leaves it on its outside.
    #[inline(always)]
    pub(crate) fn is_convex(&self) -> bool {
        match &self.kind {
            Kind::Sphere(_) | Kind::Cuboid(_) => true,
            Kind::Cylinder(cylinder) => !cylinder.open,
            Kind::Cone(cone) => !cone.open,
            Kind::Plane(_)
            | Kind::Disc(_)
            | Kind::Rectangle(_)
            | Kind::Triangle(_)
            | Kind::Torus(_)
            | Kind::Mesh(_)
            | Kind::Particles(_)
            | Kind::Solid(_) => false,
        }
    }

    /// Which of eight rays, of directions of unit length, come near it: all others surely miss it.
    #[inline(always)]
    pub(crate) fn lanes_near<S: Simd>(&self, simd: S, (origin, direction): (Lanes<S>, Lanes<S>)) -> u32 {
        let (middle, squared_radius) = self.ball;
        let to_middle = Lanes::splat(simd, middle) - origin;
        let along = to_middle.dot(direction);
        let aside = to_middle - direction * along;
        let squared = to_middle.dot(to_middle);
        // What the differences may have lost by rounding is much less than the last term.
        let reach = f64x8::splat(simd, squared_radius) + squared * 1e-12;
        let misses = aside.dot(aside).simd_gt(reach);
        let is_behind = along.simd_lt(f64x8::splat(simd, 0.0)) & squared.simd_gt(reach);
        !(misses | is_behind).to_bitmask() as u32
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
    use durer_math::{DAffine3, DMat3};
    use fearless_simd::dispatch;

    fn flats() -> Vec<Primitive> {
        let tilted =
            DAffine3::from_scale(DVec3::new(2.0, 0.7, -1.3)) * DAffine3::from_mat3(durer_math::rotation(DVec3::X, 0.4));
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

    /// Solid and hollow things, small, stretched and sheared, near and far.
    fn things() -> Vec<Primitive> {
        let far = DAffine3::from_translation(DVec3::new(300.0, -200.0, 100.0));
        let sheared =
            DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(0.7, 0.1, 0.3), DVec3::new(0.0, -0.4, 2.0));
        let maps = [DAffine3::IDENTITY, DAffine3::from_mat3(sheared), far, DAffine3::from_scale(DVec3::splat(1e-3))];
        let (low, high) = (DVec3::new(-0.6, -0.5, 0.1), DVec3::new(0.5, 0.9, 0.4));
        let each = |map: &DAffine3| {
            let mut things = vec![
                Primitive::sphere(low, 0.7, map),
                Primitive::cuboid(low, high, map),
                Primitive::torus(low, high, [0.8, 0.2], map),
                Primitive::triangle([low, high, DVec3::X], [durer_math::DVec2::ZERO; 3], map),
            ];
            for open in [false, true] {
                things.push(Primitive::cylinder(low, high, 0.3, open, map));
                things.push(Primitive::cone(low, high, [0.4, 0.0], open, map));
                things.push(Primitive::cone(low, high, [0.3, 0.5], open, map));
            }
            things
        };
        maps.iter().flat_map(each).chain(flats()).collect()
    }

    #[test]
    fn rays_that_meet_something_come_near_it() {
        let (mut met, mut missed) = (0, 0);
        for level in SimdLevel::available() {
            for thing in things() {
                let bounds = thing.bounds();
                let (middle, size) = match bounds.size().is_finite() {
                    true => (bounds.center(), bounds.size().length()),
                    false => (DVec3::ZERO, 1.0),
                };
                for packet in packets().take(100) {
                    let rays: [Ray; LANES] = std::array::from_fn(|lane| {
                        let ray = packet.ray(lane);
                        Ray { origin: middle + ray.origin * size, direction: ray.direction }
                    });
                    let packet = Packet::new(&rays);
                    let near = dispatch!(level.level(), simd => {
                        let rays = (Lanes::load(simd, &packet.origin), Lanes::load(simd, &packet.direction));
                        thing.lanes_near(simd, rays)
                    });
                    for (lane, ray) in rays.iter().enumerate() {
                        let meets = thing.meets(ray, f64::INFINITY);
                        assert!(!meets || near >> lane & 1 == 1, "{ray:?} {thing:?}");
                        (met, missed) = (met + u32::from(meets), missed + u32::from(near >> lane & 1 == 0));
                    }
                }
            }
        }
        assert!(met > 5_000 && missed > 50_000, "{met} met, {missed} missed");
    }

    /// Directions along the surface are the hardest.
    #[test]
    fn rays_that_leave_what_is_convex_do_not_meet_it_again() {
        let mut left = 0;
        for thing in things().iter().filter(|thing| thing.is_convex()) {
            let (middle, size) = (thing.bounds().center(), thing.bounds().size().length());
            for packet in packets().take(5000) {
                let [ray, other] = [packet.ray(0), packet.ray(1)];
                let ray = Ray { origin: middle + ray.origin * size, direction: ray.direction };
                let Some(crossing) = thing.intersect(&ray, f64::INFINITY) else { continue };
                let surface = thing.surface(&ray, &crossing);
                if ray.direction.dot(surface.normal) >= 0.0 {
                    continue;
                }
                let along = other.direction - surface.normal * other.direction.dot(surface.normal);
                for cosine in [1.1e-6_f64, 1e-4, 0.01, 0.3, 1.0] {
                    let direction =
                        (along.normalize() * (1.0 - cosine * cosine).sqrt() + surface.normal * cosine).normalize();
                    let origin = surface.point + surface.normal * surface.offset;
                    assert!(!thing.meets(&Ray { origin, direction }, f64::INFINITY), "{cosine} {surface:?} {thing:?}");
                    left += 1;
                }
            }
        }
        assert!(left > 10_000, "{left}");
    }
}
