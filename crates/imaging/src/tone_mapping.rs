//! Tone mapping: how much more light than a screen can show becomes what it can show. It stands between the film, which is
//! linear and without bounds, and the transfer curve of 8- and 16-bit files.

use durer_math::Rgb;
use durer_math::functions::{ln, pow};

/// How light of any amount becomes light that a screen can show, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMapping {
    /// As it is; what is brighter than white becomes white.
    #[default]
    None,
    /// L / (1 + L) on the luminance, with hue kept: Reinhard et al., "Photographic Tone Reproduction for Digital Images",
    /// SIGGRAPH 2002, equation 3. Colors whose strongest component is then still above 1 are cut off there.
    Reinhard,
    /// The film look of ACES, the reference rendering transform and the transform for sRGB screens as one: the fit by
    /// Stephen Hill (2016). Without the factor 1/0.6 that some programs put before it: add 0.737 stops for their brightness.
    Aces,
    /// AgX by Troy Sobotka (2022), the base look, with the polynomial of degree 6 that Benjamin Wrensch fitted to its curve
    /// ("Minimal AgX Implementation", 2023). Bright saturated colors go to white.
    Agx,
    /// Khronos PBR Neutral (2024): base colors come out as they are under a white light of 1, only highlights are
    /// compressed.
    PbrNeutral,
}

/// Brighter than any light in a picture, and small enough for single precision to square it.
const BRIGHTEST: f32 = 1e9;

impl ToneMapping {
    /// All of them.
    pub const ALL: [ToneMapping; 5] =
        [ToneMapping::None, ToneMapping::Reinhard, ToneMapping::Aces, ToneMapping::Agx, ToneMapping::PbrNeutral];

    /// Its name: `pbr_neutral`.
    pub fn word(self) -> &'static str {
        match self {
            ToneMapping::None => "none",
            ToneMapping::Reinhard => "reinhard",
            ToneMapping::Aces => "aces",
            ToneMapping::Agx => "agx",
            ToneMapping::PbrNeutral => "pbr_neutral",
        }
    }

    /// What a screen shows of a color in linear light that is first made brighter by `exposure` stops, a factor of two
    /// each. The result is linear light, too, of the primaries of sRGB; from 0 to 1, but for [`ToneMapping::None`], which
    /// bounds nothing. Without exposure that one gives every color back to the last bit. For the others, what is negative or
    /// not a number counts as no light.
    pub fn apply(self, color: Rgb, exposure: f32) -> Rgb {
        Developer::new(self, exposure).develop(color)
    }
}

/// [`ToneMapping::apply`] for many colors of one exposure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Developer {
    tone_mapping: ToneMapping,
    /// `None` for no change.
    factor: Option<f32>,
}

impl Developer {
    pub(crate) fn new(tone_mapping: ToneMapping, exposure: f32) -> Developer {
        Developer { tone_mapping, factor: (exposure != 0.0).then(|| pow(2.0, exposure)) }
    }

    /// True if all colors stay what they are.
    pub(crate) fn is_identity(&self) -> bool {
        self.tone_mapping == ToneMapping::None && self.factor.is_none()
    }

    pub(crate) fn develop(&self, color: Rgb) -> Rgb {
        let color = self.factor.map_or(color, |factor| color * factor);
        let light = || color.map(|c| if c > 0.0 { c.min(BRIGHTEST) } else { 0.0 });
        match self.tone_mapping {
            ToneMapping::None => color,
            ToneMapping::Reinhard => reinhard(light()),
            ToneMapping::Aces => aces(light()),
            ToneMapping::Agx => agx(light()),
            ToneMapping::PbrNeutral => pbr_neutral(light()),
        }
    }
}

fn clamped(color: Rgb) -> Rgb {
    color.map(|c| c.clamp(0.0, 1.0))
}

/// A matrix, by its rows, times a color.
fn times(rows: &[[f32; 3]; 3], color: Rgb) -> Rgb {
    let row = |[a, b, c]: [f32; 3]| a * color.r + b * color.g + c * color.b;
    Rgb::new(row(rows[0]), row(rows[1]), row(rows[2]))
}

fn reinhard(color: Rgb) -> Rgb {
    clamped(color * (1.0 / (1.0 + color.luminance())))
}

/// From linear sRGB to the working space of the rendering transform, with its desaturation.
const ACES_FROM_SRGB: [[f32; 3]; 3] =
    [[0.597_19, 0.354_58, 0.048_23], [0.076_00, 0.908_34, 0.015_66], [0.028_40, 0.133_83, 0.837_77]];

/// ... and back from the space of the screen transform, with its own.
const SRGB_FROM_ACES: [[f32; 3]; 3] =
    [[1.604_75, -0.531_08, -0.073_67], [-0.102_08, 1.108_13, -0.006_05], [-0.003_27, -0.072_76, 1.076_02]];

fn aces(color: Rgb) -> Rgb {
    let curve = |v: f32| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081);
    clamped(times(&SRGB_FROM_ACES, times(&ACES_FROM_SRGB, color).map(curve)))
}

/// Moves the primaries inward, so that bright saturated light has somewhere to go.
const AGX_INSET: [[f32; 3]; 3] = [
    [0.842_479_06, 0.078_433_6, 0.079_223_745],
    [0.042_328_242, 0.878_468_64, 0.079_166_13],
    [0.042_375_655, 0.078_433_6, 0.879_143],
];

/// Its inverse.
const AGX_OUTSET: [[f32; 3]; 3] = [
    [1.196_879, -0.098_020_88, -0.099_029_74],
    [-0.052_896_85, 1.151_903_1, -0.098_961_18],
    [-0.052_971_635, -0.098_043_45, 1.151_073_7],
];

/// What AgX shows: from 10 stops below middle gray, 0.18, to 6.5 above it, as powers of two.
const AGX_STOPS: (f64, f64) = (-12.473_93, 4.026_069);

fn agx(color: Rgb) -> Rgb {
    let (least, most) = AGX_STOPS;
    let logarithm = |v: f32| {
        // The least is where the polynomial begins; no logarithm of 0 is needed.
        let stops = if v > 1e-10 { ln(f64::from(v)) * std::f64::consts::LOG2_E } else { least };
        ((stops.clamp(least, most) - least) / (most - least)) as f32
    };
    let curve = |x: f32| {
        let coefficients = [15.5, -40.14, 31.96, -6.868, 0.429_8, 0.119_1, -0.002_32];
        coefficients.iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
    };
    let shown = times(&AGX_OUTSET, times(&AGX_INSET, color).map(|v| curve(logarithm(v))));
    // The curve gives what is sent to a screen of gamma 2.2; the screen's light is its power.
    clamped(shown).map(|v| pow(v, 2.2))
}

/// By the reference implementation in the specification of the Khronos Group.
fn pbr_neutral(color: Rgb) -> Rgb {
    /// Reflectance of dielectrics head on, which white light adds to each base color.
    const F90_OFFSET: f32 = 0.04;
    const START_COMPRESSION: f32 = 0.8 - F90_OFFSET;
    const DESATURATION: f32 = 0.15;
    let least = color.min_component();
    let offset = if least < 0.08 { least - 6.25 * least * least } else { F90_OFFSET };
    let color = color - Rgb::gray(offset);
    let peak = color.max_component();
    if peak < START_COMPRESSION {
        return color;
    }
    let room = 1.0 - START_COMPRESSION;
    let new_peak = 1.0 - room * room / (peak + room - START_COMPRESSION);
    let whiteness = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    clamped((color * (new_peak / peak)).lerp(Rgb::gray(new_peak), whiteness))
}

#[cfg(test)]
mod tests {
    use super::*;
    use durer_math::functions::pow_wide;

    const MAPPED: [ToneMapping; 4] =
        [ToneMapping::Reinhard, ToneMapping::Aces, ToneMapping::Agx, ToneMapping::PbrNeutral];

    fn assert_near(a: Rgb, b: [f32; 3], tolerance: f32) {
        let off = (a - Rgb::from(b)).map(f32::abs).max_component();
        assert!(off <= tolerance, "{a:?} is not {b:?}");
    }

    /// Grays from 2⁻²⁰ to 2²⁰.
    fn ramp() -> impl Iterator<Item = f32> {
        (-400..=400).map(|i| pow(2.0, i as f32 / 20.0))
    }

    #[test]
    fn none_without_exposure_keeps_every_bit() {
        for v in [0.0, -0.0, -3.5, 1e-42, 0.18, 1.0, 7e30, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            let shown = ToneMapping::None.apply(Rgb::new(v, 0.5, v), 0.0);
            assert_eq!((shown.r.to_bits(), shown.g, shown.b.to_bits()), (v.to_bits(), 0.5, v.to_bits()));
        }
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        let color = Rgb::new(0.1, 0.25, 3.0);
        assert_eq!(ToneMapping::None.apply(color, 1.0), color * 2.0);
        assert_eq!(ToneMapping::None.apply(color, -3.0), color * 0.125);
        for mapping in MAPPED {
            assert_eq!(mapping.apply(color, 2.0), mapping.apply(color * 4.0, 0.0), "{mapping:?}");
        }
    }

    #[test]
    fn known_values() {
        assert_near(ToneMapping::Reinhard.apply(Rgb::gray(3.0), 0.0), [0.75; 3], 1e-6);
        let (red, luminance) = (Rgb::new(2.0, 0.0, 0.0), 0.4252);
        assert_near(ToneMapping::Reinhard.apply(red, 0.0), [1.0_f32.min(2.0 / (1.0 + luminance)), 0.0, 0.0], 1e-6);
        // The fit's rational function by hand: of 0.18, (0.18 · 0.2045786 - 0.000090537) / 0.34788500.
        assert_near(ToneMapping::Aces.apply(Rgb::gray(0.18), 0.0), [0.105_591; 3], 2e-5);
        assert_near(ToneMapping::Aces.apply(Rgb::gray(1.0), 0.0), [0.619_13; 3], 3e-5);
        // By the specification: above the start of compression, 1 - 0.24² / (peak + 0.24 - 0.76).
        let peak = 1.0 - 0.24 * 0.24 / (0.96 + 0.24 - 0.76);
        assert_near(ToneMapping::PbrNeutral.apply(Rgb::WHITE, 0.0), [peak; 3], 1e-6);
    }

    /// Of the curve as Sobotka's own program computes it: two powers of a line, which meet in middle gray with a slope of 2.
    /// The mean square of the fit is 3.7·10⁻⁶, says its author; the matrices, which turn gray a little, add some.
    #[test]
    fn agx_is_near_the_curve_that_its_polynomial_was_fitted_to() {
        let power = |base: f64, exponent: f64| f64::from(pow_wide(base, exponent as f32));
        let (pivot, middle, slope) = (10.0 / 16.5, 0.5, 2.0);
        let scale = |width: f64, height: f64, bend: f64| {
            power(power(slope * width, -bend) * (power(slope * width / height, bend) - 1.0), -1.0 / bend)
        };
        let curve = |x: f64| {
            let (scale, bend) = match x >= pivot {
                true => (scale(1.0 - pivot, 1.0 - middle, 3.25), 3.25),
                false => (-scale(pivot, middle, 3.0), 3.0),
            };
            let along = slope * (x - pivot) / scale;
            scale * along / power(1.0 + power(along, bend), 1.0 / bend) + middle
        };
        let mut squares = Vec::new();
        for gray in ramp() {
            let shown = f64::from(ToneMapping::Agx.apply(Rgb::gray(gray), 0.0).g);
            let (least, most) = AGX_STOPS;
            let x = (ln(f64::from(gray)) / std::f64::consts::LN_2 - least) / (most - least);
            let off = power(shown, 1.0 / 2.2) - curve(x.clamp(0.0, 1.0));
            assert!(off.abs() < 0.008, "{gray}: {off}");
            if (0.0..=1.0).contains(&x) {
                squares.push(off * off);
            }
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        assert!(mean < 8e-6, "{mean:e}");
    }

    #[test]
    fn more_light_is_never_darker_and_never_above_white() {
        for mapping in MAPPED {
            let mut before = 0.0;
            for gray in ramp() {
                let shown = mapping.apply(Rgb::gray(gray), 0.0).g;
                assert!(shown >= before - 2e-7 && shown <= 1.0, "{mapping:?} of {gray}: {shown} after {before}");
                before = shown;
            }
            assert!(before > 0.98, "{mapping:?}: the brightest is {before}");
            assert!(mapping.apply(Rgb::BLACK, 0.0).max_component() < 1e-6, "{mapping:?}");
        }
    }

    #[test]
    fn gray_stays_gray() {
        for mapping in MAPPED {
            for gray in ramp() {
                let Rgb { r, g, b } = mapping.apply(Rgb::gray(gray), 0.0);
                assert!((r - g).abs() < 5e-4 && (b - g).abs() < 5e-4, "{mapping:?} of {gray}: {r}, {g}, {b}");
            }
        }
    }

    #[test]
    fn any_number_becomes_one_from_0_to_1() {
        let nasty = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e-40, 0.5, 1e9, 3e38];
        for mapping in MAPPED {
            for (r, g, b) in nasty.iter().flat_map(|&r| nasty.iter().flat_map(move |&g| nasty.map(|b| (r, g, b)))) {
                for exposure in [-200.0, 0.0, 200.0] {
                    let shown = mapping.apply(Rgb::new(r, g, b), exposure).to_array();
                    assert!(shown.iter().all(|c| (0.0..=1.0).contains(c)), "{mapping:?} of {r}, {g}, {b}: {shown:?}");
                }
            }
        }
    }

    /// A dielectric under a white light of 1 sends back its base color and 4 % beside it, which is taken away again.
    #[test]
    fn pbr_neutral_keeps_base_colors() {
        for base in [[0.1, 0.2, 0.3], [0.7, 0.04, 0.5], [0.75, 0.75, 0.75], [0.5, 0.45, 0.07]] {
            let lit = Rgb::from(base) + Rgb::gray(0.04);
            assert_near(ToneMapping::PbrNeutral.apply(lit, 0.0), base, 1e-6);
        }
    }

    #[test]
    fn very_bright_saturated_light_goes_to_white() {
        for mapping in [ToneMapping::Aces, ToneMapping::Agx, ToneMapping::PbrNeutral] {
            let shown = mapping.apply(Rgb::new(1.0, 0.2, 0.05), 12.0);
            assert!(shown.min_component() > 0.9, "{mapping:?}: {shown:?}");
        }
    }
}
