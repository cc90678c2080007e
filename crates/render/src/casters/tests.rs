use super::*;
use crate::sampler::{Purpose, Sampler};
use durer_geometry::{BuildFor, Plan, Primitive, Ray, SimdLevel, World};
use durer_math::DAffine3;

const IOR: f64 = 1.5;

/// Numbers from 0 to 1.
fn dice(index: u32, which: u32) -> f64 {
    Sampler::new(5, (0, 0), index).one(which, Purpose::Lobe)
}

fn direction(index: u32, which: u32) -> DVec3 {
    let (y, turn) = (2.0 * dice(index, which) - 1.0, std::f64::consts::TAU * dice(index, which + 1));
    let flat = (1.0 - y * y).sqrt();
    DVec3::new(flat * cos(turn), y, flat * sin(turn))
}

fn ball() -> Caster {
    Caster { primitive: 0, round: Round::Ball { center: DVec3::new(0.3, -0.2, 0.5), radius: 0.7 }, ior: Some(IOR) }
}

fn cylinder() -> Caster {
    let axis = DVec3::new(0.2, 1.0, -0.4).normalize();
    let round = Round::Cylinder { center: DVec3::new(-0.3, 0.1, 0.2), axis, half_length: 0.8, radius: 0.5 };
    Caster { primitive: 0, round, ior: Some(IOR) }
}

fn shape(caster: &Caster) -> Primitive {
    match caster.round {
        Round::Ball { center, radius } => Primitive::sphere(center, radius, &DAffine3::IDENTITY),
        Round::Cylinder { center, axis, half_length, radius } => {
            let end = axis * half_length;
            Primitive::cylinder(center - end, center + end, radius, false, &DAffine3::IDENTITY)
        }
    }
}

fn refracted(d: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    let cos = -d.dot(normal);
    let squared = 1.0 - (1.0 - cos * cos) / (eta * eta);
    (squared > 0.0).then(|| (d / eta + normal * (cos / eta - squared.sqrt())).normalize())
}

/// Follows a ray in a given way, surface by surface: how many it meets, and where it goes then.
fn follow(caster: &Caster, from: DVec3, toward: DVec3, passage: Passage) -> Option<(u32, DVec3)> {
    let world = World::build(vec![shape(caster)], Plan { purpose: BuildFor::Preview, simd: SimdLevel::best() });
    let mut ray = Ray { origin: from, direction: toward };
    let meet = |ray: &mut Ray, passes: Option<bool>| {
        let hit = world.closest_hit(ray, f64::INFINITY, u32::MAX, None)?;
        let surface = world.surface(ray, &hit);
        let side = if ray.direction.dot(surface.normal) < 0.0 { 1.0 } else { -1.0 };
        let normal = surface.normal * side;
        let is_cap = hit.crossing.part != 0;
        let passes = passes.unwrap_or(is_cap);
        let eta = if side > 0.0 { IOR } else { 1.0 / IOR };
        let direction = match passes {
            true => refracted(ray.direction, normal, eta)?,
            false => ray.direction - normal * (2.0 * ray.direction.dot(normal)),
        };
        let offset = normal * if passes { -surface.offset } else { surface.offset };
        *ray = Ray { origin: surface.point + offset, direction };
        Some(is_cap)
    };
    let mut surfaces = 1;
    match passage {
        Passage::Back => (!meet(&mut ray, Some(false))?).then_some(())?,
        Passage::Through => {
            let caps = [meet(&mut ray, Some(true))?, meet(&mut ray, Some(true))?];
            surfaces = 2;
            (caps == [false, false]).then_some(())?;
        }
        Passage::Along => {
            meet(&mut ray, None)?.then_some(())?;
            loop {
                surfaces += 1;
                if meet(&mut ray, None)? {
                    break;
                }
            }
        }
    }
    Some((surfaces, ray.direction))
}

/// Places from which rays are sent by a caster, in some passage.
fn cases() -> Vec<(Caster, DVec3, Passage)> {
    let mut cases = Vec::new();
    for (caster, passages) in [
        (ball(), [Passage::Through, Passage::Back].as_slice()),
        (cylinder(), [Passage::Through, Passage::Back, Passage::Along].as_slice()),
    ] {
        for &passage in passages {
            for (index, distance) in [0.81, 1.0, 1.7, 6.0].into_iter().enumerate() {
                let from = match (caster.round, passage) {
                    // Before an end, near the axis.
                    (Round::Cylinder { center, axis, radius, .. }, Passage::Along) => {
                        let (u, v) = any_orthonormal_pair(axis);
                        let off = (u * dice(index as u32, 50) + v * dice(index as u32, 51)) * 0.6 * radius;
                        let side = if index % 2 == 0 { 1.0 } else { -1.0 };
                        center + axis * (side * distance) + off
                    }
                    (Round::Ball { center, .. } | Round::Cylinder { center, .. }, _) => {
                        center + direction(index as u32, 40) * distance
                    }
                };
                cases.push((caster, from, passage));
            }
        }
    }
    cases
}

/// To somewhere in the caster or around it.
fn toward(caster: &Caster, from: DVec3, index: u32) -> DVec3 {
    let (center, size) = match caster.round {
        Round::Ball { center, radius } => (center, radius),
        Round::Cylinder { center, half_length, .. } => (center, half_length),
    };
    (center + direction(index, 0) * (1.1 * size * dice(index, 3).sqrt()) - from).normalize()
}

/// Any ray that goes some way is found again by where it goes, so that none is missed; and all that are found go there.
#[test]
fn rays_are_found_by_where_they_go() {
    for (caster, from, passage) in cases() {
        let mut met = 0;
        for index in 0..3000 {
            let toward = toward(&caster, from, index);
            let Some((surfaces, light)) = follow(&caster, from, toward, passage) else { continue };
            if passage == Passage::Along && surfaces - 2 > MOST_TIMES {
                continue;
            }
            met += 1;
            let found = caster.rays(from, light, passage);
            let off = |other: &DVec3| (*other - toward).length();
            assert!(
                found.iter().any(|other| off(other) < 1e-6),
                "{caster:?} {passage:?} from {from}: {toward} {found:?}"
            );
            for other in found {
                let Some((_, end)) = follow(&caster, from, other, passage) else {
                    panic!("{caster:?} {passage:?} from {from}: {other} does not come through")
                };
                assert!((end - light).length() < 1e-6, "{passage:?} from {from}: {other} goes to {end}, not {light}");
            }
        }
        assert!(met > 20, "{caster:?} {passage:?} from {from}: {met} rays");
    }
}

/// The solid angle that rays around one leave in, by differences.
#[test]
fn spread_is_a_ratio_of_solid_angles() {
    let mut checked = 0;
    for (caster, from, passage) in cases() {
        for index in 0..1500 {
            let toward = toward(&caster, from, index);
            let Some((surfaces, _)) = follow(&caster, from, toward, passage) else { continue };
            let (u, v) = any_orthonormal_pair(toward);
            let h = 1e-5;
            let end = |by: DVec3| match follow(&caster, from, (toward + by).normalize(), passage) {
                Some((same, end)) if same == surfaces => Some(end),
                _ => None,
            };
            let [Some(a), Some(b), Some(c), Some(d)] = [end(u * h), end(u * -h), end(v * h), end(v * -h)] else {
                continue;
            };
            let expected = (a - b).cross(c - d).length() / (4.0 * h * h);
            match caster.spread(from, toward, passage, surfaces) {
                Some(spread) => {
                    assert!(
                        surfaces < 3 || surfaces - 2 <= MOST_TIMES,
                        "{passage:?} from {from}, {toward}: {surfaces}"
                    );
                    // Near the edges it grows without bound.
                    let is_near = (spread - expected).abs() < 1e-3 * (1.0 + expected);
                    assert!(is_near || expected > 100.0, "{passage:?} from {from}, {toward}: {spread}, not {expected}");
                    checked += 1;
                }
                None => assert!(surfaces - 2 > MOST_TIMES, "{passage:?} from {from}, {toward}"),
            }
        }
    }
    assert!(checked > 1000, "{checked}");
}

/// Casters of which nothing is known but where they are.
fn casters() -> Casters {
    let list: Vec<Caster> = (0..40)
        .map(|index| {
            let center = DVec3::new(8.0 * dice(index, 0), dice(index, 1), 8.0 * dice(index, 2));
            let radius = 0.1 + 0.3 * dice(index, 3);
            let round = match index % 2 {
                0 => Round::Ball { center, radius },
                _ => Round::Cylinder { center, axis: direction(index, 4), half_length: 2.0 * radius, radius },
            };
            Caster { primitive: index, round, ior: (index % 5 != 0).then_some(IOR) }
        })
        .collect();
    Casters::new(list, |caster| shape(caster).bounds())
}

#[test]
fn casters_are_chosen_as_often_as_is_said() {
    let casters = casters();
    const TRIES: u32 = 1 << 14;
    for at in 0..6 {
        let point = DVec3::new(8.0 * dice(at, 20), 0.0, 8.0 * dice(at, 21));
        let receiver = Receiver { point, normal: DVec3::Y, passes: false };
        let light = direction(at, 22);
        let mut found = std::collections::HashMap::new();
        let pdf = [0.3, 1.0, 5.0][at as usize % 3];
        for index in 0..TRIES {
            let choice = Sampler::new(9, (3, 4), index).two(1, Purpose::Caster);
            if let Some((index, passage)) = casters.choose(&receiver, (light, pdf), choice) {
                *found.entry((index, passage as u32)).or_insert(0_u32) += 1;
            }
        }
        let (mut sum, mut all) = (0.0, 0.0);
        for index in 0..casters.list.len() as u32 {
            for passage in [Passage::Through, Passage::Back, Passage::Along] {
                let chance = worth(pdf) * casters.chance(&receiver, light, (index, passage));
                let found = f64::from(found.get(&(index, passage as u32)).copied().unwrap_or(0)) / f64::from(TRIES);
                // The numbers are better distributed than random ones.
                let error = (chance / f64::from(TRIES)).sqrt() + 2.0 / f64::from(TRIES);
                assert!((found - chance).abs() < 5.0 * error, "{at} {index} {passage:?}: {found}, not {chance}");
                sum += chance;
                all += found;
            }
        }
        // Some ways down the tree lead nowhere.
        assert!(sum > 0.1 * worth(pdf) && sum < worth(pdf) + 1e-9, "{sum}");
        assert!((all - sum).abs() < 0.01, "{sum} {all}");
    }
}
