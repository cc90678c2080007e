//! Operands that share faces, edges or points.

use super::*;

fn every_shape(map: &DAffine3) -> Vec<Primitive> {
    let (low, high) = (vec(0.0, -0.5, 0.0), vec(0.0, 0.75, 0.0));
    vec![
        Primitive::sphere(vec(0.1, 0.2, 0.3), 0.7, map),
        Primitive::cuboid(vec(-0.5, -0.3, -0.1), vec(0.5, 0.9, 0.7), map),
        Primitive::cylinder(low, high, 0.5, false, map),
        Primitive::cone(low, high, [0.7, 0.2], false, map),
        Primitive::torus(DVec3::ZERO, DVec3::Y, [0.6, 0.25], map),
    ]
}

/// A ray that all but touches a ball of radius 1 around a point: inside it or outside by next to nothing.
fn shallow_ray(center: DVec3, random: &mut Random) -> Ray {
    let direction = random.direction();
    let aside = direction.any_orthonormal_vector();
    let depth = random.power(-17.0, -1.0) * random.between(-1.0, 1.0).signum();
    let origin = center + aside * (1.0 - depth) - direction * random.power(0.5, 4.0);
    Ray { origin, direction }
}

/// True if rays next to this one meet other faces, or as many in other places: it but touches, or passes an edge.
fn touches(shape: &Primitive, ray: &Ray) -> bool {
    let (starts_inside, all) = crossings(shape, ray);
    let (a, b) = ray.direction.any_orthonormal_pair();
    [a + b, a - b, b - a, -a - b, a, b, -a, -b].into_iter().any(|aside| {
        let size = shape.bounds().size().max_element();
        let moved = Ray { origin: ray.origin + aside * (1e-6 * size), ..*ray };
        let (inside, others) = crossings(shape, &moved);
        let differ = |(a, b): (&Crossing, &Crossing)| a.part != b.part || (a.t - b.t).abs() > 1e-3 * size;
        inside != starts_inside || others.len() != all.len() || all.iter().zip(&others).any(differ)
    })
}

#[test]
fn a_shape_with_itself_is_the_shape_bit_for_bit() {
    let mut random = Random(41);
    for shape in every_shape(&random_map(&mut random)) {
        let same = || Operand::Shape(shape.clone());
        let other = || random_operand(2, &mut Random(5));
        let alone = solid(same());
        let bits = [union([same(), same()]), intersection([same(), same(), same()]), difference([same()])];
        let sames = [
            intersection([same(), union([same(), other()])]),
            union([same(), intersection([same(), other()])]),
            union([difference([same(), other()]), same()]),
        ];
        for (i, operand) in bits.into_iter().chain(sames).enumerate() {
            let solid = solid(operand);
            for _ in 0..3_000 {
                let ray = ray_at(DVec3::ZERO, 1.0, &mut random);
                if i < 3 {
                    assert_eq!(follow(&alone, &ray), follow(&solid, &ray), "{ray:?}");
                }
                if !touches(&shape, &ray) {
                    // The solid's operands are moved to its middle, so the last bits may differ, but no more.
                    is_the_same(&shape, &solid, &ray);
                }
            }
        }
    }
}

/// The same faces in the same places.
fn is_the_same(shape: &Primitive, solid: &Primitive, ray: &Ray) {
    has_the_same_crossings(shape, solid, ray);
    for (a, b) in crossings(shape, ray).1.iter().zip(&follow(solid, ray).1) {
        let (a, b) = (shape.surface(ray, a), solid.surface(ray, b));
        let tolerance = 1e-9 + 1e-13 * ray.origin.abs().max_element();
        let same = (a.point - b.point).length() < tolerance && a.normal.dot(b.normal) > 1.0 - 1e-9;
        assert!(same, "{ray:?}: {a:?} {b:?}");
    }
}

fn has_the_same_crossings(shape: &Primitive, solid: &Primitive, ray: &Ray) {
    has_crossings_within(1e-9, shape, solid, ray);
}

fn has_crossings_within(tolerance: f64, shape: &Primitive, solid: &Primitive, ray: &Ray) {
    let (a, b) = (crossings(shape, ray), follow(solid, ray));
    assert_eq!((a.0, a.1.len()), (b.0, b.1.len()), "{ray:?}: {a:?} {b:?}");
    for (a, b) in a.1.iter().zip(&b.1) {
        let tolerance = tolerance * (1.0 + a.t) + 1e-13 * ray.origin.abs().max_element();
        assert!((a.t - b.t).abs() <= tolerance, "{ray:?}: {a:?} {b:?}");
    }
}

/// The same set in two ways, by maps that differ.
fn twins(map: &DAffine3) -> Vec<[Primitive; 2]> {
    let turned = |angle: f64| *map * DAffine3::from_mat3(rotation(DVec3::Y, angle));
    let [quarter, other, any] = [0.5 * PI, PI, 1.234].map(turned);
    let (low, high) = (vec(0.0, -0.5, 0.0), vec(0.0, 0.75, 0.0));
    let rim = vec(0.5, 0.75, 0.5);
    let twisted = *map * DAffine3::from_mat3(rotation(vec(0.6, 0.0, 0.8), 0.9));
    vec![
        [Primitive::sphere(DVec3::ZERO, 1.0, map), Primitive::sphere(DVec3::ZERO, 1.0, &twisted)],
        [Primitive::cuboid(-rim, rim, map), Primitive::cuboid(-rim, rim, &quarter)],
        [Primitive::cuboid(-rim, rim, &other), Primitive::cuboid(-rim, rim, &quarter)],
        [Primitive::cylinder(low, high, 1.0, false, map), Primitive::cylinder(high, low, 1.0, false, &any)],
        [Primitive::cone(low, high, [0.7, 0.2], false, map), Primitive::cone(high, low, [0.2, 0.7], false, &any)],
        [
            Primitive::torus(DVec3::ZERO, DVec3::Y, [0.75, 0.25], map),
            Primitive::torus(DVec3::ZERO, DVec3::NEG_Y, [0.75, 0.25], &any),
        ],
    ]
}

fn stretched(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_diagonal(vec(x, y, z)))
}

/// Rays of all kinds at things of size 1, and the map from where they are meant to the world.
fn each_ray(map: &DAffine3, seed: u64, mut check: impl FnMut(&Ray)) {
    let mut random = Random(seed);
    for i in 0..1_500 {
        let mut ray =
            if i % 4 == 0 { shallow_ray(DVec3::ZERO, &mut random) } else { ray_at(DVec3::ZERO, 1.0, &mut random) };
        if i % 5 == 0 {
            ray.origin -= ray.direction * random.power(1.0, 6.0);
        }
        let mapped = ray.transformed(map);
        check(&Ray { origin: mapped.origin, direction: mapped.direction.normalize() });
    }
}

fn some_maps() -> Vec<DAffine3> {
    let mut random = Random(42);
    let far = DAffine3::from_translation(vec(1e6, -2e6, 3e5));
    let tiny = stretched(1e-3, 1e-3, 1e-3);
    vec![
        HERE,
        random_map(&mut random),
        random_map(&mut random),
        far * random_map(&mut random),
        tiny * random_map(&mut random),
        stretched(30.0, -0.1, 1.0) * random_map(&mut random),
    ]
}

#[test]
fn nothing_is_left_of_a_shape_without_itself() {
    let (mut checked, mut seen) = (0, 0);
    for map in some_maps() {
        for [a, b] in twins(&map) {
            let operands = || [Operand::Shape(a.clone()), Operand::Shape(b.clone())];
            let nothing = solid(difference(operands()));
            let neither = solid(difference([union(operands()), intersection(operands())]));
            each_ray(&map, 43, |ray| {
                assert_eq!(follow(&nothing, ray), (false, vec![]), "{a:?} {b:?} {ray:?}");
                assert_eq!(follow(&neither, ray), (false, vec![]), "{a:?} {b:?} {ray:?}");
                checked += 1;
                seen += usize::from(a.intersect(ray, f64::INFINITY).is_some());
            });
        }
    }
    assert!(seen > checked / 4, "the test must test something: {seen} of {checked}");
}

#[test]
fn twins_have_one_surface() {
    for map in some_maps() {
        for [a, b] in twins(&map) {
            let operands = || [Operand::Shape(a.clone()), Operand::Shape(b.clone())];
            let (both, either) = (solid(intersection(operands())), solid(union(operands())));
            each_ray(&map, 44, |ray| {
                let (_, alone) = crossings(&a, ray);
                let (inside_both, both_all) = follow(&both, ray);
                let (inside_either, all) = follow(&either, ray);
                let ends_outside = |inside: bool, all: &[Crossing]| (all.len() % 2 == 1) == inside;
                assert!(ends_outside(inside_either, &all) && ends_outside(inside_both, &both_all), "{ray:?}");
                let leaves = all.iter().chain(&both_all).map(|crossing| either.leaf_of(crossing.part));
                // Of the two the first is seen.
                if !touches(&a, ray) && !touches(&b, ray) {
                    assert!(leaves.max().unwrap_or(0) == 0, "{ray:?}: {all:?} {both_all:?}");
                    assert_eq!((all.len(), both_all.len()), (alone.len(), alone.len()), "{ray:?}: {alone:?} {all:?}");
                }
            });
        }
    }
}

/// Small boxes that fill a large one: from outside and inside there is but the large one. Rays run in the planes in which
/// the small ones meet, and along the lines.
#[test]
fn boxes_face_to_face_are_one() {
    let steps = [-0.5, -0.5 + 1.0 / 3.0, 0.1, 0.5];
    let mut cells = Vec::new();
    for i in 0..27 {
        let corner = |k: usize| vec(steps[i % 3 + k], steps[i / 3 % 3 + k], steps[i / 9 + k]);
        cells.push((corner(0), corner(1)));
    }
    for map in some_maps() {
        let cell = |&(min, max): &(DVec3, DVec3)| Operand::Shape(Primitive::cuboid(min, max, &map));
        let cells = || cells.iter().map(cell).collect::<Vec<_>>();
        let whole = Primitive::cuboid(DVec3::splat(-0.5), DVec3::splat(0.5), &map);
        let filled = solid(union(cells()));
        let emptied =
            solid(difference(std::iter::once(Operand::Shape(whole.clone())).chain(cells()).collect::<Vec<_>>()));
        let check = |ray: &Ray| {
            assert_eq!(follow(&emptied, ray), (false, vec![]), "{map:?} {ray:?}");
            let (starts_inside, all) = follow(&filled, ray);
            let count = all.len() + usize::from(starts_inside);
            assert!(count == 0 || count == 2, "{map:?} {ray:?}: {all:?}");
            if touches(&whole, ray) {
                return;
            }
            has_the_same_crossings(&whole, &filled, ray);
            // Exactly on a seam the face that two small boxes share may be what is met first.
            let on_seam = |hit: &Crossing| {
                let point = map.inverse().transform_point3(ray.at(hit.t)).to_array();
                point.iter().any(|x| steps[1..3].iter().any(|step| (x - step).abs() < 1e-8))
            };
            if !all.iter().any(on_seam) {
                is_the_same(&whole, &filled, ray);
            }
        };
        each_ray(&map, 45, check);
        let mut random = Random(46);
        for _ in 0..2_000 {
            check(&in_planes(&steps, &mut random).transformed(&map));
        }
    }
}

/// A ray from outside that lies in one or two of the planes.
fn in_planes(steps: &[f64], random: &mut Random) -> Ray {
    let (mut from, mut to) = (random.direction() * 2.0, random.in_cube() * 0.49);
    let first = random.between(0.0, 3.0) as usize;
    let second = random.between(0.0, 3.0) as usize;
    for axis in [first, second] {
        let level = steps[1 + random.between(0.0, 2.0) as usize];
        (from[axis], to[axis]) = (level, level);
    }
    if first == second || random.between(0.0, 1.0) < 0.5 {
        return Ray { origin: from, direction: (to - from).normalize() };
    }
    // Along a line in which four meet.
    let axis = 3 - first - second;
    from[axis] = -2.0;
    Ray { origin: from, direction: DVec3::AXES[axis] }
}

/// Drums and frustums cap to cap, or cut in two, and rays in the plane of the caps.
#[test]
fn stacks_are_one() {
    for map in some_maps() {
        let at = |y: f64| vec(0.0, y, 0.0);
        let rod = |low: f64, high: f64| Primitive::cylinder(at(low), at(high), 0.5, false, &map);
        let cone =
            |low: f64, high: f64| Primitive::cone(at(low), at(high), [0.5 - 0.3 * low, 0.5 - 0.3 * high], false, &map);
        let stacks =
            [[rod(-0.5, 0.5), rod(-0.5, 0.1), rod(0.1, 0.5)], [cone(-0.5, 0.5), cone(-0.5, 0.1), cone(0.1, 0.5)]];
        let cut = |normal: DVec3| Operand::Shape(Primitive::plane(at(0.1), normal, &map));
        let half = |whole: &Primitive, normal: DVec3| intersection([Operand::Shape(whole.clone()), cut(normal)]);
        let halves = |whole: &Primitive| union([half(whole, DVec3::Y), half(whole, DVec3::NEG_Y)]);
        let stacks = stacks.into_iter().flat_map(|[whole, lower, upper]| {
            let halves = halves(&whole);
            [(whole.clone(), union([Operand::Shape(lower), Operand::Shape(upper)])), (whole, halves)]
        });
        for (whole, stack) in stacks {
            let stack = solid(stack);
            let mut random = Random(51);
            for i in 0..1_000 {
                let (mut from, mut to) = (random.direction() * 2.0, random.in_cube() * 0.4);
                if i % 2 == 0 {
                    (from.y, to.y) = (0.1, 0.1);
                }
                let ray = Ray { origin: from, direction: (to - from).normalize() }.transformed(&map);
                if !touches(&whole, &ray) {
                    // Under the uneven stretch a half-space knows its place less well.
                    has_crossings_within(1e-7, &whole, &stack, &ray);
                }
            }
        }
    }
}

/// What was cut out and put back leaves no trace, and what is cut off flush no skin.
#[test]
fn plugs_fit_their_holes() {
    let (low, high) = (vec(0.1, -0.5, 0.2), vec(0.1, 0.5, 0.2));
    for map in some_maps() {
        let plugs = [
            Primitive::cylinder(low, high, 0.3, false, &map),
            Primitive::cone(low, high, [0.3, 0.1], false, &map),
            Primitive::sphere(vec(0.1, 0.0, 0.2), 0.25, &map),
            Primitive::cuboid(vec(-0.1, -0.5, -0.1), vec(0.2, 0.5, 0.2), &map),
            Primitive::torus(vec(0.1, 0.0, 0.0), DVec3::Y, [0.2, 0.1], &map),
        ];
        let whole = Primitive::cuboid(DVec3::splat(-0.5), DVec3::splat(0.5), &map);
        let shape = |primitive: &Primitive| Operand::Shape(primitive.clone());
        for plug in &plugs {
            let bored = difference([shape(&whole), shape(plug)]);
            let filled = solid(union([bored.clone(), shape(plug)]));
            let bored = solid(bored);
            let check = |ray: &Ray| {
                if touches(&whole, ray) {
                    return;
                }
                has_the_same_crossings(&whole, &filled, ray);
                if !touches(plug, ray) {
                    is_the_same(&whole, &filled, ray);
                }
                // Through the middle of the hole.
                if let [a, b] = crossings(plug, ray).1[..]
                    && b.t - a.t > 0.1 * plug.bounds().size().min_element()
                    && [a, b]
                        .iter()
                        .all(|hit| plug.surface(ray, hit).point.distance(whole_hit(&whole, ray, hit.t)) < 1e-9)
                {
                    assert_eq!(follow(&bored, ray).1, [], "{ray:?} {plug:?}");
                }
            };
            each_ray(&map, 47, check);
            let mut random = Random(48);
            for _ in 0..500 {
                check(&along_side(&mut random).transformed(&map));
            }
        }
    }
}

/// Where a ray meets the whole nearest to `t`; far away if nowhere.
fn whole_hit(whole: &Primitive, ray: &Ray, t: f64) -> DVec3 {
    let all = crossings(whole, ray).1.into_iter();
    all.map(|hit| ray.at(hit.t))
        .min_by(|a, b| a.distance(ray.at(t)).total_cmp(&b.distance(ray.at(t))))
        .unwrap_or(DVec3::INFINITY)
}

/// A ray along the side of the cylinder or of the cone, in it but for rounding.
fn along_side(random: &mut Random) -> Ray {
    let around = rotation(DVec3::Y, random.between(0.0, 6.0)) * DVec3::X;
    let top = if random.between(0.0, 1.0) < 0.5 { 0.3 } else { 0.1 };
    let (from, to) = (vec(0.1, -0.5, 0.2) + around * 0.3, vec(0.1, 0.5, 0.2) + around * top);
    let direction = (to - from).normalize();
    Ray { origin: from - direction * random.between(0.1, 3.0), direction }
}

/// Where faces of several leaves are one face of the solid, that of the first is seen, if it is seen at all.
#[test]
fn the_first_of_equal_faces_is_seen() {
    let mut random = Random(49);
    let map = random_map(&mut random);
    let block = |min: [f64; 3], max: [f64; 3]| Operand::Shape(Primitive::cuboid(min.into(), max.into(), &map));
    let a = || block([0.0, 0.1, 0.0], [0.7, 0.8, 1.0]);
    let b = || block([0.3, -0.1, 0.2], [1.0, 0.8, 0.9]);
    let hidden = || difference([b(), block([0.2, 0.5, 0.1], [1.1, 0.9, 1.1])]);
    // Their common part has its top at 0.8. Leaves by number.
    let cases = [
        (union([a(), b()]), 0),
        (union([b(), a()]), 0),
        (intersection([a(), b()]), 0),
        (intersection([b(), a()]), 0),
        (union([hidden(), a()]), 2),
        (union([a(), hidden()]), 0),
        (intersection([union([b(), block([0.0, 0.0, 0.0], [1.0, 1.0, 1.0])]), a()]), 2),
        (difference([a(), block([0.0, 0.8, 0.0], [1.0, 1.8, 1.0])]), 0),
        (difference([block([0.0, 0.1, 0.0], [0.7, 1.8, 1.0]), block([0.0, 0.8, 0.0], [1.0, 1.8, 1.0]), b()]), 1),
    ];
    for (i, (operand, expected)) in cases.into_iter().enumerate() {
        let solid = solid(operand);
        for _ in 0..2_000 {
            let mut within = |low: f64, high: f64| random.between(low, high);
            let target = vec(within(0.31, 0.69), 0.8, within(0.21, 0.89));
            let from = vec(within(-1.0, 2.0), 1.5, within(-1.0, 2.0));
            let ray = Ray { origin: from, direction: target - from }.transformed(&map);
            if i == 8 {
                // Nothing is left under this face.
                let hit = solid.intersect(&ray, f64::INFINITY);
                assert!(hit.is_none_or(|hit| hit.t > 1.0 + 1e-9), "{hit:?}");
                continue;
            }
            let hit = solid.intersect(&ray, f64::INFINITY).expect("aimed at the top");
            assert!((hit.t - 1.0).abs() < 1e-12 || hit.t < 1.0 - 1e-9, "case {i}: {hit:?}");
            if hit.t > 1.0 - 1e-9 {
                assert_eq!(solid.leaf_of(hit.part), expected, "case {i}: {ray:?} {hit:?}");
            }
        }
    }
}

/// A ray along a floor, that would come into it right behind the foot of a wall, sees the wall.
#[test]
fn other_faces_nearby_are_others() {
    let room = solid(union([
        block(vec(-1.0, -1.0, -1.0), vec(1.0, 0.0, 1.0)),
        block(vec(0.5, -1.0, -1.0), vec(0.9, 1.0, 1.0)),
    ]));
    for slope in [1e-6, 1e-7, 1e-8, 1e-9] {
        let ray = Ray { origin: vec(-0.9, slope * (1.4 + 1e-6), 0.1), direction: vec(1.0, -slope, 0.0) };
        let hit = room.intersect(&ray, f64::INFINITY).expect("aimed at it");
        assert_eq!((room.leaf_of(hit.part), room.surface(&ray, &hit).normal), (1, DVec3::NEG_X), "{slope}");
    }
}

#[test]
fn balls_that_touch() {
    let two = || vec![ball(vec(-1.0, 0.0, 0.0), 1.0), ball(vec(1.0, 0.0, 0.0), 1.0)];
    let through = Ray { origin: vec(-5.0, 0.0, 0.0), direction: DVec3::X };
    let past = Ray { origin: vec(0.0, -5.0, 0.0), direction: DVec3::Y };
    assert_eq!(times(&solid(union(two())), &through), [3.0, 7.0]);
    assert_eq!(times(&solid(difference(two())), &through), [3.0, 5.0]);
    assert_eq!(times(&solid(intersection(two())), &through), []);
    let inner = || vec![ball(DVec3::ZERO, 2.0), ball(vec(1.0, 0.0, 0.0), 1.0)];
    assert_eq!(times(&solid(difference(inner())), &through), [3.0, 5.0]);
    assert_eq!(times(&solid(union(inner())), &through), [3.0, 7.0]);
    for operand in [union(two()), difference(two()), intersection(two())] {
        assert_eq!(times(&solid(operand), &past), []);
    }
}

/// A ray that cuts off but little of a ball is no thin slice, as long as it can be told from none.
#[test]
fn shallow_chords_are_seen() {
    let mut random = Random(52);
    let one = solid(ball(DVec3::ZERO, 1.0));
    let hollow = solid(difference([ball(DVec3::ZERO, 2.0), ball(DVec3::ZERO, 1.0)]));
    for _ in 0..5_000 {
        let direction = random.direction();
        let depth = random.power(-12.0, -5.0);
        let origin = direction.any_orthonormal_vector() * (1.0 - depth) - direction * 3.0;
        let ray = Ray { origin, direction };
        let half = (2.0 * depth).sqrt();
        let times = times(&one, &ray);
        assert!(near(&times, &[3.0 - half, 3.0 + half], 1e-3 * half), "depth {depth}: {times:?}");
        assert_eq!(follow(&hollow, &ray).1.len(), 4, "depth {depth}");
    }
}

/// A small block with its top at the top of a ball so large that its own arithmetic is coarse.
#[test]
fn rays_start_off_all_faces_at_a_place() {
    let mut random = Random(53);
    let turn = DAffine3::from_mat3(rotation(vec(0.6, 0.0, 0.8), 0.7));
    let ground = Primitive::sphere(vec(0.0, 0.3 - 1e5, 0.0), 1e5, &turn);
    let small = Primitive::cuboid(vec(-1e-4, 0.3 - 2e-4, -1e-4), vec(1e-4, 0.3, 1e-4), &turn);
    for order in [[&small, &ground], [&ground, &small]] {
        let solid = solid(intersection(order.map(|primitive| Operand::Shape(primitive.clone()))));
        for _ in 0..3_000 {
            let target = vec(0.0, 0.3, 0.0) + random.in_cube() * vec(0.9e-4, 0.0, 0.9e-4);
            let from = target + random.direction() * DVec3::X + DVec3::Y;
            let ray = Ray { origin: from, direction: target - from }.transformed(&turn);
            let hit = solid.intersect(&ray, f64::INFINITY).expect("aimed at it");
            assert_eq!(solid.leaf_of(hit.part), 0);
            let surface = solid.surface(&ray, &hit);
            for shape in order {
                assert!(!shape.contains(surface.point + surface.normal * surface.offset), "{surface:?}");
                assert!(shape.contains(surface.point - surface.normal * surface.offset), "{surface:?}");
            }
            let aside = surface.normal.any_orthonormal_vector() * random.between(-1.0, 1.0).signum();
            for cosine in [1.0, random.power(-3.0, 0.0)] {
                let direction = surface.normal * cosine + aside * (1.0 - cosine * cosine).sqrt();
                let origin = surface.point + surface.normal * surface.offset;
                assert_eq!(follow(&solid, &Ray { origin, direction }), (false, vec![]), "{surface:?} {cosine}");
            }
        }
    }
}

/// A wall on a floor, met exactly in the line where they meet, by rays that go on along wall and floor.
#[test]
fn rays_start_well_in_concave_corners() {
    let mut random = Random(50);
    for map in some_maps().into_iter().take(3) {
        let block = |min: DVec3, max: DVec3| Operand::Shape(Primitive::cuboid(min, max, &map));
        let room = solid(union([
            block(vec(-1.0, -0.3, -1.0), vec(1.0, 0.1, 1.0)),
            block(vec(0.3, 0.1, -1.0), vec(1.0, 0.9, 1.0)),
        ]));
        for _ in 0..3_000 {
            let corner = vec(0.3, 0.1, random.between(-0.9, 0.9));
            let from = vec(random.between(-1.0, 0.2), random.between(0.2, 1.0), random.between(-0.9, 0.9));
            let ray = Ray { origin: from, direction: corner - from }.transformed(&map);
            let hit = room.intersect(&ray, f64::INFINITY).expect("aimed at it");
            assert!((hit.t - 1.0).abs() < 1e-12);
            let surface = room.surface(&ray, &hit);
            // Back to where it came from, and to other places in the open: nothing is in the way.
            let start = surface.point + surface.normal * surface.offset;
            let open = vec(random.between(-1.0, 0.2), random.between(0.2, 1.0), random.between(-0.9, 0.9));
            for target in [ray.origin, map.transform_point3(open)] {
                let back = Ray { origin: start, direction: target - start };
                assert_eq!(room.intersect(&back, 1.0), None, "{ray:?} {back:?}");
            }
        }
    }
}
