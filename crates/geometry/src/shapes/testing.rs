//! Laws that every shape must keep, tried with thousands of random rays, many of them in symmetric and degenerate
//! positions. Each shape's own tests give its equation, written independently, and call what applies.

use super::Shape;
use crate::{Crossing, Ray};
use durer_math::DVec3;
use durer_math::functions::pow;

/// A number generator for tests (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform in [low, high).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A power of ten with uniform exponent.
    pub(crate) fn power(&mut self, low: f64, high: f64) -> f64 {
        f64::from(pow(10.0, self.between(low, high) as f32))
    }

    /// Uniform in the cube from -1 to 1.
    pub(crate) fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.in_cube();
            if v.length_squared() > 0.01 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }

    /// Small whole numbers, halved: origins and directions in symmetric positions.
    fn lattice(&mut self) -> DVec3 {
        ((self.in_cube() * 3.0).round()) * 0.5
    }

    /// A ray in the neighborhood of the origin; one in three on the lattice or parallel to a coordinate plane.
    pub(crate) fn ray(&mut self) -> Ray {
        let origin = self.in_cube() * 3.0;
        let direction = (self.in_cube() - origin).normalize();
        let (o, d) = (self.lattice(), self.lattice());
        match self.between(0.0, 9.0) as u32 {
            0 if d != DVec3::ZERO => Ray { origin: o, direction: d },
            1 => Ray { origin: o, direction },
            2 => Ray { origin, direction: DVec3::new(direction.x, 0.0, direction.z) },
            _ => Ray { origin, direction },
        }
    }
}

/// A function that is zero on a surface and grows outwards about as fast as the distance.
pub(super) type Level<'a> = &'a dyn Fn(DVec3) -> f64;

/// A shape and what is known of it: one level for each part.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub(super) shape: &'a dyn Shape,
    pub(super) levels: &'a [Level<'a>],
}

impl Known<'_> {
    /// Below 0 inside, if the shape is the intersection of what is inside its parts.
    fn depth(&self, p: DVec3) -> f64 {
        self.levels.iter().map(|level| level(p)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far to move a point off the surface: as little as the contract allows.
    fn offset(&self) -> f64 {
        self.shape.rounding(0) * 1.01 + f64::EPSILON
    }

    fn hit(&self, ray: &Ray) -> Option<Crossing> {
        let hit = self.shape.intersect(ray, f64::INFINITY);
        if let Some(c) = hit {
            assert!(c.t > 0.0 && c.t.is_finite() && (c.part as usize) < self.levels.len(), "{c:?} of {ray:?}");
        }
        hit
    }

    /// Each hit lies on its part, can be snapped, has the outward normal, is found only if `t_max` allows, and does
    /// not depend on the length of the direction.
    pub(super) fn hits_obey_the_equation(&self) {
        let mut random = Random(1);
        let mut hits = 0;
        for _ in 0..30_000 {
            let ray = random.ray();
            let Some(hit) = self.hit(&ray) else { continue };
            hits += 1;
            let level = self.levels[hit.part as usize];
            let p = ray.at(hit.t);
            let tolerance = if at_a_tip(p) { 1e-7 } else { 1e-13 };
            assert!(level(p).abs() < tolerance, "{hit:?} of {ray:?} is off by {}", level(p));
            let (snapped, normal) = self.shape.surface(p, hit.part);
            assert!((snapped - p).length() < tolerance && level(snapped).abs() < 1e-15, "{hit:?} of {ray:?}");
            let cosine = normal.normalize().dot(gradient(level, snapped));
            assert!(cosine > 0.999_999 || at_a_tip(snapped), "normal of {hit:?} of {ray:?}: cosine {cosine}");
            assert_eq!(self.shape.intersect(&ray, hit.t), None);
            assert_eq!(self.shape.intersect(&ray, hit.t * 1.000_001), Some(hit));
            self.does_not_depend_on_length(&ray, hit);
        }
        assert!(hits > 200, "the test must test something: {hits}");
    }

    fn does_not_depend_on_length(&self, ray: &Ray, hit: Crossing) {
        // By powers of two, not a bit may change. Others may round a ray past an edge that it was aimed at.
        for scale in [1.0 / f64::from(1 << 27), 0.5, f64::from(1 << 27)] {
            let scaled = Ray { origin: ray.origin, direction: ray.direction * scale };
            assert_eq!(self.hit(&scaled), Some(Crossing { t: hit.t / scale, part: hit.part }), "{ray:?} by {scale}");
        }
        let on_lattice = ray.origin == (ray.origin * 2.0).round() * 0.5;
        for scale in [1e-8, 1e-3, 3.0, 1e8] {
            let scaled = Ray { origin: ray.origin, direction: ray.direction * scale };
            let t = self.hit(&scaled).map(|c| c.t * scale);
            assert!(on_lattice || t.is_some_and(|t| (t - hit.t).abs() <= 1e-9 * (1.0 + hit.t)), "{ray:?} by {scale}");
        }
    }

    /// The crossings along random rays, each found from the one before, are the sign changes of `depth` (negative
    /// inside) along the ray; between them the shape contains what it should. For a sheet, `counts` says which sign
    /// changes are on it.
    pub(super) fn crossings_match_sampling(&self, depth: Level<'_>, closed: bool, counts: impl Fn(DVec3) -> bool) {
        let mut random = Random(2);
        let mut compared = 0;
        for _ in 0..2_000 {
            let mut ray = random.ray();
            ray.direction = ray.direction.normalize();
            let Some(mut expected) = sampled_crossings(depth, &ray) else { continue };
            if closed {
                for pair in expected.windows(2) {
                    let p = ray.at(0.5 * (pair[0] + pair[1]));
                    assert_eq!(self.shape.contains(p), depth(p) < 0.0, "contains {p}");
                }
            }
            let at_an_edge = |p: DVec3| {
                let on_parts = self.levels.iter().filter(|level| level(p).abs() < 1e-9).count();
                on_parts > 1 || OCTANTS.iter().any(|&step| counts(p + step * 1e-6) != counts(p - OCTANTS[0] * 1e-6))
            };
            if expected.iter().any(|&t| at_an_edge(ray.at(t))) {
                continue;
            }
            expected.retain(|&t| counts(ray.at(t)));
            let mut found = self.all_crossings(&ray);
            found.retain(|&t| t < SAMPLED_LENGTH);
            let agree = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
            assert!(
                found.len() == expected.len() && found.iter().zip(&expected).all(agree),
                "{ray:?}: found {found:?}, sampled {expected:?}"
            );
            compared += found.len();
        }
        assert!(compared > 20, "the test must test something: {compared}");
    }

    /// All crossings in order, each sought from the one before moved off the surface to where the ray goes.
    fn all_crossings(&self, ray: &Ray) -> Vec<f64> {
        let mut found = Vec::new();
        let mut rest = *ray;
        while let Some(hit) = self.hit(&rest) {
            let (p, normal) = self.shape.surface(rest.at(hit.t), hit.part);
            let normal = normal.normalize();
            let side = if rest.direction.dot(normal) > 0.0 { 1.0 } else { -1.0 };
            found.push((p - ray.origin).dot(ray.direction));
            rest.origin = p + normal * (side * self.offset());
            assert!(found.len() < 20, "{ray:?} goes on and on");
        }
        found
    }

    /// `crossings` finds the crossings that `intersect` finds one after the other, the first of them bit for bit, and
    /// says rightly whether the ray starts inside. A ray that but touches may see two crossings or none.
    pub(super) fn crossings_are_those_found_one_by_one(&self) {
        let mut random = Random(6);
        let mut compared = 0;
        for i in 0..30_000 {
            let mut ray = random.ray();
            ray.direction = ray.direction.normalize();
            if i % 10 == 0 {
                ray.origin -= ray.direction * random.power(1.0, 4.0);
            }
            let mut all = Vec::new();
            let starts_inside = self.shape.crossings(&ray, &mut |crossing| all.push(crossing));
            all.sort_by(|a, b| a.t.total_cmp(&b.t));
            let starts_on_it = self.depth(ray.origin).abs() < 1e-12;
            if starts_on_it || self.hit(&ray).is_some_and(|hit| self.touches(&ray, hit)) {
                continue;
            }
            assert_eq!(all.first().copied(), self.hit(&ray), "{ray:?}");
            let one_by_one = self.all_crossings(&ray);
            if all.iter().any(|&hit| self.touches(&ray, hit)) {
                continue;
            }
            let tolerance = 1e-9 * (1.0 + ray.origin.length());
            let same = all.iter().zip(&one_by_one).all(|(hit, t)| (hit.t - t).abs() < tolerance);
            assert!(same && all.len() == one_by_one.len(), "{ray:?}: {all:?}, one by one {one_by_one:?}");
            assert_eq!(starts_inside, self.shape.contains(ray.origin), "{ray:?}");
            compared += all.len();
        }
        assert!(compared > 2_000, "the test must test something: {compared}");
    }

    /// True for a hit at so shallow an angle, or so near an edge, that rounding decides what is met there.
    fn touches(&self, ray: &Ray, hit: Crossing) -> bool {
        let p = ray.at(hit.t);
        let (_, normal) = self.shape.surface(p, hit.part);
        let on_parts = self.levels.iter().filter(|level| level(p).abs() < 1e-9).count();
        normal.dot(ray.direction).abs() < 1e-4 || on_parts > 1 || at_a_tip(p)
    }

    /// A ray that leaves a convex shape, however shallow its angle, does not hit it again; one that goes in comes out
    /// exactly once.
    pub(super) fn leaves_and_enters_once(&self, closed: bool) {
        let mut random = Random(3);
        for _ in 0..20_000 {
            let ray = random.ray();
            let Some(hit) = self.hit(&ray) else { continue };
            let (p, normal) = self.shape.surface(ray.at(hit.t), hit.part);
            let normal = normal.normalize();
            let away = normal * if random.between(0.0, 1.0) < 0.5 && !closed { -1.0 } else { 1.0 };
            for cosine in [random.power(-9.0, 0.0), random.between(0.0, 1.0), 1e-9, 1.0] {
                let direction = tilted(away, cosine, &mut random);
                let out = Ray { origin: p + away * self.offset(), direction };
                assert_eq!(self.hit(&out), None, "leaves at {p} (cosine {cosine}), hit by {ray:?} on {hit:?}");
                let inside = p - normal * self.offset();
                if closed && self.depth(inside) < 0.0 {
                    let inwards = Ray { origin: inside, direction: -direction };
                    let times = self.all_crossings(&inwards).len();
                    assert_eq!(times, 1, "enters at {p} (cosine {cosine}), hit by {ray:?} on {hit:?}");
                }
            }
        }
    }

    /// From far away, rays to points inside hit, where rays from near do; rays past a convex shape miss.
    pub(super) fn far_rays_are_precise(&self, convex: bool) {
        let mut random = Random(4);
        let mut hits = 0;
        for _ in 0..20_000 {
            let (target, direction) = (random.in_cube() * 1.2, random.direction());
            if self.depth(target) > -1e-3 {
                continue;
            }
            let near = Ray { origin: target - direction * 6.0, direction };
            let Some(first) = self.hit(&near) else { panic!("{near:?} misses") };
            let (p, normal) = self.shape.surface(near.at(first.t), first.part);
            let normal = normal.normalize();
            for distance in [1e6, 1e8] {
                // The rounding of an origin this far away.
                let noise = distance * 4e-16;
                let far = Ray { origin: p - direction * distance, direction };
                let hit = self.hit(&far).unwrap_or_else(|| panic!("{far:?} misses {p}"));
                let off = self.levels[hit.part as usize](far.at(hit.t));
                assert!(off.abs() < 4.0 * noise, "{far:?} is off by {off}");
                if normal.dot(direction) < -0.1 {
                    assert!((far.at(hit.t) - p).length() < 40.0 * noise, "{far:?}");
                    hits += 1;
                }
                let past = tilted(normal, 0.0, &mut random);
                let origin = p + normal * (4.0 * noise) - past * distance;
                assert!(!convex || self.hit(&Ray { origin, direction: past }).is_none(), "{past} passes {p}");
            }
        }
        assert!(hits > 200, "the test must test something: {hits}");
    }

    /// Rays aimed exactly at points of a rim, and going on inside, hit: there is no gap between parts.
    pub(super) fn rims_have_no_gap(&self, rim: &[DVec3]) {
        let mut random = Random(5);
        let inner = [DVec3::new(0.0, 0.5, 0.0), DVec3::new(0.0, 0.25, 0.0), DVec3::new(0.125, 0.5, -0.125)];
        for &p in rim {
            for i in 0..200 {
                let target = *inner.get(i).unwrap_or(&(inner[2] + random.in_cube() * 0.1));
                for distance in [1.0, 2.0, 3.0, random.power(0.0, 2.0)] {
                    let direction = target - p;
                    for direction in [direction, direction.normalize()] {
                        let ray = Ray { origin: p - direction * distance, direction };
                        let hit = self.hit(&ray).unwrap_or_else(|| panic!("{ray:?} through {p} misses"));
                        let miss = (ray.at(hit.t) - p).length();
                        assert!(miss < 1e-12 * (1.0 + distance), "{ray:?} meets {}", ray.at(hit.t));
                    }
                }
            }
        }
    }
}

const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

/// A direction in each octant.
const OCTANTS: [DVec3; 8] = {
    let (x, y, z) = (1.0, 0.7, 0.4);
    [
        DVec3::new(x, y, z),
        DVec3::new(-x, y, z),
        DVec3::new(x, -y, z),
        DVec3::new(-x, -y, z),
        DVec3::new(x, y, -z),
        DVec3::new(-x, y, -z),
        DVec3::new(x, -y, -z),
        DVec3::new(-x, -y, -z),
    ]
};

const SAMPLED_LENGTH: f64 = 8.0;

/// At the tip of a cone, where the surface has no tangent plane, and hits by rays along the side are known less well.
fn at_a_tip(p: DVec3) -> bool {
    p.x.abs() < 1e-5 && p.z.abs() < 1e-5
}

/// A unit vector at a given cosine to `normal`.
fn tilted(normal: DVec3, cosine: f64, random: &mut Random) -> DVec3 {
    let v = random.direction();
    let tangent = (v - normal * v.dot(normal)).normalize();
    normal * cosine + tangent * (1.0 - cosine * cosine).sqrt()
}

fn gradient(level: Level<'_>, p: DVec3) -> DVec3 {
    let h = 1e-6;
    let along = |axis: DVec3| level(p + axis * h) - level(p - axis * h);
    DVec3::from(AXES.map(along)).normalize()
}

/// Where `depth` changes sign on the first [`SAMPLED_LENGTH`] of a ray of unit direction; `None` if it comes so near to zero
/// without crossing, or starts so near to it, that sampling cannot tell.
fn sampled_crossings(depth: Level<'_>, ray: &Ray) -> Option<Vec<f64>> {
    const STEP: f64 = SAMPLED_LENGTH / 2_000.0;
    let samples: Vec<f64> = (0..=2_000).map(|i| depth(ray.at(f64::from(i) * STEP))).collect();
    let mut crossings = Vec::new();
    if samples[0].abs() < 2.0 * STEP {
        return None;
    }
    for i in 1..samples.len() {
        let (before, here) = (samples[i - 1], samples[i]);
        let after = *samples.get(i + 1).unwrap_or(&here);
        let turns = here.abs() <= before.abs() && here.abs() <= after.abs();
        if turns && (before < 0.0) == (here < 0.0) && (here < 0.0) == (after < 0.0) && here.abs() < 2.0 * STEP {
            return None;
        }
        if (before < 0.0) != (here < 0.0) {
            crossings.push(bisected(depth, ray, (i - 1) as f64 * STEP, i as f64 * STEP));
        }
    }
    Some(crossings)
}

fn bisected(depth: Level<'_>, ray: &Ray, mut low: f64, mut high: f64) -> f64 {
    let low_inside = depth(ray.at(low)) < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (depth(ray.at(middle)) < 0.0) == low_inside {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
