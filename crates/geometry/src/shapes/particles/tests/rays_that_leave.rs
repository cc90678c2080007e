//! Surfaces are sharp: what leaves does not come back, and what grazes is above or below.

use super::*;

/// A particle, and a primitive that has nothing else.
fn placed(random: &mut Random, kind: u32, place: f64, size: f64, mapped: bool) -> (One, Primitive) {
    let at = random.in_cube() * place;
    let one = random.particle(kind, at, size);
    let map = if mapped { random.map() } else { DAffine3::IDENTITY };
    (one, Primitive::particles(Arc::new(one.set()), &map))
}

fn for_surfaces(check: impl Fn(&Primitive, &Surface, &mut Random, u32)) {
    for (place, size) in [(0.0, 1.0), (1.0, 1e-3), (1e3, 1.0), (1e3, 1e3), (1e6, 10.0), (0.0, 1e-6)] {
        for kind in KINDS {
            let mut random = Random(31 + u64::from(kind));
            let mut hits = 0;
            for case in 0..400 {
                let (one, primitive) = placed(&mut random, kind, place, size, case % 2 == 1);
                let bounds = primitive.bounds();
                for _ in 0..10 {
                    let (target, direction) =
                        (bounds.center() + random.in_cube() * (0.3 * one.size()), random.direction());
                    let far = random.power(-1.0, 5.0) * one.size();
                    let ray = Ray { origin: target - direction * far, direction };
                    let Some(crossing) = primitive.intersect(&ray, f64::INFINITY) else { continue };
                    hits += 1;
                    check(&primitive, &primitive.surface(&ray, &crossing), &mut random, kind);
                }
            }
            assert!(hits > 1000, "the test must test something: {hits}");
        }
    }
}

fn tilted(normal: DVec3, cosine: f64, random: &mut Random) -> DVec3 {
    let tangent = normal.cross(random.direction()).normalize();
    normal * cosine + tangent * (1.0 - cosine * cosine).sqrt()
}

#[test]
fn do_not_meet_it_again() {
    for_surfaces(|primitive, surface, random, kind| {
        if kind == 2 {
            // From outside a tube may be entered at its end.
            return;
        }
        for cosine in [0.0, 1e-12, random.power(-9.0, 0.0), random.between(0.0, 1.0)] {
            let direction = tilted(surface.normal, cosine, random);
            let away = Ray { origin: surface.point + surface.normal * surface.offset, direction };
            assert_eq!(primitive.intersect(&away, f64::INFINITY), None, "{surface:?} {cosine}");
            assert!(!primitive.meets(&away, f64::INFINITY));
        }
    });
}

#[test]
fn inwards_come_out_once() {
    for_surfaces(|primitive, surface, random, kind| {
        if kind == 2 {
            return;
        }
        let direction = -tilted(surface.normal, random.between(0.05, 1.0), random);
        let inside = surface.point - surface.normal * surface.offset;
        if !primitive.contains(inside) {
            // At a tip, or near a sharp rim.
            return;
        }
        let ray = Ray { origin: inside, direction };
        let Some(exit) = primitive.intersect(&ray, f64::INFINITY) else { panic!("{surface:?}") };
        let out = primitive.surface(&ray, &exit);
        let onward = Ray { origin: out.point + out.normal * out.offset, direction };
        assert!(out.normal.dot(direction) > -1e-9, "{surface:?} {out:?}");
        assert_eq!(primitive.intersect(&onward, f64::INFINITY), None, "{surface:?} {out:?}");
    });
}

#[test]
fn a_ray_along_a_surface_is_above_or_below() {
    let mut grazing = 0;
    for (size, distance) in [(1.0, 10.0), (1.0, 1e3), (1.0, 1e6), (1e-3, 1.0), (1e-3, 1e6), (1e3, 1e4)] {
        for kind in [0, 1, 3] {
            let mut random = Random(41);
            for _ in 0..500 {
                let (one, primitive) = placed(&mut random, kind, 0.0, size, false);
                let direction = random.direction();
                let ray = Ray { origin: one.center() - direction * (5.0 * size), direction };
                let Some(crossing) = primitive.intersect(&ray, f64::INFINITY) else { continue };
                let surface = primitive.surface(&ray, &crossing);
                let along = tilted(surface.normal, 0.0, &mut random);
                let height = surface.offset + 2e-15 * distance;
                let at = |height: f64| Ray {
                    origin: surface.point + surface.normal * height - along * distance,
                    direction: along,
                };
                assert_eq!(primitive.intersect(&at(height), f64::INFINITY), None, "{one:?} {surface:?}");
                let inside = surface.point - surface.normal * height;
                if one.depth(inside) < -0.9 * height {
                    grazing += 1;
                    let hit = primitive.intersect(&at(-height), f64::INFINITY);
                    assert!(hit.is_some_and(|hit| hit.t < distance), "{one:?} {surface:?} {hit:?}");
                }
            }
        }
    }
    assert!(grazing > 3000, "the test must test something: {grazing}");
}

#[test]
fn points_on_surfaces_are_as_near_as_promised() {
    for (place, size) in [(0.0, 1.0), (1.0, 1.0), (1e3, 1e-2), (0.0, 1e-6)] {
        for kind in KINDS {
            let (mut random, mut worst) = (Random(42), 0.0_f64);
            for _ in 0..2000 {
                let at = random.in_cube() * place;
                let one = random.particle(kind, at, size);
                let set = one.set();
                let direction = random.direction();
                let ray = Ray { origin: one.center() - direction * (3.0 * size), direction };
                let Some(crossing) = set.intersect(&ray, f64::INFINITY) else { continue };
                let (point, _) = set.surface(ray.at(crossing.t), crossing.part);
                worst = worst.max(one.depth(point - set.origin()).abs() / set.rounding(crossing.part));
            }
            assert!((0.02..=0.7).contains(&worst), "{worst} of what is promised: kind {kind} at {place} of {size}");
        }
    }
}

#[test]
fn rims_are_inside_a_little() {
    let mut random = Random(43);
    let mut rims = 0;
    for _ in 0..3000 {
        let at = random.in_cube();
        let One::Frustum([base, top], [radius, _]) = random.particle(1, at, 1.0) else { continue };
        if radius == 0.0 {
            continue;
        }
        let one = One::Frustum([base, top], [radius; 2]);
        let cylinder = Primitive::particles(Arc::new(one.set()), &DAffine3::IDENTITY);
        let out = (top - base).cross(random.direction()).normalize();
        let rim = base + out * radius;
        let direction = (base.lerp(top, 0.3) - rim + (top - base).cross(out) * random.between(-0.1, 0.1)).normalize();
        let ray = Ray { origin: rim - direction, direction };
        let Some(crossing) = cylinder.intersect(&ray, f64::INFINITY) else { continue };
        let surface = cylinder.surface(&ray, &crossing);
        let inside = surface.point - surface.normal * surface.offset;
        assert!(cylinder.contains(inside), "{one:?} {surface:?}");
        rims += 1;
    }
    assert!(rims > 1000, "the test must test something: {rims}");
}
