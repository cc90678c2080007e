//! Films of samples: for each pixel, sums that are exact, so that their order does not matter.
//!
//! A color is added as a whole number of steps of 2⁻⁶⁰, which 128 bits hold for 2³² samples of up to 2³⁴. So any samples of
//! any pixels, taken by any threads, in one run or in many, add up to the same bits. Sums in floating point would not,
//! whatever their precision; and sums in trees of a fixed shape would, but only for the ranges that the tree has.
//!
//! Light that is too bright for these numbers is never taken for light that is known: a sample above 2³⁴ counts as 2³⁴, and
//! the variance of its pixel as infinite; and so does that of a pixel whose squares together are 2⁷⁷ or more, which takes
//! half a million samples of 2²⁹. Such sums stay what they are, whatever is added to them, so that order does not matter here
//! either.

use super::{Account, Region};
use crate::passes::{CELL, PASSES};
use durer_math::Rgb;

/// A range of the samples of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleRange {
    /// The number of the first.
    pub start: u32,
    /// The number after the last.
    pub end: u32,
}

/// Samples of the pixels of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Which pixels.
    pub region: Region,
    /// Which of their samples.
    pub samples: SampleRange,
}

/// The sums of the samples of a film's pixels, row by row: as many of each as there are pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sums {
    /// What the film is of. Until it is finished, pixels have the first of these samples, as many as `taken` says; after
    /// that, all, or as many as the noise that was aimed at took. Sorted, and none overlaps another.
    pub parts: Vec<Part>,
    /// Samples taken.
    pub taken: Vec<u32>,
    /// How many of them count, and how many count negatively, where the filter is below 0; the others were not finite.
    pub counts: Vec<[u32; 2]>,
    /// Of the colors, in linear light and steps of 2⁻⁶⁰.
    pub colors: Vec<[i128; 3]>,
    /// Of that part of the colors that is light which met one surface at most, or nothing if that is not known apart.
    pub direct: Vec<[i128; 3]>,
    /// Of the squares of their luminances, in steps of 2⁻⁵⁰: what chance does is estimated by them. The greatest number there
    /// is stands for all that are greater, and for samples whose color is not known.
    pub squares: Vec<i128>,
    /// Of a film that aims at noise and is not finished: what is known of each cell of 8 × 8 pixels on a grid that begins at
    /// the picture's corner, or of its part in the film, row by row. Nothing for others, and before the first look.
    pub calm: Vec<Calm>,
}

/// What is known of the noise of a cell of 8 × 8 pixels, while a film aims at noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Calm {
    /// The samples that each of its pixels had when it was last looked at.
    pub samples: u32,
    /// In how many passes running there was little enough; 2 stands for any more.
    pub passes: u8,
    /// The samples that each pixel had when that was 2 for the first time; 0 if it never was.
    pub first: u32,
}

/// The sums of one pixel, or what some samples add to them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PixelSums {
    pub(crate) taken: u32,
    counts: [u32; 2],
    color: [i128; 3],
    direct: [i128; 3],
    square: i128,
}

/// Some samples of the pixels of a rectangle.
#[derive(Clone, Debug)]
pub(crate) struct SampledTile {
    pub(crate) region: Region,
    pub(crate) pixels: Vec<PixelSums>,
    pub(crate) account: Account,
}

impl SampleRange {
    /// How many there are.
    pub fn count(self) -> u32 {
        self.end.saturating_sub(self.start)
    }
}

/// The greatest component of a sample that is added as it is.
const BRIGHTEST: f64 = (1_u64 << 34) as f64;

/// A component in steps. What is more than [`BRIGHTEST`] counts as much.
fn fixed(component: f64) -> i128 {
    let component = component.clamp(-BRIGHTEST, BRIGHTEST);
    // `(component * COLOR) as i128`, in two steps that processors have instructions for.
    let whole = component as i64;
    (i128::from(whole) << COLOR_BITS) + i128::from(((component - whole as f64) * COLOR) as i64)
}

/// The square of a luminance in steps; the greatest number there is if that is too much for it.
fn square(color: Rgb) -> i128 {
    if color.to_array().into_iter().any(|component| f64::from(component).abs() > BRIGHTEST) {
        return i128::MAX;
    }
    let luminance = f64::from(color.luminance());
    let steps = luminance * luminance * SQUARE;
    // Most are so small that there is an instruction for it.
    if steps < i64::MAX as f64 { (steps as i64).into() } else { steps as i128 }
}

/// The steps of a color in 1. Numbers of single precision from 2⁻³⁶ to 2³⁴ are exact.
const COLOR: f64 = (1_u64 << COLOR_BITS) as f64;
const COLOR_BITS: u32 = 60;
/// Those of the square of a luminance.
const SQUARE: f64 = (1_u64 << 50) as f64;

impl PixelSums {
    /// Adds a sample.
    ///
    /// # Errors
    /// The sample is not finite. It counts as taken, and nothing else.
    pub(crate) fn add(&mut self, color: Rgb, direct: Rgb, is_negative: bool) -> Result<(), NotFinite> {
        self.taken += 1;
        if !(color.is_finite() && direct.is_finite()) {
            return Err(NotFinite);
        }
        let sign = if is_negative { -1.0 } else { 1.0 };
        for (sums, color) in [(&mut self.color, color), (&mut self.direct, direct)] {
            if !color.is_black() {
                for (sum, component) in sums.iter_mut().zip(color.to_array()) {
                    *sum += fixed(sign * f64::from(component));
                }
            }
        }
        self.square = self.square.saturating_add(square(color));
        self.counts[usize::from(is_negative)] += 1;
        Ok(())
    }
}

/// A sample was not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotFinite;

impl Sums {
    /// None as yet, of the pixels of a part.
    pub(crate) fn new(part: Part, direct: bool) -> Sums {
        let length = part.region.pixels() as usize;
        Sums {
            parts: vec![part],
            taken: vec![0; length],
            counts: vec![[0; 2]; length],
            colors: vec![[0; 3]; length],
            direct: if direct { vec![[0; 3]; length] } else { Vec::new() },
            squares: vec![0; length],
            calm: Vec::new(),
        }
    }

    /// True if they are those of a film of this region, as far as can be told.
    pub(super) fn fit(&self, region: Region, is_finished: bool) -> bool {
        let Sums { parts, taken, counts, colors, direct, squares, calm } = self;
        let length = region.pixels();
        let all_there = [taken.len(), counts.len(), colors.len(), squares.len()].iter().all(|&l| l as u64 == length);
        let counted =
            taken.iter().zip(counts).all(|(taken, [a, b])| a.checked_add(*b).is_some_and(|sum| sum <= *taken));
        let is_begun = |part: &Part| part.region == region && taken.iter().all(|&taken| taken <= part.samples.count());
        let judged = calm.is_empty()
            || !is_finished
                && calm.len() as u64 == region.cell_count(CELL)
                && calm.iter().all(|calm| calm.passes <= PASSES);
        all_there
            && judged
            && squares.iter().all(|&square| square >= 0)
            && (direct.is_empty() || direct.len() as u64 == length)
            && counted
            && parts_fit(parts, region)
            && (is_finished || matches!(&parts[..], [part] if is_begun(part)))
    }

    /// If all pixels have the same samples, these were all that there are to be.
    pub(super) fn close(&mut self) {
        let (least, most) = self.least_and_most();
        if let ([part], true) = (&mut self.parts[..], least == most && least > 0) {
            part.samples.end = part.samples.start.saturating_add(least);
        }
    }

    /// All samples that were taken.
    pub fn samples(&self) -> u64 {
        self.taken.iter().map(|&taken| u64::from(taken)).sum()
    }

    /// The fewest and the most samples that a pixel has.
    pub fn least_and_most(&self) -> (u32, u32) {
        let taken = || self.taken.iter().copied();
        (taken().min().unwrap_or(0), taken().max().unwrap_or(0))
    }

    /// Adds to those of a pixel.
    pub(crate) fn add(&mut self, pixel: usize, more: &PixelSums) {
        // Only numbers that somebody else has written can be so large.
        self.taken[pixel] = self.taken[pixel].saturating_add(more.taken);
        for (count, more) in self.counts[pixel].iter_mut().zip(more.counts) {
            *count = count.saturating_add(more);
        }
        let direct = self.direct.get_mut(pixel).into_iter().flatten().zip(more.direct);
        for (sum, more) in self.colors[pixel].iter_mut().zip(more.color).chain(direct) {
            *sum = sum.wrapping_add(more);
        }
        self.squares[pixel] = self.squares[pixel].saturating_add(more.square);
    }

    /// Those of a pixel.
    pub(super) fn of(&self, pixel: usize) -> PixelSums {
        PixelSums {
            taken: self.taken[pixel],
            counts: self.counts[pixel],
            color: self.colors[pixel],
            direct: self.direct.get(pixel).copied().unwrap_or_default(),
            square: self.squares[pixel],
        }
    }

    /// The color of a pixel, as far as it is known; black if nothing is.
    pub fn mean(&self, pixel: usize) -> Rgb {
        self.mean_of(&self.colors[pixel], pixel)
    }

    /// What of it is light that met one surface at most; `None` if that is not known apart.
    pub fn direct_mean(&self, pixel: usize) -> Option<Rgb> {
        self.direct.get(pixel).map(|direct| self.mean_of(direct, pixel))
    }

    fn mean_of(&self, sum: &[i128; 3], pixel: usize) -> Rgb {
        let [r, g, b] = sum.map(|sum| sum as f64 / COLOR / self.divisor(pixel));
        Rgb::new(r as f32, g as f32, b as f32)
    }

    /// The variance of the mean of a pixel's luminance, by that of its samples; infinite if there are less than two, or if they
    /// are too bright to tell. The samples work together, so it is more than what is really there.
    pub fn variance(&self, pixel: usize) -> f64 {
        let [positive, negative] = self.counts[pixel].map(f64::from);
        let count = positive + negative;
        if count < 2.0 || self.squares[pixel] == i128::MAX {
            return f64::INFINITY;
        }
        let luminance = f64::from(self.mean(pixel).luminance());
        // Of a sample that counts negatively, that much is taken away: it is as far from the mean as that.
        let share = self.divisor(pixel) / count;
        let of_samples = self.squares[pixel] as f64 / SQUARE / count - (luminance * share) * (luminance * share);
        of_samples.max(0.0) / (count - 1.0) / (share * share)
    }

    /// What the sum of a pixel is to be divided by: what its samples count together, so that an even surface is even. If the
    /// negative part of a filter has more than its share, as may be with few samples, that says nothing.
    fn divisor(&self, pixel: usize) -> f64 {
        let [positive, negative] = self.counts[pixel].map(f64::from);
        (positive - negative).max(0.5 * (positive + negative)).max(1.0)
    }
}

/// More parts than a film can be of.
pub(super) const MOST_PARTS: usize = 4096;

/// True if parts can be those of a film of this region: sorted, and none overlaps another.
pub(super) fn parts_fit(parts: &[Part], region: Region) -> bool {
    let inside = |part: &Part| part.region.is_somewhere() && part.region.intersection(region) == Some(part.region);
    let is_fine = |part: &Part| inside(part) && part.samples.count() > 0;
    let alone = |(at, part): (usize, &Part)| parts[at + 1..].iter().all(|other| !part.overlaps(other));
    !parts.is_empty()
        && parts.len() <= MOST_PARTS
        && parts.iter().all(is_fine)
        && parts.is_sorted_by_key(Part::order)
        && parts.iter().enumerate().all(alone)
}

impl Part {
    /// By samples, then row by row.
    pub(super) fn order(&self) -> (SampleRange, u32, u32) {
        (self.samples, self.region.y, self.region.x)
    }

    /// True if both have some samples.
    fn overlaps(&self, other: &Part) -> bool {
        let (a, b) = (self.samples, other.samples);
        a.start.max(b.start) < a.end.min(b.end) && self.region.intersection(other.region).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums_of(samples: &[(Rgb, bool)]) -> Sums {
        let region = Region { x: 0, y: 0, width: 1, height: 1 };
        let mut sums = Sums::new(Part { region, samples: SampleRange { start: 0, end: 100 } }, true);
        for &(color, is_negative) in samples {
            let mut pixel = PixelSums::default();
            let _ = pixel.add(color, color * 0.5, is_negative);
            sums.add(0, &pixel);
        }
        sums
    }

    fn colors() -> Vec<(Rgb, bool)> {
        let number = |n: u32| (n.wrapping_mul(2_654_435_761) >> 8) as f32 / 1e4;
        (0..50).map(|n| (Rgb::new(number(n), number(n + 99) * 1e-6, number(n + 7) * 1e2), n % 11 == 3)).collect()
    }

    #[test]
    fn steps_are_cut_toward_zero() {
        let numbers = colors().into_iter().flat_map(|(color, _)| color.to_array()).map(f64::from);
        for number in numbers.chain([0.0, 1.5, 0.5 / COLOR, (1_u64 << 33) as f64 + 0.25, 1e300, f64::MIN_POSITIVE]) {
            for number in [number, -number] {
                assert_eq!(fixed(number), (number.clamp(-BRIGHTEST, BRIGHTEST) * COLOR) as i128, "{number}");
            }
        }
    }

    #[test]
    fn the_order_of_samples_does_not_matter() {
        let mut samples = colors();
        let sums = sums_of(&samples);
        samples.reverse();
        assert_eq!(sums, sums_of(&samples));
        samples.swap(3, 30);
        assert_eq!(sums, sums_of(&samples));
    }

    #[test]
    fn means_and_variances_are_those_of_statistics() {
        let samples: Vec<(Rgb, bool)> = colors().into_iter().map(|(color, _)| (color, false)).collect();
        let sums = sums_of(&samples);
        let count = samples.len() as f64;
        let of = |f: &dyn Fn(Rgb) -> f64| samples.iter().map(|&(color, _)| f(color)).sum::<f64>() / count;
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
        let mean = sums.mean(0);
        near(f64::from(mean.r), of(&|color| f64::from(color.r)));
        near(f64::from(mean.g), of(&|color| f64::from(color.g)));
        near(f64::from(mean.b), of(&|color| f64::from(color.b)));
        let luminance = of(&|color| f64::from(color.luminance()));
        let square =
            of(&|color| (f64::from(color.luminance()) - luminance) * (f64::from(color.luminance()) - luminance));
        near(sums.variance(0), square / (count - 1.0));
    }

    /// Also if some samples count negatively, and if some are not finite.
    #[test]
    fn an_even_surface_is_even() {
        let color = Rgb::new(0.1, 0.7, 123.0);
        let samples: Vec<(Rgb, bool)> = (0..40).map(|n| (color, n % 9 == 0)).collect();
        assert_eq!(sums_of(&samples).mean(0), color);
        assert_eq!(sums_of(&samples).direct_mean(0), Some(color * 0.5));
        let with_bad = [&samples[..], &[(Rgb::gray(f32::NAN), false), (Rgb::gray(f32::INFINITY), true)]].concat();
        let sums = sums_of(&with_bad);
        assert_eq!((sums.mean(0), sums.taken[0]), (color, 42));
        assert_eq!(sums_of(&[]).mean(0), Rgb::BLACK);
    }

    /// Samples of 2²³ are beyond what squares could hold that stopped at 2⁴⁴; their variance is that of all others, scaled.
    #[test]
    fn bright_light_has_the_variance_of_dark_light_scaled() {
        let of = |scale: f32| {
            let samples: Vec<(Rgb, bool)> =
                (0..64_u32).map(|n| (Rgb::gray(if n % 16 == 5 { scale } else { 0.0 }), false)).collect();
            sums_of(&samples).variance(0) / f64::from(scale) / f64::from(scale)
        };
        // 4 of 64: p (1 - p) / 63.
        let expected = 0.0625 * 0.9375 / 63.0;
        for power in [0_u32, 10, 21, 23, 28, 33] {
            let found = of((1_u64 << power) as f32);
            assert!((found / expected - 1.0).abs() < 1e-6, "2^{power}: {found}");
        }
        assert!(of(3e10).is_infinite());
    }

    /// What is too bright to be known stays unknown, in any order.
    #[test]
    fn light_that_is_too_bright_is_not_taken_for_known() {
        let dark = (Rgb::gray(0.5), false);
        for bright in [Rgb::gray(1e11), Rgb::new(f32::MAX, 0.0, 0.0)] {
            let first = sums_of(&[(bright, false), dark, dark]);
            assert_eq!(first, sums_of(&[dark, dark, (bright, false)]));
            assert!(first.variance(0).is_infinite());
        }
        // Each alone can be told, and all together cannot.
        let many = sums_of(&vec![(Rgb::gray(1.7e10), false); 600]);
        assert!(sums_of(&[(Rgb::gray(1.7e10), false); 300]).variance(0).is_finite());
        assert!(many.variance(0).is_infinite());
    }

    #[test]
    fn the_brightest_and_the_darkest_fit() {
        let bright = sums_of(&[(Rgb::gray(f32::MAX), false); 50]);
        assert!((f64::from(bright.mean(0).r) / f64::from(1 << 17) / f64::from(1 << 17) - 1.0).abs() < 1e-6);
        let dark = Rgb::gray(1e-10);
        assert_eq!(sums_of(&[(dark, false); 50]).mean(0), dark);
    }
}
