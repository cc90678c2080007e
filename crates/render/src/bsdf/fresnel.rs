//! Fresnel's equations: which part of unpolarized light a smooth boundary reflects.
//!
//! Born and Wolf, Principles of Optics, §1.5 and §14.2. Cosines are those of the angle to the normal, not negative; `eta`
//! is the index of refraction behind the boundary divided by that before it.

use durer_math::{Rgb, functions::ln};

/// What a dielectric boundary does with light that comes to it under one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Boundary {
    /// The part that is reflected; 1 where reflection is total.
    pub(crate) reflectance: f64,
    /// Cosine of the angle behind it; 0 where reflection is total.
    pub(crate) cos_behind: f64,
}

/// A boundary between dielectrics.
#[inline]
pub(crate) fn dielectric(cos: f64, eta: f64) -> Boundary {
    let cos = cos.min(1.0);
    let sin2_behind = (1.0 - cos * cos) / (eta * eta);
    if sin2_behind >= 1.0 {
        return Boundary { reflectance: 1.0, cos_behind: 0.0 };
    }
    let cos_behind = (1.0 - sin2_behind).sqrt();
    let (a, b) = (eta * cos, eta * cos_behind);
    let (parallel, perpendicular) = ((a - cos_behind) / (a + cos_behind), (cos - b) / (cos + b));
    Boundary { reflectance: 0.5 * (parallel * parallel + perpendicular * perpendicular), cos_behind }
}

/// The part of light from everywhere (of the same radiance) that a smooth dielectric boundary reflects.
///
/// For `eta` above 1 the closed form of Duntley (1942), as Egan and Hilgeman give it (Optical Properties of Inhomogeneous
/// Materials, 1979); the other side follows from it, since a white inside must stay white.
pub(crate) fn dielectric_average(eta: f64) -> f64 {
    if eta < 1.0 {
        return 1.0 - (1.0 - dielectric_average(1.0 / eta)) * eta * eta;
    }
    if eta < 1.0 + 1e-3 {
        // The closed form would divide rounding errors by next to nothing; there is next to nothing to reflect.
        return 0.0;
    }
    let n = eta;
    let (n2, n3) = (n * n, n * n * n);
    let n4 = n2 * n2;
    let (sum, difference) = (n2 + 1.0, n2 - 1.0);
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        + n2 * difference * difference / (sum * sum * sum) * ln((n - 1.0) / (n + 1.0))
        - 2.0 * n3 * (n2 + 2.0 * n - 1.0) / (sum * (n4 - 1.0))
        + 8.0 * n4 * (n4 + 1.0) / (sum * (n4 - 1.0) * (n4 - 1.0)) * ln(n)
}

/// A metal whose index of refraction, against what is before it, is `eta` + i `k`.
#[inline]
fn conductor_of(cos: f64, eta: f64, k: f64) -> f64 {
    let cos2 = cos * cos;
    let sin2 = 1.0 - cos2;
    let (eta2, k2) = (eta * eta, k * k);
    let t0 = eta2 - k2 - sin2;
    let a2_plus_b2 = (t0 * t0 + 4.0 * eta2 * k2).sqrt();
    let a = (0.5 * (a2_plus_b2 + t0)).max(0.0).sqrt();
    let (t1, t2) = (a2_plus_b2 + cos2, 2.0 * cos * a);
    let perpendicular = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (cos2 * a2_plus_b2 + sin2 * sin2, t2 * sin2);
    let parallel = perpendicular * (t3 - t4) / (t3 + t4);
    let reflectance = 0.5 * (perpendicular + parallel);
    // Nothing behind the boundary is like what is before it: 0/0.
    if reflectance.is_finite() { reflectance.clamp(0.0, 1.0) } else { 1.0 }
}

/// How a metal reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reflectance {
    /// By its index of refraction η + ik in red, green and blue.
    Complex { eta: Rgb, k: Rgb },
    /// By its colors at normal incidence and at grazing angles: Schlick, "An Inexpensive BRDF Model for Physically-based
    /// Rendering", 1994.
    Schlick { f0: Rgb, f90: Rgb },
}

impl Reflectance {
    /// At an angle with this cosine.
    #[inline]
    pub(crate) fn at(&self, cos: f64) -> Rgb {
        let cos = cos.clamp(0.0, 1.0);
        match self {
            Reflectance::Complex { eta, k } => {
                let of = |eta: f32, k: f32| conductor_of(cos, f64::from(eta), f64::from(k)) as f32;
                Rgb::new(of(eta.r, k.r), of(eta.g, k.g), of(eta.b, k.b))
            }
            Reflectance::Schlick { f0, f90 } => f0.lerp(*f90, schlick_weight(cos) as f32),
        }
    }

    /// The part of light from everywhere that is reflected: the mean, weighted by the cosine.
    pub(crate) fn average(&self) -> Rgb {
        match self {
            Reflectance::Complex { .. } => {
                // Gauss and Legendre's rule with four points, for 2 ∫ F(μ) μ dμ.
                const POINTS: [(f64, f64); 4] = [
                    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
                    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
                    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
                    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
                ];
                let part = |(cos, weight): (f64, f64)| self.at(cos) * ((2.0 * cos * weight) as f32);
                POINTS.into_iter().map(part).fold(Rgb::BLACK, |sum, part| sum + part)
            }
            Reflectance::Schlick { f0, f90 } => f0.lerp(*f90, 1.0 / 21.0),
        }
    }
}

/// How far Schlick's reflectance is on its way from normal incidence to grazing angles: (1 - cos)⁵.
#[inline]
pub(crate) fn schlick_weight(cos: f64) -> f64 {
    let m = 1.0 - cos.clamp(0.0, 1.0);
    let m2 = m * m;
    m2 * m2 * m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::materials::refract;
    use durer_math::{DVec3, functions::sin};

    /// 2 ∫ f(μ) μ dμ by many steps; squares of evenly spaced numbers see the grazing angles.
    fn average(f: impl Fn(f64) -> f64) -> f64 {
        let count = 20_000;
        let part = |i: i32| {
            let t = (f64::from(i) + 0.5) / f64::from(count);
            4.0 * t * t * t * f(t * t)
        };
        (0..count).map(part).sum::<f64>() / f64::from(count)
    }

    #[test]
    fn agrees_with_the_law_that_rays_follow() {
        for eta in [0.4, 0.75, 1.0, 1.33, 1.5, 2.4] {
            for i in 1..=50 {
                let cos = f64::from(i) / 50.0;
                let direction = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, -cos);
                let found = dielectric(cos, eta);
                match refract(direction, DVec3::Z, 1.0 / eta) {
                    Some(refracted) => {
                        assert!((refracted.reflectance - found.reflectance).abs() < 1e-12);
                        assert!((refracted.direction.z + found.cos_behind).abs() < 1e-12);
                    }
                    None => assert_eq!(found, Boundary { reflectance: 1.0, cos_behind: 0.0 }),
                }
            }
        }
    }

    #[test]
    fn averages_are_what_summing_gives() {
        for eta in [0.42, 0.66, 0.9, 1.01, 1.1, 1.33, 1.5, 2.0, 2.4, 4.0] {
            let (closed, summed) = (dielectric_average(eta), average(|cos| dielectric(cos, eta).reflectance));
            assert!((closed - summed).abs() < 2e-5, "{eta}: {closed}, not {summed}");
        }
        let metals = [
            Reflectance::Complex { eta: Rgb::new(0.2, 1.2, 3.0), k: Rgb::new(3.9, 2.5, 1.0) },
            Reflectance::Schlick { f0: Rgb::new(0.04, 0.5, 0.9), f90: Rgb::new(1.0, 0.7, 1.0) },
        ];
        for metal in metals {
            let closed = metal.average().to_array();
            for (channel, closed) in closed.into_iter().enumerate() {
                let summed = average(|cos| f64::from(metal.at(cos).to_array()[channel]));
                assert!((f64::from(closed) - summed).abs() < 2e-3, "{closed}, not {summed}");
            }
        }
    }

    /// Without absorption a conductor is a dielectric; and at normal incidence it is ((η-1)² + k²) / ((η+1)² + k²).
    #[test]
    fn metals_become_glass_without_absorption() {
        for degrees in 0..90 {
            let cos = sin(f64::from(90 - degrees).to_radians());
            let (metal, glass) = (conductor_of(cos, 1.5, 0.0), dielectric(cos, 1.5).reflectance);
            assert!((metal - glass).abs() < 1e-12, "{degrees}°: {metal}, not {glass}");
        }
        let (eta, k) = (0.27, 3.4);
        let expected = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
        assert!((conductor_of(1.0, eta, k) - expected).abs() < 1e-12);
        assert!((conductor_of(0.0, eta, k) - 1.0).abs() < 1e-12);
    }
}
