//! The tree, the lists and every instruction set find what testing all primitives one by one finds, to the last bit.

use super::*;
use crate::SimdLevel;
use durer_math::{DAffine3, DMat3, DVec2, rotation};

/// Random numbers, the same at every run (Knuth's MMIX multiplier).
struct Random(u64);

impl Random {
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn point(&mut self, reach: f64) -> DVec3 {
        DVec3::new(self.number(-reach, reach), self.number(-reach, reach), self.number(-reach, reach))
    }

    fn direction(&mut self) -> DVec3 {
        // Now and then along an axis, where divisions by zero lurk.
        let axis = self.number(0.0, 12.0) as usize;
        if axis < 3 { DVec3::AXES[axis] } else { self.point(1.0).normalize() }
    }

    fn map(&mut self, scale: f64) -> DAffine3 {
        let stretch = DVec3::new(self.number(0.3, 2.0), self.number(-2.0, -0.3), self.number(0.3, 2.0)) * scale;
        let turn = rotation(self.direction(), self.number(0.0, 6.0));
        DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(stretch), self.point(10.0))
    }

    fn primitive(&mut self, scale: f64) -> Primitive {
        let map = self.map(scale);
        let (o, y) = (DVec3::ZERO, DVec3::Y);
        let mut primitive = match self.number(0.0, 10.0) as u32 {
            0 => Primitive::sphere(o, 1.0, &map),
            1 => Primitive::cuboid(-DVec3::ONE, DVec3::ONE, &map),
            2 => Primitive::cylinder(o, y, 1.0, false, &map),
            3 => Primitive::cylinder(o, y, 1.0, true, &map),
            4 => Primitive::cone(o, y, [1.0, 0.0], false, &map),
            5 => Primitive::cone(o, y, [1.0, 0.5], true, &map),
            6 => Primitive::disc(o, y, [0.2, 1.0], &map),
            7 => Primitive::rectangle(o, [DVec3::X, DVec3::Z], &map),
            8 => Primitive::triangle([o, DVec3::X, y], [DVec2::ZERO; 3], &map),
            _ => Primitive::torus(o, y, [1.0, 0.3], &map),
        };
        primitive.mask = 1 + self.number(0.0, 2.0) as u32;
        primitive
    }

    fn scene(&mut self, bounded: usize, planes: usize) -> Vec<Primitive> {
        let scale = if bounded > 100 { 0.5 } else { 2.0 };
        let mut all: Vec<Primitive> = (0..bounded).map(|_| self.primitive(scale)).collect();
        for _ in 0..planes {
            let mut plane = Primitive::plane(self.point(20.0), self.direction(), &DAffine3::IDENTITY);
            plane.mask = 1 + self.number(0.0, 2.0) as u32;
            all.insert(self.number(0.0, all.len() as f64) as usize, plane);
        }
        // The same thing twice: the lower index must win.
        all.extend_from_within(..all.len().min(3));
        all
    }
}

fn closest_by_hand(primitives: &[Primitive], ray: &Ray, t_max: f64, mask: u32) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    for (id, primitive) in primitives.iter().enumerate().filter(|(_, p)| p.mask & mask != 0) {
        if let Some(crossing) = primitive.intersect(ray, t_max)
            && best.is_none_or(|b| crossing.t < b.crossing.t)
        {
            best = Some(Hit { crossing, primitive: id as u32 });
        }
    }
    best
}

fn for_random_scenes(check: impl Fn(&[Primitive], &[World], &mut Random)) {
    let mut random = Random(7);
    for (bounded, planes) in [(0, 0), (1, 0), (0, 1), (7, 2), (9, 0), (60, 6), (60, 20), (400, 3), (2000, 0)] {
        for _ in 0..if bounded < 100 { 6 } else { 1 } {
            let primitives = random.scene(bounded, planes);
            let worlds: Vec<World> = SimdLevel::available()
                .into_iter()
                .map(|level| World::build(primitives.clone(), level.into()))
                .collect();
            check(&primitives, &worlds, &mut random);
        }
    }
}

#[test]
fn the_closest_hit_is_that_of_testing_all_at_every_instruction_set() {
    for_random_scenes(|primitives, worlds, random| {
        let eye = random.point(15.0);
        let vantage = worlds[0].vantage(eye, u32::MAX);
        for i in 0..200 {
            let origin = if i % 2 == 0 { eye } else { random.point(15.0) };
            let ray = Ray { origin, direction: random.direction() };
            let (t_max, mask) = (random.number(1.0, 60.0), 1 + i % 3);
            let expected = closest_by_hand(primitives, &ray, t_max, mask);
            for world in worlds {
                assert_eq!(world.closest_hit(&ray, t_max, mask, None), expected);
            }
            if i % 2 == 0 {
                let infinite = closest_by_hand(primitives, &ray, f64::INFINITY, mask);
                assert_eq!(worlds[0].closest_hit(&ray, f64::INFINITY, mask, vantage.as_ref()), infinite);
            }
        }
    });
}

#[test]
fn any_hit_visits_exactly_what_is_met() {
    for_random_scenes(|primitives, worlds, random| {
        let light = random.point(15.0);
        let vantage = worlds[0].vantage(light, 1);
        for _ in 0..100 {
            let origin = random.point(15.0);
            let distance = (light - origin).length();
            let ray = Ray { origin, direction: (light - origin) / distance };
            let met: Vec<u32> = (0..primitives.len() as u32)
                .filter(|&id| primitives[id as usize].intersect(&ray, distance).is_some())
                .collect();
            for world in worlds {
                let mut visited = Vec::new();
                assert!(!world.any_hit(&ray, distance, None, |id, _| {
                    visited.push(id);
                    false
                }));
                visited.sort_unstable();
                assert_eq!(visited, met);
                assert_eq!(world.any_hit(&ray, distance, None, |_, _| true), !met.is_empty());
            }
            // What does not hide is visited, all of it.
            let clear = |id: &u32| primitives[*id as usize].mask & 1 == 0;
            let mut visited = Vec::new();
            worlds[0].any_hit(&ray, distance, vantage.as_ref(), |id, _| {
                visited.push(id);
                false
            });
            visited.sort_unstable();
            visited.retain(clear);
            assert_eq!(visited, met.iter().copied().filter(clear).collect::<Vec<u32>>());
            for class in [1, 2] {
                let expected = met.iter().any(|&id| primitives[id as usize].mask == class);
                let found = worlds[0].any_hit(&ray, distance, vantage.as_ref(), |_, p| p.mask == class);
                assert_eq!(found, expected);
            }
        }
    });
}

#[test]
fn rays_that_leave_a_surface_do_not_meet_it_again() {
    let mut random = Random(3);
    for scale in [1e-3, 1.0, 1e6] {
        for _ in 0..300 {
            let primitive = random.primitive(scale);
            let bounds = primitive.bounds();
            let target = bounds.min + bounds.size() * random.number(0.2, 0.8);
            let origin = target + random.direction() * (bounds.size().length() + 20.0);
            let ray = Ray { origin, direction: (target - origin).normalize() };
            let Some(crossing) = primitive.intersect(&ray, f64::INFINITY) else { continue };
            let surface = primitive.surface(&ray, &crossing);
            assert!(surface.offset < 1e-6 * bounds.size().length(), "an offset that shows: {}", surface.offset);
            for _ in 0..50 {
                let direction = random.direction();
                let side = direction.dot(surface.normal);
                let leaving = Ray { origin: surface.point + surface.normal * surface.offset.copysign(side), direction };
                if let Some(again) = primitive.intersect(&leaving, f64::INFINITY) {
                    let back = primitive.surface(&leaving, &again);
                    let apart = (back.point - surface.point).length();
                    assert!(apart > 2.0 * surface.offset, "{primitive:?} met again after {apart}");
                }
            }
        }
    }
}

#[test]
fn crossings_of_a_closed_shape_come_in_pairs_for_rays_from_outside() {
    let mut random = Random(5);
    let ball = Primitive::sphere(DVec3::ZERO, 1.0, &DAffine3::IDENTITY);
    let ring = Primitive::torus(DVec3::ZERO, DVec3::Y, [1.0, 0.3], &DAffine3::IDENTITY);
    let mut fours = 0;
    for _ in 0..2000 {
        let origin = random.direction() * 5.0;
        let ray = Ray { origin, direction: (random.point(0.8) - origin).normalize() };
        assert!(matches!(ball.count_crossings(&ray, f64::INFINITY), 0 | 2));
        let crossings = ring.count_crossings(&ray, f64::INFINITY);
        assert!(matches!(crossings, 0 | 2 | 4), "{crossings}");
        fours += u32::from(crossings == 4);
        assert_eq!(ball.count_crossings(&Ray { origin: DVec3::ZERO, ..ray }, f64::INFINITY), 1);
    }
    assert!(fours > 50);
}

#[test]
fn of_axis_aligned_faces_all_but_in_one_place_the_nearer_is_hit_and_of_equal_ones_the_first() {
    let mut random = Random(11);
    let sheet = |y: f64| {
        Primitive::rectangle(DVec3::new(-3.0, y, 3.0), [DVec3::X * 6.0, DVec3::NEG_Z * 6.0], &DAffine3::IDENTITY)
    };
    for gap in [0.0, 1e-9, 1e-8, 1e-7] {
        for y in [0.1, 0.3, 1.7, -0.9] {
            // Enough things to make the tree a tree.
            let mut primitives = vec![sheet(y), sheet(y + gap), sheet(y)];
            primitives.extend((0..20).map(|_| random.primitive(0.1)));
            let world = World::build(primitives.clone(), Plan::default());
            let vantage_point = DVec3::new(0.2, 5.0, 0.1);
            let vantage = world.vantage(vantage_point, u32::MAX);
            for i in 0..2000 {
                let origin = if i % 2 == 0 { vantage_point } else { random.point(2.0) + DVec3::Y * 5.0 };
                let target = DVec3::new(random.number(-2.5, 2.5), y, random.number(-2.5, 2.5));
                let ray = Ray { origin, direction: (target - origin).normalize() };
                let expected = closest_by_hand(&primitives, &ray, f64::INFINITY, u32::MAX);
                let list = if i % 2 == 0 { vantage.as_ref() } else { None };
                assert_eq!(world.closest_hit(&ray, f64::INFINITY, u32::MAX, list), expected);
            }
        }
    }
}

#[test]
fn one_plane_written_twice_is_hit_as_the_first_whatever_finds_it() {
    let scaled = DAffine3::from_scale(DVec3::new(3.0, 0.7, 5.0));
    let primitives = vec![
        Primitive::plane(DVec3::NEG_Y, DVec3::Y, &DAffine3::IDENTITY),
        Primitive::plane(DVec3::NEG_Y / 0.7, DVec3::Y, &scaled),
    ];
    let world = World::build(primitives.clone(), Plan::default());
    let eye = DVec3::new(0.3, 1.9, 0.4);
    let vantage = world.vantage(eye, u32::MAX);
    let mut random = Random(13);
    for _ in 0..20_000 {
        let direction = (random.point(1.0) - DVec3::Y * 1.2).normalize();
        let ray = Ray { origin: eye, direction };
        let expected = closest_by_hand(&primitives, &ray, f64::INFINITY, u32::MAX);
        assert_eq!(world.closest_hit(&ray, f64::INFINITY, u32::MAX, vantage.as_ref()), expected);
    }
}

#[test]
fn a_plane_through_the_light_hides_no_other_plane() {
    let level = |y: f64| Primitive::plane(DVec3::Y * y, DVec3::Y, &DAffine3::IDENTITY);
    let world = World::build(vec![level(0.3), level(0.0), level(-2.0)], Plan::default());
    let light = DVec3::new(0.0, 0.3_f64.next_up(), 0.0);
    let vantage = world.vantage(light, 1);
    let origin = DVec3::new(0.5, -1.9, 0.2);
    let distance = (light - origin).length();
    let ray = Ray { origin, direction: (light - origin) / distance };
    let mut met = Vec::new();
    world.any_hit(&ray, distance * (1.0 - 1e-12), vantage.as_ref(), |id, _| {
        met.push(id);
        false
    });
    assert!(met.contains(&1), "the plane between is met: {met:?}");
}

#[test]
fn rays_leave_shapes_that_are_stretched_unevenly_and_askew() {
    let mut random = Random(17);
    for stretch in [1e2, 1e4, 1e6] {
        for case in 0..300 {
            let (turn, back) =
                (rotation(random.direction(), random.number(0.0, 6.0)), rotation(random.direction(), 1.0));
            let uneven = DMat3::from_diagonal(if case % 2 == 0 {
                DVec3::new(stretch, 1.0, 1.0)
            } else {
                DVec3::new(1.0, stretch, stretch)
            });
            let map = DAffine3::from_mat3_translation(back * uneven * turn, random.point(10.0));
            let ball = Primitive::sphere(DVec3::ZERO, 1.0, &map);
            let target = map.transform_point3(random.point(0.5));
            let origin = target + random.direction() * 4.0 * stretch;
            let ray = Ray { origin, direction: (target - origin).normalize() };
            let Some(crossing) = ball.intersect(&ray, f64::INFINITY) else { continue };
            let surface = ball.surface(&ray, &crossing);
            for _ in 0..40 {
                let direction = random.direction();
                let outward = direction * direction.dot(surface.normal).signum();
                let leaving = Ray { origin: surface.point + surface.normal * surface.offset, direction: outward };
                assert_eq!(ball.intersect(&leaving, f64::INFINITY), None, "stretch {stretch}");
            }
        }
    }
}

#[test]
fn the_tree_is_no_deeper_than_its_stack_allows() {
    // Each thing is far smaller than the one before: area would peel them off one by one.
    let size = |i: u32| (0..i).fold(1.0, |size: f64, _| size * 0.5);
    let nested = |i: u32| {
        let map = DAffine3::from_mat3_translation(
            DMat3::from_diagonal(DVec3::splat(size(i % 60))),
            DVec3::X * size(i % 60) * f64::from(i / 60 + 1),
        );
        Primitive::sphere(DVec3::ZERO, 1.0, &map)
    };
    let world = World::build((0..6000).map(nested).collect(), Plan::default());
    assert!(
        world
            .closest_hit(&Ray { origin: DVec3::X * 9000.0, direction: DVec3::NEG_X }, f64::INFINITY, 1, None)
            .is_some()
    );
}
