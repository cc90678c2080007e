//! Aiming at a box: uniform in the solid angle that its faces fill.

use super::rectangle::Seen;
use super::{Chosen, Shows, Target};
use durer_math::{DVec2, DVec3};

/// From -`half` to `half`. Parts 0 to 5 are the faces -x, +x, -y, +y, -z, +z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cuboid {
    pub(super) half: DVec3,
    pub(super) shows: Shows,
}

/// A box is small if it fills less than this; then its faces are weighed by what they look like from far away.
const SMALL: f64 = 1e-7;

/// The faces as seen from somewhere, and what each weighs.
struct Faces {
    seen: [Option<Seen>; 6],
    weights: [f64; 6],
}

impl Cuboid {
    /// The two axes along a face.
    fn axes(part: usize) -> [usize; 3] {
        let axis = part / 2;
        [axis, (axis + 1) % 3, (axis + 2) % 3]
    }

    fn faces(&self, from: DVec3) -> Faces {
        let inside = from.abs().cmplt(self.half).all();
        let shows_all = inside || self.shows == Shows::BothSides;
        let mut seen = [None; 6];
        for (part, seen) in seen.iter_mut().enumerate() {
            let [axis, u, v] = Cuboid::axes(part);
            let above = if part % 2 == 1 { from[axis] - self.half[axis] } else { -from[axis] - self.half[axis] };
            if above > 0.0 || (shows_all && above != 0.0) {
                let range = |axis: usize| [-self.half[axis] - from[axis], self.half[axis] - from[axis]];
                *seen = Some(Seen::new(range(u), range(v), above.abs()));
            }
        }
        let solid_angles = seen.map(|face| face.map_or(0.0, |face| face.solid_angle.max(0.0)));
        let weights = if solid_angles.iter().sum::<f64>() > SMALL {
            solid_angles
        } else {
            seen.map(|face| face.map_or(0.0, |face| face.weight_from_afar()))
        };
        let all: f64 = weights.iter().sum();
        Faces { seen, weights: weights.map(|weight| if all > 0.0 { weight / all } else { 0.0 }) }
    }
}

impl Target for Cuboid {
    fn sample(&self, from: DVec3, at: DVec2) -> Option<Chosen> {
        let faces = self.faces(from);
        let mut left = at.x;
        let mut chosen = None;
        for (part, &weight) in faces.weights.iter().enumerate() {
            if weight > 0.0 {
                chosen = Some((part, (left / weight).clamp(0.0, 1.0)));
                if left < weight {
                    break;
                }
                left -= weight;
            }
        }
        let (part, x) = chosen?;
        let seen = faces.seen[part]?;
        let place = seen.sample(DVec2::new(x, at.y));
        let [axis, u, v] = Cuboid::axes(part);
        let mut point = DVec3::ZERO;
        point[axis] = if part % 2 == 1 { self.half[axis] } else { -self.half[axis] };
        point[u] = from[u] + place.x;
        point[v] = from[v] + place.y;
        Some(Chosen { point, part: part as u32, pdf: faces.weights[part] * seen.pdf(place) })
    }

    fn pdf(&self, from: DVec3, point: DVec3, part: u32) -> f64 {
        let faces = self.faces(from);
        let part = part as usize;
        let [_, u, v] = Cuboid::axes(part);
        let place = DVec2::new(point[u] - from[u], point[v] - from[v]);
        faces.seen[part].map_or(0.0, |seen| faces.weights[part] * seen.pdf(place))
    }
}
