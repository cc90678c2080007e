//! The thin lens: all of its points see the plane in focus the same way, and what is before or behind it differently.

use durer_math::functions::{cos, sin};
use durer_math::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// A lens in the plane of the eye, across the view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    /// From the middle to the right and to the top of the aperture, in the world.
    right: DVec3,
    up: DVec3,
    /// How far away the plane in focus is, along the view.
    pub(super) focus: f64,
    aperture: Aperture,
}

/// The shape of the opening, about the origin.
#[derive(Clone, Copy, Debug)]
enum Aperture {
    /// The unit disc.
    Round,
    /// A regular polygon whose corners lie on the unit circle.
    Blades {
        /// How many corners it has.
        count: u32,
        /// The angle of one of them, counterclockwise from the right, in radians.
        first: f64,
    },
}

impl Lens {
    /// A lens of this radius, by directions of length 1, in focus at a distance. `blades` of 0 make a round one; with others
    /// one corner is at the top, turned by `rotation` radians counterclockwise as the eye sees it.
    pub(super) fn new((right, up): (DVec3, DVec3), radius: f64, focus: f64, blades: u32, rotation: f64) -> Lens {
        let aperture = match blades {
            0..3 => Aperture::Round,
            count => Aperture::Blades { count, first: FRAC_PI_2 + rotation },
        };
        Lens { right: right * radius, up: up * radius, focus, aperture }
    }

    /// From the middle of the lens to the point that a point of the unit square stands for. Equal parts of the square stand for
    /// equal parts of the opening.
    pub(super) fn point(&self, square: DVec2) -> DVec3 {
        let at = match self.aperture {
            Aperture::Round => concentric_disc(square),
            Aperture::Blades { count, first } => regular_polygon(square, count, first),
        };
        self.right * at.x + self.up * at.y
    }

    /// A little more than half the width of the lens.
    pub(super) fn reach(&self) -> f64 {
        self.right.length().max(self.up.length()) * 1.001
    }
}

/// Points of the unit square to the unit disc: squares about the middle become circles, so that what lies side by side stays
/// so. Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997.
pub(crate) fn concentric_disc(square: DVec2) -> DVec2 {
    let at = square * 2.0 - DVec2::ONE;
    if at == DVec2::ZERO {
        return at;
    }
    let (radius, angle) = match at.x.abs() > at.y.abs() {
        true => (at.x, FRAC_PI_4 * (at.y / at.x)),
        false => (at.y, FRAC_PI_2 - FRAC_PI_4 * (at.x / at.y)),
    };
    DVec2::new(radius * cos(angle), radius * sin(angle))
}

/// Points of the unit square to a regular polygon: one of its triangles about the middle by the first coordinate, then a point
/// in it.
fn regular_polygon(square: DVec2, corners: u32, first: f64) -> DVec2 {
    let along = square.x * f64::from(corners);
    let triangle = along.floor().clamp(0.0, f64::from(corners - 1));
    let corner = |k: f64| {
        let angle = first + TAU * k / f64::from(corners);
        DVec2::new(cos(angle), sin(angle))
    };
    let (a, b) = triangle_weights(DVec2::new((along - triangle).clamp(0.0, 1.0), square.y));
    corner(triangle) * a + corner(triangle + 1.0) * b
}

/// Points of the unit square to the weights of two corners of a triangle, the third having the rest. Heitz, "A Low-Distortion
/// Map Between Triangle and Square", 2019.
fn triangle_weights(square: DVec2) -> (f64, f64) {
    let (a, b) = (square.x * 0.5, square.y * 0.5);
    match b > a {
        true => (a, square.y - a),
        false => (square.x - b, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lens(blades: u32, rotation: f64) -> Lens {
        Lens::new((DVec3::X, DVec3::Y), 1.0, 1.0, blades, rotation)
    }

    /// The middles of n × n parts of the unit square.
    fn lattice(n: u32) -> impl Iterator<Item = DVec2> {
        let middle = move |k: u32| (f64::from(k) + 0.5) / f64::from(n);
        (0..n * n).map(move |k| DVec2::new(middle(k % n), middle(k / n)))
    }

    /// Equal parts of the square become equal parts of the opening, so means over the square are means over the opening, of
    /// which the moments are known: r² of a disc is 1/2 in the mean, of a regular polygon of circumradius 1 it is
    /// (2 + cos(2π/n)) / 6.
    #[test]
    fn points_are_uniform() {
        // Each blade gets as many columns of the lattice.
        const N: u32 = 576;
        for blades in [0, 3, 4, 6, 9] {
            let lens = lens(blades, 0.3);
            let expected = if blades == 0 { 0.5 } else { (2.0 + cos(TAU / f64::from(blades))) / 6.0 };
            let points: Vec<DVec3> = lattice(N).map(|square| lens.point(square)).collect();
            let mean = |f: &dyn Fn(&DVec3) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
            assert!((mean(&|p| p.length_squared()) - expected).abs() < 1e-3, "{blades}");
            // Of shapes with more than one axis of symmetry all directions have the same second moment.
            assert!((mean(&|p| p.x * p.x) - expected / 2.0).abs() < 3e-3, "{blades}");
            assert!(mean(&|p| p.x * p.y).abs() < 3e-3 && mean(&|p| p.x).abs() < 3e-3, "{blades}");
            assert!(points.iter().all(|p| p.length() <= 1.0 && p.z == 0.0), "{blades}");
            let within_half = mean(&|p| f64::from(u8::from(p.length() < 0.4)));
            let area = if blades == 0 { TAU / 2.0 } else { f64::from(blades) / 2.0 * sin(TAU / f64::from(blades)) };
            // A circle of radius 0.4 lies within all of them.
            assert!((within_half - TAU / 2.0 * 0.16 / area).abs() < 3e-3, "{blades}: {within_half}");
        }
    }

    #[test]
    fn a_corner_is_at_the_top_and_turns_counterclockwise() {
        for (rotation, corner) in [(0.0, DVec3::Y), (FRAC_PI_2, -DVec3::X)] {
            let lens = lens(5, rotation);
            let farthest = lattice(200).map(|square| lens.point(square)).filter(|p| p.dot(corner) > 0.9);
            assert!(farthest.map(|p| p.dot(corner)).fold(0.0, f64::max) > 0.98);
            // On the other side is the middle of an edge.
            let opposite = lattice(200).map(|square| lens.point(square).dot(-corner)).fold(0.0, f64::max);
            assert!((opposite - cos(TAU / 10.0)).abs() < 0.02, "{opposite}");
        }
    }

    #[test]
    fn the_edges_of_the_square_are_no_trouble() {
        for (x, y) in [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.999_999, 0.5)] {
            for blades in [0, 3, 7] {
                let point = lens(blades, 0.0).point(DVec2::new(x, y));
                assert!(point.is_finite() && point.length() <= 1.0 + 1e-12, "{x}, {y}, {blades}: {point}");
            }
        }
    }
}
