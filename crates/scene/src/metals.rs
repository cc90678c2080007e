//! Metals that have been measured.

use durer_math::Rgb;

/// A metal by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MetalName {
    /// Al.
    Aluminum,
    /// Copper with zinc.
    Brass,
    /// Cr.
    Chromium,
    /// Cu.
    Copper,
    /// Au.
    Gold,
    /// Fe.
    Iron,
    /// Ni.
    Nickel,
    /// Pt.
    Platinum,
    /// Ag.
    Silver,
    /// Ti.
    Titanium,
}

impl MetalName {
    /// The complex index of refraction η + ik for red, green and blue: `[η, k]`.
    ///
    /// Aluminum, chromium, copper, gold and silver are spectra (Rakić, Palik, Johnson and Christy) seen by the eyes of the
    /// standard observer, in linear sRGB; the others are measured values (refractiveindex.info) at 650, 550 and 450 nm, nickel's at 642, 529 and
    /// 464 nm.
    pub fn index(self) -> [Rgb; 2] {
        let (eta, k) = match self {
            MetalName::Aluminum => ([1.657_46, 0.880_369, 0.521_229], [9.223_869, 6.269_523, 4.837_001]),
            MetalName::Brass => ([0.444, 0.527, 1.094], [3.695, 2.765, 1.829]),
            MetalName::Chromium => ([4.369_683, 2.916_713, 1.654_698], [5.206_434, 4.231_366, 3.754_947]),
            MetalName::Copper => ([0.200_438, 0.924_033, 1.102_212], [3.912_949, 2.452_848, 2.142_188]),
            MetalName::Gold => ([0.143_119, 0.374_957, 1.442_479], [3.983_16, 2.385_721, 1.603_215]),
            MetalName::Iron => ([2.911_4, 2.949_7, 2.584_5], [3.089_3, 2.931_8, 2.767]),
            MetalName::Nickel => ([1.994_12, 1.732_04, 1.645_42], [3.768_2, 3.131_6, 2.737_1]),
            MetalName::Platinum => ([2.375_7, 2.084_7, 1.845_3], [4.265_5, 3.715_3, 3.136_5]),
            MetalName::Silver => ([0.155_265, 0.116_723, 0.138_342], [4.828_37, 3.122_5, 2.147_037]),
            MetalName::Titanium => ([2.740_7, 2.541_8, 2.267], [3.814_3, 3.434_5, 3.038_5]),
        };
        [Rgb::from(eta), Rgb::from(k)]
    }

    /// What is mirrored at normal incidence: ((η-1)² + k²) / ((η+1)² + k²).
    pub fn reflectance(self) -> Rgb {
        let [eta, k] = self.index();
        reflectance(eta, k)
    }
}

/// What a metal of the complex index of refraction η + ik mirrors at normal incidence (Born and Wolf, §14.2).
pub fn reflectance(eta: Rgb, k: Rgb) -> Rgb {
    let (below, above) = (eta - Rgb::WHITE, eta + Rgb::WHITE);
    let (over, under) = (below * below + k * k, above * above + k * k);
    Rgb::new(over.r / under.r, over.g / under.g, over.b / under.b)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [MetalName; 10] = [
        MetalName::Aluminum,
        MetalName::Brass,
        MetalName::Chromium,
        MetalName::Copper,
        MetalName::Gold,
        MetalName::Iron,
        MetalName::Nickel,
        MetalName::Platinum,
        MetalName::Silver,
        MetalName::Titanium,
    ];

    #[test]
    fn metals_have_the_colors_that_they_have() {
        for metal in ALL {
            let Rgb { r, g, b } = metal.reflectance();
            assert!(r > 0.4 && r < 1.0 && g > 0.4 && b > 0.25, "{metal:?}: {r} {g} {b}");
        }
        let gold = MetalName::Gold.reflectance();
        assert!(gold.r > gold.g && gold.g > 2.0 * gold.b, "gold is yellow: {gold:?}");
        let silver = MetalName::Silver.reflectance();
        assert!(silver.min_component() > 0.9, "silver mirrors nearly all: {silver:?}");
        let aluminum = MetalName::Aluminum.reflectance();
        assert!((aluminum.g - 0.915).abs() < 0.01, "{aluminum:?}");
        // Without absorption it is a dielectric: ((n-1)/(n+1))².
        assert!((reflectance(Rgb::gray(1.5), Rgb::BLACK).g - 0.04).abs() < 1e-7);
    }
}
