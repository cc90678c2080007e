//! What is known by heart: lenses, rings, Steinmetz's solids.

use super::*;

#[test]
fn a_lens_along_its_axis() {
    let balls = || vec![ball(vec(-0.5, 0.0, 0.0), 1.0), ball(vec(0.5, 0.0, 0.0), 1.0)];
    let ray = Ray { origin: vec(-5.0, 0.0, 0.0), direction: DVec3::X };
    let normals = |operand: Operand| -> Vec<(f64, DVec3)> {
        let solid = solid(operand);
        let all = follow(&solid, &ray).1;
        all.iter().map(|crossing| (crossing.t, solid.surface(&ray, crossing).normal)).collect()
    };
    let (out, back) = (DVec3::X, DVec3::NEG_X);
    assert_eq!(normals(union(balls())), [(3.5, back), (6.5, out)]);
    assert_eq!(normals(intersection(balls())), [(4.5, back), (5.5, out)]);
    assert_eq!(normals(difference(balls())), [(3.5, back), (4.5, out)]);
    let other_way: Vec<Operand> = balls().into_iter().rev().collect();
    assert_eq!(normals(difference(other_way)), [(5.5, back), (6.5, out)]);
}

/// The length of many parallel rays inside, times what each stands for.
fn volume(solid: &Primitive, radius: f64, across: i32) -> f64 {
    let turn = rotation(vec(0.6, 0.0, 0.8), 0.7);
    let step = 2.0 * radius / f64::from(across);
    let mut length = 0.0;
    for row in 0..across {
        for column in 0..across {
            let (x, y) = (f64::from(column) + 0.5, f64::from(row) + 0.5);
            let ray = Ray {
                origin: turn * vec(x * step - radius, y * step - radius, -2.0 * radius),
                direction: turn * DVec3::Z,
            };
            let times = times(solid, &ray);
            assert_eq!(times.len() % 2, 0, "{ray:?}: {times:?}");
            length += times.chunks(2).map(|pair| pair[1] - pair[0]).sum::<f64>();
        }
    }
    length * step * step
}

/// The share of random points of a cube that are inside, times its volume.
fn volume_by_points(solid: &Primitive, radius: f64) -> f64 {
    let mut random = Random(21);
    let inside = (0..200_000).filter(|_| solid.contains(random.in_cube() * radius)).count();
    inside as f64 / 200_000.0 * 8.0 * radius * radius * radius
}

#[test]
fn volumes_are_those_of_the_books() {
    let unit = || ball(DVec3::ZERO, 1.0);
    let along = |axis: DVec3| rod(axis * -2.0, axis * 2.0, 1.0);
    let distance = 0.8;
    let lens = PI * (4.0 + distance) * (2.0 - distance) * (2.0 - distance) / 12.0;
    let whole = 4.0 / 3.0 * PI;
    let apart = || vec![unit(), ball(vec(0.0, distance, 0.0), 1.0)];
    let root = 2.0_f64.sqrt();
    let known = [
        ("lens", intersection(apart()), lens),
        ("two balls", union(apart()), 2.0 * whole - lens),
        ("moon", difference(apart()), whole - lens),
        (
            "napkin ring",
            difference([unit(), rod(vec(0.0, -2.0, 0.0), vec(0.0, 2.0, 0.0), 0.6)]),
            PI * 1.6 * 1.6 * 1.6 / 6.0,
        ),
        ("two cylinders", intersection([along(DVec3::X), along(DVec3::Y)]), 16.0 / 3.0),
        ("three cylinders", intersection([DVec3::X, DVec3::Y, DVec3::Z].map(along)), 8.0 * (2.0 - root)),
        ("half a ball", intersection([unit(), half_space(DVec3::ZERO, vec(0.6, 0.8, 0.0))]), 0.5 * whole),
        ("octant taken", difference([unit(), block(DVec3::ZERO, DVec3::splat(2.0))]), 0.875 * whole),
        (
            "half a ring",
            difference([
                Operand::Shape(Primitive::torus(DVec3::ZERO, DVec3::Z, [1.2, 0.4], &HERE)),
                half_space(DVec3::ZERO, DVec3::X),
            ]),
            PI * PI * 1.2 * 0.4 * 0.4,
        ),
    ];
    for (name, operand, expected) in known {
        let solid = solid(operand);
        let (by_rays, by_points) = (volume(&solid, 3.0, 600), volume_by_points(&solid, 3.0));
        assert!((by_rays - expected).abs() < 1e-3 * expected, "{name}: {by_rays}, expected {expected}");
        assert!((by_points - expected).abs() < 0.05 * expected, "{name}: {by_points}, expected {expected}");
    }
}

#[test]
fn thin_shells_have_two_sides() {
    let inner = 1.0 - 1e-9;
    let shell = solid(difference([ball(DVec3::ZERO, 1.0), ball(DVec3::ZERO, inner)]));
    let mut random = Random(22);
    for distance in [3.0, 15.0, 1e3, 1e6] {
        for _ in 0..2_000 {
            let direction = random.direction();
            let aside = direction.any_orthonormal_vector() * random.between(0.0, 0.999);
            let ray = Ray { origin: aside - direction * distance, direction };
            let half = |radius: f64| (radius * radius - aside.length_squared()).sqrt();
            let (far, near_by) = (half(1.0), half(inner));
            let expected = [distance - far, distance - near_by, distance + near_by, distance + far];
            let times = times(&shell, &ray);
            // The origin's rounding moves all four, and more the shallower the ray; it does not change the thickness.
            assert!(near(&times, &expected, 2e-14 * distance), "{ray:?}: {times:?}, expected {expected:?}");
            let thickness = [times[1] - times[0], times[3] - times[2]];
            assert!(near(&thickness, &[far - near_by; 2], 4e-16 * distance + 1e-13), "{ray:?}: {thickness:?}");
        }
    }
}

#[test]
fn shells_within_shells() {
    // Radii 64, 63, … 1, each taken away from what is outside.
    let nest = |radii: std::ops::RangeInclusive<i32>| {
        radii.fold(ball(DVec3::ZERO, 1.0), |inner, radius| difference([ball(DVec3::ZERO, f64::from(radius)), inner]))
    };
    let onion = solid(nest(2..=64));
    let ray = Ray { origin: vec(-100.0, 0.0, 0.0), direction: DVec3::X };
    let expected: Vec<f64> = (0..128).map(|i| if i < 64 { 36.0 + f64::from(i) } else { 37.0 + f64::from(i) }).collect();
    let (_, all) = follow(&onion, &ray);
    let times: Vec<f64> = all.iter().map(|crossing| crossing.t).collect();
    assert!(near(&times, &expected, 1e-12), "{times:?}");
    // Leaves are in the order of writing: the outermost first.
    let leaves: Vec<usize> = all[..64].iter().map(|crossing| onion.leaf_of(crossing.part)).collect();
    assert_eq!(leaves, (0..64).collect::<Vec<_>>());
    for crossing in &all {
        let normal = onion.surface(&ray, crossing).normal;
        let ahead = if onion.contains(ray.at(crossing.t + 0.5)) { DVec3::NEG_X } else { DVec3::X };
        assert!((normal - ahead).length() < 1e-12, "{crossing:?}: {normal}");
    }
}

/// More leaves and crossings than there is room for without the heap.
#[test]
fn a_string_of_many_beads() {
    let beads: Vec<Operand> = (0..700).map(|i| ball(vec(f64::from(i), 0.0, 0.0), 0.25)).collect();
    let ray = Ray { origin: vec(-1.0, 0.0, 0.0), direction: DVec3::X };
    let (_, all) = follow(&solid(union(beads.clone())), &ray);
    assert_eq!(all.len(), 1_400);
    for (i, crossing) in all.iter().enumerate() {
        let expected = 0.75 + (i / 2) as f64 + if i % 2 == 1 { 0.5 } else { 0.0 };
        assert!((crossing.t - expected).abs() < 1e-12 && crossing.part as usize == i / 2, "{crossing:?}");
    }
    let string = rod(vec(-0.5, 0.0, 0.0), vec(699.5, 0.0, 0.0), 0.5);
    let (_, all) = follow(&solid(difference(std::iter::once(string).chain(beads).collect::<Vec<_>>())), &ray);
    assert_eq!(all.len(), 1_402);
    assert_eq!((all[0].part, all[1].part, all[1_401].part), (1, 3, 2));
}

#[test]
fn a_pit_in_endless_ground() {
    let ground = solid(difference([half_space(vec(0.0, 1.0, 0.0), DVec3::Y), ball(vec(3.0, 1.0, 0.0), 2.0)]));
    let down = |x: f64| Ray { origin: vec(x, 5.0, 0.0), direction: DVec3::NEG_Y };
    assert_eq!((times(&ground, &down(0.0)), times(&ground, &down(3.0))), (vec![4.0], vec![6.0]));
    assert!(!ground.bounds().min.is_finite());
    let (starts_inside, all) = follow(&ground, &Ray { origin: vec(3.0, -5.0, 0.0), direction: DVec3::Y });
    assert!(starts_inside);
    assert_eq!(all, [Crossing { t: 4.0, part: 1 }]);
    let (starts_inside, all) = follow(&ground, &Ray { origin: vec(-5.0, 0.5, 0.0), direction: DVec3::X });
    assert!(starts_inside);
    assert!(near(
        &all.iter().map(|hit| hit.t).collect::<Vec<_>>(),
        &[8.0 - 3.75_f64.sqrt(), 8.0 + 3.75_f64.sqrt()],
        1e-12
    ));
    assert!(
        ground.contains(vec(3.0, -5.0, 0.0))
            && !ground.contains(vec(3.0, 0.0, 0.0))
            && !ground.contains(vec(0.0, 2.0, 0.0))
    );
    // Level rays in it and above it never get out or in.
    for (y, inside) in [(-3.0, true), (1.5, false)] {
        assert_eq!(follow(&ground, &Ray { origin: vec(9.0, y, 0.5), direction: DVec3::X }), (inside, vec![]));
    }
}

/// Where a solid is put together far from everything, or of things of very different size, the small ones are as sharp
/// as if they were alone.
#[test]
fn small_things_near_large_ones_are_sharp() {
    let ground = || ball(vec(0.0, -1e6, 0.0), 1e6);
    let top = |x: f64| 1e6 * (1.0 - (1.0 - x * x * 1e-12).sqrt());
    let dotted = solid(difference([ground(), ball(DVec3::ZERO, 1e-3), ball(vec(1e9, 0.0, 0.0), 1e-4)]));
    let mut random = Random(25);
    for _ in 0..1_000 {
        let (x, z) = (random.between(-6e-4, 6e-4), random.between(-6e-4, 6e-4));
        let down = Ray { origin: vec(x, 1.0, z), direction: DVec3::NEG_Y };
        let hit = dotted.intersect(&down, f64::INFINITY).expect("the bottom of the dot");
        let expected = 1.0 + (1e-6 - x * x - z * z).sqrt();
        assert!((hit.t - expected).abs() < 1e-15 && hit.part == 1, "{hit:?}, expected {expected}");
        let beside = Ray { origin: vec(x + 0.01, 1.0, z), direction: DVec3::NEG_Y };
        let hit = dotted.intersect(&beside, f64::INFINITY).expect("the ground");
        assert!((hit.t - 1.0 - top(x + 0.01)).abs() < 1e-9 && hit.part == 0, "{hit:?}");
    }
    let away = vec(1e6, 1e6, -1e6);
    let lens = solid(intersection([ball(away, 1.0), ball(away + DVec3::X, 1.0)]));
    let ray = Ray { origin: away - DVec3::X, direction: DVec3::X };
    assert_eq!(times(&lens, &ray), [1.0, 2.0]);
}

#[test]
fn bounds_are_those_of_what_can_be_inside() {
    let close = |primitive: Primitive, min: DVec3, max: DVec3| {
        let Bounds { min: low, max: high } = primitive.bounds();
        assert!((low - min).length() < 1e-12 && (high - max).length() < 1e-12, "{low} {high}");
    };
    let two = || vec![block(DVec3::ZERO, DVec3::splat(2.0)), block(DVec3::ONE, vec(5.0, 3.0, 3.0))];
    close(solid(union(two())), DVec3::ZERO, vec(5.0, 3.0, 3.0));
    close(solid(intersection(two())), DVec3::ONE, DVec3::splat(2.0));
    close(solid(difference(two())), DVec3::ZERO, DVec3::splat(2.0));
    let below = half_space(vec(0.0, 0.5, 0.0), DVec3::Y);
    close(solid(intersection([two().remove(0), below])), DVec3::ZERO, vec(2.0, 0.5, 2.0));
    let beside = half_space(vec(0.5, 0.0, 0.0), DVec3::NEG_X);
    close(solid(intersection([two().remove(0), beside])), vec(0.5, 0.0, 0.0), DVec3::splat(2.0));
}

/// Boxes lie in those above them, and what cannot matter is not in the tree.
#[test]
fn trees_are_pruned() {
    let holes = (0..1_000).map(|i| ball(vec(f64::from(i % 100), f64::from(i / 100), 0.0), 0.3));
    let plate = block(vec(9.5, -1.0, -1.0), vec(29.5, 1.5, 1.0));
    let (solid, _) = Solid::build(difference(std::iter::once(plate).chain(holes).collect::<Vec<_>>()));
    let leaves = solid.nodes.iter().filter(|node| node.leaf.is_some()).count();
    assert_eq!(leaves, 1 + 20 * 2);
    for (i, node) in solid.nodes.iter().enumerate() {
        let (mut below, mut children) = (i + 1, 0);
        while below < node.end as usize {
            let child = &solid.nodes[below];
            let margin = node.bounds.widened(1e-6);
            assert!(holds(&margin, child.bounds.min).is_some() && holds(&margin, child.bounds.max).is_some(), "{i}");
            (below, children) = (child.end as usize, children + 1);
        }
        assert!(below == node.end as usize && children <= MOST_TOGETHER + 1, "{i}: {children}");
    }
    assert_eq!(solid.part_count(), 6 + 1_000);
}

#[test]
fn nothing_is_hit_where_nothing_is_left() {
    let unit = || block(DVec3::ZERO, DVec3::ONE);
    let mut random = Random(23);
    let nothings = [
        union([]),
        intersection([]),
        difference([]),
        intersection([unit(), ball(DVec3::splat(3.0), 1.0)]),
        intersection([unit(), union([ball(vec(3.0, 0.5, 0.5), 1.5), ball(vec(-3.0, 0.5, 0.5), 1.5)])]),
        difference([unit(), ball(DVec3::splat(0.5), 1.0)]),
        difference([unit(), half_space(vec(0.0, 2.0, 0.0), DVec3::Y)]),
        difference([union([]), unit()]),
    ];
    for nothing in nothings {
        let nothing = solid(nothing);
        assert!(!nothing.bounds().is_empty(), "a box that a tree can hold");
        for _ in 0..2_000 {
            let ray = ray_at(DVec3::splat(0.5), 1.0, &mut random);
            assert_eq!(follow(&nothing, &ray), (false, vec![]), "{ray:?}");
            assert!(!nothing.contains(ray.origin));
        }
    }
}

/// A die: a cube with its corners cut by a ball.
#[test]
fn a_die_keeps_the_laws_of_convex_shapes() {
    let (die, middle) = Solid::build(intersection([block(-DVec3::ONE, DVec3::ONE), ball(DVec3::ZERO, 1.4)]));
    assert_eq!(middle, DVec3::ZERO);
    let known = Known {
        shape: &die,
        levels: &[
            &|p| -1.0 - p.x,
            &|p| p.x - 1.0,
            &|p| -1.0 - p.y,
            &|p| p.y - 1.0,
            &|p| -1.0 - p.z,
            &|p| p.z - 1.0,
            &|p| p.length() - 1.4,
        ],
    };
    known.hits_obey_the_equation();
    known.crossings_match_sampling(&|p| (p.abs().max_element() - 1.0).max(p.length() - 1.4), true, |_| true);
    known.leaves_and_enters_once(true);
    known.far_rays_are_precise(true);
    known.crossings_are_those_found_one_by_one();
}

#[test]
fn parts_name_leaf_and_face() {
    let column = Primitive::cylinder(DVec3::ZERO, vec(0.0, 3.0, 0.0), 1.0, false, &HERE);
    let operand = union([
        Operand::Shape(column.clone()),
        difference([block(vec(2.0, 0.0, 0.0), vec(4.0, 2.0, 2.0)), ball(vec(4.0, 2.0, 2.0), 1.0)]),
    ]);
    let solid = solid(operand);
    let hit = |origin: DVec3, direction: DVec3| {
        let ray = Ray { origin, direction };
        let crossing = solid.intersect(&ray, f64::INFINITY).expect("aimed at it");
        let surface = solid.surface(&ray, &crossing);
        (solid.leaf_of(crossing.part), crossing.part, surface.normal, solid.uv(surface.point, crossing.part))
    };
    let (leaf, part, normal, uv) = hit(vec(0.5, 9.0, 0.0), DVec3::NEG_Y);
    assert_eq!((leaf, part, normal), (0, 2, DVec3::Y));
    assert_eq!(uv, column.uv(vec(0.5, 3.0, 0.0), 2));
    let (leaf, part, normal, _) = hit(vec(3.0, 1.0, -9.0), DVec3::Z);
    assert_eq!((leaf, part, normal), (1, 3 + 4, DVec3::NEG_Z));
    let (leaf, part, normal, _) = hit(vec(4.0, 9.0, 2.0) + vec(-0.1, 0.0, -0.1), DVec3::NEG_Y);
    assert_eq!((leaf, part), (2, 9));
    assert!(normal.y > 0.9, "{normal}");
    assert_eq!(column.leaf_of(2), 0);
}

#[test]
fn crossings_are_counted() {
    let ring = solid(difference([ball(DVec3::ZERO, 2.0), ball(DVec3::ZERO, 1.0)]));
    let ray = Ray { origin: vec(-3.0, 0.0, 0.0), direction: DVec3::X };
    let counts: Vec<u32> = [0.5, 1.5, 3.0, 4.5, 9.0].map(|t_max| ring.count_crossings(&ray, t_max)).into();
    assert_eq!(counts, [0, 1, 2, 3, 4]);
    assert_eq!(ring.intersect(&ray, 1.0), None);
    assert_eq!(ring.intersect(&ray, 1.001), Some(Crossing { t: 1.0, part: 0 }));
}

#[test]
fn solids_may_be_operands_of_solids() {
    let mut random = Random(24);
    let moon = || difference([ball(DVec3::ZERO, 1.0), ball(vec(0.5, 0.0, 0.0), 0.8)]);
    let bite = || block(vec(-2.0, 0.3, -2.0), vec(2.0, 2.0, 2.0));
    let flat = solid(difference([moon(), bite()]));
    let nested = solid(difference([Operand::Shape(solid(moon())), bite()]));
    for _ in 0..3_000 {
        let ray = ray_at(DVec3::ZERO, 1.0, &mut random);
        let (a, b) = (follow(&flat, &ray), follow(&nested, &ray));
        assert_eq!(a.0, b.0, "{ray:?}");
        assert!(near(&times(&flat, &ray), &times(&nested, &ray), 1e-12), "{ray:?}: {a:?} {b:?}");
    }
}
