//! Random solids, against membership asked point by point.

use super::*;

/// All points of the ray between crossings are inside or not, as the definition says.
fn agrees_with_membership(operand: &Operand, solid: &Primitive, ray: &Ray, length: f64) -> usize {
    let (starts_inside, all) = follow(solid, ray);
    let mut leaf_times: Vec<f64> = Vec::new();
    for shape in shapes(operand) {
        shape.crossings(ray, &mut |crossing| leaf_times.push(crossing.t));
    }
    for i in 0..400 {
        let t = length * (f64::from(i) + 0.5) / 400.0;
        if leaf_times.iter().any(|other| (other - t).abs() < 1e-6 * length) {
            continue;
        }
        let crossed = all.iter().filter(|crossing| crossing.t < t).count();
        let inside = starts_inside != (crossed % 2 == 1);
        let point = ray.at(t);
        assert_eq!(inside, is_in(operand, point), "{operand:?}, {ray:?} at {t}: {all:?}");
        assert_eq!(inside, solid.contains(point), "{operand:?} contains {point}");
    }
    all.len()
}

#[test]
fn crossings_are_where_membership_changes() {
    let mut random = Random(31);
    let mut compared = 0;
    for _ in 0..300 {
        let operand = random_operand(4, &mut random);
        let solid = solid(operand.clone());
        for _ in 0..20 {
            let ray = ray_at(DVec3::ZERO, 1.5, &mut random);
            compared += agrees_with_membership(&operand, &solid, &ray, 12.0);
        }
    }
    assert!(compared > 2_000, "the test must test something: {compared}");
}

#[test]
fn cheese_with_many_holes() {
    let mut random = Random(32);
    for holes in [50, 300] {
        let mut hole = || ball(random.in_cube(), random.between(0.05, 0.3));
        let holes: Vec<Operand> = (0..holes).map(|_| hole()).collect();
        let cheese = [block(-DVec3::ONE, DVec3::ONE)].into_iter().chain(holes).collect::<Vec<_>>();
        let operand = difference(cheese);
        let solid = solid(operand.clone());
        let mut compared = 0;
        for _ in 0..500 {
            let ray = ray_at(DVec3::ZERO, 1.0, &mut random);
            compared += agrees_with_membership(&operand, &solid, &ray, 8.0);
        }
        assert!(compared > 1_000, "the test must test something: {compared}");
    }
}

/// Placing operands or placing the solid is the same, wherever and however large it is.
#[test]
fn maps_of_the_whole_are_maps_of_the_parts() {
    let mut random = Random(33);
    let mut compared = 0;
    for i in 0..60 {
        let operand = random_operand(3, &mut random);
        let scale = [1e-3, 1.0, 1e3][i % 3];
        let shift = [0.0, 1.0, 1e6][i / 3 % 3];
        let map = random_map(&mut random);
        let map = DAffine3::from_mat3_translation(map.matrix3 * scale, random.in_cube() * shift);
        let here = solid(operand.clone());
        let there = Primitive::solid(operand, &map);
        for _ in 0..50 {
            let ray = ray_at(DVec3::ZERO, 1.5, &mut random);
            let mapped = ray.transformed(&map);
            let (a, b) = (times(&here, &ray), times(&there, &mapped));
            // Where a ray but touches, or passes an edge, the map's rounding decides.
            let noise = 1e-13 + 1e-15 * shift / scale;
            let close = a.windows(2).any(|pair| pair[1] - pair[0] < 1e3 * noise.sqrt());
            if close || noise > 1e-4 || a.len() != b.len() && shift / scale > 1e2 {
                continue;
            }
            assert!(near(&a, &b, 1e4 * noise), "{ray:?} by {map:?}: {a:?} {b:?}");
            compared += a.len();
        }
    }
    assert!(compared > 1_000, "the test must test something: {compared}");
}

/// Where two leaves meet, a point is on both to within this.
const SEAM: f64 = 1e-7;

/// True if another leaf than the hit one has its surface near.
fn at_a_seam(operand: &Operand, solid: &Primitive, point: DVec3, part: u32) -> bool {
    let hit = solid.leaf_of(part);
    let others = shapes(operand).into_iter().enumerate().filter(|(i, _)| *i != hit);
    let corners = |step: f64| {
        [-1.0, 1.0]
            .into_iter()
            .flat_map(move |x| [-1.0, 1.0].into_iter().flat_map(move |y| [-1.0, 1.0].map(|z| vec(x, y, z) * step)))
    };
    others.into_iter().any(|(_, shape)| {
        let inside = corners(10.0 * SEAM).filter(|&step| shape.contains(point + step)).count();
        inside % 8 != 0
    })
}

/// The normal points out, the offset is on the right side of the surface, and rays from there start on that side and are
/// not stopped by what they leave, however shallow.
#[test]
fn rays_leave_and_enter_surfaces() {
    let mut random = Random(34);
    let (mut tried, mut seams) = (0, 0);
    for i in 0..300 {
        let operand = random_operand(3, &mut random);
        let map = match i % 3 {
            0 => HERE,
            1 => random_map(&mut random),
            _ => DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(1e-3)), vec(1e3, 0.0, -1e3)),
        };
        let solid = Primitive::solid(operand.clone(), &map);
        for _ in 0..20 {
            let ray = ray_at(DVec3::ZERO, 1.5, &mut random).transformed(&map);
            for crossing in follow(&solid, &ray).1 {
                let surface = solid.surface(&ray, &crossing);
                let at_home = map.inverse().transform_point3(surface.point);
                if at_a_seam(&operand, &solid, at_home, crossing.part) {
                    seams += 1;
                    continue;
                }
                tried += 1;
                leaves_and_enters(&solid, &surface, crossing.part, &mut random);
            }
        }
    }
    assert!(tried > 2_000 && seams < tried / 10, "the test must test something: {tried}, {seams}");
}

fn leaves_and_enters(solid: &Primitive, surface: &Surface, part: u32, random: &mut Random) {
    let (point, normal) = (surface.point, surface.normal);
    let reach = 1e-12 * largest(point) + 2.0 * surface.offset;
    assert!(surface.offset < 1e-9 * (largest(point) + 1.0), "{surface:?}");
    assert!(!solid.contains(point + normal * reach) && solid.contains(point - normal * reach), "{surface:?}");
    for cosine in [1.0, random.between(0.0, 1.0), random.power(-9.0, 0.0), 1e-9] {
        for side in [1.0, -1.0] {
            let v = random.direction();
            let along = (v - normal * v.dot(normal)).normalize();
            let direction = normal * (side * cosine) + along * (1.0 - cosine * cosine).sqrt();
            let ray = Ray { origin: point + normal * (side * surface.offset), direction };
            let (starts_inside, all) = follow(solid, &ray);
            assert_eq!(starts_inside, side < 0.0, "{part} of {solid:?}: {surface:?}, {ray:?}");
            // What is curved away from the ray is not met again nearby; a bowl is, but not at once.
            let soon = all.first().map_or(f64::INFINITY, |crossing| crossing.t);
            assert!(soon > surface.offset, "{surface:?}, {ray:?}: {soon}");
        }
    }
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

#[test]
fn identities_of_sets() {
    let mut random = Random(35);
    let mut compared = 0;
    for _ in 0..200 {
        let [a, b, c] = [0, 1, 1].map(|depth| random_operand(depth, &mut random));
        let (a, b, c) = (|| a.clone(), || b.clone(), || c.clone());
        let pairs = [
            (difference([a(), b(), c()]), intersection([difference([a(), b()]), difference([a(), c()])])),
            (difference([a(), union([b(), c()])]), difference([difference([a(), b()]), c()])),
            (difference([a(), intersection([b(), c()])]), union([difference([a(), b()]), difference([a(), c()])])),
            (intersection([a(), b()]), difference([a(), difference([a(), b()])])),
            (a(), union([difference([a(), b()]), intersection([a(), b()])])),
            (union([a(), b()]), union([difference([a(), b()]), difference([b(), a()]), intersection([b(), a()])])),
        ];
        for (left, right) in pairs.map(|(left, right)| (solid(left), solid(right))) {
            for _ in 0..30 {
                let ray = ray_at(DVec3::ZERO, 1.5, &mut random);
                let ((starts_a, a), (starts_b, b)) = (follow(&left, &ray), follow(&right, &ray));
                assert_eq!(starts_a, starts_b, "{ray:?}");
                let times = |all: &[Crossing]| all.iter().map(|crossing| crossing.t).collect::<Vec<_>>();
                assert!(near(&times(&a), &times(&b), 1e-12), "{ray:?}: {a:?} {b:?}\n{left:?}\n{right:?}");
                compared += a.len();
            }
        }
    }
    assert!(compared > 10_000, "the test must test something: {compared}");
}

/// From outside, what is bounded is entered as often as left, also by rays through edges and corners.
#[test]
fn crossings_come_in_pairs() {
    let mut random = Random(36);
    let lattice = |random: &mut Random| (random.in_cube() * 3.0).round() * 0.5;
    let mut crossed = 0;
    for _ in 0..500 {
        let mut operand = || {
            let (a, b) = (lattice(&mut random), lattice(&mut random));
            match random.between(0.0, 4.0) as u32 {
                0 => ball(a, 0.5 + random.between(0.0, 3.0).floor() * 0.5),
                1 => rod(a, a + DVec3::AXES[random.between(0.0, 3.0) as usize], 0.5),
                _ => block(a.min(b), a.max(b) + 0.5),
            }
        };
        let [a, b, c, d] = [operand(), operand(), operand(), operand()];
        let solid = solid(difference([union([a, b]), intersection([c, d])]));
        for _ in 0..50 {
            let ray = ray_at(DVec3::ZERO, 1.0, &mut random);
            let ray = Ray { origin: ray.origin - ray.direction * 10.0, ..ray };
            let (starts_inside, all) = follow(&solid, &ray);
            assert!(!starts_inside && all.len() % 2 == 0, "{solid:?}, {ray:?}: {all:?}");
            crossed += all.len();
        }
    }
    assert!(crossed > 10_000, "the test must test something: {crossed}");
}
