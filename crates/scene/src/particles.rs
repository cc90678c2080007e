//! Simple shapes by the million, without an object for each.

use crate::{Data, Sizes};
use durer_math::{DVec3, Rgb};

/// Many shapes of one kind, with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Particles {
    /// A file with usual columns that gave what the fields below do not say themselves.
    pub file: Option<String>,
    /// The kind, and what it takes to place each.
    pub kind: ParticleKind,
    /// A linear colour for each. They take the place of the material's plain colour, and multiply its texture.
    pub colors: Option<Data<Rgb>>,
}

impl Particles {
    /// The most in one list.
    pub const MOST: usize = 1 << 28;
}

/// The kinds of particles. All lists of one set have the same length.
#[derive(Clone, Debug, PartialEq)]
pub enum ParticleKind {
    /// Balls.
    Spheres {
        /// Their middles.
        centers: Data<DVec3>,
        /// Their radii, above 0.
        radii: Sizes,
    },
    /// Cylinders between two points, as bonds between atoms.
    Cylinders {
        /// Middle of one end.
        bases: Data<DVec3>,
        /// Middle of the other end.
        tops: Data<DVec3>,
        /// Their radii, above 0.
        radii: Sizes,
        /// True takes the caps away.
        open: bool,
    },
    /// Cones, or frusta, as heads of arrows.
    Cones {
        /// Middles of the bases.
        bases: Data<DVec3>,
        /// Apices, or middles of the tops.
        tops: Data<DVec3>,
        /// Radii at the bases, above 0.
        radii: Sizes,
        /// Radii at the tops, not negative.
        top_radii: Sizes,
        /// True takes the caps away.
        open: bool,
    },
    /// Cylinders with a half ball at each end.
    Capsules {
        /// Middle of one half ball.
        bases: Data<DVec3>,
        /// Middle of the other half ball.
        tops: Data<DVec3>,
        /// Their radii, above 0.
        radii: Sizes,
    },
}

impl ParticleKind {
    /// The word for this kind in scene files and messages.
    pub fn word(&self) -> &'static str {
        match self {
            ParticleKind::Spheres { .. } => "spheres",
            ParticleKind::Cylinders { .. } => "cylinders",
            ParticleKind::Cones { .. } => "cones",
            ParticleKind::Capsules { .. } => "capsules",
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            ParticleKind::Spheres { centers, .. } => centers.values.len(),
            ParticleKind::Cylinders { bases, .. }
            | ParticleKind::Cones { bases, .. }
            | ParticleKind::Capsules { bases, .. } => bases.values.len(),
        }
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
