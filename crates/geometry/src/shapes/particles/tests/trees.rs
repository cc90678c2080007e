//! Trees find what testing all one by one finds, to the last bit.

use super::*;

/// Particles one by one, each with a tree of its own.
fn alone(all: &[One]) -> Vec<Particles> {
    all.iter().map(|one| set(SimdLevel::available()[0], &[*one])).collect()
}

/// The nearest crossing, and whose it is.
fn by_hand(alone: &[Particles], ray: &Ray, t_max: f64) -> Option<(f64, u32, u32)> {
    let mut best: Option<(f64, u32, u32)> = None;
    for (number, particle) in alone.iter().enumerate() {
        if let Some(crossing) = particle.intersect(ray, t_max)
            && best.is_none_or(|(t, ..)| crossing.t < t)
        {
            best = Some((crossing.t, number as u32, crossing.part % FACES));
        }
    }
    best
}

#[test]
fn find_what_testing_all_finds_at_every_instruction_set() {
    for kind in KINDS {
        let mut random = Random(51 + u64::from(kind));
        let mut hits = 0;
        for count in [1, 2, 3, 4, 5, 8, 9, 17, 100, 1500] {
            let mut all = random.particles(kind, count);
            // The same thing twice: the lower number must win.
            all.extend_from_within(..count.min(3));
            let sets: Vec<Particles> = SimdLevel::available().into_iter().map(|level| set(level, &all)).collect();
            let alone = alone(&all);
            for _ in 0..if count > 100 { 200 } else { 400 } {
                let ray = random.ray();
                let t_max = if random.between(0.0, 2.0) < 1.0 { f64::INFINITY } else { random.between(0.1, 4.0) };
                let expected = by_hand(&alone, &ray, t_max);
                hits += u32::from(expected.is_some());
                for set in &sets {
                    let found = set.intersect(&ray, t_max);
                    let named = found.map(|c| (c.t, set.particle_of(c.part), c.part % FACES));
                    assert_eq!(named, expected, "{ray:?}");
                    assert_eq!(found, sets[0].intersect(&ray, t_max), "{ray:?}");
                    assert_eq!(set.meets(&ray, t_max), expected.is_some());
                    let mut work = Work::default();
                    assert_eq!(set.intersect_watched(&ray, t_max, &mut work), found);
                    assert!(work.nodes > 0 && work.primitives >= u64::from(found.is_some()));
                }
                let point = random.in_cube();
                let inside = alone.iter().any(|particle| particle.contains(point));
                assert!(sets.iter().all(|set| set.contains(point) == inside));
            }
        }
        assert!(hits > 500, "the test must test something: {hits}");
    }
}

#[test]
fn surfaces_are_those_of_the_particle_that_a_part_names() {
    for kind in KINDS {
        let mut random = Random(61);
        let all = random.particles(kind, 700);
        let (set, alone) = (set(SimdLevel::best(), &all), alone(&all));
        for _ in 0..2000 {
            let ray = random.ray();
            let Some(crossing) = set.intersect(&ray, f64::INFINITY) else { continue };
            let (own, face) = (&alone[set.particle_of(crossing.part) as usize], crossing.part % FACES);
            let point = ray.at(crossing.t);
            assert_eq!(set.surface(point, crossing.part), own.surface(point, face));
            assert_eq!(set.uv(point, crossing.part), own.uv(point, face));
            assert_eq!(set.rounding(crossing.part), own.rounding(face));
        }
    }
}

#[test]
fn of_equals_the_first_wins() {
    for kind in KINDS {
        let mut random = Random(71);
        let distinct = random.particles(kind, 40);
        // Each forty times over, so that leaves are full of equals.
        let all: Vec<One> = (0..1600).map(|index| distinct[(index * 7) % 40]).collect();
        let set = set(SimdLevel::best(), &all);
        let mut hits = 0;
        for _ in 0..500 {
            let ray = random.ray();
            let Some(crossing) = set.intersect(&ray, f64::INFINITY) else { continue };
            let number = set.particle_of(crossing.part) as usize;
            assert_eq!(all.iter().position(|one| *one == all[number]), Some(number));
            hits += 1;
        }
        assert!(hits > 50, "the test must test something: {hits}");
    }
}

#[test]
fn nested_ones_are_met_from_outside_in() {
    let shells = Particles::spheres(64, Plan::default(), |index| (DVec3::ZERO, (64 - index) as f64));
    let inwards = Ray { origin: DVec3::X * 100.0, direction: DVec3::NEG_X };
    let mut from = 0.0;
    for index in 0..64 {
        let ray = Ray { origin: inwards.at(from), ..inwards };
        let crossing = shells.intersect(&ray, f64::INFINITY).expect("a shell");
        assert_eq!((shells.particle_of(crossing.part), from + crossing.t), (index, 36.0 + f64::from(index)));
        from += crossing.t + 1e-9;
    }
    let outwards = Ray { origin: DVec3::ZERO, direction: DVec3::Y };
    let first = shells.intersect(&outwards, f64::INFINITY).expect("the smallest");
    assert_eq!((first.t, shells.particle_of(first.part)), (1.0, 63));
}

#[test]
fn take_few_bytes() {
    let mut random = Random(81);
    let spheres = random.particles(0, 50_000);
    let bytes = set(SimdLevel::best(), &spheres).memory() as f64 / 50_000.0;
    assert!(bytes < 40.0, "{bytes}");
}
