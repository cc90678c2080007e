//! Where small and thin things are, without a ray: what the samples of a picture may all miss.

use crate::Bounds;
use durer_math::functions::{cos, sin};
use durer_math::{DMat3, DVec3};

/// A thing, as a line with a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slender {
    /// The ends of the line; for something round they are the same.
    pub ends: [DVec3; 2],
    /// All of the thing is within this distance of the line.
    pub radius: f64,
    /// About the middle of the line the thing covers this much to both sides, from wherever it is seen. For shapes of which
    /// only a box is known this is a guess.
    pub core: f64,
    /// True if it is one of many that make up a surface.
    pub is_part: bool,
}

/// How a shape fills its box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// As an ellipsoid.
    Ball,
    /// As a flat disc.
    Disc,
    /// As a cylinder, at least in its middle.
    Rod,
    /// In a way that is not known.
    Any,
}

impl Slender {
    /// What is inside a box, along its longest edge: in its own space, and placed by an affine map.
    pub(crate) fn of_box(bounds: &Bounds, form: Form, map: &DMat3, origin: DVec3) -> Slender {
        let (center, half) = (origin + *map * bounds.center(), bounds.size() * 0.5);
        let mut axes = [map.x_axis * half.x, map.y_axis * half.y, map.z_axis * half.z];
        axes.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let ([thin, thick, _], long) = (axes.map(DVec3::length), axes[2]);
        let ends = |long: DVec3| [center - long, center + long];
        let round = ends(long - long.normalize_or_zero() * thick);
        let box_radius = (thin * thin + thick * thick).sqrt();
        let (ends, radius, core) = match form {
            Form::Ball => (round, thick, thin),
            // Seen neither edge-on nor from the front.
            Form::Disc => (round, thick, 0.75 * thick),
            Form::Rod => (ends(long), thick, thin),
            Form::Any => (ends(long), box_radius, box_radius * 0.5),
        };
        Slender { ends, radius, core, is_part: false }
    }

    /// A triangle, along its longest edge.
    pub(crate) fn of_triangle([a, b, c]: [DVec3; 3]) -> Slender {
        let turned = [[a, b, c], [b, c, a], [c, a, b]];
        let longer = |one: [DVec3; 3], other: [DVec3; 3]| match (one[1] - one[0]).length_squared()
            < (other[1] - other[0]).length_squared()
        {
            true => other,
            false => one,
        };
        let [from, to, tip] = longer(longer(turned[0], turned[1]), turned[2]);
        let along = (to - from).normalize_or_zero();
        // From the edge to the tip, at a right angle.
        let height = (tip - from) - along * (tip - from).dot(along);
        let radius = height.length() * 0.5;
        Slender { ends: [from + height * 0.5, to + height * 0.5], radius, core: radius * 0.5, is_part: false }
    }

    /// Calls `visit` with pieces of a ring about the y axis, of a radius and with a half-width.
    pub(crate) fn each_of_ring(radius: f64, half_width: f64, visit: &mut dyn FnMut(Slender)) {
        const PIECES: u32 = 48;
        let angle = |piece: u32| std::f64::consts::TAU * f64::from(piece) / f64::from(PIECES);
        let at = |piece: u32| DVec3::new(cos(angle(piece)), 0.0, sin(angle(piece))) * radius;
        // Between its ends a piece bends away from the line so far.
        let bend = radius * (1.0 - cos(angle(1) * 0.5));
        for piece in 0..PIECES {
            visit(Slender {
                ends: [at(piece), at(piece + 1)],
                radius: half_width + bend,
                core: half_width,
                is_part: false,
            });
        }
    }

    /// Moved by an affine map.
    pub(crate) fn mapped(self, map: &DMat3, origin: DVec3) -> Slender {
        let [least, greatest] = stretches(map);
        let ends = self.ends.map(|end| origin + *map * end);
        Slender { ends, radius: self.radius * greatest, core: self.core * least, ..self }
    }
}

/// Bounds on the least and the greatest stretch of a map; exact where it keeps the right angles between the axes.
fn stretches(map: &DMat3) -> [f64; 2] {
    let columns = [map.x_axis, map.y_axis, map.z_axis];
    let [x, y, z] = columns;
    let lengths = columns.map(DVec3::length);
    let (least, greatest) = lengths.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &l| (a.min(l), b.max(l)));
    let skew = x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs());
    if skew <= 1e-9 * least * least {
        return [least, greatest];
    }
    let size = |map: &DMat3| [map.x_axis, map.y_axis, map.z_axis].map(DVec3::length_squared).iter().sum::<f64>().sqrt();
    [1.0 / size(&map.inverse()), size(map)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::particles::Particles;
    use crate::{BuildFor, Primitive};
    use durer_math::{DAffine3, DVec2};
    use std::sync::Arc;

    fn slender(primitive: &Primitive) -> Vec<Slender> {
        let mut all = Vec::new();
        primitive.each_slender(&mut |one, _| all.push(one));
        all
    }

    #[test]
    fn a_ball_is_a_point_with_its_radius() {
        let map = DAffine3::from_translation(DVec3::X) * DAffine3::from_scale(DVec3::splat(3.0));
        let [ball] = slender(&Primitive::sphere(DVec3::Y, 2.0, &map))[..] else { panic!("one thing") };
        assert_eq!(ball, Slender { ends: [DVec3::new(1.0, 3.0, 0.0); 2], radius: 6.0, core: 6.0, is_part: false });
    }

    #[test]
    fn a_cylinder_is_its_axis() {
        let (base, top) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(5.0, 2.0, 0.0));
        let [rod] = slender(&Primitive::cylinder(base, top, 0.01, false, &DAffine3::IDENTITY))[..] else {
            panic!("one thing")
        };
        assert!((rod.radius - 0.01).abs() < 1e-12 && (rod.core - 0.01).abs() < 1e-12, "{rod:?}");
        let near = |a: DVec3, b: DVec3| (a - b).length() < 1e-12;
        assert!(near(rod.ends[0], base) && near(rod.ends[1], top), "{rod:?}");
    }

    #[test]
    fn each_particle_is_one_and_a_plane_is_none() {
        let ball = |index: usize| (DVec3::X * index as f64, 0.5);
        let particles = Arc::new(Particles::spheres(3, BuildFor::Preview.into(), ball));
        let map = DAffine3::from_scale(DVec3::new(1.0, 2.0, 4.0));
        let mut all = slender(&Primitive::particles(particles, &map));
        all.sort_by(|a, b| a.ends[0].x.total_cmp(&b.ends[0].x));
        all.dedup();
        assert_eq!(all.iter().map(|one| one.ends[0].x).collect::<Vec<_>>(), [0.0, 1.0, 2.0]);
        assert!(all.iter().all(|one| one.radius == 2.0 && one.core == 0.5));
        assert!(slender(&Primitive::plane(DVec3::ZERO, DVec3::Y, &DAffine3::IDENTITY)).is_empty());
    }

    /// Whatever its corners' order, all of a triangle is within the radius of the line, and the line is no longer than it.
    #[test]
    fn a_triangle_lies_along_its_longest_edge() {
        let [a, b, c] = [DVec3::new(1.0, 0.0, 0.0), DVec3::new(11.0, 0.0, 0.0), DVec3::new(4.0, 0.0, 0.5)];
        for vertices in [[a, b, c], [b, c, a], [c, b, a]] {
            let [one] = slender(&Primitive::triangle(vertices, [DVec2::ZERO; 3], &DAffine3::IDENTITY))[..] else {
                panic!("one thing")
            };
            assert!(
                (one.radius - 0.25).abs() < 1e-12 && (one.ends[1] - one.ends[0]).length() - 10.0 < 1e-12,
                "{one:?}"
            );
            for vertex in vertices {
                let along = (one.ends[1] - one.ends[0]).normalize();
                let t = (vertex - one.ends[0]).dot(along).clamp(0.0, 10.0);
                assert!((one.ends[0] + along * t - vertex).length() < 0.25 + 1e-12, "{one:?}");
            }
        }
    }

    #[test]
    fn a_ring_is_within_its_pieces() {
        let ring = slender(&Primitive::torus(DVec3::X, DVec3::Z, [3.0, 0.01], &DAffine3::IDENTITY));
        for step in 0..1000 {
            let angle = f64::from(step) * 0.01;
            let point = DVec3::new(1.0 + 3.0 * cos(angle), 3.0 * sin(angle), 0.0);
            let distance = |one: &Slender| {
                let along = one.ends[1] - one.ends[0];
                let t = ((point - one.ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (one.ends[0] + along * t - point).length() - (one.radius - 0.01)
            };
            assert!(ring.iter().any(|one| distance(one) < 1e-9), "{point}");
        }
    }

    #[test]
    fn a_skewed_map_is_bounded() {
        let map = DMat3::from_cols(DVec3::X, DVec3::new(3.0, 1.0, 0.0), DVec3::Z);
        let [least, greatest] = stretches(&map);
        // The singular values of this shear are (√13 ± 3) / 2.
        let exact = [(13.0_f64.sqrt() - 3.0) / 2.0, (13.0_f64.sqrt() + 3.0) / 2.0];
        assert!(least <= exact[0] && greatest >= exact[1], "{least} {greatest}");
        assert!(least > 0.2 * exact[0] && greatest < 1.5 * exact[1], "{least} {greatest}");
    }
}
