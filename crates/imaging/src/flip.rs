//! FLIP: how strongly a viewer who flips between two pictures sees a difference, for each pixel.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating
//! Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020; the variant for pictures
//! of low dynamic range. Section numbers below are the paper's.

mod color;
mod filter;

use crate::Image;
use crate::compare::clamped;
use color::{hunt_lab_from_linear, linear_from_ycxcz, ycxcz_from_linear};
use durer_math::Rgb;
use durer_math::functions::pow;
use filter::{Kernel, Plane};

/// The paper's default: a screen 3840 pixels and 0.7 m wide, seen from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 67.0;

/// The exponent of color differences, q_c (4.1.4).
const COLOR_EXPONENT: f32 = 0.7;
/// Color differences below this share of the largest, p_c, are spread over most of the range (4.1.4).
const COLOR_KNEE: f32 = 0.4;
/// The error at the knee, p_t (4.1.4).
const ERROR_AT_KNEE: f32 = 0.95;
/// The exponent of feature differences, q_f (4.2.2).
const FEATURE_EXPONENT: f32 = 0.5;

/// An error for each pixel, from 0 (not visible) to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` errors: rows from the top, pixels from the left.
    pub values: Vec<f32>,
}

impl ErrorMap {
    /// The mean error; 0 for an empty map.
    pub fn mean(&self) -> f64 {
        self.values.iter().map(|&error| f64::from(error)).sum::<f64>() / self.values.len().max(1) as f64
    }
}

/// The FLIP error between two pictures of the same size, clamped to 0..1, for 67 pixels per degree.
pub(crate) fn error_map(a: &Image, b: &Image) -> ErrorMap {
    let Image { width, height, .. } = *a;
    if a.pixels.is_empty() {
        return ErrorMap { width, height, values: Vec::new() };
    }
    let (a, b) = (Seen::of(a), Seen::of(b));
    let color_errors = ColorErrors::new();
    let pairs = a.colors.iter().zip(&b.colors).zip(a.features.iter().zip(&b.features));
    let values = pairs.map(|((&color_a, &color_b), (&features_a, &features_b))| {
        let color = color_errors.between(color_a, color_b);
        pow(color, 1.0 - feature_error(features_a, features_b))
    });
    ErrorMap { width, height, values: values.collect() }
}

/// A picture as the model sees it.
struct Seen {
    /// Colours blurred as the eye blurs them, in Hunt-adjusted L*a*b*.
    colors: Vec<[f32; 3]>,
    /// How strong an edge and a point are at each pixel.
    features: Vec<[f32; 2]>,
}

impl Seen {
    fn of(image: &Image) -> Seen {
        let opponent: Vec<[f32; 3]> =
            image.pixels.iter().map(|&color| ycxcz_from_linear(clamped(color).to_array())).collect();
        let plane =
            |channel: usize| Plane::new(image.width as usize, opponent.iter().map(|color| color[channel]).collect());
        let [y, cx, cz] = [plane(0), plane(1), plane(2)];
        Seen { colors: blurred_colors(&y, &cx, &cz), features: features(&y) }
    }
}

/// Blurs by the eye's sensitivity to contrast (4.1.1) and goes on to a space of perceived differences (4.1.2).
fn blurred_colors(y: &Plane, cx: &Plane, cz: &Plane) -> Vec<[f32; 3]> {
    // Each filter is a sum of Gaussians (a, b) with a √(π/b) exp(-π² x²/b), x in degrees: table 1 of the paper.
    let y = filtered(y, &[(1.0, 0.0047)]);
    let cx = filtered(cx, &[(1.0, 0.0053)]);
    let cz = filtered(cz, &[(34.1, 0.04), (13.5, 0.025)]);
    let colors = y.values.iter().zip(&cx.values).zip(&cz.values);
    colors
        .map(|((&y, &cx), &cz)| {
            let linear = Rgb::from(linear_from_ycxcz([y, cx, cz]));
            hunt_lab_from_linear(clamped(linear).to_array())
        })
        .collect()
}

/// The plane under a normalized sum of Gaussians.
fn filtered(plane: &Plane, gaussians: &[(f64, f64)]) -> Plane {
    use std::f64::consts::PI;
    // All filters have the radius of three deviations of the widest Gaussian, b = 0.04.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let terms: Vec<(f64, Kernel)> = gaussians
        .iter()
        .map(|&(a, b)| {
            let deviation = (b / 2.0).sqrt() / PI * PIXELS_PER_DEGREE;
            let (kernel, sum) = Kernel::gaussian(deviation, radius);
            // A two-dimensional Gaussian is the product of two: its sum is the square.
            (a * (PI / b).sqrt() * sum * sum, kernel)
        })
        .collect();
    let total: f64 = terms.iter().map(|(weight, _)| weight).sum();
    let mut result = Plane::new(plane.width, vec![0.0; plane.values.len()]);
    for (weight, kernel) in &terms {
        result.add_scaled(&plane.along_rows(kernel).along_columns(kernel), (weight / total) as f32);
    }
    result
}

/// How strong an edge and a point are at each pixel of the luminance (4.2.1).
fn features(y: &Plane) -> Vec<[f32; 2]> {
    // Half of w, the width in degrees of the features that the eye detects, in pixels.
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as usize;
    let (smooth, _) = Kernel::gaussian(deviation, radius);
    let edge = Kernel::first_derivative(deviation, radius);
    let point = Kernel::second_derivative(deviation, radius);
    // Y of the opponent space runs from -16 to 100.
    let y = Plane::new(y.width, y.values.iter().map(|&y| (y + 16.0) / 116.0).collect());
    let smooth_rows = y.along_rows(&smooth);
    let edges = lengths(&y.along_rows(&edge).along_columns(&smooth), &smooth_rows.along_columns(&edge));
    let points = lengths(&y.along_rows(&point).along_columns(&smooth), &smooth_rows.along_columns(&point));
    edges.into_iter().zip(points).map(|(edge, point)| [edge, point]).collect()
}

/// The lengths of the vectors with these components.
fn lengths(x: &Plane, y: &Plane) -> Vec<f32> {
    x.values.iter().zip(&y.values).map(|(x, y)| (x * x + y * y).sqrt()).collect()
}

/// ΔE_f: how different edges and points are (4.2.2).
fn feature_error(a: [f32; 2], b: [f32; 2]) -> f32 {
    let difference = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    pow(difference * std::f32::consts::FRAC_1_SQRT_2, FEATURE_EXPONENT).min(1.0)
}

/// ΔE_c: how different colours are, from 0 to 1 (4.1.3 and 4.1.4).
struct ColorErrors {
    largest: f32,
}

impl ColorErrors {
    fn new() -> ColorErrors {
        let (green, blue) = (hunt_lab_from_linear([0.0, 1.0, 0.0]), hunt_lab_from_linear([0.0, 0.0, 1.0]));
        ColorErrors { largest: pow(hyab(green, blue), COLOR_EXPONENT) }
    }

    fn between(&self, a: [f32; 3], b: [f32; 3]) -> f32 {
        let difference = pow(hyab(a, b), COLOR_EXPONENT);
        let knee = COLOR_KNEE * self.largest;
        let error = if difference < knee {
            ERROR_AT_KNEE * difference / knee
        } else {
            ERROR_AT_KNEE + (difference - knee) / (self.largest - knee) * (1.0 - ERROR_AT_KNEE)
        };
        error.min(1.0)
    }
}

/// The HyAB distance: city-block in lightness, Euclidean in the two others.
fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [l, x, y] = [0, 1, 2].map(|i| a[i] - b[i]);
    l.abs() + (x * x + y * y).sqrt()
}
