//! What five samples of a square show.

use crate::eye::Look;

/// Tells what is to be seen in a square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judge {
    /// The largest difference of a component, from 0 to 1 as on a screen, that is let pass.
    pub(super) threshold: f32,
}

/// What is to be seen in a square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Much the same everywhere.
    Flat,
    /// Two colours that may meet along a line: true for the samples (corners clockwise, middle) of the second.
    Edge([bool; 5]),
    /// More than that.
    Mixed,
    /// Something small lies there that no sample has met.
    Missed,
}

/// Of a difference, how much colours on one side of an edge may differ: more is a third colour.
const SIDE: f32 = 0.3;
/// Where colours change evenly, the samples tell the mean though they differ this many thresholds.
const EVEN: f32 = 6.0;

/// By how much more colours may differ in squares of a pixel that was divided so often: what is wrong in a quarter matters a
/// quarter as much, and there are four of them, wrong in ways that have little to do with each other, so together they are
/// wrong by about half. This grows by the root of two a level, to be careful.
const GROWTH: [f32; 8] = [1.0, 1.41, 2.0, 2.83, 4.0, 5.66, 8.0, 11.31];

/// How much two looks differ, as seen.
pub(super) fn difference(a: &Look, b: &Look) -> f32 {
    a.seen.iter().zip(b.seen).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// To which of two ends something belongs: false for the first, true for the second; `None` if it is like neither.
pub(super) fn nearer(look: &Look, ends: [&Look; 2]) -> Option<bool> {
    let [first, second] = ends.map(|end| difference(look, end));
    (first.min(second) <= SIDE * difference(ends[0], ends[1])).then_some(second < first)
}

/// True if two looks may be of one smooth surface.
fn same_surface(a: &Look, b: &Look) -> bool {
    if a.piece != b.piece {
        return false;
    }
    let cosine: f32 = a.normal.iter().zip(b.normal).map(|(a, b)| a * b).sum();
    let depths = (a.depth - b.depth).abs() <= 0.1 * a.depth.min(b.depth);
    (cosine > 0.9 && depths) || a.depth == b.depth
}

impl Judge {
    /// Judges the corners, clockwise, and the middle of a square of a pixel that was divided so often.
    pub(super) fn verdict(&self, looks: [&Look; 5], level: u8) -> Verdict {
        let (mut range, mut ends) = (0.0, [0, 0]);
        for i in 0..5 {
            for j in 0..i {
                let difference = difference(looks[i], looks[j]);
                if difference > range {
                    (range, ends) = (difference, [j, i]);
                }
            }
        }
        let threshold = self.threshold * GROWTH[usize::from(level).min(GROWTH.len() - 1)];
        let surface = looks.iter().all(|look| same_surface(look, looks[4]));
        if range <= threshold {
            // Between things that look alike there may be something that does not.
            return if surface || level > 0 { Verdict::Flat } else { Verdict::Mixed };
        }
        if surface && range <= EVEN * threshold && is_even(looks, threshold) {
            return Verdict::Flat;
        }
        let classes = looks.map(|look| nearer(look, ends.map(|end| looks[end])));
        match classes {
            [Some(a), Some(b), Some(c), Some(d), Some(middle)] => {
                let corners = [a, b, c, d];
                let changes = (0..4).filter(|&i| corners[i] != corners[(i + 1) % 4]).count();
                if changes == 2 { Verdict::Edge([a, b, c, d, middle]) } else { Verdict::Mixed }
            }
            _ => Verdict::Mixed,
        }
    }
}

/// True if the middle lies between opposite corners in colour as it does in place.
fn is_even([a, b, c, d, middle]: [&Look; 5], threshold: f32) -> bool {
    let bent = |from: &Look, to: &Look| {
        let bends = (0..3).map(|i| (from.seen[i] + to.seen[i] - 2.0 * middle.seen[i]).abs());
        bends.fold(0.0, f32::max)
    };
    bent(a, c) <= threshold && bent(b, d) <= threshold
}
