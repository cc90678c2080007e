//! What is chosen, against a count of all directions and against closed forms.

use crate::shapes::mesh::MeshSource;
use crate::{BuildFor, Mesh, Operand, Operation, Particles, Plan, Primitive, Ray, SimdLevel};
use durer_math::functions::{atan2, cos, sin};
use durer_math::{DAffine3, DMat3, DVec2, DVec3, rotation_between};
use std::f64::consts::PI;
use std::sync::Arc;

fn plan() -> Plan {
    Plan { purpose: BuildFor::Preview, simd: SimdLevel::best() }
}

/// Hammersley's points.
fn plane_points(count: u32) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |index| {
        let second = f64::from(index.reverse_bits()) / 4_294_967_296.0;
        DVec2::new((f64::from(index) + 0.5) / f64::from(count), second)
    })
}

/// What is summed up over directions, so that a wrong density shows.
fn weigh(direction: DVec3) -> [f64; 4] {
    let d = direction;
    [1.0, d.x * d.y + d.z, d.y * d.y - 0.3 * d.x, d.z * d.z * d.x]
}

/// A primitive seen from somewhere: what samples say of it is what rays in all directions say.
#[track_caller]
fn agrees(primitive: &Primitive, from: DVec3) {
    const SAMPLES: u32 = 1 << 14;
    let (mut sums, mut mean_facing, mut elements, mut missed) = ([0.0; 4], 0.0, 0, 0);
    primitive.each_element(&mut |element| {
        elements += 1;
        if primitive.extent(element).is_none() {
            return;
        }
        let aimable = primitive.aimable(element).unwrap();
        for at in plane_points(SAMPLES) {
            let Some(aim) = primitive.aim(&aimable, from, at) else { continue };
            let again = aimable.pdf(from, aim.surface.point, aim.part);
            let facing = aim.direction.dot(aim.surface.normal).abs();
            let is_same = (again / aim.pdf - 1.0).abs() < 1e-5;
            assert!(is_same || facing < 1e-3, "{again} is not {}, at {at}", aim.pdf);
            assert_eq!(primitive.element_of(aim.part), element);
            mean_facing += facing / f64::from(SAMPLES);
            // It is on the surface that a ray meets there.
            let ray = Ray { origin: from, direction: aim.direction };
            let met = primitive.each_crossing(&ray, aim.distance * 1.001 + 1e-6, |_, _, surface| {
                let grazing = aim.direction.dot(surface.normal).abs() < 1e-4;
                grazing || (surface.point - aim.surface.point).length() < 1e-5
            });
            missed += u32::from(!met && facing > 1e-3);
            let weights = weigh(aim.direction).map(|weight| weight / aim.pdf / f64::from(SAMPLES));
            (0..4).for_each(|k| sums[k] += weights[k]);
        }
    });
    // On edges rays may just miss.
    assert!(missed <= elements * SAMPLES / 500, "{missed} samples are not on it");
    let (mut counted, mut total) = ([0.0; 4], 0.0);
    const DIRECTIONS: u32 = 1 << 17;
    for at in plane_points(DIRECTIONS) {
        let direction = super::ball::on_sphere(at);
        let share = 4.0 * PI / f64::from(DIRECTIONS);
        primitive.each_crossing(&Ray { origin: from, direction }, f64::INFINITY, |_, crossing, surface| {
            let aimable = primitive.aimable(primitive.element_of(crossing.part));
            let pdf = aimable.map_or(0.0, |aimable| aimable.pdf(from, surface.point, crossing.part));
            if pdf > 0.0 {
                // Where a surface is seen edge-on, its density may be without bound, but not this.
                total += pdf * direction.dot(surface.normal).abs() * share;
                (0..4).for_each(|k| counted[k] += weigh(direction)[k] * share);
            }
            false
        });
    }
    for k in 0..4 {
        let error = (sums[k] - counted[k]).abs();
        assert!(error < 0.01 * counted[0] + 1e-3, "{k}: {} by samples, {} by rays ({elements})", sums[k], counted[k]);
    }
    assert!((total - mean_facing).abs() < 0.02 * mean_facing + 0.003, "the density gives {total}, not {mean_facing}");
}

fn sheared() -> DAffine3 {
    let columns = [DVec3::new(1.3, 0.2, 0.0), DVec3::new(-0.4, 0.8, 0.3), DVec3::new(0.1, 0.3, -0.9)];
    DAffine3::from_mat3_translation(DMat3::from_cols(columns[0], columns[1], columns[2]), DVec3::new(0.1, 0.2, -0.1))
}

fn turned() -> DAffine3 {
    let turn = rotation_between(DVec3::Y, DVec3::new(0.48, 0.6, 0.64));
    DAffine3::from_mat3_translation(turn * 1.2, DVec3::new(-0.2, 0.1, 0.3))
}

/// From above, beside, below and near.
const PLACES: [DVec3; 4] =
    [DVec3::new(0.3, 2.4, 0.2), DVec3::new(2.0, 0.2, -1.5), DVec3::new(-0.7, -2.2, 1.1), DVec3::new(0.9, 1.0, 1.3)];

fn agrees_everywhere(make: impl Fn(&DAffine3) -> Primitive) {
    for map in [DAffine3::IDENTITY, turned(), sheared()] {
        PLACES.into_iter().for_each(|from| agrees(&make(&map), from));
    }
}

fn agrees_inside(make: impl Fn(&DAffine3) -> Primitive, inside: DVec3) {
    for map in [DAffine3::IDENTITY, sheared()] {
        agrees(&make(&map), map.transform_point3(inside));
    }
}

#[test]
fn spheres() {
    let sphere = |map: &DAffine3| Primitive::sphere(DVec3::new(0.1, 0.0, 0.0), 0.9, map);
    agrees_everywhere(sphere);
    agrees_inside(sphere, DVec3::new(0.3, 0.4, -0.2));
}

#[test]
fn rectangles() {
    agrees_everywhere(|map| Primitive::rectangle(DVec3::new(-1.0, 0.1, -0.5), [DVec3::X * 2.0, DVec3::Z], map));
    agrees_everywhere(|map| {
        Primitive::rectangle(DVec3::new(-1.0, 0.1, -0.5), [DVec3::new(1.5, 0.3, 0.2), DVec3::new(0.4, 0.0, 1.0)], map)
    });
}

#[test]
fn triangles() {
    let corners = [DVec3::new(-1.0, 0.0, -0.6), DVec3::new(0.2, 0.3, 1.2), DVec3::new(1.1, -0.2, -0.4)];
    agrees_everywhere(|map| Primitive::triangle(corners, [DVec2::ZERO; 3], map));
}

#[test]
fn discs_and_rings() {
    agrees_everywhere(|map| Primitive::disc(DVec3::ZERO, DVec3::new(0.2, 1.0, 0.3), [0.0, 1.1], map));
    agrees_everywhere(|map| Primitive::disc(DVec3::ZERO, DVec3::new(0.2, 1.0, 0.3), [0.6, 1.1], map));
}

#[test]
fn cylinders() {
    for open in [false, true] {
        let cylinder = move |map: &DAffine3| {
            Primitive::cylinder(DVec3::new(0.0, -0.6, 0.0), DVec3::new(0.2, 0.5, 0.1), 0.7, open, map)
        };
        agrees_everywhere(cylinder);
        agrees_inside(cylinder, DVec3::new(0.3, 0.1, -0.2));
    }
}

#[test]
fn cones_and_frusta() {
    for radii in [[0.8, 0.0], [0.5, 1.0]] {
        for open in [false, true] {
            let cone = move |map: &DAffine3| {
                Primitive::cone(DVec3::new(0.0, -0.6, 0.0), DVec3::new(0.2, 0.7, 0.1), radii, open, map)
            };
            agrees_everywhere(cone);
            agrees_inside(cone, DVec3::new(0.1, -0.2, -0.1));
        }
    }
}

#[test]
fn boxes() {
    let cuboid = |map: &DAffine3| Primitive::cuboid(DVec3::new(-0.8, -0.5, -0.3), DVec3::new(0.7, 0.5, 0.4), map);
    agrees_everywhere(cuboid);
    agrees_inside(cuboid, DVec3::new(0.3, 0.1, -0.2));
}

#[test]
fn tori() {
    agrees_everywhere(|map| Primitive::torus(DVec3::ZERO, DVec3::new(0.1, 1.0, 0.3), [0.8, 0.3], map));
}

#[derive(Debug)]
struct Tetrahedron;

impl MeshSource for Tetrahedron {
    fn positions(&self) -> &[[f32; 3]] {
        &[[0.9, -0.5, 0.0], [-0.7, -0.5, 0.8], [-0.6, -0.4, -0.9], [0.1, 0.9, 0.0]]
    }

    fn triangles(&self) -> &[[u32; 3]] {
        &[[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    }

    fn normals(&self) -> &[[f32; 3]] {
        &[]
    }

    fn uvs(&self) -> &[[f32; 2]] {
        &[]
    }

    fn enclosed_volume(&self) -> Option<f64> {
        Some(1.0)
    }
}

#[test]
fn meshes() {
    let mesh = Arc::new(Mesh::build(Arc::new(Tetrahedron), plan()));
    agrees_everywhere(|map| Primitive::mesh(mesh.clone(), DVec3::ZERO, map));
}

#[test]
fn particles() {
    let ends = |index: usize| {
        let x = index as f64 - 1.0;
        [DVec3::new(x, -0.4, 0.0), DVec3::new(x + 0.3, 0.5, 0.2 * x)]
    };
    let sets = [
        Particles::spheres(3, plan(), |index| (ends(index)[0], 0.2 + 0.1 * index as f64)),
        Particles::frusta(3, false, plan(), |index| (ends(index), [0.3, 0.1 * index as f64])),
        Particles::frusta(3, true, plan(), |index| (ends(index), [0.2, 0.2])),
        Particles::capsules(3, plan(), |index| (ends(index), 0.2 + 0.05 * index as f64)),
    ];
    for set in sets.map(Arc::new) {
        for (map, from) in [(DAffine3::IDENTITY, PLACES[0]), (turned(), PLACES[1]), (sheared(), PLACES[2])] {
            agrees(&Primitive::particles(set.clone(), &map), from);
        }
    }
}

/// What is left of a ball with a bite, which is seen from outside.
#[test]
fn solids() {
    let identity = DAffine3::IDENTITY;

    let operands = || {
        vec![
            Operand::Shape(Primitive::sphere(DVec3::ZERO, 1.0, &identity)),
            Operand::Shape(Primitive::sphere(DVec3::new(0.6, 0.9, 0.0), 0.7, &identity)),
        ]
    };
    for operation in [Operation::Difference, Operation::Union, Operation::Intersection] {
        for (map, from) in [(identity, PLACES[0]), (sheared(), PLACES[1]), (turned(), PLACES[3])] {
            agrees(&Primitive::solid(Operand::Combined(operation, operands()), &map), from);
        }
    }
}

/// The irradiance, over π, on a patch at `from` that faces `normal`, of a shape that gives off light everywhere.
fn form_factor(primitive: &Primitive, from: DVec3, normal: DVec3) -> f64 {
    const SAMPLES: u32 = 1 << 14;
    let aimable = primitive.aimable(0).unwrap();
    let aims = plane_points(SAMPLES).filter_map(|at| primitive.aim(&aimable, from, at));
    aims.map(|aim| aim.direction.dot(normal).max(0.0) / aim.pdf).sum::<f64>() / (f64::from(SAMPLES) * PI)
}

/// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors": B-12, B-3 and that of a sphere.
#[test]
fn form_factors_are_those_of_the_catalog() {
    let identity = DAffine3::IDENTITY;
    for height in [0.05, 0.7, 3.0, 1000.0] {
        let disc = Primitive::disc(DVec3::Y * height, DVec3::NEG_Y, [0.0, 1.0], &identity);
        let expected = 1.0 / (1.0 + height * height);
        let found = form_factor(&disc, DVec3::ZERO, DVec3::Y);
        let slack = if height < 0.1 { 0.05 } else { 2e-3 };
        assert!((found / expected - 1.0).abs() < slack, "disc at {height}: {found}, not {expected}");

        let sphere = Primitive::sphere(DVec3::Y * (1.0 + height), 1.0, &identity);
        let expected = 1.0 / ((1.0 + height) * (1.0 + height));
        let found = form_factor(&sphere, DVec3::ZERO, DVec3::Y);
        assert!((found / expected - 1.0).abs() < 2e-3, "sphere at {height}: {found}, not {expected}");

        let (a, b) = (1.0, 2.0);
        let rectangle = Primitive::rectangle(DVec3::Y * height, [DVec3::X * a, DVec3::Z * b], &identity);
        let term = |a: f64, b: f64| {
            let side = (a * a + height * height).sqrt();
            a / side * atan2(b, side)
        };
        let expected = (term(a, b) + term(b, a)) / (2.0 * PI);
        let found = form_factor(&rectangle, DVec3::ZERO, DVec3::Y);
        assert!((found / expected - 1.0).abs() < 2e-3, "rectangle at {height}: {found}, not {expected}");
    }
}

/// A patch beside a wall of light that reaches up to the sky: half of what it sees.
#[test]
fn near_the_plane_of_a_rectangle_nothing_is_lost() {
    let wall = Primitive::rectangle(DVec3::new(-1e3, 0.0, 0.0), [DVec3::X * 2e3, DVec3::Y * 1e3], &DAffine3::IDENTITY);
    for distance in [0.1, 1e-3, 1e-6] {
        let found = form_factor(&wall, DVec3::new(0.0, 0.0, distance), DVec3::Y);
        assert!((found - 0.5).abs() < 1e-3, "{found} at {distance}");
    }
}

/// Seen along its surface, from its tip, from its middle or its plane, from where it ends, or from very far away: numbers, or
/// nothing.
#[test]
fn nasty_places_give_no_nonsense() {
    let map = DAffine3::IDENTITY;
    let shapes = [
        Primitive::sphere(DVec3::ZERO, 1.0, &map),
        Primitive::cuboid(DVec3::NEG_ONE, DVec3::ONE, &map),
        Primitive::cylinder(DVec3::NEG_Y, DVec3::Y, 1.0, false, &map),
        Primitive::cone(DVec3::NEG_Y, DVec3::Y, [1.0, 0.0], false, &map),
        Primitive::cone(DVec3::NEG_Y, DVec3::Y, [0.0, 1.0], true, &map),
        Primitive::disc(DVec3::ZERO, DVec3::Y, [0.5, 1.0], &map),
        Primitive::rectangle(DVec3::ZERO, [DVec3::X, DVec3::Z], &map),
        Primitive::triangle([DVec3::ZERO, DVec3::X, DVec3::Z], [DVec2::ZERO; 3], &map),
        Primitive::triangle([DVec3::ZERO, DVec3::X, DVec3::X * 2.0], [DVec2::ZERO; 3], &map),
        Primitive::torus(DVec3::ZERO, DVec3::Y, [1.0, 0.5], &map),
        Primitive::sphere(DVec3::ZERO, 1e-9, &map),
    ];
    let mut places = vec![DVec3::ZERO, DVec3::splat(1e9), DVec3::new(1e-300, 0.0, 0.0), DVec3::new(1.0, 1e12, 0.0)];
    for x in [-1.0, 0.0, 0.5, 1.0] {
        for y in [-1.0, 0.0, 1e-12, 1.0] {
            places.extend([DVec3::new(x, y, 0.0), DVec3::new(x, y, 1.0), DVec3::new(2.0 * x, y, -3.0)]);
        }
    }
    let edges = [0.0, 1e-17, 0.3, 0.5, 1.0 - 1e-16];
    for (index, shape) in shapes.iter().enumerate() {
        let aimable = shape.aimable(0).unwrap();
        for &from in &places {
            for at in edges.into_iter().flat_map(|x| edges.map(|y| DVec2::new(x, y))) {
                let Some(aim) = shape.aim(&aimable, from, at) else { continue };
                let usable = aim.pdf > 0.0 && aim.pdf.is_finite() && aim.distance > 0.0 && aim.direction.is_finite();
                assert!(usable && aim.direction.is_normalized(), "shape {index} from {from} at {at}: {aim:?}");
                assert!(aim.surface.point.is_finite() && aim.surface.offset.is_finite());
            }
        }
    }
}

/// A shadow ray to a point on a shape ends before the shape.
#[test]
fn what_is_aimed_at_does_not_hide_itself() {
    let map = turned();
    let shapes = [
        Primitive::sphere(DVec3::ZERO, 1.0, &map),
        Primitive::cuboid(DVec3::NEG_ONE, DVec3::ONE, &map),
        Primitive::cylinder(DVec3::NEG_Y, DVec3::Y, 1.0, false, &map),
        Primitive::cone(DVec3::NEG_Y, DVec3::Y, [1.0, 0.2], false, &map),
        Primitive::rectangle(DVec3::ZERO, [DVec3::X, DVec3::Z], &map),
    ];
    for (index, shape) in shapes.iter().enumerate() {
        let aimable = shape.aimable(0).unwrap();
        for angle in (0..40).map(f64::from) {
            let from = DVec3::new(9.0 * cos(angle), 0.2 * angle - 4.0, 9.0 * sin(angle));
            let aims = plane_points(500).filter_map(|at| shape.aim(&aimable, from, at));
            let hidden = aims.filter(|aim| {
                let ray = Ray { origin: from, direction: aim.direction };
                shape.meets(&ray, aim.distance * (1.0 - 1e-12))
            });
            // Seen along its surface, a curved one may.
            let grazing = hidden.filter(|aim| aim.direction.dot(aim.surface.normal).abs() > 1e-5);
            assert_eq!(grazing.count(), 0, "shape {index} from {from}");
        }
    }
}
