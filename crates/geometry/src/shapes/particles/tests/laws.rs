//! The laws of single shapes, with single particles.

use super::*;

fn round(p: DVec3) -> f64 {
    p.length() - 1.0
}

#[test]
fn spheres_keep_them() {
    let sphere = One::Sphere(DVec3::ZERO, 1.0).set();
    let known = Known { shape: &sphere, levels: &[&round] };
    known.hits_obey_the_equation();
    known.crossings_match_sampling(&round, true, |_| true);
    known.leaves_and_enters_once(true);
    known.far_rays_are_precise(true);
}

/// Those of the single cone.
const RADII: [[f64; 2]; 7] =
    [[1.0, 0.0], [0.0, 1.0], [1.0, 0.5], [0.25, 1.0], [1.0, 1e-9], [1.0, 0.999_999_9], [1.0, 1.0]];

fn side(p: DVec3, radii: [f64; 2]) -> f64 {
    let slope = radii[1] - radii[0];
    ((p.x * p.x + p.z * p.z).sqrt() - radii[0] - slope * p.y) / (1.0 + slope * slope).sqrt()
}

const AXIS: [DVec3; 2] = [DVec3::ZERO, DVec3::Y];

fn each(check: impl Fn([f64; 2], &dyn Fn(DVec3) -> f64)) {
    for radii in RADII {
        let radii = radii.map(|radius| f64::from(radius as f32));
        check(radii, &|p| side(p, radii));
    }
}

#[test]
fn frusta_keep_them() {
    each(|radii, level| {
        let frustum = One::Frustum(AXIS, radii).set();
        let known = Known { shape: &frustum, levels: &[level, &|p| -p.y, &|p| p.y - 1.0] };
        known.hits_obey_the_equation();
        known.crossings_match_sampling(&|p| level(p).max(-p.y).max(p.y - 1.0), true, |_| true);
        known.leaves_and_enters_once(true);
        known.far_rays_are_precise(true);
    });
}

#[test]
fn open_frusta_keep_them() {
    each(|radii, level| {
        let tube = One::Tube(AXIS, radii).set();
        let known = Known { shape: &tube, levels: &[level] };
        known.hits_obey_the_equation();
        known.crossings_match_sampling(level, false, |p| p.y > 0.0 && p.y < 1.0);
    });
}

const RING: [(f64, f64); 7] = [(1., 0.), (0., 1.), (-1., 0.), (0., -1.), (0.6, 0.8), (-0.8, 0.6), (0.28, -0.96)];

#[test]
fn rims_and_tips_have_no_gap() {
    each(|radii, level| {
        let rim = |&(x, z): &(f64, f64)| [0, 1].map(|end| DVec3::new(x * radii[end], end as f64, z * radii[end]));
        let rims: Vec<_> = RING.iter().flat_map(rim).collect();
        let frustum = One::Frustum(AXIS, radii).set();
        let known = Known { shape: &frustum, levels: &[level, &|p| -p.y, &|p| p.y - 1.0] };
        known.rims_have_no_gap(&rims);
    });
}

fn capsule(p: DVec3, radius: f64) -> f64 {
    (p - DVec3::Y * p.y.clamp(0.0, 1.0)).length() - radius
}

#[test]
fn capsules_keep_them() {
    for radius in [0.75, 0.5, 1.0] {
        let level = |p: DVec3| capsule(p, radius);
        let capsule = One::Capsule(AXIS, radius).set();
        let known = Known { shape: &capsule, levels: &[&level] };
        known.hits_obey_the_equation();
        known.crossings_match_sampling(&level, true, |_| true);
        known.leaves_and_enters_once(true);
        known.far_rays_are_precise(true);
        let seams = |&(x, z): &(f64, f64)| [0.0, 1.0].map(|y| DVec3::new(x * radius, y, z * radius));
        known.rims_have_no_gap(&RING.iter().flat_map(seams).collect::<Vec<_>>());
    }
}

/// As the single cone, where the numbers are explained.
#[test]
fn cones_are_met_along_generator_and_axis() {
    let cone = |open: bool| if open { One::Tube(AXIS, [1.0, 0.0]) } else { One::Frustum(AXIS, [1.0, 0.0]) }.set();
    let hit = |open, origin, direction| {
        let crossing = cone(open).intersect(&Ray { origin, direction }, f64::INFINITY);
        crossing.map(|crossing| (crossing.t, crossing.part))
    };
    assert_eq!(hit(false, DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y), Some((2.0, 0)));
    assert_eq!(cone(false).surface(DVec3::Y, 0), (DVec3::Y, DVec3::Y));
    assert_eq!(hit(false, DVec3::new(0.0, -1.0, 0.0), DVec3::Y), Some((1.0, 1)));
    assert_eq!(hit(true, DVec3::new(0.0, -1.0, 0.0), DVec3::Y), Some((2.0, 0)));
    let along = DVec3::new(1.0, -1.0, 0.0);
    assert_eq!(hit(false, DVec3::new(-1.0, 1.0, 0.0), along), Some((0.5, 0)));
    assert_eq!(hit(false, DVec3::new(0.25, 0.5, 0.0), along), Some((0.5, 1)));
    assert_eq!(hit(true, DVec3::new(0.25, 0.5, 0.0), along), None);
    assert_eq!(hit(false, DVec3::new(-0.5, 1.5 + 1e-9, 0.0), along), None);
    assert_eq!(hit(false, DVec3::new(-3.0, 1.5, 0.0), DVec3::X), None);
    // In the side itself is outside.
    assert_eq!(hit(false, DVec3::new(0.0, 1.0, 0.0), along), None);
    assert_eq!(hit(false, DVec3::new(0.25, 0.75, 0.0), along), None);
}

#[test]
fn surfaces_have_the_nearest_points() {
    let mut random = Random(14);
    for kind in KINDS {
        for _ in 0..500 {
            let one = random.particle(kind, DVec3::ZERO, 1.0);
            let set = one.set();
            let ray = Ray { origin: one.center() + random.direction() * 9.0, direction: DVec3::ZERO };
            let ray = Ray { direction: one.center() - ray.origin, ..ray };
            let Some(crossing) = set.intersect(&ray, f64::INFINITY) else { continue };
            let (on, normal) = set.surface(ray.at(crossing.t), crossing.part);
            let off = on + normal * 1e-3;
            let (back, same) = set.surface(off, crossing.part);
            assert!((back - on).length() < 1e-14 && (same - normal).length() < 1e-12, "{one:?} {on} {back}");
        }
    }
}
