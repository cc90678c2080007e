//! Each kind is hit where single shapes are.

use super::*;

/// Where single shapes that overlap are met from outside, first; from inside, last.
fn met(singles: &[Primitive], ray: &Ray) -> Option<(Crossing, usize)> {
    let crossing =
        |(index, single): (usize, &Primitive)| single.intersect(ray, f64::INFINITY).map(|crossing| (crossing, index));
    let all = singles.iter().enumerate().filter_map(crossing);
    let inside = singles.iter().any(|single| single.contains(ray.origin));
    match inside {
        false => all.min_by(|a, b| a.0.t.total_cmp(&b.0.t)),
        true => left(singles, ray, all.count()),
    }
}

/// Where a ray that starts inside some leaves the last.
fn left(singles: &[Primitive], ray: &Ray, _met: usize) -> Option<(Crossing, usize)> {
    let mut exits = Vec::new();
    for (index, single) in singles.iter().enumerate() {
        let mut from = 0.0;
        while let Some(crossing) = single.intersect(&Ray { origin: ray.at(from), ..*ray }, f64::INFINITY) {
            from += crossing.t;
            exits.push((Crossing { t: from, part: crossing.part }, index));
            from += 1e-9 * single.bounds().size().length();
        }
    }
    exits.into_iter().max_by(|a, b| a.0.t.total_cmp(&b.0.t))
}

/// The least depth along a ray, which is convex there.
fn deepest(one: One, ray: &Ray, length: f64) -> f64 {
    let (mut low, mut high) = (0.0, length);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if one.depth(ray.at(a)) < one.depth(ray.at(b)) {
            high = b;
        } else {
            low = a;
        }
    }
    one.depth(ray.at(0.5 * (low + high)))
}

/// A ray at a particle of some size at some place: many graze it, some start inside.
fn ray_at(random: &mut Random, one: One, map: &DAffine3, distance: f64) -> Ray {
    let (size, center) = (one.size(), one.center());
    let target = map.transform_point3(center + random.in_cube() * (0.4 * size));
    // Along the axis or the side but for rounding, and little more.
    let along = match random.between(0.0, 6.0) as u32 {
        0 => one.axis(),
        1 => one.generator(random.direction()),
        _ => random.direction(),
    };
    let along = map.transform_vector3(along).normalize();
    let doubt = if random.between(0.0, 1.0) < 0.5 { random.power(-18.0, -2.0) } else { 0.0 };
    let direction = (along + random.direction() * doubt).normalize();
    let direction = if random.between(0.0, 1.0) < 0.5 { direction } else { -direction };
    Ray { origin: target - direction * distance, direction }
}

/// The surfaces agree but for `tolerance`, which along the ray grows the flatter it is met.
fn agree(ours: &Surface, theirs: &Surface, ray: &Ray, tolerance: f64, size: f64) -> bool {
    let apart = (ours.point - theirs.point).length();
    let cosine = ours.normal.dot(ray.direction).abs().max(theirs.normal.dot(ray.direction).abs());
    apart * cosine <= tolerance || apart * apart <= tolerance * size
}

fn compare(kind: u32, place: f64, size: f64, distance: f64, maps: bool) {
    let mut random = Random(21 + u64::from(kind));
    let (mut hits, mut differences) = (0, 0);
    for _ in 0..300 {
        let at = random.in_cube() * place;
        let one = random.particle(kind, at, size);
        let map = if maps { random.map() } else { DAffine3::IDENTITY };
        let ours = Primitive::particles(Arc::new(one.set()), &map);
        let singles = one.singles(&map);
        for _ in 0..60 {
            let far = if random.between(0.0, 4.0) < 1.0 { 0.0 } else { distance };
            let ray = ray_at(&mut random, one, &map, far);
            let tolerance = 1e-14 * (far + 30.0 * (place + size) + 10.0);
            let expected = met(&singles, &ray);
            let found = ours.intersect(&ray, f64::INFINITY);
            assert_eq!(ours.meets(&ray, f64::INFINITY), found.is_some());
            let (Some((theirs, index)), Some(crossing)) = (expected, found) else {
                let differ = expected.is_some() != found.is_some();
                let deepest = deepest(one, &ray.transformed(&map.inverse()), far + 8.0 * one.size());
                let grazes = deepest.abs() < 3.0 * tolerance || kind == 2;
                assert!(!differ || grazes, "{one:?} {ray:?}: {found:?}, single {expected:?}, depth {deepest:e}");
                differences += u32::from(differ);
                continue;
            };
            hits += 1;
            let (ours_at, theirs_at) = (ours.surface(&ray, &crossing), singles[index].surface(&ray, &theirs));
            assert!(
                agree(&ours_at, &theirs_at, &ray, tolerance, one.size()),
                "{one:?} {ray:?}: {crossing:?}, single {theirs:?}, apart {}",
                (ours_at.point - theirs_at.point).length()
            );
            let same_place = (ours_at.point - theirs_at.point).length();
            let normals_apart = (ours_at.normal - theirs_at.normal).length();
            let at_edge = kind != 0 && kind != 3 && crossing.part % FACES != theirs.part;
            differences += u32::from(at_edge);
            assert!(
                at_edge || normals_apart <= 100.0 * (same_place + tolerance) / size,
                "{one:?} {ray:?}: {} and {}",
                ours_at.normal,
                theirs_at.normal
            );
        }
    }
    assert!(hits > 2000, "the test must test something: {hits}");
    assert!(differences < 40, "{differences} of {hits}");
}

#[test]
fn near_and_of_usual_size() {
    KINDS.iter().for_each(|&kind| compare(kind, 3.0, 1.0, 7.0, false));
}

#[test]
fn placed_by_skew_and_mirroring_maps() {
    KINDS.iter().for_each(|&kind| compare(kind, 3.0, 1.0, 7.0, true));
}

#[test]
fn tiny() {
    KINDS.iter().for_each(|&kind| compare(kind, 1.0, 1e-3, 2.0, true));
}

#[test]
fn from_far_away() {
    KINDS.iter().for_each(|&kind| compare(kind, 1.0, 1.0, 1e6, true));
    KINDS.iter().for_each(|&kind| compare(kind, 1.0, 1e-3, 1e6, false));
}

#[test]
fn texture_coordinates_are_theirs() {
    let mut random = Random(22);
    for case in 0..2000 {
        let kind = case % 3;
        let at = random.in_cube();
        let one = random.particle(kind, at, 1.0);
        let map = random.map();
        let (ours, single) = (Primitive::particles(Arc::new(one.set()), &map), &one.singles(&map)[0]);
        let ray = ray_at(&mut random, one, &map, 5.0);
        if let (Some(a), Some(b)) = (ours.intersect(&ray, f64::INFINITY), single.intersect(&ray, f64::INFINITY))
            && a.part % FACES == b.part
        {
            let point = single.surface(&ray, &b).point;
            let (a, b) = (ours.uv(point, a.part), single.uv(point, b.part));
            let seam = (a.x - b.x).abs() > 0.99;
            assert!(seam || (a - b).length() < 1e-9, "{one:?} {point}: {a} and {b}");
        }
    }
}

#[test]
fn contain_the_same_points() {
    let mut random = Random(23);
    for kind in KINDS {
        let mut inside = 0;
        for _ in 0..2000 {
            let at = random.in_cube();
            let one = random.particle(kind, at, 1.0);
            let map = random.map();
            let ours = Primitive::particles(Arc::new(one.set()), &map);
            let point = map.transform_point3(one.center() + random.in_cube() * (0.5 * one.size()));
            let expected = one.singles(&map).iter().any(|single| single.contains(point));
            assert_eq!(ours.contains(point), expected, "{one:?} {point}");
            inside += u32::from(expected);
        }
        assert!(inside > 100 || kind == 2, "{inside}");
    }
}
