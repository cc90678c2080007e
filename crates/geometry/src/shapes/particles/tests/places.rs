//! Where particles are kept, and odd ones.

use super::*;

#[test]
fn that_single_precision_holds_are_kept() {
    let mut random = Random(91);
    let set = set(SimdLevel::best(), &random.particles(0, 10));
    assert_eq!(set.origin(), DVec3::ZERO);
}

#[test]
fn far_from_the_origin_are_kept_relative_to_their_middle() {
    let far = DVec3::new(1e7 + 0.1, -3e7, 2e7);
    let mut random = Random(92);
    let centers: Vec<DVec3> = (0..200).map(|_| far + random.in_cube()).collect();
    let set = Particles::spheres(200, Plan::default(), |index| (centers[index], 0.25));
    assert!((set.origin() - far).length() < 0.5);
    let world = World::build(vec![Primitive::particles(Arc::new(set), &DAffine3::IDENTITY)], Plan::default());
    for center in centers {
        let ray = Ray { origin: center + DVec3::Y * 3.0, direction: DVec3::NEG_Y };
        let hit = world.closest_hit(&ray, f64::INFINITY, u32::MAX, None).expect("a sphere");
        assert!(hit.crossing.t < 2.75 + 1e-7, "{hit:?}");
    }
}

#[test]
fn axes_without_a_length_leave_nothing_or_a_ball() {
    let ends = [DVec3::new(1.0, 0.5, 0.25); 2];
    let mut random = Random(93);
    let gone = Particles::frusta(5, false, Plan::default(), |_| (ends, [0.5, 0.25]));
    let ball = One::Capsule(ends, 0.5).set();
    let sphere = One::Sphere(ends[0], 0.5).set();
    for _ in 0..2000 {
        let ray = random.ray();
        assert_eq!(gone.intersect(&ray, f64::INFINITY), None);
        let (a, b) = (ball.intersect(&ray, f64::INFINITY), sphere.intersect(&ray, f64::INFINITY));
        assert_eq!(a.map(|crossing| crossing.part), b.map(|crossing| crossing.part));
        if let (Some(a), Some(b)) = (a, b) {
            assert!((a.t - b.t).abs() < 1e-14);
            let (p, q) = (ball.surface(ray.at(a.t), a.part), sphere.surface(ray.at(b.t), b.part));
            assert!((p.0 - q.0).length() < 1e-7 && (p.1 - q.1).length() < 1e-6);
            assert!((ball.uv(p.0, 0) - sphere.uv(p.0, 0)).length() < 1e-12);
        }
    }
    assert!(!gone.contains(ends[0]) && ball.contains(ends[0]));
}

#[test]
fn no_particles_are_nowhere() {
    let none = Particles::spheres(0, Plan::default(), |_| (DVec3::ZERO, 1.0));
    let ray = Ray { origin: DVec3::ZERO, direction: DVec3::X };
    assert!(none.intersect(&ray, f64::INFINITY).is_none() && !none.meets(&ray, 1.0) && !none.contains(DVec3::ZERO));
    assert!(none.bounds().is_empty());
    let world = World::build(vec![Primitive::particles(Arc::new(none), &DAffine3::IDENTITY)], Plan::default());
    assert_eq!(world.closest_hit(&ray, f64::INFINITY, u32::MAX, None), None);
}

#[test]
fn on_a_capsule_have_coordinates_from_pole_to_pole() {
    let capsule = One::Capsule([DVec3::ZERO, DVec3::Y * 2.0], 0.5).set();
    let at = |x, y, z| capsule.uv(DVec3::new(x, y, z), 0);
    let half_ball = 0.25 * std::f64::consts::PI;
    let whole = 2.0 + 2.0 * half_ball;
    assert_eq!((at(0.0, -0.5, 0.0).y, at(0.0, 2.5, 0.0).y), (0.0, 1.0));
    assert!((at(0.5, 0.0, 0.0) - DVec2::new(0.5, half_ball / whole)).length() < 1e-15);
    assert!((at(0.0, 1.0, -0.5) - DVec2::new(0.25, 0.5)).length() < 1e-15);
    let slant = 0.5 * 0.5_f64.sqrt();
    assert!((at(0.0, -slant, slant) - DVec2::new(0.75, half_ball / (2.0 * whole))).length() < 1e-14);
}
